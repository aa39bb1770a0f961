// SPDX-License-Identifier: BSD-3-Clause
// The tidy CSV tables under tables/, the contract of DESIGN with other programs.
#pragma once

#include <filesystem>
#include <span>

#include "analysis/result.hpp"

namespace bedscope::analysis {

/// Writes every table that the runs have rows for into `folder`.
void write_tables(std::span<const RunResult> runs, const std::filesystem::path& folder);

}  // namespace bedscope::analysis
