// SPDX-License-Identifier: BSD-3-Clause
// Overlapping spheres: a closed form for two, all pairs by brute force for many.
#include "readers/overlaps.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <random>
#include <vector>

namespace bedscope::readers {
namespace {

struct Bed {
  std::vector<double> x, y, z, radius, body;

  void add(double at_x, double at_y, double at_z, double r, double of_body = 0) {
    x.push_back(at_x);
    y.push_back(at_y);
    z.push_back(at_z);
    radius.push_back(r);
    body.push_back(of_body);
  }
  Spheres spheres(bool bodies = false) const {
    return {x, y, z, radius, bodies ? std::span<const double>(body) : std::span<const double>()};
  }
};

/// Coordinates in [0, 1), so six digits leave 5e-7 open at most.
Bed random_bed(std::size_t count, double smallest, double largest, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(0, 1), size(std::log(smallest), std::log(largest));
  Bed bed;
  for (std::size_t i = 0; i < count; ++i)
    bed.add(place(random), place(random), place(random), std::exp(size(random)));
  return bed;
}

TEST(Overlaps, OfTwoSpheresAreRadiiLessDistanceOverTheSmallerRadiusLessTheLastDigit) {
  Bed bed;
  bed.add(0.1, 0.2, 0.3, 0.03);
  bed.add(0.1, 0.2, 0.337, 0.01);  // 0.04 - 0.037
  const auto found = find_overlaps(bed.spheres());
  EXPECT_NEAR(found.deepest + found.rounding, 0.3, 1e-12);
  // Half a unit of the sixth digit is 5e-7 in each coordinate, 5e-8 in each radius, twice each.
  EXPECT_NEAR(found.rounding, (std::sqrt(3.) * 1e-6 + 1e-7) / 0.01, 1e-12);
  EXPECT_EQ(found.a, 0U);
  EXPECT_EQ(found.b, 1U);
  EXPECT_EQ(found.beyond_rule, 1);
  EXPECT_EQ(found.deep, 0);  // 0.037 > 0.9 * 0.04
  bed.z[1] = 0.335;
  EXPECT_EQ(find_overlaps(bed.spheres()).deep, 1);
  bed.z[1] = 0.34;
  EXPECT_EQ(find_overlaps(bed.spheres()).deepest, 0);
}

TEST(Overlaps, ASphereThatIsNowhereTouchesNone) {
  for (int axis = 0; axis < 3; ++axis) {
    Bed bed;
    bed.add(axis == 0 ? NAN : 0, axis == 1 ? NAN : 0, axis == 2 ? NAN : 0, 1);
    bed.add(0.5, 0.5, 0.5, 1);
    EXPECT_EQ(find_overlaps(bed.spheres()).deep, 0);
  }
}

TEST(Overlaps, ThatTheDigitsOfADumpLeaveOpenAreNone) {
  Bed bed;  // at 1.5 m the sixth digit is 1e-5 m, 1 % of this radius
  bed.add(1.50000, 0, 0, 0.001);
  bed.add(1.50199, 0, 0, 0.001);
  EXPECT_EQ(find_overlaps(bed.spheres()).deepest, 0);
}

TEST(Overlaps, OfManyAreThoseThatBruteForceFinds) {
  for (const double largest : {0.012, 0.3}) {  // nearly equal spheres, and a factor of 30
    const auto bed = random_bed(800, 0.01, largest, 7);
    Overlaps all;
    for (std::size_t a = 0; a < bed.x.size(); ++a)
      for (std::size_t b = a + 1; b < bed.x.size(); ++b) {
        Bed pair;
        for (const auto row : {a, b}) pair.add(bed.x[row], bed.y[row], bed.z[row], bed.radius[row]);
        const auto found = find_overlaps(pair.spheres());
        all.beyond_rule += found.beyond_rule;
        all.deep += found.deep;
        all.deepest = std::max(all.deepest, found.deepest);
        const double distance =
            std::hypot(bed.x[a] - bed.x[b], bed.y[a] - bed.y[b], bed.z[a] - bed.z[b]);
        const double depth = bed.radius[a] + bed.radius[b] - distance;
        const double smaller = std::min(bed.radius[a], bed.radius[b]);
        ASSERT_NEAR(found.deepest, std::max(0., depth / smaller), 1e-3) << a << " " << b;
      }
    const auto found = find_overlaps(bed.spheres());
    EXPECT_TRUE(found.complete);
    EXPECT_EQ(found.beyond_rule, all.beyond_rule);
    EXPECT_EQ(found.deep, all.deep);
    EXPECT_EQ(found.deepest, all.deepest);
    EXPECT_GT(found.deep, 10);
  }
}

TEST(Overlaps, AreAllowedWithinABody) {
  Bed bed;
  bed.add(0, 0, 0, 0.01, 3);
  bed.add(0.01, 0, 0, 0.01, 3);
  EXPECT_GT(find_overlaps(bed.spheres()).deepest, 0.9);
  EXPECT_EQ(find_overlaps(bed.spheres(true)).deepest, 0);
  bed.body = {0, 0};  // single spheres
  EXPECT_GT(find_overlaps(bed.spheres(true)).deepest, 0.9);
}

TEST(Overlaps, ValuesThatAreNoSpheresArePassedOver) {
  const double nan = std::nan(""), infinity = INFINITY;
  Bed bed;
  for (const double odd : {nan, infinity, -infinity, 1e300}) {
    bed.add(odd, 0, 0, 1);
    bed.add(0, 0, 0, odd == 1e300 ? -1 : odd);
  }
  bed.add(0, 0, 0, 0);
  EXPECT_EQ(find_overlaps(bed.spheres()).deepest, 0);
  bed.add(5, 5, 5, 1e-3);
  bed.add(5, 5, 5.001, 1e-3);
  EXPECT_GT(find_overlaps(bed.spheres()).deepest, 0.9);
}

TEST(Overlaps, AHeapOfSpheresInOnePlaceEndsSoonAndSaysSo) {
  Bed bed;
  for (int i = 0; i < 20'000; ++i) bed.add(0.5, 0.5, 0.5, 0.01);
  const auto started = std::chrono::steady_clock::now();
  EXPECT_FALSE(find_overlaps(bed.spheres()).complete);
  EXPECT_LT(std::chrono::steady_clock::now() - started, std::chrono::seconds(60));
}

TEST(Overlaps, ManySizesEndSoonToo) {
  const auto bed = random_bed(100'000, 1e-12, 1e-3, 3);  // 30 classes of sizes
  const auto started = std::chrono::steady_clock::now();
  EXPECT_TRUE(find_overlaps(bed.spheres()).complete);
  EXPECT_LT(std::chrono::steady_clock::now() - started, std::chrono::seconds(60));
}

}  // namespace
}  // namespace bedscope::readers
