// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/stroke.hpp"

#include <algorithm>
#include <cmath>
#include <map>

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

}  // namespace

double stroke_width(const cv::Mat& coverage) {
  // Where a stroke is cut by a row and by a column, its thickness is the height of the triangle of
  // the two cuts. The commonest by length, in steps of an eighth of an octave.
  const cv::Mat across = mass_of_rows(coverage), down = mass_of_rows(coverage.t()).t();
  std::map<int, double> lengths;
  for (int y = 0; y < coverage.rows; ++y)
    for (int x = 0; x < coverage.cols; ++x) {
      if (coverage.at<float>(y, x) < 0.4F) continue;
      const double h = across.at<float>(y, x), v = down.at<float>(y, x);
      const double thickness = h * v / std::hypot(h, v);
      lengths[cvRound(8 * std::log2(thickness))] += coverage.at<float>(y, x) / thickness;
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
}  // namespace bedscope::digitise
