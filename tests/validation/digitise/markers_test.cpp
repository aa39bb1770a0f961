// SPDX-License-Identifier: BSD-3-Clause
// What markers look like, and where they are: ink drawn here, with lines and bars of the same ink.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tests/validation/digitise/drawn_stroke.hpp"
#include "validation/digitise/error_bars.hpp"
#include "validation/digitise/markers.hpp"
#include "validation/digitise/pieces.hpp"

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

Template square_of(int size) {
  const Shape square{Outline::square, Fill::filled};
  return make_template(draw_shape(square, cv::Size(size, size), 1, {size + 4, size + 4}), square);
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
  const auto marker = square_of(11);
  const auto bars = find_error_bars(map, marker, at, true);
  for (std::size_t i = 0; i < at.size(); ++i) {
    EXPECT_NEAR(bars[i].upper, at[i].y - lengths[i], 0.5) << i;
    EXPECT_NEAR(bars[i].lower, at[i].y + lengths[i], 0.5) << i;
  }
}

TEST(ErrorBars, CapsCloseToTheirMarkersAreRead) {
  expect_bars({25, 8.5, 25, 9, 25, 8.5, 25}, 2, 4.5);
}

/// What drop_on_bars() leaves of one series.
std::vector<Marker> off_bars(const InkMap& map, const Template& marker,
                             const std::vector<Marker>& markers, bool with_line = false) {
  std::vector<std::vector<Marker>> found{markers};
  drop_on_bars(map, {marker}, {true}, found, with_line);
  return found[0];
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
  markers = off_bars(map, make_template(draw_shape(disc, {12, 12}, 1, {16, 16}), disc), markers);
  ASSERT_EQ(markers.size(), at.size() + 1);
  EXPECT_EQ(markers.back().at, at[3] + cv::Point2d(20, 29));
}

/// Open markers filled with paper, on a bar.
void add_on_bar(InkMap& map, Outline outline, double size, cv::Point2d at, double length) {
  add_bar(map, at, length, 2, 6);
  map.coverage.setTo(0, marker_at({outline, Fill::filled}, size, 1, at) > 0.5F);
  add(map, marker_at({outline, Fill::open}, size, 2, at));
}

TEST(Learn, SeriesOfOneInkByTheirShapesThoughBarsGoThroughThem) {
  auto map = empty();
  std::vector<cv::Point2d> circles, diamonds;
  for (int i = 0; i < 24; ++i)
    circles.emplace_back(25.5 + 33 * (i % 12), 40.5 + (i % 4) * 7 + i / 12 * 70);
  for (int i = 0; i < 3; ++i) diamonds.emplace_back(60.5 + 120 * i, 200.5 - 4 * i);
  for (const auto at : circles) add_on_bar(map, Outline::circle, 17, at, 24);
  for (const auto at : diamonds) add_on_bar(map, Outline::diamond, 23, at, 27);
  const Shape circle{Outline::circle, Fill::open}, diamond{Outline::diamond, Fill::open};
  MarkerQuery of_diamonds, of_circles;
  of_diamonds.shape = diamond;
  of_circles.shape = circle;
  of_diamonds.among = of_circles.among = {circle, diamond};
  of_diamonds.rivals = {circle};
  of_circles.rivals = {diamond};
  const auto learned = learn_all(map, {of_diamonds, of_circles});
  ASSERT_TRUE(learned[0] && learned[1]);
  const auto found = find_markers(map, {*learned[0], *learned[1]});
  EXPECT_EQ(found[0].size(), diamonds.size());
  EXPECT_EQ(found[1].size(), circles.size());
  for (const auto& one : found[0])
    EXPECT_TRUE(std::any_of(diamonds.begin(), diamonds.end(),
                            [&](cv::Point2d at) { return cv::norm(one.at - at) < 0.5; }));
}

TEST(Learn, DashesOfALineBesideItsMarkersAreNone) {
  auto map = empty();
  const auto at = places(9);
  for (std::size_t i = 1; i < at.size(); ++i) {
    const auto way = at[i] - at[i - 1];
    for (double t = 0.03; t < 0.9; t += 0.24)
      add(map, stroke_from(at[i - 1] + t * way, at[i - 1] + (t + 0.14) * way, 2.5));
  }
  for (const auto place : at) {
    map.coverage.setTo(0, marker_at({Outline::triangle, Fill::filled}, 15, 1, place) > 0.5F);
    add(map, marker_at({Outline::triangle, Fill::open}, 15, 1.6, place));
  }
  cv::GaussianBlur(map.coverage, map.coverage, {}, 0.8);
  MarkerQuery query;
  query.with_line = true;
  const auto marker = learn(map, query);
  ASSERT_TRUE(marker);
  EXPECT_EQ(name_of(marker->shape), "open triangle");
  EXPECT_EQ(find_markers(map, {*marker})[0].size(), at.size());
}

TEST(Learn, APieceOfTheirLineOnMostMarkersIsNotTheirs) {
  auto map = empty();
  const auto at = places(9);
  for (std::size_t i = 0; i < at.size(); ++i) {
    add(map, marker_at({Outline::triangle_down, Fill::open}, 20, 3, at[i]));
    // A dash to the left, one to the right, none: within the box, so that all are of one size.
    if (i % 3 < 2)
      add(map,
          stroke_from(at[i] + cv::Point2d(0, 8), at[i] + cv::Point2d(i % 3 == 0 ? -9 : 9, -1), 4));
  }
  MarkerQuery query;
  query.with_line = true;
  const auto marker = learn(map, query);
  ASSERT_TRUE(marker);
  EXPECT_EQ(name_of(marker->shape), "open triangle_down");
  EXPECT_EQ(find_markers(map, {*marker})[0].size(), at.size());
}

TEST(Learn, FilledMarkersThatAThickLineTouchesAreAsWideAsHigh) {
  auto map = empty();
  add(map, stroke_from({8, 150}, {412, 109.6}, 5));
  std::vector<cv::Point2d> at;
  for (const double aside : {-5, 5, -5, 5, 0, -5, 5, 0, 5}) {
    const double x = 30.3 + 44.6 * static_cast<double>(at.size());
    at.emplace_back(x, 150 - 0.1 * (x - 8) + aside);
  }
  for (const auto place : at) add(map, marker_at({Outline::square, Fill::filled}, 13, 1, place));
  MarkerQuery query;
  query.with_line = true;
  const auto marker = learn(map, query);
  ASSERT_TRUE(marker);
  EXPECT_EQ(name_of(marker->shape), "filled square");
  EXPECT_EQ(find_markers(map, {*marker})[0].size(), at.size());
}

TEST(Learn, RingsBesideLargerFilledMarkersOfTheirInk) {
  auto map = empty();
  std::vector<cv::Point2d> rings, diamonds;
  for (int i = 0; i < 9; ++i) rings.emplace_back(24.3 + 45.2 * i, 160.4 + 30 * std::sin(0.9 * i));
  for (int i = 0; i < 7; ++i) diamonds.emplace_back(40.1 + 56.3 * i, 60.2 + 4.5 * i);
  for (const auto at : rings) {
    add_bar(map, at, 22, 2, 6);
    add(map, marker_at({Outline::circle, Fill::open}, 15, 2.2, at));
  }
  for (const auto at : diamonds) {
    add_bar(map, at, 26, 2, 6);
    add(map, marker_at({Outline::diamond, Fill::filled}, 22, 1, at));
  }
  cv::GaussianBlur(map.coverage, map.coverage, {}, 0.5);
  const Shape ring{Outline::circle, Fill::open}, diamond{Outline::diamond, Fill::filled};
  MarkerQuery of_rings, of_diamonds;
  of_rings.shape = ring;
  of_diamonds.shape = diamond;
  of_rings.among = of_diamonds.among = {ring, diamond};
  of_rings.rivals = {diamond};
  of_diamonds.rivals = {ring};
  const auto first = learn(map, of_rings);  // while the diamonds are there
  ASSERT_TRUE(first);
  EXPECT_NEAR(first->box.width, 15, 1.5);
  const auto learned = learn_all(map, {of_rings, of_diamonds});
  ASSERT_TRUE(learned[0] && learned[1]);
  const auto found = find_markers(map, {*learned[0], *learned[1]});
  EXPECT_EQ(found[0].size(), rings.size());
  EXPECT_EQ(found[1].size(), diamonds.size());
}

TEST(Pieces, ADashIsAsBroadAsItsLineThoughItsBoxIsSquare) {
  auto map = empty();
  add(map, stroke_from({100, 100}, {108, 108}, 2.5));
  add(map, marker_at({Outline::circle, Fill::open}, 11, 2, {200, 100}));
  const auto pieces = pieces_of(map.coverage > 0.28F, map);
  ASSERT_EQ(pieces.size(), 2U);
  const auto& dash = pieces[0].box.x < 150 ? pieces[0] : pieces[1];
  const auto& ring = pieces[0].box.x < 150 ? pieces[1] : pieces[0];
  EXPECT_NEAR(dash.breadth, 2.5, 0.5);
  EXPECT_GT(ring.breadth, 9);
}

TEST(Learn, AMarkerShownWithTheLineThatPassesIt) {
  auto map = empty();
  const auto at = places(9);
  for (std::size_t i = 1; i < at.size(); ++i) add(map, stroke_from(at[i - 1], at[i], 3));
  for (const auto place : at) {
    map.coverage.setTo(0, marker_at({Outline::triangle, Fill::filled}, 22, 1, place) > 0.5F);
    add(map, marker_at({Outline::triangle, Fill::open}, 22, 2.5, place));
  }
  MarkerQuery query;
  query.sample =
      map.coverage(cv::Rect(cv::Point(at[2]) - cv::Point(16, 16), cv::Size(33, 33))).clone();
  const auto marker = learn(map, query);
  ASSERT_TRUE(marker);
  EXPECT_EQ(find_markers(map, {*marker})[0].size(), at.size());
}

TEST(Template, ASquareWithTheEndsOfItsLineIsNoCutTriangle) {
  const Shape square{Outline::square, Fill::filled};
  for (const double angle : {0.0, 0.3, 0.7}) {
    cv::Mat ink = draw_shape(square, {30, 30}, 1, {46, 46});
    const cv::Point2d way(std::cos(angle), std::sin(angle)), middle(23, 23);
    ink = cv::max(ink, drawn_stroke(middle - 22 * way, middle + 22 * way, 5, ink.size()));
    const auto bare = trimmed(make_template(ink, square), candidates(std::nullopt), 0.4);
    EXPECT_EQ(name_of(bare.shape), "filled square");
    EXPECT_NEAR(bare.box.width, 30, 1.5);
    EXPECT_LT(cv::norm(bare.reference), 0.5);
  }
}

TEST(Template, ASmallBlurredTriangleIsNoPentagon) {
  cv::Mat ink = draw_shape({Outline::triangle, Fill::filled}, {11, 11}, 1, {21, 21});
  cv::GaussianBlur(ink, ink, {}, 1.4);
  const auto marker =
      reshaped(make_template(ink, {Outline::pentagon, Fill::filled}), candidates(std::nullopt));
  EXPECT_EQ(marker.shape.outline, Outline::triangle);
  const auto round =
      reshaped(make_template(draw_shape({Outline::circle, Fill::filled}, {11, 11}, 1, {21, 21}),
                             {Outline::pentagon, Fill::filled}),
               {{Outline::triangle, Fill::filled}, {Outline::pentagon, Fill::filled}});
  EXPECT_EQ(round.shape.outline, Outline::pentagon);
}

TEST(Learn, SmallBlurredTrianglesAreNoPentagons) {
  auto map = empty();
  for (const auto place : places(9))
    add(map, marker_at({Outline::triangle, Fill::filled}, 10, 1, place));
  cv::GaussianBlur(map.coverage, map.coverage, {}, 1.6);
  const auto marker = learn(map, {});
  ASSERT_TRUE(marker);
  EXPECT_EQ(name_of(marker->shape), "filled triangle");
}

TEST(Template, ABarAtItsTipDoesNotMoveATrianglesPoint) {
  const Shape shape{Outline::triangle, Fill::filled};
  cv::Mat ink = draw_shape(shape, {20, 20}, 1, {30, 50});
  const auto point = [&shape](const cv::Mat& sharp) {
    cv::Mat blurred;
    cv::GaussianBlur(sharp, blurred, {}, 1.5);
    return make_template(blurred, shape).reference.y;
  };
  const double bare = point(ink);
  ink.rowRange(9, 25).colRange(13, 17).setTo(1);
  EXPECT_NEAR(point(ink), bare, 0.5);
}

TEST(ErrorBars, AFaintRowBehindACapIsNotTheBars) {
  auto map = empty();
  const Shape square{Outline::square, Fill::filled};
  const cv::Point2d at(100.5, 120);
  add(map, marker_at(square, 11, 1, at));
  add_bar(map, at, 30, 3, 8);
  map.coverage(cv::Rect(99, 152, 3, 1)).setTo(0.4);  // noise below the lower cap
  const auto marker = square_of(11);
  const auto bar = find_error_bar(map, marker, at, false);
  EXPECT_NEAR(bar.lower, 150, 0.3);
  EXPECT_GT(bar.half_cap, 7);
}

TEST(ErrorBars, BehindTheGapThatGnuplotLeavesRoundAMarker) {
  auto map = empty();
  const Shape square{Outline::square, Fill::filled};
  const cv::Point2d at(100.4, 120.3);
  add_bar(map, at, 30, 2, 5);
  map.coverage.setTo(0, marker_at(square, 17, 1, at) > 0.5F);
  add(map, marker_at(square, 11, 1, at));
  const auto marker = square_of(11);
  const auto bar = find_error_bar(map, marker, at, false);
  EXPECT_NEAR(bar.upper, at.y - 30, 0.5);
  EXPECT_NEAR(bar.lower, at.y + 30, 0.5);
  // The marker below another is no bar.
  auto two = empty();
  add(two, marker_at({Outline::circle, Fill::filled}, 11, 1, {200.5, 100}));
  add(two, marker_at({Outline::circle, Fill::filled}, 11, 1, {200.5, 114}));
  const auto none = find_error_bar(two, marker, {200.5, 100}, false);
  EXPECT_TRUE(std::isnan(none.lower));
}

TEST(ErrorBars, OnABarIsAMarkerOnlyByInkThatIsNotTheBars) {
  auto map = empty();
  const Shape triangle{Outline::triangle, Fill::open};
  const auto at = places(6);
  for (const auto place : at) {
    add(map, marker_at(triangle, 12, 1.8, place));
    add_bar(map, place, 30, 2, 6);
  }
  const cv::Point2d below(0, 18), cap(0, 25);
  add(map, marker_at(triangle, 12, 1.8, at[4] + below));  // two of one abscissa
  cv::GaussianBlur(map.coverage, map.coverage, {}, 1.3);
  cv::Mat ink = draw_shape(triangle, {12, 12}, 1.8, {22, 22});
  cv::GaussianBlur(ink, ink, {}, 1.3);
  const auto marker = make_template(ink, triangle);
  std::vector<Marker> markers;
  const auto store = [&](cv::Point2d place) {
    Marker one;
    one.fit = fit(marker, map, place);
    one.at = one.fit.origin + marker.reference;
    markers.push_back(one);
  };
  for (const auto place : at) store(place);
  store(at[4] + below);
  store(at[1] + cap);  // is like a base
  store(at[2] + cap);
  ASSERT_GT(markers.back().fit.score, little_alike(markers));
  markers = off_bars(map, marker, markers);
  EXPECT_EQ(markers.size(), 7U);
  EXPECT_NEAR(markers.back().fit.origin.y, at[4].y + below.y, 1);
}

TEST(ErrorBars, ABarThatHardlyLeavesItsMarkerIsReadWhereOthersShowTheirs) {
  auto map = empty();
  const Shape diamond{Outline::diamond, Fill::filled};
  const auto at = places(6);
  for (std::size_t i = 0; i < at.size(); ++i) {
    add(map, marker_at(diamond, 32, 1, at[i]));
    const double length = i == 2 ? 20.5 : 40;
    add(map, stroke_from(at[i] - cv::Point2d(0, length), at[i] + cv::Point2d(0, length), 3));
  }
  const auto marker = make_template(draw_shape(diamond, {32, 32}, 1, {36, 36}), diamond);
  ASSERT_TRUE(std::isnan(find_error_bar(map, marker, at[2], false).upper));
  const auto bars = find_error_bars(map, marker, at, false);
  EXPECT_NEAR(bars[2].upper, at[2].y - 20.5, 0.5);
  EXPECT_NEAR(bars[2].lower, at[2].y + 20.5, 0.5);
}

TEST(ErrorBars, ALineAlongACapIsNotHiddenWithIt) {
  auto map = empty();
  const Shape square{Outline::square, Fill::filled};
  const cv::Point2d at(200.4, 120.3);
  add(map, marker_at(square, 12, 1, at));
  add_bar(map, at, 30, 2, 6);
  add(map, stroke_from({60, 150.3}, {380, 150.3}, 2));  // a level curve through the lower one
  const auto marker = make_template(draw_shape(square, {12, 12}, 1, {16, 16}), square);
  const auto bar = find_error_bar(map, marker, at, true);
  ASSERT_FALSE(std::isnan(bar.lower));
  cover(map, bar, at);
  EXPECT_LT(cv::countNonZero(map.unknown.row(150)), 4 * 12);
}

TEST(ErrorBars, CapsOfOneSeriesAreNoMarkersOfAnother) {
  auto map = empty();
  const Shape diamond{Outline::diamond, Fill::filled},
      triangle{Outline::triangle_down, Fill::filled};
  const auto at = places(6);
  for (std::size_t i = 0; i < at.size(); ++i) {
    add(map, marker_at(i < 3 ? diamond : triangle, 13, 1, at[i]));
    add_bar(map, at[i], 22, 3, 6);
  }
  cv::GaussianBlur(map.coverage, map.coverage, {}, 0.8);
  std::vector<Template> templates;
  std::vector<std::vector<Marker>> found(2);
  for (const auto& shape : {diamond, triangle}) {
    cv::Mat ink = draw_shape(shape, {13, 13}, 1, {19, 19});
    cv::GaussianBlur(ink, ink, {}, 0.8);
    templates.push_back(make_template(ink, shape));
  }
  const auto store = [&](std::size_t t, cv::Point2d place) {
    found[t].push_back(marker_at(templates[t], fit(templates[t], map, place)));
  };
  for (std::size_t i = 0; i < at.size(); ++i) store(i < 3 ? 0 : 1, at[i]);
  store(1, at[1] - cv::Point2d(0, 18));  // a cap with the bar below it
  ASSERT_GT(found[1].back().fit.score, little_alike(found[1]));
  drop_on_bars(map, templates, {true, true}, found, false);
  EXPECT_EQ(found[0].size(), 3U);
  EXPECT_EQ(found[1].size(), 3U);
}

TEST(ErrorBars, AMarkerOnASteepLineIsNotTheCapOfABar) {
  auto map = empty();
  const Shape triangle{Outline::triangle_down, Fill::filled};
  std::vector<cv::Point2d> at = places(7);
  at.push_back(at[3] + cv::Point2d(1, 24));
  for (std::size_t i = 1; i < 7; ++i) add(map, stroke_from(at[i - 1], at[i], 2));
  add(map, stroke_from(at[3], at[7], 2));
  for (const auto place : at) add(map, marker_at(triangle, 13, 1, place));
  cv::GaussianBlur(map.coverage, map.coverage, {}, 0.7);
  cv::Mat ink = draw_shape(triangle, {13, 13}, 1, {19, 19});
  cv::GaussianBlur(ink, ink, {}, 0.7);
  const auto marker = make_template(ink, triangle);
  std::vector<Marker> markers;
  for (const auto place : at) markers.push_back(marker_at(marker, fit(marker, map, place)));
  const auto bar = find_error_bar(map, marker, markers[7].at, true);
  ASSERT_FALSE(std::isnan(bar.upper));  // the line up to the next one looks like a bar
  markers[3].fit.score = std::min(markers[3].fit.score, markers[7].fit.score - 0.01);
  markers = off_bars(map, marker, markers, true);
  EXPECT_EQ(markers.size(), at.size());
}

TEST(ErrorBars, NothingIsLeftOfThickCapsUnderACover) {
  auto map = empty();
  const Shape square{Outline::square, Fill::filled};
  const cv::Point2d at(100.4, 120.3);
  add(map, marker_at(square, 30, 1, at));
  add_bar(map, at, 70, 8, 20);
  const auto marker = square_of(30);
  InkMap rest{map.coverage, map.unknown.clone()};
  cover(rest, find_error_bar(map, marker, at, true), at);
  cv::Mat left = map.coverage.clone();
  left.setTo(0, rest.unknown);
  EXPECT_LT(cv::sum(left.rowRange(0, 100))[0] + cv::sum(left.rowRange(140, rows))[0], 1);
}

TEST(Markers, ThatAnotherTemplateFitsAboutAsWellAreDoubted) {
  const Shape disc{Outline::circle, Fill::filled}, box{Outline::square, Fill::filled};
  auto map = empty();
  add(map, marker_at(disc, 20, 1, {60.2, 120.4}));
  add(map, marker_at(box, 20, 1, {140.2, 120.4}));
  const cv::Point2d either(220.2, 120.4);  // with corners, but pale ones
  add(map, 0.4 * marker_at(disc, 20, 1, either) + 0.6 * marker_at(box, 20, 1, either));
  std::vector<Template> templates;
  for (const auto& shape : {disc, box})
    templates.push_back(make_template(draw_shape(shape, {20, 20}, 1, {24, 24}), shape));
  const auto found = find_markers(map, templates);
  ASSERT_EQ(found[0].size() + found[1].size(), 3U);
  for (const auto& of_template : found)
    for (const auto& one : of_template) EXPECT_EQ(one.doubted, one.at.x > 180) << one.at;
}

}  // namespace
}  // namespace bedscope::digitise
