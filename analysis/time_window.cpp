// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/time_window.hpp"

#include <algorithm>

namespace bedscope::analysis {

std::vector<double> time_weights(std::span<const double> times) {
  const std::size_t n = times.size();
  if (n < 2) return std::vector<double>(n, 1.0);
  std::vector<double> weights(n);
  weights.front() = times[1] - times[0];
  weights.back() = times[n - 1] - times[n - 2];
  for (std::size_t i = 1; i + 1 < n; ++i) weights[i] = (times[i + 1] - times[i - 1]) / 2;
  return weights;
}

IndexRange select_window(std::span<const double> times, double from, double to, double half_step) {
  const auto first = std::lower_bound(times.begin(), times.end(), from - half_step);
  const auto end = std::upper_bound(first, times.end(), to + half_step);
  return {static_cast<std::size_t>(first - times.begin()), static_cast<std::size_t>(end - first)};
}

}  // namespace bedscope::analysis
