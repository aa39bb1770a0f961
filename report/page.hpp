// SPDX-License-Identifier: BSD-3-Clause
// The page of results: figures by gnuplot, and index.html that holds them all.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "analysis/result.hpp"

namespace bedscope::report {

struct ReportOptions {
  bool png = true;  ///< false: SVG only, in about half the time, for a page that is updated often
  int refresh_seconds = 0;  ///< > 0: browsers load the page again by themselves, for --follow
};

/// Draws figures/ (SVG, PNG, gnuplot script and data beside) and index.html into `folder`. The page
/// needs no other file; it links to the tables, results.h5 and summary.json that are in `folder`
/// when it is written, so write these first. What an earlier report drew is replaced.
/// Throws InputError without runs or where gnuplot is missing (names the package), FileError.
void write_report(std::span<const analysis::RunResult> runs, const std::string& title,
                  const std::filesystem::path& folder, const ReportOptions& options = {});

}  // namespace bedscope::report
