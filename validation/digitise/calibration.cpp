// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "readers/error.hpp"

namespace bedscope::digitise {
namespace {

constexpr double beside = 1.5;  // px: the pixel beside the middle, and the line's rounding

/// The line that is meant by a point: the only one near it.
std::optional<double> meant(double at, const std::vector<double>& lines, double pixel) {
  std::optional<double> line;
  for (const double other : lines) {
    if (std::abs(other - at) > 6 * pixel) continue;
    if (line) return std::nullopt;
    line = other;
  }
  return line && std::abs(*line - at) <= beside * pixel ? line : std::nullopt;
}

constexpr double of_a_fraction = 0.1;  // standard uncertainty of a pixel given as a fraction [px]

/// The line whose middle was measured: the nearest within three uncertainties of that.
std::optional<double> measured(double at, const std::vector<double>& lines, double pixel) {
  std::optional<double> line;
  for (const double other : lines)
    if (std::abs(other - at) <= 3 * of_a_fraction * pixel &&
        (!line || std::abs(other - at) < std::abs(*line - at)))
      line = other;
  return line;
}

/// The two points that are farthest apart, as a vector from the first to the second.
cv::Point2d longest(const AxisSpec& axis) {
  cv::Point2d best;
  for (const auto& from : axis.points)
    for (const auto& to : axis.points)
      if (cv::norm(to.pixel - from.pixel) > cv::norm(best)) best = to.pixel - from.pixel;
  return best;
}

bool in_whole_pixels(const AxisSpec& axis) {
  return std::all_of(axis.points.begin(), axis.points.end(), [](const auto& point) {
    return point.pixel.x == std::round(point.pixel.x) && point.pixel.y == std::round(point.pixel.y);
  });
}

/// The standard uncertainty of a point's pixel as given.
double picked(const AxisSpec& axis) {
  return in_whole_pixels(axis) ? 1 / std::sqrt(3.0) : of_a_fraction;
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
  double squares = u * u, shared = 0, tt = 0;
  for (const auto& place : places) tt += (place.at - origin) * (place.at - origin);
  for (const auto& place : places) {  // by how much the line at `pixel` follows this one
    const double lever =
        1 / static_cast<double>(places.size()) + (pixel - origin) * (place.at - origin) / tt;
    squares += std::pow(lever * place.u, 2);
    shared += lever * place.shared;
  }
  const double linear = std::abs(b) * std::sqrt(squares + shared * shared);
  return log ? value(pixel) * std::numbers::ln10 * linear : linear;
}

std::vector<Place> places_of(const AxisSpec& axis, const std::vector<double>& along,
                             const std::vector<double>& lines, double pixel, bool turned) {
  const bool whole = in_whole_pixels(axis);
  std::vector<Place> places;
  for (const double at : along) {
    const auto line = whole ? meant(at, lines, pixel) : measured(at, lines, pixel);
    if (!line) {
      places.push_back({at, pixel * picked(axis)});
      continue;
    }
    const double off_edge = std::abs(*line / pixel - std::round(*line / pixel));
    const double half = turned || off_edge > 0.25 ? 0.25 * pixel : 0;
    places.push_back({*line - half, pixel * 0.5 / std::sqrt(3.0), half});
  }
  return places;
}

Calibration calibrate(const AxisSpec& axis, const std::vector<Place>& places,
                      const std::string& where) {
  Calibration result;
  result.log = axis.log;
  const auto n = places.size();
  std::vector<double> values;
  for (const auto& point : axis.points) {
    if (axis.log && !(point.value > 0))
      throw InputError("{}: expected values above 0 on a log axis, found {}", where, point.value);
    values.push_back(axis.log ? std::log10(point.value) : point.value);
  }
  double mean = 0;
  for (std::size_t i = 0; i < n; ++i) {
    result.origin += places[i].at / static_cast<double>(n);
    mean += values[i] / static_cast<double>(n);
  }
  double tt = 0, tv = 0;
  for (std::size_t i = 0; i < n; ++i) {
    tt += (places[i].at - result.origin) * (places[i].at - result.origin);
    tv += (places[i].at - result.origin) * (values[i] - mean);
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
  double scatter = 0, squares = 0;  // px
  for (std::size_t i = 0; i < n; ++i) {
    const double off = std::abs(places[i].at - result.origin - (values[i] - mean) / result.b);
    scatter = std::max(scatter, off);
    squares += off * off;
  }
  const double allowed = std::max(3.0, 0.005 * std::sqrt(tt));
  if (scatter > allowed)
    throw InputError("{}: expected points on one {} scale, found one {:.1f} px off", where,
                     axis.log ? "logarithmic" : "linear", scatter);
  result.places = places;
  if (n == 2) return result;
  const double seen = std::sqrt(squares / static_cast<double>(n - 2));
  for (auto& place : result.places)
    if (seen < place.u) {
      place.shared = std::hypot(place.shared, std::sqrt(place.u * place.u - seen * seen));
      place.u = seen;
    } else {
      place.u = std::max(place.u, scatter / std::sqrt(3.0));
    }
  return result;
}

Angle angle_of_points(const Figure& figure) {
  auto along_x = longest(figure.x), along_y = longest(figure.y);
  if (along_x.x < 0) along_x = -along_x;
  if (along_y.y > 0) along_y = -along_y;
  const double to_degrees = 180 / std::numbers::pi;
  const double from_x = std::atan2(-along_x.y, along_x.x) * to_degrees;
  const double from_y = std::atan2(-along_y.x, -along_y.y) * to_degrees;
  const double wx = along_x.dot(along_x), wy = along_y.dot(along_y);
  if (std::abs(from_x) > 20 || std::abs(from_y) > 20) return {};
  if (std::abs(from_x - from_y) > 0.7 + 115 / std::sqrt(std::min(wx, wy))) return {};
  // Of each direction sqrt(2) picked / length; the weights are those of the least uncertainty.
  const double u = std::max(picked(figure.x), picked(figure.y)) * std::sqrt(2 / (wx + wy));
  return {(wx * from_x + wy * from_y) / (wx + wy), u * to_degrees};
}

}  // namespace bedscope::digitise
