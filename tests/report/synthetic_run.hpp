// SPDX-License-Identifier: BSD-3-Clause
// A riser made of formulas: enough structure for every figure, small enough for quick tests.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "analysis/result.hpp"

namespace bedscope::tests {

struct SyntheticOptions {
  std::string label = "K = 1";
  std::array<int, 3> cells{14, 1, 60};
  int snapshots = 120;
  int clusters_each = 4;  ///< in each snapshot
  bool two_types = true;  ///< "1" and "2" besides "all"
  bool temperature = true;
  double shift = 0;  ///< makes runs differ [-]
};

/// Denser at the bottom and the walls, falling there, rising in the middle; the second half is the
/// averaging window. The top cell row has seen no solids: NaN velocities.
analysis::RunResult synthetic_run(const SyntheticOptions& options = {});

}  // namespace bedscope::tests
