// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/cluster_sensitivity.hpp"

#include <fmt/format.h>

#include <cmath>

namespace bedscope::analysis {
namespace {

constexpr double change = 0.01;   // of a threshold
constexpr double too_far = 0.05;  // that a result may move
constexpr double too_many = 3;    // clusters; fewer may be chance

ClusterSensitivity::Count count_of(const ClusterImage& image) {
  ClusterSensitivity::Count count;
  count.clusters = static_cast<double>(image.clusters.size());
  for (const auto& cluster : image.clusters) count.holdup += cluster.holdup;
  return count;
}

double mean_holdup(const ClusterSensitivity::Count& count) {
  return count.clusters > 0 ? count.holdup / count.clusters : 0;
}

double number_change(const ClusterSensitivity::Count& now, const ClusterSensitivity::Count& then) {
  return now.clusters > 0 ? std::abs(then.clusters - now.clusters) / now.clusters
                          : (then.clusters > 0 ? 1 : 0);
}

double holdup_change(const ClusterSensitivity::Count& now, const ClusterSensitivity::Count& then) {
  if (!(now.clusters > 0 && then.clusters > 0)) return 0;
  return std::abs(mean_holdup(then) / mean_holdup(now) - 1);
}

}  // namespace

void ClusterSensitivity::add(const Grid& grid, std::span<const double> holdup,
                             const ClusterThresholds& thresholds, const ClusterImage& as_they_are) {
  // Velocities are not asked for: the holdup stands in for them.
  const auto with = [&](double ClusterThresholds::*one, double factor) {
    auto other = thresholds;
    other.*one *= factor;
    return count_of(find_clusters(grid, holdup, holdup, holdup, holdup, other));
  };
  const auto put = [&](std::size_t at, const Count& count) {
    counts[at].clusters += count.clusters;
    counts[at].holdup += count.holdup;
  };
  put(0, count_of(as_they_are));
  std::size_t at = 1;
  for (auto one :
       {&ClusterThresholds::threshold, &ClusterThresholds::core, &ClusterThresholds::min_area})
    for (const double factor : {1 - change, 1 + change}) put(at++, with(one, factor));
}

void ClusterSensitivity::merge(const ClusterSensitivity& other) {
  for (std::size_t k = 0; k < cases; ++k) {
    counts[k].clusters += other.counts[k].clusters;
    counts[k].holdup += other.counts[k].holdup;
  }
}

double ClusterSensitivity::number_moves() const {
  double most = 0;
  for (const auto& count : counts) most = std::max(most, number_change(counts[0], count));
  return most;
}

double ClusterSensitivity::holdup_moves() const {
  double most = 0;
  for (const auto& count : counts) most = std::max(most, holdup_change(counts[0], count));
  return most;
}

std::string ClusterSensitivity::describe(const ClusterThresholds& thresholds) const {
  static constexpr std::array names{"threshold", "core", "min_area"};
  const std::array values{thresholds.threshold, thresholds.core, thresholds.min_area};
  double worst = too_far;
  std::size_t which = 0;
  for (std::size_t k = 1; k < cases; ++k) {
    const double moves =
        std::max(number_change(counts[0], counts[k]), holdup_change(counts[0], counts[k]));
    if (moves <= worst || std::abs(counts[k].clusters - counts[0].clusters) < too_many) continue;
    worst = moves;
    which = k;
  }
  if (which == 0) return "";
  return fmt::format(
      "clusters: {} ({:g}) lies at an edge: where it changes by 1 %, their number moves by {:.2g} "
      "% "
      "and their holdup by {:.2g} %",
      names[(which - 1) / 2], values[(which - 1) / 2],
      100 * number_change(counts[0], counts[which]), 100 * holdup_change(counts[0], counts[which]));
}

}  // namespace bedscope::analysis
