// SPDX-License-Identifier: BSD-3-Clause
#include "readers/vtk_gas_files.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "readers/error.hpp"
#include "readers/file_index.hpp"
#include "readers/source.hpp"
#include "readers/vtk_grid.hpp"

namespace bedscope::readers {
namespace {

namespace fs = std::filesystem;

// What a folder offers, by the ends of the names: dumps of another kind are not even opened.
struct Offer {
  std::vector<std::string> lists;    // .series, .pvd
  std::vector<std::string> indices;  // .vtm, .pvtu
  std::vector<std::string> xml, legacy;
};

Offer offer_of(const std::string& folder) {
  Offer offer;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error);
       !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const auto path = entry->path().string();
    const auto ends = [&](std::string_view end) { return path.ends_with(end); };
    auto* to = ends(".series") || ends(".pvd") ? &offer.lists
               : ends(".vtm") || ends(".pvtu") ? &offer.indices
               : ends(".vtu")                  ? &offer.xml
               : ends(".vtk")                  ? &offer.legacy
                                               : nullptr;
    if (to != nullptr) to->push_back(path);
  }
  if (error) throw FileError("{}: {}", folder, error.message());
  for (auto* list : {&offer.lists, &offer.indices, &offer.xml, &offer.legacy})
    std::sort(list->begin(), list->end());
  return offer;
}

bool holds_grid(const std::string& path) { return is_vtk_grid(read_head(path)); }

/// Those of the files of an instant that hold cells: the pieces of processors, or the one block.
std::vector<std::string> grids_of(const IndexedSnapshot& snapshot) {
  std::vector<std::string> grids, blocks;
  for (const auto& file : snapshot.files) {
    if (file.path.ends_with(".vtp") || !holds_grid(file.path)) continue;  // patches of the boundary
    grids.push_back(file.path);
    if (file.label.starts_with("block")) blocks.push_back(file.path);
  }
  if (blocks.size() > 1)
    throw InputError("{}: several meshes, name one of {}", snapshot.files.front().index,
                     fmt::join(blocks, ", "));
  return grids;
}

std::vector<VtkGasTime> times_of(const FileIndex& index) {
  if (!index.error.empty()) throw FormatError("{}", index.error);
  std::vector<VtkGasTime> times;
  for (const auto& snapshot : index.snapshots)
    if (auto grids = grids_of(snapshot); !grids.empty())
      times.push_back({snapshot.time, std::move(grids)});
  return times;
}

FileIndex index_at(const std::string& path) {
  const auto* form = index_form(read_head(path));
  if (form == nullptr) return {};
  return read_index(path, *form);
}

/// Does an index lead to cells? One that is damaged may.
bool may_lead_to_cells(const FileIndex& index) {
  if (!index.error.empty()) return true;
  return !index.snapshots.empty() && !grids_of(index.snapshots.front()).empty();
}

std::vector<VtkGasTime> by_list(const std::string& folder, const Offer& offer,
                                std::vector<std::string>& problems) {
  std::vector<std::string> lists;
  FileIndex used;
  for (const auto& path : offer.lists) {
    auto index = index_at(path);
    if (!may_lead_to_cells(index)) continue;
    lists.push_back(path);
    used = std::move(index);
  }
  if (lists.empty()) return {};
  if (lists.size() > 1)
    throw InputError("{}: several lists of times, name one of {}", folder, fmt::join(lists, ", "));
  for (auto& note : used.notes) problems.push_back(note);
  if (!used.cut.empty()) problems.push_back(used.cut);
  const std::set<std::string> named(used.named.begin(), used.named.end());
  const auto& files = offer.indices.empty() ? offer.legacy : offer.indices;
  const auto more = std::count_if(files.begin(), files.end(), [&](const auto& file) {
    return !named.contains(fs::path(file).lexically_normal().string());
  });
  if (more > 0)
    problems.push_back(
        fmt::format("{} does not name {} of the {} files beside it: these are not read",
                    lists.front(), more, files.size()));
  return times_of(used);
}

std::vector<VtkGasTime> of_folder(const std::string& folder, std::vector<std::string>& problems) {
  const auto offer = offer_of(folder);
  auto times = by_list(folder, offer, problems);
  if (!times.empty()) return times;
  for (const auto& path : offer.indices)
    for (auto& time : times_of(index_at(path))) times.push_back(std::move(time));
  if (!times.empty()) return times;
  for (const auto* files : {&offer.xml, &offer.legacy}) {
    for (const auto& path : *files)
      if (holds_grid(path)) times.push_back({unknown, {path}});
    if (!times.empty()) return times;
  }
  throw InputError("{}: expected an OpenFOAM case or VTK files with cells, found none", folder);
}

}  // namespace

std::vector<VtkGasTime> vtk_gas_files(const std::string& path, std::vector<std::string>& problems) {
  std::error_code error;
  if (fs::is_directory(path, error)) return of_folder(path, problems);
  auto index = index_at(path);
  for (auto& note : index.notes) problems.push_back(note);
  if (!index.cut.empty()) problems.push_back(index.cut);
  auto times = times_of(index);
  if (times.empty() && holds_grid(path)) times.push_back({unknown, {path}});
  if (times.empty())
    throw InputError("{}: expected an OpenFOAM case or VTK files with cells, found none", path);
  return times;
}

std::string first_vtk_grid(const std::string& path) {
  constexpr std::size_t tried = 8;  // of each kind
  std::error_code error;
  const auto by_index = [&](const std::string& file) {
    const auto index = index_at(file);
    if (!index.error.empty()) return file;  // whoever opens it is told
    if (index.snapshots.empty()) return std::string();
    for (const auto& named : index.snapshots.front().files)
      if (!named.path.ends_with(".vtp") && holds_grid(named.path)) return named.path;
    return std::string();
  };
  if (!fs::is_directory(path, error)) {
    if (!fs::is_regular_file(path, error)) return {};
    return holds_grid(path) ? path : by_index(path);
  }
  const auto offer = offer_of(path);
  for (const auto* files : {&offer.lists, &offer.indices, &offer.xml, &offer.legacy})
    for (std::size_t k = 0; k < std::min(tried, files->size()); ++k) {
      const auto& file = (*files)[k];
      const auto found = files == &offer.lists || files == &offer.indices
                             ? by_index(file)
                             : (holds_grid(file) ? file : std::string());
      if (!found.empty()) return found;
    }
  return {};
}

}  // namespace bedscope::readers
