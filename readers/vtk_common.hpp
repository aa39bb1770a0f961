// SPDX-License-Identifier: BSD-3-Clause
// What the legacy and the XML files of VTK have in common. Internal to this room.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "readers/numbers.hpp"

namespace bedscope::readers {

/// The decimal that a float was made of, if that had six digits or fewer: 0.001, not 0.00100000005.
/// OpenFOAM writes times as float.
inline double as_written(float value) {
  double decimal = value;
  const auto text = fmt::format("{}", value);
  parse_number(text.data(), text.data() + text.size(), decimal);
  return decimal;
}

/// Arrays that tell ghosts: copies of points or cells that another file of the snapshot owns.
/// Source: vtkDataSetAttributes::PointGhostTypes, CellGhostTypes; vtkGhostLevels is that array
/// before VTK 6.3.
inline bool is_ghost_array(std::string_view name) {
  return name == "vtkGhostType" || name == "vtkGhostLevels";
}

/// Marks in `ghosts`, from its entry `first` on, which values of the array `name` stand for copies.
inline void mark_ghosts(std::string_view name, std::span<const double> values, std::size_t first,
                        std::vector<bool>& ghosts) {
  constexpr unsigned duplicate = 1;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool small = values[i] >= 0 && values[i] <= 255;
    ghosts[first + i] = name == "vtkGhostLevels"
                            ? values[i] > 0
                            : small && (static_cast<unsigned>(values[i]) & duplicate);
  }
}

/// Moves the rows that are no ghosts to the front; returns how many these are.
inline std::size_t drop_ghosts(const std::vector<bool>& ghosts, std::vector<double>& column) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < ghosts.size(); ++i)
    if (!ghosts[i]) column[kept++] = column[i];
  column.resize(kept);
  return kept;
}

}  // namespace bedscope::readers
