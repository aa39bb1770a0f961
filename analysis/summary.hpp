// SPDX-License-Identifier: BSD-3-Clause
// summary.json: the few numbers of each run, for scripts and CI.
#pragma once

#include <filesystem>
#include <span>

#include "analysis/result.hpp"

namespace bedscope::analysis {

void write_summary(std::span<const RunResult> runs, const std::filesystem::path& path);

}  // namespace bedscope::analysis
