// SPDX-License-Identifier: BSD-3-Clause
// Where a triangle is, by its sides: a bar hides its tip, and a line its corners.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

namespace bedscope::digitise {

/// The box of a triangle that stands on its base near `about`, its top where the sides meet [px].
/// `ink`: coverage, CV_32F. Nothing where fewer than four rows show both sides.
std::optional<cv::Rect2d> box_by_sides(const cv::Mat& ink, const cv::Rect2d& about);

}  // namespace bedscope::digitise
