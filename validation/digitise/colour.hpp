// SPDX-License-Identifier: BSD-3-Clause
// Who owns a pixel, and how much of it: a pixel at the edge of a line is a mixture of the line's
// colour and the paper's, so that its share tells where within the pixel the edge lies.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace bedscope::digitise {

inline constexpr float same_ink = 60;  ///< distance in BGR within which a colour is the asked one

struct Colours {
  cv::Vec3f paper;
  std::vector<cv::Vec3f> inks;    ///< the asked ones first, as they are in the picture; then others
  std::vector<int> ink_of_asked;  ///< -1: not there; two may mean the same ink
  cv::Mat owner;                  ///< CV_32S: index of the ink, -1 paper
  cv::Mat coverage;               ///< CV_32F, 0 to 1: share of the owner in the pixel
  bool lossy = false;             ///< the picture has noise of compression, scanning or blur
};

/// The inks of `area` of the page: those asked for, found again within a tolerance (compression,
/// scanning, transparency), and the others that are there. `asked` may repeat a colour.
Colours separate(const cv::Mat& page, const cv::Rect& area, bool lossy,
                 const std::vector<cv::Vec3f>& asked);

/// The share of ink `index` in each pixel of the area's page; 0 where another ink owns it.
cv::Mat coverage_of(const Colours& colours, int index);

/// 8-bit: pixels that another ink owns (more than a faint share), under which this one may go on.
cv::Mat hidden_from(const Colours& colours, int index);

/// The inks of a part of a page, the commonest first, each as it is where it is least mixed with
/// the paper. In noise (`lossy`, or where it is seen) those of one hue are one.
std::vector<cv::Vec3f> inks_in(const cv::Mat& page, const cv::Rect& area, bool lossy);

std::string hex_of(cv::Vec3f colour);

}  // namespace bedscope::digitise
