// SPDX-License-Identifier: BSD-3-Clause
// How high a bed stands in one snapshot.
#pragma once

#include <span>

#include "analysis/grid.hpp"

namespace bedscope::analysis {

/// Heights above the domain's floor [m], NaN where there are no solids.
struct BedHeights {
  double by_solids = 0;  ///< below it lie 95 % of the solids inside the domain
  double surface = 0;    ///< see bed_heights()
};

template <class Archive>
void archive(Archive& ar, BedHeights& heights) {
  auto& [by_solids, surface] = heights;
  ar(by_solids, surface);
}

/// From the holdup of each layer of cells over the whole cross-section [-], lowest first.
///
/// by_solids: the solids spread evenly within a layer.
/// surface: the top of the highest layer with more than half of the holdup that the solids see on
/// average, sum phi^2 / sum phi, which does not depend on the room above the bed; between the
/// middle of that layer and of the next the holdup is taken as linear. Above the domain it counts
/// as 0: a bed that reaches its top has its surface in the upper half of the top layer, at most at
/// the top itself.
BedHeights bed_heights(const Grid& grid, std::span<const double> layers);

}  // namespace bedscope::analysis
