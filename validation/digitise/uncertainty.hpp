// SPDX-License-Identifier: BSD-3-Clause
// The standard uncertainty of a place in the picture.
#pragma once

#include <vector>

#include "validation/digitise/lines.hpp"
#include "validation/digitise/markers.hpp"

namespace bedscope::digitise {

/// Adds to the markers' uncertainties what a fit cannot see: compression, and programs that draw
/// each marker on whole pixels, told by the fractions of the places found, which are all alike
/// then. Of the programs that do, gnuplot rounds to the middle of a pixel, matplotlib to the edge
/// between two and then, for circles and some sizes of the other shapes, draws half a pixel to the
/// right and below of that. Markers on the middles of pixels are therefore moved by half of that
/// half.
void complete(std::vector<Marker>& markers, int reduction, bool turned, bool lossy);

/// The same for the points of a line of thickness `stroke` [px].
void complete(std::vector<LinePoint>& points, double stroke, bool lossy);

}  // namespace bedscope::digitise
