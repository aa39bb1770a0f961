// SPDX-License-Identifier: BSD-3-Clause
// A pull parser for the XML that VTK files are made of: no DTD, no entities of one's own, bounded
// depth, nothing copied. Internal to this room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "readers/error.hpp"

namespace bedscope::readers {

/// Walks over a text that must outlive it. All functions throw FormatError ("path: line 7: ...")
/// where the text is not well-formed, CutError where it ends too early.
class XmlReader {
 public:
  enum class Event { open, text, close, end };

  XmlReader(std::string_view text, std::string path);

  /// Goes to the next tag or text; comments, processing instructions and blank text are passed
  /// over. `<a/>` gives open and close. `end` comes once the outermost element is closed.
  Event next();

  /// Goes to the close of the element that was opened last, from its open or any time after.
  void skip_element();

  /// Goes on at `offset`, past bytes that are not XML.
  void jump(std::size_t offset) { next_ = offset; }

  std::string_view name() const { return name_; }      ///< of the element opened or closed last
  std::string_view text() const { return text_; }      ///< of the last text, without leading blanks
  std::size_t position() const { return at_; }         ///< offset of the last event
  std::size_t next_position() const { return next_; }  ///< offset of the first byte after it
  std::size_t depth() const { return open_.size(); }   ///< elements that are open

  /// Value of an attribute of the element opened last, without blanks around it; `&lt;` and the
  /// like are left as they are.
  std::optional<std::string_view> attribute(std::string_view name) const;

  /// A value with `&lt; &gt; &amp; &quot; &apos; &#65; &#x41;` replaced.
  std::string unescape(std::string_view value) const;

  std::string place(std::size_t offset) const;  ///< "path: line 7"

 private:
  struct Attribute {
    std::string_view name, value;
  };
  struct Element {
    std::string_view name, label;  ///< label: its Name attribute
    std::size_t at;
  };

  bool pass_markup(std::string_view begin, std::string_view end);
  void open_element();
  void close_element(std::string_view name);
  void read_attribute();
  void skip_blanks();
  [[noreturn]] void fail_at_end() const;
  template <class... T>
  [[noreturn]] void fail(std::size_t offset, fmt::format_string<T...> text, T&&... values) const {
    throw FormatError("{}: {}", place(offset), fmt::format(text, std::forward<T>(values)...));
  }

  std::string_view all_;
  std::string path_;
  std::size_t at_ = 0, next_ = 0;
  std::string_view name_, text_;
  std::vector<Attribute> attributes_;
  std::vector<Element> open_;
  bool close_next_ = false;  ///< the last tag was `<a/>`
};

/// The number (from 1) of the line that holds the byte at `offset`.
std::uint64_t line_of(std::string_view text, std::size_t offset);

/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);

}  // namespace bedscope::readers
