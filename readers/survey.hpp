// SPDX-License-Identifier: BSD-3-Clause
// What a series holds: counts from all headers, ranges from the rows of some or all snapshots.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "readers/flaws.hpp"
#include "readers/series.hpp"

namespace bedscope::readers {

struct Survey {
  std::array<std::int64_t, 2> particles{};     ///< fewest and most in a snapshot
  std::map<std::int64_t, std::int64_t> types;  ///< type: particles in the snapshots read
  bool has_radius = false;
  std::array<double, 2> radius{};      ///< smallest and largest [m]
  std::array<double, 3> min{}, max{};  ///< of the centres [m]
  bool has_particles = false;          ///< false: bounds mean nothing
  std::size_t snapshots_read = 0;      ///< rows of that many were looked at
  std::vector<std::string> problems;
};

/// The first of `count` snapshots, the last and eight between, or all (`full`), ascending.
std::vector<std::size_t> chosen_snapshots(std::size_t count, bool full);

/// Reads the rows of the first, the last and eight snapshots between, or of all (`full`).
Survey survey(const Series& series, bool full);

}  // namespace bedscope::readers
