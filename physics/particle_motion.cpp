// SPDX-License-Identifier: BSD-3-Clause
#include "physics/particle_motion.hpp"

#include "physics/require.hpp"

namespace bedscope::physics {
namespace {

void require_phases(const Sphere& sphere, const Gas& gas) {
  require_positive(sphere.diameter, "diameter");
  require_positive(sphere.density, "particle density");
  require_positive(gas.density, "gas density");
  require_positive(gas.viscosity, "viscosity");
}

}  // namespace

double archimedes(const Sphere& sphere, const Gas& gas, double gravity) {
  require_phases(sphere, gas);
  require_positive(gravity, "gravity");
  const double d = sphere.diameter;
  return gas.density * (sphere.density - gas.density) * gravity * d * d * d /
         (gas.viscosity * gas.viscosity);
}

double reynolds(const Gas& gas, double velocity, double diameter) {
  require_positive(gas.density, "gas density");
  require_positive(gas.viscosity, "viscosity");
  require_not_negative(velocity, "velocity");
  require_positive(diameter, "diameter");
  return gas.density * velocity * diameter / gas.viscosity;
}

double drag_coefficient_schiller_naumann(double reynolds) {
  return drag_coefficient(reynolds, wen_yu);
}

double drag_coefficient(double reynolds, const DragLaw& law) {
  require_positive(reynolds, "Reynolds number");
  return 24 * law(1, reynolds) / reynolds;
}

double terminal_velocity(const Sphere& sphere, const Gas& gas, double gravity, const DragLaw& law) {
  return carrying_velocity(sphere, gas, gravity, 1, law);
}

double relaxation_time(const Sphere& sphere, const Gas& gas) {
  require_phases(sphere, gas);
  return sphere.density * sphere.diameter * sphere.diameter / (18 * gas.viscosity);
}

double relaxation_time(const Sphere& sphere, const Gas& gas, double slip_velocity,
                       const DragLaw& law) {
  return relaxation_time(sphere, gas) / law(1, reynolds(gas, slip_velocity, sphere.diameter));
}

double stokes_number(double relaxation_time, double velocity, double length) {
  require_positive(relaxation_time, "relaxation time");
  require_not_negative(velocity, "velocity");
  require_positive(length, "length");
  return relaxation_time * velocity / length;
}

}  // namespace bedscope::physics
