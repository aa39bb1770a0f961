// SPDX-License-Identifier: BSD-3-Clause
// The parts of a body with plane faces in the cells of a grid.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "analysis/grid.hpp"

namespace bedscope::analysis {

/// Cuts tetrahedra along the planes of a grid and adds up what lies in each cell. A body is given
/// as tetrahedra from any one point to the triangles of its surface: those that reach outside it
/// count as negative and cancel, so that it need not be convex.
class CellCutter {
 public:
  explicit CellCutter(const Grid& grid) : grid_(grid) {}

  /// A new body, anywhere between `low` and `high` [m]; tetrahedra of up to `negligible` [m3] are
  /// left out.
  void begin(const Vec3& low, const Vec3& high, double negligible);
  /// The tetrahedron of an apex and a triangle that is seen counter-clockwise from outside.
  void add(const std::array<Vec3, 4>& tetrahedron);
  /// The shares of the body in the cells of the grid, those above 1e-12, and what share of it that
  /// is.
  const std::vector<std::pair<std::size_t, double>>& finish();
  double inside() const { return inside_; }

 private:
  using Tetrahedron = std::array<Vec3, 4>;
  void cut(const Tetrahedron& body, int axis);
  void take(const Tetrahedron& body);
  int slab_of(int axis, double x) const;

  const Grid& grid_;
  std::array<int, 3> first_{}, size_{};  // of the cells about the body
  std::array<int, 3> at_{};              // the cell that is being cut out
  double negligible_ = 0, sign_ = 1, volume_ = 0, inside_ = 0;
  std::vector<double> sums_;
  std::vector<std::pair<std::size_t, double>> parts_;
};

}  // namespace bedscope::analysis
