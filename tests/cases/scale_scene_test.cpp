// SPDX-License-Identifier: BSD-3-Clause
// Tables 4.1, 4.2, 5.1 and 5.2 of Mu (2022), every cell, from the scenes that ship; the tables are
// those of data/curves/mu_2022, as printed.
#include "cases/scale_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "cases/scene_file.hpp"
#include "physics/contact.hpp"
#include "readers/error.hpp"

namespace bedscope::cases {
namespace {

using physics::MappingCondition;

Scene shipped(const std::string& name) {
  return read_scene(std::string(BEDSCOPE_SOURCE "/cases/") + name);
}

using Table = std::vector<std::vector<std::string>>;

Table table(const std::string& name) {
  std::ifstream file(std::string(BEDSCOPE_SOURCE "/data/curves/mu_2022/") + name);
  Table rows;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> cells;
    std::stringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    rows.push_back(cells);
  }
  return rows;
}

/// Half a unit of the last printed digit, and a hair for rounding.
double digit(const std::string& printed) {
  const auto exponent = printed.find('e');
  const auto mantissa = printed.substr(0, exponent);
  const auto point = mantissa.find('.');
  double unit =
      point == mantissa.npos ? 1 : std::pow(10, -static_cast<double>(mantissa.size() - point - 1));
  if (exponent != printed.npos) unit *= std::pow(10, std::stod(printed.substr(exponent + 1)));
  return 0.5001 * unit;
}

double cell_over_particle(const Scene& s, std::size_t species, double cells) {
  return s.geometry.width * s.geometry.depth * s.geometry.height / cells /
         physics::sphere_volume(s.species[species].diameter);
}

double cells_of(const Scene& s) {
  const auto& n = s.numerics.grid;
  return static_cast<double>(n[0]) * n[1] * n[2];
}

TEST(ScaledRiser, GivesTable41) {
  const auto riser = shipped("riser/scene.toml");
  const double factors[] = {0.8, 1, 1.25, 2};
  // Printed cells that are not the rule's, with what is: k_t of walls is 512.89, not 512.95, at
  // K = 1 (docs/physics.md); 1.0625 mm is printed as 1.06; 97,656.25 particles.
  std::map<std::string, double> slack{{"tangential spring stiffness p-w", 0.13},
                                      {"tangential spring stiffness p-p", 0.03}};
  int compared = 0;
  for (const auto& row : table("table_4_1_scaling_parameters.csv")) {
    if (row[0] == "parameter") continue;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto s = scale_scene(riser, factors[k], MappingCondition::a);
      const std::map<std::string, double> ours{
          {"particle diameter", 1e3 * s.species[0].diameter},
          {"particle density", s.species[0].density},
          {"solids volume fraction (printed: solids voidfraction)", 100 * mean_holdup(s)},
          {"particle number", static_cast<double>(s.particles.number)},
          {"gas density", s.gas->density},
          {"gas viscosity", s.gas->viscosity},
          {"gravity", s.gravity},
          {"gas velocity", s.gas->velocity},
          {"normal restitution p-p", s.contacts.particle.restitution},
          {"normal restitution p-w", s.contacts.wall.restitution},
          {"tangential restitution", s.contacts.particle.tangential_restitution},
          {"friction coefficient", s.contacts.particle.friction},
          {"normal spring stiffness", s.contacts.particle.normal_stiffness},
          {"tangential spring stiffness p-p", s.contacts.particle.tangential_stiffness()},
          {"tangential spring stiffness p-w", s.contacts.wall.tangential_stiffness()}};
      const auto& printed = row[k + 2];
      EXPECT_NEAR(ours.at(row[0]), std::stod(printed), digit(printed) + slack[row[0]])
          << row[0] << ", K = " << factors[k];
      ++compared;
    }
  }
  EXPECT_EQ(compared, 15 * 4);
}

struct Difference {
  double by_rule;  ///< cells
  int ours;        ///< whole ones along each axis
};

/// A table of mapping conditions. `different`: the cells that are printed otherwise than the rule
/// or whole cells give; there dV/V_p is the volume over the printed cells.
void expect_mapping(const Scene& scene, const std::string& file, const std::vector<double>& factors,
                    const std::map<std::pair<double, char>, Difference>& different,
                    double number_slack) {
  const auto species = scene.species.size();
  std::map<std::pair<char, std::size_t>, double> printed_cells;
  const auto rows = table(file);
  for (const auto& row : rows)
    if (row[0] == "Ncell")
      for (std::size_t k = 0; k < factors.size(); ++k)
        printed_cells[{row[1][0], k}] = std::stod(row[2 + k * species]);
  int compared = 0;
  for (const auto& row : rows) {
    if (row[0] == "quantity") continue;
    const auto condition = physics::mapping_condition(row[1]);
    for (std::size_t k = 0; k < factors.size(); ++k)
      for (std::size_t i = 0; i < species; ++i) {
        const auto column = 2 + k * species + i;
        if (column >= row.size() || row[column].empty()) continue;
        const double printed = std::stod(row[column]), K = factors[k];
        const auto s = scale_scene(scene, K, condition);
        const auto where = row[0] + " " + row[1] + ", K = " + std::to_string(K);
        ++compared;
        if (row[0] == "dV/Vp") {
          const double by_print = cell_over_particle(s, i, printed_cells[{row[1][0], k}]);
          EXPECT_NEAR(by_print / printed, 1, 0.013) << where;  // two digits: 3.644 as 3.6
        } else if (row[0] == "D/dp") {
          EXPECT_NEAR(s.geometry.depth / s.species[i].diameter, printed,
                      digit(row[column]) + 1e-3)
              << where;  // 5.647 as 5.65, 7.0588 as 7.06
        } else if (row[0] == "Ncell") {
          const auto report = scaling_report(scene, K, condition);
          const auto other = different.find({K, row[1][0]});
          if (other == different.end()) {
            EXPECT_EQ(cells_of(s), printed) << where;
            EXPECT_NEAR(report.cells_by_rule, printed, 1e-6) << where;
          } else {
            EXPECT_NE(report.cells_by_rule, printed) << where;
            EXPECT_NEAR(report.cells_by_rule, other->second.by_rule, 0.5) << where;
            EXPECT_EQ(cells_of(s), other->second.ours) << where;
          }
        } else {
          EXPECT_NEAR(static_cast<double>(s.particles.number), printed, number_slack) << where;
        }
      }
  }
  EXPECT_EQ(compared, static_cast<int>(4 * factors.size() * (2 * species + 2)));
}

TEST(ScaledRiser, GivesTable42) {
  // 126,000 is no grid of whole cells (35 x 4.8 x 750); 33,600 and 42,000 neither (22.4 x 480 of
  // them in the plane); 50,400 has 4.8 mm of depth in 3 cells, 4 x 0.8 = 3.2 by the rule.
  expect_mapping(shipped("riser/scene.toml"), "table_4_2_mapping_conditions.csv", {0.8, 1, 1.25, 2},
                 {{{0.8, 'b'}, {131250, 35 * 5 * 750}},
                  {{1.25, 'b'}, {34406, 22 * 3 * 480}},
                  {{0.8, 'c'}, {53760, 28 * 3 * 600}},
                  {{1.25, 'd'}, {43008, 22 * 4 * 480}}},
                 0);
}

TEST(ScaledBinaryRiser, GivesTable51) {
  const auto riser = shipped("binary_riser/scene.toml");
  const double factors[] = {1, 1.5, 2, 3};
  int compared = 0;
  for (const auto& row : table("table_5_1_binary_parameters.csv")) {
    if (row[0] == "parameter") continue;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto s = scale_scene(riser, factors[k], MappingCondition::a);
      const std::map<std::string, double> ours{
          {"particle diameter small", 1e6 * s.species[0].diameter},
          {"particle diameter large", 1e6 * s.species[1].diameter},
          {"particle density", s.species[1].density},
          {"particle number", static_cast<double>(s.particles.number)},
          {"gas density", s.gas->density},
          {"gas viscosity", s.gas->viscosity},
          {"gravity", s.gravity},
          {"gas velocity", s.gas->velocity},
          {"normal restitution", s.contacts.particle.restitution},
          {"tangential restitution", s.contacts.particle.tangential_restitution},
          {"friction coefficient", s.contacts.particle.friction},
          {"normal spring stiffness", s.contacts.particle.normal_stiffness},
          {"tangential spring stiffness", s.contacts.particle.tangential_stiffness()}};
      const auto& printed = row[k + 2];
      // 514.03 by the right Eq. 4.14, printed 514.08 (docs/physics.md)
      const double slack = row[0] == "tangential spring stiffness" ? 0.06 * factors[k] : 0;
      EXPECT_NEAR(ours.at(row[0]), std::stod(printed), digit(printed) + slack)
          << row[0] << ", K = " << factors[k];
      ++compared;
    }
  }
  EXPECT_EQ(compared, 13 * 4);
}

TEST(ScaledBinaryRiser, GivesTable52) {
  // 21.3 x 1.33 x 666.7 cells at K = 1.5, 10.7 x 0.67 x 333.3 at K = 3 are not whole; the depth of
  // 0.67 becomes one cell of 0.4 of what the rule asks for: ours are fewer or more. 273,095.6
  // particles are cut in the table, rounded here. Printed: two species share a number.
  auto scene = shipped("binary_riser/scene.toml");
  const std::map<std::pair<double, char>, Difference> different{{{1.5, 'b'}, {18963, 21 * 1 * 667}},
                                                                {{3.0, 'b'}, {2370, 11 * 1 * 333}},
                                                                {{1.5, 'd'}, {28444, 21 * 2 * 667}},
                                                                {{3.0, 'd'}, {7111, 11 * 2 * 333}}};
  const auto rows = table("table_5_2_mapping_conditions.csv");
  int compared = 0;
  const std::vector<double> factors{1, 1.5, 2, 3};
  std::map<std::pair<std::string, std::size_t>, double> printed_cells;
  for (const auto& row : rows)
    for (std::size_t k = 0; k < 4 && row[0] == "Ncell"; ++k)
      printed_cells[{row[1], k}] = std::stod(row[2 + 2 * k]);
  for (const auto& row : rows) {
    if (row[0] == "quantity") continue;
    const auto condition = physics::mapping_condition(row[1]);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto s = scale_scene(scene, factors[k], condition);
      const auto where = row[0] + " " + row[1] + ", K = " + std::to_string(factors[k]);
      for (std::size_t i = 0; i < 2; ++i) {
        const auto column = 2 + 2 * k + i;
        if (column >= row.size() || row[column].empty()) continue;
        const double printed = std::stod(row[column]);
        ++compared;
        if (row[0] == "D/dp")
          EXPECT_NEAR(s.geometry.depth / s.species[i].diameter, printed, 0.051) << where;
        else if (row[0] == "Np(total)")
          EXPECT_NEAR(static_cast<double>(s.particles.number), printed, 1) << where;
        else if (row[0] == "Ncell" && !different.contains({factors[k], row[1][0]}))
          EXPECT_EQ(cells_of(s), printed) << where;
        else if (row[0] == "Ncell")
          EXPECT_EQ(cells_of(s), different.at({factors[k], row[1][0]}).ours) << where;
        else
          EXPECT_NEAR(cell_over_particle(s, i, printed_cells.at({row[1], k})) / printed, 1, 0.013)
              << where;
      }
    }
  }
  EXPECT_EQ(compared, 4 * 4 * (2 + 2 + 1 + 1));
}

TEST(ScalingReport, NamesWhatIsKeptAndWhatIsNot) {
  const auto report = scaling_report(shipped("riser/scene.toml"), 2, MappingCondition::b);
  const std::map<std::string, double> expected{{"Re", 1},
                                               {"Ar", 1},
                                               {"Fr", 1},
                                               {"N_kn", 1},
                                               {"N_gamma_n", 1},
                                               {"holdup", 1},
                                               {"density ratio", 1},
                                               {"dV/V_p", 1},
                                               {"overlap", 1},
                                               {"D/d", 0.5},
                                               {"W/d", 0.5},
                                               {"St_L", 2},
                                               {"Fr_L", 2},
                                               {"pressure drop", 0.5},
                                               {"contact time", 2},
                                               {"cells in the smallest cluster", 0.25}};
  ASSERT_EQ(report.groups.size(), expected.size());
  for (const auto& g : report.groups) {
    EXPECT_NEAR(g.ratio, expected.at(g.name), 1e-12) << g.name;
    EXPECT_EQ(g.kept, expected.at(g.name) == 1) << g.name;
  }
}

TEST(ScaledScene, KeepsHertzByItsModulus) {
  const auto bed = shipped("bubbling_bed/scene.toml");
  const auto scaled = scale_scene(bed, 2, MappingCondition::b);
  EXPECT_EQ(scaled.contacts.particle.young, bed.contacts.particle.young);
  for (const auto& g : scaling_report(bed, 2, MappingCondition::b).groups) {
    EXPECT_EQ(g.kept, g.ratio == 1 || std::abs(g.ratio - 1) < 1e-9) << g.name;
    if (g.name == "N_kn" || g.name == "N_gamma_n") {
      EXPECT_TRUE(g.kept) << g.name;
    } else if (g.name == "Pr") {
      EXPECT_NEAR(g.ratio, 2, 1e-12);  // the rule does not speak of heat
    }
  }
}

TEST(ScaledScene, WithoutGasHasNoGroups) {
  const auto report = scaling_report(shipped("impact/scene.toml"), 2, MappingCondition::a);
  EXPECT_TRUE(report.groups.empty());
  EXPECT_FALSE(report.remarks.empty());
}

}  // namespace
}  // namespace bedscope::cases
