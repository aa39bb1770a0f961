// SPDX-License-Identifier: BSD-3-Clause
#include "physics/time_steps.hpp"

#include <algorithm>
#include <cmath>

#include "physics/require.hpp"

namespace bedscope::physics {

double rayleigh_time(const Sphere& sphere, double young, double poisson) {
  require_positive(sphere.diameter, "diameter");
  require_positive(sphere.density, "density");
  require_positive(young, "modulus");
  require_between(poisson, 0, 0.5, "Poisson ratio");
  const double shear = young / (2 * (1 + poisson));
  return std::numbers::pi * sphere.diameter / 2 * std::sqrt(sphere.density / shear) /
         (0.1631 * poisson + 0.8766);
}

double gas_relaxation_time(double voidage, double gas_density, double momentum_exchange) {
  require_voidage(voidage);
  require_positive(gas_density, "gas density");
  require_positive(momentum_exchange, "momentum exchange");
  return voidage * gas_density / momentum_exchange;
}

double solids_relaxation_time(double voidage, double particle_density, double momentum_exchange) {
  require_voidage(voidage);
  require_positive(particle_density, "particle density");
  require_positive(momentum_exchange, "momentum exchange");
  return (1 - voidage) * particle_density / momentum_exchange;
}

double longest_drag_step(double voidage, double particle_density, double momentum_exchange) {
  const double tau = solids_relaxation_time(voidage, particle_density, momentum_exchange);
  return 2 * std::min(1.0, voidage / (1 - voidage)) * voidage * tau;
}

double longest_heat_step(double step_over_gas_time, double courant) {
  require_not_negative(step_over_gas_time, "step");
  require_not_negative(courant, "Courant number");
  return 2 * (1 + step_over_gas_time / (2 + courant));
}

double gas_thermal_time(double voidage, double gas_heat_capacity, double heat_exchange) {
  require_voidage(voidage);
  require_positive(gas_heat_capacity, "heat capacity");
  require_positive(heat_exchange, "heat exchange");
  return voidage * gas_heat_capacity / heat_exchange;
}

double courant(double velocity, double step, double cell) {
  require_positive(step, "step");
  require_positive(cell, "cell");
  return velocity * step / cell;
}

}  // namespace bedscope::physics
