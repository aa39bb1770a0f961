// SPDX-License-Identifier: BSD-3-Clause
#include "validation/metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <set>

#include "readers/error.hpp"
#include "readers/toml_table.hpp"
#include "validation/draws.hpp"

namespace bedscope::validation {
namespace {

/// Abscissae of the compared points.
std::vector<double> abscissae(const Comparison& comparison) {
  std::vector<double> x;
  for (const auto& point : comparison.points) x.push_back(point.x);
  return x;
}

struct Perturbed {
  std::vector<double> result, reference;
};

/// Standard normal errors of all points: what is drawn once for all metrics of errors.
struct Deviates {
  std::vector<double> result, reference, between;

  Deviates(std::span<const double> memory, Draw& draw) {
    double of_result = draw.normal(), of_reference = draw.normal();
    for (const double of_one : memory) {
      result.push_back(of_result = draw.after(of_result, of_one));
      reference.push_back(of_reference = draw.after(of_reference, of_one));
      between.push_back(draw.normal());
    }
  }
};

/// `of_average`: with the errors of the time average, or with those alone that no longer simulation
/// would narrow.
Perturbed perturbed(const Comparison& comparison, const Deviates& drawn, bool of_average) {
  Perturbed curves;
  for (std::size_t i = 0; i < comparison.points.size(); ++i) {
    const auto& point = comparison.points[i];
    curves.result.push_back(point.result + (of_average ? drawn.result[i] * point.u_result : 0) +
                            drawn.between[i] * point.u_interpolation);
    const bool towards = (drawn.reference[i] > 0) == (point.error() >= 0);
    curves.reference.push_back(point.reference +
                               drawn.reference[i] * (towards ? point.u_reference : point.away()));
  }
  return curves;
}

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
}

/// Mean over the points of the squares of f.
template <class F>
double mean_square(const Comparison& comparison, F&& f) {
  double sum = 0;
  for (const auto& point : comparison.points) sum += f(point) * f(point);
  return sum / static_cast<double>(comparison.points.size());
}

/// Mean square of the reference's relative uncertainty and of the result's, from its time average
/// and from its interpolation.
double relative_noise(const Comparison& comparison, bool of_average, bool of_interpolation) {
  double sum = 0;
  for (const auto& point : comparison.points) {
    const double u =
        std::hypot(of_average ? point.u_result : 0, of_interpolation ? point.u_interpolation : 0);
    sum += std::pow(u / point.result, 2) + std::pow(point.u_reference_mean() / point.reference, 2);
  }
  return sum / static_cast<double>(comparison.points.size());
}

std::vector<double> ranks(std::span<const double> values) {
  std::vector<std::pair<double, std::size_t>> order;
  for (const double value : values) order.emplace_back(value, order.size());
  std::sort(order.begin(), order.end());
  std::vector<double> rank(values.size());
  for (std::size_t i = 0; i < order.size();) {  // ties share their mean rank
    std::size_t end = i + 1;
    while (end < order.size() && order[end].first == order[i].first) ++end;
    for (std::size_t k = i; k < end; ++k)
      rank[order[k].second] = (static_cast<double>(i) + static_cast<double>(end - 1)) / 2;
    i = end;
  }
  return rank;
}

/// Of ln(result / reference), where both were drawn above 0.
struct Logarithms {
  double count = 0, mean = 0, variance = 0;

  Logarithms(std::span<const double> result, std::span<const double> reference) {
    std::vector<double> values;
    for (std::size_t i = 0; i < result.size(); ++i)
      if (result[i] > 0 && reference[i] > 0) values.push_back(std::log(result[i] / reference[i]));
    count = static_cast<double>(values.size());
    for (const double value : values) mean += value / count;
    for (const double value : values)
      variance += (value - mean) * (value - mean) / std::max(1., count - 1);
  }
};

double rank_correlation(std::span<const double> a, std::span<const double> b) {
  const auto ra = ranks(a), rb = ranks(b);
  const double ma = mean(ra), mb = mean(rb);
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < ra.size(); ++i) {
    ab += (ra[i] - ma) * (rb[i] - mb);
    aa += (ra[i] - ma) * (ra[i] - ma);
    bb += (rb[i] - mb) * (rb[i] - mb);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

/// The metric of drawn curves; `added` is the mean square that the draws add by themselves, in the
/// metric's own measure.
double statistic(const Metric& metric, const Comparison& comparison, const Perturbed& drawn,
                 double added) {
  const auto n = static_cast<double>(drawn.result.size());
  const double m = std::abs(mean(drawn.reference));
  const auto error = [&](std::size_t i) { return drawn.result[i] - drawn.reference[i]; };
  const bool is_scaled = metric.name == "e over u";
  double squares = 0, sum = 0, largest = 0;
  for (std::size_t i = 0; i < drawn.result.size(); ++i) {
    const double scale = is_scaled ? comparison.points[i].u_validation() : 1;
    squares += error(i) * error(i) / (scale * scale) / n;
    sum += error(i) / n;
    largest = std::max(largest, std::abs(error(i)));
  }
  if (metric.name == "relative rmse") return std::sqrt(std::max(0., squares - added)) / m;
  if (metric.name == "e over u") return std::sqrt(squares);
  if (metric.name == "relative bias") return std::abs(sum) / m;
  if (metric.name == "relative max error") return largest / m;
  if (metric.name == "max error") return largest;
  if (metric.of_logarithms) {
    const Logarithms logarithms(drawn.result, drawn.reference);
    const double scatter2 = std::max(0., logarithms.variance - added);
    if (metric.name == "model scatter") return std::sqrt(scatter2);
    return std::abs(
        std::exp(logarithms.mean + (scatter2 - relative_noise(comparison, false, false)) / 2) - 1);
  }
  return rank_correlation(drawn.result, drawn.reference);
}

/// The z with P(N > z) = share for a normal N, by Newton's method on erfc.
double normal_quantile(double share) {
  double z = 2;
  for (int k = 0; k < 50; ++k) {
    const double density = std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
    z += (std::erfc(z / std::sqrt(2.)) / 2 - share) / density;
  }
  return z;
}

/// Of max |E|: the largest of the points' upper ends, 2.5 % each, for the truth's largest is one of
/// them; and the largest of their lower ends, 2.5 % for all n together (Bonferroni), for noise
/// chooses among n. Both hold whatever the correlation between points. An error of the mean that
/// scales may go with the point's own: they are added.
Interval interval_of_largest(const Comparison& comparison, bool per_mean, bool of_average) {
  const auto n = static_cast<double>(comparison.points.size());
  const double outer = normal_quantile(.025), inner = normal_quantile(.025 / n);
  double m = 0, u_m = 0;
  for (const auto& point : comparison.points) {
    m += point.reference / n;
    u_m += point.u_reference_mean() / n;
  }
  const double scale = per_mean ? std::abs(m) : 1;
  Interval interval;
  for (const auto& point : comparison.points) {
    const double e = std::abs(point.error());
    const double of_mean = per_mean ? e * u_m / std::abs(m) : 0;
    const auto u = [&](double of_reference) {
      return std::hypot(of_average ? point.u_result : 0, point.u_interpolation,
                        of_reference + of_mean);
    };
    interval.lo = std::max(interval.lo, (e - inner * u(point.u_reference)) / scale);
    interval.hi = std::max(interval.hi, (e + outer * u(point.away())) / scale);
  }
  return interval;
}

/// What is taken off the mean square of the drawn errors, by each of the ways that may be right.
std::vector<double> taken_off(const Metric& metric, const Comparison& comparison, double noise,
                              Errors errors, bool of_average) {
  if (metric.name == "relative rmse") {
    const double drawn = mean_square(comparison, [&](const ComparedPoint& p) {
      return std::hypot(of_average ? p.u_result : 0, p.u_interpolation, p.u_reference_mean());
    });
    const double of_reference = mean_square(comparison, [](const ComparedPoint& p) {
      return std::hypot(p.u_reference_mean(), p.u_interpolation);
    });
    // The rmse as defined has the scatter of the reference in it; the truth has not.
    return {noise + drawn, noise + drawn + of_reference};
  }
  if (!metric.of_logarithms) return {0};
  if (errors == Errors::common) return {0, noise};  // which are no scatter
  return {noise + relative_noise(comparison, of_average, true)};
}

/// With the errors of the time average, and with those alone that no longer simulation would
/// narrow.
struct Intervals {
  Interval all, fixed;
};

Intervals intervals_of(const Metric& metric, const Comparison& comparison, double value,
                       double noise) {
  if (metric.name == "e over u")  // has the uncertainties in it already
    return {{value, value}, {value, value}};
  if (metric.name.ends_with("max error"))
    return {interval_of_largest(comparison, metric.per_mean, true),
            interval_of_largest(comparison, metric.per_mean, false)};
  const bool reflects = metric.name != "relative rmse" && metric.name != "model scatter";
  Intervals intervals{{value, value}, {value, value}};
  const auto x = abscissae(comparison);
  for (const auto errors : all_errors) {
    // Of a mean and a mean square the common errors are the largest.
    if (errors == Errors::neighbours && !metric.of_differences) continue;
    const auto memory = memory_of(x, errors);
    struct Values {
      bool of_average;
      Interval& interval;
      std::vector<double> off;
      std::vector<std::vector<double>> by_off{};
    };
    std::array both{
        Values{true, intervals.all, taken_off(metric, comparison, noise, errors, true)},
        Values{false, intervals.fixed, taken_off(metric, comparison, noise, errors, false)}};
    for (auto& values : both) values.by_off.resize(values.off.size());
    Draw draw;
    for (int k = 0; k < draws; ++k) {
      const Deviates deviates(memory, draw);
      for (auto& values : both) {
        const auto drawn = perturbed(comparison, deviates, values.of_average);
        for (std::size_t i = 0; i < values.off.size(); ++i)
          values.by_off[i].push_back(statistic(metric, comparison, drawn, values.off[i]));
      }
    }
    for (auto& values : both)
      for (auto& of_one : values.by_off)
        widen(values.interval, value, percentiles(of_one), reflects);
  }
  return intervals;
}

Interval within_bounds(const Metric& metric, Interval interval) {
  const bool is_correlation = metric.name == "rank correlation";
  return {std::max(is_correlation ? -1. : 0., interval.lo),
          is_correlation ? std::min(1., interval.hi) : interval.hi};
}

/// The mean square that the errors add to a metric as it is seen.
double noise_of(const Metric& metric, const Comparison& comparison) {
  if (metric.name == "relative rmse")
    return mean_square(comparison, [](const ComparedPoint& p) { return p.u_result; });
  return metric.of_logarithms ? relative_noise(comparison, true, true) : 0;
}

/// Of a metric of logarithms: the points that have one.
Comparison judged_by(const Metric& metric, Comparison comparison) {
  if (metric.of_logarithms)
    std::erase_if(comparison.points,
                  [](const ComparedPoint& point) { return !point.has_logarithm(); });
  return comparison;
}

Perturbed as_seen(const Comparison& comparison) {
  Perturbed curves;
  for (const auto& point : comparison.points) {
    curves.result.push_back(point.result);
    curves.reference.push_back(point.reference);
  }
  return curves;
}

/// Those of its points that take part in draws; all, where the interval is not drawn.
Comparison drawn_of(const Metric& metric, const Comparison& comparison) {
  const bool is_drawn = metric.name != "e over u" && !metric.name.ends_with("max error");
  if (!is_drawn || comparison.points.size() <= most_drawn) return comparison;
  Comparison some{.x = comparison.x, .y = comparison.y};
  for (const std::size_t i : drawn_points(comparison.points.size()))
    some.points.push_back(comparison.points[i]);
  return some;
}

}  // namespace

std::span<const Metric> metrics() {
  static constexpr std::array<Metric, 8> all{{
      {"relative rmse", "root mean square error over the reference's mean"},
      {"relative bias", "mean error over the reference's mean"},
      {"relative max error", "largest error over the reference's mean"},
      {"max error", "largest error", true, false},
      {"e over u", "error over its validation uncertainty (ASME V&V 20)", true, false},
      {"model bias", "mean factor between result and reference, less 1", true, false, 1, true},
      {"model scatter", "scatter of that factor beyond what the uncertainties explain", true, false,
       3, true, true},
      {"rank correlation", "Spearman's rank correlation", false, false, 4, false, true},
  }};
  return all;
}

const Metric& find_metric(const std::string& name) {
  std::set<std::string> names;
  for (const auto& metric : metrics()) {
    if (metric.name == name) return metric;
    names.emplace(metric.name);
  }
  names.emplace("area");
  throw InputError("no metric \"{}\"; the nearest known one is \"{}\"", name,
                   readers::nearest_name(name, names));
}

MetricValue evaluate(const Metric& metric, const Comparison& of_all) {
  const auto comparison = judged_by(metric, of_all);
  const auto seen = as_seen(comparison);
  if (metric.per_mean && mean(seen.reference) == 0)
    throw InputError("{}: the mean of the reference is 0: expected a metric in the quantity's unit",
                     metric.name);
  if (comparison.points.size() < metric.least_points)
    throw InputError("{}: expected {} points at which result and reference are above 0",
                     metric.name, metric.least_points);
  if (metric.name == "rank correlation" &&
      std::ranges::adjacent_find(seen.reference, std::not_equal_to<>()) == seen.reference.end())
    throw InputError("{}: the reference is constant: expected one that rises or falls",
                     metric.name);
  if (metric.name == "e over u")
    for (const auto& point : comparison.points)
      if (!(point.u_validation() > 0))
        throw InputError(
            "e over u: no uncertainty at {} = {:.4g}: expected one of result or "
            "reference",
            comparison.x.name, point.x);
  MetricValue found;
  found.value = statistic(metric, comparison, seen, noise_of(metric, comparison));
  const auto some = drawn_of(metric, comparison);
  const double noise = noise_of(metric, some);
  const double of_some = statistic(metric, some, as_seen(some), noise);
  const auto intervals = intervals_of(metric, some, of_some, noise);
  const auto ends = [&](Interval drawn) {
    return within_bounds(metric, about_all(drawn, of_some, found.value));
  };
  const auto all = ends(intervals.all), fixed = ends(intervals.fixed);
  found.lo = all.lo;
  found.hi = all.hi;
  found.fixed_half_width = std::max(fixed.hi - found.value, found.value - fixed.lo);
  found.points = comparison.points.size();
  found.points_drawn = some.points.size();
  if (metric.name == "max error") found.unit = comparison.y.unit;
  return found;
}

MetricValue with_interval(const Sampled& curve, const StatisticOfCurve& statistic_of,
                          bool is_distance) {
  Sampled some;
  for (const std::size_t i : drawn_points(curve.at.size())) {
    some.at.push_back(curve.at[i]);
    some.value.push_back(curve.value[i]);
    some.u.push_back(curve.u[i]);
  }
  const double seen = statistic_of(curve.at, curve.value);
  const double seen_of_some = statistic_of(some.at, some.value);
  MetricValue found{.value = seen};
  found.points = curve.at.size();
  found.points_drawn = some.at.size();
  double of_some = seen_of_some;
  Interval interval{of_some, of_some};
  for (const auto errors : all_errors) {
    const auto memory = memory_of(some.at, errors);
    Draw draw;
    std::vector<double> values;
    values.reserve(draws);
    for (int k = 0; k < draws; ++k)
      values.push_back(
          statistic_of(some.at, perturbed(some.value, some.u, draw_errors(memory, draw))));
    if (is_distance) {
      double added = -seen_of_some * seen_of_some;
      for (const double value : values) added += value * value / draws;
      for (double& value : values) value = std::sqrt(std::max(0., value * value - 2 * added));
      if (errors == Errors::independent) {
        const auto without_noise = [&](double value) {
          return std::sqrt(std::max(0., value * value - std::max(0., added)));
        };
        found.value = without_noise(seen);
        interval.lo = of_some = without_noise(seen_of_some);
      }
    }
    widen(interval, of_some, percentiles(values), !is_distance);
  }
  interval = about_all(interval, of_some, found.value);
  found.lo = is_distance ? std::max(0., interval.lo) : interval.lo;
  found.hi = interval.hi;
  return found;
}

}  // namespace bedscope::validation
