// SPDX-License-Identifier: BSD-3-Clause
// What `bedscope tradeoff` writes: the page with a chart a product, the table, the summary.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/choice.hpp"
#include "analysis/result.hpp"
#include "validation/tradeoff.hpp"

namespace bedscope::report {

struct TradeoffReport {
  std::string title;
  std::string study;  ///< its path
  validation::Tradeoff tradeoff;
  std::vector<analysis::Variant> variants;  ///< of the first run
  validation::Recommendation recommendation;
  std::vector<analysis::RunResult> runs;  ///< by the finest snapshots and the study's settings
  std::vector<std::string> problems;
};

/// For each product one sentence: "... is 9 times cheaper within 1 % of the axial holdup"; then
/// what is recommended, and whether it kept its promise.
std::vector<std::string> sentences(const TradeoffReport& report);

/// index.html (self-contained), tables/tradeoff.csv, summary.json and the charts in figures/.
/// Throws FileError, InputError where gnuplot is missing.
void write_tradeoff(const TradeoffReport& report, const std::filesystem::path& folder);

std::string tradeoff_summary(const TradeoffReport& report);

}  // namespace bedscope::report
