// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/triangle.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bedscope::digitise {
namespace {

/// Of an even number the mean of the two in the middle, so that the two sides err alike.
double median(std::vector<double> values) {
  const auto half = static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), values.begin() + half, values.end());
  const double upper = values[values.size() / 2];
  if (values.size() % 2 == 1) return upper;
  return (*std::max_element(values.begin(), values.begin() + half) + upper) / 2;
}

/// x = at + slope * y
struct Side {
  double at = 0, slope = 0;
  double operator()(double y) const { return at + slope * y; }
};

/// The median of all slopes (Theil 1950, Sen 1968): up to 29 % of the rows may be off, where a line
/// leaves the marker.
Side side_through(const std::vector<cv::Point2d>& places) {
  std::vector<double> slopes, rest;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = i + 1; j < places.size(); ++j)
      slopes.push_back((places[j].x - places[i].x) / (places[j].y - places[i].y));
  Side side;
  side.slope = median(slopes);
  for (const auto& p : places) rest.push_back(p.x - side.slope * p.y);
  side.at = median(rest);
  return side;
}

/// Where the ink first reaches `level` on the way from pixel `from` in steps of `step`; between
/// the centres of two pixels. Nothing where it does not.
template <class At>
std::optional<double> edge_from(int from, int step, int n, float level, const At& at) {
  float before = 0;
  for (int i = from; i >= 0 && i < n; i += step) {
    const float here = at(i);
    if (here >= level)
      return i + 0.5 - step * static_cast<double>((here - level) / std::max(1e-3F, here - before));
    before = here;
  }
  return std::nullopt;
}

}  // namespace

std::optional<cv::Rect2d> box_by_sides(const cv::Mat& ink, const cv::Rect2d& about) {
  double most = 0;
  cv::minMaxLoc(ink, nullptr, &most);
  const auto level = static_cast<float>(most / 2);
  // Below the bar's width, above what a blur takes from the corners.
  std::vector<cv::Point2d> left, right;
  for (int y = cvCeil(about.y + 0.4 * about.height); y + 1 <= about.y + 0.85 * about.height; ++y) {
    if (y < 0 || y >= ink.rows) continue;
    const auto row = [&](int x) { return ink.at<float>(y, x); };
    const auto l = edge_from(0, 1, ink.cols, level, row),
               r = edge_from(ink.cols - 1, -1, ink.cols, level, row);
    if (!l || !r) continue;
    left.emplace_back(*l, y + 0.5);
    right.emplace_back(*r, y + 0.5);
  }
  if (left.size() < 4) return std::nullopt;
  std::vector<double> bottoms;
  for (int x = 0; x < ink.cols; ++x) {
    const double share = (x + 0.5 - about.x) / about.width, off = std::abs(share - 0.5);
    if (off < 0.15 || off > 0.38) continue;
    if (const auto edge = edge_from(ink.rows - 1, -1, ink.rows, level,
                                    [&](int y) { return ink.at<float>(y, x); }))
      bottoms.push_back(*edge);
  }
  if (bottoms.size() < 2) return std::nullopt;
  const Side on_left = side_through(left), on_right = side_through(right);
  const double base = median(bottoms), opening = on_right.slope - on_left.slope;
  if (!(opening > 0)) return std::nullopt;
  const double apex = (on_left.at - on_right.at) / opening;
  if (std::abs(apex - about.y) > 0.3 * about.height) return std::nullopt;
  return cv::Rect2d(cv::Point2d(on_left(base), apex), cv::Point2d(on_right(base), base));
}

}  // namespace bedscope::digitise
