// SPDX-License-Identifier: BSD-3-Clause
// What log.liggghts beside the dumps tells: the time step, the densities.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace bedscope::readers {

struct LiggghtsLog {
  std::string path;                 ///< empty: no log was found
  std::optional<double> time_step;  ///< [s], of the last `timestep` command
  bool several_time_steps = false;
  std::map<int, double> density;  ///< by atom type, from constant particle templates [kg/m3]
};

/// Looks for log.liggghts in the folder of a dump and in the folder above it.
LiggghtsLog find_log(const std::string& dump);

/// Reads one log. Commands are echoed in it, with their variables put in.
LiggghtsLog read_log(const std::string& path);

}  // namespace bedscope::readers
