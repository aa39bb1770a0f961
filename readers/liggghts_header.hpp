// SPDX-License-Identifier: BSD-3-Clause
// What stands before the rows of a snapshot in a LIGGGHTS text dump.
#pragma once

#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "readers/byte_window.hpp"
#include "readers/error.hpp"
#include "readers/numbers.hpp"
#include "readers/snapshot.hpp"
#include "readers/source.hpp"
#include "readers/tokens.hpp"

namespace bedscope::readers::liggghts_dump {

inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
inline constexpr std::string_view first_item = "ITEM: ";

/// The first letters of another header, where a killed run stopped within "ITEM: ".
inline bool is_cut_item(std::string_view line) {
  return !line.empty() && first_item.starts_with(line);
}

inline std::string quote(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text.substr(0, 40)) quoted += static_cast<unsigned char>(c) < ' ' ? '?' : c;
  return quoted + (text.size() > 40 ? "...\"" : "\"");
}

/// A dump of something else than atoms: one that is given by name is refused, one that lies in a
/// folder of dumps is left out.
class NotParticles : public FormatError {
 public:
  using FormatError::FormatError;
};

/// What stands before the rows of a snapshot.
struct Header {
  std::int64_t step = no_step;
  double time = unknown;
  std::string units;  // what "ITEM: UNITS" says, of the first snapshot of a file
  std::int64_t particles = -1;
  Box box;
  std::vector<std::string> columns;  // "column 1" ... where the header names none
  bool named = true;
  std::uint64_t offset = 0;  // of its first line
  std::uint64_t line = 0;    // the number of its first line, where next() was told
  std::uint64_t lines = 0;   // up to and with "ITEM: ATOMS"
};

/// The number of the first line of a header; reads the file where it is not known.
inline std::uint64_t first_line(const Header& header, const std::string& path) {
  return header.line != 0 ? header.line : line_at(path, header.offset);
}

/// Reads the header of a snapshot line by line. The numbers of lines are counted from the
/// snapshot's first line and turned into the file's only in errors.
class HeaderReader {
 public:
  HeaderReader(ByteWindow& window, const std::string& path) : window_(window), path_(path) {}

  /// The next header, or nothing at the end of the file (blank lines are passed over).
  /// `number_of_line`: of its first line, where known; errors then need not count.
  std::optional<Header> next(std::uint64_t number_of_line = 0) {
    header_ = {};
    header_.line = number_of_line;
    skip_blank_lines();
    if (!window_.ensure(1)) return std::nullopt;
    header_.offset = window_.offset();
    while (true) {
      const auto line = require_line("a section (\"ITEM: ...\")");
      std::string_view text = line;
      if (header_.lines == 1 && text.starts_with(byte_order_mark))
        text.remove_prefix(byte_order_mark.size());
      if (!text.starts_with(first_item)) {
        if (header_.lines == 1 && text.find('\0') != text.npos) fail("NUL byte");
        fail("expected \"ITEM: ...\", found {}", quote(text));
      }
      text.remove_prefix(first_item.size());
      if (text.starts_with("TIMESTEP")) {
        if (header_.step != no_step)  // killed here, and another run went on in the file
          fail("\"ITEM: TIMESTEP\" twice, of step {} without its particles", header_.step);
        header_.step = integer("the step");
      } else if (text.starts_with("TIME")) {
        header_.time = number("the time");
        if (!std::isfinite(header_.time)) fail("the time is not finite");
      } else if (text.starts_with("UNITS")) {
        header_.units = require_line("a text");
      } else if (text.starts_with("LABEL")) {
        require_line("a text");
      } else if (text.starts_with("NUMBER OF ATOMS")) {
        if (header_.particles >= 0) fail("\"ITEM: NUMBER OF ATOMS\" twice");
        header_.particles = integer("the number of atoms");
        if (header_.particles < 0) fail("count is negative: {}", header_.particles);
      } else if (text.starts_with("NUMBER OF ") && is_local(text.substr(10))) {
        throw NotParticles("{}: line {}: a dump local ({}): contacts, not particles", path_,
                           line_number(), text.substr(10));
      } else if (text.starts_with("BOX BOUNDS")) {
        read_box(text.substr(10));
      } else if (text.starts_with("GRID SIZE") || text.starts_with("DIMENSION")) {
        throw NotParticles("{}: line {}: a dump grid: values of cells, not particles", path_,
                           line_number());
      } else if (text.starts_with("ATOMS")) {
        finish(text.substr(5));
        return header_;
      } else {
        fail("unknown section {}", quote(line));
      }
    }
  }

  template <class... T>
  [[noreturn]] void fail(fmt::format_string<T...> text, T&&... values) const {
    throw FormatError("{}: line {}: {}", path_, line_number(),
                      fmt::format(text, std::forward<T>(values)...));
  }

 private:
  /// `dump local` calls its rows ENTRIES, or what `dump_modify label` says: then "ITEM: <label>"
  /// stands before them.
  bool is_local(std::string_view label) {
    if (label == "ENTRIES" || label == "CONTACTS") return true;
    const auto rows = fmt::format("\n{}{} ", first_item, label);
    while (window_.size() < (1U << 12) && window_.more()) {
    }
    const std::string_view rest(window_.begin(), window_.size());
    const auto found = rest.find(rows);
    return found != rest.npos && found < rest.find("\nITEM: ATOMS");
  }

  /// LAMMPS before 2010 names no columns: they are counted in the first row.
  void number_columns() {
    header_.named = false;
    if (header_.particles == 0) return;
    while (std::memchr(window_.begin(), '\n', window_.size()) == nullptr && window_.more()) {
    }
    std::string_view row(window_.begin(), window_.size());
    row = row.substr(0, row.find('\n'));
    while (!next_word(row).empty())
      header_.columns.push_back(fmt::format("column {}", header_.columns.size() + 1));
    if (header_.columns.empty()) fail("\"ITEM: ATOMS\" without column names and rows");
  }

  /// Of the line read last.
  std::uint64_t line_number() const { return first_line(header_, path_) + header_.lines - 1; }

  void skip_blank_lines() {
    while (window_.ensure(1) && (*window_.begin() == '\n' || *window_.begin() == '\r' ||
                                 *window_.begin() == ' ' || *window_.begin() == '\t'))
      window_.drop_until(window_.begin() + 1);
  }

  std::string require_line(const char* expected) {
    const auto line = window_.line();
    if (!line)
      throw CutError("{}: line {}: expected {}, found end of file", path_, line_number(), expected);
    ++header_.lines;
    if (!window_.closed())
      throw CutError("{}: line {}: no line end: file is cut", path_, line_number());
    return std::string(*line);
  }

  std::int64_t integer(const char* what) {
    const auto line = require_line(what);
    std::string_view rest = line;
    const auto word = next_word(rest);
    std::int64_t value = 0;
    bool overflow = false;
    if (!parse_integer(word, value, overflow)) {
      if (overflow) fail("{} does not fit in 64 bits: {}", what, quote(word));
      if (line.starts_with(first_item) || word.empty())
        fail("expected {}, found {}", what, quote(line));
      fail("expected an integer ({}), found {}", what, quote(word));
    }
    return value;
  }

  double number(const char* what) {
    const auto line = require_line(what);
    std::string_view rest = line;
    const auto word = next_word(rest);
    double value = 0;
    if (!parse_number(word.data(), word.data() + word.size(), value))
      fail("expected a number ({}), found {}", what, quote(line));
    return value;
  }

  void read_box(std::string_view flags) {
    auto& box = header_.box;
    if (box.known) fail("\"ITEM: BOX BOUNDS\" twice");
    box.known = true;
    std::vector<std::string_view> words;
    for (auto word = next_word(flags); !word.empty(); word = next_word(flags))
      words.push_back(word);
    const bool triclinic = !words.empty() && words[0] == "xy";
    if (triclinic && words.size() >= 3) words.erase(words.begin(), words.begin() + 3);
    if (!words.empty() && words[0] == "abc")
      fail("a general triclinic box (\"abc origin\") is not supported");
    const std::size_t count = triclinic ? 3 : 2;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto line = require_line("box bounds");
      std::array<double, 3> values{};
      std::string_view rest = line;
      for (std::size_t k = 0; k < count; ++k) {
        const auto word = next_word(rest);
        if (word.empty() || !parse_number(word.data(), word.data() + word.size(), values[k]))
          fail("expected {} box numbers, found {}", count, quote(line));
      }
      // A third number would be a tilt, whose names are not there.
      if (!next_word(rest).empty())
        fail("expected {} box numbers, found more: {}", count, quote(line));
      box.min[axis] = values[0];
      box.max[axis] = values[1];
      if (triclinic) box.tilt[axis] = values[2];
      if (axis < words.size()) {
        box.periodic[axis] = words[axis].starts_with('p');
        box.shrink_wrapped |= words[axis].find_first_of("sm") != std::string_view::npos;
      }
      if (!(box.max[axis] > box.min[axis]) || !std::isfinite(box.max[axis] - box.min[axis]))
        fail("box has no width in {}: {} {}", "xyz"[axis], values[0], values[1]);
    }
  }

  void finish(std::string_view names) {
    if (header_.step == no_step) fail("\"ITEM: ATOMS\" before \"ITEM: TIMESTEP\"");
    if (header_.particles < 0) fail("\"ITEM: ATOMS\" before \"ITEM: NUMBER OF ATOMS\"");
    for (auto name = next_word(names); !name.empty(); name = next_word(names))
      header_.columns.emplace_back(name);
    if (header_.columns.empty()) number_columns();
  }

  ByteWindow& window_;
  const std::string& path_;
  Header header_;
};

}  // namespace bedscope::readers::liggghts_dump
