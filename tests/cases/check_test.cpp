// SPDX-License-Identifier: BSD-3-Clause
#include "cases/check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>

#include "cases/scene_file.hpp"
#include "cases/scene_physics.hpp"
#include "physics/time_steps.hpp"

namespace bedscope::cases {
namespace {

Scene shipped(const std::string& name) {
  return read_scene(std::string(BEDSCOPE_SOURCE "/cases/") + name);
}

const SceneNumber& number(const std::vector<SceneNumber>& numbers, const std::string& name) {
  for (const auto& n : numbers)
    if (n.name == name) return n;
  throw std::out_of_range(name);
}

Limit limit(const Scene& scene, const std::string& name) {
  for (const auto& l : scene_limits(scene))
    if (l.name == name) return l;
  throw std::out_of_range(name);
}

std::map<std::string, bool> advice(const std::string& scene) {
  std::map<std::string, bool> needed;
  for (const auto& a : scene_advice(shipped(scene))) {
    EXPECT_GT(a.reason.size(), 10U) << a.model;
    needed[a.model] = a.needed;
  }
  return needed;
}

TEST(Numbers, OfTheRiser) {
  const auto numbers = scene_numbers(shipped("riser/scene.toml"));
  const auto value = [&](const char* name) { return number(numbers, name).value; };
  EXPECT_NEAR(value("Re"), 314.5, 1e-9);                           // 1.2 5.55 0.85 / 0.018
  EXPECT_NEAR(value("Fr"), 5.55 * 5.55 / (9.81 * 0.85e-3), 1e-6);  // definition
  EXPECT_NEAR(value("u_t"), 4.938, 5e-4);  // of a coupled run with Beetstra's law
  EXPECT_NEAR(value("u_t by Schiller and Naumann"), 5.953, 5e-4);
  EXPECT_NEAR(value("u_mf"), 0.43, 5e-3);  // Beetstra, voidage 0.40
  EXPECT_NEAR(value("contact time"), 49.8e-6, 5e-8);
  EXPECT_NEAR(value("steps in a contact"), 4.98, 5e-3);
  EXPECT_NEAR(value("impact velocity of 1 % overlap"), 0.27, 5e-3);
  EXPECT_NEAR(value("dV/V_p"), 29.2, 0.05);  // Table 4.2
  EXPECT_NEAR(value("D/d"), 7.06, 5e-3);
  EXPECT_NEAR(value("cells in the smallest cluster"), 9.6, 1e-9);
  EXPECT_NEAR(value("mass loading"), 0.02552 * 2500 / (0.97448 * 1.2), 0.01);
  EXPECT_EQ(number(numbers, "Geldart group").unit, "D");
}

TEST(Numbers, FollowTheDragLawOfTheScene) {
  auto bed = shipped("bubbling_bed/scene.toml");
  bed.models.drag = "ergun";
  EXPECT_NEAR(number(scene_numbers(bed), "u_mf").value, 0.262, 5e-4);  // Mu (2022), section 2.4
  EXPECT_NEAR(number(scene_numbers(bed), "thermal time").value, 43.0, 0.05);
  EXPECT_NEAR(number(scene_numbers(bed), "mean particle temperature at equilibrium").value, 356, 1);
}

TEST(Numbers, OfSeveralSpeciesNameThem) {
  const auto numbers = scene_numbers(shipped("binary_riser/scene.toml"));
  EXPECT_GT(number(numbers, "u_t (large)").value, number(numbers, "u_t (small)").value);
}

TEST(Limits, OfTheDemStep) {
  EXPECT_FALSE(limit(shipped("riser/scene.toml"), "DEM step").ok);  // 4.98 steps a contact
  const auto as_run = limit(shipped("riser/as_run.toml"), "DEM step");
  EXPECT_TRUE(as_run.ok);
  EXPECT_NEAR(as_run.margin, 49.8 / 25, 2e-3);
  EXPECT_TRUE(limit(shipped("riser/scene.toml"), "DEM step in the contact time").ok);
  auto half = shipped("riser/scene.toml");
  half.numerics.dem_step = 0.51 * shortest_contact(half);
  EXPECT_FALSE(limit(half, "DEM step in the contact time").ok);
  EXPECT_FALSE(limit(shipped("binary_riser/printed.toml"), "DEM step in the contact time").ok);
}

TEST(Limits, OfTheGrid) {
  const auto a = limit(shipped("riser/K2_a.toml"), "cell edge holds a particle");
  EXPECT_FALSE(a.ok);
  EXPECT_NEAR(a.value, 1.5 / 1.7, 1e-9);
  EXPECT_TRUE(limit(shipped("riser/K2_b.toml"), "cell edge holds a particle").ok);
  auto scene = shipped("riser/scene.toml");
  EXPECT_EQ(limit(scene, "cell edge over diameter").limit, 1.8);
  scene.models.void_fraction = VoidFraction::centre;
  EXPECT_EQ(limit(scene, "cell edge over diameter").limit, 3);
  EXPECT_FALSE(limit(shipped("riser/K2_b.toml"), "cells in the smallest cluster").ok);
}

TEST(Limits, OfTheFeed) {
  EXPECT_NEAR(limit(shipped("riser/feed_bottom_printed.toml"), "feed").value, 1.28, 1e-9);
  EXPECT_FALSE(limit(shipped("riser/feed_side_printed.toml"), "feed").ok);
  EXPECT_TRUE(limit(shipped("riser/feed_side.toml"), "feed").ok);
  auto scene = shipped("riser/feed_side.toml");
  scene.inlet.velocity = {0.1, 0, 0};  // out of the slit in the right wall
  EXPECT_FALSE(limit(scene, "feed").ok);
}

TEST(Limits, OfExplicitDragComeOnWithIt) {
  auto bed = shipped("mueller_bed/scene.toml");
  EXPECT_THROW(limit(bed, "explicit drag on the gas"), std::out_of_range);
  bed.models.implicit_drag = false;
  const auto now = limit(bed, "explicit drag on the gas");
  EXPECT_EQ(now.limit, 1);
  const double n = dense_slope(bed);  // Re = 48: neither creeping nor inertial
  EXPECT_GT(n, 0.2);
  EXPECT_LT(n, 0.8);
  const double tau = physics::gas_relaxation_time(0.4, 1.2, dense_exchange(bed)) / (1 + n);
  EXPECT_NEAR(now.value, bed.numerics.gas_step / tau, 1e-12);
  bed.numerics.gas_step = tau * 1.01;
  EXPECT_FALSE(limit(bed, "explicit drag on the gas").ok);
  bed.numerics.gas_step = tau / 2;
  EXPECT_TRUE(limit(bed, "explicit drag on the gas").ok);
}

TEST(Limits, OfTheParticlesDragAreThoseOfTheirSurroundings) {
  const char* name = "gas step over the particles' relaxation time";
  auto scene = shipped("mueller_bed/scene.toml");
  const double tau = physics::solids_relaxation_time(0.4, 1000, dense_exchange(scene));
  // In a settled bed min(1, eps / (1 - eps)) eps tau is half the edge: 2/3 of 0.4 tau.
  EXPECT_NEAR(limit(scene, name).value,
              scene.numerics.gas_step * (1 + dense_slope(scene)) / (0.4 * tau * 2 / 3), 1e-9);
  scene.particles.arrangement = Arrangement::single;  // its cell is nearly empty
  EXPECT_NEAR(dense_voidage(scene), 1 - 1 / 13.263, 1e-4);
  EXPECT_NEAR(settled_voidage(scene), 0.4, 1e-15);
  EXPECT_LT(limit(scene, name).value, scene.numerics.gas_step / tau);
}

TEST(Limits, OfHeatFollowTheParticlesCapacity) {
  const char* name = "gas step over the particles' thermal time";
  auto bed = shipped("bubbling_bed/scene.toml");
  EXPECT_TRUE(limit(bed, name).ok);
  const double value = limit(bed, name).value;
  bed.species[0].heat_capacity /= 100;
  EXPECT_NEAR(limit(bed, name).value, 100 * value, 1e-9 * value);
  EXPECT_THROW(limit(bed, "cell height over exchange length"), std::out_of_range);
  const auto fixed = limit(shipped("fixed_bed/as_run.toml"), "cell height over exchange length");
  EXPECT_TRUE(fixed.ok);
  auto coarse = shipped("fixed_bed/as_run.toml");
  coarse.numerics.grid[2] /= 25;
  EXPECT_NEAR(limit(coarse, "cell height over exchange length").value, 25 * fixed.value, 1e-9);
  EXPECT_FALSE(limit(coarse, "cell height over exchange length").ok);
}

TEST(Limits, OfTheSmallestClusterCountItsParticles) {
  const char* name = "scatter of the smallest cluster's holdup";
  EXPECT_TRUE(limit(shipped("riser/scene.toml"), name).ok);
  EXPECT_TRUE(limit(shipped("riser/K2_b.toml"), name).ok);
  auto large = shipped("riser/scene.toml");
  large.species[0].diameter *= 3;  // 0.2 60 6 mm3 hold 8.3 of them
  EXPECT_FALSE(limit(large, name).ok);
  EXPECT_NEAR(limit(large, name).value, std::sqrt(0.4096 / 1.9296 / 8.2924), 1e-5);
}

TEST(Limits, OfTheOverlapFollowTheVelocity) {
  auto scene = shipped("riser/scene.toml");
  const double speed = particle_overlap(scene).velocity_of_one_percent;
  scene.contacts.impact_velocity = speed;
  EXPECT_NEAR(limit(scene, "overlap over radius").value, 0.01, 1e-12);
  auto bed = shipped("bubbling_bed/scene.toml");  // Hertz
  bed.contacts.impact_velocity = particle_overlap(bed).velocity_of_one_percent;
  EXPECT_NEAR(limit(bed, "overlap over radius").value, 0.01, 1e-12);
}

TEST(Limits, OfThermalEquilibrium) {
  const char* name = "distance from thermal equilibrium at the end";
  EXPECT_FALSE(limit(shipped("bubbling_bed/scene.toml"), name).ok);
  EXPECT_TRUE(limit(shipped("bubbling_bed/near_equilibrium.toml"), name).ok);
}

TEST(Limits, SayWhatCannotRun) {
  const std::map<std::string, std::size_t> broken{{"riser/scene.toml", 0},
                                                  {"riser/feed_bottom.toml", 0},
                                                  {"riser/feed_bottom_printed.toml", 1},
                                                  {"riser/K2_c.toml", 1},
                                                  {"riser/K2_b.toml", 0},
                                                  {"binary_riser/printed.toml", 1},
                                                  {"fixed_bed/scene.toml", 0},
                                                  {"impact/scene.toml", 0},
                                                  {"bubbling_bed/H0.16_u0.4.toml", 0}};
  for (const auto& [name, count] : broken)
    EXPECT_EQ(what_cannot_run(scene_limits(shipped(name))).size(), count) << name;
}

TEST(Advice, OnTheThesisScenesIsTheThesisChoice) {
  // Both-ways momentum and contacts everywhere but in the fixed bed; no added mass, lift,
  // turbulence, conduction or radiation anywhere; heat in ch. 2 alone; sizes in ch. 5 alone. The
  // third dimension is kept by the thesis everywhere; where front and back slip in a thin domain
  // (ch. 2.4, 5) it is not needed for the gas, and the reason says so.
  struct Expected {
    const char* scene;
    bool four_way, friction, heat, depth, sizes;
  };
  const Expected list[] = {{"fixed_bed/scene.toml", false, false, true, true, false},
                           {"bubbling_bed/scene.toml", true, true, true, false, false},
                           {"riser/scene.toml", true, true, false, true, false},
                           {"binary_riser/scene.toml", true, true, false, false, true}};
  for (const auto& e : list) {
    auto needed = advice(e.scene);
    EXPECT_TRUE(needed.at("two-way coupling")) << e.scene;
    EXPECT_EQ(needed.at("four-way coupling"), e.four_way) << e.scene;
    EXPECT_EQ(needed.at("rotation and friction"), e.friction) << e.scene;
    EXPECT_EQ(needed.at("temperature"), e.heat) << e.scene;
    EXPECT_EQ(needed.at("third dimension"), e.depth) << e.scene;
    EXPECT_EQ(needed.at("polydispersity"), e.sizes) << e.scene;
    for (const auto* model :
         {"added mass", "lift", "gas turbulence", "conduction between particles", "radiation"})
      EXPECT_FALSE(needed.at(model)) << e.scene << ": " << model;
  }
  for (const auto* scene : {"bubbling_bed/scene.toml", "binary_riser/scene.toml"})
    for (const auto& a : scene_advice(shipped(scene)))
      if (a.model == "third dimension") {
        EXPECT_NE(a.reason.find("Mu (2022)"), std::string::npos);
      }
}

TEST(Advice, ChangesWithTheScene) {
  auto scene = shipped("riser/scene.toml");
  const auto needed = [&](const std::string& model) {
    for (const auto& a : scene_advice(scene))
      if (a.model == model) return a.needed;
    throw std::out_of_range(model);
  };
  scene.particles.number = 5;  // holdup 2.6e-6, loading 5e-3
  EXPECT_FALSE(needed("four-way coupling"));
  EXPECT_TRUE(needed("gas turbulence"));
  scene.gas->density = 1000;
  EXPECT_TRUE(needed("added mass"));
  scene.species[0].source = 1e6;
  EXPECT_TRUE(needed("temperature"));
}

}  // namespace
}  // namespace bedscope::cases
