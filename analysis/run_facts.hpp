// SPDX-License-Identifier: BSD-3-Clause
// What a run tells of the scene that it was: sizes, numbers, densities, how fast particles meet.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/settings.hpp"

namespace bedscope::analysis {

/// Zeros are unknown.
struct RunFacts {
  struct Species {
    std::string type;
    double number = 0;
    double diameter = 0;  ///< [m]; of spheres of the mean volume
    double smallest = 0, largest = 0;
    double density = 0;  ///< [kg/m3]
  };
  std::vector<Species> species;
  std::array<double, 3> extent{};  ///< lateral, depth, up [m]
  /// Speed that one particle of a hundred exceeds, relative to the mean velocity of all [m/s].
  double impact_velocity = 0;
  std::vector<std::string> remarks;  ///< where the facts come from
};

/// From up to ten snapshots, evenly spread. Densities are the settings' or the dumps'. Throws as
/// Series::open does.
RunFacts facts_of_dumps(const RunSettings& settings);

/// From results.h5: the first run's grid and its inventory's last rows. Holdup, mass and number
/// give the mean volume and density of each type. Throws FileError, FormatError.
RunFacts facts_of_results(const std::filesystem::path& path);

}  // namespace bedscope::analysis
