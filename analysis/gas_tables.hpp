// SPDX-License-Identifier: BSD-3-Clause
// The tables of the gas: gas_axial, gas_lateral, voidage_check and pressure_drop (.csv).
#pragma once

#include <filesystem>
#include <span>

#include "analysis/result.hpp"

namespace bedscope::analysis {

/// Written where a run has gas (pressure_drop: a pressure), else those left from an earlier
/// analysis are removed. Columns: docs/results.md. Throws FileError.
void write_gas_tables(std::span<const RunResult> runs, const std::filesystem::path& folder);

}  // namespace bedscope::analysis
