// SPDX-License-Identifier: BSD-3-Clause
// The place of a line from sections across it.
#pragma once

#include <optional>
#include <vector>

#include "validation/digitise/template.hpp"

namespace bedscope::digitise {

/// Where a line passes, roughly, and the direction in which it runs there (a unit vector).
struct Passage {
  cv::Point2d at, along;
};

/// The ink of a section across a line [px]: that of the line alone lies between these.
struct Thickness {
  double least = 0, most = 0;
};

/// The ink of the sections at `passages`: their median, give or take three times their scatter, at
/// least 0.2 px: so much ink beside the line moves its middle by a tenth of a pixel.
Thickness thickness_of(const InkMap& map, const std::vector<Passage>& passages, double stroke);

struct PlaceOnLine {
  Passage passage;
  double u = 0;  ///< across the line [px]
};

/// The line's place near a passage, from sections a pixel apart within one `stroke` to each side:
/// a parabola through their middles, or, of a dot, the centroid. Unlike cuts by row or column,
/// sections across the line are not shifted by the ends of dashes, which run across it too.
/// Sections that meet an unknown pixel or hold other ink do not count; nothing where too few are
/// left.
std::optional<PlaceOnLine> place_across(const InkMap& map, const Passage& near, double stroke,
                                        const Thickness& thickness);

}  // namespace bedscope::digitise
