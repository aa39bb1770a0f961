// SPDX-License-Identifier: BSD-3-Clause
// The thickness of strokes.
#pragma once

#include <opencv2/core.hpp>

namespace bedscope::digitise {

/// The commonest thickness of strokes, by their length, in a map of coverage (CV_32F, 0 to 1) [px];
/// 1 or more. Everything that depends on how thick the lines of a picture are goes by this.
double stroke_width(const cv::Mat& coverage);

}  // namespace bedscope::digitise
