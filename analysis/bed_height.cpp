// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/bed_height.hpp"

#include <algorithm>
#include <limits>

namespace bedscope::analysis {

BedHeights bed_heights(const Grid& grid, std::span<const double> layers) {
  constexpr double share = 0.95;
  constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
  double sum = 0, squares = 0;
  for (const double phi : layers) {
    sum += phi;
    squares += phi * phi;
  }
  if (!(sum > 0)) return {undefined, undefined};

  BedHeights heights;
  double below = 0;
  std::size_t k = 0;
  while (k + 1 < layers.size() && below + layers[k] < share * sum) below += layers[k++];
  heights.by_solids = (static_cast<double>(k) + (share * sum - below) / layers[k]) * grid.width(up);

  const double limit = squares / sum / 2;
  std::size_t top = layers.size() - 1;
  while (layers[top] <= limit) --top;  // one is above, as the largest is
  const double next = top + 1 < layers.size() ? layers[top + 1] : 0;
  const double layer =
      static_cast<double>(top) + 0.5 + (layers[top] - limit) / (layers[top] - next);
  heights.surface = std::min(layer * grid.width(up), grid.length(up));
  return heights;
}

}  // namespace bedscope::analysis
