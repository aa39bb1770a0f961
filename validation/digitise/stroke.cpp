// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/stroke.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

namespace bedscope::digitise {
namespace {

/// For each pixel the ink of the unbroken stretch of its row that it lies in.
cv::Mat mass_of_rows(const cv::Mat& coverage) {
  cv::Mat mass = cv::Mat::zeros(coverage.size(), CV_32F);
  for (int y = 0; y < coverage.rows; ++y) {
    const auto* ink = coverage.ptr<float>(y);
    for (int x = 0; x < coverage.cols; ++x) {
      int end = x;
      float sum = 0;
      while (end < coverage.cols && ink[end] > 0.1F) sum += ink[end++];
      if (end > x) mass.row(y).colRange(x, end).setTo(sum);
      x = end;
    }
  }
  return mass;
}

/// The pixels of which no neighbour lies deeper in the ink: the middle of a line all along, of a
/// filled marker hardly more than its centre.
cv::Mat ridge_of(const cv::Mat& mask) {
  cv::Mat depth, deepest;
  cv::distanceTransform(mask, depth, cv::DIST_L2, 5);
  cv::dilate(depth, deepest, cv::Mat::ones(3, 3, CV_8U));
  return (depth >= deepest) & mask;
}

/// The commonest thickness of strokes by their length, in steps of an eighth of an octave. The
/// length is that of the ridge, or the area by the thickness.
double commonest(const cv::Mat& coverage, bool by_ridge) {
  // Where a stroke is cut by a row and by a column, its thickness is the height of the triangle of
  // the two cuts.
  const cv::Mat across = mass_of_rows(coverage), down = mass_of_rows(coverage.t()).t();
  cv::Mat where = coverage >= 0.4;
  if (by_ridge) where = ridge_of(where);
  std::map<int, double> lengths;
  for (int y = 0; y < coverage.rows; ++y)
    for (int x = 0; x < coverage.cols; ++x) {
      if (where.at<uchar>(y, x) == 0) continue;
      const double h = across.at<float>(y, x), v = down.at<float>(y, x);
      const double thickness = h * v / std::hypot(h, v);
      lengths[cvRound(8 * std::log2(thickness))] +=
          by_ridge ? 1 : coverage.at<float>(y, x) / thickness;
    }
  double most = 0, width = 1;
  for (const auto& [step, length] : lengths) {
    const auto at = [&](int k) { return lengths.contains(k) ? lengths.at(k) : 0.0; };
    if (const double around = at(step - 1) + at(step) + at(step + 1); around > most) {
      most = around;
      width = std::exp2(step / 8.0);
    }
  }
  return std::max(1.0, width);
}

}  // namespace

double stroke_width(const cv::Mat& coverage) { return commonest(coverage, false); }

double line_width(const cv::Mat& coverage) { return commonest(coverage, true); }

}  // namespace bedscope::digitise
