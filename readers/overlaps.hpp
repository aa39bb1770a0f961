// SPDX-License-Identifier: BSD-3-Clause
// How deep spheres overlap: pairs found by linked cells, in time that grows with their number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace bedscope::readers {

/// Columns of one snapshot, one value a sphere [m].
struct Spheres {
  std::span<const double> x, y, z, radius;
  std::span<const double> body;  ///< spheres of one body (> 0) may overlap; empty: no bodies
};

struct Overlaps {
  double deepest = 0;            ///< (r1 + r2 - distance) / min(r1, r2), less `rounding`
  double rounding = 0;           ///< what the digits of the dump leave open, for that pair
  std::size_t a = 0, b = 0;      ///< its rows
  std::int64_t beyond_rule = 0;  ///< pairs deeper than `overlap_rule`
  std::int64_t deep = 0;         ///< pairs nearer than 0.9 (r1 + r2)
  bool complete = true;  ///< false: so many spheres in one place that not all pairs were looked at
};

/// The usual rule for the stiffness of soft spheres: overlaps stay below 1 % of the radius. It is a
/// rule of thumb; runs with softer springs are common and may still be right.
inline constexpr double overlap_rule = 0.01;

/// All pairs of spheres that touch. Coordinates are taken as printed with 6 significant digits
/// (LIGGGHTS' %g): what these leave open is taken off each overlap, so that rounding never counts
/// as one. Pairs across periodic sides are not seen. Rows that are not finite or have no size are
/// passed over. Cost: O(N), for any mix of sizes.
Overlaps find_overlaps(const Spheres& spheres);

}  // namespace bedscope::readers
