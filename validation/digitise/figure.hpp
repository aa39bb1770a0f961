// SPDX-License-Identifier: BSD-3-Clause
// What the user says about a picture of a plot, and what is found in it.
// Pixels: x to the right, y down, 0 at the outer edge of the first pixel, so that the centre of the
// first pixel is at 0.5.
#pragma once

#include <limits>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "validation/digitise/shapes.hpp"

namespace bedscope::digitise {

struct CalibrationPoint {
  cv::Point2d pixel;
  double value = 0;
};

struct AxisSpec {
  std::string name, unit = "-";
  bool log = false;
  std::vector<CalibrationPoint> points;  ///< two or more
};

enum class Kind { markers, line };

struct SeriesSpec {
  std::string name;
  Kind kind = Kind::markers;
  cv::Vec3f colour{0, 0, 0};       ///< blue, green, red; 0 to 255
  std::optional<Shape> shape;      ///< markers: found by itself where left out
  std::optional<cv::Rect> sample;  ///< markers: one of them in the picture, as a template [px]
  std::optional<cv::Point2d> reference;  ///< its reference point [px]; else its centre
  std::optional<bool> error_bars;        ///< markers: have vertical ones; seen where left out
  int points = 200;                      ///< line: at most so many points
};

struct Figure {
  AxisSpec x, y;
  std::optional<cv::Rect2d> plot_area;  ///< [px]; found by itself where left out
  std::optional<double> rotation;       ///< degrees anticlockwise of the scan; found where left out
  std::vector<cv::Rect2d> exclude;      ///< [px] not looked at: legends, insets
  std::vector<SeriesSpec> series;
};

/// Throws InputError, `where` first, where a pixel that the figure names lies outside a picture of
/// this size. A box that a user draws may go a pixel beyond it.
void check_inside(const Figure& figure, cv::Size picture, const std::string& where);

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A point in the picture and in the axes' units; u is one standard uncertainty.
struct Point {
  cv::Point2d pixel;  ///< in the upright page
  double u_pixel[2] = {0, 0};
  double x = nan, y = nan, x_u = nan, y_u = nan;
  double bar_pixel[2] = {nan, nan};  ///< row of the lower and the upper end of the error bar
  double lo = nan, hi = nan;         ///< values there
};

struct FoundSeries {
  std::string name;
  Kind kind = Kind::markers;
  std::string shape;          ///< of markers, as recognised
  std::vector<Point> points;  ///< by x
};

struct Digitised {
  std::vector<FoundSeries> series;
  double angle = 0;                 ///< of the scan, degrees anticlockwise
  cv::Rect2d plot_area;             ///< in the upright page [px]
  std::vector<cv::Rect> left_out;   ///< legends and insets found, in the upright page [px]
  std::vector<std::string> notes;   ///< what was done unasked
  std::vector<std::string> doubts;  ///< what may be wrong
  cv::Mat overlay;                  ///< the upright page with what was found, 8-bit BGR
};

/// Finds the series of `figure` in `picture` (8-bit BGR). `lossy`: from a JPEG.
/// Throws InputError where a calibration is singular or a colour is not in the plot.
/// `where` begins the texts of errors.
Digitised digitise(const cv::Mat& picture, bool lossy, const Figure& figure,
                   const std::string& where);

}  // namespace bedscope::digitise
