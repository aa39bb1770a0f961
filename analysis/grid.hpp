// SPDX-License-Identifier: BSD-3-Clause
// The uniform grid onto which particles are mapped, in the bed's own axes.
#pragma once

#include <array>
#include <cstddef>

namespace bedscope::analysis {

/// The bed's axes: lateral (across, drawn to the right), depth (averaged over unless the grid is
/// 3-D), up (against gravity). All arrays of three in `analysis` are in this order.
enum Axis : int { lateral = 0, depth = 1, up = 2 };
using Vec3 = std::array<double, 3>;

/// A uniform grid over the domain. Depth-averaged: cells[depth] == 1 and the front and back of the
/// domain do not cut particles. Cell index: i + cells[0] * (j + cells[1] * k), lateral fastest.
struct Grid {
  Vec3 min{}, max{};                  ///< the domain [m]
  std::array<int, 3> cells{1, 1, 1};  ///< lateral, depth, up
  std::array<bool, 3> periodic{};

  std::size_t size() const {
    return static_cast<std::size_t>(cells[0]) * static_cast<std::size_t>(cells[1]) *
           static_cast<std::size_t>(cells[2]);
  }
  bool depth_averaged() const { return cells[depth] == 1; }
  double length(int axis) const { return max[axis] - min[axis]; }
  double width(int axis) const { return length(axis) / cells[axis]; }  ///< of a cell [m]
  double cell_volume() const { return width(0) * width(1) * width(2); }
  double volume() const { return length(0) * length(1) * length(2); }
  /// Face i of the cells along an axis [m], i = 0 ... cells[axis]; the last is max itself.
  double face(int axis, int i) const {
    return i == cells[axis] ? max[axis] : min[axis] + i * width(axis);
  }
  double centre(int axis, int i) const { return min[axis] + (i + 0.5) * width(axis); }
  std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(cells[0]) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(cells[1]) * static_cast<std::size_t>(k));
  }
  bool operator==(const Grid&) const = default;
};

}  // namespace bedscope::analysis
