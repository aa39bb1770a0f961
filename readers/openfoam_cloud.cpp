// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_cloud.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "readers/numbers.hpp"
#include "readers/openfoam_list.hpp"

namespace bedscope::readers {
namespace {

struct Row {
  std::array<double, 4> numbers{};
  std::size_t count = 0;  // 3: cartesian, 4: barycentric
  std::array<std::int64_t, 3> labels{};
};

Point barycentric_point(const CloudMesh& mesh, const Row& row, const std::string& where) {
  const auto [cell, face, corner] = row.labels;
  if (cell < 0 || static_cast<std::size_t>(cell) >= mesh.centres.size() || face < 0 ||
      static_cast<std::size_t>(face) >= mesh.poly.faces())
    throw FormatError("{}: expected a cell and a face of the mesh, found {} {}", where, cell, face);
  const auto f = static_cast<std::size_t>(face);
  const auto labels = mesh.poly.face(f);
  const auto n = static_cast<std::int64_t>(labels.size());
  const bool owns = mesh.poly.owner[f] == cell;
  if (!owns && (f >= mesh.poly.neighbour.size() || mesh.poly.neighbour[f] != cell))
    throw FormatError("{}: cell {} is not bounded by face {}", where, cell, face);
  if (corner < 1 || corner > n - 2)
    throw FormatError("{}: face {} of {} points has no triangle {}", where, face, n, corner);
  const std::int64_t base = mesh.base.empty() ? 0 : mesh.base[f];
  auto third = (corner + base) % n, fourth = (third + 1) % n;
  if (!owns) std::swap(third, fourth);
  const auto point = [&](std::int64_t k) -> const Point& {
    return mesh.poly.points[static_cast<std::size_t>(labels[static_cast<std::size_t>(k)])];
  };
  const auto& centre = mesh.centres[static_cast<std::size_t>(cell)];
  Point x{};
  for (std::size_t a = 0; a < 3; ++a)
    x[a] = row.numbers[0] * centre[a] + row.numbers[1] * point(base)[a] +
           row.numbers[2] * point(third)[a] + row.numbers[3] * point(fourth)[a];
  return x;
}

void add_row(const Row& row, const std::function<const CloudMesh&()>& mesh, const std::string& path,
             std::size_t index, CloudPoints& out) {
  if (row.count == 3) {
    out.at.push_back({row.numbers[0], row.numbers[1], row.numbers[2]});
    return;
  }
  const double sum = row.numbers[0] + row.numbers[1] + row.numbers[2] + row.numbers[3];
  if (!(std::abs(sum - 1) < 1e-5) && out.off_sum++ == 0) {  // six digits are the fewest written
    out.first_off = out.at.size();
    out.first_sum = sum;
  }
  out.at.push_back(barycentric_point(mesh(), row, fmt::format("{}: parcel {}", path, index)));
}

Row read_ascii_row(FoamStream& stream, std::size_t index) {
  Row row;
  stream.expect('(', "the parcel before");
  while (!stream.take(')')) {
    const auto token = stream.next();
    if (token.at_end()) stream.fail_cut("end of file in the position of parcel {}", index);
    if (row.count == 4 || !parse_number(token.text.data(), token.text.data() + token.text.size(),
                                        row.numbers[row.count]))
      stream.fail(token.offset, "expected 3 or 4 numbers for parcel {}, found \"{}\"", index,
                  token.text);
    ++row.count;
  }
  if (row.count < 3)
    stream.fail(stream.offset(), "expected 3 or 4 numbers for parcel {}, found {}", index,
                row.count);
  const std::size_t labels = row.count == 4 ? 3 : 1;
  for (std::size_t k = 0; k < labels; ++k) {
    const auto token = stream.next();
    bool overflow = false;
    if (!parse_integer(token.text, row.labels[k], overflow))
      stream.fail(token.offset, "expected {} labels behind the position of parcel {}, found \"{}\"",
                  labels, index, token.text);
  }
  return row;
}

// The forms of a binary record: how many scalars, how many labels behind them, how many bytes.
struct Record {
  std::size_t scalars, labels, bytes;
};

Record record_form(FoamStream& stream, const FoamLayout& layout) {
  const std::size_t s = layout.scalar_bytes, l = layout.label_bytes;
  const std::array<Record, 3> forms{{{4, 3, 4 * s + 3 * l},    // barycentric
                                     {3, 1, 3 * s + l},        // + writeLagrangianPositions
                                     {3, 1, 4 * s + 2 * l}}};  // before v5: face, stepFraction
  stream.skip_blanks();
  while (static_cast<std::size_t>(stream.end() - stream.at()) < 80 && stream.more()) {
  }
  const std::string_view head(stream.at(), static_cast<std::size_t>(stream.end() - stream.at()));
  for (const auto& form : forms) {
    const auto close = 1 + form.bytes;
    if (close >= head.size() || head[close] != ')') continue;
    // Behind the record: another one, or the end of the list.
    const auto next = head.find_first_not_of(" \r\n", close + 1);
    if (next == std::string_view::npos || head[next] == '(' || head[next] == ')') return form;
  }
  return forms[0];  // and fail at its closing parenthesis
}

Row read_binary_row(FoamStream& stream, const FoamLayout& layout, const Record& form,
                    std::size_t index) {
  Row row;
  stream.expect('(', "the parcel before");
  std::array<char, 64> bytes{};
  if (stream.read({bytes.data(), form.bytes}) < form.bytes)
    stream.fail_cut("record {}: {} bytes expected, the file ends", index, form.bytes);
  const bool swap = layout.big_endian != (std::endian::native == std::endian::big);
  const auto number = [&]<class T>(const char* from, T value) {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), from, sizeof(T));
    if (swap) std::reverse(raw.begin(), raw.end());
    std::memcpy(&value, raw.data(), sizeof(T));
    return value;
  };
  const char* from = bytes.data();
  for (; row.count < form.scalars; ++row.count, from += layout.scalar_bytes)
    row.numbers[row.count] =
        layout.scalar_bytes == 8 ? number(from, double{}) : number(from, float{});
  for (std::size_t k = 0; k < form.labels; ++k, from += layout.label_bytes)
    row.labels[k] =
        layout.label_bytes == 8 ? number(from, std::int64_t{}) : number(from, std::int32_t{});
  if (stream.at() == stream.end()) stream.more();
  if (stream.at() == stream.end() || *stream.at() != ')')
    stream.fail_binary("record {}: expected \")\" after {} bytes ({})", index, form.bytes,
                       layout.arch);
  stream.go_to(stream.at() + 1);
  return row;
}

}  // namespace

std::size_t read_cloud_count(FoamBlocks& file) {
  auto& stream = file.stream();
  const auto token = stream.next();
  std::int64_t count = 0;
  bool overflow = false;
  if (!parse_integer(token.text, count, overflow) || count < 0)
    stream.fail(token.offset, "expected the number of parcels, found \"{}\"", token.text);
  if (static_cast<std::uint64_t>(count) > stream.left() / 8)  // "(0 0 0)0"
    stream.fail_cut("{} parcels declared, the file ends after {} bytes more", count, stream.left());
  return static_cast<std::size_t>(count);
}

void read_cloud_points(FoamBlocks& file, const std::function<const CloudMesh&()>& mesh,
                       CloudPoints& out) {
  auto& stream = file.stream();
  const auto layout = layout_of(file.header(), stream.path());
  const auto count = read_cloud_count(file);
  if (count == 0) return;
  stream.expect('(', "the number of parcels");
  const auto form = layout.binary ? record_form(stream, layout) : Record{};
  for (std::size_t index = 0; index < count; ++index) {
    const auto row = layout.binary ? read_binary_row(stream, layout, form, index)
                                   : read_ascii_row(stream, index);
    add_row(row, mesh, stream.path(), index, out);
  }
  stream.expect(')', "the last parcel");
}

}  // namespace bedscope::readers
