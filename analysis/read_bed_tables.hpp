// SPDX-License-Identifier: BSD-3-Clause
// The tables of bed and gas read back, for read_tables(), which says what holds for all.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "analysis/result.hpp"

namespace bedscope::analysis {

/// Each takes the rows of `run_name` (of every run where it is nothing) into `run`. Needed are the
/// coordinates `time [s]`, `height [m]`, `x [m]`, `z [m]`, and `signal`, `unit` of fluctuation.csv;
/// what else is left out is NaN. Gas profiles at a height that no lateral profile has add it.
/// Throws FileError and FormatError.
using RunName = std::optional<std::string>;
void read_bed_height(const std::filesystem::path& path, const RunName& run_name, RunResult& run);
void read_bubbles(const std::filesystem::path& path, const RunName& run_name, RunResult& run);
void read_bubble_profile(const std::filesystem::path& path, const RunName& run_name,
                         RunResult& run);
void read_fluctuation(const std::filesystem::path& path, const RunName& run_name, RunResult& run);
void read_gas_axial(const std::filesystem::path& path, const RunName& run_name, RunResult& run);
void read_gas_lateral(const std::filesystem::path& path, const RunName& run_name, RunResult& run);
void read_pressure_drop(const std::filesystem::path& path, const RunName& run_name, RunResult& run);

}  // namespace bedscope::analysis
