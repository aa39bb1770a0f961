// SPDX-License-Identifier: BSD-3-Clause
// Long straight lines along the axes of the page: frame, grid, boxes of legends and insets.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace bedscope::digitise {

struct Rule {
  double at = 0;            ///< its middle across [px]
  double from = 0, to = 0;  ///< its ends along [px]
  double thickness = 1;     ///< [px]
  double slope = 0;         ///< across per along
  double length() const { return to - from; }
};

struct Rules {
  std::vector<Rule> rows, columns;  ///< horizontal ones by y, vertical ones by x
};

/// Unbroken lines of ink (0 to 1) of at least `least` pixels and at most `thickest` across.
Rules find_rules(const cv::Mat& ink, double least, double thickest);

/// The lines' common slope, weighted by length, as an angle [degrees anticlockwise]; nothing where
/// there is no line.
std::optional<double> angle_of(const Rules& rules);

/// The part of the page round `inside` that has the paper of the plot, where that is another than
/// the page's (a shaded plot without a frame).
std::optional<cv::Rect2d> shaded_area(const cv::Mat& page, const cv::Rect2d& inside);

/// The plot area: of the lines that cross or touch `inside` (the box of the calibration points) and
/// of the ends of those across them; where there are none, of a frame that lies around the box,
/// within a fifth of its size. `inside` grown by an eighth where there is none either: a guess.
struct PlotArea {
  cv::Rect2d box;
  bool guess = false;
};
PlotArea plot_area(const Rules& rules, const cv::Rect2d& inside, cv::Size page);

}  // namespace bedscope::digitise
