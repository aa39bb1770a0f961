// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/uncertainty.hpp"

#include <cmath>
#include <complex>
#include <numbers>

namespace bedscope::digitise {
namespace {

/// 1 where all fractions of a pixel are alike, about 1/sqrt(n) where they are random (the mean
/// resultant length of directional statistics; Mardia and Jupp, 2000).
double alike(const std::vector<Marker>& markers, int axis) {
  std::complex<double> sum;
  for (const auto& marker : markers) {
    const double at = axis == 0 ? marker.at.x : marker.at.y;
    sum += std::polar(1.0, 2 * std::numbers::pi * at);
  }
  return std::abs(sum) / static_cast<double>(markers.size());
}

}  // namespace

void complete(std::vector<Marker>& markers, const Template&, bool lossy) {
  if (markers.empty()) return;
  const double chance = 1 / std::sqrt(static_cast<double>(markers.size()));
  for (int axis = 0; axis < 2; ++axis) {
    // On whole pixels: off by up to half a pixel, so that two standard uncertainties of a quarter
    // hold almost all. Too few markers to tell: in between.
    const double whole = 0.25, exact = 0.08;
    const double likeness = alike(markers, axis);
    const double grid = markers.size() < 4                     ? 0.2
                        : likeness > std::max(0.5, 2 * chance) ? whole
                                                               : exact;
    for (auto& marker : markers)
      marker.u[axis] = std::hypot(1.3 * marker.u[axis], grid, lossy ? 0.05 : 0.0);
  }
}

void complete(std::vector<LinePoint>& points, double stroke, bool lossy) {
  for (auto& point : points) point.u = std::hypot(point.u, 0.08 + 0.02 * stroke, lossy ? 0.1 : 0.0);
}

}  // namespace bedscope::digitise
