// SPDX-License-Identifier: BSD-3-Clause
// A mean and its error, the form of every averaged number.
#pragma once

#include <limits>

namespace bedscope::analysis {

/// A mean and the half-width of its 95 % confidence interval, in the unit of the quantity.
struct Estimate {
  double value = std::numeric_limits<double>::quiet_NaN();
  double ci95 = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace bedscope::analysis
