// SPDX-License-Identifier: BSD-3-Clause
// Verdicts for machines: JUnit for the pages of GitHub and GitLab, Markdown for a job's summary,
// the checks of summary.json.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "analysis/result.hpp"
#include "report/validation_page.hpp"
#include "validation/verdict.hpp"

namespace bedscope::report {

/// A test case a check: does not hold is a failure, undecided and skipped are skipped.
std::string junit_text(std::span<const validation::Verdict> verdicts, const std::string& title);

/// A table with one row a check, worst first, and what the analysis has to say of the runs.
std::string markdown_text(std::span<const analysis::RunResult> runs,
                          std::span<const validation::Verdict> verdicts, const std::string& title);

/// summary.json of the analysis with its list `checks` filled.
std::string summary_with_checks(std::span<const analysis::RunResult> runs,
                                std::span<const validation::Verdict> verdicts);

/// The checks of an earlier summary.json. Throws FileError, FormatError.
std::vector<EarlierVerdict> read_earlier(const std::filesystem::path& summary);

}  // namespace bedscope::report
