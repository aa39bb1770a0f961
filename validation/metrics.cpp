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

/// How the errors of neighbouring points may go together: not at all; over a part of the curve, as
/// where neighbours see the same clusters or a shift moves both flanks of a peak; all alike. In a
/// difference between walls and core the first and the last cancel, and the second does not.
enum class Errors { independent, neighbours, common };
constexpr std::array all_errors{Errors::independent, Errors::neighbours, Errors::common};

/// Share of the curve over which the errors of neighbours fall to 1/e: that at which the difference
/// of an outer fifth and the middle two fifths errs most (0.96 u; 0.76 u at 0.05, 0.66 u at 1).
constexpr double memory_length = 0.2;

/// How much of its left neighbour's error each point has, for abscissae that ascend.
std::vector<double> memory_of(std::span<const double> x, Errors errors) {
  std::vector<double> memory(x.size(), errors == Errors::common ? 1 : 0);
  if (errors != Errors::neighbours) return memory;
  for (std::size_t i = 1; i < x.size(); ++i) {
    const double gap = x[i] - x[i - 1];  // 0 where a place was measured twice
    memory[i] = gap > 0 ? std::exp(-gap / (memory_length * (x.back() - x.front()))) : 1;
  }
  return memory;
}

/// Abscissae of the compared points.
std::vector<double> abscissae(const Comparison& comparison) {
  std::vector<double> x;
  for (const auto& point : comparison.points) x.push_back(point.x);
  return x;
}

struct Perturbed {
  std::vector<double> result, reference;
};

class Draw {
 public:
  double normal() { return distribution_(engine_); }
  /// Standard normal, with this much of the one before.
  double after(double before, double memory) {
    if (memory == 1) return before;
    return memory * before + std::sqrt(1 - memory * memory) * normal();
  }

 private:
  std::mt19937_64 engine_{seed};
  std::normal_distribution<double> distribution_;
};

Perturbed perturb(const Comparison& comparison, std::span<const double> memory, bool of_average,
                  Draw& draw) {
  Perturbed drawn;
  double result = draw.normal(), reference = draw.normal();
  for (std::size_t i = 0; i < comparison.points.size(); ++i) {
    const auto& point = comparison.points[i];
    result = draw.after(result, memory[i]);
    reference = draw.after(reference, memory[i]);
    const double between = draw.normal();
    drawn.result.push_back(point.result + (of_average ? result * point.u_result : 0) +
                           between * point.u_interpolation);
    const bool towards = (reference > 0) == (point.error() >= 0);
    drawn.reference.push_back(point.reference +
                              reference * (towards ? point.u_reference : point.away()));
  }
  return drawn;
}

/// Drawn errors of standard uncertainties u, added to the values of one curve.
void add_errors(std::vector<double>& values, std::span<const double> u,
                std::span<const double> memory, Draw& draw) {
  double error = draw.normal();
  for (std::size_t i = 0; i < values.size(); ++i) {
    error = draw.after(error, memory[i]);
    values[i] += error * u[i];
  }
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

/// Mean square, over the points that have a logarithm, of the reference's relative uncertainty and
/// of the result's, from its time average and from its interpolation.
double relative_noise(const Comparison& comparison, bool of_average, bool of_interpolation) {
  double sum = 0, count = 0;
  for (const auto& point : comparison.points) {
    if (!(point.result > 0 && point.reference > 0)) continue;
    const double u =
        std::hypot(of_average ? point.u_result : 0, of_interpolation ? point.u_interpolation : 0);
    sum += std::pow(u / point.result, 2) + std::pow(point.u_reference_mean() / point.reference, 2);
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
        std::exp(logarithms.mean + (scatter2 - relative_noise(comparison, false, false)) / 2) - 1);
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

/// `of_average`: with the errors of the time average, or with those alone that no longer simulation
/// would narrow.
Interval interval_of(const Metric& metric, const Comparison& comparison, double value, double noise,
                     bool of_average) {
  if (metric.name == "e over u") return {value, value};  // has the uncertainties in it already
  if (metric.name.ends_with("max error"))
    return interval_of_largest(comparison, metric.per_mean, of_average);
  const bool reflects = metric.name != "relative rmse" && metric.name != "model scatter";
  Interval interval{value, value};
  const auto x = abscissae(comparison);
  for (const auto errors : all_errors) {
    // Of a mean and a mean square the common errors are the largest.
    if (errors == Errors::neighbours && !metric.of_differences) continue;
    const auto memory = memory_of(x, errors);
    const auto off = taken_off(metric, comparison, noise, errors, of_average);
    std::vector<std::vector<double>> values(off.size());
    Draw draw;
    for (int k = 0; k < draws; ++k) {
      const auto drawn = perturb(comparison, memory, of_average, draw);
      for (std::size_t i = 0; i < off.size(); ++i)
        values[i].push_back(statistic(metric, comparison, drawn, off[i]));
    }
    for (auto& of_one : values) widen(interval, value, percentiles(of_one), reflects);
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
  found.fixed_half_width = std::max(fixed.hi - found.value, found.value - fixed.lo);
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

namespace {

/// The errors of a distribution that moves as a whole: alike on each side of its peak, opposite
/// across it.
std::vector<double> memory_of_a_shift(std::span<const double> density) {
  std::vector<double> memory(density.size(), 1);
  memory[static_cast<std::size_t>(std::max_element(density.begin(), density.end()) -
                                  density.begin())] = -1;
  return memory;
}

/// Standard uncertainties of a curve's ordinates, those of its abscissae through its own slope
/// among them.
std::vector<double> ordinate_errors(const Curve& curve) {
  std::vector<double> u;
  const auto& points = curve.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto &before = points[i == 0 ? 0 : i - 1],
               &after = points[std::min(i + 1, points.size() - 1)];
    u.push_back(
        std::hypot(points[i].u_y, (after.y - before.y) / (after.x - before.x) * points[i].u_x));
  }
  return u;
}

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
  if (result.x.unit != reference.x.unit)
    throw InputError("{}: a density along {}: expected it along {}", reference.name,
                     reference.x.text(), result.x.text());
  for (std::size_t i = 0; i < result.at.size(); ++i)  // no bin can be left out of an area
    if (!std::isfinite(result.value[i]) || !std::isfinite(result.u[i]))
      throw InputError("area: {} = {:.4g}: expected {} and, where others have one, its interval",
                       result.x.name, result.at[i], result.y.name);
  std::vector<double> x, density;
  for (const auto& point : reference.points) {
    x.push_back(point.x);
    density.push_back(point.y);
  }
  MetricValue found{.unit = result.x.unit};
  found.value = wasserstein(result.at, result.value, x, density);
  const auto u_reference = ordinate_errors(reference);
  // Errors common to all bins are no error of a density, which is normalised.
  const std::array memories{
      std::pair(memory_of(result.at, Errors::independent), memory_of(x, Errors::independent)),
      std::pair(memory_of(result.at, Errors::neighbours), memory_of(x, Errors::neighbours)),
      std::pair(memory_of_a_shift(result.value), memory_of_a_shift(density))};
  // Errors so wide that they leave no density say nothing of where it lies.
  const double farthest =
      std::max(result.at.back(), x.back()) - std::min(result.at.front(), x.front());
  const auto is_density = [](const std::vector<double>& values) {
    return std::any_of(values.begin(), values.end(), [](double v) { return v > 0; });
  };
  const auto interval = [&](bool of_average) {
    Interval ends{found.value, found.value};
    for (const auto& [in_result, in_reference] : memories) {
      Draw draw;
      std::vector<double> values;
      for (int k = 0; k < draws; ++k) {
        auto drawn = result.value;
        auto drawn_reference = density;
        if (of_average) add_errors(drawn, result.u, in_result, draw);
        add_errors(drawn_reference, u_reference, in_reference, draw);
        values.push_back(is_density(drawn) && is_density(drawn_reference)
                             ? wasserstein(result.at, drawn, x, drawn_reference)
                             : farthest);
      }
      widen(ends, found.value, percentiles(values), true);
    }
    return ends;
  };
  const auto all = interval(true), fixed = interval(false);
  found.lo = std::max(0., all.lo);
  found.hi = all.hi;
  found.fixed_half_width = std::max(fixed.hi - found.value, found.value - fixed.lo);
  return found;
}

MetricValue with_interval(const Sampled& curve,
                          const std::function<double(std::span<const double>)>& statistic_of,
                          bool is_distance) {
  const double seen = statistic_of(curve.value);
  MetricValue found{.value = seen};
  Interval interval{seen, seen};
  for (const auto errors : all_errors) {
    const auto memory = memory_of(curve.at, errors);
    Draw draw;
    std::vector<double> values;
    for (int k = 0; k < draws; ++k) {
      auto drawn = curve.value;
      add_errors(drawn, curve.u, memory, draw);
      values.push_back(statistic_of(drawn));
    }
    if (is_distance) {
      double added = -seen * seen;
      for (const double value : values) added += value * value / draws;
      for (double& value : values) value = std::sqrt(std::max(0., value * value - 2 * added));
      if (errors == Errors::independent)
        interval.lo = found.value = std::sqrt(std::max(0., seen * seen - std::max(0., added)));
    }
    widen(interval, found.value, percentiles(values), !is_distance);
  }
  found.lo = interval.lo;
  found.hi = interval.hi;
  return found;
}

}  // namespace bedscope::validation
