// SPDX-License-Identifier: BSD-3-Clause
// What markers look like, and where they are: ink drawn here, with lines and bars of the same ink.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tests/validation/digitise/drawn_stroke.hpp"
#include "validation/digitise/error_bars.hpp"
#include "validation/digitise/markers.hpp"

namespace bedscope::digitise {
namespace {

constexpr int rows = 240, columns = 420;

InkMap empty() {
  return {cv::Mat::zeros(rows, columns, CV_32F), cv::Mat::zeros(rows, columns, CV_8U)};
}

/// Lays ink over what is there.
void add(InkMap& map, const cv::Mat& ink) { map.coverage = cv::max(map.coverage, ink); }

cv::Mat marker_at(const Shape& shape, double size, double stroke, cv::Point2d at) {
  return draw_shape(shape, {size, size}, stroke, {columns, rows},
                    {at.x - columns / 2.0, at.y - rows / 2.0});
}

cv::Mat stroke_from(cv::Point2d a, cv::Point2d b, double width) {
  return drawn_stroke(a, b, width, {columns, rows});
}

/// An upright bar from `length` above to `length` below, with caps.
void add_bar(InkMap& map, cv::Point2d at, double length, double width, double cap) {
  add(map, stroke_from({at.x, at.y - length}, {at.x, at.y + length}, width));
  for (const double way : {-1.0, 1.0})
    add(map,
        stroke_from({at.x - cap, at.y + way * length}, {at.x + cap, at.y + way * length}, width));
}

/// Not all at the same fraction of a pixel, and not in line.
std::vector<cv::Point2d> places(int n) {
  std::vector<cv::Point2d> at;
  for (int i = 0; i < n; ++i) at.emplace_back(30.2 + 43.3 * i, 120.4 + 45 * std::sin(0.8 * i));
  return at;
}

void expect_found(const InkMap& map, const std::vector<cv::Point2d>& at, Outline outline, Fill fill,
                  double size) {
  const auto marker = learn(map, {});
  ASSERT_TRUE(marker);
  EXPECT_EQ(name_of(marker->shape), name_of({outline, fill}));
  EXPECT_NEAR(marker->box.width, size, 1.5);
  EXPECT_NEAR(marker->box.height, size, 1.5);
  const auto found = find_markers(map, {*marker})[0];
  ASSERT_EQ(found.size(), at.size());
  for (const auto& place : at)
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const Marker& one) {
      return cv::norm(one.at - place) < 0.4;
    })) << place;
}

TEST(Learn, OpenMarkersThatHideAThickLineOfTheirInk) {
  auto map = empty();
  const auto at = places(9);
  for (std::size_t i = 1; i < at.size(); ++i) add(map, stroke_from(at[i - 1], at[i], 7));
  for (const auto place : at) add_bar(map, place, 22, 2, 5);
  for (const auto place : at) {
    map.coverage.setTo(0, marker_at({Outline::circle, Fill::filled}, 15, 1, place) > 0.5F);
    add(map, marker_at({Outline::circle, Fill::open}, 15, 2.5, place));
  }
  expect_found(map, at, Outline::circle, Fill::open, 15);
}

/// Markers with bars of `width` through them.
InkMap with_bars(const std::vector<cv::Point2d>& at, const Shape& shape, double size, double stroke,
                 double length, double width, double cap) {
  auto map = empty();
  for (const auto place : at) {
    add(map, marker_at(shape, size, stroke, place));
    add_bar(map, place, length, width, cap);
  }
  return map;
}

TEST(Learn, OpenMarkersThroughWhichBarsGo) {
  const auto at = places(6);
  const Shape square{Outline::square, Fill::open};
  expect_found(with_bars(at, square, 16, 2.5, 20, 3, 0), at, square.outline, square.fill, 16);
}

TEST(Learn, CrossesWithBarsAreNoTriangles) {
  const auto at = places(8);
  const Shape x{Outline::x, Fill::any};
  expect_found(with_bars(at, x, 15, 3, 30, 2.5, 6), at, x.outline, x.fill, 15);
}

TEST(Learn, BlurredOutlinesThatStandAlone) {
  auto map = empty();
  const auto at = places(8);
  for (const auto place : at)
    add(map, marker_at({Outline::triangle_right, Fill::open}, 19, 1.2, place));
  cv::GaussianBlur(map.coverage, map.coverage, {}, 1.0);
  expect_found(map, at, Outline::triangle_right, Fill::open, 19);
}

TEST(Learn, OutlinesSoThinThatABlurCoversNoPixelByHalf) {
  auto map = empty();
  const auto at = places(9);
  for (const auto place : at) add(map, marker_at({Outline::circle, Fill::open}, 14, 0.8, place));
  cv::GaussianBlur(map.coverage, map.coverage, {}, 0.9);
  ASSERT_LT(*std::max_element(map.coverage.begin<float>(), map.coverage.end<float>()), 0.5F);
  expect_found(map, at, Outline::circle, Fill::open, 14);
}

TEST(Learn, BlurredDotsOfALineAreNoCrosses) {
  auto map = empty();
  const cv::Point2d along = cv::Point2d(1, 0.7) / std::hypot(1, 0.7);
  for (cv::Point2d at(20, 34); at.y < 225; at += 5.28 * along)
    add(map, stroke_from(at, at + 2.4 * along, 2.4));
  cv::GaussianBlur(map.coverage, map.coverage, {}, 0.9);
  EXPECT_FALSE(markers_on_line(map));
}

TEST(Markers, HalfOfOneAtThePlotsEdgeIsEnoughWhereItFitsWell) {
  auto map = empty();
  const Shape diamond{Outline::diamond, Fill::filled};
  add(map, marker_at(diamond, 30, 1, {0.5, 80.3}));
  add(map, marker_at(diamond, 30, 1, {200.2, 120}));
  // A frame in the paper's colour lies over the edge: nothing is known there.
  map.coverage.colRange(0, 4).setTo(0);
  map.unknown.colRange(0, 4).setTo(255);
  const auto found =
      find_markers(map, {make_template(draw_shape(diamond, {30, 30}, 1, {34, 34}), diamond)})[0];
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[1].at.x, 0.5, 0.2);
  EXPECT_NEAR(found[1].at.y, 80.3, 0.2);
}

TEST(Learn, DashesOfASteepLineAreNoMarkers) {
  for (const double width : {1.2, 1.6})
    for (const double steep : {0.8, 1.5}) {
      auto map = empty();
      add(map, stroke_from({20, 20}, {60, 20}, width));
      cv::Point2d at(60, 20);
      for (int i = 0; at.y < 220 && i < 14; ++i) {  // dash, dot, on a line that turns
        const double slope = steep + 0.05 * i;
        const cv::Point2d along = cv::Point2d(1, slope) / std::hypot(1, slope);
        add(map, stroke_from(at, at + 10 * along, width));
        add(map, stroke_from(at + 11.5 * along, at + (11.5 + width) * along, width));
        at += (13 + width) * along;
      }
      EXPECT_FALSE(markers_on_line(map)) << width << " " << steep;
    }
}

TEST(Template, TrimmedLosesTheStubsOfABar) {
  const Shape shape{Outline::triangle_down, Fill::filled};
  const auto bare = make_template(draw_shape(shape, {19, 19}, 1, {25, 25}), shape);
  cv::Mat ink = draw_shape(shape, {19, 19}, 1, {25, 25});
  ink.colRange(11, 14).setTo(1);
  const auto clean = trimmed(make_template(ink, {Outline::diamond, Fill::filled}),
                             {{Outline::diamond, Fill::filled}, shape});
  EXPECT_EQ(clean.shape.outline, Outline::triangle_down);
  EXPECT_NEAR(clean.box.height, bare.box.height, 0.5);
  EXPECT_NEAR(clean.reference.y, bare.reference.y, 0.3);
  // A cross is none of these shapes: it stays as it is.
  const auto plus = make_template(draw_shape({Outline::plus, Fill::any}, {19, 19}, 7, {25, 25}),
                                  {Outline::plus, Fill::any});
  EXPECT_EQ(trimmed(plus, {shape}).box.height, plus.box.height);
}

TEST(Template, APatchOfALineIsNotDistinct) {
  auto map = empty();
  add(map, stroke_from({20, 60}, {400, 60}, 8));
  const Shape disc{Outline::circle, Fill::filled};
  add(map, marker_at(disc, 16, 1, {200, 60}));
  const auto patch = make_template(draw_shape(disc, {8, 8}, 1, {10, 10}), disc),
             marker = make_template(draw_shape(disc, {16, 16}, 1, {20, 20}), disc);
  EXPECT_EQ(distinct(patch, map, fit(patch, map, {100, 60})), 0);
  EXPECT_GT(distinct(marker, map, fit(marker, map, {200, 60})), 0.2);
}

/// Squares of 11 pixels with bars of the given lengths: both ends of each are found within half a
/// pixel.
void expect_bars(const std::vector<double>& lengths, double width, double cap) {
  auto map = empty();
  const auto at = places(static_cast<int>(lengths.size()));
  const Shape square{Outline::square, Fill::filled};
  for (std::size_t i = 0; i < at.size(); ++i) {
    add(map, marker_at(square, 11, 1, at[i]));
    add_bar(map, at[i], lengths[i], width, cap);
  }
  const auto marker = make_template(draw_shape(square, {11, 11}, 1, {15, 15}), square);
  const auto bars = find_error_bars(map, marker, at, true);
  for (std::size_t i = 0; i < at.size(); ++i) {
    EXPECT_NEAR(bars[i].upper, at[i].y - lengths[i], 0.5) << i;
    EXPECT_NEAR(bars[i].lower, at[i].y + lengths[i], 0.5) << i;
  }
}

TEST(ErrorBars, CapsCloseToTheirMarkersAreRead) {
  expect_bars({25, 8.5, 25, 9, 25, 8.5, 25}, 2, 4.5);
}

TEST(ErrorBars, WhatResemblesAMarkerLittleAndLiesOnABarIsNone) {
  auto map = empty();
  const auto at = places(6);
  const Shape disc{Outline::circle, Fill::filled};
  std::vector<Marker> markers;
  const auto store = [&](cv::Point2d place, double score) {
    Marker one;
    one.at = one.fit.origin = place;
    one.fit.score = score;
    markers.push_back(one);
  };
  for (const auto place : at) {
    add(map, marker_at(disc, 12, 1, place));
    add_bar(map, place, 30, 2, 6);
    store(place, 0.97);
  }
  store(at[2] + cv::Point2d(0, 29), 0.65);   // where a cap meets its bar
  store(at[3] + cv::Point2d(20, 29), 0.65);  // beside: another curve may hide half of it
  drop_on_bars(map, make_template(draw_shape(disc, {12, 12}, 1, {16, 16}), disc), markers, false);
  ASSERT_EQ(markers.size(), at.size() + 1);
  EXPECT_EQ(markers.back().at, at[3] + cv::Point2d(20, 29));
}

}  // namespace
}  // namespace bedscope::digitise
