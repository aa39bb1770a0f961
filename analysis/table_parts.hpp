// SPDX-License-Identifier: BSD-3-Clause
// What the writers of tables have in common.
#pragma once

#include <algorithm>
#include <filesystem>
#include <limits>
#include <span>

#include "analysis/output_file.hpp"
#include "analysis/result.hpp"

namespace bedscope::analysis {

/// [s]; NaN where the run's times count steps.
inline double shown_time(const RunResult& run, double time) {
  return run.time_known ? time : std::numeric_limits<double>::quiet_NaN();
}

/// Calls write(runs, path) where one of the runs has what it writes; else removes what an earlier
/// analysis left there. Throws FileError.
template <class Has, class Write>
void write_or_remove(std::span<const RunResult> runs, const std::filesystem::path& path, Has has,
                     Write write) {
  if (std::any_of(runs.begin(), runs.end(), has))
    write(runs, path);
  else
    remove_file(path);
}

}  // namespace bedscope::analysis
