// SPDX-License-Identifier: BSD-3-Clause
// Vertical error bars: thin strokes that start at a marker, with or without caps.
#pragma once

#include "validation/digitise/markers.hpp"

namespace bedscope::digitise {

struct ErrorBar {
  double lower = 0,
         upper = 0;     ///< rows of the ends (lower: the larger row); NaN where none is seen
  double half_cap = 0;  ///< half the width of the caps; of the bar where there are none [px]
  int cap = 0;          ///< rows of the thicker cap; 0 where there is none [px]
  int thickness = 0;    ///< [px]; 0 where none is seen
};

/// The bar of a marker at `at`, whose template is `marker`. `with_line`: the ink also draws a line
/// through the markers, so that a stroke without a cap has to be upright and end in paper.
/// `thickness`: of the bar, where other markers show it, else 0.
ErrorBar find_error_bar(const InkMap& map, const Template& marker, cv::Point2d at, bool with_line,
                        int thickness = 0);

/// The bars of a series' markers. Where a third of them or more have one, its thickness tells the
/// cap of a bar so short that little else of it is seen, and a bar without one that is hardly seen.
std::vector<ErrorBar> find_error_bars(const InkMap& map, const Template& marker,
                                      const std::vector<cv::Point2d>& at, bool with_line);

/// Leaves out of the markers of each template those that lie on the bar of a better one, of any
/// template that has bars, and resemble the others of theirs little, or are none without the ink of
/// that marker and its bar: where a cap or the marker's edge crosses it. Two markers of one
/// abscissa stay as far as the bar leaves enough of them.
void drop_on_bars(const InkMap& map, const std::vector<Template>& templates,
                  const std::vector<bool>& with_bars, std::vector<std::vector<Marker>>& found,
                  bool with_line);

/// Under a bar nothing is known of a line of its ink.
void cover(InkMap& map, const ErrorBar& bar, cv::Point2d at);

}  // namespace bedscope::digitise
