// SPDX-License-Identifier: BSD-3-Clause
// A figure file to start from: the axes and ticks that a picture shows.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace bedscope::digitise {

/// TOML with the plot area, the pixels of the ticks of both axes (their values are the user's) and
/// a series for each ink. Throws InputError where the picture shows no axis.
std::string suggest(const cv::Mat& picture, bool lossy, const std::string& image_name);

}  // namespace bedscope::digitise
