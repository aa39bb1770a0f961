// SPDX-License-Identifier: BSD-3-Clause
#include "cases/initial_particles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cases/scene_file.hpp"
#include "readers/error.hpp"

namespace bedscope::cases {
namespace {

Scene shipped(const std::string& name) {
  return read_scene(std::string(BEDSCOPE_SOURCE "/cases/") + name);
}

/// Smallest gap between two spheres [m], by cells as wide as the largest.
double smallest_gap(const std::vector<InitialParticle>& particles, double d) {
  std::map<std::array<int, 3>, std::vector<const InitialParticle*>> cells;
  const auto cell_of = [&](const Vector& x) {
    return std::array{static_cast<int>(x[0] / d), static_cast<int>(x[1] / d),
                      static_cast<int>(x[2] / d)};
  };
  double smallest = 1;
  for (const auto& p : particles) {
    const auto c = cell_of(p.position);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k)
          if (const auto at = cells.find({c[0] + i, c[1] + j, c[2] + k}); at != cells.end())
            for (const auto* q : at->second) {
              const double distance =
                  std::hypot(p.position[0] - q->position[0], p.position[1] - q->position[1],
                             p.position[2] - q->position[2]);
              smallest = std::min(smallest, distance - (p.diameter + q->diameter) / 2);
            }
    cells[c].push_back(&p);
  }
  return smallest;
}

TEST(InitialParticles, AreAsManyAsTheSceneSaysAndDoNotOverlap) {
  for (const auto* name :
       {"riser/K2_b.toml", "riser/feed_bottom_rough.toml", "mueller_bed/scene.toml",
        "binary_riser/K3_b.toml", "bubbling_bed/H0.04_u0.5_active.toml"}) {
    const auto scene = shipped(name);
    const auto particles = initial_particles(scene);
    ASSERT_EQ(static_cast<std::int64_t>(particles.size()), scene.particles.number) << name;
    std::vector<std::int64_t> numbers(scene.species.size());
    const auto& g = scene.geometry;
    for (const auto& p : particles) {
      ++numbers[static_cast<std::size_t>(p.species)];
      const double r = p.diameter / 2 * (1 - 1e-9);
      const Vector size{g.width, g.depth, g.height};
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_GE(p.position[k], r) << name;
        ASSERT_LE(p.position[k], size[k] - r) << name;
      }
    }
    EXPECT_EQ(numbers, species_numbers(scene)) << name;
    EXPECT_GE(smallest_gap(particles, largest_diameter(scene)), -1e-9 * g.width) << name;
  }
}

TEST(InitialParticles, HaveTheSpreadOfTheirSpecies) {
  const auto scene = shipped("riser/feed_bottom_rough.toml");
  double sum = 0, squares = 0, least = 1, most = 0;
  for (const auto& p : initial_particles(scene)) {
    sum += p.diameter;
    squares += p.diameter * p.diameter;
    least = std::min(least, p.diameter);
    most = std::max(most, p.diameter);
  }
  const double n = 50000, mean = sum / n;
  EXPECT_NEAR(mean, 0.85e-3, 5 * 0.05e-3 / std::sqrt(3 * n));  // five standard errors
  EXPECT_NEAR(std::sqrt(squares / n - mean * mean), 0.05e-3 / std::sqrt(3.0), 1e-6);  // uniform
  EXPECT_GE(least, 0.80e-3);
  EXPECT_LE(most, 0.90e-3);
}

TEST(InitialParticles, OfALatticeFillTheBox) {
  const auto particles = initial_particles(shipped("fixed_bed/scene.toml"));
  ASSERT_EQ(particles.size(), 78125U);
  EXPECT_NEAR(particles.front().position[0], 0.002, 1e-12);
  EXPECT_NEAR(particles.back().position[2], 0.498, 1e-12);
}

TEST(InitialParticles, AreTheSameEachTime) {
  const auto scene = shipped("riser/K2_b.toml");
  const auto once = initial_particles(scene), again = initial_particles(scene);
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].position, again[i].position);
  // Fixed for ever, on every machine: the generator is our own.
  EXPECT_GT(once[0].position[0], 0);
}

TEST(InitialParticles, ThatDoNotFitAreAnError) {
  auto scene = shipped("mueller_bed/scene.toml");
  scene.particles.number *= 10;
  EXPECT_THROW(initial_particles(scene), InputError);
  scene = shipped("riser/scene.toml");
  scene.geometry.depth = 0.5e-3;
  EXPECT_THROW(initial_particles(scene), InputError);
}

}  // namespace
}  // namespace bedscope::cases
