// SPDX-License-Identifier: BSD-3-Clause
#include "readers/xml_text.hpp"

#include <algorithm>
#include <charconv>

namespace bedscope::readers {
namespace {

// VTK's own files are 7 deep; a bound of our own keeps a hostile file from growing the stack.
constexpr std::size_t max_depth = 32;
constexpr std::size_t max_attributes = 64;
constexpr std::string_view blanks = " \t\r\n";

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

bool ends_name(char c) { return blank(c) || c == '/' || c == '>' || c == '=' || c == '<'; }

// A name for a message: what stands in a damaged file can be long.
std::string_view shown(std::string_view text) { return text.substr(0, 40); }

void append_utf8(std::string& to, std::uint32_t code) {
  const auto put = [&to](std::uint32_t byte) { to += static_cast<char>(byte); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0 | code >> 6);
    put(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    put(0xE0 | code >> 12);
    put(0x80 | (code >> 6 & 0x3F));
    put(0x80 | (code & 0x3F));
  } else {
    put(0xF0 | code >> 18);
    put(0x80 | (code >> 12 & 0x3F));
    put(0x80 | (code >> 6 & 0x3F));
    put(0x80 | (code & 0x3F));
  }
}

// "amp", "#65" or "#x41" to what it stands for; false where it is none of these.
bool append_reference(std::string& to, std::string_view name) {
  constexpr std::pair<std::string_view, char> known[] = {
      {"lt", '<'}, {"gt", '>'}, {"amp", '&'}, {"quot", '"'}, {"apos", '\''}};
  for (const auto& [text, value] : known) {
    if (name == text) {
      to += value;
      return true;
    }
  }
  if (!name.starts_with('#')) return false;
  name.remove_prefix(1);
  const bool hexadecimal = name.starts_with('x');
  if (hexadecimal) name.remove_prefix(1);
  std::uint32_t code = 0;
  const char* const end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, code, hexadecimal ? 16 : 10);
  if (error != std::errc{} || stop != end || code == 0 || code > 0x10FFFF) return false;
  append_utf8(to, code);
  return true;
}

}  // namespace

std::uint64_t line_of(std::string_view text, std::size_t offset) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size()));
  return 1 + static_cast<std::uint64_t>(std::count(text.begin(), end, '\n'));
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

XmlReader::XmlReader(std::string_view text, std::string path) : all_(text), path_(std::move(path)) {
  if (all_.starts_with("\xEF\xBB\xBF")) next_ = 3;  // byte order mark of UTF-8
}

std::string XmlReader::place(std::size_t offset) const {
  return fmt::format("{}: line {}", path_, line_of(all_, offset));
}

std::optional<std::string_view> XmlReader::attribute(std::string_view name) const {
  for (const Attribute& attribute : attributes_) {
    if (attribute.name == name) return trimmed(attribute.value);
  }
  return std::nullopt;
}

std::string XmlReader::unescape(std::string_view value) const {
  std::string plain;
  while (true) {
    const std::size_t ampersand = value.find('&');
    plain += value.substr(0, ampersand);
    if (ampersand == std::string_view::npos) return plain;
    value.remove_prefix(ampersand + 1);
    const std::size_t semicolon = value.find(';');
    const std::string_view name = value.substr(0, semicolon);
    if (semicolon == std::string_view::npos || !append_reference(plain, name)) {
      fail(at_, "entity '&{}' is not accepted", shown(name));
    }
    value.remove_prefix(semicolon + 1);
  }
}

XmlReader::Event XmlReader::next() {
  if (close_next_) {
    close_next_ = false;
    close_element(open_.back().name);
    return Event::close;
  }
  while (true) {
    const std::size_t first = all_.find_first_not_of(blanks, next_);
    if (first == std::string_view::npos) {
      if (!open_.empty() || name_.empty()) fail_at_end();
      next_ = all_.size();
      return Event::end;
    }
    at_ = first;
    if (open_.empty() && !name_.empty()) return Event::end;  // what follows is not ours to judge
    if (all_[first] != '<') {
      if (open_.empty()) fail(first, "expected '<', found '{}'", shown(all_.substr(first, 20)));
      next_ = std::min(all_.find('<', first), all_.size());
      text_ = all_.substr(first, next_ - first);
      return Event::text;
    }
    const std::string_view tag = all_.substr(first, 9);
    if (pass_markup("<!--", "-->") || pass_markup("<?", "?>")) continue;
    if (tag == "<!DOCTYPE") fail(first, "DOCTYPE is not accepted");
    if (tag.size() < 4 && all_.ends_with(tag)) fail_at_end();
    if (tag.starts_with("<!")) fail(first, "'{}' is not accepted", tag);
    if (tag.starts_with("</")) {
      next_ = first + 2;
      const std::size_t end = all_.find('>', next_);
      if (end == std::string_view::npos) fail_at_end();
      const std::string_view closed = trimmed(all_.substr(next_, end - next_));
      next_ = end + 1;
      close_element(closed);
      return Event::close;
    }
    open_element();
    return Event::open;
  }
}

void XmlReader::skip_element() {
  const std::size_t outside = open_.size() - 1;
  while (open_.size() > outside) next();
}

// Passes over a comment or a processing instruction, if one begins here.
bool XmlReader::pass_markup(std::string_view begin, std::string_view end) {
  if (all_.substr(at_, begin.size()) != begin) return false;
  const std::size_t stop = all_.find(end, at_ + begin.size());
  if (stop == std::string_view::npos) {
    throw CutError("{}: XML ends inside '{}'", place(at_), begin);
  }
  next_ = stop + end.size();
  return true;
}

void XmlReader::open_element() {
  if (open_.size() == max_depth) {
    fail(at_, "elements nested deeper than {} are not accepted", max_depth);
  }
  const auto* const begin = all_.begin() + static_cast<std::ptrdiff_t>(at_ + 1);
  const auto* const end = std::find_if(begin, all_.end(), ends_name);
  next_ = static_cast<std::size_t>(end - all_.begin());
  name_ = all_.substr(at_ + 1, next_ - at_ - 1);
  if (name_.empty()) fail(at_, "expected the name of an element after '<'");
  attributes_.clear();
  open_.push_back({name_, {}, at_});
  while (true) {
    skip_blanks();
    const char c = all_[next_];
    if (c == '>') break;
    if (c == '/') {
      if (next_ + 1 == all_.size()) fail_at_end();
      if (all_[next_ + 1] != '>') fail(next_, "expected '/>' at the end of <{}>", shown(name_));
      close_next_ = true;
      ++next_;
      break;
    }
    read_attribute();
  }
  ++next_;
  open_.back().label = attribute("Name").value_or("");
}

void XmlReader::read_attribute() {
  const std::size_t begin = next_;
  while (next_ < all_.size() && !ends_name(all_[next_])) ++next_;
  const std::string_view name = all_.substr(begin, next_ - begin);
  skip_blanks();
  if (name.empty() || all_[next_] != '=') {
    fail(begin, "expected an attribute of <{}>, found '{}'", shown(name_),
         shown(all_.substr(begin, 20)));
  }
  ++next_;
  skip_blanks();
  const char quote = all_[next_];
  if (quote != '"' && quote != '\'') {
    fail(next_, "attribute {}: expected a quotation mark, found '{}'", shown(name), quote);
  }
  const char stops[] = {quote, '<'};
  const std::size_t end = all_.find_first_of(std::string_view(stops, 2), next_ + 1);
  if (end == std::string_view::npos) fail_at_end();
  if (all_[end] == '<') fail(next_, "attribute {}: quotation mark not closed", shown(name));
  if (attribute(name)) fail(begin, "attribute {} twice in <{}>", shown(name), shown(name_));
  if (attributes_.size() == max_attributes) {
    fail(begin, "more than {} attributes in <{}> are not accepted", max_attributes, shown(name_));
  }
  attributes_.push_back({name, all_.substr(next_ + 1, end - next_ - 1)});
  next_ = end + 1;
}

void XmlReader::close_element(std::string_view name) {
  if (open_.empty() || open_.back().name != name) {
    fail(at_, "expected </{}>, found </{}>", open_.empty() ? "" : shown(open_.back().name),
         shown(name));
  }
  name_ = name;
  open_.pop_back();
}

// To the next byte that is not blank; inside of a tag there must be one.
void XmlReader::skip_blanks() {
  next_ = all_.find_first_not_of(blanks, next_);
  if (next_ == std::string_view::npos) fail_at_end();
}

void XmlReader::fail_at_end() const {
  const std::string end = place(all_.size());
  if (open_.empty()) throw CutError("{}: XML ends before its first element is whole", end);
  const Element& last = open_.back();
  throw CutError("{}: XML ends inside <{}{}> of line {}", end, shown(last.name),
                 last.label.empty() ? "" : fmt::format(" Name=\"{}\"", shown(last.label)),
                 line_of(all_, last.at));
}

}  // namespace bedscope::readers
