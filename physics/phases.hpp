// SPDX-License-Identifier: BSD-3-Clause
// The gas and the sphere that every formula of this room speaks of.
#pragma once

#include <numbers>

namespace bedscope::physics {

struct Gas {
  double density;    ///< [kg/m3]
  double viscosity;  ///< dynamic [Pa s]
};

struct Sphere {
  double diameter;  ///< [m]
  double density;   ///< [kg/m3]
};

/// pi d^3 / 6 [m3]
constexpr double sphere_volume(double diameter) {
  return std::numbers::pi / 6 * diameter * diameter * diameter;
}

constexpr double sphere_mass(const Sphere& sphere) {  ///< [kg]
  return sphere.density * sphere_volume(sphere.diameter);
}

}  // namespace bedscope::physics
