// SPDX-License-Identifier: BSD-3-Clause
// The shapes of markers: their names, and their pictures as a plotting program draws them.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bedscope::digitise {

enum class Outline {
  circle,
  square,
  diamond,
  triangle,
  triangle_down,
  triangle_left,
  triangle_right,
  pentagon,
  hexagon,
  star,
  plus,
  x,
  asterisk,
  cross /* plus or x */
};
enum class Fill { any, filled, open };

struct Shape {
  Outline outline = Outline::circle;
  Fill fill = Fill::any;
};

/// "circle", "open triangle", "triangle_down", "filled square", "o", "^", ...; nothing where
/// unknown.
std::optional<Shape> shape_of(std::string_view name);
std::string name_of(const Shape& shape);
/// Every name of an outline, for messages.
std::vector<std::string_view> outline_names();

bool is_triangle(Outline outline);
bool is_strokes(Outline outline);  ///< plus, x, asterisk: no inside

/// Programs draw markers as wide as high, but for thin diamonds and flat triangles (an equilateral
/// one is 0.87 as high as wide); a small one is off by its whole pixels. A sliver of a bar or of a
/// line, that would explain more ink than a marker, is none.
bool is_proportioned(Outline outline, cv::Size2d box);

/// The thickest stroke of a marker as a share of its width. An open one has a hole of three tenths
/// of its inscribed circle or more; one without would lie as well as a filled one.
double thickest_stroke(const Shape& shape);

/// The outline (no cross) scaled to a width and height in pixels, filled or as a stroke whose outer
/// edge touches the box, drawn with anti-aliasing `off` the middle of an image of `size` pixels.
/// Returns coverage 0 to 1, CV_32F.
cv::Mat draw_shape(const Shape& shape, cv::Size2d box, double stroke, cv::Size size,
                   cv::Point2d off = {0, 0});

/// Where the data point is, from the middle of the box of a marker's ink, as a fraction of the
/// box's width and height (y down), with its standard uncertainty.
/// Triangles as wide as high (matplotlib, gnuplot) stand with the middle of their path on the
/// point. The box is that whose top is where the sides of the ink meet, whether the stroke's corner
/// reaches there (mitred) or not (round): 0.31 of the stroke's width farther than at the base.
/// `stroke` is that of an open marker [px]; of a filled one it is not seen: between a white edge of
/// a twelfth of the size and one of its own colour of a quarter (matplotlib's and gnuplot's have a
/// sixth by default, small markers and those of thick lines more). Those that lack a pixel of their
/// height lack it at the base (gnuplot); equilateral ones stand with their centre of mass on the
/// point. Where the box does not tell these the point is between, and that uncertain: the
/// difference of its sides is `known_to` so many pixels.
struct Reference {
  cv::Point2d at;
  double uncertain = 0;
};
Reference reference_of(const Shape& shape, cv::Size2d box, double stroke, double known_to = 0.4);

}  // namespace bedscope::digitise
