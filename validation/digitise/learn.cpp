// SPDX-License-Identifier: BSD-3-Clause
// What the markers of an ink look like.
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>

#include "validation/digitise/markers.hpp"

namespace bedscope::digitise {
namespace {

struct Piece {
  cv::Rect box;
  int area = 0;
  double ink = 0;
};

/// Connected pieces of `mask` of a marker's size, whole and not beside unknown pixels.
std::vector<Piece> pieces_of(const cv::Mat& mask, const InkMap& map) {
  cv::Mat labels, stats, centres, near_unknown;
  const int n = cv::connectedComponentsWithStats(mask, labels, stats, centres, 8);
  cv::dilate(map.unknown, near_unknown, cv::Mat::ones(3, 3, CV_8U));
  const int largest = std::max(24, std::min(mask.cols, mask.rows) / 6);
  std::vector<int> touched(n);
  std::vector<double> ink(n);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (const int label = labels.at<int>(y, x); label > 0) {
        ink[label] += map.coverage.at<float>(y, x);
        touched[label] += near_unknown.at<uchar>(y, x) != 0;
      }
  std::vector<Piece> pieces;
  for (int i = 1; i < n; ++i) {
    const cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    if (touched[i] > 0.08 * stats.at<int>(i, cv::CC_STAT_AREA) ||
        std::min(box.width, box.height) < 4 || std::max(box.width, box.height) > largest ||
        std::max(box.width, box.height) > 2.0 * std::min(box.width, box.height))
      continue;
    pieces.push_back({box, stats.at<int>(i, cv::CC_STAT_AREA), ink[i]});
  }
  return pieces;
}

bool alike(const Piece& a, const Piece& b) {
  const auto near = [](double p, double q, double slack) { return std::abs(p - q) <= slack; };
  return near(a.box.width, b.box.width, std::max(1.5, 0.1 * a.box.width)) &&
         near(a.box.height, b.box.height, std::max(1.5, 0.1 * a.box.height)) &&
         near(a.ink, b.ink, 0.2 * a.ink + 2);
}

/// The patch of a piece, its box in the middle.
cv::Mat patch_of(const cv::Mat& coverage, const Piece& piece) {
  constexpr int margin = 2;
  const cv::Rect box(piece.box.x - margin, piece.box.y - margin, piece.box.width + 2 * margin,
                     piece.box.height + 2 * margin);
  cv::Mat patch = cv::Mat::zeros(box.size(), CV_32F);
  const cv::Rect there = box & cv::Rect(0, 0, coverage.cols, coverage.rows);
  coverage(there).copyTo(patch(there - box.tl()));
  return patch;
}

/// Pixel by pixel the median of windows of the map at the places where `marker` fits well: what is
/// not in most of them (lines, bars, neighbours) is gone, and so is noise.
cv::Mat typical(const InkMap& map, const Template& marker,
                const std::vector<cv::Point2d>& guesses) {
  std::vector<cv::Mat> windows;
  for (const auto guess : guesses) {
    if (windows.size() == 40) break;
    const auto found = fit(marker, map, guess);
    if (found.score < 0.5 || found.known < 0.95 || found.least_part < 0.5) continue;
    windows.push_back(window(map.coverage, found.origin, marker.ink.size(), 0));
  }
  if (windows.size() < 3) return {};
  cv::Mat median(marker.ink.size(), CV_32F);
  std::vector<float> values(windows.size());
  for (int y = 0; y < median.rows; ++y)
    for (int x = 0; x < median.cols; ++x) {
      for (std::size_t i = 0; i < windows.size(); ++i) values[i] = windows[i].at<float>(y, x);
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      median.at<float>(y, x) = std::clamp(*middle, 0.0F, 1.0F);
    }
  return median;
}

/// Nothing outside of the marker itself: what a median leaves of lines that always meet it.
void trim(cv::Mat& ink, const cv::Mat& inside) {
  cv::Mat outside;
  cv::bitwise_not(inside, outside);
  ink.setTo(0, outside);
}

cv::Mat without_margin(const cv::Mat& ink, int margin) {
  return ink(cv::Rect(margin, margin, ink.cols - 2 * margin, ink.rows - 2 * margin)).clone();
}

struct Group {
  std::vector<Piece> pieces;
  Shape shape;
  double resemblance = 0, ink = 0;
};

/// The group of pieces of one size and shape that most likely are the markers: those that resemble
/// one of the shapes, and of these the group with most ink.
std::optional<Group> best_group(const std::vector<Piece>& pieces, const cv::Mat& coverage,
                                const std::vector<Shape>& shapes, double least) {
  std::optional<Group> best;
  std::vector<bool> seen(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (seen[i]) continue;
    Group group;
    std::vector<std::pair<Shape, double>> verdicts;
    for (std::size_t j = i; j < pieces.size(); ++j)
      if (alike(pieces[i], pieces[j])) {
        const auto verdict = recognise(patch_of(coverage, pieces[j]), candidates(std::nullopt));
        const auto wanted = std::find_if(shapes.begin(), shapes.end(), [&](const Shape& shape) {
          return shape.outline == verdict.first.outline &&
                 (shape.fill == verdict.first.fill || shape.fill == Fill::any);
        });
        if (wanted == shapes.end()) continue;
        seen[j] = true;
        group.pieces.push_back(pieces[j]);
        group.ink += pieces[j].ink;
        verdicts.push_back(verdict);
      }
    if (verdicts.empty()) continue;
    std::nth_element(
        verdicts.begin(), verdicts.begin() + static_cast<std::ptrdiff_t>(verdicts.size() / 2),
        verdicts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    std::tie(group.shape, group.resemblance) = verdicts[verdicts.size() / 2];
    if (group.resemblance < least) continue;
    if (!best || group.ink > best->ink) best = group;
  }
  return best;
}

/// The template of a group: one of them, then the median of all.
Template template_of(const Group& group, const InkMap& map) {
  const auto& piece = group.pieces[group.pieces.size() / 2];
  Template marker = make_template(without_margin(patch_of(map.coverage, piece), 1), group.shape);
  std::vector<cv::Point2d> guesses;
  for (const auto& each : group.pieces)
    guesses.emplace_back(each.box.x + each.box.width / 2.0, each.box.y + each.box.height / 2.0);
  if (cv::Mat median = typical(map, marker, guesses); !median.empty()) {
    trim(median, marker.inside);
    marker = make_template(without_margin(median, 2), group.shape);
  }
  return marker;
}

/// Filled markers on thinner lines and bars: what an opening by a little more than the stroke
/// leaves.
std::optional<Template> on_lines(const InkMap& map, const cv::Mat& mask,
                                 const std::vector<Shape>& shapes) {
  const double stroke = stroke_width(map.coverage);
  for (const double factor : {1.5, 2.2}) {
    const int disc = 2 * cvRound(factor * stroke / 2 + 0.6) + 1;
    const cv::Mat element = cv::getStructuringElement(cv::MORPH_ELLIPSE, {disc, disc});
    cv::Mat opened, grown;
    cv::morphologyEx(mask, opened, cv::MORPH_OPEN, element);
    cv::dilate(opened, grown, cv::Mat::ones(3, 3, CV_8U));
    InkMap cores{map.coverage.clone(), map.unknown};
    cv::Mat rest;
    cv::bitwise_not(grown, rest);
    cores.coverage.setTo(0, rest);
    std::vector<Shape> filled;
    for (const auto& shape : shapes)
      if (shape.fill == Fill::filled) filled.push_back(shape);
    auto pieces = pieces_of(opened, cores);
    // Where strokes cross or turn they are thicker too, but not by much.
    std::erase_if(pieces, [&](const Piece& piece) {
      return std::min(piece.box.width, piece.box.height) < std::max(5.0, 2.6 * stroke);
    });
    const auto group = best_group(pieces, cores.coverage, filled, 0.8);
    if (!group || group->pieces.size() < 2) continue;
    auto marker = template_of(*group, cores);
    // Once more with the whole ink: the opening has rounded the corners.
    std::vector<cv::Point2d> guesses;
    for (const auto& each : group->pieces)
      guesses.emplace_back(each.box.x + each.box.width / 2.0, each.box.y + each.box.height / 2.0);
    if (cv::Mat median = typical(map, marker, guesses); !median.empty()) {
      trim(median, marker.inside);
      marker = make_template(without_margin(median, 2), group->shape);
    }
    return marker;
  }
  return std::nullopt;
}

/// Places where `drawn` correlates with the coverage better than `least`, none within half a box.
std::vector<std::pair<double, cv::Point2d>> peaks(const cv::Mat& coverage, const cv::Mat& drawn,
                                                  double least, double apart) {
  std::vector<std::pair<double, cv::Point2d>> found;
  if (drawn.cols >= coverage.cols || drawn.rows >= coverage.rows) return found;
  cv::Mat score, highest;
  cv::matchTemplate(coverage, drawn, score, cv::TM_CCOEFF_NORMED);
  const int reach = 2 * std::max(1, cvRound(apart / 2)) + 1;
  cv::dilate(score, highest, cv::Mat::ones(reach, reach, CV_8U));
  for (int y = 0; y < score.rows; ++y)
    for (int x = 0; x < score.cols; ++x) {
      const float s = score.at<float>(y, x);
      if (s > least && s < 1.01F && s >= highest.at<float>(y, x))
        found.emplace_back(s, cv::Point2d(x + drawn.cols / 2.0, y + drawn.rows / 2.0));
    }
  return found;
}

struct Guess {
  Shape shape;
  cv::Size2d box;
  double stroke = 1, worth = 0;
  std::vector<cv::Point2d> places;
};

/// Shapes and sizes that correlate with the map in several places, the best first. The markers'
/// strokes may be thinner than a line through them.
std::vector<Guess> rough_guesses(const InkMap& map, const std::vector<Shape>& shapes,
                                 double stroke) {
  const double largest = std::min(map.coverage.cols, map.coverage.rows) / 8.0;
  std::vector<Guess> guesses;
  for (double size = std::max(5.0, 3 * stroke); size < largest; size *= 1.15) {
    const double scale = std::min(1.0, 11 / size), box = size * scale;
    cv::Mat small;
    cv::resize(map.coverage, small, {}, scale, scale, cv::INTER_AREA);
    for (const auto& shape : shapes)
      for (const double narrow : {1.0, 0.75})
        for (const double thin : {1.0, 0.5}) {
          if (narrow < 1 && shape.outline != Outline::diamond) continue;
          if (thin < 1 && (stroke < 2 || shape.fill == Fill::filled)) continue;
          const cv::Size canvas(cvCeil(box) + 2, cvCeil(box) + 2);
          const auto drawn =
              draw_shape(shape, {box * narrow, box}, std::max(0.5, thin * stroke * scale), canvas);
          auto found = peaks(small, drawn, 0.55, 0.6 * box);
          if (found.size() < 2) continue;
          std::sort(found.begin(), found.end(),
                    [](const auto& a, const auto& b) { return a.first > b.first; });
          if (found.size() > 40) found.resize(40);
          Guess guess{shape, {size * narrow, size}, thin * stroke, 0, {}};
          for (const auto& [score, place] : found) {
            guess.worth += (score - 0.5) * (score - 0.5);
            guess.places.emplace_back(place / scale);
          }
          guesses.push_back(guess);
        }
  }
  std::sort(guesses.begin(), guesses.end(),
            [](const auto& a, const auto& b) { return a.worth > b.worth; });
  return guesses;
}

/// The best guess of each shape, stroke and range of sizes (small ones fit in many places, so that
/// the large would never have their turn), 80 at most.
std::vector<Guess> best_of_each(const std::vector<Guess>& guesses) {
  std::set<std::array<int, 4>> had;
  std::vector<Guess> best;
  for (const auto& guess : guesses)
    if (best.size() < 80 &&
        had.insert({static_cast<int>(guess.shape.outline), static_cast<int>(guess.shape.fill),
                    cvRound(4 * guess.stroke), cvRound(std::log(guess.box.height) / std::log(1.2))})
            .second)
      best.push_back(guess);
  return best;
}

/// The map at a size at which strokes are about three pixels wide.
InkMap coarse(const InkMap& map, double scale) {
  InkMap small;
  cv::resize(map.coverage, small.coverage, {}, scale, scale, cv::INTER_AREA);
  cv::resize(map.unknown, small.unknown, small.coverage.size(), 0, 0, cv::INTER_AREA);
  return small;
}

/// Drawn shapes of all sizes, for thin and open markers on lines and bars: the one that explains
/// most ink where it lies well. A smaller one of the same kind would lie as well, but explains
/// less.
std::optional<Template> by_search(const InkMap& map, const std::vector<Shape>& shapes) {
  const double full_stroke = std::max(1.0, stroke_width(map.coverage));
  const double scale = std::min(1.0, 3 / full_stroke), stroke = full_stroke * scale;
  const auto small = scale < 0.75 ? coarse(map, scale) : map;
  const double back = static_cast<double>(map.coverage.cols) / small.coverage.cols;
  const auto guesses = best_of_each(rough_guesses(small, shapes, stroke));
  double most = 0;
  const Guess* best = nullptr;
  for (const auto& guess : guesses) {
    const cv::Size canvas(cvCeil(guess.box.width) + 2, cvCeil(guess.box.height) + 2);
    const auto marker =
        make_template(draw_shape(guess.shape, guess.box, guess.stroke, canvas), guess.shape);
    const double ink = marker.ink.dot(marker.ink);
    double worth = 0;
    int good = 0;
    for (const auto& place : guess.places) {
      const auto found = fit(marker, small, place);
      if (found.score < 0.6 || found.known < 0.8 || found.least_part < 0.6) continue;
      worth += ink * (found.score - 0.5);
      ++good;
    }
    if (good < 2 || worth <= most) continue;
    most = worth;
    best = &guess;
  }
  if (best == nullptr) return std::nullopt;
  const cv::Size2d box = best->box * back;
  const cv::Size canvas(cvCeil(box.width) + 2, cvCeil(box.height) + 2);
  auto marker =
      make_template(draw_shape(best->shape, box, best->stroke * back, canvas), best->shape);
  std::vector<cv::Point2d> places;
  for (const auto& place : best->places) places.push_back(place * back);
  if (cv::Mat median = typical(map, marker, places); !median.empty()) {
    trim(median, marker.inside);
    marker = make_template(without_margin(median, 2), best->shape);
  }
  return marker;
}

/// What a search tries where the user names no shape.
std::vector<Shape> common_shapes() {
  std::vector<Shape> shapes{{Outline::plus, Fill::any}, {Outline::x, Fill::any}};
  for (const auto outline : {Outline::circle, Outline::square, Outline::diamond, Outline::triangle,
                             Outline::triangle_down}) {
    shapes.push_back({outline, Fill::filled});
    shapes.push_back({outline, Fill::open});
  }
  return shapes;
}

/// How much ink a template explains, and how well.
double worth(const InkMap& map, const Template& marker) {
  double sum = 0;
  const auto found = find_markers(map, {marker});
  for (const auto& one : found[0]) sum += marker.ink.dot(marker.ink) * (one.fit.score - 0.5);
  return sum;
}

}  // namespace

double stroke_width(const cv::Mat& coverage) {
  // Twice the distance to the paper along the ridges, by how often it occurs.
  cv::Mat mask, distance, highest;
  cv::compare(coverage, 0.4, mask, cv::CMP_GT);
  cv::distanceTransform(mask, distance, cv::DIST_L2, 5);
  cv::dilate(distance, highest, cv::Mat::ones(3, 3, CV_8U));
  std::vector<int> counts(64);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) {
      const float d = distance.at<float>(y, x);
      if (d > 0 && d >= highest.at<float>(y, x))
        ++counts[static_cast<std::size_t>(std::clamp(cvRound(2 * d - 1), 0, 63))];
    }
  return std::max(
      1.0, static_cast<double>(std::max_element(counts.begin(), counts.end()) - counts.begin()));
}

std::optional<Template> learn(const InkMap& map, const MarkerQuery& query) {
  const auto shapes = candidates(query.shape);
  if (!query.sample.empty()) {
    auto shape = query.shape.value_or(recognise(query.sample, shapes).first);
    auto marker = make_template(query.sample, shape);
    if (query.reference)
      marker.reference =
          *query.reference - cv::Point2d(query.sample.cols / 2.0, query.sample.rows / 2.0);
    return marker;
  }
  cv::Mat mask;
  cv::compare(map.coverage, 0.28, mask, cv::CMP_GT);
  const double all = cv::sum(map.coverage)[0];
  const auto pieces = pieces_of(mask, map);
  const auto alone = best_group(pieces, map.coverage, shapes, 0.8);
  if (alone && (alone->ink > 0.35 * all ||
                (alone->pieces.size() >= 3 && (query.shape || alone->resemblance > 0.88))))
    return template_of(*alone, map);
  const auto filled = on_lines(map, mask, shapes);
  if (filled && recognise(filled->ink, {filled->shape}).second > 0.94) return filled;
  const auto drawn = by_search(map, query.shape ? shapes : common_shapes());
  if (filled && drawn) return worth(map, *filled) > worth(map, *drawn) ? filled : drawn;
  if (filled) return filled;
  if (drawn) return drawn;
  if (alone) return template_of(*alone, map);
  // A shape without a name, or one that does not look like its name.
  if (auto group = best_group(pieces, map.coverage, candidates(std::nullopt), 0.0)) {
    if (query.shape) group->shape = shapes.front();
    return template_of(*group, map);
  }
  return std::nullopt;
}

}  // namespace bedscope::digitise
