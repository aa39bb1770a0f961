// SPDX-License-Identifier: BSD-3-Clause
// Clusters followed through time.
#pragma once

#include "analysis/clusters.hpp"

namespace bedscope::analysis {

/// Links the clusters of consecutive snapshots; feed it in the order of time.
class Tracker {
 public:
  explicit Tracker(const Grid& grid) : grid_(grid) {}
  /// Sets track, track_velocity and parents of the clusters of `now`, seen at `time` [s].
  void link(ClusterImage& now, double time);

 private:
  Grid grid_;
  ClusterImage before_;
  double time_ = 0;
  int tracks_ = 0;
};

}  // namespace bedscope::analysis
