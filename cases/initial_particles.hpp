// SPDX-License-Identifier: BSD-3-Clause
// Where the particles of a scene are at the start.
#pragma once

#include <vector>

#include "cases/scene.hpp"

namespace bedscope::cases {

struct InitialParticle {
  int species;  ///< index into Scene::species
  double diameter;
  Vector position;
};

/// Exactly the scene's particles, inside the straight part, none overlapping another or a wall: on
/// the sites of a lattice, moved at random within the free space of their site, species shuffled
/// over the sites. The same scene gives the same particles on every machine.
///
/// `bed`: sites of 1.05 largest diameters from the bottom up (holdup 0.45, it settles to a bed);
/// `uniform`: sites as large as the straight part allows; `lattice`: the sites fill the box's width
/// and depth, cubic, nothing is moved; `single`.
/// Throws InputError where they do not fit.
std::vector<InitialParticle> initial_particles(const Scene& scene);

/// Height of the sites that `initial_particles` fills [m].
double initial_height(const Scene& scene);

}  // namespace bedscope::cases
