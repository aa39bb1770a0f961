// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace bedscope::analysis {
namespace {

// Chosen from measured coverages (tests/analysis/coverage_test.cpp prints the table).
constexpr std::size_t most_batches = 10;
constexpr std::size_t fewest_batches = 4;
constexpr double batch_length = 5;           // in autocorrelation times
constexpr double correlated = 2;             // an autocorrelation time that widens the interval
constexpr double disagreement = 2.5;         // between the two standard errors
constexpr double enough_independent = 10;    // samples
constexpr double enough_for_skewness = 12;   // samples, per skewness squared
constexpr std::size_t fewest_for_time = 10;  // samples to estimate an autocorrelation time from

constexpr double rounding = 1e-12;  // of the largest magnitude: sums of 1e6 terms in any order

bool is_constant(std::span<const double> values) {
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  return *highest - *lowest <= rounding * std::max(std::abs(*lowest), std::abs(*highest));
}

double sum_of_squares(std::span<const double> values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

/// The two opinions on the error of a sum of contributions that add up to zero.
struct Errors {
  std::size_t batches = 0;
  AutocorrelationTime time;
  double from_time = 0;  ///< standard error by the autocorrelation time
};

Errors errors_by_time(std::span<const double> contributions) {
  const std::size_t n = contributions.size();
  Errors errors;
  if (n >= fewest_for_time) errors.time = autocorrelation_time(contributions);
  const double count = static_cast<double>(n);
  errors.from_time =
      std::sqrt(count / (count - 1) * sum_of_squares(contributions) * errors.time.value);
  const auto wanted = static_cast<std::size_t>(count / (batch_length * errors.time.value));
  errors.batches = n < most_batches ? n : std::clamp(wanted, fewest_batches, most_batches);
  return errors;
}

/// Sums over `batches` runs of consecutive values, as equal in length as can be.
std::vector<double> batch_sums(std::span<const double> values, std::size_t batches) {
  std::vector<double> sums(batches);
  for (std::size_t b = 0; b < batches; ++b) {
    const std::size_t first = b * values.size() / batches;
    const std::size_t last = (b + 1) * values.size() / batches;
    for (std::size_t i = first; i < last; ++i) sums[b] += values[i];
  }
  return sums;
}

/// Student's t for 95 %: profiles and fields ask for it once a cell.
double t95(std::size_t batches) {
  static const auto table = [] {
    std::array<double, most_batches + 1> t{};
    for (std::size_t b = 2; b <= most_batches; ++b) t[b] = student_t(0.95, static_cast<int>(b) - 1);
    return t;
  }();
  return table[batches];
}

double half_width(const Errors& errors, double from_batches) {
  const bool widen = errors.time.value > correlated;
  return t95(errors.batches) * (widen ? std::max(from_batches, errors.from_time) : from_batches);
}

}  // namespace

MeanEstimate estimate_mean(std::span<const double> values, std::span<const double> weights) {
  assert(values.size() == weights.size());
  MeanEstimate result;
  const std::size_t n = values.size();
  if (n == 0) return result;
  // Relative to the first, equal weights are exactly 1 and the mean is the plain one to the bit.
  const auto weight = [&](std::size_t i) { return weights[i] / weights[0]; };
  double total = 0, sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    total += weight(i);
    sum += weight(i) * values[i];
  }
  result.value = sum / total;
  result.independent_samples = static_cast<double>(n);
  result.enough_samples = enough_independent;
  result.few_samples = n == 1;
  if (n == 1) return result;
  if (is_constant(values)) {
    result.ci95 = 0;
    return result;
  }

  std::vector<double> contributions(n);  // to the error of the mean
  double second = 0, third = 0;          // central moments
  for (std::size_t i = 0; i < n; ++i) {
    const double share = weight(i) / total, deviation = values[i] - result.value;
    contributions[i] = share * deviation;
    second += contributions[i] * deviation;
    third += contributions[i] * deviation * deviation;
  }
  const Errors errors = errors_by_time(contributions);
  const double batches = static_cast<double>(errors.batches);
  const double from_batches = std::sqrt(batches / (batches - 1) *
                                        sum_of_squares(batch_sums(contributions, errors.batches)));
  result.ci95 = half_width(errors, from_batches);

  const double independent = static_cast<double>(n) / errors.time.value;
  const double skewness_squared = third * third / (second * second * second);
  result.independent_samples = std::min(independent, static_cast<double>(n));
  // One standard error of the correlation time more, as it comes from the same series.
  result.enough_samples = std::max(enough_independent, enough_for_skewness * skewness_squared) *
                          (1 + errors.time.relative_error);
  result.few_samples = n < fewest_for_time || independent < result.enough_samples;
  result.disagree = n >= fewest_for_time && (from_batches > disagreement * errors.from_time ||
                                             errors.from_time > disagreement * from_batches);
  return result;
}

Estimate estimate_ratio(std::span<const double> numerator, std::span<const double> denominator,
                        std::span<const double> weights) {
  assert(numerator.size() == weights.size() && denominator.size() == weights.size());
  Estimate result;
  const std::size_t n = weights.size();
  std::vector<double> above(n), below(n), contributions(n);
  for (std::size_t i = 0; i < n; ++i) {
    above[i] = weights[i] / weights[0] * numerator[i];
    below[i] = weights[i] / weights[0] * denominator[i];
  }
  const double total = std::accumulate(below.begin(), below.end(), 0.0);
  if (total == 0) return result;
  result.value = std::accumulate(above.begin(), above.end(), 0.0) / total;
  if (n < 2) return result;

  for (std::size_t i = 0; i < n; ++i)
    contributions[i] = (above[i] - result.value * below[i]) / total;
  const Errors errors = errors_by_time(contributions);
  const std::vector<double> above_sums = batch_sums(above, errors.batches);
  const std::vector<double> below_sums = batch_sums(below, errors.batches);
  std::vector<double> without(errors.batches);  // the ratio without one of the batches
  for (std::size_t left_out = 0; left_out < errors.batches; ++left_out) {
    // Summed anew: a difference of the totals would miss an exact zero.
    double above_rest = 0, below_rest = 0;
    for (std::size_t b = 0; b < errors.batches; ++b) {
      if (b == left_out) continue;
      above_rest += above_sums[b];
      below_rest += below_sums[b];
    }
    if (below_rest == 0) return result;
    without[left_out] = above_rest / below_rest;
  }
  const double batches = static_cast<double>(errors.batches);
  const double centre = std::accumulate(without.begin(), without.end(), 0.0) / batches;
  for (double& ratio : without) ratio -= centre;
  result.ci95 = half_width(errors, std::sqrt((batches - 1) / batches * sum_of_squares(without)));
  return result;
}

AutocorrelationTime autocorrelation_time(std::span<const double> deviations) {
  const std::size_t n = deviations.size();
  const double variance = sum_of_squares(deviations);
  if (n < 2 || variance == 0) return {};
  const double count = static_cast<double>(n);
  double time = 1, window = 0;
  for (std::size_t lag = 1; lag < n; ++lag) {
    time += 2 / variance *
            std::inner_product(deviations.begin() + static_cast<std::ptrdiff_t>(lag),
                               deviations.end(), deviations.begin(), 0.0);
    window = static_cast<double>(lag);
    if (window >= 4 * std::max(time, 1.0) || lag >= n / 4) break;
  }
  const double correction = 1 + (2 * window + 1) / count;
  return {std::max(time * correction, 1 / count), std::sqrt(2 * (2 * window + 1) / count)};
}

double student_t(double confidence, int degrees_of_freedom) {
  assert(confidence > 0 && confidence < 1 && degrees_of_freedom >= 1);
  // P(|T| <= sqrt(dof) tan(angle)) is a finite sum in the angle.
  const auto probability = [degrees_of_freedom](double angle) {
    const double sine = std::sin(angle), cosine = std::cos(angle);
    const bool odd = degrees_of_freedom % 2 == 1;
    double term = odd ? cosine : 1, sum = degrees_of_freedom == 1 ? 0 : term;
    for (int k = odd ? 3 : 2; k < degrees_of_freedom; k += 2) {
      term *= cosine * cosine * (k - 1) / k;
      sum += term;
    }
    return odd ? 2 / std::numbers::pi * (angle + sine * sum) : sine * sum;
  };
  double low = 0, high = std::numbers::pi / 2;
  for (;;) {  // ends when no number is left between the two
    const double middle = std::midpoint(low, high);
    if (middle <= low || middle >= high) break;
    (probability(middle) < confidence ? low : high) = middle;
  }
  return std::sqrt(degrees_of_freedom) * std::tan(low);
}

namespace {

constexpr std::size_t samples_a_mean = 5;      // of MSER-5
constexpr std::size_t fewest_for_steady = 20;  // samples
constexpr std::size_t fewest_kept = 5;         // means: the variance of fewer is small by chance
constexpr double as_good = 1.1;                // times the minimum
constexpr double plain_drift = 3;              // standard errors
constexpr double significant_jump = 5;         // more, as its place is chosen from the series

/// Least-squares fit of a times a shape to a series, both of zero mean.
struct Fit {
  double significance = 0;  ///< |a| over its standard error, correlation included
  double residue = 0;       ///< sum of squares that is left
};

std::vector<double> without_mean(std::span<const double> series) {
  const double sum = std::accumulate(series.begin(), series.end(), 0.0);
  std::vector<double> deviations(series.begin(), series.end());
  for (double& x : deviations) x -= sum / static_cast<double>(series.size());
  return deviations;
}

Fit fit(std::vector<double> deviations, const std::vector<double>& shape) {
  const double spread = sum_of_squares(shape);
  const double amplitude =
      std::inner_product(shape.begin(), shape.end(), deviations.begin(), 0.0) / spread;
  for (std::size_t i = 0; i < shape.size(); ++i) deviations[i] -= amplitude * shape[i];
  const double residue = sum_of_squares(deviations);
  // What a fit leaves swings against itself, the more so the shorter it is: a time below that of
  // white noise would be taken from the fit, not from the series.
  const double time = std::max(1.0, autocorrelation_time(deviations).value);
  const double variance = residue / static_cast<double>(shape.size() - 2) * time / spread;
  return {std::abs(amplitude) / std::sqrt(variance), residue};
}

/// Where a series of zero mean jumps, if it does: the two means that leave the least squares.
std::size_t best_jump(std::span<const double> deviations) {
  std::size_t best = 1;
  double most = 0, sum = 0;
  for (std::size_t i = 1; i < deviations.size(); ++i) {
    sum += deviations[i - 1];
    const double explained = sum * sum / static_cast<double>(i * (deviations.size() - i));
    if (explained <= most) continue;
    most = explained;
    best = i;
  }
  return best;
}

/// Whether a series drifts, or jumps: the better fit of the two decides.
bool changes(std::span<const double> series) {
  const std::vector<double> deviations = without_mean(series);
  std::vector<double> line(series.size()), step(series.size(), 0.0);
  std::iota(line.begin(), line.end(), 0.0);
  std::fill(step.begin() + static_cast<std::ptrdiff_t>(best_jump(deviations)), step.end(), 1.0);
  const Fit drift = fit(deviations, without_mean(line));
  const Fit leap = fit(deviations, without_mean(step));
  return leap.residue < drift.residue ? leap.significance > significant_jump
                                      : drift.significance > plain_drift;
}

/// The rule's statistic for each number of means cut off the front; the last ones are left out.
std::vector<double> marginal_errors(std::span<const double> series, std::size_t length) {
  const std::size_t k = series.size() / length;
  std::vector<double> statistic(k);
  double mean = 0, squares = 0;  // Welford, from the end: exactly 0 on a constant tail
  for (std::size_t d = k; d-- > 0;) {
    const auto block = series.subspan(series.size() - (k - d) * length, length);
    const double y = std::accumulate(block.begin(), block.end(), 0.0) / static_cast<double>(length);
    const double kept = static_cast<double>(k - d), deviation = y - mean;
    mean += deviation / kept;
    squares += deviation * (y - mean);
    statistic[d] = squares / (kept * kept);
  }
  statistic.resize(k - fewest_kept + 1);
  return statistic;
}

}  // namespace

Drift drift_of(std::span<const double> series) {
  Drift drift;
  const std::size_t n = series.size();
  const bool finite =
      std::all_of(series.begin(), series.end(), [](double x) { return std::isfinite(x); });
  if (n < fewest_for_steady || !finite || is_constant(series)) return drift;
  std::vector<double> line(n);
  std::iota(line.begin(), line.end(), 0.0);
  line = without_mean(line);
  const auto deviations = without_mean(series);
  const double slope =
      std::inner_product(line.begin(), line.end(), deviations.begin(), 0.0) / sum_of_squares(line);
  drift.change = slope * static_cast<double>(n - 1);
  drift.significance = fit(deviations, line).significance;
  return drift;
}

SteadyStart steady_start(std::span<const double> series) {
  SteadyStart result;
  const std::size_t n = series.size();
  const bool finite =
      std::all_of(series.begin(), series.end(), [](double x) { return std::isfinite(x); });
  if (n > 0 && finite && is_constant(series)) {
    result.constant = true;
    return result;
  }
  if (n < fewest_for_steady || !finite) {
    result.steady = false;
    return result;
  }
  const std::size_t length = std::min(samples_a_mean, n / fewest_for_steady);
  // What does not fill a mean is cut off the front with the first mean that is cut.
  const auto sample = [&](std::ptrdiff_t d) {
    return d == 0 ? 0 : n % length + static_cast<std::size_t>(d) * length;
  };
  const std::vector<double> statistic = marginal_errors(series, length);
  const auto begin = statistic.begin();
  const auto half = begin + static_cast<std::ptrdiff_t>(n / length / 2);
  const auto best = std::min_element(begin, statistic.end());
  const auto early = std::min_element(begin, half + 1);
  result.steady = best < half || !changes(series.subspan(sample(early - begin)));
  auto chosen = best;
  if (result.steady) {
    chosen = *early > 0 ? half : early;              // an exactly constant rest is kept whole
    if (*begin <= as_good * *early) chosen = begin;  // no start-up to be seen: nothing is cut
    while (*chosen > as_good * *early) --chosen;
  }
  result.start = sample(chosen - begin);
  return result;
}

}  // namespace bedscope::analysis
