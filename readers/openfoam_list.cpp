// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_list.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "readers/openfoam_list_parts.hpp"
#include "readers/openfoam_numbers.hpp"
#include "readers/processor.hpp"

namespace bedscope::readers {

namespace detail {

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

void close_binary(FoamStream& stream, const FoamLayout& layout, std::uint64_t bytes) {
  if (stream.at() == stream.end() && !stream.more())
    stream.fail_cut("expected \")\" after {} bytes, found end of file", bytes);
  if (*stream.at() != ')')
    stream.fail_binary("expected \")\" after {} bytes of a binary list ({})", bytes, layout.arch);
  stream.go_to(stream.at() + 1);
}

void check_expected(FoamStream& stream, std::uint64_t count, std::optional<FoamCount> expected) {
  if (expected && count != expected->count)
    stream.fail(stream.offset(), "list declares {} values, {} has {} {}", count, expected->whole,
                expected->count, expected->parts);
}

}  // namespace detail

namespace {

using namespace detail;

BEDSCOPE_FOR_EACH_PROCESSOR std::size_t count_non_finite(const double* values, std::size_t count) {
  constexpr std::uint64_t exponent = 0x7ff0000000000000;
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i)
    found += (std::bit_cast<std::uint64_t>(values[i]) & exponent) == exponent;
  return found;
}

// Takes the values of a list piece by piece: one behind the other, or each to its place. What is
// not finite is counted while a piece is still in the cache.
class Sink {
 public:
  Sink(std::vector<double>& out, unsigned components, const FoamPlaces* places)
      : out_(out), components_(components), places_(places) {
    if (places != nullptr) out.resize(places->size * components);
  }

  // So many may come (`sure`: will, if the file is not cut). Numbers of the list before are
  // overwritten, not cleared: that costs as much as reading.
  void expect(std::uint64_t numbers, bool sure) {
    if (places_ != nullptr) return;
    if (sure)
      out_.resize(static_cast<std::size_t>(numbers));
    else
      out_.reserve(static_cast<std::size_t>(numbers));
  }

  double* room(std::size_t numbers) {
    if (places_ != nullptr) {
      if (places_->piece->size() < numbers) places_->piece->resize(numbers);
      return places_->piece->data();
    }
    if (out_.size() < taken_ + numbers) out_.resize(taken_ + numbers);
    return out_.data() + taken_;
  }

  void take(std::size_t numbers) {
    const double* const from = places_ != nullptr ? places_->piece->data() : out_.data() + taken_;
    if (count_non_finite(from, numbers) > 0) note_non_finite(from, numbers);
    if (places_ != nullptr) put(from, numbers / components_);
    taken_ += numbers;
  }

  std::size_t values() const { return taken_ / components_; }
  bool full() const { return places_ != nullptr && values() == places_->count; }

  NonFinite finish() {
    if (places_ == nullptr) out_.resize(taken_);
    return seen_;
  }

 private:
  static constexpr std::size_t rows_ahead = 4, line = 64 / sizeof(double);

  void note_non_finite(const double* from, std::size_t numbers) {
    for (std::size_t value = 0; value < numbers / components_; ++value) {
      if (count_non_finite(from + value * components_, components_) == 0) continue;
      if (seen_.values++ == 0) seen_.first = values() + value;
    }
  }

  void put(const double* from, std::size_t count) {
    while (count > 0) {
      // The processor fetches ahead within a row; where the next ones begin it must be told. (In
      // a function of its own GCC 12 drops this, as it has no effect.)
      if (run_ + rows_ahead < places_->runs.size()) {
        const auto& later = places_->runs[run_ + rows_ahead];
        const double* at = out_.data() + static_cast<std::size_t>(later.place) * components_;
        const double* const end = at + static_cast<std::size_t>(later.count) * components_;
        for (; at < end; at += line) __builtin_prefetch(at, 1);
      }
      const auto& run = places_->runs[run_];
      const auto now = std::min(count, static_cast<std::size_t>(run.count) - of_run_);
      const auto to = static_cast<std::size_t>(run.place) + of_run_;
      std::copy_n(from, now * components_, out_.data() + to * components_);
      from += now * components_;
      count -= now;
      of_run_ += now;
      if (of_run_ < static_cast<std::size_t>(run.count)) continue;
      ++run_;
      of_run_ = 0;
    }
  }

  std::vector<double>& out_;
  unsigned components_;
  const FoamPlaces* places_;
  std::size_t taken_ = 0;             // numbers
  std::size_t run_ = 0, of_run_ = 0;  // where the next value goes
  NonFinite seen_;
};

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
void read_ascii(FoamStream& stream, const FoamType& type, Opening opening, Sink& sink) {
  constexpr std::size_t step = 4096;  // values in one go: at most 300 kB of numbers
  const bool counted = opening.form == Opening::Form::parenthesis;
  const auto total = counted ? opening.count : std::numeric_limits<std::uint64_t>::max();
  for (std::uint64_t done = 0; done < total;) {
    if (!counted && stream.peek() == ')') break;
    if (!counted && sink.full()) break;  // and fail at the parenthesis
    const auto now = counted ? std::min<std::uint64_t>(step, total - done) : 1;
    const auto numbers = static_cast<std::size_t>(now) * type.components;
    double* into = sink.room(numbers);
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
    sink.take(numbers);
    done += now;
  }
  if (!stream.take(')')) {
    if (stream.peek() == '\0' && stream.at() == stream.end())
      stream.fail_cut("{} values declared, end of file before \")\"", total);
    stream.fail(stream.offset(), "expected \")\" after {} values, found {}", sink.values(),
                stream.found());
  }
}

void read_uniform(FoamStream& stream, const FoamType& type, Opening opening,
                  std::optional<FoamCount> expected, Sink& sink) {
  std::array<double, 9> value{};
  parse_value_slowly(stream, type, value.data(), 0, 1);
  stream.expect('}', "the value of a uniform list");
  if (!expected)
    stream.fail(stream.offset(), "a uniform list of {} values where their number is not known",
                opening.count);
  const auto numbers = static_cast<std::size_t>(opening.count) * type.components;
  double* const into = sink.room(numbers);
  for (std::size_t i = 0; i < numbers; ++i) into[i] = value[i % type.components];
  sink.take(numbers);
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
                      std::optional<FoamCount> expected, std::vector<double>& out,
                      const FoamPlaces* places) {
  if (places != nullptr) expected = FoamCount{places->count};
  Sink sink(out, type.components, places);
  const auto opening = read_opening(stream, layout);
  if (opening.form != Opening::Form::uncounted) check_expected(stream, opening.count, expected);
  switch (opening.form) {
    case Opening::Form::empty:
      break;
    case Opening::Form::uniform:
      read_uniform(stream, type, opening, expected, sink);
      break;
    case Opening::Form::uncounted:
      read_ascii(stream, type, opening, sink);
      break;
    case Opening::Form::parenthesis: {
      const std::uint64_t least =
          std::uint64_t{type.components} * (layout.binary ? layout.scalar_bytes : 2);
      check_claim(stream, opening.count, least, type.name, layout.binary);
      const auto count = opening.count * type.components;
      if (!stream.compressed()) sink.expect(count, layout.binary);
      if (!layout.binary) {
        read_ascii(stream, type, opening, sink);
        break;
      }
      const auto room = [&](std::size_t numbers) { return sink.room(numbers); };
      const auto take = [&](std::size_t numbers) { sink.take(numbers); };
      if (layout.scalar_bytes == 8)
        read_binary<double, double>(stream, layout, count, type.components, room, take);
      else
        read_binary<float, double>(stream, layout, count, type.components, room, take);
      close_binary(stream, layout, count * layout.scalar_bytes);
    }
  }
  if (expected && sink.values() != expected->count)
    stream.fail(stream.offset(), "list holds {} values, {} has {} {}", sink.values(),
                expected->whole, expected->count, expected->parts);
  return sink.finish();
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
