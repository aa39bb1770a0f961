// SPDX-License-Identifier: BSD-3-Clause
// A line of one ink, followed through dashes, crossings and markers.
#pragma once

#include <vector>

#include "validation/digitise/template.hpp"

namespace bedscope::digitise {

struct LinePoint {
  cv::Point2d at;
  double u = 0;  ///< across the line [px]
};

struct TracedLine {
  std::vector<LinePoint> points;  ///< in the order of the direction below
  bool along_x = true;            ///< else one point for each y: the curve is a function of y
  double stroke = 1;              ///< its thickness [px]
  cv::Point2d first, last;        ///< where its ink begins and ends; no place may be there
  double explained = 0;           ///< share of the ink that lies on the line
};

/// The line with the most ink that has one place in each column, or, where that explains more of
/// the ink, in each row; at most `points` places, equally spaced along the line, each where
/// ink was seen.
/// `through`: markers under which the map is unknown and through which the line may go.
TracedLine trace_line(const InkMap& map, const std::vector<LinePoint>& through, int points);

}  // namespace bedscope::digitise
