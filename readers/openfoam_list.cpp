// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_list.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "readers/openfoam_numbers.hpp"

namespace bedscope::readers {
namespace {

constexpr std::size_t piece_bytes = 1U << 18;  // read, converted and checked while in the cache

/// The opening of a list: how many values, and what follows.
struct Opening {
  enum class Form { empty, parenthesis, uniform, uncounted } form = Form::empty;
  std::uint64_t count = 0;
};

std::uint64_t claimed_count(FoamStream& stream, const FoamToken& token) {
  std::int64_t count = 0;
  bool overflow = false;
  if (!parse_integer(token.text, count, overflow)) {
    if (token.at_end()) stream.fail_cut("expected the length of a list, found end of file");
    stream.fail(token.offset, "expected the length of a list, found \"{}\"", token.text);
  }
  if (count < 0) stream.fail(token.offset, "negative list length {}", count);
  return static_cast<std::uint64_t>(count);
}

Opening read_opening(FoamStream& stream, const FoamLayout& layout) {
  if (!layout.binary && stream.take('(')) return {Opening::Form::uncounted, 0};
  const auto count = claimed_count(stream, stream.next());
  if (count == 0) {
    if (stream.take('(')) stream.expect(')', "an empty list");
    return {Opening::Form::empty, 0};
  }
  if (stream.take('{')) return {Opening::Form::uniform, count};
  stream.expect('(', fmt::format("list length {}", count));
  return {Opening::Form::parenthesis, count};
}

// `bytes` is the least that one value takes.
void check_claim(FoamStream& stream, std::uint64_t count, std::uint64_t bytes,
                 std::string_view type, bool binary) {
  if (count <= stream.left() / bytes) return;
  if (binary)
    stream.fail_cut("{} bytes of List<{}> declared ({} values), the file ends after {}",
                    count > std::numeric_limits<std::uint64_t>::max() / bytes
                        ? std::numeric_limits<std::uint64_t>::max()
                        : count * bytes,
                    type, count, stream.left());
  stream.fail_cut("{} values of List<{}> declared, the file ends after {} bytes more", count, type,
                  stream.left());
}

// Room for `more` further numbers of `total`: at once where the file can surely hold them, else
// as they come (a gzip file claims what it likes).
template <class T>
void make_room(std::vector<T>& out, const FoamStream& stream, std::uint64_t total) {
  if (!stream.compressed()) out.reserve(static_cast<std::size_t>(total));
}

template <class T>
T swapped(T value) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  std::reverse(bytes.begin(), bytes.end());
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

std::size_t count_non_finite(const double* values, std::size_t count) {
  constexpr std::uint64_t exponent = 0x7ff0000000000000;
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i)
    found += (std::bit_cast<std::uint64_t>(values[i]) & exponent) == exponent;
  return found;
}

// Adds what out[from...] holds to the count, in values of `components` numbers.
void note_non_finite(const std::vector<double>& out, std::size_t from, unsigned components,
                     NonFinite& seen) {
  if (count_non_finite(out.data() + from, out.size() - from) == 0) return;
  for (std::size_t value = from / components; value < out.size() / components; ++value) {
    if (count_non_finite(out.data() + value * components, components) == 0) continue;
    if (seen.values++ == 0) seen.first = value;
  }
}

// `count` numbers of the type File on disk, in pieces of whole values.
template <class File, class T, class Done>
void read_binary(FoamStream& stream, const FoamLayout& layout, std::uint64_t count,
                 std::size_t components, std::vector<T>& out, Done&& done) {
  std::vector<File> piece;
  const std::size_t step = piece_bytes / sizeof(File) / components * components;
  const bool swap = layout.big_endian != (std::endian::native == std::endian::big);
  while (count > 0) {
    const auto now = static_cast<std::size_t>(std::min<std::uint64_t>(count, step));
    const auto from = out.size();
    out.resize(from + now);
    std::size_t got = 0;
    if constexpr (std::is_same_v<File, T>) {
      got = stream.read({reinterpret_cast<char*>(out.data() + from), now * sizeof(T)});
      if (swap) std::transform(out.begin() + from, out.end(), out.begin() + from, swapped<T>);
    } else {
      piece.resize(now);
      got = stream.read({reinterpret_cast<char*>(piece.data()), now * sizeof(File)});
      for (std::size_t i = 0; i < now; ++i) {
        const File value = swap ? swapped(piece[i]) : piece[i];
        out[from + i] = static_cast<T>(value);
        if constexpr (std::is_integral_v<T>)
          if (out[from + i] != value) stream.fail_binary("label {} does not fit in 32 bits", value);
      }
    }
    if (got < now * sizeof(File))
      stream.fail_cut("the file ends inside a binary list, {} numbers before its end",
                      count - got / sizeof(File));
    done(from);
    count -= now;
  }
}

void close_binary(FoamStream& stream, const FoamLayout& layout, std::uint64_t bytes) {
  if (stream.at() == stream.end() && !stream.more())
    stream.fail_cut("expected \")\" after {} bytes, found end of file", bytes);
  if (*stream.at() != ')')
    stream.fail_binary("expected \")\" after {} bytes of a binary list ({})", bytes, layout.arch);
  stream.go_to(stream.at() + 1);
}

// One value at `p`; false where it is none or not all of it is there.
bool parse_value(const char*& p, const char* end, const FoamType& type, double* into) {
  p = skip_space(p, end);
  if (type.bracketed && *p++ != '(') return false;
  for (unsigned c = 0; c < type.components; ++c) {
    p = skip_space(p, end);
    if (!number_here(p, end, into[c])) return false;
  }
  if (!type.bracketed) return ends_number(*p) && p != end;
  p = skip_space(p, end);
  return p != end && *p++ == ')';
}

// A value in the slow way: after a comment, over the edge of the window, or a mistake to name.
void parse_value_slowly(FoamStream& stream, const FoamType& type, double* into, std::uint64_t index,
                        std::uint64_t declared) {
  const auto expect_more = [&] {
    if (!stream.skip_blanks())
      stream.fail_cut("{} values of List<{}> declared, end of file after {}", declared, type.name,
                      index);
  };
  expect_more();
  if (type.bracketed && !stream.take('('))
    stream.fail(stream.offset(), "value {} of {}: expected \"(\" of a {}, found {}", index,
                declared, type.name, stream.found());
  for (unsigned c = 0; c < type.components; ++c) {
    expect_more();
    const auto token = stream.next();
    if (!parse_number(token.text.data(), token.text.data() + token.text.size(), into[c]))
      stream.fail(token.offset, "value {} of {}: not a number at offset {}: \"{}\"", index,
                  declared, token.offset, printable(token.text));
  }
  if (type.bracketed) stream.expect(')', "a value");
}

// Values up to `count`, or up to the closing parenthesis where the list has no count.
void read_ascii(FoamStream& stream, const FoamType& type, Opening opening, std::vector<double>& out,
                NonFinite& seen) {
  constexpr std::size_t step = 4096;  // values in one go: at most 300 kB of numbers
  const bool counted = opening.form == Opening::Form::parenthesis;
  const auto total = counted ? opening.count : std::numeric_limits<std::uint64_t>::max();
  for (std::uint64_t done = 0; done < total;) {
    if (!counted && stream.peek() == ')') break;
    const auto now = counted ? std::min<std::uint64_t>(step, total - done) : 1;
    const auto from = out.size();
    out.resize(from + static_cast<std::size_t>(now) * type.components);
    double* into = out.data() + from;
    for (std::uint64_t k = 0; k < now; ++k, into += type.components) {
      const char* p = stream.at();
      if (parse_value(p, stream.end(), type, into)) {
        stream.go_to(p);
      } else if (static_cast<std::size_t>(stream.end() - stream.at()) < longest_row &&
                 stream.more()) {
        --k, into -= type.components;  // again, with the rest of the row
      } else {
        parse_value_slowly(stream, type, into, done + k, counted ? total : done + k + 1);
      }
    }
    note_non_finite(out, from, type.components, seen);
    done += now;
  }
  if (!stream.take(')')) {
    if (stream.peek() == '\0' && stream.at() == stream.end())
      stream.fail_cut("{} values declared, end of file before \")\"", total);
    stream.fail(stream.offset(), "expected \")\" after {} values, found {}", total, stream.found());
  }
}

void read_uniform(FoamStream& stream, const FoamType& type, Opening opening,
                  std::optional<FoamCount> expected, std::vector<double>& out, NonFinite& seen) {
  std::array<double, 9> value{};
  parse_value_slowly(stream, type, value.data(), 0, 1);
  stream.expect('}', "the value of a uniform list");
  if (!expected)
    stream.fail(stream.offset(), "a uniform list of {} values where their number is not known",
                opening.count);
  out.resize(static_cast<std::size_t>(opening.count) * type.components);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = value[i % type.components];
  note_non_finite(out, 0, type.components, seen);
}

std::int32_t read_label(FoamStream& stream, std::string_view of) {
  const auto token = stream.next();
  if (token.at_end()) stream.fail_cut("expected a label of {}, found end of file", of);
  std::int64_t value = 0;
  bool overflow = false;
  if (!parse_integer(token.text, value, overflow) || value != static_cast<std::int32_t>(value))
    stream.fail(token.offset, "expected a label of {}, found \"{}\"", of, printable(token.text));
  return static_cast<std::int32_t>(value);
}

// Labels of an ascii list up to its closing parenthesis.
void read_ascii_labels(FoamStream& stream, std::uint64_t count, std::vector<std::int32_t>& out) {
  for (std::uint64_t k = 0; k < count;) {
    const char* p = skip_space(stream.at(), stream.end());
    std::int32_t value = 0;
    if (label_here(p, value) && p != stream.end() && ends_number(*p)) {
      stream.go_to(p);
    } else if (static_cast<std::size_t>(stream.end() - stream.at()) < longest_row &&
               stream.more()) {
      continue;
    } else {
      value = read_label(stream, "a list");
    }
    out.push_back(value);
    ++k;
  }
  stream.expect(')', "the last label");
}

// Passes over numbers in an open bracket, up to the one that closes it.
void skip_text(FoamStream& stream) {
  for (int depth = 1; depth > 0;) {
    if (stream.at() == stream.end() && !stream.more())
      stream.fail_cut("expected \")\" of a list, found end of file");
    const char* p = stream.at();
    for (; p != stream.end() && depth > 0; ++p) {
      depth += *p == '(' || *p == '{';
      depth -= *p == ')' || *p == '}';
    }
    stream.go_to(p);
  }
}

void check_expected(FoamStream& stream, std::uint64_t count, std::optional<FoamCount> expected) {
  if (expected && count != expected->count)
    stream.fail(stream.offset(), "list declares {} values, {} has {} {}", count, expected->whole,
                expected->count, expected->parts);
}

}  // namespace

const FoamType* foam_type(std::string_view name) {
  const auto found = std::find_if(foam_types.begin(), foam_types.end(),
                                  [&](const FoamType& type) { return type.name == name; });
  return found == foam_types.end() ? nullptr : &*found;
}

FoamLayout layout_of(const FoamHeader& header, const std::string& where) {
  FoamLayout layout;
  layout.binary = header.binary;
  layout.arch = header.arch.empty() ? "no arch: LSB;label=32;scalar=64 assumed"
                                    : fmt::format("arch says {}", header.arch);
  layout.big_endian = header.arch.find("MSB") != std::string::npos;
  const auto size = [&](std::string_view key, unsigned usual) {
    const auto at = header.arch.find(key);
    if (at == std::string::npos) return usual;
    const auto bits = std::string_view(header.arch).substr(at + key.size(), 2);
    if (bits != "32" && bits != "64")
      throw FormatError("{}: expected sizes of 32 or 64 bits in arch, found {}", where,
                        header.arch);
    return bits == "32" ? 4U : 8U;
  };
  layout.label_bytes = size("label=", layout.label_bytes);
  layout.scalar_bytes = size("scalar=", layout.scalar_bytes);
  return layout;
}

NonFinite read_values(FoamStream& stream, const FoamLayout& layout, const FoamType& type,
                      std::optional<FoamCount> expected, std::vector<double>& out) {
  out.clear();
  NonFinite seen;
  const auto opening = read_opening(stream, layout);
  if (opening.form != Opening::Form::uncounted) check_expected(stream, opening.count, expected);
  switch (opening.form) {
    case Opening::Form::empty:
      break;
    case Opening::Form::uniform:
      read_uniform(stream, type, opening, expected, out, seen);
      break;
    case Opening::Form::uncounted:
      read_ascii(stream, type, opening, out, seen);
      break;
    case Opening::Form::parenthesis: {
      const std::uint64_t least = type.components * (layout.binary ? layout.scalar_bytes : 2);
      check_claim(stream, opening.count, least, type.name, layout.binary);
      make_room(out, stream, opening.count * type.components);
      if (!layout.binary) {
        read_ascii(stream, type, opening, out, seen);
        break;
      }
      const auto count = opening.count * type.components;
      const auto check = [&](std::size_t from) {
        note_non_finite(out, from, type.components, seen);
      };
      if (layout.scalar_bytes == 8)
        read_binary<double>(stream, layout, count, type.components, out, check);
      else
        read_binary<float>(stream, layout, count, type.components, out, check);
      close_binary(stream, layout, count * layout.scalar_bytes);
    }
  }
  if (expected && out.size() / type.components != expected->count)
    stream.fail(stream.offset(), "list holds {} values, {} has {} {}", out.size() / type.components,
                expected->whole, expected->count, expected->parts);
  return seen;
}

void read_labels(FoamStream& stream, const FoamLayout& layout, std::vector<std::int32_t>& out,
                 std::optional<FoamCount> expected) {
  out.clear();
  const auto opening = read_opening(stream, layout);
  if (opening.form == Opening::Form::uncounted)
    stream.fail(stream.offset(), "expected a list of labels with its length, found \"(\"");
  check_expected(stream, opening.count, expected);
  if (opening.form == Opening::Form::uniform) {
    if (!expected)
      stream.fail(stream.offset(), "a uniform list of {} labels where their number is not known",
                  opening.count);
    out.assign(static_cast<std::size_t>(opening.count), read_label(stream, "a uniform list"));
    stream.expect('}', "the label of a uniform list");
    return;
  }
  if (opening.form == Opening::Form::empty) return;
  check_claim(stream, opening.count, layout.binary ? layout.label_bytes : 2, "label",
              layout.binary);
  make_room(out, stream, opening.count);
  if (!layout.binary) return read_ascii_labels(stream, opening.count, out);
  const auto done = [](std::size_t) {};
  if (layout.label_bytes == 4)
    read_binary<std::int32_t>(stream, layout, opening.count, 1, out, done);
  else
    read_binary<std::int64_t>(stream, layout, opening.count, 1, out, done);
  close_binary(stream, layout, opening.count * layout.label_bytes);
}

void read_faces(FoamStream& stream, const FoamLayout& layout, bool compact,
                std::vector<std::int32_t>& starts, std::vector<std::int32_t>& points) {
  if (compact) {
    read_labels(stream, layout, starts);
    read_labels(stream, layout, points);
    if (starts.empty() && points.empty()) starts.push_back(0);
    if (starts.empty() || starts.front() != 0 || !std::is_sorted(starts.begin(), starts.end()) ||
        static_cast<std::size_t>(starts.back()) != points.size())
      stream.fail(stream.offset(), "expected ascending offsets of faces that end at {}",
                  points.size());
    return;
  }
  starts.assign(1, 0);
  points.clear();
  FoamLayout ascii = layout;
  ascii.binary = false;  // the outer list is text in both
  const auto opening = read_opening(stream, ascii);
  if (opening.form == Opening::Form::empty) return;
  if (opening.form != Opening::Form::parenthesis)
    stream.fail(stream.offset(), "expected a list of faces with its length, found another form");
  check_claim(stream, opening.count, layout.binary ? 4 : 6, "face", false);
  make_room(starts, stream, opening.count + 1);
  std::vector<std::int32_t> face;
  for (std::uint64_t f = 0; f < opening.count; ++f) {
    if (layout.binary) {  // before compact lists: each face a binary list of labels
      read_labels(stream, layout, face);
      points.insert(points.end(), face.begin(), face.end());
    } else {
      const auto corners = claimed_count(stream, stream.next());
      stream.expect('(', "the number of points of a face");
      check_claim(stream, corners, 2, "label", false);
      read_ascii_labels(stream, corners, points);
    }
    if (points.size() > std::numeric_limits<std::int32_t>::max())
      stream.fail(stream.offset(), "faces with more than 2^31 points in all");
    starts.push_back(static_cast<std::int32_t>(points.size()));
  }
  stream.expect(')', fmt::format("{} faces", opening.count));
}

void skip_list(FoamStream& stream, const FoamLayout& layout, std::string_view list_type) {
  const auto name = list_type.substr(5, list_type.size() - 6);
  const auto* type = foam_type(name);
  const auto bytes = type != nullptr   ? type->components * layout.scalar_bytes
                     : name == "label" ? layout.label_bytes
                     : name == "bool"  ? 1U
                                       : 0U;
  if (bytes == 0) return;  // List<word> and the like stay text
  const auto opening = read_opening(stream, layout);
  if (opening.form == Opening::Form::empty) return;
  if (!layout.binary || opening.form == Opening::Form::uniform) return skip_text(stream);
  check_claim(stream, opening.count, bytes, name, true);
  if (!stream.skip(opening.count * bytes)) stream.fail_cut("the file ends inside a binary list");
  close_binary(stream, layout, opening.count * bytes);
}

}  // namespace bedscope::readers
