// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "readers/error.hpp"

namespace bedscope::digitise {
namespace {

/// Whole pixels are read off by eye: u = 0.5 / sqrt(3); a fraction was measured.
double pixel_uncertainty(const AxisSpec& axis) {
  const bool whole = std::all_of(axis.points.begin(), axis.points.end(), [](const auto& point) {
    return point.pixel.x == std::round(point.pixel.x) && point.pixel.y == std::round(point.pixel.y);
  });
  return whole ? 0.29 : 0.1;
}

/// The two points that are farthest apart, as a vector from the first to the second.
cv::Point2d longest(const AxisSpec& axis) {
  cv::Point2d best;
  for (const auto& from : axis.points)
    for (const auto& to : axis.points)
      if (cv::norm(to.pixel - from.pixel) > cv::norm(best)) best = to.pixel - from.pixel;
  return best;
}

}  // namespace

double Calibration::value(double pixel) const {
  const double linear = a + b * (pixel - origin);
  return log ? std::pow(10.0, linear) : linear;
}

double Calibration::pixel(double value) const {
  return origin + ((log ? std::log10(value) : value) - a) / b;
}

double Calibration::uncertainty(double pixel, double u) const {
  const double linear = std::hypot(a_u, b_u * (pixel - origin), b * u);
  return log ? value(pixel) * std::numbers::ln10 * linear : linear;
}

Calibration calibrate(const AxisSpec& axis, const std::vector<double>& along,
                      const std::string& where) {
  Calibration result;
  result.log = axis.log;
  const auto n = along.size();
  std::vector<double> values;
  for (const auto& point : axis.points) {
    if (axis.log && !(point.value > 0))
      throw InputError("{}: expected values above 0 on a log axis, found {}", where, point.value);
    values.push_back(axis.log ? std::log10(point.value) : point.value);
  }
  double mean = 0;
  for (std::size_t i = 0; i < n; ++i) {
    result.origin += along[i] / static_cast<double>(n);
    mean += values[i] / static_cast<double>(n);
  }
  double tt = 0, tv = 0;
  for (std::size_t i = 0; i < n; ++i) {
    tt += (along[i] - result.origin) * (along[i] - result.origin);
    tv += (along[i] - result.origin) * (values[i] - mean);
  }
  if (!(tt > 2))
    throw InputError(
        "{}: singular: expected points apart along the axis, found all at pixel {:.6g}", where,
        result.origin);
  result.a = mean;
  result.b = tv / tt;
  if (!(std::abs(result.b) > 0) || !std::isfinite(result.b))
    throw InputError("{}: singular: expected different values, found all equal to {}", where,
                     axis.points[0].value);
  double scatter = 0;  // px
  for (std::size_t i = 0; i < n; ++i)
    scatter = std::max(scatter, std::abs(along[i] - result.origin - (values[i] - mean) / result.b));
  const double allowed = std::max(3.0, 0.005 * std::sqrt(tt));
  if (scatter > allowed)
    throw InputError("{}: expected points on one {} scale, found one {:.1f} px off", where,
                     axis.log ? "logarithmic" : "linear", scatter);
  const double u = std::max(pixel_uncertainty(axis), n > 2 ? scatter / std::sqrt(3.0) : 0.0);
  result.a_u = std::abs(result.b) * u / std::sqrt(static_cast<double>(n));
  result.b_u = std::abs(result.b) * u / std::sqrt(tt);
  return result;
}

double angle_of_points(const Figure& figure) {
  auto along_x = longest(figure.x), along_y = longest(figure.y);
  if (along_x.x < 0) along_x = -along_x;
  if (along_y.y > 0) along_y = -along_y;
  const double to_degrees = 180 / std::numbers::pi;
  const double from_x = std::atan2(-along_x.y, along_x.x) * to_degrees;
  const double from_y = std::atan2(-along_y.x, -along_y.y) * to_degrees;
  const double wx = along_x.dot(along_x), wy = along_y.dot(along_y);
  if (std::abs(from_x) > 20 || std::abs(from_y) > 20) return nan;
  if (std::abs(from_x - from_y) > 0.7 + 115 / std::sqrt(std::min(wx, wy))) return nan;
  return (wx * from_x + wy * from_y) / (wx + wy);
}

}  // namespace bedscope::digitise
