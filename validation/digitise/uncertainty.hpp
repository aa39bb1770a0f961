// SPDX-License-Identifier: BSD-3-Clause
// The standard uncertainty of a place in the picture.
#pragma once

#include <vector>

#include "validation/digitise/lines.hpp"
#include "validation/digitise/markers.hpp"

namespace bedscope::digitise {

/// Adds to the markers' own uncertainties what a fit cannot see: programs that draw each marker on
/// whole pixels (told by the fractions of the places found: all alike), compression, and how unlike
/// one another the markers are.
void complete(std::vector<Marker>& markers, const Template& marker, bool lossy);

/// The same for the points of a line of thickness `stroke` [px].
void complete(std::vector<LinePoint>& points, double stroke, bool lossy);

}  // namespace bedscope::digitise
