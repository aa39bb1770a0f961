// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/beside_line.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace bedscope::digitise {
namespace {

// Of a marker's ink that the line leaves:
constexpr double to_tell = 0.1;    // whether it is one
constexpr double to_place = 0.35;  // where it is, and that one was missed

/// Where a marker lies best, from its place and from a quarter of its size to each side.
Fit best_near(const Template& marker, const InkMap& rest, cv::Point2d origin) {
  Fit best = fit(marker, rest, origin);
  const double x = marker.box.width / 4, y = marker.box.height / 4;
  for (const cv::Point2d by : {cv::Point2d(x, 0), {-x, 0}, {0, y}, {0, -y}})
    if (const auto here = fit(marker, rest, origin + by);
        here.known > to_place && here.score > best.score)
      best = here;
  return best;
}

/// The window of a template with a straight band hidden that goes through it `aside` its middle.
InkMap without_band(const InkMap& map, const Template& marker, cv::Point2d origin, double angle,
                    double aside, double thickness) {
  const cv::Size size = marker.ink.size();
  InkMap part{window(map.coverage, origin, size, 0), {}};
  part.unknown = window(map.unknown, origin, size, 255) > 127;
  const cv::Point2d across(-std::sin(angle), std::cos(angle));
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const cv::Point2d from(x + 0.5 - size.width / 2.0, y + 0.5 - size.height / 2.0);
      if (std::abs(from.dot(across) - aside) < thickness / 2) part.unknown.at<uchar>(y, x) = 255;
    }
  return part;
}

bool is_stretch(const InkMap& map, const Template& marker, const Fit& where, double stroke) {
  if (distinct(marker, map, where) == 0) return true;
  constexpr int ways = 12;
  const cv::Point2d middle(marker.ink.cols / 2.0, marker.ink.rows / 2.0);
  for (int way = 0; way < ways; ++way)
    for (const double aside : {-stroke / 4, 0.0, stroke / 4}) {
      const auto part =
          without_band(map, marker, where.origin, way * CV_PI / ways, aside, stroke + 2);
      const auto here = seen_at(marker, part, middle);
      if (here.known > to_tell && here.least_part < where.least_part / 2 &&
          here.next_part < where.next_part / 2)
        return true;
    }
  return false;
}

}  // namespace

InkMap without_line(const InkMap& map, const TracedLine& line) {
  constexpr int shift = 4;  // fractions of a pixel for OpenCV, whose pixels have their middles at 0
  std::vector<cv::Point> way;
  const auto add = [&](cv::Point2d at) {
    way.emplace_back(cvRound((at.x - 0.5) * (1 << shift)), cvRound((at.y - 0.5) * (1 << shift)));
  };
  add(line.first);
  for (const auto& point : line.points) add(point.at);
  add(line.last);
  cv::Mat band = cv::Mat::zeros(map.coverage.size(), CV_8U);
  cv::polylines(band, way, false, cv::Scalar(255), cvCeil(line.stroke) + 2, cv::LINE_8, shift);
  band.setTo(0, map.coverage < 0.06F);
  InkMap rest{map.coverage.clone(), map.unknown.clone()};
  rest.coverage.setTo(0, band);
  rest.unknown.setTo(255, band);
  return rest;
}

void drop_stretches(const InkMap& map, double stroke, const std::vector<Template>& templates,
                    std::vector<std::vector<Marker>>& found) {
  for (std::size_t t = 0; t < templates.size(); ++t)
    std::erase_if(found[t], [&](const Marker& one) {
      return is_stretch(map, templates[t], one.fit, stroke);
    });
}

std::vector<std::vector<Marker>> beside_line(const InkMap& map,
                                             const std::vector<TracedLine>& lines,
                                             const std::vector<Template>& templates,
                                             const std::vector<std::vector<Marker>>& found) {
  if (lines.empty()) return found;
  InkMap rest = map;
  for (const auto& line : lines) rest = without_line(rest, line);
  const InkMap alone = rest;
  std::vector<std::vector<Marker>> again(templates.size());
  for (std::size_t t = 0; t < templates.size(); ++t)
    for (auto one : found[t]) {
      auto here = best_near(templates[t], alone, one.fit.origin);
      const auto as_it_was = seen_at(templates[t], alone, one.fit.origin);
      if (as_it_was.known > to_tell && std::max(as_it_was.score, here.score) < least_score)
        continue;
      std::size_t which = t;
      for (std::size_t other = 0; one.doubted && other < templates.size(); ++other)
        if (const auto there = best_near(templates[other], alone, one.fit.origin);
            is_marker(there) && there.score > here.score) {
          here = there;
          which = other;
        }
      const bool doubted = one.doubted;
      if (is_marker(here)) one = marker_at(templates[which], here);
      one.doubted = doubted;
      again[which].push_back(one);
    }
  for (std::size_t t = 0; t < templates.size(); ++t)
    for (const auto& one : again[t]) take_away(rest, templates[t], one.fit.origin);
  const auto more = find_markers(rest, templates);
  for (std::size_t t = 0; t < templates.size(); ++t)
    for (const auto& one : more[t])
      if (one.fit.known > to_place) again[t].push_back(one);
  return again;
}

}  // namespace bedscope::digitise
