// SPDX-License-Identifier: BSD-3-Clause
// Clusters followed through time.
#pragma once

#include <limits>

#include "analysis/clusters.hpp"

namespace bedscope::analysis {

/// Links the clusters of consecutive snapshots; feed it in the order of time.
///
/// The cells of each previous cluster are moved by its velocity times dt (that of its solids or,
/// for bubbles, that of its track so far, 0 at first sight), cut at cell faces (one moved cell
/// covers up to four), and a pair is linked where the overlap is at least a quarter of the smaller
/// cluster's area. The smaller one: a cluster that is swallowed and a piece that breaks off lie
/// wholly inside the other, however large that is. A quarter: two equal discs still link when the
/// velocity is wrong by 0.63 diameters a snapshot, and clusters that only graze do not.
///
/// - The pair that is each other's largest overlap continues its track (ties: the lower number).
/// - Every other track that links to a cluster is among its parents, ascending. So what splits off
///   is a new track with the old one as parent; what merges keeps the track of the largest
///   contributor and has the others as parents. No link: a new track without parents.
/// - track_velocity = displacement of the centroid / dt, where both clusters have this one link
///   only; NaN at first sight and where clusters merge or split, because there the centroid jumps
///   with the area that comes or goes.
/// - dt unknown (NaN), zero or negative: linked without moving, track_velocity NaN. Where times are
///   steps in truth, hand in NaN.
/// - A step of time longer than three times both steps before it is a gap: no links across it.
///
/// New tracks are numbered from 1 in the order of snapshots and of clusters. Nothing is linked
/// across a periodic seam.
class Tracker {
 public:
  enum class Motion { of_solids, of_track };
  explicit Tracker(const Grid& grid, Motion motion = Motion::of_solids)
      : grid_(grid), motion_(motion) {}
  /// Sets track, track_velocity and parents of the clusters of `now`, seen at `time` [s].
  void link(ClusterImage& now, double time);

  /// Into and out of one of the same grid.
  template <class Archive>
  void archive(Archive& ar) {
    ar(before_, time_, step_, step_before_, tracks_);
  }

 private:
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  Grid grid_;
  Motion motion_;
  ClusterImage before_;
  double time_ = unknown;
  double step_ = unknown, step_before_ = unknown;  ///< the last two known steps of time [s]
  int tracks_ = 0;
};

/// Leaves the clusters of the snapshots from `first` on, their tracks numbered from 1 in order of
/// appearance, without the parents before.
void keep_from(std::vector<Cluster>& clusters, std::size_t first);

}  // namespace bedscope::analysis
