// SPDX-License-Identifier: BSD-3-Clause
// Means of correlated time series and their errors; the start of the steady part.
#pragma once

#include <cstddef>
#include <span>

#include "analysis/result.hpp"

namespace bedscope::analysis {

/// A mean with its error and with what is to be said about that error.
struct MeanEstimate : Estimate {
  double independent_samples = 0;  ///< n / integrated autocorrelation time
  bool few_samples = false;        ///< fewer than 10 independent ones
  bool disagree = false;           ///< batch means and autocorrelation time give different errors
};

MeanEstimate estimate_mean(std::span<const double> values, std::span<const double> weights);
Estimate estimate_ratio(std::span<const double> numerator, std::span<const double> denominator,
                        std::span<const double> weights);

struct SteadyStart {
  std::size_t start = 0;
  bool steady = true;
  bool constant = false;
};
SteadyStart steady_start(std::span<const double> series);

}  // namespace bedscope::analysis
