// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_stream.hpp"

#include <algorithm>
#include <cstring>

#include "readers/tokens.hpp"

namespace bedscope::readers {
namespace {

constexpr std::size_t padding = 64;  // bytes behind the end that may be read: loads of 8 bytes
// Names, macros and strings; a token beyond it is damage (a quote that is never closed).
constexpr std::size_t longest_token = 1U << 20;

bool is_sign(char c) { return c != '\0' && std::strchr("(){}[];,", c) != nullptr; }
bool begins_number(char c) { return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.'; }

}  // namespace

FoamStream::FoamStream(const std::string& path)
    : path_(path), source_(std::make_unique<Source>(path)), buffer_(piece + padding) {
  at_ = end_ = held_ = buffer_.data();
  buffer_[0] = '\0';
}

FoamStream::FoamStream(std::string_view text, const std::string& path)
    : path_(path), buffer_(text.size() + padding) {
  std::copy(text.begin(), text.end(), buffer_.begin());
  at_ = buffer_.data();
  end_ = held_ = at_ + text.size();
  position_ = text.size();
}

bool FoamStream::more() {
  if (source_ == nullptr || position_ >= limit_) return false;
  const auto rest = static_cast<std::size_t>(end_ - at_);
  if (2 * rest + padding > buffer_.size()) {  // a long token or row: grow
    std::vector<char> larger(buffer_.size() * 2);
    std::memcpy(larger.data(), at_, rest);
    buffer_.swap(larger);
  } else {
    std::memmove(buffer_.data(), at_, rest);
  }
  const auto room = std::min<std::uint64_t>(buffer_.size() - padding - rest, limit_ - position_);
  const auto got = source_->read({buffer_.data() + rest, static_cast<std::size_t>(room)});
  at_ = buffer_.data();
  end_ = held_ = at_ + rest + got;
  buffer_[rest + got] = '\0';
  position_ += got;
  return got > 0;
}

std::uint64_t FoamStream::left() const {
  const auto bound = source_ == nullptr ? position_ : std::min(limit_, source_->size_bound());
  const auto here = offset();
  return bound > here ? bound - here : 0;
}

std::size_t FoamStream::read(std::span<char> into) {
  const auto held = std::min(into.size(), static_cast<std::size_t>(end_ - at_));
  if (held > 0) std::memcpy(into.data(), at_, held);
  at_ += held;
  if (held == into.size() || source_ == nullptr || position_ >= limit_) return held;
  const auto ask = std::min<std::uint64_t>(into.size() - held, limit_ - position_);
  const auto got = source_->read(into.subspan(held, static_cast<std::size_t>(ask)));
  position_ += got;
  return held + got;
}

bool FoamStream::skip(std::uint64_t count) {
  if (count > left()) return false;
  const auto held = static_cast<std::uint64_t>(end_ - at_);
  if (count <= held) {
    at_ += count;
    return true;
  }
  at_ = end_;
  position_ += count - held;
  source_->seek(position_);
  return source_->position() == position_;  // a gzip stream may end before its bound
}

bool FoamStream::ensure(std::size_t count) {
  while (static_cast<std::size_t>(end_ - at_) < count)
    if (!more()) return false;
  return true;
}

bool FoamStream::skip_blanks() {
  for (;;) {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    if (at_ == end_) {
      if (!more()) return false;
      continue;
    }
    if (*at_ != '/' || !ensure(2) || (at_[1] != '/' && at_[1] != '*')) return true;
    const auto start = offset();
    const bool to_line_end = at_[1] == '/';
    at_ += 2;
    for (;;) {
      const auto* stop = static_cast<const char*>(
          std::memchr(at_, to_line_end ? '\n' : '*', static_cast<std::size_t>(end_ - at_)));
      at_ = stop != nullptr ? stop + 1 : end_;
      if (stop != nullptr && (to_line_end || (ensure(1) && *at_ == '/'))) {
        at_ += !to_line_end;
        break;
      }
      if (at_ == end_ && !more()) {
        if (to_line_end) return false;
        fail_cut("comment of offset {} is not closed", start);
      }
    }
  }
}

void FoamStream::read_string(FoamToken& token) {
  token.kind = FoamToken::Kind::string;
  ++at_;
  for (; token.text.size() < longest_token; ++at_) {
    if (!ensure(1)) fail_cut("expected the closing quote, found end of file");
    if (*at_ == '"') {
      ++at_;
      return;
    }
    if (*at_ == '\\' && ensure(2) && at_[1] == '"') ++at_;
    token.text += *at_;
  }
  fail(token.offset, "a string of more than {} characters: is its quote closed?", longest_token);
}

void FoamStream::read_code(FoamToken& token) {
  at_ += 2;
  char before = '\0';
  for (; ensure(1); before = *at_, ++at_) {
    if (before == '#' && *at_ == '}') {
      ++at_;
      token.text = "#{";
      return;
    }
  }
  fail(token.offset, "expected \"#}}\" after \"#{{\", found end of file");
}

void FoamStream::read_word(FoamToken& token) {
  const bool number = token.kind == FoamToken::Kind::number;
  const bool braced = token.kind == FoamToken::Kind::variable && ensure(2) && at_[1] == '{';
  int depth = 0;
  for (; ensure(1) && token.text.size() < longest_token; ++at_) {
    const char c = *at_;
    if (is_blank(c) || c == '"') break;
    if (c == '/' && ensure(2) && (at_[1] == '/' || at_[1] == '*')) break;  // a comment
    if (braced && !token.text.empty()) {
      token.text += c;
      if (c == '}') {
        ++at_;
        return;
      }
      continue;
    }
    if (is_sign(c)) {
      if (number && c == ',') {  // 0,003 is one word, and no number
        token.text += c;
        continue;
      }
      if (number || (c != '(' && c != ')' && c != ',' && c != '[' && c != ']')) break;
      if (c == '(') ++depth;
      if (c == ')' && --depth < 0) break;
      if (depth == 0 && c != ')') break;  // a comma or bracket outside parentheses
    }
    token.text += c;
  }
  if (token.text.size() >= longest_token)
    fail(token.offset, "a word of more than {} characters", longest_token);
}

FoamToken FoamStream::next() {
  FoamToken token;
  if (!skip_blanks()) {
    token.offset = offset();
    return token;
  }
  token.offset = offset();
  const char c = *at_;
  if (is_sign(c)) {
    token.kind = FoamToken::Kind::sign;
    token.text = c;
    ++at_;
  } else if (c == '"') {
    read_string(token);
  } else if (c == '#' && ensure(2) && at_[1] == '{') {
    token.kind = FoamToken::Kind::directive;
    read_code(token);
  } else {
    token.kind = c == '$'           ? FoamToken::Kind::variable
                 : c == '#'         ? FoamToken::Kind::directive
                 : begins_number(c) ? FoamToken::Kind::number
                                    : FoamToken::Kind::word;
    read_word(token);
  }
  return token;
}

void FoamStream::expect(char sign, std::string_view after) {
  if (take(sign)) return;
  const auto here = offset();
  const auto what = found();
  if (at_ == end_) fail_cut("expected \"{}\" after {}, found {}", sign, after, what);
  fail(here, "expected \"{}\" after {}, found {}", sign, after, what);
}

bool FoamStream::take(char sign) {
  if (peek() != sign) return false;
  ++at_;
  return true;
}

void FoamStream::enter(std::uint64_t bytes) {
  limit_ = offset() + bytes;
  if (limit_ >= position_) return;
  // What was read beyond the block is kept and hidden.
  end_ = held_ - (position_ - limit_);
  const auto place = static_cast<std::size_t>(end_ - buffer_.data());
  hidden_ = std::exchange(buffer_[place], '\0');
}

void FoamStream::leave() {
  const auto stop = std::exchange(limit_, no_limit);
  if (end_ != held_) {
    buffer_[static_cast<std::size_t>(end_ - buffer_.data())] = hidden_;
    at_ = std::exchange(end_, held_);
  } else if (stop > position_) {
    source_->seek(stop);
    position_ = stop;
    at_ = end_;
  } else {
    at_ = end_;
  }
}

void FoamStream::fail_text(std::uint64_t offset, bool cut, const std::string& text) const {
  const auto line = source_ == nullptr ? 0 : line_at(path_, offset);
  const auto where = line == 0 ? path_ : fmt::format("{}: line {}", path_, line);
  // Whatever is wrong with the last characters of a file: more may have followed.
  const bool at_end = source_ != nullptr && at_ == end_ && (left() == 0 || !source_->cut().empty());
  if (source_ != nullptr && !source_->cut().empty())
    throw CutError("{}: {} ({})", where, text, source_->cut());
  if (cut || at_end) throw CutError("{}: {}", where, text);
  throw FormatError("{}: {}", where, text);
}

std::string FoamStream::found() {
  if (!skip_blanks()) return "end of file";
  ensure(24);
  std::string text;
  for (const char* p = at_; p != end_ && text.size() < 24 && !is_blank(*p); ++p)
    text += *p > ' ' && *p < 127 ? *p : '?';
  return fmt::format("\"{}\"", text);
}

}  // namespace bedscope::readers
