// SPDX-License-Identifier: BSD-3-Clause
// The validation report: report.html, self-contained, for the screen and for paper.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "analysis/result.hpp"
#include "validation/verdict.hpp"

namespace bedscope::report {

/// A verdict of an earlier report, for its history.
struct EarlierVerdict {
  std::string key;  ///< check_key()
  std::string outcome;
  double value = 0;
};

/// What names a check from one report to the next: quantity, place, run, reference, metric.
std::string check_key(const validation::Verdict& verdict);

struct ValidationReport {
  std::string title;
  std::string study;  ///< path of the study file, whose text is quoted
  std::span<const analysis::RunResult> runs;
  std::span<const validation::Verdict> verdicts;
  std::vector<EarlierVerdict> earlier;
  std::string earlier_name;  ///< of the summary.json that they come from
};

/// Draws checks/ and writes report.html into `folder`: a table of all verdicts, a panel a check, a
/// scatter plot a quantity, what was assumed, where everything comes from. Throws FileError,
/// InputError where gnuplot is missing.
void write_validation_page(const ValidationReport& report, const std::filesystem::path& folder);

}  // namespace bedscope::report
