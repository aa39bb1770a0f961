// SPDX-License-Identifier: BSD-3-Clause
// The area metric of distributions.
#include <algorithm>
#include <cmath>

#include "readers/error.hpp"
#include "validation/draws.hpp"
#include "validation/metrics.hpp"

namespace bedscope::validation {
namespace {

/// Faces of a density's bins: halfway between the abscissae.
std::vector<double> faces_of(std::span<const double> x) {
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(x[i] > x[i - 1]))
      throw InputError("area: expected ascending abscissae, found {} after {}", x[i], x[i - 1]);
  if (x.size() < 2) throw InputError("area: expected a density at two abscissae at least");
  std::vector<double> face{x[0] - (x[1] - x[0]) / 2};
  for (std::size_t i = 1; i < x.size(); ++i) face.push_back((x[i - 1] + x[i]) / 2);
  face.push_back(x.back() + (x.back() - x[x.size() - 2]) / 2);
  return face;
}

/// A density's cumulative curve at its faces, 0 to 1.
std::vector<double> cumulated(std::span<const double> density, std::span<const double> face) {
  std::vector<double> value{0};
  for (std::size_t i = 0; i < density.size(); ++i)
    value.push_back(value.back() + std::max(0., density[i]) * (face[i + 1] - face[i]));
  if (!(value.back() > 0)) throw InputError("area: a density without positive area");
  for (auto& v : value) v /= value.back();
  return value;
}

/// Two sets of bins, for any densities in them.
class AreaBetween {
 public:
  AreaBetween(std::span<const double> x1, std::span<const double> x2)
      : one_{faces_of(x1), {}}, two_{faces_of(x2), {}} {
    faces_.resize(one_.face.size() + two_.face.size());
    std::merge(one_.face.begin(), one_.face.end(), two_.face.begin(), two_.face.end(),
               faces_.begin());
    for (auto* bins : {&one_, &two_})
      for (const double x : faces_)
        bins->above.push_back(static_cast<std::size_t>(
            std::upper_bound(bins->face.begin(), bins->face.end(), x) - bins->face.begin()));
  }

  double operator()(std::span<const double> density1, std::span<const double> density2) const {
    const auto one = cumulated(density1, one_.face), two = cumulated(density2, two_.face);
    const auto difference = [&](std::size_t i) { return at(one_, one, i) - at(two_, two, i); };
    double area = 0, a = difference(0);
    for (std::size_t i = 1; i < faces_.size(); ++i) {  // both are linear between neighbours
      const double b = difference(i);
      const double width = faces_[i] - faces_[i - 1];
      if (a * b >= 0)
        area += width * std::abs(a + b) / 2;
      else
        area += width * (a * a + b * b) / (2 * (std::abs(a) + std::abs(b)));
      a = b;
    }
    return area;
  }

 private:
  struct Bins {
    std::vector<double> face;
    std::vector<std::size_t> above;  ///< the first face above each of faces_
  };

  double at(const Bins& bins, std::span<const double> value, std::size_t i) const {
    const double x = faces_[i];
    const auto& face = bins.face;
    if (x <= face.front()) return 0;
    if (x >= face.back()) return 1;
    const auto k = bins.above[i];
    return value[k - 1] + (value[k] - value[k - 1]) * (x - face[k - 1]) / (face[k] - face[k - 1]);
  }

  Bins one_, two_;
  std::vector<double> faces_;  ///< of both, ascending
};

/// The errors of a distribution that moves as a whole: alike on each side of its peak, opposite
/// across it.
std::vector<double> memory_of_a_shift(std::span<const double> density) {
  std::vector<double> memory(density.size(), 1);
  memory[static_cast<std::size_t>(std::max_element(density.begin(), density.end()) -
                                  density.begin())] = -1;
  return memory;
}

/// Standard uncertainties of a curve's ordinates, those of its abscissae among them through its own
/// slope over their reach, or between its neighbours where these are further.
std::vector<double> ordinate_errors(const Curve& curve) {
  std::vector<double> u;
  const auto& points = curve.points;
  const auto first_from = [&](double x) {
    return static_cast<std::size_t>(
        std::partition_point(points.begin(), points.end(),
                             [&](const CurvePoint& point) { return point.x < x; }) -
        points.begin());
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t first = first_from(points[i].x - points[i].u_x);
    const std::size_t behind = first_from(points[i].x + points[i].u_x);
    const auto &before = points[std::min(first, i == 0 ? 0 : i - 1)],
               &after = points[std::min(std::max(behind, i + 2) - 1, points.size() - 1)];
    u.push_back(
        std::hypot(points[i].u_y, (after.y - before.y) / (after.x - before.x) * points[i].u_x));
  }
  return u;
}

/// A density in bins, with its standard uncertainties.
struct Density {
  std::vector<double> x, value, u;
};

/// At the points that take part in draws.
Density drawn_of(const Density& all) {
  Density some;
  for (const std::size_t i : drawn_points(all.x.size())) {
    some.x.push_back(all.x[i]);
    some.value.push_back(all.value[i]);
    some.u.push_back(all.u[i]);
  }
  return some;
}

bool is_density(std::span<const double> values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return v > 0; });
}

/// `of_average`: with the errors of the result, or with the reference's alone.
Interval interval_of(const Density& result, const Density& reference, double value,
                     bool of_average) {
  const AreaBetween area(result.x, reference.x);
  // Errors common to all bins are no error of a density, which is normalised.
  const std::array memories{
      std::pair(memory_of(result.x, Errors::independent),
                memory_of(reference.x, Errors::independent)),
      std::pair(memory_of(result.x, Errors::neighbours),
                memory_of(reference.x, Errors::neighbours)),
      std::pair(memory_of_a_shift(result.value), memory_of_a_shift(reference.value))};
  // Errors so wide that they leave no density say nothing of where it lies.
  const double farthest = std::max(result.x.back(), reference.x.back()) -
                          std::min(result.x.front(), reference.x.front());
  Interval ends{value, value};
  for (const auto& [in_result, in_reference] : memories) {
    Draw draw;
    std::vector<double> values;
    for (int k = 0; k < draws; ++k) {
      const auto drawn = of_average
                             ? perturbed(result.value, result.u, draw_errors(in_result, draw))
                             : result.value;
      const auto drawn_reference =
          perturbed(reference.value, reference.u, draw_errors(in_reference, draw));
      values.push_back(is_density(drawn) && is_density(drawn_reference)
                           ? area(drawn, drawn_reference)
                           : farthest);
    }
    widen(ends, value, percentiles(values), true);
  }
  return ends;
}

}  // namespace

double wasserstein(std::span<const double> x1, std::span<const double> density1,
                   std::span<const double> x2, std::span<const double> density2) {
  return AreaBetween(x1, x2)(density1, density2);
}

MetricValue evaluate_area(const Sampled& result, const Curve& reference) {
  if (result.x.unit != reference.x.unit)
    throw InputError("{}: a density along {}: expected it along {}", reference.name,
                     reference.x.text(), result.x.text());
  for (std::size_t i = 0; i < result.at.size(); ++i)  // no bin can be left out of an area
    if (!std::isfinite(result.value[i]) || !std::isfinite(result.u[i]))
      throw InputError("area: {} = {:.4g}: expected {} and, where others have one, its interval",
                       result.x.name, result.at[i], result.y.name);
  const Density of_result{result.at, result.value, result.u};
  Density of_reference{.u = ordinate_errors(reference)};
  for (const auto& point : reference.points) {
    of_reference.x.push_back(point.x);
    of_reference.value.push_back(point.y);
  }
  const auto distance = [](const Density& a, const Density& b) {
    return wasserstein(a.x, a.value, b.x, b.value);
  };
  MetricValue found{.unit = result.x.unit};
  found.value = distance(of_result, of_reference);
  const auto some = drawn_of(of_result), some_of_reference = drawn_of(of_reference);
  const double of_some = distance(some, some_of_reference);
  const auto ends = [&](bool of_average) {
    return about_all(interval_of(some, some_of_reference, of_some, of_average), of_some,
                     found.value);
  };
  const auto all = ends(true), fixed = ends(false);
  found.lo = std::max(0., all.lo);
  found.hi = all.hi;
  found.fixed_half_width = std::max(fixed.hi - found.value, found.value - fixed.lo);
  found.points = of_result.x.size() + of_reference.x.size();
  found.points_drawn = some.x.size() + some_of_reference.x.size();
  return found;
}

}  // namespace bedscope::validation
