// SPDX-License-Identifier: BSD-3-Clause
#include "physics/minimum_fluidisation.hpp"

#include <cmath>

#include "physics/particle_motion.hpp"
#include "physics/require.hpp"

namespace bedscope::physics {

double minimum_fluidisation_velocity(const Sphere& sphere, const Gas& gas, double gravity,
                                     double voidage, const DragLaw& law) {
  return carrying_velocity(sphere, gas, gravity, voidage, law);
}

double minimum_fluidisation_velocity_wen_yu(const Sphere& sphere, const Gas& gas, double gravity) {
  const double load = 0.0408 * archimedes(sphere, gas, gravity);
  require_positive(load, "weight less buoyancy");
  // sqrt(a^2 + load) - a, without the cancellation of small Ar
  const double reynolds_mf = load / (std::sqrt(33.7 * 33.7 + load) + 33.7);
  return reynolds_mf * gas.viscosity / (gas.density * sphere.diameter);
}

double fixed_bed_pressure_gradient(const Sphere& sphere, const Gas& gas, double voidage,
                                   double superficial_velocity, const DragLaw& law) {
  const double drag = law(voidage, reynolds(gas, superficial_velocity, sphere.diameter));
  return momentum_exchange(drag, voidage, gas, sphere.diameter) * superficial_velocity /
         (voidage * voidage);
}

double bed_pressure_drop(double solids_mass, double area, double particle_density,
                         double gas_density, double gravity) {
  require_not_negative(solids_mass, "solids mass");
  require_positive(area, "area");
  require_positive(particle_density, "particle density");
  require_not_negative(gas_density, "gas density");
  require_positive(gravity, "gravity");
  return solids_mass * gravity * (1 - gas_density / particle_density) / area;
}

}  // namespace bedscope::physics
