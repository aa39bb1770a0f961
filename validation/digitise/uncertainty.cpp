// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/uncertainty.hpp"

#include <cmath>
#include <complex>
#include <numbers>

namespace bedscope::digitise {
namespace {

constexpr double compression = 0.05;  // of a place in a JPEG [px]

/// The mean of the fractions of a pixel as a vector: of length 1 where all are alike, about
/// 1/sqrt(n) where they are random (the mean resultant of directional statistics; Mardia and Jupp,
/// 2000).
std::complex<double> mean_fraction(const std::vector<Marker>& markers, int axis) {
  std::complex<double> sum;
  for (const auto& marker : markers) {
    const double at = axis == 0 ? marker.at.x : marker.at.y;
    sum += std::polar(1.0, 2 * std::numbers::pi * at);
  }
  return sum / static_cast<double>(markers.size());
}

double mean_u(const std::vector<Marker>& markers, int axis) {
  double sum = 0;
  for (const auto& marker : markers) sum += marker.u[axis];
  return sum / static_cast<double>(markers.size());
}

}  // namespace

void complete(std::vector<Marker>& markers, int reduction, bool turned, bool lossy) {
  if (markers.empty()) return;
  const auto n = static_cast<double>(markers.size());
  for (int axis = 0; axis < 2; ++axis) {
    const auto mean = mean_fraction(markers, axis);
    // An error of 0.2 px would make alike fractions look different: |mean| = exp(-2 pi^2 0.04).
    const bool seen = !turned && reduction == 1 && n >= 4 && mean_u(markers, axis) < 0.15;
    double shift = 0.25 / reduction, grid = 0.33 / reduction;
    if (seen && std::abs(mean) > std::max(0.45, 2 / std::sqrt(n)) && mean.real() > 0) {
      // A quarter of a pixel, as twice that holds almost all of an error of up to half a pixel.
      shift = 0;
      grid = 0.25;
    } else if (seen && n >= 8 && std::abs(mean) < 0.45) {  // by chance 1 / sqrt(n)
      shift = 0;
      grid = 0.08;
    }
    for (auto& marker : markers) {
      (axis == 0 ? marker.at.x : marker.at.y) -= shift;
      marker.u[axis] = std::hypot(1.3 * marker.u[axis], grid, lossy ? compression : 0.0);
    }
  }
}

void complete(std::vector<LinePoint>& points, bool lossy) {
  for (auto& point : points)
    point.u = std::hypot(point.u, 1 / 9.0 / std::sqrt(3.0), lossy ? compression : 0.0);
}

}  // namespace bedscope::digitise
