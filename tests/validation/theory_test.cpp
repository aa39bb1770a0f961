// SPDX-License-Identifier: BSD-3-Clause
// The theories of a check are those of physics/, with every parameter in its place.
#include "validation/theory.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(Theory, BedWeightOfARunGivenAsTablesIsThatOfItsInventory) {
  analysis::RunResult run;
  run.window = {.from = 1, .to = 3, .snapshots = 3};
  for (const auto& [time, mass] : {std::pair{0.0, 1.0}, {1.0, 0.03}, {2.0, 0.04}, {3.0, 0.05}})
    run.inventory.push_back({.time = time, .type = "all", .solids_mass = mass});
  const std::map<std::string, double> with{
      {"area", 4.2e-4}, {"particle_density", 2500}, {"gas_density", 1.2}, {"gravity", 9.81}};
  EXPECT_EQ(theory_curve("bed weight", with, run, at({0}, "Pa")).points.at(0).y,
            value("bed weight", with, "Pa"));
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

/// By people who know nothing of bedscope; each to the digits that they give.
TEST(Theory, GivesWhatOthersPublish) {
  // GPSA Engineering Data Book, 13th ed., example 7-1: a droplet of 150 um, 31.2 lb/ft3, in gas of
  // 2.07 lb/ft3 falls at 0.46 ft/s.
  constexpr double foot = .3048, pound_per_cubic_foot = .45359237 / (foot * foot * foot);
  EXPECT_NEAR(value("terminal velocity",
                    {{"diameter", 150e-6},
                     {"particle_density", 31.2 * pound_per_cubic_foot},
                     {"gas_density", 2.07 * pound_per_cubic_foot},
                     {"gas_viscosity", 1.2e-5},
                     {"gravity", 9.80665}},
                    "m/s") /
                  foot,
              .46, .005);
  // The Python library fluids (C. Bell and contributors), Ergun(): 1338.8671874999995 Pa a metre.
  EXPECT_NEAR(value("fixed bed pressure drop",
                    {{"diameter", 8e-4},
                     {"particle_density", 2500},
                     {"gas_density", 1e3},
                     {"gas_viscosity", 1e-3},
                     {"voidage", .4},
                     {"superficial_velocity", 1e-3},
                     {"height", 1}},
                    "Pa"),
              1338.8671874999995, 1e-9);
  // Wen and Yu, AIChE J. 12 (1966) 610: their equation, written out.
  EXPECT_NEAR(value("minimum fluidisation Wen-Yu",
                    {{"diameter", 1e-3},
                     {"particle_density", 2500},
                     {"gas_density", 1.2},
                     {"gas_viscosity", 1.8e-5},
                     {"gravity", 9.81}},
                    "m/s"),
              1.8e-5 / 1.2e-3 *
                  (std::sqrt(33.7 * 33.7 + .0408 * 1.2 * (2500 - 1.2) * 9.81e-9 / 3.24e-10) - 33.7),
              1e-12);
  // Berryman, Phys. Rev. A 27 (1983) 1053: 0.64 +- 0.02 for the densest random packing.
  EXPECT_NEAR(value("random close packing", {}, "-"), .64, .02);
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

TEST(Theory, ClosuresOfOneSphereAreTheirFormulasWrittenOut) {
  EXPECT_NEAR(value("drag Ergun", {{"voidage", .4}, {"reynolds", 100}}, "-"),
              (150 * .6 + 1.75 * 100) / (18 * .16), 1e-12);
  const double schiller_naumann = 1 + .15 * std::pow(100, .687);
  EXPECT_NEAR(value("drag Wen-Yu", {{"voidage", .9}, {"reynolds", 100}}, "-"),
              schiller_naumann * std::pow(.9, -3.65), 1e-12);
  EXPECT_NEAR(value("drag Gidaspow", {{"voidage", .9}, {"reynolds", 100}}, "-"),
              schiller_naumann * std::pow(.9, -3.65), 1e-12);
  EXPECT_NEAR(value("drag Di Felice", {{"voidage", 1}, {"reynolds", 100}}, "-"),
              std::pow(.63 + .48, 2) * 100 / 24, 1e-12);
  // Beetstra et al. (2007), eq. 16, at rest and of a lone sphere.
  EXPECT_NEAR(value("drag Beetstra", {{"voidage", .5}, {"reynolds", 0}}, "-"),
              10 * .5 / .25 + .25 * (1 + 1.5 * std::sqrt(.5)), 1e-12);
  EXPECT_NEAR(value("drag Beetstra", {{"voidage", 1}, {"reynolds", 100}}, "-"),
              1 + .413 * 100 / 24 * (1 + 8.4 * std::pow(100, -.343)) / (1 + .1), 1e-12);
  // Gunn (1978) for a lone sphere: 2 (1 + 0.7 Re^0.2 Pr^1/3) + 0.13 Re^0.7 Pr^1/3.
  EXPECT_NEAR(value("Nusselt Gunn", {{"voidage", 1}, {"reynolds", 100}, {"prandtl", 8}}, "-"),
              2 * (1 + .7 * std::pow(100, .2) * 2) + .13 * std::pow(100, .7) * 2, 1e-12);
}

TEST(Theory, ClosuresOfOneContactAreTheRisersAndHertzs) {
  const double half_mass = .5 * 2500 * std::acos(-1) / 6 * std::pow(.85e-3, 3);
  const std::map<std::string, double> linear{{"stiffness", 1600}, {"effective_mass", half_mass}};
  auto with = linear;
  EXPECT_NEAR(value("contact time", with, "s"), 49.8e-6, .1e-6);  // Mu (2022), the riser's glass
  with["restitution"] = .96;
  // m x'' + eta x' + k x = 0 loses exp(-eta t_c / 2 m) of its velocity in half a period.
  EXPECT_NEAR(std::exp(-value("damping coefficient", with, "kg/s") *
                       value("contact time", with, "s") / (2 * half_mass)),
              .96, 1e-12);
  EXPECT_NEAR(
      value("stiffness ratio", {{"restitution", .96}, {"tangential_restitution", .33}}, "-"),
      2. / 7 * (std::pow(std::acos(-1), 2) + std::pow(std::log(.33), 2)) /
          (std::pow(std::acos(-1), 2) + std::pow(std::log(.96), 2)),
      1e-12);
  with = linear;
  with["impact_velocity"] = 2;  // all of the energy is in the spring: k delta^2 = m v^2
  EXPECT_NEAR(value("largest overlap", with, "m"), 2 * std::sqrt(half_mass / 1600), 1e-15);
  const std::map<std::string, double> hertz{{"effective_modulus", 3e5},
                                            {"effective_radius", 5e-4},
                                            {"effective_mass", half_mass},
                                            {"impact_velocity", 2}};
  const double overlap = value("largest overlap Hertz", hertz, "m");
  EXPECT_NEAR(8. / 15 * 3e5 * std::sqrt(5e-4) * std::pow(overlap, 2.5), .5 * half_mass * 4, 1e-15);
  EXPECT_NEAR(value("contact time Hertz", hertz, "s"), 2.9433 * overlap / 2, 1e-4 * overlap);
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
