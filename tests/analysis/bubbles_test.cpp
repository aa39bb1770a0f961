// SPDX-License-Identifier: BSD-3-Clause
// Round voids drawn into a bed: which of them are bubbles, how large, how fast, how many pass.
#include "analysis/bubbles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace bedscope::analysis {
namespace {

struct Void {
  double x, z, diameter;
};

/// A bed of holdup 0.6 up to 0.2 m in a domain of 0.1 x 0.3 m, cells of 2 mm, floor at 0.
struct Bed {
  RunSetup setup;

  Bed() {
    setup.grid.min = {0, 0, 0};
    setup.grid.max = {0.1, 0.01, 0.3};
    setup.grid.cells = {50, 1, 150};
    setup.settings.bubbles = {.threshold = 0.8, .core = 0.9, .min_area = 16e-6};
    for (int b = 0; b < 10; ++b) {
      Band band{0.015 + 0.03 * b, 0.03, std::vector<double>(150, 0)};
      std::fill_n(band.weights.begin() + 15 * b, 15, 1. / 15);
      setup.bubble_bands.push_back(band);
    }
  }

  std::vector<double> holdup(const std::vector<Void>& voids) const {
    std::vector<double> phi;
    for (int k = 0; k < 150; ++k)
      for (int i = 0; i < 50; ++i) {
        const double x = setup.grid.centre(lateral, i), z = setup.grid.centre(up, k);
        bool empty = z > 0.2;
        for (const Void& v : voids) empty |= std::hypot(x - v.x, z - v.z) < v.diameter / 2;
        phi.push_back(empty ? 0 : 0.6);
      }
    return phi;
  }
  BubbleProduct see(const std::vector<Void>& voids) const {
    return make_bubbles(setup, holdup(voids), 0.2);
  }
};

TEST(Bubbles, have_the_size_and_place_of_the_void) {
  const auto found = Bed().see({{0.05, 0.1, 0.03}}).image.clusters;
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(equivalent_diameter(found[0]), 0.03, 0.0006);  // 15 cells across: 2 %
  EXPECT_NEAR(found[0].centre.x, 0.05, 1e-4);
  EXPECT_NEAR(found[0].centre.z, 0.1, 1e-4);
  EXPECT_NEAR(aspect_ratio(found[0]), 1, 0.01);
  EXPECT_FALSE(found[0].at_wall);
  EXPECT_DOUBLE_EQ(found[0].holdup, 1);  // the voidage
}

TEST(Bubbles, aspect_is_height_over_width) {
  Cluster bubble;
  bubble.major = 3;
  bubble.minor = 1;
  bubble.angle = std::numbers::pi / 2;
  EXPECT_NEAR(aspect_ratio(bubble), 3, 1e-12);
  bubble.angle = 0;
  EXPECT_NEAR(aspect_ratio(bubble), 1. / 3, 1e-12);
  bubble.angle = std::numbers::pi / 4;
  EXPECT_NEAR(aspect_ratio(bubble), 1, 1e-12);
}

TEST(Bubbles, the_freeboard_is_none_and_what_breaks_into_it_belongs_to_it) {
  EXPECT_TRUE(Bed().see({}).image.clusters.empty());
  EXPECT_TRUE(Bed().see({{0.05, 0.195, 0.03}}).image.clusters.empty());
  EXPECT_EQ(Bed().see({{0.05, 0.18, 0.03}}).image.clusters.size(), 1u);  // a roof of 5 mm
}

TEST(Bubbles, a_pocket_with_its_centre_above_the_surface_is_none) {
  const Bed bed;
  auto phi = bed.holdup({});
  for (int i = 0; i < 50; ++i) phi[static_cast<std::size_t>(i + 50 * 120)] = 0.4;  // thrown up
  EXPECT_TRUE(make_bubbles(bed.setup, phi, 0.2).image.clusters.empty());
  EXPECT_EQ(make_bubbles(bed.setup, phi, 0.25).image.clusters.size(), 1u);
  EXPECT_TRUE(make_bubbles(bed.setup, phi, std::nan("")).image.clusters.empty());
}

TEST(Bubbles, at_a_wall_or_the_floor_are_kept_and_flagged) {
  const auto found = Bed().see({{0, 0.1, 0.03}, {0.05, 0, 0.03}, {0.05, 0.1, 0.03}});
  ASSERT_EQ(found.image.clusters.size(), 3u);
  EXPECT_TRUE(found.image.clusters[0].at_wall);
  EXPECT_EQ(found.image.clusters[1].at_wall + found.image.clusters[2].at_wall, 1);
}

TEST(Bubbles, cover_their_share_of_a_band) {
  const Bed bed;
  const auto found = bed.see({{0.05, 0.105, 0.02}});  // the band from 0.09 to 0.12
  ASSERT_EQ(found.covered.size(), 10u);
  EXPECT_NEAR(found.covered[3], found.image.clusters[0].area / (0.1 * 0.03), 1e-12);
  EXPECT_DOUBLE_EQ(found.covered[2], 0);
}

/// Voids of `diameter` rise at `speed`, `frequency` a second, for a window of `snapshots`.
Bubbles rising(const Bed& bed, double diameter, double speed, double frequency, int snapshots,
               double dt, std::vector<std::string>& problems, int first = 0) {
  BubbleSums sums(bed.setup.grid);
  for (int n = 0; n < snapshots; ++n) {
    std::vector<Void> voids;
    for (int v = 0; v < 1000; ++v) {
      const double z = speed * (n * dt - v / frequency);
      if (z > -diameter && z < 0.4) voids.push_back({0.05, z, diameter});
    }
    auto product = bed.see(voids);
    sums.add(product, static_cast<std::size_t>(n), n * dt, dt, false);
  }
  return std::move(sums).finish(bed.setup, static_cast<std::size_t>(first), problems);
}

TEST(Bubbles, rise_at_the_speed_and_pass_at_the_frequency_that_were_drawn) {
  const Bed bed;
  std::vector<std::string> problems;
  const double speed = 0.5, frequency = 7, dt = 0.01, diameter = 0.03;
  const auto found = rising(bed, diameter, speed, frequency, 601, dt, problems, 100);
  EXPECT_TRUE(problems.empty());
  ASSERT_EQ(found.bands.size(), 10u);
  for (const int b : {1, 2, 3, 4}) {  // clear of floor and surface
    const auto& band = found.bands[static_cast<std::size_t>(b)];
    EXPECT_NEAR(band.diameter.value, diameter, 0.02 * diameter) << b;  // 15 cells across
    EXPECT_NEAR(band.velocity.value, speed, 0.01 * speed) << b;
    EXPECT_NEAR(band.frequency.value, frequency, 1 / 5.) << b;  // one more or less in 5 s
    // Time in the band times frequency; area of one times the number in the bed.
    EXPECT_NEAR(band.number.value, frequency * 0.03 / speed, 0.01) << b;
    EXPECT_NEAR(band.area_fraction.value,
                frequency / speed * std::numbers::pi / 4 * diameter * diameter / 0.1, 0.004)
        << b;
    EXPECT_GT(band.diameter.ci95, 0);
    EXPECT_LT(std::abs(band.velocity.value - speed), band.velocity.ci95 + 1e-3);
  }
  EXPECT_EQ(found.bands[8].number.value, 0);  // above the bed
  EXPECT_TRUE(std::isnan(found.bands[8].diameter.value));
  EXPECT_EQ(found.bubbles.front().snapshot, 100u);
  EXPECT_EQ(found.bubbles.front().track, 1);
}

TEST(Bubbles, that_cannot_be_followed_are_said) {
  const Bed bed;
  std::vector<std::string> problems;
  rising(bed, 0.02, 0.5, 8, 60, 0.06, problems);  // 1.5 diameters a snapshot
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_NE(problems[0].find("too far apart"), std::string::npos);
}

TEST(Bubbles, without_times_have_sizes_but_neither_speed_nor_frequency) {
  const Bed bed;
  BubbleSums sums(bed.setup.grid);
  for (std::size_t n = 0; n < 30; ++n) {
    auto product = bed.see({{0.05, 0.1 + 0.001 * static_cast<double>(n), 0.03}});
    sums.add(product, n, std::nan(""), 1, false);
  }
  std::vector<std::string> problems;
  const auto found = std::move(sums).finish(bed.setup, 0, problems);
  EXPECT_NEAR(found.diameter.value, 0.03, 0.0003);
  EXPECT_TRUE(std::isnan(found.velocity.value));
  EXPECT_TRUE(std::isnan(found.bands[3].frequency.value));
}

}  // namespace
}  // namespace bedscope::analysis
