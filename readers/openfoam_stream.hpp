// SPDX-License-Identifier: BSD-3-Clause
// The characters and tokens of an OpenFOAM file, read forward in pieces; binary lists in between
// are taken by length. Inside a collated file the stream ends where the block of one rank ends.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "readers/error.hpp"
#include "readers/source.hpp"

namespace bedscope::readers {

/// A word, number, quoted string or sign of an OpenFOAM file.
struct FoamToken {
  enum class Kind {
    end,       ///< of the file or block
    sign,      ///< one of ( ) { } [ ] ; ,
    number,    ///< begins like a number: digits, sign or point
    word,      ///< anything else, balanced parentheses included: YH2O(l), List<vector>
    string,    ///< "...", without the quotes
    variable,  ///< $name, ${name}, with the $
    directive  ///< #include, #calc; "#{" for code between #{ and #}
  };
  Kind kind = Kind::end;
  std::string text;
  std::uint64_t offset = 0;

  bool is(char sign) const { return kind == Kind::sign && text[0] == sign; }
  bool at_end() const { return kind == Kind::end; }
};

class FoamStream {
 public:
  /// Opens a file, plain or gzip. Throws FileError.
  explicit FoamStream(const std::string& path);
  /// Reads `text`; errors are said to be of `path`. For entries that macros were put into.
  FoamStream(std::string_view text, const std::string& path);

  const std::string& path() const { return path_; }

  /// The characters at hand; *end() is NUL, so that a loop over digits or blanks needs no bound.
  const char* at() const { return at_; }
  const char* end() const { return end_; }
  void go_to(const char* place) { at_ = place; }
  /// Reads more behind end(); false at the end of the file or block. Moves what at() points to.
  bool more();
  std::uint64_t offset() const { return position_ - static_cast<std::uint64_t>(held_ - at_); }
  /// How many bytes can follow at most; exact for plain files.
  std::uint64_t left() const;
  bool compressed() const { return source_ != nullptr && source_->compressed(); }

  /// Bytes as they are; returns how many there were.
  std::size_t read(std::span<char> into);
  /// Steps over bytes; false if the file or block ends before.
  bool skip(std::uint64_t count);

  /// Steps over blanks and comments; false at the end.
  bool skip_blanks();
  /// The next character that is no blank or comment, not taken; NUL at the end.
  char peek() { return skip_blanks() ? *at_ : '\0'; }
  FoamToken next();
  /// The sign expected here, or an error: `after` says where we are ("boundaryField").
  void expect(char sign, std::string_view after);
  bool take(char sign);  ///< takes it where it is next

  /// From here on the stream ends `bytes` further (the block of one rank), until leave().
  void enter(std::uint64_t bytes);
  void leave();

  /// "path: line 7: " and the text, thrown as FormatError, or as CutError at the end of the file.
  template <class... T>
  [[noreturn]] void fail(std::uint64_t offset, fmt::format_string<T...> text, T&&... values) const {
    fail_text(offset, false, fmt::format(text, std::forward<T>(values)...));
  }
  template <class... T>
  [[noreturn]] void fail_cut(fmt::format_string<T...> text, T&&... values) const {
    fail_text(offset(), true, fmt::format(text, std::forward<T>(values)...));
  }
  /// The same for binary parts, which have no lines: "path: offset 812: ".
  template <class... T>
  [[noreturn]] void fail_binary(fmt::format_string<T...> text, T&&... values) const {
    throw FormatError("{}: offset {}: {}", path_, offset(),
                      fmt::format(text, std::forward<T>(values)...));
  }

  /// The next characters in a form fit for an error: quoted, short, "end of file".
  std::string found();

 private:
  static constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();
  static constexpr std::size_t piece =
      window_bytes(1U << 16);  // stays in the cache; more costs page faults

  [[noreturn]] void fail_text(std::uint64_t offset, bool cut, const std::string& text) const;
  void read_string(FoamToken& token);
  void read_code(FoamToken& token);
  void read_word(FoamToken& token);
  bool ensure(std::size_t count);

  std::string path_;
  std::unique_ptr<Source> source_;
  std::vector<char> buffer_;
  const char* at_ = nullptr;
  const char* end_ = nullptr;   // of what the caller may see: within the block
  const char* held_ = nullptr;  // of what was read
  char hidden_ = '\0';          // the character that end_'s NUL stands for
  std::uint64_t position_ = 0;  // offset of held_
  std::uint64_t limit_ = no_limit;
};

}  // namespace bedscope::readers
