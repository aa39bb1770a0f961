// SPDX-License-Identifier: BSD-3-Clause
#include "readers/checkup_series.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace bedscope::readers {
namespace {

constexpr std::size_t enough = 3;                            // equal intervals that make a spacing
constexpr std::int64_t longest_gap = 1'000'000'000'000'000;  // beyond, steps are nonsense
constexpr std::size_t batches = 10;
constexpr std::size_t fewest_points = 5;
constexpr double least_change = 0.01;

/// Steps come from files and may be anything: no overflow.
std::int64_t difference(std::int64_t a, std::int64_t b) {
  std::int64_t d = 0;
  return __builtin_sub_overflow(b, a, &d) ? std::numeric_limits<std::int64_t>::max() : d;
}

/// Equal intervals in a row: steps[first] to steps[first + count].
struct Stretch {
  std::size_t first = 0, count = 0;
  std::int64_t spacing = 0;
};

std::vector<Stretch> stretches_of(std::span<const std::int64_t> steps) {
  std::vector<Stretch> found;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    const auto d = difference(steps[i], steps[i + 1]);
    if (found.empty() || found.back().spacing != d)
      found.push_back({i, 1, d});
    else
      ++found.back().count;
  }
  return found;
}

std::int64_t most_common(const std::vector<Stretch>& stretches) {
  std::map<std::int64_t, std::size_t> counts;
  for (const auto& stretch : stretches) counts[stretch.spacing] += stretch.count;
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? 0 : most->first;
}

/// The spacing that holds at each stretch: its own, or that of the nearest long one, the one before
/// rather than the one after; 0 where there is no long one.
std::vector<std::int64_t> spacing_around(const std::vector<Stretch>& stretches) {
  std::vector<std::int64_t> around(stretches.size(), 0);
  std::int64_t spacing = 0;
  for (std::size_t k = 0; k < stretches.size(); ++k) {
    if (stretches[k].count >= enough) spacing = stretches[k].spacing;
    around[k] = spacing;
  }
  for (std::size_t k = stretches.size(); k-- > 0;) {
    if (around[k] == 0) around[k] = spacing;
    if (stretches[k].count >= enough) spacing = stretches[k].spacing;
  }
  return around;
}

/// Two-sided 99 % points of Student's t for 1 to 8 degrees of freedom.
constexpr std::array student{63.657, 9.925, 5.841, 4.604, 4.032, 3.707, 3.499, 3.355};

}  // namespace

std::uint64_t StepSpacing::Gap::missing() const {
  return static_cast<std::uint64_t>((after - before) / spacing - 1);
}

std::uint64_t StepSpacing::missing() const {
  return std::accumulate(gaps.begin(), gaps.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const Gap& gap) { return sum + gap.missing(); });
}

StepSpacing spacing_of(std::span<const std::int64_t> steps) {
  StepSpacing found;
  const auto stretches = stretches_of(steps);
  found.usual = most_common(stretches);
  if (stretches.size() < 2) return found;
  const auto around = spacing_around(stretches);
  std::int64_t before = 0;  // the last spacing that held
  for (std::size_t k = 0; k < stretches.size(); ++k) {
    const auto& [first, count, spacing] = stretches[k];
    const auto expected = around[k];
    if (expected == 0 ? spacing == found.usual : spacing == expected) {
      if (before != 0 && expected != before && count >= enough)
        found.changes.push_back({steps[first], before, expected});
      if (count >= enough) before = expected;
    } else if (expected != 0 && spacing < longest_gap && spacing % expected == 0) {
      for (std::size_t i = first; i < first + count; ++i)
        found.gaps.push_back({steps[i], steps[i + 1], expected});
    } else {
      found.irregular += count;
    }
  }
  return found;
}

bool Trend::significant() const {
  return std::abs(change) > ci99 && std::abs(change) > least_change;
}

std::optional<std::size_t> sudden_change(std::span<const std::int64_t> counts, double sign) {
  std::vector<double> changes;
  for (std::size_t i = 1; i < counts.size(); ++i)
    changes.push_back(static_cast<double>(counts[i] - counts[i - 1]) /
                      static_cast<double>(std::max<std::int64_t>(counts[i - 1], 1)));
  if (changes.size() < 3) return {};
  auto sizes = changes;
  for (auto& size : sizes) size = std::abs(size);
  std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2),
                   sizes.end());
  const double median = sizes[sizes.size() / 2];
  const auto most = std::max_element(changes.begin(), changes.end(),
                                     [&](double a, double b) { return sign * a < sign * b; });
  const auto i = static_cast<std::size_t>(most - changes.begin());
  const double chance = 5 / std::sqrt(static_cast<double>(std::max<std::int64_t>(counts[i], 1)));
  if (sign * *most <= std::max({0.2, 5 * median, chance})) return {};
  return i;
}

std::optional<Trend> trend_of(std::span<const double> x, std::span<const double> y) {
  const std::size_t n = std::min(batches, x.size());
  if (n < fewest_points) return std::nullopt;
  std::vector<double> at(n, 0.), mean(n, 0.);
  for (std::size_t b = 0; b < n; ++b) {
    const std::size_t first = b * x.size() / n, last = (b + 1) * x.size() / n;
    for (std::size_t i = first; i < last; ++i) {
      at[b] += x[i] / static_cast<double>(last - first);
      mean[b] += y[i] / static_cast<double>(last - first);
    }
  }
  const auto count = static_cast<double>(n);
  const double x0 = std::accumulate(at.begin(), at.end(), 0.) / count;
  const double y0 = std::accumulate(mean.begin(), mean.end(), 0.) / count;
  double xx = 0, xy = 0;
  for (std::size_t b = 0; b < n; ++b) {
    xx += (at[b] - x0) * (at[b] - x0);
    xy += (at[b] - x0) * (mean[b] - y0);
  }
  const double slope = xy / xx;
  double rest = 0;
  for (std::size_t b = 0; b < n; ++b) rest += std::pow(mean[b] - y0 - slope * (at[b] - x0), 2);
  const double error = std::sqrt(rest / (count - 2) / xx);
  const double length = x.back() - x.front();
  const Trend trend{y0, slope * length / y0, student[n - 3] * error * length / std::abs(y0)};
  if (!std::isfinite(trend.change) || !std::isfinite(trend.ci99)) return std::nullopt;
  return trend;
}

}  // namespace bedscope::readers
