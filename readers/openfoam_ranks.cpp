// SPDX-License-Identifier: BSD-3-Clause
// The meshes of the ranks, put together in the order of the whole case.
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <string_view>

#include "readers/openfoam_case_impl.hpp"
#include "readers/openfoam_tets.hpp"

namespace bedscope::readers {
namespace {

void add_patches(const std::vector<FoamPatch>& of_rank, std::vector<FoamPatch>& all) {
  for (const auto& patch : of_rank) {
    if (patch.type.starts_with("processor")) continue;
    const auto same = std::find_if(all.begin(), all.end(),
                                   [&](const auto& other) { return other.name == patch.name; });
    if (same == all.end())
      all.push_back(patch);
    else
      same->faces += patch.faces;
  }
}

// A patch procBoundary1to2 says that there is a processor 2. Where the last ones are missing and
// the cells of the others have no gaps, nothing else does.
void require_neighbours(const std::vector<FoamPatch>& of_rank, std::size_t ranks,
                        const std::string& folder) {
  for (const auto& patch : of_rank) {
    if (!patch.type.starts_with("processor")) continue;
    const std::string_view name = patch.name;
    const auto to = name.find("to", std::string_view("procBoundary").size());
    std::size_t neighbour = 0;
    if (to != name.npos)
      std::from_chars(name.data() + to + 2, name.data() + name.size(), neighbour);
    if (neighbour >= ranks)
      throw FormatError("{}: borders on processor {} (patch {}), found {} processors", folder,
                        neighbour, patch.name, ranks);
  }
}

}  // namespace

// The newest file of a mesh at or before a time: times with points of their own move the mesh.
std::string OpenFoamCase::Impl::mesh_file(const FoamFolder& folder, std::size_t time,
                                          std::string_view name) const {
  const auto file = fmt::format("{}polyMesh/{}", region, name);
  for (std::size_t t = time + 1; t-- > 0 && moving;) {
    auto found = plain_or_gz(fmt::format("{}/{}/{}", folder.path, times[t].name, file));
    if (!found.empty()) return found;
  }
  return plain_or_gz(fmt::format("{}/constant/{}", folder.path, file));
}

bool OpenFoamCase::Impl::has_mesh() const {
  return !mesh_file(folders.front(), times.size() - 1, "points").empty();
}

void OpenFoamCase::Impl::read_addresses(std::size_t time, RankedMesh& mesh) const {
  std::size_t total = 0, with = 0;
  for (const auto cells : mesh.cells) total += cells;
  std::vector<bool> taken(total);
  mesh.runs.resize(ranks);
  std::vector<std::int32_t> address;
  for (const auto& folder : folders) {
    // That of the mesh at this time: the one of before a refinement names other cells.
    const auto path =
        plain_or_gz((std::filesystem::path(mesh_file(folder, time, "owner")).parent_path() /
                     "cellProcAddressing")
                        .string());
    if (path.empty()) continue;
    FoamBlocks file(path);
    for (std::size_t k = 0; k < folder.ranks; ++k, ++with) {
      const auto rank = folder.first_rank + k;
      if (!file.next()) throw CutError("{}: expected {} blocks, found {}", path, folder.ranks, k);
      read_labels(file.stream(), layout_of(file.header(), path), address);
      if (address.size() != mesh.cells[rank])
        throw FormatError("{}: processor {}: {} cells, its mesh has {}", path, rank, address.size(),
                          mesh.cells[rank]);
      for (const auto cell : address) {
        if (cell < 0 || static_cast<std::size_t>(cell) >= total)
          throw FormatError(
              "{}: processor {} names cell {}, all processors have {}: is one missing?", path, rank,
              cell, total);
        if (taken[static_cast<std::size_t>(cell)])
          throw FormatError("{}: processor {} names cell {} a second time", path, rank, cell);
        taken[static_cast<std::size_t>(cell)] = true;
        auto& runs = mesh.runs[rank];
        if (!runs.empty() && runs.back().place + runs.back().count == cell)
          ++runs.back().count;
        else
          runs.push_back({cell, 1});
      }
    }
  }
  if (with > 0 && with < ranks)
    throw FormatError("{}: expected cellProcAddressing of {} processors, found {}", root, ranks,
                      with);
  if (with > 0) return;
  std::int32_t next = 0;  // rank after rank, the mesh and the fields alike
  for (std::size_t rank = 0; rank < ranks; ++rank) {
    const auto cells = static_cast<std::int32_t>(mesh.cells[rank]);
    if (cells > 0) mesh.runs[rank].push_back({next, cells});
    next += cells;
  }
}

OpenMeshFile OpenFoamCase::Impl::mesh_opener(const FoamFolder& folder, std::size_t block,
                                             std::size_t time) const {
  return [this, &folder, block, time](std::string_view name) -> std::unique_ptr<FoamBlocks> {
    const auto path = mesh_file(folder, time, name);
    if (path.empty() && name == "boundary") return nullptr;
    if (path.empty())
      throw FileError("{}/constant/{}polyMesh/{}: no such file", folder.path, region, name);
    auto file = std::make_unique<FoamBlocks>(path);
    for (std::size_t k = 0; k <= block; ++k)
      if (!file->next()) throw CutError("{}: expected {} blocks, found {}", path, folder.ranks, k);
    return file;
  };
}

std::shared_ptr<const std::vector<CloudMesh>> OpenFoamCase::Impl::cloud_meshes(
    std::size_t time) const {
  const std::lock_guard lock(clouds_mutex);
  if (!moving && clouds_start != nullptr) return clouds_start;
  auto made = std::make_shared<std::vector<CloudMesh>>(ranks);
  for (const auto& folder : folders)
    for (std::size_t k = 0; k < folder.ranks; ++k) {
      auto& mesh = (*made)[folder.first_rank + k];
      mesh.poly = read_poly_mesh(mesh_opener(folder, k, time));
      mesh.centres = cell_geometry(mesh.poly).centres;
      std::unique_ptr<FoamBlocks> base;
      if (!mesh_file(folder, time, "tetBasePtIs").empty())
        base = mesh_opener(folder, k, time)("tetBasePtIs");
      mesh.base = tet_base_points(mesh.poly, mesh.centres, base.get());
    }
  clouds_start = made;
  return made;
}

std::shared_ptr<const RankedMesh> OpenFoamCase::Impl::read_mesh(std::size_t time) const {
  auto made = std::make_shared<RankedMesh>();
  std::vector<CellGeometry> parts(ranks);
  std::vector<MeshPart> faces(ranks);
  std::vector<FoamPatch> patches;
  for (const auto& folder : folders) {
    for (std::size_t k = 0; k < folder.ranks; ++k) {
      auto poly = read_poly_mesh(mesh_opener(folder, k, time));
      if (folder.path != root) require_neighbours(poly.patches, ranks, folder.path);
      add_patches(poly.patches, patches);
      if (ranks == 1) {
        made->cells = {poly.cells};
        made->mesh = make_mesh(std::move(poly));
        made->mesh.patches = std::move(patches);
        return made;
      }
      parts[folder.first_rank + k] = cell_geometry(poly);
      faces[folder.first_rank + k].poly = std::make_shared<const PolyMesh>(std::move(poly));
    }
  }
  for (const auto& part : parts) made->cells.push_back(part.volumes.size());
  read_addresses(time, *made);
  CellGeometry all;
  std::size_t total = 0;
  for (const auto cells : made->cells) total += cells;
  all.centres.resize(total);
  all.volumes.resize(total);
  all.low.resize(total);
  all.high.resize(total);
  for (std::size_t rank = 0; rank < ranks; ++rank) {
    std::ptrdiff_t from = 0;
    for (const auto& run : made->runs[rank]) {
      const auto put = [&](const auto& part, auto& whole) {
        std::copy_n(part.begin() + from, run.count, whole.begin() + run.place);
      };
      put(parts[rank].centres, all.centres);
      put(parts[rank].volumes, all.volumes);
      put(parts[rank].low, all.low);
      put(parts[rank].high, all.high);
      for (std::int32_t k = 0; k < run.count; ++k) faces[rank].cells.push_back(run.place + k);
      from += run.count;
    }
  }
  made->mesh = make_mesh(std::move(all), std::move(faces));
  made->mesh.patches = std::move(patches);
  return made;
}

}  // namespace bedscope::readers
