// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_tables.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "readers/byte_window.hpp"
#include "readers/error.hpp"
#include "readers/numbers.hpp"
#include "readers/openfoam_row.hpp"
#include "readers/tokens.hpp"

namespace bedscope::readers {
namespace {

constexpr double not_found = -1e299;  // OpenFOAM writes -1e300 for a probe outside the mesh

/// Is it the first title of a table over time?
bool is_time(std::string_view word) {
  return word == "Time" || word == "time" || word == "TimeStep";
}

/// What the comments above the rows tell.
struct Header {
  std::vector<FoamTable::Point> points;
  std::vector<std::string> titles;  ///< without that of the first column; empty: not told
  bool over_time = false;
  int title_lines = 0;

  void add(std::string_view comment) {
    comment.remove_prefix(1);
    auto rest = comment;
    const auto first = next_word(rest);
    if (first == "Probe" && add_point(rest)) return;
    if (!is_time(first) && title_lines > 0) return;
    titles = split_titles(comment);
    if (!titles.empty()) titles.erase(titles.begin());
    title_lines += is_time(first);
    over_time |= is_time(first);
  }

  /// A first row of words only: titles without '#', as in the .csv of sampled sets.
  bool add_names(const FoamRow& row) {
    const auto is_name = [](const auto& leaf) { return leaf.depth == 0 && !leaf.is_number; };
    if (!titles.empty() || !std::all_of(row.leaves.begin(), row.leaves.end(), is_name))
      return false;
    over_time = is_time(row.leaves.front().text);
    title_lines = 1;
    for (std::size_t k = 1; k < row.leaves.size(); ++k) titles.emplace_back(row.leaves[k].text);
    return true;
  }

  /// "3 (9 9 9)  # Not Found"
  bool add_point(std::string_view text) {
    next_word(text);
    FoamRow row;
    const bool found = text.find("# Not Found") == text.npos;
    if (!row.parse(text.substr(0, text.find('#'))).empty() || row.leaves.size() != 3 ||
        row.leaves[0].depth == 0)  // "Probe 0 1 2 3": the line above the rows
      return false;
    points.push_back({{row.leaves[0].number, row.leaves[1].number, row.leaves[2].number}, found});
    return true;
  }
};

class TableReader {
 public:
  explicit TableReader(const std::string& path) : path_(path) { table_.files.push_back(path); }

  FoamTable read() {
    Source source(path_);
    std::vector<char> buffer;
    ByteWindow window(source, buffer);
    std::uint64_t line = 0;
    std::string fault;  // of the row before, which is a cut one only where it is the last
    std::uint64_t fault_line = 0;
    bool closed = true;
    while (const auto text = window.line()) {
      ++line;
      auto rest = *text;
      const auto first = next_word(rest);
      if (first.empty()) continue;
      if (!fault.empty()) throw FormatError("{}: line {}: {}", path_, fault_line, fault);
      if (first.starts_with('#')) {
        if (table_.times.empty()) header_.add(text->substr(text->find('#')));
        continue;
      }
      closed = window.closed();
      fault = closed ? add(*text) : "expected a line end, found the end of the file";
      fault_line = line;
    }
    if (!fault.empty()) {
      if (table_.times.empty() && closed)
        throw FormatError("{}: line {}: {}", path_, fault_line, fault);
      table_.problems.push_back(one_line(
          fmt::format("{}: line {}: {}: the last row is left out", path_, fault_line, fault)));
    }
    if (!source.cut().empty()) table_.problems.push_back(path_ + ": " + source.cut());
    finish_points();
    return std::move(table_);
  }

 private:
  /// Adds a row; says what is wrong with it instead.
  std::string add(std::string_view text) {
    if (auto fault = row_.parse(text); !fault.empty()) return fault;
    const auto& leaves = row_.leaves;
    if (header_.add_names(row_)) return {};
    if (leaves.front().depth > 0 || !leaves.front().is_number)
      return fmt::format("expected a time, found '{}'", leaves.front().text.substr(0, 40));
    if (table_.times.empty()) begin();
    if (leaves.size() != table_.columns.size() + 1)
      return fmt::format("expected {} values, found {}", table_.columns.size() + 1, leaves.size());
    for (std::size_t c = 0; c < table_.columns.size(); ++c)
      if (!is_word_[c] && !leaves[c + 1].is_number)
        return fmt::format("expected a number for '{}', found '{}'", table_.columns[c].title,
                           leaves[c + 1].text.substr(0, 40));
    const double time = leaves.front().number;
    if (header_.over_time && !table_.times.empty() && time < table_.times.back()) {
      if (!went_back_)
        table_.problems.push_back(
            fmt::format("{}: time goes back from {} to {}: the later rows are taken", path_,
                        table_.times.back(), time));
      went_back_ = true;
      drop_from(table_, time);
    }
    table_.times.push_back(time);
    for (std::size_t c = 0; c < table_.columns.size(); ++c) {
      auto& column = table_.columns[c];
      const auto& leaf = leaves[c + 1];
      const bool lost = column.point && leaf.number < not_found;
      if (is_word_[c])
        column.words.emplace_back(leaf.text);
      else
        column.values.push_back(lost ? std::numeric_limits<double>::quiet_NaN() : leaf.number);
    }
    return {};
  }

  /// The columns, from the shape of the first row.
  void begin() {
    const auto& leaves = row_.leaves;
    const std::size_t items = leaves.back().item;  // the time is item 0
    auto titles = header_.titles;
    const bool probes = !header_.points.empty();
    if (probes && items != header_.points.size())
      throw FormatError("{}: expected a value for each of {} probes, found {}", path_,
                        header_.points.size(), items);
    const bool told = titles.size() == items && header_.title_lines <= 1;
    titles.resize(items);
    table_.columns.clear();
    is_word_.clear();
    for (std::size_t k = 0; k < items; ++k)
      if (probes)
        titles[k] = fmt::format("probe {}", k);
      else if (!told)
        titles[k] = fmt::format("column {}", k + 2);
    for (std::size_t l = 1; l < leaves.size(); ++l) {
      FoamTable::Column column;
      const std::size_t item = leaves[l].item - 1;
      column.title = leaf_title(titles[item], leaves[l]);
      if (probes) column.point = item;
      table_.columns.push_back(std::move(column));
      is_word_.push_back(!leaves[l].is_number);
    }
  }

  /// A probe without one value is outside the mesh, whatever the header says.
  void finish_points() {
    table_.points = std::move(header_.points);
    for (std::size_t p = 0; p < table_.points.size(); ++p) {
      auto& point = table_.points[p];
      for (const auto& column : table_.columns)
        if (column.point == p)
          point.found = std::any_of(column.values.begin(), column.values.end(),
                                    [](double value) { return std::isfinite(value); });
      if (!point.found)
        table_.problems.push_back(fmt::format("{}: probe {} at ({} {} {}) is outside the mesh: nan",
                                              path_, p, point.place[0], point.place[1],
                                              point.place[2]));
    }
  }

  std::string path_;
  Header header_;
  FoamRow row_;
  std::vector<bool> is_word_;
  FoamTable table_;
  bool went_back_ = false;
};

}  // namespace

const FoamTable::Column* FoamTable::find(std::string_view title) const {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const Column& column) { return column.title == title; });
  return found == columns.end() ? nullptr : &*found;
}

void drop_from(FoamTable& table, double time) {
  const auto first =
      std::find_if(table.times.begin(), table.times.end(), [time](double t) { return t >= time; });
  const auto kept = static_cast<std::size_t>(first - table.times.begin());
  table.times.resize(kept);
  for (auto& column : table.columns) {
    column.values.resize(std::min(kept, column.values.size()));
    column.words.resize(std::min(kept, column.words.size()));
  }
}

FoamTable read_foam_table(const std::string& path) { return TableReader(path).read(); }

bool is_foam_table(const std::string& path) {
  const std::string head = read_head(path);
  std::string_view text = head;
  while (text.starts_with('#')) {
    auto line = text.substr(1, text.find('\n') - 1);
    const auto first = next_word(line);
    if (is_time(first) || (first == "Probe" && line.find('(') != line.npos)) return true;
    const auto end = text.find('\n');
    if (end == text.npos) return false;
    text.remove_prefix(end + 1);
  }
  return false;
}

}  // namespace bedscope::readers
