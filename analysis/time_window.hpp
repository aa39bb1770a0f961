// SPDX-License-Identifier: BSD-3-Clause
// Which snapshots an average takes, and the time that each of them stands for.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace bedscope::analysis {

/// Weights of the snapshots of a window in a time average, one for each of `times`, in their unit:
/// half the gap to each neighbour, the first and the last their one gap whole, so that equal
/// spacing gives equal weights. One snapshot: 1. None: empty.
/// `times`: those of the window only, strictly ascending.
std::vector<double> time_weights(std::span<const double> times);

/// Consecutive members of a series.
struct IndexRange {
  std::size_t first = 0, count = 0;
};

/// A weight for every snapshot of a series: time_weights of the window, 0 outside.
std::vector<double> window_weights(std::span<const double> times, const IndexRange& window);

/// Equal spacing (to rounding): then every snapshot weighs the same wherever a window begins.
bool evenly_spaced(std::span<const double> times);

/// The snapshots with from - half_step <= t <= to + half_step. Half a step of the solver makes the
/// ends insensitive to the rounding of t = step * time_step, and can include no other snapshot
/// when from and to are times of snapshots. `times` ascending; `from` and `to` may be infinite.
/// No snapshot: count 0.
IndexRange select_window(std::span<const double> times, double from, double to, double half_step);

}  // namespace bedscope::analysis
