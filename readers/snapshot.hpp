// SPDX-License-Identifier: BSD-3-Clause
// The particles at one instant: what every reader fills and every analysis takes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace bedscope::readers {

inline constexpr std::int64_t no_step = std::numeric_limits<std::int64_t>::min();
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The simulation box as the dump states it [m]. `known` is false where the form has none.
struct Box {
  std::array<double, 3> min{}, max{};
  std::array<double, 3> tilt{};  ///< xy, xz, yz; min and max are then the bounding box
  std::array<bool, 3> periodic{};
  bool shrink_wrapped = false;  ///< follows the particles (boundary s or m), so it moves by itself
  bool known = false;

  bool operator==(const Box&) const = default;
};

/// A column that the caller wants, by the field's name (`x`, `vx`, `radius`, `type`, `id`, `mass`,
/// `density`, `temperature`) or by its name on disk (`f_dragforce[3]`).
struct ColumnRequest {
  std::string name;
  bool required = true;  ///< absent and required: FormatError; absent and optional: an empty column
};
using Request = std::vector<ColumnRequest>;

/// The particles at one instant, SI units as on disk. Re-used from one read to the next so that a
/// series is read without allocations.
struct Snapshot {
  std::int64_t step = no_step;
  double time = unknown;      ///< [s], only where the form itself stores it
  std::size_t particles = 0;  ///< rows
  Box box;
  std::vector<std::vector<double>> columns;  ///< as requested: `particles` values each, or empty
  std::uint64_t bytes_read = 0;              ///< from disk, for this snapshot
};

}  // namespace bedscope::readers
