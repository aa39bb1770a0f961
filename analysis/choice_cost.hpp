// SPDX-License-Identifier: BSD-3-Clause
// What the variants of an analysis cost, measured on this machine.
#pragma once

#include <vector>

#include "analysis/choice.hpp"
#include "analysis/result.hpp"

namespace bedscope::analysis {

/// What analysing one snapshot takes, in the mean.
struct ChoiceCost {
  double read = 0;      ///< CPU time to read it [s]
  double products = 0;  ///< CPU time to map it and to sum [s]
  double bytes = 0;     ///< read from disk
};

/// Of each variant: times some snapshots of the window, one after the other on one thread, each
/// `repeats` times of which the fastest counts. For other forms of dumps these snapshots are
/// written to a temporary folder and read from there. Throws FileError.
std::vector<ChoiceCost> time_choices(const readers::Series& series,
                                     const std::vector<RunSetup>& setups,
                                     const std::vector<Variant>& variants, const Window& window,
                                     std::size_t snapshots = 8, int repeats = 3);

}  // namespace bedscope::analysis
