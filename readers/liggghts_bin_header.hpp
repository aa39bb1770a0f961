// SPDX-License-Identifier: BSD-3-Clause
// What stands before the rows of a snapshot in a binary dump; readers/liggghts_bin.cpp has the
// layout. Internal to this room.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "readers/error.hpp"
#include "readers/snapshot.hpp"
#include "readers/source.hpp"
#include "readers/tokens.hpp"

namespace bedscope::readers::liggghts_binary {

inline constexpr std::int32_t most_columns = 1000;
inline constexpr std::size_t longest_text = 1 << 16;

struct Header {
  std::uint64_t offset = 0;  // of the first byte
  std::uint64_t count_at = 0;
  std::int64_t step = 0, particles = 0;
  double time = unknown;
  std::string units;  // as stored, or empty
  Box box;
  std::int32_t columns = 0, chunks = 0;
  std::vector<std::string> names;  // empty: not stored
};

/// Reads number after number; tells the place where the file ends.
class NumberReader {
 public:
  NumberReader(Source& source, const std::string& path) : source_(source), path_(path) {}

  template <class T>
  T next() {
    T value;
    read(reinterpret_cast<char*>(&value), sizeof(T));
    return value;
  }
  std::string text(std::int32_t length, const char* what) {
    if (length < 0 || static_cast<std::size_t>(length) > longest_text)
      fail(position() - 4, "{} of {} bytes", what, length);
    std::string text(static_cast<std::size_t>(length), '\0');
    read(text.data(), text.size());
    return text;
  }
  std::uint64_t position() const { return source_.position(); }

  template <class... T>
  [[noreturn]] void fail(std::uint64_t offset, fmt::format_string<T...> text, T&&... values) const {
    throw FormatError("{}: offset {}: {}", path_, offset,
                      fmt::format(text, std::forward<T>(values)...));
  }

 private:
  void read(char* into, std::size_t count) {
    if (source_.read({into, count}) < count)
      throw CutError("{}: offset {}: file ends inside the header{}{}", path_, position(),
                     source_.cut().empty() ? "" : ": ", source_.cut());
  }
  Source& source_;
  const std::string& path_;
};

/// What LAMMPS since 2020 puts first. Returns the revision.
inline std::int32_t read_magic(NumberReader& numbers, std::int64_t length) {
  const auto at = numbers.position() - 8;
  if (length > 64) numbers.fail(at, "a magic text of {} bytes", length);
  const auto magic = numbers.text(static_cast<std::int32_t>(length), "a magic text");
  if (!magic.starts_with("DUMP")) numbers.fail(at + 8, "expected the magic text DUMP...");
  const auto mark = numbers.next<std::int32_t>();
  if (mark != 1) numbers.fail(numbers.position() - 4, "written on a machine of other byte order");
  const auto revision = numbers.next<std::int32_t>();
  if (revision < 1 || revision > 2)
    numbers.fail(numbers.position() - 4, "revision {} of the binary dump is not known", revision);
  return revision;
}

inline void read_box(NumberReader& numbers, Header& header) {
  auto& box = header.box;
  const auto triclinic = numbers.next<std::int32_t>();
  if (triclinic == 2)
    numbers.fail(numbers.position() - 4, "a general triclinic box is not supported");
  if (triclinic != 0 && triclinic != 1)
    numbers.fail(numbers.position() - 4, "expected triclinic 0 or 1, found {}", triclinic);
  for (int k = 0; k < 6; ++k) {
    const auto boundary = numbers.next<std::int32_t>();
    if (boundary < 0 || boundary > 3)
      numbers.fail(numbers.position() - 4, "expected a boundary from 0 to 3, found {}", boundary);
    if (boundary == 0) box.periodic[static_cast<std::size_t>(k / 2)] = true;
    box.shrink_wrapped |= boundary >= 2;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = numbers.next<double>();
    box.max[axis] = numbers.next<double>();
    if (!(box.max[axis] > box.min[axis]) || !std::isfinite(box.max[axis] - box.min[axis]))
      numbers.fail(numbers.position() - 16, "box has no width in {}: {} {}", "xyz"[axis],
                   box.min[axis], box.max[axis]);
  }
  for (std::size_t k = 0; triclinic == 1 && k < 3; ++k) {
    box.tilt[k] = numbers.next<double>();
    if (!std::isfinite(box.tilt[k]))
      numbers.fail(numbers.position() - 8, "a tilt of the box is not finite");
  }
  box.known = true;
}

inline void read_names(NumberReader& numbers, Header& header) {
  header.units = numbers.text(numbers.next<std::int32_t>(), "a name of units");
  if (numbers.next<char>() != 0) header.time = numbers.next<double>();
  const auto at = numbers.position();
  const auto text = numbers.text(numbers.next<std::int32_t>(), "names of columns");
  std::string_view rest = text;
  for (auto name = next_word(rest); !name.empty(); name = next_word(rest))
    header.names.emplace_back(name);
  if (header.names.size() != static_cast<std::size_t>(header.columns))
    numbers.fail(at, "{} columns, but {} names", header.columns, header.names.size());
}

/// The header at the source's position; nothing at the end of the file.
inline std::optional<Header> next_header(Source& source, const std::string& path) {
  Header header;
  header.offset = source.position();
  char probe = 0;
  if (source.read({&probe, 1}) == 0) return std::nullopt;
  source.seek(header.offset);
  NumberReader numbers(source, path);
  header.step = numbers.next<std::int64_t>();
  std::int32_t revision = 0;
  if (header.step < 0) {
    revision = read_magic(numbers, header.step == INT64_MIN ? INT64_MAX : -header.step);
    header.step = numbers.next<std::int64_t>();
    if (header.step < 0) numbers.fail(numbers.position() - 8, "negative step");
  }
  header.count_at = numbers.position();
  header.particles = numbers.next<std::int64_t>();
  if (header.particles < 0) numbers.fail(header.count_at, "negative count: {}", header.particles);
  read_box(numbers, header);
  const auto at = numbers.position();
  header.columns = numbers.next<std::int32_t>();
  if (header.columns < 1 || header.columns > most_columns)
    numbers.fail(at, "{} columns", header.columns);
  if (revision > 1) read_names(numbers, header);
  header.chunks = numbers.next<std::int32_t>();
  if (header.chunks < 0) numbers.fail(numbers.position() - 4, "{} chunks", header.chunks);
  return header;
}

}  // namespace bedscope::readers::liggghts_binary
