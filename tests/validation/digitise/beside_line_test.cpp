// SPDX-License-Identifier: BSD-3-Clause
// Markers beside, on and under a line of their ink.
#include "validation/digitise/beside_line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tests/validation/digitise/drawn_stroke.hpp"
#include "validation/digitise/lines_among_markers.hpp"

namespace bedscope::digitise {
namespace {

const cv::Size plot(420, 240);

cv::Mat drawn(const Shape& shape, double size, double stroke, cv::Point2d at) {
  return draw_shape(shape, {size, size}, stroke, plot,
                    {at.x - plot.width / 2.0, at.y - plot.height / 2.0});
}

/// A line from left to right of `width` pixels, and markers over it.
struct Scene {
  InkMap map{cv::Mat::zeros(plot, CV_32F), cv::Mat::zeros(plot, CV_8U)};
  TracedLine line;
  Template marker;
};

Scene scene(const Shape& shape, double size, double stroke, double width,
            const std::vector<cv::Point2d>& at) {
  Scene made;
  const cv::Point2d left(10, 160.3), right(410, 80.3);
  made.map.coverage = drawn_stroke(left, right, width, plot);
  for (const auto place : at)
    made.map.coverage = cv::max(made.map.coverage, drawn(shape, size, stroke, place));
  for (int i = 0; i <= 20; ++i) made.line.points.push_back({left + i / 20.0 * (right - left), 0.1});
  made.line.first = left;
  made.line.last = right;
  made.line.stroke = width;
  const cv::Size canvas(cvCeil(size) + 2, cvCeil(size) + 2);
  made.marker = make_template(draw_shape(shape, {size, size}, stroke, canvas), shape);
  return made;
}

Marker placed(const Scene& made, cv::Point2d at) {
  return marker_at(made.marker, seen_at(made.marker, made.map, at - made.marker.reference));
}

TEST(BesideLine, AFilledMarkerThatALineDrewOverGoesBackToItsEdges) {
  const cv::Point2d at(200.4, 131.2);  // the line touches its upper edge
  const auto made = scene({Outline::square, Fill::filled}, 13, 1, 6, {at});
  const auto again =
      beside_line(made.map, {made.line}, {made.marker}, {{placed(made, at - cv::Point2d(0, 3.5))}});
  ASSERT_EQ(again[0].size(), 1U);
  EXPECT_NEAR(again[0][0].at.x, at.x, 0.1);
  EXPECT_NEAR(again[0][0].at.y, at.y, 0.1);
}

TEST(BesideLine, MarkersOfAThinStrokeUnderAThickLineAreFound) {
  std::vector<cv::Point2d> at;
  for (const double x : {60.2, 170.6, 301.4}) at.emplace_back(x, 162.3 - 0.2 * x);
  const auto made = scene({Outline::circle, Fill::open}, 19, 1.6, 7, at);
  const auto again = beside_line(made.map, {made.line}, {made.marker}, {{}});
  ASSERT_EQ(again[0].size(), at.size());
  for (const auto& one : again[0])
    EXPECT_TRUE(std::any_of(at.begin(), at.end(), [&](cv::Point2d place) {
      return cv::norm(one.at - place) < 0.2;
    })) << one.at;
}

TEST(BesideLine, ADoubtedMarkerGoesToTheTemplateThatLiesBetterWithoutTheLine) {
  const cv::Point2d at(200.4, 131.2);
  const Shape diamond{Outline::diamond, Fill::filled},
      triangle{Outline::triangle_down, Fill::filled};
  const auto made = scene(diamond, 15, 1, 6, {at});
  const std::vector<Template> templates{
      made.marker, make_template(draw_shape(triangle, {15, 15}, 1, {17, 17}), triangle)};
  auto taken = marker_at(templates[1], fit(templates[1], made.map, at));
  EXPECT_EQ(beside_line(made.map, {made.line}, templates, {{}, {taken}})[1].size(), 1U);
  taken.doubted = true;
  const auto again = beside_line(made.map, {made.line}, templates, {{}, {taken}});
  ASSERT_EQ(again[0].size(), 1U);
  EXPECT_NEAR(again[0][0].at.y, at.y, 0.2);
  EXPECT_TRUE(again[1].empty());
}

TEST(BesideLine, WhatTheLineCoversStaysWhereItWas) {
  const cv::Point2d at(200.4, 122.2);
  const auto made = scene({Outline::circle, Fill::filled}, 7, 1, 7, {at});
  const auto again = beside_line(made.map, {made.line}, {made.marker}, {{placed(made, at)}});
  ASSERT_EQ(again[0].size(), 1U);
  EXPECT_EQ(again[0][0].at, at);
}

TEST(LinesAmong, MarkersThatNobodyAskedForAndNoBars) {
  const Shape box{Outline::square, Fill::filled}, disc{Outline::circle, Fill::filled};
  std::vector<cv::Point2d> boxes, discs;
  for (const double x : {60.2, 130.6, 200.4, 270.1, 340.7}) {
    boxes.emplace_back(x, 162.3 - 0.2 * x);
    discs.emplace_back(x + 20, 50 - 0.05 * x);
  }
  auto made = scene(box, 13, 1, 3, boxes);
  const auto other = scene(disc, 15, 1, 3, {});
  for (const auto at : discs)
    made.map.coverage = cv::max(made.map.coverage, drawn(disc, 15, 1, at));
  std::vector<std::vector<Marker>> found(2);
  for (const auto at : boxes) found[0].push_back(placed(made, at));
  for (const auto at : discs)
    found[1].push_back(marker_at(other.marker, fit(other.marker, made.map, at)));
  const std::vector<Template> both{made.marker, other.marker};
  EXPECT_EQ(lines_among(made.map, both, found, 0).size(), 1U);
  auto two = made.map;
  two.coverage = cv::max(two.coverage, drawn_stroke({80.2, 47.0}, {360.7, 33.0}, 3, plot));
  EXPECT_EQ(lines_among(two, both, found, 0).size(), 2U);
  // What stands beside the markers, as bars of another series, is no line.
  InkMap bars{cv::Mat::zeros(plot, CV_32F), made.map.unknown};
  for (const auto at : boxes) {
    bars.coverage = cv::max(bars.coverage, drawn(box, 13, 1, at));
    bars.coverage = cv::max(
        bars.coverage, drawn_stroke(at + cv::Point2d(8, -40), at + cv::Point2d(8, 40), 3, plot));
  }
  EXPECT_TRUE(lines_among(bars, {made.marker}, {found[0]}, 0).empty());
}

TEST(Stretches, LieAsWellFartherAlongWhereOtherCurvesHideTheirSides) {
  const Shape disc{Outline::circle, Fill::filled};
  auto made = scene(disc, 13, 1, 6, {});
  cv::Mat sides = drawn_stroke({150, 132.3}, {250, 112.3}, 26, plot) > 0.5F;
  sides.setTo(0, drawn_stroke({150, 132.3}, {250, 112.3}, 5, plot) > 0.5F);
  made.map.unknown.setTo(255, sides);
  std::vector<std::vector<Marker>> found{{placed(made, {200.2, 122.3})}};
  ASSERT_TRUE(is_marker(found[0][0].fit));
  drop_stretches(made.map, 6, {made.marker}, found);
  EXPECT_TRUE(found[0].empty());
}

TEST(Stretches, EndsOfDashesAreNoPaleCrosses) {
  const Shape x{Outline::x, Fill::any};
  InkMap map{drawn_stroke({180, 120.3}, {203, 117.8}, 5, plot), cv::Mat::zeros(plot, CV_8U)};
  cv::GaussianBlur(map.coverage, map.coverage, {}, 0.8);
  cv::Mat ink = draw_shape(x, {10, 10}, 3.5, {16, 16}) * 0.75;
  cv::GaussianBlur(ink, ink, {}, 1.0);
  const auto marker = make_template(ink, x);
  std::vector<std::vector<Marker>> found(1);
  for (double at = 182; at < 202; at += 1)
    if (const auto here = fit(marker, map, {at, 142 - 0.12 * at});
        is_marker(here) && distinct(marker, map, here) > 0)
      found[0].push_back(marker_at(marker, here));
  ASSERT_FALSE(found[0].empty());
  drop_stretches(map, 5, {marker}, found);
  EXPECT_TRUE(found[0].empty());
}

TEST(Stretches, OfALineAreDroppedAndMarkersOnItStay) {
  const std::vector<cv::Point2d> at{{60.2, 150.3}, {170.6, 128.2}, {301.4, 102.0}, {240.5, 60.2}};
  for (const Shape shape : {Shape{Outline::x, Fill::any}, Shape{Outline::circle, Fill::filled},
                            Shape{Outline::diamond, Fill::open}}) {
    const auto made = scene(shape, 13, 3, 4, at);
    std::vector<std::vector<Marker>> found(1);
    for (const auto place : at) found[0].push_back(placed(made, place));
    for (const double x : {100.3, 140.2, 350.4})
      found[0].push_back(placed(made, {x, 162.3 - 0.2 * x}));
    drop_stretches(made.map, 4, {made.marker}, found);
    ASSERT_EQ(found[0].size(), at.size()) << name_of(shape);
    for (std::size_t i = 0; i < at.size(); ++i)
      EXPECT_LT(cv::norm(found[0][i].at - at[i]), 0.3) << name_of(shape);
  }
}

}  // namespace
}  // namespace bedscope::digitise
