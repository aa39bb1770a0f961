// SPDX-License-Identifier: BSD-3-Clause
// What the markers of an ink look like.
#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "validation/digitise/beside_line.hpp"
#include "validation/digitise/markers.hpp"
#include "validation/digitise/pieces.hpp"
#include "validation/digitise/search.hpp"
#include "validation/digitise/stroke.hpp"

namespace bedscope::digitise {
namespace {

/// What a search tries where the user names no shape.
std::vector<Shape> common_shapes() {
  std::vector<Shape> shapes{{Outline::plus, Fill::any}, {Outline::x, Fill::any}};
  for (const auto outline :
       {Outline::circle, Outline::square, Outline::diamond, Outline::triangle,
        Outline::triangle_down, Outline::triangle_left, Outline::triangle_right, Outline::star}) {
    shapes.push_back({outline, Fill::filled});
    shapes.push_back({outline, Fill::open});
  }
  return shapes;
}

/// How much ink a template explains, how well, and how much better than beside.
double worth(const InkMap& map, const Template& marker) {
  double sum = 0;
  const auto found = find_markers(map, {marker});
  for (const auto& one : found[0])
    sum +=
        marker.ink.dot(marker.ink) * (one.fit.score - least_score) * distinct(marker, map, one.fit);
  return sum;
}

/// Of markers that stand alone the bars, or the ends of their line, that stick out by more than two
/// pixels; their edges, which may be blurred, stay as they are.
Template without_bars(const Template& marker, const std::vector<Shape>& shapes, bool with_line) {
  const auto bare = trimmed(marker, shapes, with_line ? 0.4 : 1.0 / 8);
  return marker.box.width > bare.box.width + 2 || marker.box.height > bare.box.height + 2 ? bare
                                                                                          : marker;
}

/// Whether ink goes on beside a marker: a line or a bar leaves it.
bool goes_on(const InkMap& map, const Template& marker, cv::Point2d origin) {
  cv::Mat grown;
  cv::dilate(marker.inside, grown, cv::Mat::ones(3, 3, CV_8U));
  const cv::Mat ink = window(map.coverage, origin, grown.size(), 0) > 0.3F;
  return cv::countNonZero(ink & (grown - marker.inside)) > 0;
}

/// Whether a template looks more like the shape that a series names than like those of the others.
bool looks_as_asked(const Template& marker, const MarkerQuery& query) {
  if (!query.sample.empty() || !query.shape) return true;
  const auto seen = recognise(trimmed(marker, query.among).ink, query.among).first;
  const auto asked = candidates(query.shape);
  return std::any_of(asked.begin(), asked.end(), [&](const Shape& shape) {
    return shape.outline == seen.outline && shape.fill == seen.fill;
  });
}

/// Whether a template lies as a marker does in its three best places, half as well at least and as
/// much better than beside: crossings of bars and lines do not.
bool fits_well(const InkMap& map, const Template& marker) {
  constexpr double whole = 0.4 * 0.5;  // of a perfect fit that is half as good beside
  std::vector<double> worths;
  const auto found = find_markers(map, {marker});
  for (const auto& one : found[0])
    worths.push_back((one.fit.score - least_score) * distinct(marker, map, one.fit));
  if (worths.empty()) return false;
  std::sort(worths.rbegin(), worths.rend());
  return worths[std::min<std::size_t>(2, worths.size() - 1)] > whole / 2;
}

/// What the ink shows for a query without a sample.
std::optional<Template> found_template(const InkMap& map, const MarkerQuery& query) {
  const auto shapes = candidates(query.shape);
  cv::Mat mask;
  cv::compare(map.coverage, 0.28, mask, cv::CMP_GT);
  const double all = cv::sum(map.coverage)[0];
  constexpr double much = 0.35;  // of the ink: what holds as much can only be the markers
  auto pieces = pieces_of(mask, map);
  if (query.with_line) {
    const double stroke = std::min(stroke_width(map.coverage), line_width(map.coverage));
    std::erase_if(pieces, [&](const Piece& piece) { return piece.breadth < 2 * stroke; });
  }
  const auto alone = best_group(pieces, map.coverage, query.among, shapes, 0.8);
  const bool several = alone && alone->pieces.size() >= 3;
  std::optional<Template> bare;
  if (several || (alone && alone->ink > much * all))
    bare = without_bars(template_of(*alone, map), shapes, query.with_line);
  if (bare && (alone->ink > much * all || alone->resemblance > 0.88)) return bare;
  const auto filled = on_lines(map, mask, shapes);
  // Crossings of lines and bars look like small filled markers, but hold little of the ink; patches
  // of a line lie little better than beside. A marker's whole worth is a fifth of its ink, at half
  // as good a fit beside.
  if (filled && recognise(filled->ink, {filled->shape}).second > 0.94 &&
      worth(map, *filled) > 0.2 * much * all)
    return filled;
  const auto drawn = search_drawn(map, query.shape ? shapes : common_shapes(), query.rivals);
  if (!query.shape) bare.reset();  // too little alike to tell its shape
  std::optional<Template> best;
  double most = -1;
  for (const auto& one : {drawn, filled, bare})
    if (const double now = one ? worth(map, *one) : -1; now > most) {
      best = one;
      most = now;
    }
  if (best) return best;
  if (alone) return template_of(*alone, map);
  // A shape without a name, or one that does not look like its name.
  if (auto group = best_group(pieces, map.coverage, query.among, query.among, 0.0)) {
    if (query.shape) group->shape = shapes.front();
    return template_of(*group, map);
  }
  return std::nullopt;
}

}  // namespace

std::optional<Template> learn(const InkMap& map, const MarkerQuery& query) {
  const auto shapes = candidates(query.shape);
  if (!query.sample.empty()) {
    auto shape = query.shape.value_or(recognise(query.sample, shapes).first);
    auto marker = make_template(query.sample, shape);
    // Its box holds a part of the line or bar too, which may be large beside the marker. Strokes
    // have no outline to tell these.
    if (!is_strokes(shape.outline)) marker = trimmed(marker, shapes, 0.4);
    if (query.reference)
      marker.reference =
          *query.reference - cv::Point2d(query.sample.cols / 2.0, query.sample.rows / 2.0);
    return marker;
  }
  const auto marker = found_template(map, query);
  return marker ? std::optional(reshaped(*marker, shapes)) : std::nullopt;
}

std::vector<std::optional<Template>> learn_all(const InkMap& map,
                                               const std::vector<MarkerQuery>& queries) {
  std::vector<std::optional<Template>> found(queries.size());
  std::vector<bool> sure(queries.size());
  InkMap left{map.coverage.clone(), map.unknown.clone()};
  for (;;) {
    std::vector<Template> own;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      if (sure[i]) continue;
      const auto marker = learn(left, queries[i]);
      if (!marker) continue;
      found[i] = marker;
      sure[i] =
          queries.size() == 1 || (looks_as_asked(*marker, queries[i]) && fits_well(left, *marker));
      if (sure[i]) own.push_back(*marker);
    }
    if (own.empty() || std::count(sure.begin(), sure.end(), false) == 0) return found;
    const auto taken = find_markers(left, own);
    for (std::size_t t = 0; t < own.size(); ++t)
      for (const auto& one : taken[t]) take_away(left, own[t], one.fit.origin);
  }
}

std::optional<Template> markers_on_line(const InkMap& map) {
  const double stroke = stroke_width(map.coverage);
  const auto marker = learn(map, {});
  // A cross has arms; a blurred dot looks like one without.
  const double least = marker && is_strokes(marker->shape.outline) ? 4 : 2;
  if (!marker || std::min(marker->box.width, marker->box.height) < least * stroke) return {};
  if (spread_of(marker->ink).height < 2 * stroke) return {};  // dashes
  auto found = find_markers(map, {*marker});
  drop_stretches(map, line_width(map.coverage), {*marker}, found);
  std::vector<double> scores;
  double on_line = 0;
  for (const auto& one : found[0]) {
    scores.push_back(one.fit.score);
    on_line += goes_on(map, *marker, one.fit.origin) ? 1 : 0;
  }
  if (scores.size() < 4 || on_line < 0.5 * static_cast<double>(scores.size())) return {};
  std::sort(scores.begin(), scores.end());
  const double ink = cv::sum(marker->ink)[0] * static_cast<double>(scores.size());
  if (scores[scores.size() / 2] < 0.75 || ink < 0.05 * cv::sum(map.coverage)[0]) return {};
  return marker;
}

}  // namespace bedscope::digitise
