// SPDX-License-Identifier: BSD-3-Clause
// How far a result is from its reference, as one number with its 95 % interval.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "validation/compare.hpp"

namespace bedscope::validation {

/// A number and its 95 % interval from all uncertainties; and the half-width of what no longer
/// simulation would narrow, from the uncertainties of reference and interpolation.
struct MetricValue {
  double value = 0, lo = 0, hi = 0;
  double fixed_half_width = 0;
  std::string unit = "-";
  std::size_t points = 0, points_drawn = 0;  ///< compared, and those of them that were drawn
};

/// The metrics of profiles and single values. All take E = result - reference at the points of a
/// comparison; n points; m the mean of the reference over them.
struct Metric {
  std::string_view name;
  std::string_view meaning;
  bool small_is_good = true;  ///< false: the limit is a lower one (correlation)
  bool per_mean = true;       ///< in units of m; needs m != 0
  std::size_t least_points = 1;
  bool of_logarithms = false;   ///< only of points that have one
  bool of_differences = false;  ///< between points of a curve: errors common to all cancel
};

/// In the order of the manual:
///   relative rmse       sqrt(max(0, sum E^2 / n - sum u_result^2 / n)) / |m|: the scatter that the
///                       noise of the time average adds by itself is taken off
///   relative bias       |sum E / n| / |m|
///   relative max error  max |E| / |m|
///   max error           max |E|, in the quantity's unit
///   e over u            sqrt(sum (E / u_val)^2 / n), ASME V&V 20 (2009) section 1-5
///   model bias          |exp(mean ln(R/E) + s^2 / 2 - <(u_E/E)^2> / 2) - 1|, R the result, E the
///   model scatter       reference; s = sqrt(max(0, var ln(R/E) - <(u_E/E)^2> - <(u_R/R)^2>)):
///                       McGrattan and Toman, Metrologia 48 (2011) 173, the time average's noise
///                       taken out, too
///   rank correlation    Spearman's, of result and reference over the points
std::span<const Metric> metrics();

/// The one of that name. Throws InputError naming the nearest.
const Metric& find_metric(const std::string& name);

/// Value and interval of a metric: 2,000 draws of all errors, once with errors that are independent
/// from point to point and once with errors common to all points (what is true lies between, and
/// nobody knows where), of differences between points once more with errors that neighbours share;
/// the wider ends taken. The draws' own scatter is subtracted from the rmse,
/// which would count it; elsewhere the interval is the union of the percentile and the reflected
/// one (Davison and Hinkley, Bootstrap Methods, 1997, section 5.2). Always the same draws.
/// Of more than 1,000 points the value is of all, and the draws are of 1,000 (draws.hpp: the rule
/// and its error).
/// Of the largest error the interval is made of the points' own. "e over u" is its own test: the
/// uncertainties are in it, and its interval is the value.
/// Throws InputError for a reference of zero mean, or "e over u" without any uncertainty.
MetricValue evaluate(const Metric& metric, const Comparison& comparison);

/// 1-Wasserstein distance of two distributions given by densities on abscissae of their own, in the
/// unit of the abscissa: the area between their cumulative curves ("area metric", Ferson,
/// Oberkampf and Ginzburg 2008). Densities are normalised, and constant within their bins.
/// Throws InputError for abscissae that do not ascend, or a density without positive area; that of
/// a run also for another unit of the abscissa, and bins without a value or an interval.
double wasserstein(std::span<const double> x1, std::span<const double> density1,
                   std::span<const double> x2, std::span<const double> density2);
MetricValue evaluate_area(const Sampled& result, const Curve& reference);

/// Of abscissae and values.
using StatisticOfCurve =
    std::function<double(std::span<const double> at, std::span<const double> value)>;

/// A statistic of a curve under its errors: as for the metrics. From a distance, which is never
/// below 0 and which noise raises, the mean square is taken off that the draws add to it: once for
/// what the curve's own noise added, once for that of the draws.
MetricValue with_interval(const Sampled& curve, const StatisticOfCurve& statistic,
                          bool is_distance = false);

}  // namespace bedscope::validation
