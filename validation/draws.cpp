// SPDX-License-Identifier: BSD-3-Clause
#include "validation/draws.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bedscope::validation {
namespace {

/// Share of the curve over which the errors of neighbours fall to 1/e: that at which the difference
/// of an outer fifth and the middle two fifths errs most (0.96 u; 0.76 u at 0.05, 0.66 u at 1).
constexpr double memory_length = 0.2;

}  // namespace

std::vector<std::size_t> drawn_points(std::size_t n) {
  std::vector<std::size_t> points(std::min(n, most_drawn));
  std::iota(points.begin(), points.end(), 0);
  if (n <= most_drawn) return points;
  std::mt19937_64 random;
  for (std::size_t k = 0; k < most_drawn; ++k) {
    const std::size_t begin = k * n / most_drawn, end = (k + 1) * n / most_drawn;
    points[k] = begin + random() % (end - begin);
  }
  return points;
}

std::vector<double> memory_of(std::span<const double> x, Errors errors) {
  std::vector<double> memory(x.size(), errors == Errors::common ? 1 : 0);
  if (errors != Errors::neighbours) return memory;
  for (std::size_t i = 1; i < x.size(); ++i) {
    const double gap = x[i] - x[i - 1];  // 0 where a place was measured twice
    memory[i] = gap > 0 ? std::exp(-gap / (memory_length * (x.back() - x.front()))) : 1;
  }
  return memory;
}

double Draw::after(double before, double memory) {
  if (memory == 1) return before;
  return memory * before + std::sqrt(1 - memory * memory) * normal();
}

std::vector<double> draw_errors(std::span<const double> memory, Draw& draw) {
  std::vector<double> errors;
  errors.reserve(memory.size());
  double error = draw.normal();
  for (const double of_one : memory) errors.push_back(error = draw.after(error, of_one));
  return errors;
}

std::vector<double> perturbed(std::span<const double> values, std::span<const double> u,
                              std::span<const double> errors) {
  std::vector<double> drawn(values.begin(), values.end());
  for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i] += errors[i] * u[i];
  return drawn;
}

Interval percentiles(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + .5)];
  };
  return {at(.025), at(.975)};
}

void widen(Interval& interval, double value, Interval drawn, bool reflect) {
  interval.lo = std::min(interval.lo, drawn.lo);
  interval.hi = std::max(interval.hi, drawn.hi);
  if (!reflect) return;
  interval.lo = std::min(interval.lo, 2 * value - drawn.hi);
  interval.hi = std::max(interval.hi, 2 * value - drawn.lo);
}

Interval about_all(Interval drawn, double of_some, double of_all) {
  return {std::min(drawn.lo, drawn.lo + (of_all - of_some)),
          std::max(drawn.hi, drawn.hi + (of_all - of_some))};
}

}  // namespace bedscope::validation
