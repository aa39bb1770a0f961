// SPDX-License-Identifier: BSD-3-Clause
// The page of results: figures by gnuplot, and index.html that holds them all.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "analysis/result.hpp"

namespace bedscope::report {

/// Draws figures/ (SVG, PNG, gnuplot script and data beside) and index.html into `folder`.
void write_report(std::span<const analysis::RunResult> runs, const std::string& title,
                  const std::filesystem::path& folder);

}  // namespace bedscope::report
