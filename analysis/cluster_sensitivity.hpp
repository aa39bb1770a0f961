// SPDX-License-Identifier: BSD-3-Clause
// How far the clusters move where a threshold changes by 1 %: whether it lies at an edge of what
// there is. docs/stability.md has the maps.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "analysis/clusters.hpp"

namespace bedscope::analysis {

/// Clusters and the sum of their holdups, under the thresholds as they are and with each of them
/// changed by 1 % downwards and upwards: sums over some snapshots.
struct ClusterSensitivity {
  struct Count {
    double clusters = 0, holdup = 0;
  };
  static constexpr std::size_t cases = 7;  ///< as they are; threshold, core, min_area: - and +
  std::array<Count, cases> counts{};

  /// Adds a snapshot, given what find_clusters was given, and what it found.
  void add(const Grid& grid, std::span<const double> holdup, const ClusterThresholds& thresholds,
           const ClusterImage& as_they_are);
  void merge(const ClusterSensitivity& other);

  /// The largest change of the number of clusters, or of their mean holdup, relative.
  double number_moves() const;
  double holdup_moves() const;
  /// One line where 1 % of a threshold moves one of them by more than 5 %, and that by three
  /// clusters at least; else empty.
  std::string describe(const ClusterThresholds& thresholds) const;
};

template <class Archive>
void archive(Archive& ar, ClusterSensitivity& sensitivity) {
  for (auto& [clusters, holdup] : sensitivity.counts) ar(clusters, holdup);
}

/// Whether snapshot i is one of those that are looked at: one in four, as each costs six searches.
inline bool sensitivity_wanted(std::size_t i) { return i % 4 == 0; }

}  // namespace bedscope::analysis
