// SPDX-License-Identifier: BSD-3-Clause
#include "physics/packing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace bedscope::physics {
namespace {

TEST(Packing, OrdersItsLimits) {
  EXPECT_NEAR(simple_cubic_packing, std::numbers::pi / 6, 1e-15);           // rounding
  EXPECT_NEAR(densest_packing, std::numbers::pi / std::sqrt(18.0), 1e-15);  // rounding
  EXPECT_LT(simple_cubic_packing, random_loose_packing);
  EXPECT_LT(random_loose_packing, random_close_packing);
  EXPECT_LT(random_close_packing, densest_packing);
}

TEST(Holdup, OfASphereInItsCubeIsThatOfASimpleCubicPacking) {
  EXPECT_NEAR(holdup(8, 1e-3, 8e-9), simple_cubic_packing, 1e-15);  // rounding
}

TEST(Holdup, OfTheScenesOfTheThesis) {
  // Mu (2022), Table 2.2: 25 x 25 x 125 spheres of 3.95 mm, 4 mm apart
  EXPECT_NEAR(holdup(78125, 3.95e-3, 0.1 * 0.1 * 0.5), 0.504, 5e-4);  // last digit
  // Table 2.4: within the random packings
  EXPECT_NEAR(holdup(37225, 0.995e-3, 0.08 * 0.01 * 0.04), 0.600, 5e-4);  // last digit
  // Table 4.1: 2.55 %, of 1.5 m and not of the 1.57 m that Table 4.2 names
  EXPECT_NEAR(holdup(50000, 0.85e-3, 0.07 * 0.006 * 1.5), 0.0255, 5e-5);  // last digit
  EXPECT_NEAR(holdup(50000, 0.85e-3, 0.07 * 0.006 * 1.57), 0.0244, 5e-5);
}

TEST(SettledBed, HoldsAllItsParticles) {
  const double height = settled_bed_height(37225, 0.995e-3, 0.08 * 0.01, 0.6);
  EXPECT_NEAR(holdup(37225, 0.995e-3, 0.08 * 0.01 * height), 0.6, 1e-15);  // rounding
  EXPECT_NEAR(height, 0.04, 5e-5);  // Table 2.4, three digits of the holdup
  EXPECT_THROW(settled_bed_height(1, 1e-3, 1e-3, 0.75), std::domain_error);
  EXPECT_THROW(settled_bed_height(1, 1e-3, 1e-3, 0), std::domain_error);
}

TEST(Scatter, IsOfPoissonWhereSpheresAreFewAndLessWhereTheyHinderEachOther) {
  EXPECT_NEAR(number_scatter(0, 100), 0.1, 1e-15);
  EXPECT_NEAR(number_scatter(0.2, 1), std::sqrt(0.4096 / 1.9296), 1e-12);
  // S is the inverse of d(phi Z)/d phi, Z = (1 + phi + phi^2 - phi^3) / (1 - phi)^3.
  const auto pressure = [](double x) {
    return x * (1 + x + x * x - x * x * x) / std::pow(1 - x, 3);
  };
  const double slope = (pressure(0.301) - pressure(0.299)) / 0.002;
  EXPECT_NEAR(number_scatter(0.3, 1), 1 / std::sqrt(slope), 1e-5);
  EXPECT_THROW(number_scatter(0.8, 10), std::domain_error);
}

}  // namespace
}  // namespace bedscope::physics
