// SPDX-License-Identifier: BSD-3-Clause
// Lists of labels and of faces.
#include <algorithm>
#include <limits>

#include "readers/openfoam_list_parts.hpp"
#include "readers/openfoam_numbers.hpp"

namespace bedscope::readers {
namespace {

using namespace detail;

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

}  // namespace

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
  const auto room = [&out](std::size_t more) {
    out.resize(out.size() + more);
    return out.data() + (out.size() - more);
  };
  const auto take = [](std::size_t) {};
  if (layout.label_bytes == 4)
    read_binary<std::int32_t, std::int32_t>(stream, layout, opening.count, 1, room, take);
  else
    read_binary<std::int64_t, std::int32_t>(stream, layout, opening.count, 1, room, take);
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

}  // namespace bedscope::readers
