// SPDX-License-Identifier: BSD-3-Clause
// The standard uncertainty of a place in the picture.
#pragma once

#include <vector>

#include "validation/digitise/lines.hpp"
#include "validation/digitise/markers.hpp"

namespace bedscope::digitise {

/// Adds to the markers' uncertainties what a fit cannot see: compression, and programs that draw
/// each marker on whole pixels. Of these, gnuplot rounds to the middle of a pixel, matplotlib to
/// the edge between two and then, for circles and some sizes of the other shapes, draws half a
/// pixel to the right and below of that. Markers are therefore moved by half of that half, unless
/// the fractions of the places found are all alike and tell the edge between pixels, or are so
/// unlike that the program does not round; neither can be seen of a few markers, or on a page that
/// was turned or made smaller.
void complete(std::vector<Marker>& markers, int reduction, bool turned, bool lossy);

/// The same for the points of a line, which programs draw where they are; matplotlib leaves out
/// points of it that change it by less than a ninth of a pixel.
void complete(std::vector<LinePoint>& points, bool lossy);

}  // namespace bedscope::digitise
