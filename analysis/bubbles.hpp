// SPDX-License-Identifier: BSD-3-Clause
// Bubbles through time, reduced to what is reported against height.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/bed_result.hpp"
#include "analysis/run_setup.hpp"
#include "analysis/tracks.hpp"

namespace bedscope::analysis {

/// What one snapshot gives: its bubbles, and the share of each band that they cover [-].
struct BubbleProduct {
  ClusterImage image;
  std::vector<double> covered;
};

/// `holdup`: depth-averaged, cells[lateral] x cells[up]; `surface` [m above the floor]: what lies
/// above is freeboard, see find_bubbles(). The study must ask for bubbles.
BubbleProduct make_bubbles(const RunSetup& setup, std::span<const double> holdup, double surface);

/// The serial end: products in the order of the series.
class BubbleSums {
 public:
  explicit BubbleSums(const Grid& grid) : tracker_(grid, Tracker::Motion::of_track) {}

  /// `time` NaN where it is not known, `weight` > 0.
  void add(BubbleProduct& product, std::size_t snapshot, double time, double weight,
           bool keep_contours);

  /// Over the snapshots from `first` on. Means over bubbles are ratios of sums, so that their
  /// intervals take the correlation in time into account.
  ///
  ///   frequency = (tracks that cross the height upwards - downwards) / time,
  ///
  /// a track crossing where its centroid is below in one snapshot and not below in the next. A
  /// track that begins above or ends below does not pass, and one that goes to and fro passes once.
  Bubbles finish(const RunSetup& setup, std::size_t first, std::vector<std::string>& problems) &&;

 private:
  struct Sample {
    std::size_t snapshot = 0;
    double time = 0, weight = 0;
    std::vector<double> covered;
  };
  Tracker tracker_;
  std::vector<Cluster> bubbles_;
  std::vector<Sample> samples_;
};

/// sqrt(4 A / pi), the diameter of a disc of the same area [m].
double equivalent_diameter(const Cluster& bubble);
/// Height over width of its ellipse of equal second moments [-].
double aspect_ratio(const Cluster& bubble);

}  // namespace bedscope::analysis
