// SPDX-License-Identifier: BSD-3-Clause
#include "report/columns.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bedscope::report {
namespace {

std::size_t count_of(double length, double width) {
  return static_cast<std::size_t>(std::ceil(length / width));
}

/// Which of so many equal parts of an axis a value lies in.
std::size_t part_of(const Axis& axis, double value, std::size_t parts) {
  const double share = (value - axis.lo) / (axis.hi - axis.lo);
  const auto count = static_cast<double>(parts);
  return static_cast<std::size_t>(std::clamp(share * count, 0., count - 1));
}

std::size_t column_at(double x, const Panel& panel) {
  return part_of(panel.x, x, count_of(panel.width, column_width));
}

void add(const BarPoint& point, Column& column) {
  if (column.points++ == 0) {
    column = {point.x, point.y, point.y, point.low, point.high, 1};
    return;
  }
  column.low = std::min(column.low, point.y);
  column.high = std::max(column.high, point.y);
  column.bar_low = std::min(column.bar_low, point.low);
  column.bar_high = std::max(column.bar_high, point.high);
}

}  // namespace

std::vector<Column> columns_of(std::span<const BarPoint> points, const Panel& panel) {
  const bool merges = points.size() > most_single;
  std::vector<Column> columns(merges ? count_of(panel.width, column_width) : points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::isfinite(points[i].x) && std::isfinite(points[i].y))
      add(points[i], columns[merges ? column_at(points[i].x, panel) : i]);
  std::erase_if(columns, [](const Column& column) { return column.points == 0; });
  return columns;
}

std::vector<std::size_t> corners_of(std::span<const BarPoint> points, const Panel& panel) {
  std::vector<std::size_t> corners;
  if (points.size() <= most_single) {
    corners.resize(points.size());
    std::iota(corners.begin(), corners.end(), 0);
    return corners;
  }
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
    const auto column = column_at(points[begin].x, panel);
    std::vector<std::size_t> seen;
    for (end = begin; end < points.size() && column_at(points[end].x, panel) == column; ++end)
      if (std::isfinite(points[end].y)) seen.push_back(end);
    if (seen.empty()) {
      corners.push_back(begin);
      continue;
    }
    std::vector<std::size_t> of_column{seen.front(), seen.back()};
    for (const auto member : {&BarPoint::y, &BarPoint::low, &BarPoint::high}) {
      const auto below = [&](std::size_t a, std::size_t b) {
        return points[a].*member < points[b].*member;
      };
      const auto [low, high] = std::minmax_element(seen.begin(), seen.end(), below);
      of_column.insert(of_column.end(), {*low, *high});
    }
    std::sort(of_column.begin(), of_column.end());
    of_column.erase(std::unique(of_column.begin(), of_column.end()), of_column.end());
    corners.insert(corners.end(), of_column.begin(), of_column.end());
  }
  return corners;
}

std::vector<std::pair<double, double>> told_apart(std::span<const std::pair<double, double>> points,
                                                  const Panel& panel) {
  if (points.size() <= most_single) return {points.begin(), points.end()};
  const std::size_t columns = count_of(panel.width, cell_width);
  const std::size_t rows = count_of(panel.height, cell_width);
  std::vector<bool> taken(columns * rows);
  std::vector<std::pair<double, double>> kept;
  for (const auto& [x, y] : points) {
    const std::size_t cell = part_of(panel.y, y, rows) * columns + part_of(panel.x, x, columns);
    if (taken[cell]) continue;
    taken[cell] = true;
    kept.emplace_back(x, y);
  }
  return kept;
}

}  // namespace bedscope::report
