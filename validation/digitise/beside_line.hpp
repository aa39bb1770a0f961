// SPDX-License-Identifier: BSD-3-Clause
// Markers by what the line of their ink does not cover.
#pragma once

#include <vector>

#include "validation/digitise/lines.hpp"
#include "validation/digitise/markers.hpp"

namespace bedscope::digitise {

/// Drops what is a stretch of a line, of `stroke` pixels: what lies as well farther along it, or
/// has lost half of its ink in two directions where a straight band of that thickness is hidden.
void drop_stretches(const InkMap& map, double stroke, const std::vector<Template>& templates,
                    std::vector<std::vector<Marker>>& found);

/// `found` once more with the ink of their lines hidden: a line that touches a filled marker would
/// draw it over, and one thicker than a marker's stroke hides that. What lies well beside a line
/// only is added; a marker of which a line covers most stays where it was.
std::vector<std::vector<Marker>> beside_line(const InkMap& map,
                                             const std::vector<TracedLine>& lines,
                                             const std::vector<Template>& templates,
                                             const std::vector<std::vector<Marker>>& found);

/// The map with nothing known where the line has ink, and a pixel round it.
InkMap without_line(const InkMap& map, const TracedLine& line);

}  // namespace bedscope::digitise
