// SPDX-License-Identifier: BSD-3-Clause
// Closed forms of beds and their particles, as references.
#include <array>

#include "physics/contact.hpp"
#include "physics/drag.hpp"
#include "physics/fixed_bed.hpp"
#include "physics/minimum_fluidisation.hpp"
#include "physics/packing.hpp"
#include "physics/particle_motion.hpp"
#include "physics/well_mixed_bed.hpp"
#include "validation/quantity.hpp"
#include "validation/theory_parts.hpp"

namespace bedscope::validation {
namespace {

using analysis::RunResult;

physics::Sphere sphere(const Parameters& with) {
  return {with("diameter"), with("particle_density")};
}
physics::Gas gas(const Parameters& with) { return {with("gas_density"), with("gas_viscosity")}; }

double bed_weight(const Parameters& with, const RunResult& run, double) {
  const double mass =
      with.has("mass") ? with("mass") : sample(run, {.quantity = "inventory"}).value.front();
  return physics::bed_pressure_drop(mass, with("area"), with("particle_density"),
                                    with("gas_density"), with("gravity"));
}

double terminal_velocity(const Parameters& with, const RunResult&, double) {
  return physics::terminal_velocity(sphere(with), gas(with), with("gravity"));
}

double minimum_fluidisation(const Parameters& with, const RunResult&, double) {
  return physics::minimum_fluidisation_velocity(sphere(with), gas(with), with("gravity"),
                                                with("voidage"));
}

double minimum_fluidisation_wen_yu(const Parameters& with, const RunResult&, double) {
  return physics::minimum_fluidisation_velocity_wen_yu(sphere(with), gas(with), with("gravity"));
}

/// Of the particles that the check's `source` heats; `fraction` of the solids' volume is so.
double well_mixed_bed(const Parameters& with, const RunResult&, double) {
  const double fraction = with.or_else("fraction", 1);
  const std::array<physics::HeatedFraction, 2> fractions{
      {{fraction, with("source")}, {1 - fraction, with.or_else("other_source", 0)}}};
  return physics::equilibrium_temperatures(
             {with("inlet_temperature"), with("superficial_velocity"), with("gas_heat_capacity"),
              with("solids_height"), with("diameter"), with("heat_transfer_coefficient")},
             fractions)
      .particle[0];
}

physics::BedTemperatures fixed_bed_at(const Parameters& with, double z) {
  return physics::fixed_bed_temperatures(
      {with("voidage"), with("superficial_velocity"), with("gas_heat_capacity"),
       with("solids_heat_capacity"), with("heat_exchange"), with("initial_temperature"),
       with("inlet_temperature"), with.or_else("source", 0)},
      z - with.or_else("bottom", 0), with("time"));
}
double fixed_bed(const Parameters& with, const RunResult&, double z) {
  return fixed_bed_at(with, z).particle;
}
double fixed_bed_gas(const Parameters& with, const RunResult&, double z) {
  return fixed_bed_at(with, z).gas;
}

double fixed_bed_pressure_drop(const Parameters& with, const RunResult&, double) {
  return with("height") * physics::fixed_bed_pressure_gradient(sphere(with), gas(with),
                                                               with("voidage"),
                                                               with("superficial_velocity"));
}

/// No net flux of volume: phi v + eps u = 0, so that v is the superficial slip velocity, downwards.
double batch_settling(const Parameters& with, const RunResult&, double) {
  return -physics::carrying_velocity(sphere(with), gas(with), with("gravity"), with("voidage"),
                                     physics::beetstra);
}

double rebound(const Parameters& with, const RunResult&, double) {
  return with("impact_velocity") * physics::restitution_from_damping(
                                       with("stiffness"), with("effective_mass"), with("damping"));
}

double relaxing_temperature(const Parameters& with, const RunResult&, double time) {
  return physics::relaxing_temperature(with("start"), with("equilibrium"), with("thermal_time"),
                                       time);
}

double random_close_packing(const Parameters&, const RunResult&, double) {
  return physics::random_close_packing;
}
double random_loose_packing(const Parameters&, const RunResult&, double) {
  return physics::random_loose_packing;
}

}  // namespace

std::vector<Theory> theories_of_beds() {
  return {
      {{"batch settling",
        "m/s",
        {"diameter", "particle_density", "gas_density", "gas_viscosity", "gravity", "voidage"},
        {},
        "Beetstra, van der Hoef and Kuipers (2007)",
        "velocity of solids that settle in a closed vessel, below 0; no clusters; voidage 0.4 to "
        "0.9, Re up to 1000"},
       batch_settling},
      {{"bed weight",
        "Pa",
        {"area", "particle_density", "gas_density", "gravity"},
        {"mass"},
        "momentum balance of a fluidised bed",
        "fluidised; neither wall friction nor acceleration; mass: the run's where left out"},
       bed_weight},
      {{"fixed bed",
        "K",
        {"voidage", "superficial_velocity", "gas_heat_capacity", "solids_heat_capacity",
         "heat_exchange", "initial_temperature", "inlet_temperature", "time"},
        {"source", "bottom"},
        "Anzelius (1926), Schumann (1929)",
        "particles of a fixed bed at one time; one dimension, no conduction along the bed, no "
        "wall"},
       fixed_bed},
      {{"fixed bed gas",
        "K",
        {"voidage", "superficial_velocity", "gas_heat_capacity", "solids_heat_capacity",
         "heat_exchange", "initial_temperature", "inlet_temperature", "time"},
        {"source", "bottom"},
        "Anzelius (1926), Schumann (1929)",
        "the gas in it"},
       fixed_bed_gas},
      {{"fixed bed pressure drop",
        "Pa",
        {"diameter", "particle_density", "gas_density", "gas_viscosity", "voidage",
         "superficial_velocity", "height"},
        {},
        "Ergun (1952)",
        "at rest, below minimum fluidisation; voidage up to about 0.8"},
       fixed_bed_pressure_drop},
      {{"minimum fluidisation",
        "m/s",
        {"diameter", "particle_density", "gas_density", "gas_viscosity", "gravity", "voidage"},
        {},
        "Ergun (1952)",
        "superficial; a steep function of the voidage at rest"},
       minimum_fluidisation},
      {{"minimum fluidisation Wen-Yu",
        "m/s",
        {"diameter", "particle_density", "gas_density", "gas_viscosity", "gravity"},
        {},
        "Wen and Yu (1966)",
        "superficial; where the voidage at rest is not known; within about 30 %"},
       minimum_fluidisation_wen_yu},
      {{"random close packing",
        "-",
        {},
        {},
        "Scott and Kilgour (1969)",
        "equal spheres, far from walls"},
       random_close_packing},
      {{"random loose packing",
        "-",
        {},
        {},
        "Onoda and Liniger (1990)",
        "equal spheres, far from walls"},
       random_loose_packing},
      {{"rebound",
        "m/s",
        {"stiffness", "effective_mass", "damping", "impact_velocity"},
        {},
        "damped linear oscillator",
        "head-on, linear spring and dashpot, contact ends at zero overlap"},
       rebound},
      {{"relaxing temperature",
        "K",
        {"start", "equilibrium", "thermal_time"},
        {},
        "heat balance of a stirred vessel",
        "along time; no losses, gas perfectly mixed"},
       relaxing_temperature},
      {{"terminal velocity",
        "m/s",
        {"diameter", "particle_density", "gas_density", "gas_viscosity", "gravity"},
        {},
        "Schiller and Naumann (1935)",
        "one sphere in gas at rest; Re up to 2e5"},
       terminal_velocity},
      {{"well-mixed bed",
        "K",
        {"inlet_temperature", "superficial_velocity", "gas_heat_capacity", "solids_height",
         "diameter", "heat_transfer_coefficient", "source"},
        {"fraction", "other_source"},
        "Mu (2022), Eqs. 2.15-2.17",
        "the particles that `source` heats; one stirred vessel at equilibrium, no losses"},
       well_mixed_bed},
  };
}

}  // namespace bedscope::validation
