// SPDX-License-Identifier: BSD-3-Clause
// The scaling rule applied to a scene, to every species.
#pragma once

#include <string>
#include <vector>

#include "cases/scene.hpp"

namespace bedscope::cases {

/// The scene with K times larger particles (physics/scaling.hpp). The number of particles is
/// rounded, and so are the cells along each axis, to at least one. A lattice is rounded along each
/// axis. K from 0.01 to 100. Hertz: the modulus stays, as k_n goes with E d. Throws InputError for
/// another K and where no particle remains.
Scene scale_scene(const Scene& scene, double K, physics::MappingCondition condition);

struct ScaledGroup {
  std::string name;  ///< as in case scale --json
  std::string definition;
  double before, after, ratio;  ///< by the rule, before anything is rounded
  bool kept;
};

struct ScalingReport {
  std::vector<ScaledGroup> groups;   ///< of the first species; ratios are the same for all
  std::vector<std::string> remarks;  ///< what was rounded, what the rule does not speak of
  double cells_by_rule = 0;          ///< of the straight part; the grid has whole ones
};

/// What the rule keeps and what it does not. Without gas or grid there are no groups.
ScalingReport scaling_report(const Scene& scene, double K, physics::MappingCondition condition);

}  // namespace bedscope::cases
