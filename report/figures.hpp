// SPDX-License-Identifier: BSD-3-Clause
// The figures of a report: what each shows, in words and as a gnuplot script with its data.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "analysis/result.hpp"

namespace bedscope::report {

struct Figure {
  std::string name;              ///< of its files
  std::string title;             ///< may hold a user's text
  std::string caption;           ///< what is shown, window, error bars, method
  std::string missing;           ///< why there is nothing to draw; then script and data are empty
  double width = 0, height = 0;  ///< in print [mm]
  std::string script, data;
};

/// The figures of `runs` in the order of the page; those without data say why in `missing`.
std::vector<Figure> make_figures(std::span<const analysis::RunResult> runs);

/// Writes name.gp, name.dat, name.svg and, with `png`, name.png of each figure into `folder`, whole
/// or not at all, and removes what an earlier report left of figures that are not drawn now (and of
/// PNGs, without `png`: they would show an older state).
/// Throws InputError where gnuplot is missing, FileError where it fails or the disk does.
void draw_figures(std::span<const Figure> figures, const std::filesystem::path& folder, bool png);

}  // namespace bedscope::report
