// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/time_window.hpp"

#include <algorithm>
#include <cmath>

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

std::vector<double> window_weights(std::span<const double> times, const IndexRange& window) {
  std::vector<double> weights(times.size(), 0.);
  const auto inside = time_weights(times.subspan(window.first, window.count));
  std::copy(inside.begin(), inside.end(),
            weights.begin() + static_cast<std::ptrdiff_t>(window.first));
  return weights;
}

bool evenly_spaced(std::span<const double> times) {
  if (times.size() < 3) return true;
  const double gap = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  for (std::size_t i = 1; i < times.size(); ++i)
    if (std::abs(times[i] - times[i - 1] - gap) > 1e-6 * gap) return false;
  return true;
}

IndexRange select_window(std::span<const double> times, double from, double to, double half_step) {
  const auto first = std::lower_bound(times.begin(), times.end(), from - half_step);
  const auto end = std::upper_bound(first, times.end(), to + half_step);
  return {static_cast<std::size_t>(first - times.begin()), static_cast<std::size_t>(end - first)};
}

}  // namespace bedscope::analysis
