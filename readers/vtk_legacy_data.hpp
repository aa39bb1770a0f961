// SPDX-License-Identifier: BSD-3-Clause
// Lines, counts and arrays of numbers of a legacy VTK file, ASCII or big-endian binary, read from
// front to back. Internal to this room.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "readers/byte_window.hpp"
#include "readers/error.hpp"
#include "readers/numbers.hpp"
#include "readers/source.hpp"
#include "readers/tokens.hpp"
#include "readers/vtk_legacy_types.hpp"

namespace bedscope::readers::vtk_legacy_file {

class LegacyData {
 public:
  std::uint64_t bytes_from_disk() const { return source_.bytes_from_disk(); }
  const std::string& trailing() const { return source_.trailing(); }

 protected:
  static constexpr std::size_t header_bytes = 4096;  // more than the lines before an array take

  LegacyData(const std::string& path, std::vector<char>& buffer, std::size_t piece)
      : path_(path), source_(path), window_(source_, buffer, piece) {}

  /// A line without its end, the last of the file, may be cut: so is then the file.
  template <class... T>
  [[noreturn]] void fail(fmt::format_string<T...> text, T&&... values) {
    if (!window_.closed())
      throw CutError("{}: {}: {}", path_, here(), fmt::format(text, std::forward<T>(values)...));
    throw FormatError("{}: {}: {}", path_, here(), fmt::format(text, std::forward<T>(values)...));
  }

  template <class... T>
  [[noreturn]] void fail_cut(fmt::format_string<T...> text, T&&... values) {
    const auto end = binary_ ? fmt::format("offset {}", source_.likely_size()) : here();
    throw CutError("{}: {}: {}", path_, end, fmt::format(text, std::forward<T>(values)...));
  }

  /// A line number means nothing behind binary data.
  std::string here() const {
    if (binary_ && seen_data_) return fmt::format("offset {}", window_.offset());
    return fmt::format("line {}", line_at(path_, line_start_));
  }

  std::optional<std::string_view> next_line() {
    line_start_ = window_.offset();
    if (binary_ && window_.size() == 0) window_.more(header_bytes);
    return window_.line();
  }

  std::string_view need_line(const char* expected) {
    const auto line = next_line();
    if (!line) fail_cut("expected {}, found end of file", expected);
    return *line;
  }

  /// The next line that is not blank.
  std::optional<std::string_view> keyword_line() {
    while (auto line = next_line()) {
      if (!line->empty() && line->find_first_not_of('\0') == line->npos)
        fail_cut("NUL bytes behind the data (file system lost the tail?)");
      if (line->find_first_not_of(" \t") != line->npos) return line;
    }
    return std::nullopt;
  }

  static std::string printable(std::string_view text) {
    std::string shown;
    for (const char c : text.substr(0, 30))
      shown += static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) > '~' ? '?' : c;
    return shown;
  }

  void metadata() {
    while (auto line = next_line())
      if (line->find_first_not_of(" \t") == line->npos) return;
  }

  std::int64_t count(std::string_view word, const char* what) {
    std::int64_t value = 0;
    bool overflow = false;
    if (!parse_integer(word, value, overflow))
      fail("{}: expected a count, found \"{}\"", *what == '\0' ? "an array" : what,
           printable(word));
    if (value < 0) fail("{}: negative count {}", what, value);
    return value;
  }

  const Type& find_type(std::string_view name) {
    const auto lower = lower_case(name);
    for (const auto& type : types)
      if (type.name == lower) return type;
    fail("unknown data type \"{}\"", printable(name));
  }

  /// Counts are claims: no more values than the rest of the file can hold.
  void check_room(std::int64_t tuples, std::int64_t components, int size, const std::string& what) {
    const std::uint64_t bound = source_.size_bound();
    const std::uint64_t bytes_each =
        binary_ || size == 1 ? static_cast<std::uint64_t>(size) : 2;  // a digit and a blank
    const auto most = bound / bytes_each + 1;
    if (components > 0 &&
        static_cast<std::uint64_t>(tuples) > most / static_cast<std::uint64_t>(components))
      fail("{}: {} x {} values declared, more than the file can hold", what, tuples, components);
  }

  void skip_strings(const std::string& name, std::int64_t strings) {
    for (std::int64_t i = 0; i < strings; ++i) {
      if (!binary_) {
        if (!next_line()) fail_cut("array {}: end of file inside it", name);
        continue;
      }
      // VTK's binary strings: the length in 1, 2, 4 or 8 bytes, told by the first two bits.
      if (!window_.ensure(1)) fail_cut("array {}: end of file inside it", name);
      const int form = static_cast<unsigned char>(*window_.begin()) >> 6;
      const std::size_t bytes = form == 3 ? 1 : form == 2 ? 2 : form == 1 ? 4 : 8;
      if (!window_.ensure(bytes)) fail_cut("array {}: end of file inside it", name);
      std::uint64_t length = static_cast<unsigned char>(*window_.begin()) & 0x3f;
      for (std::size_t k = 1; k < bytes; ++k)
        length = length << 8 | static_cast<unsigned char>(window_.begin()[k]);
      window_.drop_until(window_.begin() + bytes);
      skip_bytes(length, name);
    }
  }

  void skip_data(const Type& type, std::int64_t tuples, std::int64_t components,
                 const std::string& what) {
    seen_data_ = true;
    if (binary_)
      return skip_bytes(static_cast<std::uint64_t>(tuples) * components * type.size, what);
    std::int64_t left = tuples * components;
    while (left > 0) {
      const char* at = window_.begin();
      const char* const end = behind_last_blank();
      left -= skip_words(at, end, left);
      window_.drop_until(at);
      if (left > 0 && !next_words(what, tuples * components - left, tuples, components)) break;
    }
  }

  /// Up to where words are whole: at the end of the file everything is.
  const char* behind_last_blank() const {
    const char* end = window_.end();
    if (at_end_) return end;
    while (end > window_.begin() && !is_blank(end[-1])) --end;
    return end;
  }

  /// Brings more words into the window after all whole ones were used.
  bool next_words(const std::string& what, std::int64_t seen, std::int64_t tuples,
                  std::int64_t components) {
    if (window_.more()) return true;
    if (!at_end_) {
      at_end_ = true;
      return true;
    }
    line_start_ = window_.offset();
    if (what == "POINTS")
      fail_cut("POINTS {} declared, {} present (end of file)", tuples, seen / 3);
    fail_cut("end of file inside {}: {} values declared, {} present", what, tuples * components,
             seen);
  }

  void skip_bytes(std::uint64_t bytes, const std::string& what) {
    seen_data_ = true;
    if (bytes <= window_.size()) {
      window_.drop_until(window_.begin() + bytes);
      return;
    }
    const auto target = window_.offset() + bytes;
    if (target > source_.size_bound()) fail_cut("end of file inside {}", what);
    source_.seek(target);
    window_.restart();
    if (source_.position() < target) fail_cut("end of file inside {}", what);
  }

  void values(const Type& type, std::int64_t tuples, std::span<double* const> into,
              const std::string& what) {
    seen_data_ = true;
    if (binary_)
      binary_values(type, tuples, into, what);
    else
      text_values(type, tuples, into, what);
  }

  void binary_values(const Type& type, std::int64_t tuples, std::span<double* const> into,
                     const std::string& what) {
    const std::size_t tuple_bytes = into.size() * static_cast<std::size_t>(type.size);
    std::size_t done = 0;
    const auto all = static_cast<std::size_t>(tuples);
    while (done < all) {
      const std::size_t here = std::min(window_.size() / tuple_bytes, all - done);
      if (here == 0) {
        // Not beyond the array and the header behind it: the next array may not be wanted.
        if (!window_.more((all - done) * tuple_bytes - window_.size() + header_bytes))
          fail_cut("end of file inside {}: {} tuples declared, {} present", what, all, done);
        continue;
      }
      for (std::size_t k = 0; k < into.size(); ++k)
        if (into[k] != nullptr) decode(type, window_.begin(), here, into.size(), k, into[k] + done);
      window_.drop_until(window_.begin() + here * tuple_bytes);
      done += here;
    }
  }

  void text_values(const Type& type, std::int64_t tuples, std::span<double* const> into,
                   const std::string& what) {
    const auto components = static_cast<std::int64_t>(into.size());
    const std::int64_t all = tuples * components;
    const bool single = type.kind == Kind::real && type.size == 4;
    std::int64_t done = 0;
    while (done < all) {
      const char* at = window_.begin();
      const char* const end = behind_last_blank();
      std::size_t tuple = static_cast<std::size_t>(done / components);
      std::size_t component = static_cast<std::size_t>(done % components);
      const char* bad = nullptr;
      const std::int64_t left = all - done;
      std::int64_t taken = 0;
      for_each_word(at, end, [&](std::int64_t index, const char* from, const char* to) {
        if (index == left) return false;
        if (double* const target = into[component]; target != nullptr) {
          double value = 0;
          if (!parse_number(from, to, value)) {
            bad = from;
            return false;
          }
          target[tuple] = single ? static_cast<double>(static_cast<float>(value)) : value;
        }
        if (++component == into.size()) {
          component = 0;
          ++tuple;
        }
        taken = index + 1;
        at = to;
        return true;
      });
      done += taken;
      if (bad != nullptr) {
        line_start_ = window_.offset(bad);
        const char* stop = bad;
        while (stop < window_.end() && !is_blank(*stop)) ++stop;
        fail("{}: {} x {} numbers declared; number expected, found \"{}\"", what, tuples,
             components, printable({bad, static_cast<std::size_t>(stop - bad)}));
      }
      window_.drop_until(at);
      if (done < all && !next_words(what, done, tuples, components)) break;
    }
  }

  const std::string& path_;
  Source source_;
  ByteWindow window_;
  std::uint64_t line_start_ = 0;
  bool binary_ = false, seen_data_ = false, at_end_ = false;
};

}  // namespace bedscope::readers::vtk_legacy_file
