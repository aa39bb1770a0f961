// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/page.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace bedscope::digitise {

Page::Page(const cv::Mat& full, double angle, int reduction) : reduction_(reduction) {
  cv::Mat picture = full;
  if (reduction > 1) {
    const cv::Size size(full.cols / reduction, full.rows / reduction);
    cv::resize(full(cv::Rect({0, 0}, size * reduction)), picture, size, 0, 0, cv::INTER_AREA);
  }
  if (std::abs(angle) < 0.02) {
    image_ = picture;
    return;
  }
  angle_ = angle;
  const double radians = angle * std::numbers::pi / 180;
  const double c = std::cos(radians), s = std::sin(radians);
  const double width = std::ceil(picture.cols * std::abs(c) + picture.rows * std::abs(s));
  const double height = std::ceil(picture.rows * std::abs(c) + picture.cols * std::abs(s));
  // An axis at `angle` anticlockwise (y down) becomes horizontal.
  const double mx = picture.cols / 2.0, my = picture.rows / 2.0;
  turn_ = {c, -s, width / 2 - c * mx + s * my, s, c, height / 2 - s * mx - c * my};
  auto of_indices = turn_;  // the centre of the first pixel is index 0 for OpenCV
  for (int row = 0; row < 2; ++row)
    of_indices(row, 2) += 0.5 * (turn_(row, 0) + turn_(row, 1)) - 0.5;
  const auto paper = paper_of(picture, {0, 0, picture.cols, picture.rows});
  cv::warpAffine(picture, image_, of_indices,
                 cv::Size(static_cast<int>(width), static_cast<int>(height)), cv::INTER_CUBIC,
                 cv::BORDER_CONSTANT, cv::Scalar(paper[0], paper[1], paper[2]));
}

cv::Point2d Page::to_page(cv::Point2d pixel) const {
  const auto p = turn_ * cv::Vec3d(pixel.x / reduction_, pixel.y / reduction_, 1);
  return {p[0], p[1]};
}

cv::Point2d Page::to_picture(cv::Point2d pixel) const {
  const double x = pixel.x - turn_(0, 2), y = pixel.y - turn_(1, 2);
  return reduction_ *
         cv::Point2d(turn_(0, 0) * x + turn_(1, 0) * y, turn_(0, 1) * x + turn_(1, 1) * y);
}

cv::Rect2d Page::to_page(const cv::Rect2d& box) const {
  const auto middle = to_page({box.x + box.width / 2, box.y + box.height / 2});
  // A box drawn by hand round something upright: its size is kept.
  const cv::Size2d size(box.width / reduction_, box.height / reduction_);
  return {middle.x - size.width / 2, middle.y - size.height / 2, size.width, size.height};
}

int reduction_for(double length, double stroke) {
  return std::max(1, std::min(cvFloor(length / 900), cvFloor((stroke - 1) / 1.8)));
}

cv::Vec3f paper_of(const cv::Mat& image, const cv::Rect& part) {
  std::vector<int> counts(32 * 32 * 32);
  const cv::Mat region = image(part);
  const auto bin = [](cv::Vec3b p) { return ((p[0] >> 3) * 32 + (p[1] >> 3)) * 32 + (p[2] >> 3); };
  for (int y = 0; y < region.rows; ++y)
    for (int x = 0; x < region.cols; ++x)
      ++counts[static_cast<std::size_t>(bin(region.at<cv::Vec3b>(y, x)))];
  const int best =
      static_cast<int>(std::max_element(counts.begin(), counts.end()) - counts.begin());
  cv::Vec3d sum;
  double n = 0;
  for (int y = 0; y < region.rows; ++y)
    for (int x = 0; x < region.cols; ++x)
      if (const auto p = region.at<cv::Vec3b>(y, x); bin(p) == best) {
        sum += cv::Vec3d(p[0], p[1], p[2]);
        ++n;
      }
  return n > 0 ? cv::Vec3f(sum / n) : cv::Vec3f(255, 255, 255);
}

cv::Mat ink_of(const cv::Mat& image, cv::Vec3f paper) {
  cv::Mat difference, ink(image.size(), CV_32F);
  cv::absdiff(image, cv::Scalar(paper[0], paper[1], paper[2]), difference);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const auto d = difference.at<cv::Vec3b>(y, x);
      ink.at<float>(y, x) = static_cast<float>(std::max({d[0], d[1], d[2]})) / 255.0F;
    }
  return ink;
}

namespace {

/// Sum of squares of the counts of points in rows and columns of one pixel, turned by `degrees`.
double sharpness(const std::vector<cv::Point2f>& points, double degrees, int reach) {
  const double radians = degrees * std::numbers::pi / 180;
  const auto c = static_cast<float>(std::cos(radians)), s = static_cast<float>(std::sin(radians));
  std::vector<int> rows(2 * reach + 1), columns(2 * reach + 1);
  for (const auto& p : points) {
    ++columns[static_cast<std::size_t>(cvRound(c * p.x - s * p.y) + reach)];
    ++rows[static_cast<std::size_t>(cvRound(s * p.x + c * p.y) + reach)];
  }
  double sum = 0;
  for (const int n : rows) sum += static_cast<double>(n) * n;
  for (const int n : columns) sum += static_cast<double>(n) * n;
  return sum;
}

}  // namespace

double angle_of_ink(const cv::Mat& picture) {
  const double scale = std::min(1.0, 1400.0 / std::max(picture.cols, picture.rows));
  cv::Mat small;
  cv::resize(picture, small, {}, scale, scale, cv::INTER_AREA);
  const cv::Mat ink = ink_of(small, paper_of(small, {0, 0, small.cols, small.rows}));
  std::vector<cv::Point2f> points;
  for (int y = 0; y < small.rows; ++y)
    for (int x = 0; x < small.cols; ++x)
      if (ink.at<float>(y, x) > 0.35F)
        points.emplace_back(static_cast<float>(x - small.cols / 2),
                            static_cast<float>(y - small.rows / 2));
  const int reach = small.cols + small.rows;
  double best = 0;
  for (const double step : {0.1, 0.02}) {
    const double centre = best, half = step > 0.05 ? 6 : 0.15;
    double most = -1;
    for (double angle = centre - half; angle <= centre + half; angle += step)
      if (const double now = sharpness(points, angle, reach); now > most) {
        most = now;
        best = angle;
      }
  }
  return best;
}

}  // namespace bedscope::digitise
