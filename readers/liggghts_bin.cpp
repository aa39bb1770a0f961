// SPDX-License-Identifier: BSD-3-Clause
// LIGGGHTS (and LAMMPS) `dump custom` in binary: numbers as they lay in memory, all values double.
//
//   int64 step, particles; int32 triclinic, boundary[6]; double lo and hi of x, y, z [, xy, xz,
//   yz]; int32 columns, chunks; and for each chunk: int32 count, double[count], row after row.
//
// Names of columns are not stored. LAMMPS since 2020 puts before it the negative length of a magic
// text, the text, int32 endian mark and revision; revision 2 stores units, time and names behind
// `columns`. Sources: LIGGGHTS dump_custom.cpp, LAMMPS tools/binary2txt.cpp.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "readers/columns.hpp"
#include "readers/dump_units.hpp"
#include "readers/error.hpp"
#include "readers/forms.hpp"
#include "readers/liggghts_bin_header.hpp"
#include "readers/source.hpp"

namespace bedscope::readers {
namespace {

using namespace liggghts_binary;

constexpr std::size_t piece = std::size_t{1} << 18;  // stays in the second-level cache

template <class T>
T number_at(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return value;
}

/// The count in front of a chunk.
std::int32_t chunk_size(Source& source, const std::string& path, const Header& header) {
  NumberReader numbers(source, path);
  const auto at = numbers.position();
  const auto size = numbers.next<std::int32_t>();
  if (size < 0 || size % header.columns != 0)
    numbers.fail(at, "a chunk of {} numbers, expected a multiple of {} columns", size,
                 header.columns);
  return size;
}

void check_sum(const std::string& path, const Header& header, std::uint64_t rows,
               std::uint64_t size) {
  const auto declared = static_cast<std::uint64_t>(header.particles);
  if (rows == declared) return;
  if (declared > size / sizeof(double) / static_cast<std::uint64_t>(header.columns))
    throw FormatError("{}: offset {}: {} particles declared, file has {} bytes", path,
                      header.count_at, declared, size);
  throw FormatError("{}: offset {}: header says {}, chunks hold {}", path, header.count_at,
                    declared, rows);
}

/// Goes past the chunks of a snapshot without reading their numbers.
void skip_chunks(Source& source, const std::string& path, const Header& header) {
  std::uint64_t rows = 0;
  const auto size = source.size_bound();
  for (std::int32_t chunk = 0; chunk < header.chunks; ++chunk) {
    const auto at = source.position();
    const auto count = static_cast<std::uint64_t>(chunk_size(source, path, header));
    const auto end = source.position() + count * sizeof(double);
    source.seek(end);
    if (end > size || source.position() < end)
      throw CutError("{}: offset {}: chunk declares {} doubles, {}", path, at, count,
                     source.cut().empty() ? "file ends" : source.cut());
    rows += count / static_cast<std::uint64_t>(header.columns);
  }
  check_sum(path, header, rows, size);
}

using Names = std::shared_ptr<const std::vector<std::string>>;

/// "column 1", ... where none are stored: one list for all snapshots of as many columns, as a
/// snapshot without rows takes less room in the file than a list in memory.
Names names_of(const Header& header, std::map<std::int32_t, Names>& unnamed) {
  if (!header.names.empty()) return std::make_shared<const std::vector<std::string>>(header.names);
  auto& list = unnamed[header.columns];
  if (list != nullptr) return list;
  std::vector<std::string> names;
  for (std::int32_t k = 1; k <= header.columns; ++k) names.push_back(fmt::format("column {}", k));
  return list = std::make_shared<const std::vector<std::string>>(std::move(names));
}

Located locate(const Header& header, std::map<std::int32_t, Names>& unnamed) {
  Located located;
  located.step = header.step;
  located.time = header.time;
  located.particles = header.particles;
  located.offset = header.offset;
  located.box = header.box;
  located.named = !header.names.empty();
  located.columns = located.parts = names_of(header, unnamed);
  return located;
}

/// Zeros up to the end of the file, as a crashed node leaves them.
bool only_zeros(Source& source) {
  std::vector<char> bytes(piece);
  while (const auto got = source.read(bytes))
    if (std::any_of(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(got),
                    [](char c) { return c != 0; }))
      return false;
  return true;
}

FileScan scan(const std::string& path, bool /*thorough*/) {
  Source source(path);
  FileScan found;
  std::map<std::int32_t, Names> unnamed;
  while (true) {
    const auto begin = source.position();
    try {
      const auto header = next_header(source, path);
      if (!header) break;
      skip_chunks(source, path, *header);
      if (found.snapshots.empty())
        if (auto said = units_problem(header->units); !said.empty())
          found.problems.push_back(std::move(said));
      auto located = locate(*header, unnamed);
      located.bytes = source.position() - begin;
      if (!located.named && found.unnamed.empty()) found.unnamed = "a binary dump names no columns";
      found.snapshots.push_back(std::move(located));
    } catch (const CutError& error) {
      if (found.snapshots.empty()) throw;
      found.cut = std::string(error.what()).substr(path.size() + 2);
      break;
    } catch (const FormatError&) {
      if (found.snapshots.empty()) throw;
      source.seek(begin);
      if (!only_zeros(source)) throw;
      found.cut = fmt::format("offset {}: NUL bytes after the last snapshot", begin);
      break;
    }
  }
  if (found.snapshots.empty()) throw FormatError("{}: file is empty", path);
  if (found.cut.empty()) found.cut = source.cut();
  if (!source.trailing().empty()) found.problems.push_back(source.trailing());
  return found;
}

/// Rows of doubles to the columns that are wanted.
void spread(const char* bytes, std::size_t rows, std::size_t columns, const ColumnPlan& plan,
            std::size_t first, std::vector<std::vector<double>>& raw) {
  for (std::size_t k = 0; k < plan.parse.size(); ++k) {
    const char* from = bytes + static_cast<std::size_t>(plan.parse[k]) * sizeof(double);
    double* const to = raw[k].data() + first;
    for (std::size_t row = 0; row < rows; ++row, from += columns * sizeof(double))
      to[row] = number_at<double>(from);
  }
}

void compare_twins(const std::string& path, const ColumnPlan& plan,
                   const std::vector<std::string>& names,
                   const std::vector<std::vector<double>>& raw) {
  for (const auto& [first, second] : plan.twins) {
    const auto& a = raw[static_cast<std::size_t>(first)];
    const auto& b = raw[static_cast<std::size_t>(second)];
    for (std::size_t row = 0; row < a.size(); ++row)
      if (a[row] != b[row] && !(std::isnan(a[row]) && std::isnan(b[row])))
        throw FormatError(
            "{}: column \"{}\" twice with different values (row {}: {} and {})", path,
            names[static_cast<std::size_t>(plan.parse[static_cast<std::size_t>(first)])], row + 1,
            a[row], b[row]);
  }
}

void read(const std::string& path, const Located& where, const Request& request, Snapshot& out,
          Scratch& scratch) {
  Source source(path);
  source.seek(where.offset);
  const auto header = next_header(source, path);
  if (!header || header->step != where.step || header->particles != where.particles)
    throw FormatError("{}: offset {}: the file has changed since it was opened", path,
                      where.offset);
  const auto& names = header->names.empty() ? *where.columns : header->names;
  const auto plan = plan_columns(names, request, path);
  const auto columns = static_cast<std::size_t>(header->columns);
  const auto particles = static_cast<std::size_t>(header->particles);
  if (names.size() != columns)
    throw FormatError("{}: {} columns, {} names", path, columns, names.size());
  if (particles > source.size_bound() / sizeof(double) / columns)  // nothing is reserved for a lie
    check_sum(path, *header, 0, source.size_bound());
  out.step = header->step;
  out.time = header->time;
  out.box = header->box;
  out.particles = particles;
  scratch.raw.resize(std::max(scratch.raw.size(), plan.parse.size()));
  for (std::size_t k = 0; k < plan.parse.size(); ++k) scratch.raw[k].resize(particles);

  const auto rows_at_once = std::max<std::size_t>(piece / (columns * sizeof(double)), 1);
  const auto room = rows_at_once * columns * sizeof(double);
  if (scratch.bytes.size() < room) scratch.bytes.resize(room);
  std::size_t row = 0;
  for (std::int32_t chunk = 0; chunk < header->chunks; ++chunk) {
    const auto at = source.position();
    const auto count = static_cast<std::size_t>(chunk_size(source, path, *header));
    for (std::size_t left = count / columns; left > 0;) {
      const auto rows = std::min(left, rows_at_once);
      if (row + rows > particles) check_sum(path, *header, row + left, source.size_bound());
      const auto bytes = rows * columns * sizeof(double);
      if (source.read({scratch.bytes.data(), bytes}) < bytes)
        throw CutError("{}: offset {}: chunk declares {} doubles, file ends", path, at, count);
      spread(scratch.bytes.data(), rows, columns, plan, row, scratch.raw);
      row += rows;
      left -= rows;
    }
  }
  check_sum(path, *header, row, source.size_bound());
  out.bytes_read = source.bytes_from_disk();
  compare_twins(path, plan, names, scratch.raw);
  finish_columns(plan, scratch.raw, out, path);
}

std::string place(const std::string&, const Located& where, std::size_t row) {
  return fmt::format("row {} of the snapshot at offset {}", row + 1, where.offset);
}

/// Nothing marks these files but small numbers where small numbers have to be, and a box.
bool matches(std::string_view head) {
  if (head.size() < 44) return false;
  const auto first = number_at<std::int64_t>(head.data());
  if (first < 0) return first >= -64 && head.substr(8).starts_with("DUMP");
  const auto triclinic = number_at<std::int32_t>(head.data() + 16);
  if (triclinic != 0 && triclinic != 1) return false;
  for (std::size_t k = 0; k < 6; ++k) {
    const auto boundary = number_at<std::int32_t>(head.data() + 20 + 4 * k);
    if (boundary < 0 || boundary > 3) return false;
  }
  if (head.size() < 60) return head.find_first_not_of('\0') != head.npos;
  const auto low = number_at<double>(head.data() + 44), high = number_at<double>(head.data() + 52);
  return std::isfinite(low) && std::isfinite(high) && high > low;
}

}  // namespace

extern const Form liggghts_bin;
constinit const Form liggghts_bin{
    .name = "dump-bin",
    .description =
        "LIGGGHTS or LAMMPS binary dump; names of columns come from columns = [...] of the [[run]]",
    .reference = "https://www.cfdem.com/media/DEM/docu/dump.html",
    .matches = matches,
    .scan = scan,
    .names_columns = false,
    .read = read,
    .place = place,
};

}  // namespace bedscope::readers
