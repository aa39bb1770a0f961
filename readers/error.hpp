// SPDX-License-Identifier: BSD-3-Clause
// The three kinds of error that a user can meet, told apart by whose turn it is to act.
// Texts: lower case, no full stop, where: what was expected, what was found.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace bedscope {

/// Bytes of the UTF-8 character that begins at `at`; 0 where none does.
inline std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto first = static_cast<unsigned char>(text[at]);
  if (first < 0x80) return 1;
  const std::size_t length = first < 0xc2   ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
  if (length == 0 || at + length > text.size()) return 0;
  unsigned code = first & (0xffU >> (length + 1));
  for (std::size_t k = 1; k < length; ++k) {
    const auto next = static_cast<unsigned char>(text[at + k]);
    if ((next & 0xc0U) != 0x80) return 0;
    code = code << 6 | (next & 0x3fU);
  }
  const unsigned least = length == 2 ? 0x80 : length == 3 ? 0x800 : 0x10000;
  return code < least || code > 0x10ffff || (code >= 0xd800 && code < 0xe000) ? 0 : length;
}

/// A text for the user as one line, whatever was quoted in it from a damaged file or an odd name:
/// control characters and bytes that are no UTF-8 as \n or \x1b, the middle of very long ones left
/// out.
inline std::string one_line(std::string_view text) {
  constexpr std::size_t half = 900;
  bool whole = text.size() <= 2 * half;
  std::string line;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!whole && i >= half) {
      whole = true;
      line += " ... ";
      i = text.size() - half;
    }
    const char c = text[i];
    const auto length = utf8_length(text, i);
    if (length > 1) {
      line += text.substr(i, length);
      i += length - 1;
    } else if (length == 1 && c >= ' ' && c != '\x7f') {
      line += c;
    } else {
      line += c == '\n' ? "\\n" : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    }
  }
  return line;
}

/// Base of all errors that end in exit code 2 and one line on stderr.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& text) : std::runtime_error(one_line(text)) {}
};

/// The disk: missing file, no permission, no space.
class FileError : public Error {
 public:
  template <class... T>
  explicit FileError(fmt::format_string<T...> text, T&&... values)
      : Error(fmt::format(text, std::forward<T>(values)...)) {}
};

/// The content of a file. The text begins with path and place: "dump.1000: line 7: ...".
class FormatError : public Error {
 public:
  template <class... T>
  explicit FormatError(fmt::format_string<T...> text, T&&... values)
      : Error(fmt::format(text, std::forward<T>(values)...)) {}
};

/// A file that ends too early, as a killed run leaves it: normal for the last dump of a series.
class CutError : public FormatError {
 public:
  using FormatError::FormatError;
};

/// What the user asked for: study file, options, a column that no dump has.
class InputError : public Error {
 public:
  template <class... T>
  explicit InputError(fmt::format_string<T...> text, T&&... values)
      : Error(fmt::format(text, std::forward<T>(values)...)) {}
};

}  // namespace bedscope
