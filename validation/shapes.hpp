// SPDX-License-Identifier: BSD-3-Clause
// What a profile must look like where no curve is at hand.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "validation/metrics.hpp"

namespace bedscope::validation {

/// A shape as a statistic of the profile, and the limit that it keeps unless the check names one.
struct Shape {
  std::string_view name;
  std::string_view meaning;  ///< of the statistic
  bool small_is_good = true;
  double limit = 0;
  bool is_distance = false;  ///< never below 0
};

/// Walls are the outer fifths of the abscissa, the core its middle two fifths; m is the mean of the
/// absolute values over the profile.
///   u-shaped             (mean at the lower wall - mean of the core) / m          >= 0
///   core-annulus         (mean of the core - mean at the higher wall) / m         >= 0
///   down-flow at walls   the larger of the two walls' means, over m               <= 0
///   decreasing           rmse from the nearest falling profile, over m            <= 0.05
///   symmetric            rmse from its own mirror image / sqrt 2, over m          <= 0.1
///   near walls           share of the integral in both walls, over 0.4, less 1    >= 0
/// The nearest falling profile is the isotonic regression (Barlow et al. 1972, pool adjacent
/// violators); from both rmse the noise of the errors is subtracted as in `relative rmse`.
std::span<const Shape> shapes();

/// Null where there is no shape of that name.
const Shape* find_shape(const std::string& name);

/// Throws InputError for profiles with fewer than five points.
MetricValue evaluate(const Shape& shape, const Sampled& profile);

}  // namespace bedscope::validation
