// SPDX-License-Identifier: BSD-3-Clause
// The theories of a check are those of physics/, with every parameter in its place.
#include "validation/theory.hpp"

#include <gtest/gtest.h>

#include "readers/error.hpp"

namespace bedscope::validation {
namespace {

Sampled at(std::vector<double> x, const char* unit) {
  Sampled s{.x = {"z", "m"}, .y = {"quantity", unit}, .at = std::move(x)};
  s.is_scalar = s.at.size() == 1;
  return s;
}

double value(const std::string& name, const std::map<std::string, double>& with, const char* unit,
             double x = 0) {
  analysis::RunResult run;
  run.inventory_mass.value = 0.04;
  return theory_curve(name, with, run, at({x}, unit)).points.at(0).y;
}

TEST(Theory, BedWeightIsThatOfTheRunsSolids) {
  const std::map<std::string, double> with{
      {"area", 4.2e-4}, {"particle_density", 2500}, {"gas_density", 1.2}, {"gravity", 9.81}};
  EXPECT_NEAR(value("bed weight", with, "Pa"), 0.04 * 9.81 / 4.2e-4 * (1 - 1.2 / 2500), 1e-9);
  auto heavier = with;
  heavier["mass"] = 0.08;
  EXPECT_NEAR(value("bed weight", heavier, "Pa"), 2 * value("bed weight", with, "Pa"), 1e-9);
}

TEST(Theory, TerminalVelocityOfTheRisersGlassIsThatOfSchillerAndNaumann) {
  EXPECT_NEAR(value("terminal velocity",
                    {{"diameter", .85e-3},
                     {"particle_density", 2500},
                     {"gas_density", 1.2},
                     {"gas_viscosity", 1.8e-5},
                     {"gravity", 9.81}},
                    "m/s"),
              5.95, .01);
}

TEST(Theory, AFixedBedIsAtItsInletTemperatureBelowAndAtItsStartAboveTheFront) {
  const std::map<std::string, double> with{{"voidage", .4},
                                           {"superficial_velocity", .5},
                                           {"gas_heat_capacity", 1200},
                                           {"solids_heat_capacity", 2e6},
                                           {"heat_exchange", 1e5},
                                           {"initial_temperature", 300},
                                           {"inlet_temperature", 400},
                                           {"time", 100}};
  EXPECT_NEAR(value("fixed bed", with, "K", 0), 400, .1);
  EXPECT_NEAR(value("fixed bed", with, "K", 1), 300, .1);
}

TEST(Theory, FaultsOfACheckAreOneLine) {
  EXPECT_THROW(value("bed wieght", {}, "Pa"), InputError);
  EXPECT_THROW(value("bed weight", {{"area", 1}}, "Pa"), InputError);
  EXPECT_THROW(value("random close packing", {{"area", 1}}, "-"), InputError);
  EXPECT_THROW(value("random close packing", {}, "Pa"), InputError);
  EXPECT_DOUBLE_EQ(value("random close packing", {}, "-"), .6366);
}

}  // namespace
}  // namespace bedscope::validation
