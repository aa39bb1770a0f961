// SPDX-License-Identifier: BSD-3-Clause
// The walls that particles meet; of use inside this room only.
#pragma once

#include <string>
#include <vector>

#include "cases/deck.hpp"
#include "cases/scene.hpp"

namespace bedscope::cases {

/// Infinite planes where nothing is open, triangles (STL) where a wall ends or bends.
struct ParticleWalls {
  struct Plane {
    std::string name, plane;  ///< LIGGGHTS' xplane, yplane, zplane
    double at;                ///< [m]
  };
  std::vector<Plane> planes;
  std::vector<std::string> meshes;  ///< names; files are DEM/<name>.stl
  std::vector<DeckFile> files;
};

ParticleWalls particle_walls(const Scene& scene);

/// Space that the box leaves behind its walls, where a particle that has left is still seen [m].
double margin(const Scene& scene);

/// Centres of the spheres that make a rough bend, touching each other along the arc and across the
/// depth; empty without one.
std::vector<Vector> rough_wall(const Scene& scene);

}  // namespace bedscope::cases
