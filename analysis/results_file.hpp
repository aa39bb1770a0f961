// SPDX-License-Identifier: BSD-3-Clause
// results.h5: everything that an analysis found, documented in docs/results.md.
#pragma once

#include <filesystem>
#include <span>

#include "analysis/result.hpp"

namespace bedscope::analysis {

void write_results_file(std::span<const RunResult> runs, const std::filesystem::path& path);

}  // namespace bedscope::analysis
