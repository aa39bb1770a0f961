// SPDX-License-Identifier: BSD-3-Clause
// A table that restarts have spread over start-time directories and files with a suffix.
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "readers/error.hpp"
#include "readers/numbers.hpp"
#include "readers/openfoam_folders.hpp"
#include "readers/openfoam_row.hpp"
#include "readers/openfoam_tables.hpp"

namespace bedscope::readers {
namespace {

namespace fs = std::filesystem;

/// The files of each table, in the order of their starts.
using Tables = std::map<std::string, std::vector<std::string>>;

/// The tables of one start-time directory: "p" and "p_0.5" are one, started again at 0.5.
void add_directory(const std::string& folder, Tables& tables) {
  std::set<std::string> names;
  std::map<std::string, std::map<double, std::string>> found;
  std::error_code error;
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.is_regular_file() && is_foam_table(entry.path().string()))
      paths.push_back(entry.path().string());
  if (error) throw FileError("{}: {}", folder, error.message());
  for (const auto& path : paths) names.insert(field_name(path));
  for (const auto& path : paths) {
    const auto name = field_name(path);
    const auto bar = name.rfind('_');
    double start = 0;
    const bool again = bar != name.npos && names.contains(name.substr(0, bar)) &&
                       parse_number(name.data() + bar + 1, name.data() + name.size(), start);
    // The first one has no suffix; its directory tells its start.
    found[again ? name.substr(0, bar) : name][again ? start : -1] = path;
  }
  for (const auto& [name, files] : found)
    for (const auto& [start, path] : files) tables[name].push_back(path);
}

Tables find_tables(const std::string& folder) {
  Tables tables;
  for (const auto& start : time_directories(folder))
    add_directory((fs::path(folder) / start.name).string(), tables);
  if (tables.empty()) add_directory(folder, tables);
  return tables;
}

void join(FoamTable& all, FoamTable&& later) {
  for (auto& text : later.problems) all.problems.push_back(std::move(text));
  all.files.push_back(later.files.front());
  if (later.times.empty()) return;
  drop_from(all, later.times.front());
  if (all.times.empty()) {
    all.points = std::move(later.points);
    all.times = std::move(later.times);
    all.columns = std::move(later.columns);
    return;
  }
  const auto same = [](const FoamTable::Column& a, const FoamTable::Column& b) {
    return a.title == b.title && a.words.empty() == b.words.empty();
  };
  const auto same_place = [](const FoamTable::Point& a, const FoamTable::Point& b) {
    return a.place == b.place;
  };
  if (!std::equal(all.points.begin(), all.points.end(), later.points.begin(), later.points.end(),
                  same_place))
    throw FormatError("{}: expected the probes of {}, found others", later.files.front(),
                      all.files.front());
  if (!std::equal(all.columns.begin(), all.columns.end(), later.columns.begin(),
                  later.columns.end(), same))
    throw FormatError("{}: expected the columns of {}, found others", later.files.front(),
                      all.files.front());
  all.times.insert(all.times.end(), later.times.begin(), later.times.end());
  for (std::size_t c = 0; c < all.columns.size(); ++c) {
    auto &to = all.columns[c], &from = later.columns[c];
    to.values.insert(to.values.end(), from.values.begin(), from.values.end());
    to.words.insert(to.words.end(), from.words.begin(), from.words.end());
  }
}

}  // namespace

FoamTable open_foam_table(const std::string& path, const std::string& name) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return read_foam_table(path);
  const auto tables = find_tables(path);
  std::vector<std::string> names;
  for (const auto& [found, files] : tables) names.push_back(found);
  if (names.empty())
    throw InputError("{}: expected tables of OpenFOAM's postProcessing, found none", path);
  if (name.empty() && names.size() > 1)
    throw InputError("{}: expected one table, found {}", path, fmt::join(names, ", "));
  const auto found = tables.find(name.empty() ? names.front() : name);
  if (found == tables.end())
    throw InputError("{}: expected a table \"{}\", found {}", path, name, fmt::join(names, ", "));
  FoamTable table = read_foam_table(found->second.front());
  for (std::size_t i = 1; i < found->second.size(); ++i)
    join(table, read_foam_table(found->second[i]));
  return table;
}

}  // namespace bedscope::readers
