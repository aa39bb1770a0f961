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

/// The decimal that a time was made of where it is a float: 0.001, not 0.0010000000475. OpenFOAM
/// writes times as float; a time that is none stays as it is.
inline double as_written(double time) {
  const auto single = static_cast<float>(time);
  if (time != static_cast<double>(single)) return time;
  double decimal = time;
  const auto text = fmt::format("{}", single);
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
