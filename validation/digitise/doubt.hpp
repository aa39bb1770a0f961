// SPDX-License-Identifier: BSD-3-Clause
// What a user should look at before the numbers are used.
#pragma once

#include <vector>

#include "validation/digitise/colour.hpp"
#include "validation/digitise/figure.hpp"
#include "validation/digitise/lines.hpp"
#include "validation/digitise/markers.hpp"

namespace bedscope::digitise {

/// Places in the ink that is left (what was found is unknown in `rest`) that look like markers:
/// pieces of about the size of one of `templates` that resemble it half as well as a marker has
/// to, and three or more pieces alike, at least half as large, that resemble any marker.
std::vector<cv::Point2d> missed_markers(const InkMap& rest, const std::vector<Template>& templates);

/// Markers that fit so much worse than most of their series that they are nearer to being none.
std::vector<cv::Point2d> unlike_others(const std::vector<Marker>& markers);

/// Takes away the bars of a series in which fewer than a quarter of the markers have one: a steep
/// line that leaves a marker looks like one. Where they were.
std::vector<cv::Point2d> drop_stray_bars(std::vector<Point>& points);

/// Markers of which an end of the error bar, lower or upper, is not seen, while it is of most; none
/// where that is no more than one end in ten, as a short bar hides in its marker.
std::vector<cv::Point2d> without_bar(const std::vector<Point>& points);

/// The middles of the stretches of a line that hold no place and go farther than a twentieth of an
/// axis (`area`) from the nearest one: twice as much between two, once at an end.
std::vector<cv::Point2d> gaps_in(const TracedLine& line, cv::Size area);

/// Another ink that noise cannot tell from `ink`: nearer to it than a colour may be to the one
/// asked for. Its index, or -1; always -1 where the picture has no noise.
int ink_beside(const Colours& colours, int ink);

}  // namespace bedscope::digitise
