// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/doubt.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "validation/digitise/pieces.hpp"

namespace bedscope::digitise {
namespace {

/// A part of a marker may be hidden by another curve, and bars may hang on it.
bool of_size(const cv::Rect& box, double ink, const Template& marker) {
  const auto about = [](double a, double b, double most) { return a > 0.35 * b && a < most * b; };
  return about(box.width, marker.box.width, 1.5) && about(box.height, marker.box.height, 1.5) &&
         about(ink, cv::sum(marker.ink)[0], 2);
}

cv::Point2d middle_of(const cv::Rect& box) {
  return {box.x + box.width / 2.0, box.y + box.height / 2.0};
}

/// Letters stand side by side, about as high as each other, with gaps narrower than half that.
bool in_a_word(const cv::Rect& box, const std::vector<cv::Rect>& boxes) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const cv::Rect& other) {
    const int gap = std::max(other.x - box.br().x, box.x - other.br().x);
    const int both = std::min(other.br().y, box.br().y) - std::max(other.y, box.y);
    const auto [low, high] = std::minmax(other.height, box.height);
    return gap >= 0 && gap < box.height / 2 && both > 0.5 * low && 2 * low > high;
  });
}

/// Half of what a marker has to be.
bool resembles(const InkMap& rest, const cv::Rect& box, const Template& marker) {
  const auto found = fit(marker, rest, middle_of(box));
  return found.score > least_score / 2 && found.least_part > 0.22;
}

}  // namespace

std::vector<cv::Point2d> missed_markers(const InkMap& rest,
                                        const std::vector<Template>& templates) {
  cv::Mat mask = rest.coverage > 0.28F, labels, stats, centres;
  mask.setTo(0, rest.unknown);
  const int n = cv::connectedComponentsWithStats(mask, labels, stats, centres, 8);
  std::vector<double> ink(n);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) ink[labels.at<int>(y, x)] += rest.coverage.at<float>(y, x);
  std::vector<cv::Rect> boxes;
  for (int i = 0; i < n; ++i)
    boxes.emplace_back(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
  std::vector<cv::Point2d> places;
  for (int i = 1; i < n; ++i) {
    const auto& box = boxes[static_cast<std::size_t>(i)];
    if (std::any_of(templates.begin(), templates.end(),
                    [&](const Template& marker) {
                      return of_size(box, ink[i], marker) && resembles(rest, box, marker);
                    }) &&
        !in_a_word(box, boxes))
      places.push_back(middle_of(box));
  }
  if (!places.empty()) return places;
  auto pieces = pieces_of(mask, rest);
  std::erase_if(pieces, [&](const Piece& piece) {  // ticks, dots, caps
    return std::any_of(templates.begin(), templates.end(), [&](const Template& marker) {
      return std::min(piece.box.width, piece.box.height) <
             std::min(marker.box.width, marker.box.height) / 2;
    });
  });
  const auto all = candidates(std::nullopt);
  const auto group = best_group(pieces, rest.coverage, all, all, 0.88);
  if (group && group->pieces.size() >= 3)
    for (const auto& piece : group->pieces) places.push_back(middle_of(piece.box));
  return places;
}

std::vector<cv::Point2d> unlike_others(const std::vector<Marker>& markers) {
  std::vector<cv::Point2d> places;
  const double little = little_alike(markers);
  for (const auto& marker : markers)
    if (marker.fit.score < little) places.push_back(marker.at);
  return places;
}

std::vector<cv::Point2d> drop_stray_bars(std::vector<Point>& points) {
  const auto has_one = [](const Point& point) {
    return !std::isnan(point.lo) || !std::isnan(point.hi);
  };
  if (4 * std::count_if(points.begin(), points.end(), has_one) >= std::ssize(points)) return {};
  std::vector<cv::Point2d> places;
  for (auto& point : points) {
    if (!has_one(point)) continue;
    places.push_back(point.pixel);
    point.lo = point.hi = point.bar_pixel[0] = point.bar_pixel[1] = nan;
  }
  return places;
}

std::vector<cv::Point2d> without_bar(const std::vector<Point>& points) {
  std::vector<bool> lacks(points.size());
  std::ptrdiff_t lacking = 0, ends = 0;
  for (const int side : {0, 1}) {
    const auto unseen = [side](const Point& point) { return std::isnan(point.bar_pixel[side]); };
    const auto n = std::count_if(points.begin(), points.end(), unseen);
    if (2 * n >= std::ssize(points)) continue;
    lacking += n;
    ends += std::ssize(points);
    for (std::size_t i = 0; i < points.size(); ++i) lacks[i] = lacks[i] || unseen(points[i]);
  }
  std::vector<cv::Point2d> places;
  if (10 * lacking <= ends) return places;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (lacks[i]) places.push_back(points[i].pixel);
  return places;
}

std::vector<cv::Point2d> gaps_in(const TracedLine& line, cv::Size area) {
  std::vector<cv::Point2d> places{line.first}, gaps;
  for (const auto& point : line.points) places.push_back(point.at);
  places.push_back(line.last);
  for (std::size_t i = 1; i < places.size(); ++i) {
    const auto gap = places[i] - places[i - 1];
    const bool at_end = i == 1 || i + 1 == places.size();
    const double farthest = at_end ? 1 : 0.5;
    if (20 * farthest * std::abs(gap.x) > area.width ||
        20 * farthest * std::abs(gap.y) > area.height)
      gaps.push_back((places[i] + places[i - 1]) / 2);
  }
  return gaps;
}

int ink_beside(const Colours& colours, int ink) {
  if (!colours.lossy) return -1;
  for (std::size_t k = 0; k < colours.inks.size(); ++k)
    if (static_cast<int>(k) != ink &&
        cv::norm(colours.inks[k] - colours.inks[static_cast<std::size_t>(ink)]) < same_ink)
      return static_cast<int>(k);
  return -1;
}

}  // namespace bedscope::digitise
