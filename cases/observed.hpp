// SPDX-License-Identifier: BSD-3-Clause
// What is known of a run, as a scene that can be checked.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/scene.hpp"

namespace bedscope::cases {

/// Zeros are unknown.
struct Observed {
  std::vector<Species> species;
  std::vector<double> numbers;  ///< of each
  Vector extent{};              ///< [m]
  double impact_velocity = 0;   ///< [m/s]
  double gas_density = 0;       ///< [kg/m3]
};

/// The scene with what was observed in place of what it says: sizes, densities and numbers of the
/// species, and the velocity at which particles meet. Without a scene, one of what was observed
/// alone; what nobody knows stays zero, and its limits are left out. `remarks` gets a line for each
/// difference from the scene, and for each thing that is missing. Throws InputError where a size is
/// known to nobody.
Scene observed_scene(const std::optional<Scene>& scene, const Observed& observed,
                     std::vector<std::string>& remarks);

}  // namespace bedscope::cases
