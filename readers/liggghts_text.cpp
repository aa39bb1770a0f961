// SPDX-License-Identifier: BSD-3-Clause
// LIGGGHTS (and LAMMPS) `dump custom` in text: one or many snapshots in a file, plain or gzip.
//
//   ITEM: TIMESTEP / ITEM: NUMBER OF ATOMS / ITEM: BOX BOUNDS ff ff ff / ITEM: ATOMS id type x ...
//
// and one row of blank-separated values a particle. LIGGGHTS ends rows with a blank, so a last row
// with that blank is whole even without its line end.
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <optional>

#include "readers/byte_window.hpp"
#include "readers/columns.hpp"
#include "readers/dump_units.hpp"
#include "readers/error.hpp"
#include "readers/forms.hpp"
#include "readers/liggghts_header.hpp"
#include "readers/numbers.hpp"
#include "readers/source.hpp"
#include "readers/tokens.hpp"

namespace bedscope::readers {
namespace {

using namespace liggghts_dump;

/// Moves the window to the next line that begins with "ITEM:", counting line ends and the first NUL
/// byte on the way. `last` keeps what the body's last line looks like.
struct Body {
  std::uint64_t lines = 0;  // line ends
  std::uint64_t nul = 0;    // offset of the first NUL byte
  std::uint64_t lines_before_nul = 0;
  bool has_nul = false;
  bool found_header = false;
  std::string tail;  // bytes after the last line end, at the end of the file
};

Body skip_body(ByteWindow& window) {
  Body body;
  bool line_start = true;  // the window stands at the start of a line
  while (true) {
    const char* at = window.begin();
    const char* const end = window.end();
    const char* header = nullptr;
    // Rows hold digits; a capital I is rare, so this runs at the speed of memchr.
    while (at < end) {
      const auto* candidate =
          static_cast<const char*>(std::memchr(at, 'I', static_cast<std::size_t>(end - at)));
      if (candidate == nullptr) break;
      const bool at_line_start = candidate == window.begin() ? line_start : candidate[-1] == '\n';
      if (at_line_start) {
        if (end - candidate < 5) {
          header = candidate;
          break;
        }
        if (std::string_view(candidate, 5) == "ITEM:") {
          header = candidate;
          break;
        }
      }
      at = candidate + 1;
    }
    const char* stop = header != nullptr ? header : end;
    if (!body.has_nul)
      if (const void* nul =
              std::memchr(window.begin(), 0, static_cast<std::size_t>(stop - window.begin()))) {
        body.has_nul = true;
        body.nul = window.offset(static_cast<const char*>(nul));
        body.lines_before_nul =
            body.lines + static_cast<std::uint64_t>(
                             std::count(window.begin(), static_cast<const char*>(nul), '\n'));
      }
    body.lines += static_cast<std::uint64_t>(std::count(window.begin(), stop, '\n'));
    // What follows the last line end is kept short: one row is all that matters.
    const char* tail = stop;
    while (tail > window.begin() && tail[-1] != '\n') --tail;
    if (tail > window.begin()) body.tail.clear();
    if (body.tail.size() < (1U << 20)) body.tail.append(tail, stop);
    if (stop > window.begin()) line_start = stop[-1] == '\n';
    window.drop_until(stop);
    if (header != nullptr && end - header >= 5) {
      body.found_header = true;
      return body;
    }
    if (!window.more()) {
      if (window.size() > 0) {  // "I", "IT" ... at the very end
        body.tail.assign(window.begin(), window.end());
        window.drop_until(window.end());
      }
      return body;
    }
  }
}

std::int64_t count_words(std::string_view row, std::int64_t limit) {
  std::int64_t words = 0;
  while (words < limit && !next_word(row).empty()) ++words;
  return words;
}

/// Why the snapshot behind `header` is not whole; empty if it is.
std::string incompleteness(const Header& header, const Body& body, const std::string& gzip_cut) {
  const auto columns = static_cast<std::int64_t>(header.columns.size());
  const auto declared = static_cast<std::uint64_t>(header.particles);
  std::uint64_t rows = body.lines;
  const auto first_row = header.line + header.lines;
  if (body.has_nul) {
    if (body.lines_before_nul < declared)
      return fmt::format("line {}: NUL byte", first_row + body.lines_before_nul);
    return {};
  }
  const bool open_row = body.tail.find_first_not_of(" \t\r") != std::string::npos;
  if (rows + open_row >= declared && rows < declared && body.tail.ends_with(' ') &&
      count_words(body.tail, columns + 1) == columns)
    ++rows;
  if (rows >= declared) return {};
  const auto line = first_row + rows;
  if (!gzip_cut.empty())
    return fmt::format("{}: {} declared, {} present", gzip_cut, declared, rows);
  if (open_row) {
    const auto words = count_words(body.tail, columns + 1);
    if (words > columns)
      return fmt::format(
          "line {}: {} values expected, more than {} found; no line end: file is cut", line,
          columns, columns);
    if (rows + 1 == declared && words == columns)
      return fmt::format("line {}: the last value has no blank or line end behind it: file is cut",
                         line);
    if (rows + 1 == declared)
      return fmt::format("line {}: {} values expected, {} found; no line end: file is cut", line,
                         columns, words);
  }
  return fmt::format("after line {}: {} declared, {} present", line - 1, declared, rows);
}

Located locate(const Header& header, std::shared_ptr<const std::vector<std::string>> columns) {
  Located located;
  located.step = header.step;
  located.time = header.time;
  located.particles = header.particles;
  located.offset = header.offset;
  located.line = header.line;
  located.box = header.box;
  located.columns = columns;
  located.parts = std::move(columns);
  located.named = header.named;
  return located;
}

/// One snapshot in the file, to judge from its name (which holds the step), its first rows and its
/// size? Then nobody needs to read it before its turn. A wrong guess is found when it is read.
bool looks_single(const std::string& path, const Header& header, const ByteWindow& window,
                  std::uint64_t file_size) {
  const auto name = std::filesystem::path(path).filename().string();
  const auto step = std::to_string(header.step);
  const auto at = name.find(step);
  if (at == name.npos || header.particles < 100) return false;
  const auto rows = std::count(window.begin(), window.end(), '\n');
  if (rows < 20) return false;
  const double row = static_cast<double>(window.size()) / static_cast<double>(rows);
  const double expected = static_cast<double>(header.particles) * row;
  const auto body = static_cast<double>(file_size - window.offset());
  return body < 1.25 * expected;
}

void note_unnamed(const std::string& path, const Header& header, FileScan& found) {
  if (header.named || !found.unnamed.empty()) return;
  found.unnamed = fmt::format("line {}: \"ITEM: ATOMS\" without column names (LAMMPS before 2010)",
                              first_line(header, path) + header.lines - 1);
}

/// Units stand over the first snapshot of a file alone.
void note_units(const Header& header, FileScan& found) {
  if (auto said = units_problem(header.units); !said.empty())
    found.problems.push_back(std::move(said));
}

/// The header alone, where the file looks like one snapshot (see looks_single).
bool glance(const std::string& path, FileScan& found) {
  constexpr std::size_t first_look = 1U << 14;
  Source source(path);
  std::vector<char> buffer;
  ByteWindow window(source, buffer, first_look);
  const auto header = HeaderReader(window, path).next();
  if (!header || !looks_single(path, *header, window, source.likely_size())) return false;
  note_unnamed(path, *header, found);
  note_units(*header, found);
  found.snapshots.push_back(
      locate(*header, std::make_shared<const std::vector<std::string>>(header->columns)));
  return true;
}

void note_order(FileScan& found) {
  for (std::size_t i = 1; i < found.snapshots.size(); ++i)
    if (found.snapshots[i].step < found.snapshots[i - 1].step)
      found.problems.push_back(fmt::format("steps are not in order: {} then {}; sorted by step",
                                           found.snapshots[i - 1].step, found.snapshots[i].step));
}

/// Every snapshot of the file; where some are known, from the last of these on.
FileScan find_snapshots(const std::string& path, FileScan known = {}) {
  FileScan found;
  found.snapshots = std::move(known.snapshots);
  found.unnamed = std::move(known.unnamed);
  for (auto& problem : known.problems)  // said by the first snapshot, which is not read again
    if (problem.starts_with(units_said)) found.problems.push_back(std::move(problem));
  Source source(path);
  if (source.size_bound() == 0) throw FormatError("{}: file is empty", path);
  std::shared_ptr<const std::vector<std::string>> columns;
  std::uint64_t line = 0;  // the first snapshot's is told by what stands before it
  if (!found.snapshots.empty()) {
    columns = found.snapshots.back().columns;
    line = found.snapshots.back().line;
    source.seek(found.snapshots.back().offset);
    found.snapshots.pop_back();
  }
  std::vector<char> buffer;
  ByteWindow window(source, buffer);
  HeaderReader headers(window, path);
  std::vector<std::pair<std::uint64_t, std::shared_ptr<const Checkpoint>>> entries;  // of gzip
  while (true) {
    std::optional<Header> header;
    try {
      header = headers.next(line);
    } catch (const CutError& error) {
      if (found.snapshots.empty()) throw;
      found.cut = std::string(error.what()).substr(path.size() + 2);
      break;
    }
    if (!header) break;
    header->line = first_line(*header, path);
    if (columns == nullptr || *columns != header->columns)
      columns = std::make_shared<const std::vector<std::string>>(header->columns);
    const auto body = skip_body(window);
    if (!body.found_header) {
      const auto why = incompleteness(*header, body, source.cut());
      if (!why.empty()) {
        if (found.snapshots.empty()) throw CutError("{}: {}", path, why);
        found.cut = fmt::format("snapshot {}: {}", header->step, why);
        break;
      }
    }
    note_unnamed(path, *header, found);
    if (found.snapshots.empty()) note_units(*header, found);
    auto located = locate(*header, columns);
    located.bytes = window.offset() - header->offset;
    for (const auto& [offset, entry] : entries)
      if (offset <= located.offset) located.checkpoint = entry;
    found.snapshots.push_back(std::move(located));
    if (!body.found_header && is_cut_item(body.tail))
      found.cut = fmt::format("line {}: expected another snapshot, found {} and end of file",
                              header->line + header->lines + body.lines, quote(body.tail));
    if (body.has_nul && !body.found_header)
      found.cut = fmt::format(
          "line {} (offset {}): NUL bytes after the last row (file system lost the tail?)",
          header->line + header->lines + body.lines_before_nul, body.nul);
    if (!body.found_header) break;
    line = header->line + header->lines + body.lines;
    if (source.compressed() &&
        (entries.empty() || source.position() > entries.back().first + 4 * ByteWindow::piece))
      entries.emplace_back(source.position(), source.checkpoint());
  }
  if (found.snapshots.empty()) throw FormatError("{}: no \"ITEM:\" found", path);
  note_order(found);
  if (found.cut.empty()) found.cut = source.cut();
  if (!source.trailing().empty()) found.problems.push_back(source.trailing());
  return found;
}

FileScan scan(const std::string& path, bool thorough) {
  try {
    FileScan found;
    if (!thorough && glance(path, found)) return found;
    return find_snapshots(path);
  } catch (const NotParticles& what) {
    FileScan found;
    found.not_particles = std::string(what.what()).substr(path.size() + 2);
    return found;
  }
}

FileScan extend(const std::string& path, FileScan known) {
  return find_snapshots(path, std::move(known));
}

/// 3.0D-03, as Fortran prints it.
bool has_d_exponent(std::string_view word) {
  const auto at = word.find_first_of("dD");
  return at != word.npos && at > 0 && word.find_first_not_of("0123456789+-", at + 1) == word.npos;
}

/// Says what is wrong with a row that could not be read.
[[noreturn]] void explain_row(const std::string& path, const Header& header, std::string_view row,
                              std::uint64_t row_index, const ColumnPlan& plan) {
  const auto line = first_line(header, path) + header.lines + row_index;
  const auto columns = static_cast<std::int64_t>(header.columns.size());
  if (row.find('\0') != row.npos) throw FormatError("{}: line {}: NUL byte", path, line);
  if (row.starts_with("ITEM:"))
    throw FormatError("{}: line {}: {} particles declared, {} present before {}", path, line,
                      header.particles, row_index, quote(row));
  const auto words = count_words(row, std::int64_t{1} << 40);
  if (words != columns)
    throw FormatError("{}: line {}: {} values expected (line {}), {} found", path, line, columns,
                      first_line(header, path) + header.lines - 1, words);
  std::string_view rest = row;
  for (int column = 0; column < columns; ++column) {
    const auto word = next_word(rest);
    double value = 0;
    if (std::binary_search(plan.parse.begin(), plan.parse.end(), column) &&
        !parse_number(word.data(), word.data() + word.size(), value))
      throw FormatError("{}: line {}, column {}: {} is not a number{}", path, line,
                        header.columns[static_cast<std::size_t>(column)], quote(word),
                        has_d_exponent(word) ? " (D exponent)" : "");
  }
  throw FormatError("{}: line {}: row cannot be read: {}", path, line, quote(row));
}

/// Rows into raw columns: raw[k][row] for the k-th column of plan.parse.
class RowReader {
 public:
  RowReader(const ColumnPlan& plan, std::size_t columns, std::vector<std::vector<double>>& raw)
      : columns_(static_cast<std::int64_t>(columns)),
        targets_(columns, nullptr),
        plan_(plan),
        raw_(raw) {}

  void resize(std::size_t rows) {
    raw_.resize(std::max(raw_.size(), plan_.parse.size()));
    for (std::size_t k = 0; k < plan_.parse.size(); ++k) {
      if (raw_[k].size() < rows) raw_[k].resize(rows);
      targets_[static_cast<std::size_t>(plan_.parse[k])] = raw_[k].data();
    }
  }

  /// False where the row has another count of values, or one of them is not a number.
  bool read(const char* begin, const char* end, std::size_t row) const {
    bool good = true;
    const auto words =
        for_each_word(begin, end, [&](std::int64_t column, const char* from, const char* to) {
          if (column >= columns_) return good = false;
          double* const target = targets_[static_cast<std::size_t>(column)];
          return target == nullptr || (good = parse_number(from, to, target[row]));
        });
    return good && words == columns_;
  }

 private:
  std::int64_t columns_;
  std::vector<double*> targets_;  // a column on disk: where its values go, or null
  const ColumnPlan& plan_;
  std::vector<std::vector<double>>& raw_;
};

void compare_twins(const std::string& path, const Header& header, const ColumnPlan& plan,
                   const std::vector<std::vector<double>>& raw, std::size_t rows) {
  for (const auto& [first, second] : plan.twins)
    for (std::size_t row = 0; row < rows; ++row) {
      const double a = raw[static_cast<std::size_t>(first)][row];
      const double b = raw[static_cast<std::size_t>(second)][row];
      if (a == b || (a != a && b != b)) continue;
      const auto line = first_line(header, path) + header.lines;
      const auto column = static_cast<std::size_t>(plan.parse[static_cast<std::size_t>(first)]);
      throw FormatError(
          "{}: line {}: column \"{}\" twice with different values (line {}: {} and {})", path,
          line - 1, header.columns[column], line + row, a, b);
    }
}

/// As much of the next snapshot as tells that it begins here. No more is read of it, so what a
/// snapshot costs does not depend on what follows.
constexpr std::uint64_t next_header = 64;  // bytes

void read(const std::string& path, const Located& where, const Request& request, Snapshot& out,
          Scratch& scratch) {
  Source source(path);
  source.resume(where.checkpoint);
  source.seek(where.offset);
  if (where.bytes != 0) source.stop_at(where.offset + where.bytes + next_header);
  ByteWindow window(source, scratch.bytes);
  HeaderReader headers(window, path);
  auto header = headers.next(where.line);
  if (!header || header->step != where.step || header->particles != where.particles ||
      header->named != where.named)
    throw FormatError("{}: offset {}: the file has changed since it was opened", path,
                      where.offset);
  if (!header->named) header->columns = *where.columns;  // as the user names them
  const auto names_at = [&] {
    return fmt::format("{}: line {}", path, first_line(*header, path) + header->lines - 1);
  };
  ColumnPlan plan;
  try {
    plan = plan_columns(header->columns, request, "");
  } catch (const FormatError&) {
    plan = plan_columns(header->columns, request,
                        names_at());  // the line is worth a second look only now
  }
  out.step = header->step;
  out.time = header->time;
  out.box = header->box;

  // The declared count is a claim: room grows with the rows that are really there.
  const auto declared = static_cast<std::size_t>(header->particles);
  const std::size_t least_row = 2 * std::max<std::size_t>(header->columns.size(), 1);
  const std::uint64_t most_rows = source.size_bound() / least_row + 1;
  RowReader rows(plan, header->columns.size(), scratch.raw);
  std::size_t room = std::min<std::uint64_t>(declared, most_rows);
  if (source.compressed()) room = std::min<std::size_t>(room, 1U << 16);
  rows.resize(room);

  std::size_t row = 0;
  while (row < declared) {
    const auto* end = static_cast<const char*>(std::memchr(window.begin(), '\n', window.size()));
    if (end == nullptr) {
      if (window.size() > ByteWindow::piece / 2 &&
          count_words({window.begin(), window.size()},
                      static_cast<std::int64_t>(header->columns.size()) + 1) >
              static_cast<std::int64_t>(header->columns.size()))
        explain_row(path, *header, {window.begin(), window.size()}, row, plan);
      if (window.more()) continue;
      end = window.end();
      // Without a line end only the blank that LIGGGHTS writes tells that the last number is whole.
      if (window.size() == 0 || end[-1] != ' ')
        throw FormatError("{}: after line {}: {} declared, {} present", path,
                          first_line(*header, path) + header->lines + row - 1, declared, row);
    }
    // All whole lines of the window, before it moves on.
    const char* at = window.begin();
    while (row < declared && end != nullptr) {
      if (row == room) rows.resize(room = std::min(2 * room, declared));
      if (!rows.read(at, end, row)) {
        if (end == window.end())
          throw FormatError("{}: line {}: no line end: file is cut", path,
                            first_line(*header, path) + header->lines + row);
        explain_row(path, *header, {at, static_cast<std::size_t>(end - at)}, row, plan);
      }
      ++row;
      at = end == window.end() ? end : end + 1;
      end = static_cast<const char*>(
          std::memchr(at, '\n', static_cast<std::size_t>(window.end() - at)));
    }
    window.drop_until(at);
  }
  // Behind the last row: the end, blank lines, another snapshot, or what scan() has told of: NUL
  // bytes, the first letters of another snapshot.
  while (auto line = window.line()) {
    if (line->find_first_not_of(" \t") == line->npos) continue;
    if (line->starts_with("ITEM:") && where.bytes != 0) break;
    if (line->front() == '\0' || (where.bytes != 0 && is_cut_item(*line))) break;
    if (line->starts_with("ITEM:"))
      throw FormatError(
          "{}: offset {}: holds further snapshots behind the {} particles of step {}; analyse this "
          "file by itself",
          path, window.offset(), declared, header->step);
    throw FormatError("{}: line {}: {} particles declared, more rows found", path,
                      first_line(*header, path) + header->lines + row, declared);
  }
  out.particles = declared;
  out.bytes_read = source.bytes_from_disk();
  compare_twins(path, *header, plan, scratch.raw, declared);
  for (std::size_t k = 0; k < plan.parse.size(); ++k) scratch.raw[k].resize(declared);
  finish_columns(plan, scratch.raw, out, path);
}

std::string place(const std::string& path, const Located& where, std::size_t row) {
  Source source(path);
  source.resume(where.checkpoint);
  source.seek(where.offset);
  std::vector<char> buffer;
  ByteWindow window(source, buffer, 1U << 14);
  const auto header = HeaderReader(window, path).next(where.line);
  if (!header) return "the end";
  return fmt::format("line {}", first_line(*header, path) + header->lines + row);
}

bool matches(std::string_view head) {
  if (head.starts_with(byte_order_mark)) head.remove_prefix(byte_order_mark.size());
  while (!head.empty() && (is_blank(head.front()) && head.front() != '\0')) head.remove_prefix(1);
  return head.starts_with(first_item) || (!head.empty() && first_item.starts_with(head));
}

}  // namespace

extern const Form liggghts_text;
constinit const Form liggghts_text{
    .name = "dump-text",
    .description = "LIGGGHTS or LAMMPS text dump (dump custom), plain or gzip",
    .reference = "https://www.cfdem.com/media/DEM/docu/dump.html",
    .matches = matches,
    .scan = scan,
    .extend = extend,
    .glance_tells = true,
    .read = read,
    .place = place,
};

}  // namespace bedscope::readers
