// SPDX-License-Identifier: BSD-3-Clause
// What is drawn of long curves reaches as far as all of their points do.
#include "report/columns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace bedscope::report {
namespace {

Panel panel() {
  Panel panel{.width = 100, .height = 50};
  panel.x = {.lo = 0, .hi = 1};
  panel.y = {.lo = -5, .hi = 5};
  return panel;
}

/// Noise with bars of its own length; points crowd at the left, as on a logarithmic axis.
std::vector<BarPoint> noise(int n) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<BarPoint> points;
  for (int i = 0; i < n; ++i) {
    const double y = normal(random), bar = std::abs(normal(random));
    points.push_back({std::pow(static_cast<double>(i) / n, 3), y, y - bar, y + bar});
  }
  return points;
}

/// The column of an abscissa, of 500.
int column_of(double x) { return std::min(499, static_cast<int>(x * 500)); }

TEST(Columns, ReachAsFarAsTheirPointsAndBars) {
  const auto points = noise(50000);
  const auto columns = columns_of(points, panel());
  EXPECT_LE(columns.size(), 500U);
  std::size_t count = 0, checked = 0;
  for (const auto& column : columns) {
    count += column.points;
    double low = INFINITY, high = -INFINITY, bar_low = INFINITY, bar_high = -INFINITY;
    for (const auto& point : points)
      if (column_of(point.x) == column_of(column.x)) {
        low = std::min(low, point.y);
        high = std::max(high, point.y);
        bar_low = std::min(bar_low, point.low);
        bar_high = std::max(bar_high, point.high);
      }
    EXPECT_EQ(column.low, low);
    EXPECT_EQ(column.high, high);
    EXPECT_EQ(column.bar_low, bar_low);
    EXPECT_EQ(column.bar_high, bar_high);
    ++checked;
  }
  EXPECT_EQ(count, points.size());
  EXPECT_GT(checked, 400U);
}

TEST(Columns, OfFewPointsAreThePoints) {
  const auto points = noise(2000);
  const auto columns = columns_of(points, panel());
  ASSERT_EQ(columns.size(), points.size());
  EXPECT_EQ(columns[7].low, points[7].y);
  EXPECT_EQ(columns[7].high, points[7].y);
  EXPECT_EQ(corners_of(points, panel()).size(), points.size());
}

TEST(Columns, CornersOfALineKeepItsExtremesAndItsGaps) {
  auto points = noise(50000);
  points[20000].y = 40;
  points[20001].low = -40;
  for (std::size_t i = 40000; i < 45000; ++i) points[i].y = NAN;  // 0.51 to 0.73
  points[30000].y = NAN;                                          // too narrow to be seen
  const auto corners = corners_of(points, panel());
  EXPECT_LE(corners.size(), 6U * 500);
  EXPECT_TRUE(std::is_sorted(corners.begin(), corners.end()));
  const auto kept = [&](std::size_t i) {
    return std::binary_search(corners.begin(), corners.end(), i);
  };
  EXPECT_TRUE(kept(0));
  EXPECT_TRUE(kept(20000));
  EXPECT_TRUE(kept(20001));
  EXPECT_TRUE(kept(49999));
  EXPECT_FALSE(kept(30000));
  EXPECT_TRUE(std::any_of(corners.begin(), corners.end(),
                          [](std::size_t i) { return i >= 40000 && i < 45000; }));
}

TEST(Columns, OfACloudEachCellHasOneMarker) {
  std::vector<std::pair<double, double>> cloud;
  for (const auto& point : noise(50000)) cloud.emplace_back(point.x, point.y);
  const auto kept = told_apart(cloud, panel());
  EXPECT_LE(kept.size(), 250U * 125);
  for (const auto& [x, y] : {cloud.front(), cloud[31234]}) {
    const bool near = std::any_of(kept.begin(), kept.end(), [&, x = x, y = y](const auto& other) {
      return std::abs(other.first - x) <= .4 / 100 && std::abs(other.second - y) <= .4 / 50 * 10;
    });
    EXPECT_TRUE(near);
  }
  EXPECT_LT(kept.size(), cloud.size() / 2);
}

}  // namespace
}  // namespace bedscope::report
