// SPDX-License-Identifier: BSD-3-Clause
#include "validation/compare.hpp"

#include <algorithm>
#include <cmath>

#include "readers/error.hpp"

namespace bedscope::validation {
namespace {

/// The finite values of a result, and where others lay between them: from the last value before to
/// the first behind.
struct Seen {
  Sampled curve;
  std::vector<std::pair<double, double>> gaps;  ///< ascending

  explicit Seen(const Sampled& all) : curve(all) {
    curve.at.clear();
    curve.value.clear();
    curve.u.clear();
    bool in_gap = false;
    for (std::size_t i = 0; i < all.at.size(); ++i) {
      const bool is_seen = std::isfinite(all.value[i]);
      if (is_seen) {
        if (in_gap && !curve.at.empty()) gaps.emplace_back(curve.at.back(), all.at[i]);
        curve.at.push_back(all.at[i]);
        curve.value.push_back(all.value[i]);
        curve.u.push_back(all.u[i]);
      }
      in_gap = !is_seen;
    }
  }

  bool reaches(double x) const {
    return curve.is_scalar || (x >= curve.at.front() && x <= curve.at.back());
  }
  /// But for rounding: at its ends there are values.
  bool has_gap_at(double x) const {
    const auto ends = [](const auto& gap) { return 1e-9 * (gap.second - gap.first); };
    const auto gap = std::partition_point(gaps.begin(), gaps.end(),
                                          [&](const auto& g) { return g.second - ends(g) <= x; });
    return gap != gaps.end() && x > gap->first + ends(*gap);
  }
};

/// The Lagrange polynomial through the points first ... first + count - 1 at x.
double polynomial(const Sampled& curve, std::size_t first, std::size_t count, double x) {
  double sum = 0;
  for (std::size_t i = first; i < first + count; ++i) {
    double term = curve.value[i];
    for (std::size_t j = first; j < first + count; ++j)
      if (j != i) term *= (x - curve.at[j]) / (curve.at[i] - curve.at[j]);
    sum += term;
  }
  return sum;
}

/// At a share of the way from a to b; at an end the other one does not count, nan as it may be.
double between(double a, double b, double share) {
  if (share <= 0) return a;
  return share < 1 ? (1 - share) * a + share * b : b;
}

/// Linear between the points of a curve, from its first to its last.
double linear(const Sampled& curve, double x) {
  const auto above = std::upper_bound(curve.at.begin() + 1, curve.at.end() - 1, x);
  const auto k = static_cast<std::size_t>(above - curve.at.begin());
  const double share = (x - curve.at[k - 1]) / (curve.at[k] - curve.at[k - 1]);
  return between(curve.value[k - 1], curve.value[k], share);
}

/// The slope of the result that an error of the reference's abscissa meets: over its reach, or
/// between the neighbours k - 1 and k where these are wider apart. Of neighbours that are closer
/// the difference is the result's noise, which is no slope.
double slope_at(const Sampled& result, std::size_t k, const CurvePoint& reference) {
  const double from = std::clamp(reference.x - reference.u_x, result.at.front(), result.at[k - 1]);
  const double to = std::clamp(reference.x + reference.u_x, result.at[k], result.at.back());
  return (linear(result, to) - linear(result, from)) / (to - from);
}

/// The reference's errors at its point, where the result has this slope.
void set_reference_errors(const CurvePoint& reference, double slope, ComparedPoint& point) {
  const bool above = point.result >= reference.y;
  point.u_reference = std::hypot(above ? reference.up() : reference.down(), slope * reference.u_x);
  point.u_reference_away =
      std::hypot(above ? reference.down() : reference.up(), slope * reference.u_x);
}

ComparedPoint at_reference(const Sampled& result, const CurvePoint& reference) {
  ComparedPoint point{.x = reference.x, .reference = reference.y};
  if (result.at.size() == 1) {
    point.result = result.value[0];
    point.u_result = result.u[0];
    set_reference_errors(reference, 0, point);
    return point;
  }
  const auto above = std::upper_bound(result.at.begin() + 1, result.at.end() - 1, reference.x);
  const auto k = static_cast<std::size_t>(above - result.at.begin());
  const double width = result.at[k] - result.at[k - 1];
  const double share = (reference.x - result.at[k - 1]) / width;
  point.result = between(result.value[k - 1], result.value[k], share);
  // Neighbours in a profile err together, so that their errors do not average out.
  point.u_result = between(result.u[k - 1], result.u[k], share);
  const std::size_t count = std::min<std::size_t>(4, result.at.size());
  const std::size_t first = std::min(k < 2 ? 0 : k - 2, result.at.size() - count);
  point.u_interpolation = std::abs(polynomial(result, first, count, reference.x) - point.result);
  set_reference_errors(reference, slope_at(result, k, reference), point);
  return point;
}

void match(const Seen& seen, const std::vector<CurvePoint>& reference, Comparison& found) {
  for (const auto& point : reference) {
    if (!seen.reaches(point.x) || seen.has_gap_at(point.x)) {
      found.in_gaps += seen.reaches(point.x) ? 1 : 0;
      found.outside.push_back(point);
      continue;
    }
    const auto compared = at_reference(seen.curve, point);
    if (std::isfinite(compared.u_result))
      found.points.push_back(compared);
    else
      found.without_error.push_back(point);
  }
}

double sum_of_squares(const Comparison& comparison) {
  double sum = 0;
  for (const auto& point : comparison.points) sum += point.error() * point.error();
  return sum / static_cast<double>(std::max<std::size_t>(comparison.points.size(), 1));
}

/// The errors of averages over the same snapshots are the same, and drop out of their difference.
void drop_common_errors(std::vector<ComparedPoint>& points) {
  for (auto& point : points) point.u_result = point.u_reference = point.u_reference_away = 0;
}

}  // namespace

double ComparedPoint::u_reference_mean() const {
  return std::sqrt((u_reference * u_reference + away() * away()) / 2);
}

double ComparedPoint::u_validation() const {
  return std::sqrt(u_result * u_result + u_interpolation * u_interpolation +
                   u_reference * u_reference);
}

std::vector<CurvePoint> turned_round(const Sampled& result, std::vector<CurvePoint> points) {
  for (auto& point : points) point.x = result.at.front() + result.at.back() - point.x;
  std::reverse(points.begin(), points.end());
  return points;
}

bool ComparedPoint::has_logarithm() const {
  constexpr double coverage_factor = 1.96;
  return result > coverage_factor * std::hypot(u_result, u_interpolation) &&
         reference > coverage_factor * std::max(u_reference, away());
}

Comparison compare(const Sampled& all, const Curve& reference, std::size_t least) {
  if (all.y.unit != reference.y.unit || (!all.is_scalar && all.x.unit != reference.x.unit))
    throw InputError("{}: {} against {}: expected the units of the result, {} against {}",
                     reference.name, reference.y.text(), reference.x.text(), all.y.text(),
                     all.x.text());
  const Seen seen(all);
  const auto& result = seen.curve;
  Comparison found{
      .x = all.x, .y = all.y, .error_known = all.error_known, .duration = all.duration};
  if (!result.at.empty()) match(seen, reference.points, found);
  if (!reference.about.orientation_known && result.at.size() > 1) {
    Comparison other = found;
    other.points.clear();
    other.outside.clear();
    other.in_gaps = 0;
    other.without_error.clear();
    match(seen, turned_round(result, reference.points), other);
    if (other.points.size() >= found.points.size() &&
        sum_of_squares(other) < sum_of_squares(found)) {
      found = std::move(other);
      found.mirrored = true;
    }
  }
  if (found.points.size() < std::max<std::size_t>(least, 1)) {
    if (result.at.empty()) throw InputError("{}: the run has no {}", reference.name, all.y.text());
    if (!found.without_error.empty())
      throw InputError("{}: the run's {} has an interval at none of the points to compare",
                       reference.name, all.y.text());
    if (!found.points.empty())
      throw InputError("{}: expected {} points to compare at least, found {}", reference.name,
                       least, found.points.size());
    throw InputError(
        "{}: outside the result: {} from {:.4g} to {:.4g}, the run's from {:.4g} to {:.4g}",
        reference.name, reference.x.text(), reference.points.front().x, reference.points.back().x,
        result.at.front(), result.at.back());
  }
  if (reference.of_same_snapshots) drop_common_errors(found.points);
  return found;
}

}  // namespace bedscope::validation
