// SPDX-License-Identifier: BSD-3-Clause
#include "validation/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "readers/error.hpp"

namespace bedscope::validation {
namespace {

constexpr double wall = 0.2;       // of the abscissa, at each side
constexpr double core_from = 0.3;  // to 1 - core_from
constexpr std::size_t least_points = 5;

/// A profile and where its points lie between its ends, 0 to 1.
struct Placed {
  std::span<const double> share, value;

  /// Mean of the values with a <= share <= b; the value in its middle where no point lies there.
  double mean(double a, double b) const {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < share.size(); ++i)
      if (share[i] >= a && share[i] <= b) {
        sum += value[i];
        count += 1;
      }
    return count > 0 ? sum / count : at((a + b) / 2);
  }
  /// Between the points by a straight line.
  double at(double where) const {
    const auto above = std::upper_bound(share.begin() + 1, share.end() - 1, where);
    const auto k = static_cast<std::size_t>(above - share.begin());
    const double part = (where - share[k - 1]) / (share[k] - share[k - 1]);
    return (1 - part) * value[k - 1] + part * value[k];
  }
  double left() const { return mean(0, wall); }
  double right() const { return mean(1 - wall, 1); }
  double core() const { return mean(core_from, 1 - core_from); }
  double magnitude() const {
    double sum = 0;
    for (const double v : value) sum += std::abs(v);
    return sum / static_cast<double>(value.size());
  }
};

/// The falling profile nearest to y in the mean square (pool adjacent violators).
std::vector<double> nearest_falling(std::span<const double> y) {
  std::vector<double> level;
  std::vector<std::size_t> count;
  for (const double value : y) {
    level.push_back(value);
    count.push_back(1);
    while (level.size() > 1 && level[level.size() - 2] < level.back()) {
      const auto a = static_cast<double>(count[count.size() - 2]);
      const auto b = static_cast<double>(count.back());
      level[level.size() - 2] = (a * level[level.size() - 2] + b * level.back()) / (a + b);
      count[count.size() - 2] += count.back();
      level.pop_back();
      count.pop_back();
    }
  }
  std::vector<double> falling;
  for (std::size_t k = 0; k < level.size(); ++k) falling.insert(falling.end(), count[k], level[k]);
  return falling;
}

double rmse(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

double statistic(std::string_view name, const Placed& profile) {
  const double m = profile.magnitude();
  if (name == "u-shaped") return (std::min(profile.left(), profile.right()) - profile.core()) / m;
  if (name == "core-annulus")
    return (profile.core() - std::max(profile.left(), profile.right())) / m;
  if (name == "down-flow at walls") return std::max(profile.left(), profile.right()) / m;
  if (name == "near walls") return (profile.left() + profile.right()) / 2 / profile.mean(0, 1) - 1;
  if (name == "decreasing") return rmse(profile.value, nearest_falling(profile.value)) / m;
  std::vector<double> mirrored;
  for (const double share : profile.share) mirrored.push_back(profile.at(1 - share));
  return rmse(profile.value, mirrored) / std::sqrt(2.) / m;
}

}  // namespace

std::span<const Shape> shapes() {
  static constexpr std::array<Shape, 6> all{{
      {"u-shaped", "walls above the core, over the mean", false, 0},
      {"core-annulus", "core above the walls, over the mean", false, 0},
      {"down-flow at walls", "largest wall value, over the mean", true, 0},
      {"decreasing", "distance from the nearest falling profile, over the mean", true, .05, true},
      {"symmetric", "distance from its mirror image, over the mean", true, .1, true},
      {"near walls", "density at the walls over the mean, less 1", false, 0},
  }};
  return all;
}

const Shape* find_shape(const std::string& name) {
  for (const auto& shape : shapes())
    if (shape.name == name) return &shape;
  return nullptr;
}

MetricValue evaluate(const Shape& shape, const Sampled& profile) {
  Sampled kept = profile;
  kept.at.clear();
  kept.value.clear();
  kept.u.clear();
  for (std::size_t i = 0; i < profile.at.size(); ++i)
    if (std::isfinite(profile.value[i]) && std::isfinite(profile.u[i])) {
      kept.at.push_back(profile.at[i]);
      kept.value.push_back(profile.value[i]);
      kept.u.push_back(profile.u[i]);
    }
  if (kept.at.size() < least_points)
    throw InputError("{}: expected a profile of {} points at least, found {}", shape.name,
                     least_points, kept.at.size());
  if (std::all_of(kept.value.begin(), kept.value.end(), [](double v) { return v == 0; }))
    throw InputError("{}: {} is 0 everywhere: it has no shape", shape.name, kept.y.name);
  return with_interval(
      kept,
      [&](std::span<const double> at, std::span<const double> values) {
        std::vector<double> share;
        for (const double x : at) share.push_back((x - at.front()) / (at.back() - at.front()));
        return statistic(shape.name, {share, values});
      },
      shape.is_distance);
}

}  // namespace bedscope::validation
