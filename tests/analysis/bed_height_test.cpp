// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/bed_height.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace bedscope::analysis {
namespace {

/// 20 layers of 1 cm, the floor at 0.5 m.
Grid grid() {
  Grid grid;
  grid.min = {0, 0, 0.5};
  grid.max = {0.1, 0.01, 0.7};
  grid.cells = {10, 1, 20};
  return grid;
}

std::vector<double> level_bed(int layers, double holdup = 0.6) {
  std::vector<double> bed(20, 0);
  std::fill(bed.begin(), bed.begin() + layers, holdup);
  return bed;
}

TEST(BedHeight, of_a_level_bed_is_its_height) {
  const auto heights = bed_heights(grid(), level_bed(8));
  EXPECT_NEAR(heights.surface, 0.08, 1e-12);
  EXPECT_NEAR(heights.by_solids, 0.95 * 0.08, 1e-12);
}

TEST(BedHeight, of_a_layer_filled_in_part_lies_in_it) {
  auto bed = level_bed(8);
  bed[8] = 0.15;  // a quarter: the linear profile passes half the bed's holdup at 1/3 past middles
  const double limit = (8 * 0.36 + 0.0225) / (8 * 0.6 + 0.15) / 2;
  EXPECT_NEAR(bed_heights(grid(), bed).surface, 0.01 * (7.5 + (0.6 - limit) / 0.45), 1e-12);
}

TEST(BedHeight, does_not_depend_on_the_room_above_nor_on_a_thin_splash) {
  auto bed = level_bed(8);
  bed[15] = 0.05;
  EXPECT_NEAR(bed_heights(grid(), bed).surface, 0.08, 1e-4);
  auto tall = grid();
  tall.max[up] = 0.9;
  tall.cells[up] = 40;
  bed.resize(40, 0);
  EXPECT_DOUBLE_EQ(bed_heights(tall, bed).surface, bed_heights(grid(), {bed.data(), 20}).surface);
}

TEST(BedHeight, takes_the_surface_above_a_slug) {
  auto bed = level_bed(10);
  bed[4] = bed[5] = 0.02;
  EXPECT_NEAR(bed_heights(grid(), bed).surface, 0.1, 1e-3);
}

TEST(BedHeight, of_a_domain_that_is_full_is_that_of_the_domain) {
  EXPECT_DOUBLE_EQ(bed_heights(grid(), level_bed(20)).surface, 0.2);
}

TEST(BedHeight, of_nothing_is_undefined) {
  const auto heights = bed_heights(grid(), level_bed(0));
  EXPECT_TRUE(std::isnan(heights.surface));
  EXPECT_TRUE(std::isnan(heights.by_solids));
}

}  // namespace
}  // namespace bedscope::analysis
