// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_folders.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "readers/numbers.hpp"

namespace bedscope::readers {
namespace {

namespace fs = std::filesystem;

bool whole_number(std::string_view text, std::size_t& value) {
  std::int64_t number = 0;
  bool overflow = false;
  if (text.empty() || text[0] < '0' || text[0] > '9' || !parse_integer(text, number, overflow))
    return false;
  value = static_cast<std::size_t>(number);
  return true;
}

std::vector<std::string> directories(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (auto entry = fs::directory_iterator(folder, error);
       !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code unreadable;
    if (entry->is_directory(unreadable)) names.push_back(entry->path().filename().string());
  }
  if (error) throw FileError("{}: {}", folder, error.message());
  std::sort(names.begin(), names.end());
  return names;
}

// "processors4", "processors4_0-1", "processors"
bool collated_folder(std::string_view name, FoamFolder& folder, std::size_t& ranks_in_all) {
  if (!name.starts_with("processors")) return false;
  name.remove_prefix(10);
  ranks_in_all = 0;
  folder.collated = true;
  folder.first_rank = folder.ranks = 0;
  if (name.empty()) return true;
  const auto bar = name.find('_');
  if (!whole_number(name.substr(0, bar), ranks_in_all) || ranks_in_all == 0) return false;
  folder.ranks = ranks_in_all;
  if (bar == std::string_view::npos) return true;
  const auto range = name.substr(bar + 1);
  const auto dash = range.find('-');
  std::size_t last = 0;
  if (dash == std::string_view::npos || !whole_number(range.substr(0, dash), folder.first_rank) ||
      !whole_number(range.substr(dash + 1), last) || last < folder.first_rank)
    return false;
  folder.ranks = last - folder.first_rank + 1;
  return true;
}

struct Ranks {
  std::vector<FoamFolder> separate;
  std::map<std::size_t, std::vector<FoamFolder>> collated;  // by the number of ranks in all
};

// Every rank once, from 0 on.
void check_complete(std::vector<FoamFolder>& folders, const std::string& root,
                    std::size_t ranks_in_all) {
  std::sort(folders.begin(), folders.end(),
            [](const auto& a, const auto& b) { return a.first_rank < b.first_rank; });
  std::size_t next = 0;
  for (const auto& folder : folders) {
    if (folder.first_rank != next)
      throw FormatError("{}: expected processor {}, found {}", root, next,
                        fs::path(folder.path).filename().string());
    next += folder.ranks;
  }
  if (ranks_in_all > 0 && next != ranks_in_all)
    throw FormatError("{}: expected {} processors, found {}", root, ranks_in_all, next);
}

Ranks find_ranks(const std::string& root) {
  Ranks found;
  for (const auto& name : directories(root)) {
    FoamFolder folder{(fs::path(root) / name).string(), 0, 1, false};
    std::size_t ranks_in_all = 0;
    if (collated_folder(name, folder, ranks_in_all))
      found.collated[ranks_in_all].push_back(folder);
    else if (name.starts_with("processor") &&
             whole_number(std::string_view(name).substr(9), folder.first_rank))
      found.separate.push_back(folder);
  }
  return found;
}

std::string shown(const std::vector<FoamFolder>& folders) {
  auto first = fs::path(folders.front().path).filename().string();
  if (folders.size() == 1) return first;
  return first + ".." + std::to_string(folders.back().first_rank);
}

// The one kind of ranks there is, or an error that names the choice.
std::vector<FoamFolder> one_kind(Ranks ranks, const std::string& root, Decomposition wanted) {
  if (wanted == Decomposition::separate) ranks.collated.clear();
  if (wanted == Decomposition::collated) ranks.separate.clear();
  for (auto& [in_all, folders] : ranks.collated) check_complete(folders, root, in_all);
  check_complete(ranks.separate, root, 0);
  if (ranks.collated.size() > 1)
    throw InputError("{}: both {} and {} present: expected one decomposition", root,
                     shown(ranks.collated.begin()->second), shown(ranks.collated.rbegin()->second));
  if (!ranks.collated.empty() && !ranks.separate.empty())
    throw InputError(
        "{}: both {} and {} present: decomposition = \"collated\" or \"separate\" picks one", root,
        shown(ranks.collated.begin()->second), shown(ranks.separate));
  if (!ranks.collated.empty()) return ranks.collated.begin()->second;
  if (ranks.separate.empty()) throw InputError("{}: expected processor folders, found none", root);
  return ranks.separate;
}

bool includes(const std::vector<FoamTimeName>& all, const std::vector<FoamTimeName>& some) {
  return std::all_of(some.begin(), some.end(), [&](const auto& time) {
    return std::any_of(all.begin(), all.end(),
                       [&](const auto& other) { return other.value == time.value; });
  });
}

}  // namespace

std::vector<FoamFolder> find_folders(const std::string& root, Decomposition wanted) {
  std::vector<FoamFolder> whole{{root, 0, 1, false}};
  auto ranks = find_ranks(root);
  const bool decomposed = !ranks.separate.empty() || !ranks.collated.empty();
  if (wanted == Decomposition::reconstructed) return whole;
  if (wanted != Decomposition::automatic) return one_kind(std::move(ranks), root, wanted);
  if (!decomposed) return whole;
  const auto times = time_directories(root);
  std::vector<FoamTimeName> of_ranks;
  for (const auto& folder : ranks.separate)
    for (auto& time : time_directories(folder.path)) of_ranks.push_back(std::move(time));
  for (const auto& [in_all, folders] : ranks.collated)
    for (const auto& folder : folders)
      for (auto& time : time_directories(folder.path)) of_ranks.push_back(std::move(time));
  if (!times.empty() && includes(times, of_ranks)) return whole;
  // Only the start is there: nobody has reconstructed.
  if (times.size() <= 1 || includes(of_ranks, times))
    return one_kind(std::move(ranks), root, Decomposition::processors);
  throw InputError(
      "{}: some times are only in the case, others only in its processor folders: "
      "decomposition = \"reconstructed\" or \"processors\" picks one",
      root);
}

std::vector<std::string> openfoam_regions(const std::string& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return {};
  // Where it will be read: the mesh that regions were split from stays in the whole case only.
  std::vector<std::string> roots;
  try {
    roots.push_back(find_folders(folder, Decomposition::automatic).front().path);
  } catch (const Error&) {  // told when the case is opened
  }
  // The ranks have the regions of the whole case, which may have no mesh of its own.
  auto ranks = find_ranks(folder);
  roots.push_back(folder);
  if (!ranks.separate.empty()) roots.push_back(ranks.separate.front().path);
  if (!ranks.collated.empty()) roots.push_back(ranks.collated.begin()->second.front().path);
  for (const auto& root : roots) {
    std::vector<std::string> regions;
    const fs::path constant = root + "/constant";
    if (!fs::is_directory(constant, error)) continue;
    if (fs::is_directory(constant / "polyMesh", error)) regions.emplace_back();
    for (const auto& name : directories(constant.string()))
      if (fs::is_directory(constant / name / "polyMesh", error)) regions.push_back(name);
    if (!regions.empty()) return regions;
  }
  return {};
}

bool is_openfoam_case(const std::string& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return false;
  if (fs::is_regular_file(folder + "/system/controlDict", error)) return true;
  try {
    const auto times = time_directories(folder);
    return !openfoam_regions(folder).empty() ||
           std::any_of(times.begin(), times.end(), [&](const auto& time) {
             std::error_code ignored;
             return fs::is_directory(fmt::format("{}/{}/lagrangian", folder, time.name), ignored);
           });
  } catch (const Error&) {
    return false;
  }
}

std::vector<FoamTimeName> time_directories(const std::string& folder) {
  std::vector<FoamTimeName> times;
  for (auto& name : directories(folder)) {
    double value = 0;
    if (parse_number(name.data(), name.data() + name.size(), value) && std::isfinite(value))
      times.push_back({std::move(name), value});
  }
  std::sort(times.begin(), times.end(),
            [](const auto& a, const auto& b) { return a.value < b.value; });
  for (std::size_t t = 1; t < times.size(); ++t)
    if (times[t].value == times[t - 1].value)
      throw FormatError("{}: {} and {} are the same time, expected one", folder, times[t - 1].name,
                        times[t].name);
  return times;
}

double true_time(const std::string& directory, const FoamTimeName& name,
                 std::vector<std::string>& problems) {
  const auto path = plain_or_gz(directory + "/uniform/time");
  if (path.empty()) return name.value;
  try {
    const auto text = read_dictionary(path).value("value", path);
    double value = 0;
    if (!text || !parse_number(text->data(), text->data() + text->size(), value)) return name.value;
    // The name may be rounded to its last digit (timePrecision).
    const auto mantissa = name.name.substr(0, name.name.find_first_of("eE"));
    const auto point = mantissa.find('.');
    const auto decimals = point == std::string::npos ? 0 : mantissa.size() - point - 1;
    double digits = 0;
    parse_number(mantissa.data(), mantissa.data() + mantissa.size(), digits);
    const double scale = digits == 0 ? 1 : name.value / digits;
    const double last_digit = std::abs(scale) * std::pow(10.0, -static_cast<double>(decimals));
    if (std::abs(value - name.value) <= last_digit) return value;
    problems.push_back(fmt::format("{}: says {} s, its directory {}: the directory is believed",
                                   path, value, name.name));
  } catch (const Error& error) {
    problems.emplace_back(error.what());
  }
  return name.value;
}

std::string plain_or_gz(const std::string& path) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) return path;
  if (fs::is_regular_file(path + ".gz", error)) return path + ".gz";
  return {};
}

}  // namespace bedscope::readers
