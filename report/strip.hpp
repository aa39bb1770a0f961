// SPDX-License-Identifier: BSD-3-Clause
// Snapshots of a run side by side, with what was found in them drawn over.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report/figure_parts.hpp"

namespace bedscope::report {

/// Axis units per metre, and per mm on the page, of a panel of the strip.
struct StripScale {
  double x_factor = 1, z_factor = 1;
  double x_per_mm = 1, z_per_mm = 1;
};

struct Strip {
  double least_range = 0;  ///< holdup that the colour bar reaches at least
  std::vector<LegendEntry> legend;
  /// Adds layers over a frame; `of` tells it in comments of the data file.
  std::function<void(Canvas&, const analysis::Frame&, const StripScale&, const std::string& of,
                     std::vector<std::string>& layers)>
      draw_over;
  std::string caption;  ///< what is drawn over, without a full stop
};

/// The kept frames of a run: depth-averaged holdup in light greys, `strip` drawn over.
Figure strip_figure(const analysis::RunResult& run, const Strip& strip, const std::string& name,
                    const std::string& title);

/// Lifts the pen. Not a blank line: in a file with blank lines inside blocks gnuplot miscounts the
/// matrices that follow.
inline const std::string gap_row = "nan nan\n";

/// The outlines of a cluster or bubble as closed lines.
std::string outline_rows(const analysis::Cluster& cluster, double x_factor, double z_factor);

/// A figure for each run that has what it shows, numbered and named after it where there are
/// several.
std::vector<Figure> figure_a_run(
    Runs runs, const std::string& name, const std::string& title,
    const std::function<bool(const analysis::RunResult&)>& has,
    const std::function<Figure(const analysis::RunResult&, const std::string&, const std::string&)>&
        draw);

}  // namespace bedscope::report
