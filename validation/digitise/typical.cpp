// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/typical.hpp"

#include <algorithm>

namespace bedscope::digitise {
namespace {

/// Pixel by pixel the median of windows of the map at the places where `marker` fits well: what is
/// not in most of them (lines, bars, neighbours) is gone, and so is noise.
cv::Mat median_at(const InkMap& map, const Template& marker,
                  const std::vector<cv::Point2d>& guesses) {
  std::vector<cv::Mat> windows;
  for (const auto guess : guesses) {
    if (windows.size() == 40) break;
    const auto found = fit(marker, map, guess);
    if (found.score < 0.5 || found.known < 0.95 || found.least_part < 0.5) continue;
    windows.push_back(window(map.coverage, found.origin, marker.ink.size(), 0));
  }
  if (windows.size() < 3) return {};
  cv::Mat median(marker.ink.size(), CV_32F);
  std::vector<float> values(windows.size());
  for (int y = 0; y < median.rows; ++y)
    for (int x = 0; x < median.cols; ++x) {
      for (std::size_t i = 0; i < windows.size(); ++i) values[i] = windows[i].at<float>(y, x);
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      median.at<float>(y, x) = std::clamp(*middle, 0.0F, 1.0F);
    }
  return median;
}

}  // namespace

std::optional<Template> typical(const InkMap& map, const Template& marker,
                                const std::vector<cv::Point2d>& guesses) {
  cv::Mat median = median_at(map, marker, guesses);
  if (median.empty()) return std::nullopt;
  // Nothing outside of the marker itself: what a median leaves of lines that always meet it.
  median.setTo(0, marker.inside == 0);
  const cv::Rect all({0, 0}, median.size());
  const cv::Rect bare(all.x + margin, all.y + margin, all.width - 2 * margin,
                      all.height - 2 * margin);
  return make_template(median(bare).clone(), marker.shape);
}

}  // namespace bedscope::digitise
