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
  std::string key;  ///< of check_keys()
  std::string outcome;
  double value = 0;
};

/// What names each check from one report to the next: run, quantity, place, metric, reference; of
/// several of one name the later ones are numbered, in the order of the study.
std::vector<std::string> check_keys(std::span<const validation::Verdict> verdicts);

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
