// SPDX-License-Identifier: BSD-3-Clause
// The thickness of strokes.
#pragma once

#include <opencv2/core.hpp>

namespace bedscope::digitise {

/// The commonest thickness of strokes, by their length, in a map of coverage (CV_32F, 0 to 1) [px];
/// 1 or more. Strokes are those of lines, bars and markers; a filled marker passes for one too.
double stroke_width(const cv::Mat& coverage);

/// The same of lines alone, by the length of their middle, of which filled markers have hardly any,
/// however many there are. Where there are no lines it says nothing: arms of a thick cross have a
/// middle no longer than their crossing.
double line_width(const cv::Mat& coverage);

}  // namespace bedscope::digitise
