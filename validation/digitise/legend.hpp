// SPDX-License-Identifier: BSD-3-Clause
// What lies in a plot and is not data: legends and insets.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "validation/digitise/rules.hpp"

namespace bedscope::digitise {

/// Frames of legends and insets: boxes of which three sides at least end at their corners (grid
/// lines go on; the fourth may lie beside one), with three pieces of ink in them or more.
std::vector<cv::Rect> find_boxes(const Rules& rules, const cv::Mat& ink, const cv::Rect& area);

/// Rows of text with a sample at its left or right end: something small, at the height of the text,
/// touching nothing else. `text`: coverage by dark neutral ink, `ink`: by any ink.
/// Each box holds text and sample.
std::vector<cv::Rect> find_legend_rows(const cv::Mat& text, const cv::Mat& ink,
                                       const cv::Rect& area);

}  // namespace bedscope::digitise
