// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/lines_among_markers.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "validation/digitise/beside_line.hpp"
#include "validation/digitise/error_bars.hpp"

namespace bedscope::digitise {
namespace {

constexpr double most_of_it = 0.6;

/// The first and the last column of some places.
std::pair<double, double> ends_of(const std::vector<LinePoint>& points) {
  const auto [first, last] = std::minmax_element(
      points.begin(), points.end(), [](const auto& a, const auto& b) { return a.at.x < b.at.x; });
  return {first->at.x, last->at.x};
}

bool spans(const TracedLine& line, const std::vector<LinePoint>& markers) {
  const auto [from, to] = ends_of(line.points);
  const auto [first, last] = ends_of(markers);
  return std::min(to, last) - std::max(from, first) > most_of_it * (last - first);
}

}  // namespace

std::vector<LinePoint> all_points(const std::vector<std::vector<Marker>>& markers) {
  std::vector<LinePoint> points;
  for (const auto& series : markers)
    for (const auto& one : series) points.push_back({one.at, std::max(one.u[0], one.u[1])});
  return points;
}

InkMap covered(const InkMap& map, const std::vector<Template>& templates,
               const std::vector<std::vector<Marker>>& markers, bool with_line) {
  InkMap rest{map.coverage, map.unknown.clone()};
  for (std::size_t t = 0; t < templates.size(); ++t)
    for (const auto& one : markers[t]) {
      const cv::Size size = templates[t].inside.size();
      const cv::Rect wanted(cvRound(one.fit.origin.x - size.width / 2.0),
                            cvRound(one.fit.origin.y - size.height / 2.0), size.width, size.height);
      const cv::Rect there = wanted & cv::Rect({0, 0}, rest.unknown.size());
      if (!there.empty()) rest.unknown(there).setTo(255, templates[t].inside(there - wanted.tl()));
    }
  for (std::size_t t = 0; t < templates.size(); ++t)
    for (const auto& one : markers[t])
      cover(rest, find_error_bar(map, templates[t], one.at, with_line), one.at);
  return rest;
}

TracedLine trace_beside(const InkMap& map, const std::vector<LinePoint>& through, int points) {
  InkMap wider = map;
  cv::dilate(map.unknown, wider.unknown, cv::Mat::ones(3, 3, CV_8U));
  return trace_line(wider, through, points);
}

std::vector<TracedLine> lines_among(const InkMap& map, const std::vector<Template>& templates,
                                    const std::vector<std::vector<Marker>>& markers,
                                    std::size_t asked) {
  std::vector<TracedLine> lines;
  const auto through = all_points(markers);
  if (through.empty()) return lines;
  constexpr int fine = 400;  // places on a line that is to be hidden
  const auto most = std::max(asked, templates.size());
  auto rest = covered(map, templates, markers, asked > 0);
  while (lines.size() < most) {
    const auto line = trace_beside(rest, through, fine);
    if (line.points.empty()) break;
    // Of the ink of several lines each explains its part.
    const double share = most_of_it / static_cast<double>(most - lines.size());
    if (lines.size() >= asked && (line.explained < share || !spans(line, through))) break;
    lines.push_back(line);
    rest = without_line(rest, line);
  }
  return lines;
}

}  // namespace bedscope::digitise
