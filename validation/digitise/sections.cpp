// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/sections.hpp"

#include <algorithm>
#include <cmath>

namespace bedscope::digitise {
namespace {

constexpr double step = 0.5;  // between the samples of a section [px]

struct Section {
  double t = 0;                ///< along the line, from the passage
  double middle = 0, ink = 0;  ///< no ink: paper
};

cv::Point2d across(const Passage& passage) { return {-passage.along.y, passage.along.x}; }

/// Bilinear between the centres of pixels; nothing beside an unknown one or outside of the map.
std::optional<double> coverage_at(const InkMap& map, cv::Point2d p) {
  const double x = p.x - 0.5, y = p.y - 0.5;
  const int column = cvFloor(x), row = cvFloor(y);
  if (column < 0 || row < 0 || column + 1 >= map.coverage.cols || row + 1 >= map.coverage.rows)
    return std::nullopt;
  const double fx = x - column, fy = y - row;
  double sum = 0;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      if (map.unknown.at<uchar>(row + j, column + i) != 0) return std::nullopt;
      sum += (i == 0 ? 1 - fx : fx) * (j == 0 ? 1 - fy : fy) *
             map.coverage.at<float>(row + j, column + i);
    }
  return sum;
}

/// The unbroken ink that a section meets nearest to the passage, within half a stroke; nothing
/// where it meets an unknown pixel, or the ink does not end.
std::optional<Section> section_at(const InkMap& map, const Passage& passage, double t,
                                  double stroke) {
  constexpr double seen = 0.22;
  const cv::Point2d centre = passage.at + t * passage.along, side = across(passage);
  const auto ink = [&](int i) { return coverage_at(map, centre + i * step * side); };
  const int near = cvCeil((0.5 * stroke + 1) / step), far = cvCeil((2 * stroke + 2) / step);
  std::optional<int> start;
  for (int i = 0; i <= near && !start; ++i)
    for (const int at : {i, -i}) {
      const auto share = ink(at);
      if (!share) return std::nullopt;
      if (*share >= seen) start = at;
    }
  Section section;
  section.t = t;
  if (!start) return section;
  double moment = 0;
  for (const int way : {-1, 1}) {
    int faint = 0;  // two samples, one pixel, of the edge
    for (int i = way < 0 ? *start : *start + 1; faint < 2; i += way) {
      const auto share = ink(i);
      if (!share || std::abs(i) > far) return std::nullopt;
      faint += *share < seen || faint > 0;
      section.ink += *share * step;
      moment += *share * i * step * step;
    }
  }
  section.middle = moment / section.ink;
  return section;
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The parabola's value and slope at t = 0, and its standard uncertainty.
struct Parabola {
  double value = 0, slope = 0, u = 0;
};

Parabola parabola_through(const std::vector<Section>& sections) {
  cv::Matx33d normal = cv::Matx33d::zeros();
  cv::Vec3d right(0, 0, 0);
  for (const auto& [t, middle, ink] : sections) {
    const cv::Vec3d row(1, t, t * t);
    normal += row * row.t();
    right += row * middle;
  }
  const cv::Matx33d inverse = normal.inv(cv::DECOMP_SVD);
  const cv::Vec3d c = inverse * right;
  double squares = 0;
  for (const auto& [t, middle, ink] : sections)
    squares += std::pow(middle - c[0] - c[1] * t - c[2] * t * t, 2);
  const double rms = std::sqrt(squares / std::max(1.0, static_cast<double>(sections.size()) - 3));
  return {c[0], c[1], rms / std::sqrt(static_cast<double>(sections.size()) / 3)};
}

}  // namespace

Thickness thickness_of(const InkMap& map, const std::vector<Passage>& passages, double stroke) {
  std::vector<double> inks;
  for (const auto& passage : passages)
    if (const auto section = section_at(map, passage, 0, stroke); section && section->ink > 0)
      inks.push_back(section->ink);
  if (inks.empty()) return {};
  const double typical = median(inks);
  for (auto& ink : inks) ink = std::abs(ink - typical);
  const double allowed = std::max(0.2, 3 * 1.48 * median(inks));
  return {typical - allowed, typical + allowed};
}

std::optional<PlaceOnLine> place_across(const InkMap& map, const Passage& near, double stroke,
                                        const Thickness& thickness) {
  const int reach = std::max(2, cvRound(stroke));
  Passage passage = near;
  double u = 0;
  for (int round = 0; round < 3; ++round) {
    std::vector<Section> sections, line;
    bool whole = true;  // from paper to paper, and nothing but the line between
    for (int t = -reach; t <= reach; ++t) {
      const auto section = section_at(map, passage, t, stroke);
      if (!section || section->ink > thickness.most) {
        whole = false;
        continue;
      }
      sections.push_back(*section);
      if (section->ink > thickness.least) line.push_back(*section);
    }
    if (line.size() >= 4 && line.back().t - line.front().t >= stroke) {
      const auto parabola = parabola_through(line);
      u = parabola.u;
      passage.at += parabola.value * across(passage);
      passage.along += parabola.slope * across(passage);
      passage.along /= cv::norm(passage.along);
    } else {
      const bool dot = whole && sections.front().ink == 0 && sections.back().ink == 0;
      if (!dot && line.size() < 2) return std::nullopt;
      double ink = 0;
      cv::Point2d moment;
      for (const auto& section : dot ? sections : line) {
        ink += section.ink;
        moment += section.ink * cv::Point2d(section.t, section.middle);
      }
      if (ink == 0) return std::nullopt;
      moment /= ink;
      double squares = 0;
      for (const auto& section : line) squares += std::pow(section.middle - moment.y, 2);
      u = dot ? 0 : std::sqrt(squares / static_cast<double>(line.size()));
      passage.at += moment.x * passage.along + moment.y * across(passage);
    }
    if (cv::norm(passage.at - near.at) > stroke + 1) return std::nullopt;
  }
  return PlaceOnLine{passage, u};
}

}  // namespace bedscope::digitise
