// SPDX-License-Identifier: BSD-3-Clause
#include "validation/metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <set>

#include "readers/error.hpp"
#include "readers/toml_table.hpp"

namespace bedscope::validation {
namespace {

constexpr int draws = 2000;
constexpr std::uint64_t seed = 20260101;  // any; a report must not change from run to run

/// What is drawn: deviations of results and references at the points, u_* times these.
enum class Errors { none, independent, common };

struct Perturbed {
  std::vector<double> result, reference;
};

class Draw {
 public:
  double normal() { return distribution_(engine_); }

 private:
  std::mt19937_64 engine_{seed};
  std::normal_distribution<double> distribution_;
};

Perturbed perturb(const Comparison& comparison, Errors errors, bool of_result, Draw& draw) {
  Perturbed drawn;
  const double common_result = draw.normal(), common_reference = draw.normal();
  for (const auto& point : comparison.points) {
    const bool together = errors == Errors::common;
    const double result = together ? common_result : draw.normal();
    const double reference = together ? common_reference : draw.normal();
    const double between = draw.normal();
    drawn.result.push_back(
        point.result + (of_result ? result * point.u_result + between * point.u_interpolation : 0));
    const bool towards = (reference > 0) == (point.error() >= 0);
    drawn.reference.push_back(point.reference +
                              reference * (towards ? point.u_reference : point.away()));
  }
  return drawn;
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

/// Mean over the points that have a logarithm of the squares of f, over the value that it is of.
double relative_noise(const Comparison& comparison, bool of_result, bool of_reference) {
  double sum = 0, count = 0;
  for (const auto& point : comparison.points) {
    if (!(point.result > 0 && point.reference > 0)) continue;
    if (of_result)
      sum += std::pow(std::hypot(point.u_result, point.u_interpolation) / point.result, 2);
    if (of_reference) sum += std::pow(point.u_reference_mean() / point.reference, 2);
    count += 1;
  }
  return sum / std::max(1., count);
}

std::vector<double> ranks(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> rank(values.size());
  for (std::size_t i = 0; i < order.size();) {  // ties share their mean rank
    std::size_t end = i + 1;
    while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
    for (std::size_t k = i; k < end; ++k)
      rank[order[k]] = (static_cast<double>(i) + static_cast<double>(end - 1)) / 2;
    i = end;
  }
  return rank;
}

/// Of ln(result / reference), where both are above 0.
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
  double squares = 0, sum = 0, largest = 0;
  for (std::size_t i = 0; i < drawn.result.size(); ++i) {
    const double scale = metric.name == "e over u" ? comparison.points[i].u_validation() : 1;
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
        std::exp(logarithms.mean + (scatter2 - relative_noise(comparison, false, true)) / 2) - 1);
  }
  return rank_correlation(drawn.result, drawn.reference);
}

struct Interval {
  double lo = 0, hi = 0;
};

/// Ends between which the middle 95 % of the draws lie.
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
Interval interval_of_largest(const Comparison& comparison, bool per_mean, bool of_result) {
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
      return std::hypot(of_result ? std::hypot(point.u_result, point.u_interpolation) : 0,
                        of_reference + of_mean);
    };
    interval.lo = std::max(interval.lo, (e - inner * u(point.u_reference)) / scale);
    interval.hi = std::max(interval.hi, (e + outer * u(point.away())) / scale);
  }
  return interval;
}

/// What is taken off the mean square of the drawn errors, by each of the ways that may be right.
std::vector<double> taken_off(const Metric& metric, const Comparison& comparison, double noise,
                              Errors errors, bool of_result) {
  if (metric.name == "relative rmse") {
    const double drawn = mean_square(comparison, [&](const ComparedPoint& p) {
      return of_result ? std::hypot(p.u_result, p.u_interpolation, p.u_reference_mean())
                       : p.u_reference_mean();
    });
    const double of_reference = mean_square(comparison, [](const ComparedPoint& p) {
      return std::hypot(p.u_reference_mean(), p.u_interpolation);
    });
    // The rmse as defined has the scatter of the reference in it; the truth has not.
    return {noise + drawn, noise + drawn + of_reference};
  }
  if (!metric.of_logarithms) return {0};
  if (errors == Errors::independent) return {noise + relative_noise(comparison, of_result, true)};
  return {0, noise};  // errors common to all points are no scatter
}

Interval interval_of(const Metric& metric, const Comparison& comparison, double value, double noise,
                     bool of_result) {
  if (metric.name == "e over u") return {value, value};  // has the uncertainties in it already
  if (metric.name.ends_with("max error"))
    return interval_of_largest(comparison, metric.per_mean, of_result);
  const bool reflects = metric.name != "relative rmse" && metric.name != "model scatter";
  Interval interval{value, value};
  for (const auto errors : {Errors::independent, Errors::common})
    for (const double off : taken_off(metric, comparison, noise, errors, of_result)) {
      Draw draw;
      std::vector<double> values;
      for (int k = 0; k < draws; ++k)
        values.push_back(
            statistic(metric, comparison, perturb(comparison, errors, of_result, draw), off));
      widen(interval, value, percentiles(values), reflects);
    }
  const bool is_correlation = metric.name == "rank correlation";
  interval.lo = std::max(is_correlation ? -1. : 0., interval.lo);
  if (is_correlation) interval.hi = std::min(1., interval.hi);
  return interval;
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
       3, true},
      {"rank correlation", "Spearman's rank correlation", false, false, 4},
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

MetricValue evaluate(const Metric& metric, const Comparison& comparison) {
  Perturbed as_is;
  for (const auto& point : comparison.points) {
    as_is.result.push_back(point.result);
    as_is.reference.push_back(point.reference);
  }
  if (metric.per_mean && mean(as_is.reference) == 0)
    throw InputError("{}: the mean of the reference is 0: expected a metric in the quantity's unit",
                     metric.name);
  double noise = 0;
  if (metric.name == "relative rmse")
    noise = mean_square(comparison, [](const ComparedPoint& p) { return p.u_result; });
  if (metric.of_logarithms) {
    noise = relative_noise(comparison, true, true);
    if (Logarithms(as_is.result, as_is.reference).count < static_cast<double>(metric.least_points))
      throw InputError("{}: expected {} points at which result and reference are above 0",
                       metric.name, metric.least_points);
  }
  if (metric.name == "e over u")
    for (const auto& point : comparison.points)
      if (!(point.u_validation() > 0))
        throw InputError(
            "e over u: no uncertainty at {} = {:.4g}: expected one of result or "
            "reference",
            comparison.x.name, point.x);
  MetricValue found;
  found.value = statistic(metric, comparison, as_is, noise);
  const auto all = interval_of(metric, comparison, found.value, noise, true);
  const auto fixed = interval_of(metric, comparison, found.value, noise, false);
  found.lo = all.lo;
  found.hi = all.hi;
  found.reference_half_width = std::max(fixed.hi - found.value, found.value - fixed.lo);
  if (metric.name == "max error") found.unit = comparison.y.unit;
  return found;
}

namespace {

/// A density's cumulative curve: faces halfway between the abscissae, values there, 0 to 1.
struct Cumulative {
  std::vector<double> face, value;

  Cumulative(std::span<const double> x, std::span<const double> density) {
    for (std::size_t i = 1; i < x.size(); ++i)
      if (!(x[i] > x[i - 1]))
        throw InputError("area: expected ascending abscissae, found {} after {}", x[i], x[i - 1]);
    if (x.size() < 2) throw InputError("area: expected a density at two abscissae at least");
    face.push_back(x[0] - (x[1] - x[0]) / 2);
    for (std::size_t i = 1; i < x.size(); ++i) face.push_back((x[i - 1] + x[i]) / 2);
    face.push_back(x.back() + (x.back() - x[x.size() - 2]) / 2);
    value.push_back(0);
    for (std::size_t i = 0; i < x.size(); ++i)
      value.push_back(value.back() + std::max(0., density[i]) * (face[i + 1] - face[i]));
    if (!(value.back() > 0)) throw InputError("area: a density without positive area");
    for (auto& v : value) v /= value.back();
  }

  double at(double x) const {
    if (x <= face.front()) return 0;
    if (x >= face.back()) return 1;
    const auto k =
        static_cast<std::size_t>(std::upper_bound(face.begin(), face.end(), x) - face.begin());
    return value[k - 1] + (value[k] - value[k - 1]) * (x - face[k - 1]) / (face[k] - face[k - 1]);
  }
};

}  // namespace

double wasserstein(std::span<const double> x1, std::span<const double> density1,
                   std::span<const double> x2, std::span<const double> density2) {
  const Cumulative one(x1, density1), two(x2, density2);
  std::vector<double> faces = one.face;
  faces.insert(faces.end(), two.face.begin(), two.face.end());
  std::sort(faces.begin(), faces.end());
  double area = 0;
  for (std::size_t i = 1; i < faces.size(); ++i) {  // both are linear between neighbours
    const double a = one.at(faces[i - 1]) - two.at(faces[i - 1]);
    const double b = one.at(faces[i]) - two.at(faces[i]);
    const double width = faces[i] - faces[i - 1];
    if (a * b >= 0)
      area += width * std::abs(a + b) / 2;
    else
      area += width * (a * a + b * b) / (2 * (std::abs(a) + std::abs(b)));
  }
  return area;
}

MetricValue evaluate_area(const Sampled& result, const Curve& reference) {
  std::vector<double> x, density;
  for (const auto& point : reference.points) {
    x.push_back(point.x);
    density.push_back(point.y);
  }
  MetricValue found{.unit = result.x.unit};
  found.value = wasserstein(result.at, result.value, x, density);
  const auto interval = [&](bool of_result) {
    Draw draw;
    std::vector<double> values;
    for (int k = 0; k < draws; ++k) {
      auto drawn = result.value;
      auto drawn_reference = density;
      for (std::size_t i = 0; i < drawn.size(); ++i)
        drawn[i] += of_result ? draw.normal() * result.u[i] : 0;
      for (std::size_t i = 0; i < drawn_reference.size(); ++i)
        drawn_reference[i] += draw.normal() * reference.points[i].u_y;
      values.push_back(wasserstein(result.at, drawn, x, drawn_reference));
    }
    Interval ends{found.value, found.value};
    widen(ends, found.value, percentiles(values), true);
    return ends;
  };
  const auto all = interval(true), fixed = interval(false);
  found.lo = std::max(0., all.lo);
  found.hi = all.hi;
  found.reference_half_width = std::max(fixed.hi - found.value, found.value - fixed.lo);
  return found;
}

MetricValue with_interval(const Sampled& curve,
                          const std::function<double(std::span<const double>)>& statistic_of) {
  MetricValue found;
  found.value = statistic_of(curve.value);
  Interval interval{found.value, found.value};
  for (const bool common : {false, true}) {
    Draw draw;
    std::vector<double> values;
    for (int k = 0; k < draws; ++k) {
      auto drawn = curve.value;
      const double shared = draw.normal();
      for (std::size_t i = 0; i < drawn.size(); ++i)
        drawn[i] += (common ? shared : draw.normal()) * curve.u[i];
      values.push_back(statistic_of(drawn));
    }
    widen(interval, found.value, percentiles(values), true);
  }
  found.lo = interval.lo;
  found.hi = interval.hi;
  return found;
}

}  // namespace bedscope::validation
