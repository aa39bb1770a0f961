// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <tuple>

#include "validation/digitise/markers.hpp"
#include "validation/digitise/stroke.hpp"
#include "validation/digitise/typical.hpp"

namespace bedscope::digitise {
namespace {

bool alike(const Piece& a, const Piece& b) {
  const auto near = [](double p, double q, double slack) { return std::abs(p - q) <= slack; };
  return near(a.box.width, b.box.width, std::max(1.5, 0.1 * a.box.width)) &&
         near(a.box.height, b.box.height, std::max(1.5, 0.1 * a.box.height)) &&
         near(a.ink, b.ink, 0.2 * a.ink + 2);
}

/// The patch of a piece, its box in the middle.
cv::Mat patch_of(const cv::Mat& coverage, const Piece& piece) {
  constexpr int margin = 1;
  const cv::Rect box(piece.box.x - margin, piece.box.y - margin, piece.box.width + 2 * margin,
                     piece.box.height + 2 * margin);
  cv::Mat patch = cv::Mat::zeros(box.size(), CV_32F);
  const cv::Rect there = box & cv::Rect(0, 0, coverage.cols, coverage.rows);
  coverage(there).copyTo(patch(there - box.tl()));
  return patch;
}

std::vector<cv::Point2d> middles_of(const Group& group) {
  std::vector<cv::Point2d> middles;
  for (const auto& piece : group.pieces)
    middles.emplace_back(piece.box.x + piece.box.width / 2.0, piece.box.y + piece.box.height / 2.0);
  return middles;
}

}  // namespace

cv::Size2d spread_of(const cv::Mat& ink) {
  const auto m = cv::moments(ink);
  const double half = (m.mu20 + m.mu02) / 2;
  const double apart = std::hypot((m.mu20 - m.mu02) / 2, m.mu11);
  return {std::sqrt(12 * (half + apart) / m.m00),
          std::sqrt(12 * std::max(0.0, half - apart) / m.m00)};
}

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
    cv::Mat own = cv::Mat::zeros(box.size(), CV_32F);
    map.coverage(box).copyTo(own, labels(box) == i);
    pieces.push_back({box, stats.at<int>(i, cv::CC_STAT_AREA), ink[i], spread_of(own).height});
  }
  return pieces;
}

std::optional<Group> best_group(const std::vector<Piece>& pieces, const cv::Mat& coverage,
                                const std::vector<Shape>& among, const std::vector<Shape>& shapes,
                                double least) {
  std::optional<Group> best;
  std::vector<bool> seen(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (seen[i]) continue;
    Group group;
    std::vector<std::pair<Shape, double>> verdicts;
    double most = -1;
    for (std::size_t j = i; j < pieces.size(); ++j)
      if (alike(pieces[i], pieces[j])) {
        const auto verdict = recognise(patch_of(coverage, pieces[j]), among);
        const auto wanted = std::find_if(shapes.begin(), shapes.end(), [&](const Shape& shape) {
          return shape.outline == verdict.first.outline &&
                 (shape.fill == verdict.first.fill || shape.fill == Fill::any);
        });
        if (wanted == shapes.end()) continue;
        seen[j] = true;
        group.pieces.push_back(pieces[j]);
        group.ink += pieces[j].ink;
        verdicts.push_back(verdict);
        if (verdict.second <= most) continue;
        most = verdict.second;
        group.clearest = pieces[j];
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

Template template_of(const Group& group, const InkMap& map) {
  const auto marker = make_template(patch_of(map.coverage, group.clearest), group.shape);
  return typical(map, marker, middles_of(group)).value_or(marker);
}

std::optional<Template> on_lines(const InkMap& map, const cv::Mat& mask,
                                 const std::vector<Shape>& shapes) {
  const double stroke = line_width(map.coverage);
  std::vector<Shape> filled;
  for (const auto& shape : shapes)
    if (shape.fill == Fill::filled) filled.push_back(shape);
  // Bars may be thicker than the line: the first opening that leaves a clear shape, else the one
  // that leaves the clearest. A larger one cuts corners.
  std::optional<Group> best;
  std::optional<Template> whole;
  for (const double factor : {1.5, 2.2, 3.2, 4.6}) {
    const int disc = 2 * cvRound(factor * stroke / 2 + 0.6) + 1;
    const cv::Mat element = cv::getStructuringElement(cv::MORPH_ELLIPSE, {disc, disc});
    cv::Mat opened, grown;
    cv::morphologyEx(mask, opened, cv::MORPH_OPEN, element);
    cv::dilate(opened, grown, cv::Mat::ones(3, 3, CV_8U));
    InkMap cores{map.coverage.clone(), map.unknown};
    cv::Mat rest;
    cv::bitwise_not(grown, rest);
    cores.coverage.setTo(0, rest);
    auto pieces = pieces_of(opened, cores);
    // Where strokes cross or turn they are thicker too, but not by much.
    std::erase_if(pieces, [&](const Piece& piece) {
      return std::min(piece.box.width, piece.box.height) < std::max(5.0, 2.6 * stroke);
    });
    const auto group = best_group(pieces, cores.coverage, candidates(std::nullopt), filled, 0.8);
    if (!group || group->pieces.size() < 2 || (best && group->resemblance <= best->resemblance))
      continue;
    const auto core = template_of(*group, cores);
    // Once more with the whole ink: the opening has rounded the corners.
    const auto marker = trimmed(typical(map, core, middles_of(*group)).value_or(core), filled);
    // A piece of its line is left on it.
    if (!is_proportioned(marker.shape.outline, marker.box)) continue;
    best = group;
    whole = marker;
    if (best->resemblance > 0.95) break;
  }
  if (!best) return std::nullopt;
  // What lies in many more places than the opening left, and there not much better than beside, is
  // a stretch of a line.
  const auto found = find_markers(map, {*whole})[0];
  double better = 0;
  for (const auto& one : found)
    better += distinct(*whole, map, one.fit) / static_cast<double>(found.size());
  if (found.size() > 4 * best->pieces.size() && better < 0.3) return std::nullopt;
  return whole;
}
}  // namespace bedscope::digitise
