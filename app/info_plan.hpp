// SPDX-License-Identifier: BSD-3-Clause
// What `bedscope analyse` would do with a path, and a study file that says so.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/run_setup.hpp"
#include "readers/liggghts_log.hpp"
#include "readers/series.hpp"
#include "readers/survey.hpp"

namespace bedscope::app {

struct Plan {
  std::optional<analysis::RunSetup> setup;  ///< nothing where analyse would stop
  std::string stops;                        ///< why, then
  std::uint64_t bytes = 0;                  ///< of the files to be read, as they are on disk
  double memory = 0;                        ///< an estimate, with all cores [bytes]
  std::string density, time;                ///< where they come from
  std::vector<std::string> products;
};

/// Reads one snapshot at most; nothing is analysed.
Plan make_plan(const analysis::RunSettings& settings, const readers::Series& series,
               const readers::Survey& survey, const readers::LiggghtsLog& log);

/// The settings of a bare path, with radii from the log where the dumps have none and it
/// has one for each type.
analysis::RunSettings settings_with_log(const std::string& path, const readers::Survey& survey,
                                        const readers::LiggghtsLog& log);

/// A complete study file for this run, with a comment on each value that was assumed. Paths are as
/// given: it is meant for the folder in which the command was run. Throws InputError where analyse
/// would stop.
std::string study_text(const std::string& path, const readers::Survey& survey,
                       const readers::LiggghtsLog& log, const Plan& plan);

}  // namespace bedscope::app
