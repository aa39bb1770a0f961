// SPDX-License-Identifier: BSD-3-Clause
// The tables of what a bed gives beside the averages (bed_result.hpp).
#pragma once

#include <filesystem>
#include <span>

#include "analysis/result.hpp"

namespace bedscope::analysis {

/// Writes bed_height, bubbles, bubble_profile, spectrum and fluctuation (.csv), each where a run
/// has such results; else one left there earlier is removed. Columns: docs/results.md. Throws
/// FileError.
void write_bed_tables(std::span<const RunResult> runs, const std::filesystem::path& folder);

}  // namespace bedscope::analysis
