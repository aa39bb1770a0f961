// SPDX-License-Identifier: BSD-3-Clause
// The lines of an ink that has markers too.
#pragma once

#include "validation/digitise/lines.hpp"
#include "validation/digitise/markers.hpp"

namespace bedscope::digitise {

/// The markers as places that a line of their ink may go through.
std::vector<LinePoint> all_points(const std::vector<std::vector<Marker>>& markers);

/// The map with nothing known under the markers of each template and their bars.
InkMap covered(const InkMap& map, const std::vector<Template>& templates,
               const std::vector<std::vector<Marker>>& markers, bool with_line);

/// The line of a map in which markers are covered: trace_line(), with nothing known a pixel round
/// them either.
TracedLine trace_beside(const InkMap& map, const std::vector<LinePoint>& through, int points);

/// The lines among the markers of an ink: those that were `asked` for, and one a template that
/// nobody asked for, where it reaches over most of the way from the first marker to the last and
/// explains most of the ink that markers, bars and other lines leave. None where there are no
/// markers.
std::vector<TracedLine> lines_among(const InkMap& map, const std::vector<Template>& templates,
                                    const std::vector<std::vector<Marker>>& markers,
                                    std::size_t asked);

}  // namespace bedscope::digitise
