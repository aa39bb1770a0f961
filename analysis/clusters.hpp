// SPDX-License-Identifier: BSD-3-Clause
// Clusters and bubbles of one snapshot on the depth-averaged grid.
#pragma once

#include <span>
#include <vector>

#include "analysis/cluster_result.hpp"
#include "analysis/grid.hpp"

namespace bedscope::analysis {

/// The clusters of one snapshot and the cells that they own.
struct ClusterImage {
  std::vector<Cluster> clusters;  ///< Cluster::cluster = position + 1
  std::vector<int> labels;        ///< a cell: 0, or Cluster::cluster; cells[lateral] x cells[up]
};

/// The clusters of one snapshot: 8-connected regions of holdup > threshold with an area of at least
/// min_area (an exact multiple of the cell counts as reached: 1e-9 relative) and a cell > core.
///
///   velocity = sum(rho phi v) / sum(rho phi);  major, minor = 4 sqrt(lambda)
///
/// lambda: eigenvalues of the region's central second moments, each cell's own width^2/12 included;
/// a region of equal moments (square, disc) has angle 0. Numbered upwards by centre z, then x, then
/// first cell. Contours: the outer one first, anticlockwise, then the holes, clockwise; corners
/// only, the first repeated at the end; where two cells touch by a corner the outline runs through
/// it twice. Areas of outline minus holes add up to the cluster's.
/// snapshot and time are the caller's to set, track, track velocity and parents the Tracker's.
///
/// `mass` is rho phi in any unit; where all particles have one density the holdup itself will do.
/// Regions are not joined across a periodic seam.
/// Source of the three thresholds: Carlos Varas et al. (2016).
/// Shape: cells[lateral] x cells[up], lateral fastest, whatever cells[depth]. Units: [-] and [m/s].
/// Thread-safe; turns OpenCV's own threads off for the process.
ClusterImage find_clusters(const Grid& grid, std::span<const double> holdup,
                           std::span<const double> mass, std::span<const double> mass_vx,
                           std::span<const double> mass_vz, const ClusterThresholds& thresholds);

/// The bubbles of one snapshot: the same regions of the voidage, 1 - holdup, less the freeboard.
/// What reaches the top row of cells is freeboard, and so is what has its centroid above `surface`
/// [m above the floor] (all, where that is NaN). So a bubble counts until the voidage above it
/// opens. Velocities of solids are NaN.
ClusterImage find_bubbles(const Grid& grid, std::span<const double> voidage, double surface,
                          const ClusterThresholds& thresholds);

}  // namespace bedscope::analysis
