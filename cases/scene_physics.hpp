// SPDX-License-Identifier: BSD-3-Clause
// The closed forms of physics/ with the values of a scene; of use inside this room only.
#pragma once

#include "cases/scene.hpp"
#include "physics/drag.hpp"

namespace bedscope::cases {

/// Voidage of a settled bed, 0.4, or of the scene's lattice.
double settled_voidage(const Scene& scene);

/// Voidage of the scene's densest part: that, or what a single particle leaves of its cell.
double dense_voidage(const Scene& scene);

const physics::NamedDragLaw& law_of(const Scene& scene);

/// Both need a gas, gravity, and particles heavier than the gas.
bool falls(const Scene& scene, const Species& species);
double terminal_velocity(const Scene& scene, const Species& species);
double minimum_fluidisation(const Scene& scene, const Species& species);

/// beta of the densest part at the superficial velocity [kg/m3/s], of the smallest particles; and
/// the slope n of their drag there (physics/drag.hpp), 0 without gas velocity.
double dense_exchange(const Scene& scene);
double dense_slope(const Scene& scene);

/// With which two particles meet at most [m/s]: as the scene says, or the velocity at which they
/// enter, or the smaller of the gas' and the largest terminal velocity.
double impact_velocity(const Scene& scene);

/// Shortest contact of any pair, wall included, at that velocity [s]; 0 where nothing is known.
double shortest_contact(const Scene& scene);

/// Largest overlap over radius at that velocity, and the velocity at which it is 0.01: of two
/// particles, and of a particle and a wall. Zeros where nothing is known.
struct Overlap {
  double ratio, velocity_of_one_percent;
};
Overlap particle_overlap(const Scene& scene);
Overlap wall_overlap(const Scene& scene);

/// Gunn's h at the dense voidage and the superficial velocity [W/m2/K]; 0 without heat.
double heat_transfer(const Scene& scene, const Species& species);

/// Mean temperature [K] to which a heated bed tends, and the time in which it comes within 1/e.
struct BedHeat {
  double equilibrium, time;
};
BedHeat bed_heat(const Scene& scene);

}  // namespace bedscope::cases
