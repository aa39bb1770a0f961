// SPDX-License-Identifier: BSD-3-Clause
// Curves of more points than can be seen, drawn by the columns of a panel. Inside report.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "report/canvas.hpp"

namespace bedscope::report {

/// Curves of up to so many points are drawn point by point.
constexpr std::size_t most_single = 2000;
/// A fifth of a millimetre is told from its neighbour by a good eye at reading distance.
constexpr double column_width = 0.2;  // [mm]
constexpr double cell_width = 0.4;    ///< of a cloud: half a marker [mm]

/// A point and the ends of its bar, in units of the panel's axes.
struct BarPoint {
  double x = 0, y = 0, low = 0, high = 0;
};

/// The points of one column, or a point by itself: how far they and their bars reach.
struct Column {
  double x = 0;  ///< of the first of them
  double low = 0, high = 0, bar_low = 0, bar_high = 0;
  std::size_t points = 0;
};

/// Points in any order, those without a finite value left out; by ascending column where they are
/// more than most_single, else each by itself as they came.
std::vector<Column> columns_of(std::span<const BarPoint> points, const Panel& panel);

/// The points of a curve with its band that show it as all of them do: of each column the first,
/// the last, the lowest, the highest, those whose bars reach furthest, or one without a value where
/// there are no others. Ascending; all, where they are up to most_single. `points` ascend in x.
std::vector<std::size_t> corners_of(std::span<const BarPoint> points, const Panel& panel);

/// Points of a cloud (x, y): where they are more than most_single the first of each cell.
std::vector<std::pair<double, double>> told_apart(std::span<const std::pair<double, double>> points,
                                                  const Panel& panel);

}  // namespace bedscope::report
