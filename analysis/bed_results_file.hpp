// SPDX-License-Identifier: BSD-3-Clause
// What a bed gives beside the averages (bed_result.hpp), in results.h5.
#pragma once

#include "analysis/hdf5_file.hpp"
#include "analysis/result.hpp"

namespace bedscope::analysis {

/// Writes the groups bed_height, bubble_profile and fluctuations of a run, each where it has such
/// results. (Bubbles themselves are written as clusters are.)
void write_bed_groups(Hdf5Group& group, const RunResult& run);

}  // namespace bedscope::analysis
