// SPDX-License-Identifier: BSD-3-Clause
// What an open case keeps; openfoam_times.cpp, openfoam_ranks.cpp and openfoam_cloud.cpp fill it.
#pragma once

#include <map>
#include <mutex>

#include "readers/openfoam_case.hpp"
#include "readers/openfoam_cloud.hpp"
#include "readers/openfoam_folders.hpp"

namespace bedscope::readers {

// A mesh together with where the cells of each rank go.
struct RankedMesh {
  Mesh mesh;
  std::vector<std::size_t> cells;          // of each rank
  std::vector<std::vector<FoamRun>> runs;  // of each rank's cells, where they are in the case
};

struct OpenFoamCase::Impl {
  std::string root;
  std::string region;  // with a "/" behind it, or empty
  std::vector<FoamFolder> folders;
  std::size_t ranks = 0;
  std::vector<GasTime> times;
  std::vector<std::string> regions;
  std::vector<std::string> problems;
  std::map<std::string, std::string, std::less<>> classes;  // of the fields, by name
  bool moving = false;
  std::shared_ptr<const RankedMesh> start;  // the mesh at the first time
  // Faces and points are needed by clouds only: read when the first asks.
  mutable std::mutex clouds_mutex;
  mutable std::shared_ptr<const std::vector<CloudMesh>> clouds_start;

  std::string shown(std::string_view relative) const {
    return fmt::format("{}/{}", root, relative);
  }
  std::string time_folder(std::size_t time) const { return times[time].name + "/" + region; }
  std::string cloud_path(std::size_t time, std::string_view cloud) const;

  // The path of a file of a folder; where there is none, the plain name, which Source refuses.
  static std::string path_in(const FoamFolder& folder, const std::string& relative) {
    const auto path = folder.path + "/" + relative;
    const auto found = plain_or_gz(path);
    return found.empty() ? path : found;
  }

  // Calls what(rank, file) with the file open at the block of each rank.
  template <class What>
  void for_each_rank(const std::string& relative, What&& what) const {
    for (const auto& folder : folders) for_ranks_of(folder, path_in(folder, relative), what);
  }
  template <class What>
  static void for_ranks_of(const FoamFolder& folder, const std::string& path, What&& what) {
    FoamBlocks file(path);
    if (folder.collated != file.collated())
      throw FormatError("{}: expected class {}, found {}", file.stream().path(),
                        folder.collated ? "decomposedBlockData" : "of one block",
                        file.header().class_name);
    for (std::size_t k = 0; k < folder.ranks; ++k) {
      if (!file.next())
        throw CutError("{}: expected {} blocks, found {}", file.stream().path(), folder.ranks, k);
      try {
        what(folder.first_rank + k, file);
      } catch (const FormatError& error) {
        if (!folder.collated) throw;
        file.close();  // a wrong length of the block is the better explanation
        throw FormatError("{} (block {})", error.what(), k);
      }
    }
    if (folder.collated && file.next())
      throw FormatError("{}: expected {} blocks, found more", file.stream().path(), folder.ranks);
  }

  void find_regions();
  void count_ranks();
  void tell_empty_cells();
  void find_times();
  void find_fields();
  std::string class_of(const std::string& field) const;
  void tell_missing();
  void check_last_time();
  std::string why_clouds_are_cut(const OpenFoamCase& foam) const;
  std::string mesh_file(const FoamFolder& folder, std::size_t time, std::string_view name) const;
  OpenMeshFile mesh_opener(const FoamFolder& folder, std::size_t block, std::size_t time) const;
  bool has_mesh() const;
  std::shared_ptr<const RankedMesh> read_mesh(std::size_t time) const;
  std::shared_ptr<const std::vector<CloudMesh>> cloud_meshes(std::size_t time) const;
  void read_addresses(std::size_t time, RankedMesh& mesh) const;
  std::shared_ptr<const RankedMesh> mesh_at(std::size_t time) const {
    return moving ? read_mesh(time) : start;
  }
};

}  // namespace bedscope::readers
