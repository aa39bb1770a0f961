// SPDX-License-Identifier: BSD-3-Clause
// Where the markers of a plot are.
#pragma once

#include <vector>

#include "validation/digitise/template.hpp"

namespace bedscope::digitise {

inline constexpr double least_score = 0.6;             ///< of a fit that is taken for a marker
inline constexpr double well = (least_score + 1) / 2;  ///< half way from it to a perfect one

/// What to look for in one ink.
struct MarkerQuery {
  std::optional<Shape> shape;
  cv::Mat sample;                        ///< coverage of a marker the user showed; may be empty
  std::optional<cv::Point2d> reference;  ///< its reference point in the sample [px]
  /// The shapes that this ink may show: where it has several series and each names its own, these.
  std::vector<Shape> among = candidates(std::nullopt);
  std::vector<Shape> rivals;  ///< those that the other series of this ink name
  bool with_line = false;     ///< the ink draws a line too, whose dots and dashes are no markers
};

struct Marker {
  Fit fit;
  cv::Point2d at;        ///< the data point
  double u[2] = {0, 0};  ///< [px]
  bool doubted = false;  ///< another template lies there about as well
};

/// The marker of a fit: its data point and that point's uncertainty.
Marker marker_at(const Template& marker, const Fit& fit);

/// Takes a marker's ink out of a map: what it explains is not to be explained again.
void take_away(InkMap& map, const Template& marker, cv::Point2d origin);

/// Whether what is known of a fit is good enough for a marker: ink in all directions. One eighth
/// may lack it where the whole fits well: under the edge of another curve, or at the end of a line
/// whose other markers, and so the template, have it on both sides.
bool lies_well(const Fit& fit);

/// That, and enough of it is known.
bool is_marker(const Fit& fit);

/// The template that the ink shows for a query: from the user's sample; from markers that stand
/// alone; from filled markers on thinner lines; else drawn shapes of all sizes are tried.
/// Nothing where none of these is found.
std::optional<Template> learn(const InkMap& map, const MarkerQuery& query);

/// The same of several series of one ink. A template that looks more like the shape of another
/// series was learned from that one's markers: again without the markers of those that do look like
/// their own.
std::vector<std::optional<Template>> learn_all(const InkMap& map,
                                               const std::vector<MarkerQuery>& queries);

/// The template of markers that nobody asked for on a line of this ink: five or more of them, that
/// hold more than a twentieth of the ink and fit well. Dots and dashes of the line are no markers.
std::optional<Template> markers_on_line(const InkMap& map);

/// All markers of some templates in one ink: each place goes to the template that explains it best,
/// the best place first, and what it explains is not explained twice. One list a template.
std::vector<std::vector<Marker>> find_markers(const InkMap& map,
                                              const std::vector<Template>& templates);

/// The same of one template, near `places` alone.
std::vector<Marker> markers_near(const InkMap& map, const Template& marker,
                                 const std::vector<cv::Point2d>& places);

/// The score half way from the least one to that of the median marker: one below it resembles the
/// others little. 0 for fewer than four, which show no rule.
double little_alike(const std::vector<Marker>& markers);

/// Places in the ink that is left (what was found is unknown in `rest`) that fit as markers do, but
/// lack up to three quarters of the ink in some direction: they may lie under another curve.
std::vector<cv::Point2d> incomplete_markers(const InkMap& rest,
                                            const std::vector<Template>& templates);

}  // namespace bedscope::digitise
