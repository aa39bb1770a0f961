// SPDX-License-Identifier: BSD-3-Clause
// What log.liggghts beside the dumps tells: time step, material, units, and how the run ended.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bedscope::readers {

struct LiggghtsLog {
  std::string path;                 ///< empty: no log was found
  std::optional<double> time_step;  ///< [s], of the last `timestep` command
  bool several_time_steps = false;
  std::map<int, double> density;  ///< by atom type, from constant particle templates [kg/m3]
  std::map<int, std::array<double, 2>>
      radius;  ///< smallest and largest by atom type, from constant particle templates [m]

  std::string version;  ///< "LIGGGHTS-PUBLIC 3.8.0"
  std::string units;    ///< of the last `units` command: "si", "cgs", "micro", "lj"
  std::optional<std::array<double, 3>> gravity;  ///< [m/s2]
  /// Numbers of each `property/global`, as they stand: youngsModulus [Pa], kn [N/m] ...
  std::map<std::string, std::vector<double>> properties;

  std::optional<std::int64_t> last_step;  ///< of the last row of the thermo tables
  bool ended = false;                     ///< the last table is closed by "Loop time of"

  /// Lines that begin with WARNING or ERROR, and the first of them.
  struct Complaints {
    std::int64_t count = 0;
    std::int64_t line = 0;
    std::string first;
  };
  Complaints warnings, errors;
};

/// Looks for log.liggghts in the folder of a dump and in the folder above it.
LiggghtsLog find_log(const std::string& dump);

/// Reads one log. Commands are echoed in it, with their variables put in.
LiggghtsLog read_log(const std::string& path);

}  // namespace bedscope::readers
