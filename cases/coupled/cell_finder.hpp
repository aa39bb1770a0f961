// SPDX-License-Identifier: GPL-3.0-or-later
// The cell of the gas mesh in which a point is.
#pragma once

#include <array>
#include <vector>

#include "cases/coupled/settings.hpp"

namespace bedscope::coupled {

/// Convex cells of one rank's part of the mesh, as bare numbers.
struct MeshGeometry {
  struct Plane {  ///< of a face: inside where normal . x <= offset; normal of unit length
    Vec3 normal;
    double offset;
  };
  std::vector<Vec3> low, high;   ///< bounding box of each cell [m]
  std::vector<int> first_plane;  ///< of each cell, and one past the last
  std::vector<Plane> planes;
  std::vector<double> volume;  ///< [m3]
  int cells() const { return int(volume.size()); }
};

/// A grid of bins as large as the mesh's typical cell, each with the cells that reach into it. On a
/// mesh of equal boxes a bin is a cell, and finding it one division an axis; elsewhere (bend,
/// grading) the planes of the few candidates decide.
class CellFinder {
 public:
  explicit CellFinder(MeshGeometry mesh);

  /// The cell, or -1 outside of this rank's mesh.
  int find(const Vec3& point) const {
    const int bin = bin_of(point);
    if (bin < 0) return -1;
    const int sole = sole_[bin];
    return sole >= -1 ? sole : decide(bin, point);
  }

  /// The cell that holds the whole cube of this half edge, where that is known at once; else -1.
  int holds(const Vec3& centre, double half) const;

  const Vec3& low() const { return low_; }
  const Vec3& high() const { return high_; }
  const MeshGeometry& mesh() const { return mesh_; }

 private:
  int bin_of(const Vec3& point) const {
    int index[3];
    for (int a = 0; a < 3; ++a) {
      const double at = (point[a] - low_[a]) * inverse_[a];
      if (!(at >= 0 && at <= bins_[a])) return -1;
      index[a] = int(at);
      if (index[a] == bins_[a]) --index[a];
    }
    return (index[2] * bins_[1] + index[1]) * bins_[0] + index[0];
  }
  int decide(int bin, const Vec3& point) const;

  MeshGeometry mesh_;
  Vec3 low_{}, high_{}, inverse_{};
  std::array<int, 3> bins_{};
  std::vector<int> sole_;  ///< of each bin: the cell that fills it, -1 none, -2 several candidates
  std::vector<int> first_, candidates_;
};

}  // namespace bedscope::coupled
