// SPDX-License-Identifier: BSD-3-Clause
// Clusters of one snapshot on the depth-averaged grid.
#pragma once

#include <span>
#include <vector>

#include "analysis/result.hpp"

namespace bedscope::analysis {

/// The clusters of one snapshot and the cells that they own.
struct ClusterImage {
  std::vector<Cluster> clusters;  ///< Cluster::cluster = position + 1
  std::vector<int> labels;        ///< a cell: 0, or Cluster::cluster; cells[lateral] x cells[up]
};

ClusterImage find_clusters(const Grid& grid, std::span<const double> holdup,
                           std::span<const double> holdup_vx, std::span<const double> holdup_vz,
                           const ClusterThresholds& thresholds);

}  // namespace bedscope::analysis
