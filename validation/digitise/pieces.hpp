// SPDX-License-Identifier: BSD-3-Clause
// Markers as pieces of ink: those that stand alone, and filled ones on thinner lines.
#pragma once

#include <optional>
#include <vector>

#include "validation/digitise/template.hpp"

namespace bedscope::digitise {

struct Piece {
  cv::Rect box;
  int area = 0;
  double ink = 0;
  double breadth = 0;  ///< across its longest direction, of a rectangle with its spread [px]
};

/// Pieces of one size and shape.
struct Group {
  std::vector<Piece> pieces;
  Piece clearest;  ///< the one that resembles its shape most
  Shape shape;
  double resemblance = 0, ink = 0;
};

/// Length and breadth of a rectangle, at any angle, that is spread as the ink of an image [px].
cv::Size2d spread_of(const cv::Mat& ink);

/// Connected pieces of `mask` of a marker's size, whole and not beside unknown pixels.
std::vector<Piece> pieces_of(const cv::Mat& mask, const InkMap& map);

/// The group of pieces of one size and shape that most likely are the markers: those that resemble
/// one of `shapes` more than any other of `among`, and of these the group with most ink.
std::optional<Group> best_group(const std::vector<Piece>& pieces, const cv::Mat& coverage,
                                const std::vector<Shape>& among, const std::vector<Shape>& shapes,
                                double least);

/// The template of a group: one of them, then the median of all.
Template template_of(const Group& group, const InkMap& map);

/// Filled markers on thinner lines and bars: what an opening of `mask` by a little more than the
/// stroke leaves.
std::optional<Template> on_lines(const InkMap& map, const cv::Mat& mask,
                                 const std::vector<Shape>& shapes);

}  // namespace bedscope::digitise
