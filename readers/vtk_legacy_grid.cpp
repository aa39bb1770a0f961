// SPDX-License-Identifier: BSD-3-Clause
// Cells and their values in a legacy VTK file.
#include <algorithm>
#include <array>
#include <functional>

#include "readers/error.hpp"
#include "readers/vtk_common.hpp"
#include "readers/vtk_grid.hpp"
#include "readers/vtk_legacy_walk.hpp"

namespace bedscope::readers {
namespace {

using namespace vtk_legacy_file;

constexpr double polyhedron = 42;

class LegacyGrid : public VtkGrid {
 public:
  explicit LegacyGrid(const std::string& path) : path_(path) {
    std::vector<char> buffer;
    LegacyWalk walk(path_, buffer);
    LegacyCells found;
    std::array<std::vector<double>, 3> axes;
    for (std::size_t a = 0; a < 3; ++a) walk.want(static_cast<int>(a), axes[a]);
    walk.want(found);
    walk.run();
    time = walk.time();
    binary = walk.binary();
    for (const auto& [name, components] : found.arrays) fields.push_back({name, components});
    cells_.points = points_of(axes, path_);
    cells_.resolution = resolution_of(cells_.points, !binary, walk.single_points());
    cells_.types = std::move(found.types);
    if (!found.ghosts.empty()) {
      cells_.ghosts.resize(found.ghosts.size());
      mark_ghosts("vtkGhostType", found.ghosts, 0, cells_.ghosts);
    }
    if (found.offsets_form)
      take_offsets(found);
    else
      take_counts(found);
    split_polyhedra();
  }

  bool has_volumes() const {
    return std::any_of(cells_.types.begin(), cells_.types.end(), is_volume);
  }

  std::uint64_t mesh_mark() const override {
    std::uint64_t mark = 0;
    const auto add = [&](const auto& numbers) {
      mark =
          mark * 31 + std::hash<std::string_view>{}({reinterpret_cast<const char*>(numbers.data()),
                                                     numbers.size() * sizeof(numbers.front())});
    };
    add(cells_.points);
    for (const auto* list : {&cells_.connectivity, &cells_.ends, &cells_.types, &cells_.faces})
      add(*list);
    return mark * 31 + std::hash<std::vector<bool>>{}(cells_.ghosts);
  }

  std::vector<VtkCells> pieces() const override { return {cells_}; }

  std::vector<std::vector<double>> read(const Field& field) const override {
    std::vector<char> buffer;
    LegacyWalk walk(path_, buffer);
    LegacyCells found;
    walk.want(found, field.name);
    walk.run();
    if (found.values.size() != field.components || found.types.size() != cells_.types.size())
      throw FormatError("{}: array {}: the file has changed since it was opened", path_,
                        field.name);
    if (!cells_.ghosts.empty())
      for (auto& column : found.values) drop_ghosts(cells_.ghosts, column);
    return std::move(found.values);
  }

 private:
  void take_offsets(LegacyCells& found) {
    if (found.offsets.size() != cells_.types.size() + 1 && !cells_.types.empty())
      throw FormatError("{}: {} offsets of cells, {} types", path_, found.offsets.size(),
                        cells_.types.size());
    cells_.connectivity = std::move(found.stream);
    if (!found.offsets.empty()) cells_.ends.assign(found.offsets.begin() + 1, found.offsets.end());
  }

  // Until 5.0 each cell begins with its number of points.
  void take_counts(const LegacyCells& found) {
    const auto& stream = found.stream;
    std::size_t at = 0;
    for (std::size_t cell = 0; cell < cells_.types.size(); ++cell) {
      const double count = at < stream.size() ? stream[at++] : -1;
      if (!(count >= 0 && count <= static_cast<double>(stream.size() - at)))
        throw FormatError("{}: CELLS: cell {}: {} points, the list has {} more numbers", path_,
                          cell, count, stream.size() - at);
      const auto first = stream.begin() + static_cast<std::ptrdiff_t>(at);
      at += static_cast<std::size_t>(count);
      cells_.connectivity.insert(cells_.connectivity.end(), first,
                                 stream.begin() + static_cast<std::ptrdiff_t>(at));
      cells_.ends.push_back(static_cast<double>(cells_.connectivity.size()));
    }
  }

  // What stands for the points of a polyhedron is its list of faces.
  void split_polyhedra() {
    if (std::find(cells_.types.begin(), cells_.types.end(), polyhedron) == cells_.types.end())
      return;
    cells_.faces = cells_.connectivity;
    cells_.face_ends = cells_.ends;
  }

  std::string path_;
  VtkCells cells_;
};

}  // namespace

std::shared_ptr<const VtkGrid> open_legacy_grid(const std::string& path) {
  auto grid = std::make_shared<LegacyGrid>(path);
  return grid->has_volumes() ? grid : nullptr;
}

}  // namespace bedscope::readers
