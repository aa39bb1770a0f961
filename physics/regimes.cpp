// SPDX-License-Identifier: BSD-3-Clause
#include "physics/regimes.hpp"

#include <cmath>
#include <numbers>

#include "physics/require.hpp"

namespace bedscope::physics {

double froude(double velocity, double gravity, double length) {
  require_not_negative(velocity, "velocity");
  require_positive(gravity, "gravity");
  require_positive(length, "length");
  return velocity * velocity / (gravity * length);
}

double mass_loading(double holdup, double particle_density, double gas_density) {
  require_between(holdup, 0, 1 - 1e-12, "holdup");
  require_positive(particle_density, "particle density");
  require_positive(gas_density, "gas density");
  return holdup * particle_density / ((1 - holdup) * gas_density);
}

double bagnold(const Sphere& sphere, double viscosity, double holdup, double shear_rate,
               double largest_holdup) {
  require_positive(viscosity, "viscosity");
  require_positive(holdup, "holdup");
  require_between(largest_holdup, holdup * (1 + 1e-12), 1, "largest holdup");
  require_not_negative(shear_rate, "shear rate");
  const double lambda = 1 / (std::cbrt(largest_holdup / holdup) - 1);
  return sphere.density * sphere.diameter * sphere.diameter * std::sqrt(lambda) * shear_rate /
         viscosity;
}

double biot(double heat_transfer_coefficient, double diameter, double conductivity) {
  require_not_negative(heat_transfer_coefficient, "heat transfer coefficient");
  require_positive(diameter, "diameter");
  require_positive(conductivity, "conductivity");
  return heat_transfer_coefficient * diameter / (6 * conductivity);
}

char geldart_group(const Sphere& sphere, double gas_density, double gravity) {
  require_positive(sphere.diameter, "diameter");
  require_positive(sphere.density - gas_density, "density difference");
  require_positive(gravity, "gravity");
  constexpr double adhesion = 8.76e-8;  // N
  const double excess = sphere.density - gas_density, d = sphere.diameter;
  if (excess * d * d * d * gravity < 1e-3 * adhesion) return 'C';
  if (excess * d < 0.225) return 'A';
  return excess * d * d < 1e-3 ? 'B' : 'D';
}

Coupling needed_coupling(double holdup) {
  require_between(holdup, 0, 1, "holdup");
  if (holdup < 1e-6) return Coupling::one_way;
  return holdup < 1e-3 ? Coupling::two_way : Coupling::four_way;
}

double added_mass_ratio(double particle_density, double gas_density) {
  require_positive(particle_density, "particle density");
  require_not_negative(gas_density, "gas density");
  return gas_density / (2 * particle_density);
}

double lift_over_drag(const Gas& gas, double diameter, double slip, double shear_rate,
                      double dimensionless_drag) {
  require_positive(gas.viscosity, "viscosity");
  require_positive(diameter, "diameter");
  require_positive(slip, "slip velocity");
  require_not_negative(shear_rate, "shear rate");
  require_positive(dimensionless_drag, "drag");
  const double re = gas.density * slip * diameter / gas.viscosity;
  const double re_shear = gas.density * shear_rate * diameter * diameter / gas.viscosity;
  const double root = std::sqrt(shear_rate * diameter / (2 * slip));
  const double finite = re <= 40 ? (1 - 0.3314 * root) * std::exp(-re / 10) + 0.3314 * root
                                 : 0.0524 * root * std::sqrt(re);
  return 1.615 * std::sqrt(re_shear) * finite / (3 * std::numbers::pi * dimensionless_drag);
}

double radiation_coefficient(double emissivity, double temperature) {
  require_between(emissivity, 0, 1, "emissivity");
  require_positive(temperature, "temperature");
  constexpr double stefan_boltzmann = 5.670374419e-8;  // W/m2/K4
  return 4 * stefan_boltzmann * emissivity * temperature * temperature * temperature;
}

double duct_reynolds(const Gas& gas, double velocity, double width, double depth) {
  require_positive(gas.viscosity, "viscosity");
  require_positive(width, "width");
  require_positive(depth, "depth");
  return gas.density * velocity * 2 * width * depth / (width + depth) / gas.viscosity;
}

double plate_friction(double viscosity, double velocity, double gap) {
  require_positive(gap, "gap");
  return 12 * viscosity * velocity / (gap * gap);
}

double contact_conductance(double conductivity, double contact_radius) {
  require_not_negative(conductivity, "conductivity");
  require_not_negative(contact_radius, "contact radius");
  return 2 * conductivity * contact_radius;
}

}  // namespace bedscope::physics
