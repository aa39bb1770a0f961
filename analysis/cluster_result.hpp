// SPDX-License-Identifier: BSD-3-Clause
// What the cluster machine finds, in the holdup (clusters) or in the voidage (bubbles).
#pragma once

#include <cstddef>
#include <vector>

namespace bedscope::analysis {

struct Point {
  double x = 0, z = 0;  ///< lateral, up [m]
};

/// A cluster in one snapshot (Carlos Varas et al. 2016 in its three thresholds), or a bubble, whose
/// "holdup" is the voidage that was searched and whose solids' velocity is NaN.
struct Cluster {
  std::size_t snapshot = 0;  ///< index into RunResult::occurrence
  double time = 0;           ///< [s]
  int cluster = 0;           ///< number within the snapshot, from 1, from the bottom upwards
  int track = 0;             ///< the same number through time, from 1
  Point centre;              ///< centroid of its area [m]
  double area = 0;           ///< cells x cell area [m2]
  double holdup = 0, holdup_max = 0;
  double velocity_x = 0, velocity_z = 0;              ///< of its solids, mass-weighted [m/s]
  double track_velocity_x = 0, track_velocity_z = 0;  ///< of its centroid [m/s]; NaN at first sight
  double major = 0, minor = 0;  ///< full axes of the ellipse of equal second moments [m]
  double angle = 0;             ///< of the major axis from lateral [rad], (-pi/2, pi/2]
  bool at_wall = false;         ///< touches a side of the grid or its floor
  std::vector<int>
      parents;  ///< tracks of the previous snapshot that merged into it or that it split off
  std::vector<std::vector<Point>> contours;  ///< closed polylines along cell faces [m]
};

/// The thresholds that found the clusters.
struct ClusterThresholds {
  double threshold = 0.2;   ///< holdup everywhere above [-]
  double core = 0.4;        ///< holdup somewhere above [-]
  double min_area = 60e-6;  ///< [m2]
};

}  // namespace bedscope::analysis
