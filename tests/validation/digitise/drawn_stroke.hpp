// SPDX-License-Identifier: BSD-3-Clause
// A straight stroke with flat ends, as plotting programs draw dashes, bars and lines.
#pragma once

#include <opencv2/imgproc.hpp>

namespace bedscope::digitise {

/// Coverage of an image of `size`, drawn in eighths of a pixel.
inline cv::Mat drawn_stroke(cv::Point2d a, cv::Point2d b, double width, cv::Size size) {
  constexpr int fine = 8;
  cv::Mat canvas = cv::Mat::zeros(size * fine, CV_8U), coverage;
  const cv::Point2d along = (b - a) / cv::norm(b - a),
                    side = cv::Point2d(-along.y, along.x) * (width / 2);
  std::vector<cv::Point> corners;
  for (const auto p : {a + side, b + side, b - side, a - side})
    corners.emplace_back(cvRound(fine * p.x - 0.5), cvRound(fine * p.y - 0.5));
  cv::fillConvexPoly(canvas, corners, cv::Scalar(255));
  cv::resize(canvas, canvas, size, 0, 0, cv::INTER_AREA);
  canvas.convertTo(coverage, CV_32F, 1 / 255.0);
  return coverage;
}

}  // namespace bedscope::digitise
