// SPDX-License-Identifier: BSD-3-Clause
// The picture turned upright, and the way of points between the two.
#pragma once

#include <opencv2/core.hpp>

namespace bedscope::digitise {

/// Every coordinate of the digitiser is one of this page, but for those that the user gives.
class Page {
 public:
  /// Turns an 8-bit BGR picture by -angle (degrees anticlockwise) about its middle; the page grows
  /// so that no corner is lost. Below 0.02 degrees the picture is taken as it is.
  Page(const cv::Mat& picture, double angle);

  const cv::Mat& image() const { return image_; }  ///< 8-bit BGR
  double angle() const { return angle_; }
  cv::Point2d to_page(cv::Point2d pixel) const;
  cv::Point2d to_picture(cv::Point2d pixel) const;
  /// The box around a box of the picture.
  cv::Rect2d to_page(const cv::Rect2d& box) const;

 private:
  cv::Mat image_;
  double angle_ = 0;
  cv::Matx23d turn_ = {1, 0, 0, 0, 1, 0};  // of continuous coordinates
};

/// The commonest colour, the paper, of a part of an image.
cv::Vec3f paper_of(const cv::Mat& image, const cv::Rect& part);

/// How strongly each pixel differs from the paper: the largest difference of a channel over 255,
/// CV_32F.
cv::Mat ink_of(const cv::Mat& image, cv::Vec3f paper);

/// The angle of the picture at which its ink falls into the sharpest rows and columns [degrees
/// anticlockwise], searched within 6 degrees.
double angle_of_ink(const cv::Mat& picture);

}  // namespace bedscope::digitise
