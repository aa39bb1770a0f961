// SPDX-License-Identifier: BSD-3-Clause
// Bodies whose parts are known in closed form.
#include "analysis/cell_cutter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace bedscope::analysis {
namespace {

constexpr double rounding = 1e-13;

/// Shares by cell of the grid.
std::vector<double> shares(CellCutter& cutter, const Grid& grid) {
  std::vector<double> found(grid.size(), 0);
  for (const auto& [cell, share] : cutter.finish()) found[cell] += share;
  return found;
}

/// Of {x, y, z > 0, x + y + z < 1}: what lies below a corner, by inclusion and exclusion.
double of_simplex_below(double x, double y, double z) {
  const auto corner = [](double left) { return std::pow(std::max(left, 0.), 3) / 6; };
  return corner(1) - corner(1 - x) - corner(1 - y) - corner(1 - z) + corner(1 - x - y) +
         corner(1 - y - z) + corner(1 - z - x) - corner(1 - x - y - z);
}

TEST(CellCutter, ASimplexInClosedForm) {
  for (const auto& cells : {std::array{1, 1, 1}, {4, 1, 3}, {5, 7, 6}, {1, 20, 1}}) {
    const auto grid = Grid{{0, 0, 0}, {1.05, 0.9, 1}, cells};
    CellCutter cutter(grid);
    cutter.begin({0, 0, 0}, {1, 1, 1}, 0);
    cutter.add({Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}});
    const auto found = shares(cutter, grid);
    for (int k = 0; k < cells[2]; ++k)
      for (int j = 0; j < cells[1]; ++j)
        for (int i = 0; i < cells[0]; ++i) {
          double volume = 0;
          for (int corner = 0; corner < 8; ++corner) {
            const int a = corner & 1, b = corner >> 1 & 1, c = corner >> 2;
            const double below =
                of_simplex_below(grid.face(0, i + a), grid.face(1, j + b), grid.face(2, k + c));
            volume += (a + b + c) % 2 == 1 ? below : -below;
          }
          EXPECT_NEAR(found[grid.index(i, j, k)], 6 * volume, rounding);
        }
    EXPECT_NEAR(cutter.inside(), 6 * of_simplex_below(1.05, 0.9, 1), rounding);
  }
}

TEST(CellCutter, WhatIsCutOffAndWhatIsKeptAddUp) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-0.3, 1.3);
  // The same planes on a grid that holds all of it.
  const auto inner = Grid{{0, 0, 0}, {1, 1, 1}, {3, 4, 5}};
  const auto outer = Grid{{-1, -1, -1}, {3, 3, 3}, {12, 16, 20}};
  for (int n = 0; n < 2000; ++n) {
    std::array<Vec3, 4> body{};
    Vec3 low{9, 9, 9}, high{-9, -9, -9};
    for (auto& point : body)
      for (std::size_t a = 0; a < 3; ++a) {
        point[a] = place(random);
        if (n % 3 == 0) point[a] = std::round(4 * point[a]) / 4;  // on planes, and flat ones
        low[a] = std::min(low[a], point[a]);
        high[a] = std::max(high[a], point[a]);
      }
    std::array<std::vector<double>, 2> found;
    double inside = 0;
    for (const auto* grid : {&outer, &inner}) {
      CellCutter cutter(*grid);
      cutter.begin(low, high, 0);
      cutter.add(body);
      found[grid == &inner] = shares(cutter, *grid);
      inside = cutter.inside();
    }
    const double all = std::accumulate(found[0].begin(), found[0].end(), 0.);
    if (all == 0) continue;          // flat
    EXPECT_NEAR(all, 1, 1e-9) << n;  // a thousandth of a cell in volume is known to fewer digits
    double kept = 0;
    for (int k = 0; k < 5; ++k)
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 3; ++i) {
          EXPECT_NEAR(found[1][inner.index(i, j, k)], found[0][outer.index(i + 3, j + 4, k + 5)],
                      1e-9);
          kept += found[1][inner.index(i, j, k)];
        }
    EXPECT_NEAR(kept, inside, rounding);
  }
}

/// An L of two boxes, seen from an apex in the empty corner: its inner walls count as negative.
TEST(CellCutter, ABodyNeedNotBeConvex) {
  const Grid grid = Grid{{0, 0, 0}, {2, 1, 2}, {4, 1, 4}};
  CellCutter cutter(grid);
  cutter.begin({0, 0, 0}, {2, 1, 2}, 0);
  const Vec3 apex{1.7, 0.4, 1.9};
  const auto polygon = [&](const std::vector<Vec3>& points) {
    for (std::size_t k = 1; k + 1 < points.size(); ++k)
      cutter.add({apex, points[0], points[k], points[k + 1]});
  };
  const std::vector<std::array<double, 2>> outline{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  std::vector<Vec3> front, back;
  for (const auto& [x, z] : outline) front.push_back({x, 0, z});
  for (auto at = outline.rbegin(); at != outline.rend(); ++at)
    back.push_back({(*at)[0], 1, (*at)[1]});
  polygon(front);
  polygon(back);
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const auto [x, z] = outline[k];
    const auto [u, w] = outline[(k + 1) % outline.size()];
    polygon({{x, 0, z}, {x, 1, z}, {u, 1, w}, {u, 0, w}});
  }
  const auto found = shares(cutter, grid);
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(found[grid.index(i, 0, k)], i > 1 && k > 1 ? 0 : 1. / 12, rounding) << i << k;
}

TEST(CellCutter, OfNothingAndOfWhatIsNoNumberThereAreNoParts) {
  const auto grid = Grid{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  CellCutter cutter(grid);
  cutter.begin({0, 0, 0}, {1, 1, 1}, 0);
  EXPECT_TRUE(cutter.finish().empty());
  for (const double x : {std::nan(""), HUGE_VAL, 1e200}) {
    cutter.begin({0, 0, 0}, {x, 1, 1}, 0);
    cutter.add({Vec3{0, 0, 0}, Vec3{x, 0, 0}, Vec3{0, x, 0}, Vec3{0, 0, x}});
    EXPECT_TRUE(cutter.finish().empty());
  }
}

}  // namespace
}  // namespace bedscope::analysis
