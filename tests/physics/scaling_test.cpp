// SPDX-License-Identifier: BSD-3-Clause
// Tables 4.1, 4.2, 5.1 and 5.2 of Mu (2022) from the rule, cell by cell; where a table parts from
// the rule the printed number stands beside what the rule gives, with the reason.
#include "physics/scaling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "physics/contact.hpp"
#include "physics/phases.hpp"

namespace bedscope::physics {
namespace {

constexpr MappingCondition a = MappingCondition::a, b = MappingCondition::b,
                           c = MappingCondition::c, d = MappingCondition::d;

/// The riser of ch. 4 at K = 1, and 1.5 m high: its 28 x 4 x 600 cells of 2.5 x 1.5 x 2.5 mm need
/// that, not the 1.57 m that Table 4.2 names.
const ScaledScene riser = {0.85e-3, 2500, 50000, 1.2, 1.8e-5, 5.55,   9.81,  1600,
                           2e-3,    0.07, 0.006, 1.5, 2.5e-3, 1.5e-3, 2.5e-3};

/// The binary riser of ch. 5, its small particles: 32 x 2 x 1000 cells.
const ScaledScene binary = {125e-6, 2400,  614465, 1.2, 1.8e-5, 1.0,    9.81, 1600,
                            1e-6,   0.032, 0.0012, 1.0, 1e-3,   0.6e-3, 1e-3};

double cells(const ScaledScene& s) {
  return s.width * s.depth * s.height / (s.cell_x * s.cell_y * s.cell_z);
}

double group(const ScaledScene& scene, std::string_view name) {
  for (const auto& entry : dimensionless_groups(scene))
    if (entry.name == name) return entry.value;
  throw std::domain_error("no such group");
}

TEST(ScalingRule, GivesTable41) {
  struct Column {
    double factor, d, number, mu, g, k_n, k_t_pp, k_t_pw;
  };
  const Column columns[] = {{0.8, 0.68e-3, 97656, 1.44e-5, 12.26, 1280, 411.2, 410.36},
                            {1, 0.85e-3, 50000, 1.8e-5, 9.81, 1600, 514, 512.95},
                            {1.25, 1.06e-3, 25600, 2.25e-5, 7.848, 2000, 642.5, 641.2},
                            {2, 1.70e-3, 6250, 3.6e-5, 4.905, 3200, 1028, 1025.9}};
  for (const Column& printed : columns) {
    const auto factors = scaling_factors(printed.factor, a);
    const auto scaled = scale(riser, factors);
    EXPECT_NEAR(scaled.particle_diameter, printed.d, 5e-6);  // two digits of mm: 1.0625 as 1.06
    EXPECT_EQ(std::floor(scaled.particle_number + 1e-6), printed.number);  // 97656.25 cut
    EXPECT_NEAR(scaled.gas_viscosity / printed.mu, 1, 1e-12);              // exact
    EXPECT_NEAR(scaled.gravity, printed.g, 5e-3);                          // 12.2625 as 12.26
    EXPECT_NEAR(scaled.normal_stiffness / printed.k_n, 1, 1e-12);          // exact
    EXPECT_NEAR(514 * factors.stiffness, printed.k_t_pp, 1e-9);            // exact
    EXPECT_NEAR(512.95 * factors.stiffness, printed.k_t_pw, 0.05);         // one digit
    // The rule itself gives 512.89: see contact_test.
    EXPECT_NEAR(1600 * tangential_stiffness_ratio(0.86, 0.33) * factors.stiffness, printed.k_t_pw,
                0.06 * printed.factor + 0.05);
    EXPECT_EQ(scaled.particle_density, 2500);
    EXPECT_EQ(scaled.gas_density, 1.2);
    EXPECT_EQ(scaled.gas_velocity, 5.55);
    EXPECT_NEAR(group(scaled, "holdup"), 0.0255, 5e-5);  // last digit
  }
}

struct Mapping {
  double factor;
  MappingCondition condition;
  double cell_over_particle, depth_over_diameter, number, cells;
  double cells_by_rule;  ///< where the printed one differs: grids have whole cells
};

/// What both tables must do: number and depth by the rule, cells by the rule or as remarked, and a
/// dV/V_p that is the volume over the printed cells.
void expect_table(const ScaledScene& scene, const Mapping& printed, double digit) {
  const auto scaled = scale(scene, scaling_factors(printed.factor, printed.condition));
  const std::string where =
      std::to_string(printed.factor) + " " + "abcd"[static_cast<int>(printed.condition)];
  EXPECT_NEAR(scaled.particle_number, printed.number, 1) << where;  // rounded or cut
  EXPECT_NEAR(cells(scaled), printed.cells_by_rule, 0.5) << where;
  const auto factors = scaling_factors(printed.factor, printed.condition);
  EXPECT_NEAR(cells(scaled) / cells(scene), factors.cell_number, 1e-9) << where;
  EXPECT_NEAR(group(scaled, "D/d"), printed.depth_over_diameter, digit) << where;
  const double volume = scaled.width * scaled.depth * scaled.height;
  const double by_print = volume / printed.cells / sphere_volume(scaled.particle_diameter);
  EXPECT_NEAR(by_print / printed.cell_over_particle, 1, 0.013)
      << where;  // two digits: 3.644 as 3.6
}

TEST(ScalingRule, GivesTable42) {
  // Cells: 126000 is 35 x 4.8 x 750 and 33600 is 0.977 of the rule's 34406, both not whole in
  // depth; 50400 has the 4.8 mm of depth in 3 cells of 1.6 mm, not 3.2; 42000 has 18.75 mm3
  // for 18.31.
  const Mapping table[] = {
      {0.8, a, 57.0, 8.82, 97656, 67200, 67200},    {1, a, 29.2, 7.06, 50000, 67200, 67200},
      {1.25, a, 14.9, 5.65, 25600, 67200, 67200},   {2, a, 3.6, 3.53, 6250, 67200, 67200},
      {0.8, b, 30.4, 8.82, 97656, 126000, 131250},  {1, b, 29.2, 7.06, 50000, 67200, 67200},
      {1.25, b, 29.9, 5.65, 25600, 33600, 34406.4}, {2, b, 29.2, 3.53, 6250, 8400, 8400},
      {0.8, c, 60.8, 7.06, 78125, 50400, 53760},    {1, c, 29.2, 7.06, 50000, 67200, 67200},
      {1.25, c, 14.9, 7.06, 32000, 84000, 84000},   {2, c, 3.6, 7.06, 12500, 134400, 134400},
      {0.8, d, 29.2, 7.06, 78125, 105000, 105000},  {1, d, 29.2, 7.06, 50000, 67200, 67200},
      {1.25, d, 29.9, 7.06, 32000, 42000, 43008},   {2, d, 29.2, 7.06, 12500, 16800, 16800}};
  for (const Mapping& cell : table) expect_table(riser, cell, 5.1e-3);
}

TEST(ScalingRule, GivesTable51) {
  struct Column {
    double factor, small, large, number, mu, g, k_n, k_t;
  };
  const Column columns[] = {{1, 125e-6, 185e-6, 614465, 1.8e-5, 9.81, 1600, 514.08},
                            {1.5, 187.5e-6, 277.5e-6, 182064, 2.7e-5, 6.54, 2400, 771.13},
                            {2, 250e-6, 370e-6, 76808, 3.6e-5, 4.905, 3200, 1028.17},
                            {3, 375e-6, 555e-6, 22758, 5.4e-5, 3.27, 4800, 1542.25}};
  for (const Column& printed : columns) {
    const auto factors = scaling_factors(printed.factor, b);
    const auto scaled = scale(binary, factors);
    EXPECT_NEAR(scaled.particle_diameter / printed.small, 1, 1e-12);
    EXPECT_NEAR(185e-6 * factors.diameter / printed.large, 1, 1e-12);  // the same for each species
    EXPECT_EQ(std::round(scaled.particle_number), printed.number);
    EXPECT_NEAR(scaled.gas_viscosity / printed.mu, 1, 1e-12);
    EXPECT_NEAR(scaled.gravity / printed.g, 1, 1e-12);
    EXPECT_NEAR(scaled.normal_stiffness / printed.k_n, 1, 1e-12);
    EXPECT_NEAR(514.0834 * factors.stiffness, printed.k_t, 5e-3);  // her base has more digits
  }
}

TEST(ScalingRule, GivesTable52) {
  // Cells: by the rule 64000 / 1.5^3 = 18963, 64000 / 3^3 = 2370, 64000 / 1.5^2 = 28444 and
  // 64000 / 3^2 = 7111; printed are grids of whole cells. That is where dV/V_p is off by up to 18
  // %.
  struct Large {
    double cell_over_particle, depth_over_diameter;
  };
  const std::pair<Mapping, Large> table[] = {
      {{1, a, 587.0, 9.6, 614465, 64000, 64000}, {181.1, 6.5}},
      {{1.5, a, 173.9, 6.4, 182064, 64000, 64000}, {53.7, 4.3}},
      {{2, a, 73.4, 4.8, 76808, 64000, 64000}, {22.6, 3.2}},
      {{3, a, 21.7, 3.2, 22758, 64000, 64000}, {6.7, 2.2}},
      {{1.5, b, 695.7, 6.4, 182064, 16000, 18963}, {214.6, 4.3}},
      {{2, b, 587.0, 4.8, 76808, 8000, 8000}, {181.1, 3.2}},
      {{3, b, 695.7, 3.2, 22758, 2000, 2370.4}, {214.6, 2.2}},
      {{1.5, c, 173.9, 9.6, 273095, 96000, 96000}, {53.7, 6.5}},
      {{2, c, 73.4, 9.6, 153616, 128000, 128000}, {22.6, 6.5}},
      {{3, c, 21.7, 9.6, 68274, 192000, 192000}, {6.7, 6.5}},
      {{1.5, d, 521.8, 9.6, 273095, 32000, 28444.4}, {161.0, 6.5}},
      {{2, d, 587.0, 9.6, 153616, 16000, 16000}, {181.1, 6.5}},
      {{3, d, 521.8, 9.6, 68274, 8000, 7111.1}, {161.0, 6.5}}};
  ScaledScene large = binary;
  large.particle_diameter = 185e-6;
  for (const auto& [small_row, of_large] : table) {
    expect_table(binary, small_row, 0.051);
    Mapping large_row = small_row;
    large_row.cell_over_particle = of_large.cell_over_particle;
    large_row.depth_over_diameter = of_large.depth_over_diameter;
    expect_table(large, large_row, 0.051);
  }
}

TEST(ScalingRule, KeepsWhatItSaysAndNotTheRest) {
  // Powers of K of each group: what is kept has 0. dV/V_p, D/d and the cells of a cluster follow
  // from the condition.
  const std::map<std::string_view, double> powers = {
      {"Re", 0},    {"Ar", 0},      {"Fr", 0},       {"N_kn", 0}, {"N_gamma", 0},
      {"N_rho", 0}, {"holdup", 0},  {"W/d", -1},     {"St_L", 1}, {"Fr_L", 1},
      {"Eu", -1},   {"t_c u/H", 1}, {"overlap/d", 0}};
  const std::map<std::string_view, std::map<MappingCondition, double>> by_condition = {
      {"dV/V_p", {{a, -3}, {b, 0}, {c, -3}, {d, 0}}},
      {"D/d", {{a, -1}, {b, -1}, {c, 0}, {d, 0}}},
      {"cluster cells", {{a, 0}, {b, -2}, {c, 0}, {d, -2}}}};
  for (const double K : {0.8, 1.25, 2.0, 3.0})
    for (const auto condition : {a, b, c, d}) {
      const auto groups = groups_under_scaling(riser, K, condition);
      EXPECT_EQ(groups.size(), powers.size() + by_condition.size());
      for (const auto& entry : groups) {
        const auto known = powers.find(entry.name);
        const double power =
            known != powers.end() ? known->second : by_condition.at(entry.name).at(condition);
        EXPECT_NEAR(entry.ratio, std::pow(K, power), 1e-12 * std::pow(K, power)) << entry.name;
        EXPECT_EQ(entry.kept, power == 0) << entry.name;
        EXPECT_NEAR(entry.scaled_value, entry.value * entry.ratio, 1e-12 * entry.scaled_value);
      }
    }
}

TEST(ScalingRule, KeepsTheRestitutionThatTheDashpotGives) {
  const double m = sphere_mass({0.85e-3, 2500}) / 2;
  ScaledScene scene = riser;
  scene.damping = damping_coefficient(1600, m, 0.96);
  for (const double K : {0.8, 2.0}) {
    const auto scaled = scale(scene, scaling_factors(K, b));
    EXPECT_NEAR(restitution_from_damping(scaled.normal_stiffness, m * K * K * K, scaled.damping),
                0.96, 1e-12);  // rounding
  }
}

TEST(ScalingRule, LeavesTheSmallestClusterAtTwoCells) {
  EXPECT_NEAR(group(riser, "cluster cells"), 9.6, 1e-9);  // 60 mm2 over 2.5 x 2.5 mm2
  EXPECT_NEAR(group(scale(riser, scaling_factors(2, b)), "cluster cells"), 2.4, 1e-9);
}

TEST(ScalingRule, OfOneIsNoChange) {
  for (const auto condition : {a, b, c, d})
    for (const auto& entry : groups_under_scaling(riser, 1, condition)) {
      EXPECT_EQ(entry.value, entry.scaled_value) << entry.name;
      EXPECT_TRUE(entry.kept) << entry.name;
    }
}

TEST(Groups, OfTheRiserByHand) {
  EXPECT_NEAR(group(riser, "Re"), 314.5, 1e-9);                           // 1.2 5.55 0.85 / 0.018
  EXPECT_NEAR(group(riser, "Fr"), 5.55 * 5.55 / (9.81 * 0.85e-3), 1e-6);  // definition
  EXPECT_NEAR(group(riser, "dV/V_p"), 9.375 / 0.321555, 1e-3);            // mm3
  EXPECT_NEAR(group(riser, "t_c u/H"), 49.8e-6 * 5.55 / 1.5, 2e-7);       // t_c has three digits
  EXPECT_NEAR(group(riser, "Eu") * 1.2 * 5.55 * 5.55, 938.83 * (1 - 1.2 / 2500), 0.01);  // weight/A
}

TEST(ScalingRule, RefusesWhatIsNoFactorAndNoCondition) {
  EXPECT_EQ(mapping_condition("c"), c);
  EXPECT_THROW(mapping_condition("e"), std::domain_error);
  EXPECT_THROW(mapping_condition(""), std::domain_error);
  for (const double K : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(scaling_factors(K, a), std::domain_error);
  ScaledScene bad = riser;
  bad.cell_y = 0;
  EXPECT_THROW(dimensionless_groups(bad), std::domain_error);
}

TEST(Groups, OfASceneWithoutDampingAreKeptToo) {
  ScaledScene elastic = riser;
  elastic.damping = 0;
  for (const auto& entry : groups_under_scaling(elastic, 2, b))
    if (entry.name == "N_gamma") {
      EXPECT_EQ(entry.ratio, 1);
      EXPECT_TRUE(entry.kept);
    }
}

}  // namespace
}  // namespace bedscope::physics
