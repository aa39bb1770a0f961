// SPDX-License-Identifier: BSD-3-Clause
// The ticks along the edges of a plot.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace bedscope::digitise {

/// The middles of ticks along an axis [px].
struct Ticks {
  std::vector<double> x, y;  ///< on the lower and on the left edge
};

/// The ticks of the plot in `area` of `page` (8-bit BGR, upright), in the ink of the edge that they
/// stand on: a curve of another colour that meets the edge is none. On either side of it, whichever
/// has more.
Ticks find_ticks(const cv::Mat& page, const cv::Rect2d& area);

}  // namespace bedscope::digitise
