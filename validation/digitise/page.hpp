// SPDX-License-Identifier: BSD-3-Clause
// The picture turned upright, and the way of points between the two.
#pragma once

#include <opencv2/core.hpp>

namespace bedscope::digitise {

/// Every coordinate of the digitiser is one of this page, but for those that the user gives.
class Page {
 public:
  /// Makes an 8-bit BGR picture smaller by a whole factor (means of whole pixels) and turns it by
  /// -angle (degrees anticlockwise) about its middle; the page grows so that no corner is lost.
  /// Below 0.02 degrees it is not turned.
  Page(const cv::Mat& picture, double angle, int reduction = 1);

  const cv::Mat& image() const { return image_; }  ///< 8-bit BGR
  double angle() const { return angle_; }
  int reduction() const { return reduction_; }  ///< pixels of the picture to one of the page
  cv::Point2d to_page(cv::Point2d pixel) const;
  cv::Point2d to_picture(cv::Point2d pixel) const;
  /// The box around a box of the picture.
  cv::Rect2d to_page(const cv::Rect2d& box) const;

 private:
  cv::Mat image_;
  double angle_ = 0;
  int reduction_ = 1;
  cv::Matx23d turn_ = {1, 0, 0, 0, 1, 0};  // of continuous coordinates
};

/// The reduction at which a plot of `length` pixels keeps about 1000 of them and strokes of
/// `stroke` pixels keep two: fine scans are no better for having more pixels, but slower.
int reduction_for(double length, double stroke);

/// The commonest colour, the paper, of a part of an image.
cv::Vec3f paper_of(const cv::Mat& image, const cv::Rect& part);

/// How strongly each pixel differs from the paper: the largest difference of a channel over 255,
/// CV_32F.
cv::Mat ink_of(const cv::Mat& image, cv::Vec3f paper);

/// The angle of the picture at which its ink falls into the sharpest rows and columns [degrees
/// anticlockwise], searched within 6 degrees.
double angle_of_ink(const cv::Mat& picture);

}  // namespace bedscope::digitise
