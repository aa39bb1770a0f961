// SPDX-License-Identifier: BSD-3-Clause
// The cells of a mesh as bodies that a grid can cut.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "analysis/cell_cutter.hpp"
#include "readers/openfoam_mesh.hpp"

namespace bedscope::analysis {

/// The surface of each cell in triangles, in the axes of the grid. `mesh` must outlive it.
class CellShapes {
 public:
  /// A place along lateral, depth or up [m] where it is to be taken as.
  using Snap = std::function<double(int axis, double x)>;
  CellShapes(const readers::PolyMesh& mesh, const std::array<int, 3>& axes, const Snap& snap);

  /// Gives a cell to the cutter, which is to finish it. Faces of more than three points are cut
  /// into triangles about the average of their points, as OpenFOAM does (primitiveMesh, v1912).
  void cut(std::size_t cell, double volume, CellCutter& cutter) const;

 private:
  struct Side {
    std::int32_t face = 0;
    bool outward = true;
  };
  const Vec3& point(std::int32_t label) const { return points_[static_cast<std::size_t>(label)]; }

  const readers::PolyMesh& mesh_;
  std::vector<Vec3> points_;
  std::vector<std::size_t> starts_;  // of each cell's sides
  std::vector<Side> sides_;
};

}  // namespace bedscope::analysis
