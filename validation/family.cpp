// SPDX-License-Identifier: BSD-3-Clause
#include "validation/family.hpp"

#include <algorithm>
#include <cmath>

namespace bedscope::validation {
namespace {

void evaluate(Family& family) {
  std::vector<double> logarithms;
  double relative = 0;
  for (const auto* verdict : family.verdicts)
    for (const auto& point : verdict->comparison.points) {
      if (!point.has_logarithm()) {
        ++family.left_out;
        continue;
      }
      logarithms.push_back(std::log(point.result / point.reference));
      relative += std::pow(point.u_reference / point.reference, 2);
    }
  family.points = logarithms.size();
  if (logarithms.empty()) return;
  const auto n = static_cast<double>(logarithms.size());
  double mean = 0, variance = 0;
  for (const double value : logarithms) mean += value / n;
  for (const double value : logarithms)
    variance += (value - mean) * (value - mean) / std::max(1., n - 1);
  family.sigma_experiment = std::sqrt(relative / n);
  family.scatter = std::sqrt(std::max(0., variance - relative / n));
  family.bias = std::exp(mean + (family.scatter * family.scatter - relative / n) / 2);
}

}  // namespace

std::vector<Family> families(std::span<const Verdict> verdicts) {
  std::vector<Family> found;
  for (const auto& verdict : verdicts) {
    if (verdict.comparison.points.empty()) continue;
    const auto& quantity = verdict.check.place.quantity;
    auto family = std::find_if(found.begin(), found.end(),
                               [&](const Family& f) { return f.quantity == quantity; });
    if (family == found.end()) {
      found.push_back({.quantity = quantity, .unit = verdict.comparison.y.unit});
      family = found.end() - 1;
    }
    // Several metrics of one comparison are one comparison.
    const bool seen =
        std::any_of(family->verdicts.begin(), family->verdicts.end(),
                    [&](const Verdict* other) { return same_comparison(*other, verdict); });
    if (!seen) family->verdicts.push_back(&verdict);
  }
  for (auto& family : found) evaluate(family);
  return found;
}

}  // namespace bedscope::validation
