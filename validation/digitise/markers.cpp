// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/markers.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace bedscope::digitise {
namespace {

constexpr double least_known = 0.35;
constexpr double least_known_well = 0.25;  ///< of half a marker at the plot's edge, less the frame
constexpr double least_ink = 0.45;         // of each eighth
constexpr double about_as_well = 0.02;

/// Where a template may lie, coarsely: peaks of the correlation at a size of a dozen pixels.
std::vector<cv::Point2d> guesses(const InkMap& map, const Template& marker) {
  const double scale =
      std::min(1.0, 14 / std::max(4.0, std::max(marker.box.width, marker.box.height)));
  cv::Mat coverage, drawn;
  cv::resize(map.coverage, coverage, {}, scale, scale, cv::INTER_AREA);
  cv::resize(marker.ink, drawn, {}, scale, scale, cv::INTER_AREA);
  std::vector<cv::Point2d> found;
  if (drawn.cols >= coverage.cols || drawn.rows >= coverage.rows) return found;
  // Markers reach over the edge of the plot.
  const int border = drawn.cols;
  cv::copyMakeBorder(coverage, coverage, border, border, border, border, cv::BORDER_CONSTANT,
                     cv::Scalar(0));
  cv::Mat score, highest;
  cv::matchTemplate(coverage, drawn, score, cv::TM_CCOEFF_NORMED);
  cv::dilate(score, highest, cv::Mat::ones(3, 3, CV_8U));
  const double fx = static_cast<double>(map.coverage.cols) / (coverage.cols - 2 * border);
  const double fy = static_cast<double>(map.coverage.rows) / (coverage.rows - 2 * border);
  for (int y = 0; y < score.rows; ++y)
    for (int x = 0; x < score.cols; ++x) {
      const float s = score.at<float>(y, x);
      if (s > 0.35F && s < 1.01F && s >= highest.at<float>(y, x))
        found.emplace_back((x - border + drawn.cols / 2.0) * fx,
                           (y - border + drawn.rows / 2.0) * fy);
    }
  return found;
}

struct Candidate {
  std::size_t which;
  Fit fit;
};

double worth(const Fit& fit) { return fit.score * std::sqrt(fit.known); }

/// The good fits near `places` of template `which`.
void add_candidates(std::vector<Candidate>& candidates, const InkMap& map, const Template& marker,
                    std::size_t which, const std::vector<cv::Point2d>& places) {
  for (const auto place : places)
    if (const auto here = fit(marker, map, place); is_marker(here))
      candidates.push_back({which, here});
}

std::vector<std::vector<Marker>> best_first(const InkMap& map,
                                            const std::vector<Template>& templates,
                                            std::vector<Candidate> candidates) {
  std::vector<std::vector<Marker>> found(templates.size());
  std::sort(candidates.begin(), candidates.end(),
            [](const auto& a, const auto& b) { return worth(a.fit) > worth(b.fit); });
  InkMap left{map.coverage.clone(), map.unknown.clone()};
  for (const auto& candidate : candidates) {
    const auto& marker = templates[candidate.which];
    const double size = std::max(marker.box.width, marker.box.height);
    bool taken = false;
    for (std::size_t t = 0; t < templates.size(); ++t)
      for (const auto& other : found[t])
        taken = taken || cv::norm(other.fit.origin - candidate.fit.origin) < 0.25 * size;
    if (taken) continue;
    // Again on what is left; alone, nothing has changed for it.
    const auto again = fit(marker, left, candidate.fit.origin);
    if (!is_marker(again) || cv::norm(again.origin - candidate.fit.origin) > 0.3 * size) continue;
    auto one = marker_at(marker, again);
    one.doubted = std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& other) {
      return other.which != candidate.which &&
             cv::norm(other.fit.origin - candidate.fit.origin) < 0.5 * size &&
             worth(other.fit) > worth(candidate.fit) - about_as_well;
    });
    found[candidate.which].push_back(one);
    take_away(left, marker, again.origin);
  }
  return found;
}

}  // namespace

Marker marker_at(const Template& marker, const Fit& fit) {
  Marker one{fit, fit.origin + marker.reference};
  for (int axis = 0; axis < 2; ++axis)
    one.u[axis] = std::hypot(fit.u[axis], marker.reference_u[axis]);
  return one;
}

void take_away(InkMap& map, const Template& marker, cv::Point2d origin) {
  const cv::Size size = marker.ink.size();
  const cv::Point middle(cvFloor(origin.x), cvFloor(origin.y));
  const cv::Rect wanted(middle.x - size.width / 2, middle.y - size.height / 2, size.width,
                        size.height);
  const cv::Rect there = wanted & cv::Rect(0, 0, map.coverage.cols, map.coverage.rows);
  if (there.empty()) return;
  const cv::Mat ink = laid(marker, origin, middle)(there - wanted.tl());
  map.unknown(there).setTo(255, ink > 0.15F);
  map.coverage(there).setTo(0, ink > 0.15F);
}

bool lies_well(const Fit& fit) {
  return fit.score > least_score &&
         (fit.least_part > least_ink || (fit.next_part > least_ink && fit.score > well));
}

bool is_marker(const Fit& fit) {
  return lies_well(fit) && fit.known > (fit.score > well ? least_known_well : least_known);
}

std::vector<std::vector<Marker>> find_markers(const InkMap& map,
                                              const std::vector<Template>& templates) {
  std::vector<Candidate> candidates;
  for (std::size_t t = 0; t < templates.size(); ++t)
    add_candidates(candidates, map, templates[t], t, guesses(map, templates[t]));
  return best_first(map, templates, std::move(candidates));
}

std::vector<Marker> markers_near(const InkMap& map, const Template& marker,
                                 const std::vector<cv::Point2d>& places) {
  std::vector<Candidate> candidates;
  add_candidates(candidates, map, marker, 0, places);
  return best_first(map, {marker}, std::move(candidates)).front();
}

double little_alike(const std::vector<Marker>& markers) {
  if (markers.size() < 4) return 0;
  std::vector<double> scores;
  for (const auto& marker : markers) scores.push_back(marker.fit.score);
  std::sort(scores.begin(), scores.end());
  return (least_score + scores[scores.size() / 2]) / 2;
}

std::vector<cv::Point2d> incomplete_markers(const InkMap& rest,
                                            const std::vector<Template>& templates) {
  std::vector<cv::Point2d> places;
  for (const auto& marker : templates) {
    const double size = std::max(marker.box.width, marker.box.height);
    for (const auto guess : guesses(rest, marker)) {
      const auto here = fit(marker, rest, guess);
      const bool had = std::any_of(places.begin(), places.end(), [&](cv::Point2d other) {
        return cv::norm(other - here.origin) < size;
      });
      if (!had && here.score > least_score && here.known > least_known &&
          here.least_part > least_ink / 2)
        places.push_back(here.origin);
    }
  }
  return places;
}

}  // namespace bedscope::digitise
