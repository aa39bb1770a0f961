// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace bedscope::digitise {
namespace {

constexpr std::array<std::pair<std::string_view, Outline>, 14> names{{
    {"circle", Outline::circle},
    {"square", Outline::square},
    {"diamond", Outline::diamond},
    {"triangle", Outline::triangle},
    {"triangle_down", Outline::triangle_down},
    {"triangle_left", Outline::triangle_left},
    {"triangle_right", Outline::triangle_right},
    {"pentagon", Outline::pentagon},
    {"hexagon", Outline::hexagon},
    {"star", Outline::star},
    {"plus", Outline::plus},
    {"x", Outline::x},
    {"asterisk", Outline::asterisk},
    {"cross", Outline::cross},
}};

/// Other words, and the letters of matplotlib.
constexpr std::array<std::pair<std::string_view, Outline>, 24> aliases{{
    {"o", Outline::circle},
    {"disc", Outline::circle},
    {"dot", Outline::circle},
    {"s", Outline::square},
    {"box", Outline::square},
    {"d", Outline::diamond},
    {"rhombus", Outline::diamond},
    {"^", Outline::triangle},
    {"triangle_up", Outline::triangle},
    {"v", Outline::triangle_down},
    {"inverted_triangle", Outline::triangle_down},
    {"down_triangle", Outline::triangle_down},
    {"up_triangle", Outline::triangle},
    {"<", Outline::triangle_left},
    {">", Outline::triangle_right},
    {"p", Outline::pentagon},
    {"h", Outline::hexagon},
    {"*", Outline::star},
    {"+", Outline::plus},
    {"crosses", Outline::cross},
    {"circles", Outline::circle},
    {"squares", Outline::square},
    {"diamonds", Outline::diamond},
    {"triangles", Outline::triangle},
}};

using Polygon = std::vector<cv::Point2d>;

Polygon regular(int corners, double first, double every_other = 1) {
  Polygon polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = first + 2 * std::numbers::pi * i / corners;
    const double radius = i % 2 == 0 ? 1.0 : every_other;
    polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return polygon;
}

Polygon corners_of(Outline outline) {
  constexpr double up = -std::numbers::pi / 2;
  switch (outline) {
    case Outline::square:
      return {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    case Outline::diamond:
      return {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
    case Outline::triangle:
      return {{0, -1}, {1, 1}, {-1, 1}};
    case Outline::triangle_down:
      return {{0, 1}, {1, -1}, {-1, -1}};
    case Outline::triangle_left:
      return {{-1, 0}, {1, 1}, {1, -1}};
    case Outline::triangle_right:
      return {{1, 0}, {-1, 1}, {-1, -1}};
    case Outline::pentagon:
      return regular(5, up);
    case Outline::hexagon:
      return regular(6, up);
    case Outline::star:
      return regular(10, up, 0.382);
    default:
      return regular(64, 0);
  }
}

/// Scaled so that its own box is [-1, 1] in both directions.
Polygon in_unit_box(Polygon polygon) {
  cv::Point2d low = polygon[0], high = polygon[0];
  for (const auto& p : polygon) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  for (auto& p : polygon)
    p = {2 * (p.x - low.x) / (high.x - low.x) - 1, 2 * (p.y - low.y) / (high.y - low.y) - 1};
  return polygon;
}

constexpr int fine = 8;  // sub-pixels a pixel

void fill(cv::Mat& canvas, const Polygon& polygon, cv::Point2d centre, double sx, double sy,
          int value) {
  std::vector<cv::Point> corners;
  for (const auto& p : polygon)
    corners.emplace_back(cvRound(fine * (centre.x + sx * p.x) - 0.5),
                         cvRound(fine * (centre.y + sy * p.y) - 0.5));
  cv::fillPoly(canvas, std::vector<std::vector<cv::Point>>{corners}, cv::Scalar(value));
}

void stroke_line(cv::Mat& canvas, cv::Point2d from, cv::Point2d to, double width) {
  const cv::Point2d along = (to - from) / cv::norm(to - from);
  const cv::Point2d side = cv::Point2d(-along.y, along.x) * (width / 2);
  fill(canvas, {from + side, to + side, to - side, from - side}, {0, 0}, 1, 1, 255);
}

}  // namespace

std::optional<Shape> shape_of(std::string_view text) {
  std::string name;
  for (const char c : text)
    name +=
        c == ' ' || c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  Shape shape;
  const std::array<std::pair<std::string_view, Fill>, 5> fills{{{"open", Fill::open},
                                                                {"hollow", Fill::open},
                                                                {"empty", Fill::open},
                                                                {"filled", Fill::filled},
                                                                {"solid", Fill::filled}}};
  for (const auto& [word, kind] : fills) {
    if (name.starts_with(std::string(word) + "_")) {
      shape.fill = kind;
      name.erase(0, word.size() + 1);
    } else if (name.ends_with("_" + std::string(word))) {
      shape.fill = kind;
      name.erase(name.size() - word.size() - 1);
    }
  }
  for (const auto& [known, outline] : names)
    if (name == known) return Shape{outline, shape.fill};
  for (const auto& [known, outline] : aliases)
    if (name == known) return Shape{outline, shape.fill};
  return std::nullopt;
}

std::string name_of(const Shape& shape) {
  std::string name;
  for (const auto& [known, outline] : names)
    if (shape.outline == outline) name = known;
  if (shape.fill == Fill::open) return "open " + name;
  return shape.fill == Fill::filled ? "filled " + name : name;
}

std::vector<std::string_view> outline_names() {
  std::vector<std::string_view> all;
  for (const auto& [name, outline] : names) all.push_back(name);
  return all;
}

bool is_triangle(Outline outline) {
  return outline == Outline::triangle || outline == Outline::triangle_down ||
         outline == Outline::triangle_left || outline == Outline::triangle_right;
}

bool is_strokes(Outline outline) {
  return outline == Outline::plus || outline == Outline::x || outline == Outline::asterisk ||
         outline == Outline::cross;
}

bool is_proportioned(Outline outline, cv::Size2d box) {
  constexpr double rounding = 1.18;
  const bool lying = outline == Outline::triangle_left || outline == Outline::triangle_right;
  double narrowest = 1, widest = 1;
  if (outline == Outline::diamond) narrowest = 0.6;
  if (is_triangle(outline)) (lying ? narrowest : widest) = lying ? 0.87 : 1 / 0.87;
  const double ratio = box.width / box.height;
  return ratio > narrowest / rounding && ratio < widest * rounding;
}

double thickest_stroke(const Shape& shape) {
  if (is_strokes(shape.outline)) return 0.3;
  double inscribed = 0.5;  // its radius
  if (shape.outline == Outline::diamond) inscribed = 0.354;
  if (is_triangle(shape.outline)) inscribed = 0.289;
  return 0.7 * inscribed;
}

cv::Mat draw_shape(const Shape& shape, cv::Size2d box, double stroke, cv::Size size,
                   cv::Point2d off) {
  cv::Mat canvas = cv::Mat::zeros(size.height * fine, size.width * fine, CV_8U);
  const cv::Point2d centre(size.width / 2.0 + off.x, size.height / 2.0 + off.y);
  const double rx = box.width / 2, ry = box.height / 2;
  if (is_strokes(shape.outline)) {
    const bool upright = shape.outline != Outline::x, slanted = shape.outline != Outline::plus;
    if (upright) {
      stroke_line(canvas, centre - cv::Point2d(rx, 0), centre + cv::Point2d(rx, 0), stroke);
      stroke_line(canvas, centre - cv::Point2d(0, ry), centre + cv::Point2d(0, ry), stroke);
    }
    if (slanted) {
      const double in = stroke * 0.25;  // the box of a butt end is wider than its axis
      const cv::Point2d a(rx - in, ry - in), b(rx - in, in - ry);
      stroke_line(canvas, centre - a, centre + a, stroke);
      stroke_line(canvas, centre - b, centre + b, stroke);
    }
  } else {
    const auto polygon = in_unit_box(corners_of(shape.outline));
    fill(canvas, polygon, centre, rx, ry, 255);
    if (shape.fill == Fill::open) {
      // The inner edge: a stroke keeps its width along every side, so the outline shrinks about
      // the centre of its inscribed circle, by the ratio of the radii.
      double inscribed = std::min(rx, ry);
      cv::Point2d middle = centre;
      if (shape.outline == Outline::diamond) inscribed = rx * ry / std::hypot(rx, ry);
      if (is_triangle(shape.outline)) {
        const bool flat =
            shape.outline == Outline::triangle || shape.outline == Outline::triangle_down;
        const double base = flat ? 2 * rx : 2 * ry, height = flat ? 2 * ry : 2 * rx;
        inscribed = base * height / (base + 2 * std::hypot(base / 2, height));
        const double shift = height / 2 - inscribed;  // from the middle towards the base
        if (shape.outline == Outline::triangle) middle.y += shift;
        if (shape.outline == Outline::triangle_down) middle.y -= shift;
        if (shape.outline == Outline::triangle_left) middle.x += shift;
        if (shape.outline == Outline::triangle_right) middle.x -= shift;
      }
      const double inner = 1 - stroke / inscribed;
      if (inner > 0) {
        const cv::Point2d inner_centre = middle + (centre - middle) * inner;
        fill(canvas, polygon, inner_centre, rx * inner, ry * inner, 0);
      }
    }
  }
  cv::Mat coverage;
  cv::resize(canvas, canvas, size, 0, 0, cv::INTER_AREA);
  canvas.convertTo(coverage, CV_32F, 1 / 255.0);
  return coverage;
}

Reference reference_of(const Shape& shape, cv::Size2d box, double stroke, double known_to) {
  const auto outline = shape.outline;
  if (!is_triangle(outline)) return {{0, 0}, 0};
  const bool standing = outline == Outline::triangle || outline == Outline::triangle_down;
  const double width = standing ? box.width : box.height;
  const double height = standing ? box.height : box.width;
  // By how much the middle of the box lies off that of the path, towards the tip: half of how much
  // farther off the path the outer edges of the stroke meet at the tip, 1 / sin(26.57 degrees) of
  // half its thickness, than it reaches at the base.
  constexpr double mitre = 0.31;
  // A bar or a line in a small one's hole is not its stroke.
  double towards_base = mitre * std::min(stroke, thickest_stroke(shape) * width) / height;
  Reference reference;
  reference.uncertain = 0.2 * towards_base;  // as the thickness
  if (shape.fill == Fill::filled) {          // uniform between the extremes
    constexpr double least = -mitre / 12, most = mitre / 4;
    towards_base = (least + most) / 2;
    reference.uncertain = (most - least) / std::sqrt(12.0);
  }
  // Those of gnuplot lack the pixel at their base, equilateral ones, taken for one in four, an
  // eighth of their height; small ones may be either.
  const double lacks = width - height, equilateral_lacks = (1 - std::sqrt(3.0) / 2) * width;
  towards_base += std::clamp(lacks, 0.0, 1.0) / 2 / height;
  const double either = (1 + equilateral_lacks) / 2, apart = equilateral_lacks - 1;
  const double odds = std::exp((lacks - either) * apart / (known_to * known_to)) / 3;
  const double share = std::isinf(odds) ? 1 : odds / (1 + odds);
  const double between = 1.0 / 6 - towards_base;
  reference.uncertain = std::sqrt((1 - share) * reference.uncertain * reference.uncertain +
                                  share * 0.01 * 0.01 + share * (1 - share) * between * between);
  towards_base += share * between;
  switch (outline) {
    case Outline::triangle:
      reference.at = {0, towards_base};
      break;
    case Outline::triangle_down:
      reference.at = {0, -towards_base};
      break;
    case Outline::triangle_left:
      reference.at = {towards_base, 0};
      break;
    default:
      reference.at = {-towards_base, 0};
      break;
  }
  return reference;
}

}  // namespace bedscope::digitise
