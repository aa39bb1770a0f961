// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/uncertainty.hpp"

#include <cmath>
#include <complex>
#include <numbers>

namespace bedscope::digitise {
namespace {

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

}  // namespace

void complete(std::vector<Marker>& markers, int reduction, bool turned, bool lossy) {
  if (markers.empty()) return;
  const double chance = 1 / std::sqrt(static_cast<double>(markers.size()));
  for (int axis = 0; axis < 2; ++axis) {
    const auto mean = mean_fraction(markers, axis);
    double shift = 0, grid = 0.08;
    if (reduction > 1 || markers.size() < 4) {  // nothing to tell from
      shift = 0.25 / reduction;
      grid = 0.3 / reduction;
    } else if (std::abs(mean) > std::max(0.45, 2 * chance)) {
      // A quarter of a pixel, as twice that holds almost all of an error of up to half a pixel.
      const bool on_edges = !turned && mean.real() > 0;
      shift = on_edges ? 0 : 0.25;
      grid = on_edges ? 0.25 : 0.33;
    }
    for (auto& marker : markers) {
      (axis == 0 ? marker.at.x : marker.at.y) -= shift;
      marker.u[axis] = std::hypot(1.3 * marker.u[axis], grid, lossy ? 0.05 : 0.0);
    }
  }
}

void complete(std::vector<LinePoint>& points, double stroke, bool lossy) {
  for (auto& point : points) point.u = std::hypot(point.u, 0.08 + 0.02 * stroke, lossy ? 0.1 : 0.0);
}

}  // namespace bedscope::digitise
