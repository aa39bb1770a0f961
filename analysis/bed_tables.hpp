// SPDX-License-Identifier: BSD-3-Clause
// Tables and groups of what a bed gives beside the averages (bed_result.hpp), for tables.cpp and
// results_file.cpp.
#pragma once

#include <filesystem>
#include <span>

#include "analysis/hdf5_file.hpp"
#include "analysis/result.hpp"

namespace bedscope::analysis {

/// Writes bed_height, bubbles, bubble_profile, spectrum and fluctuation (.csv), each where a run
/// has such results; else one left there earlier is removed. Throws FileError.
void write_bed_tables(std::span<const RunResult> runs, const std::filesystem::path& folder);

/// The same into groups of a run: bed_height, bubble_profile, fluctuations. (Bubbles themselves are
/// written as clusters are.)
void write_bed_groups(Hdf5Group& group, const RunResult& run);

}  // namespace bedscope::analysis
