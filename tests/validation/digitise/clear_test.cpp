// SPDX-License-Identifier: BSD-3-Clause
// What is drawn in a plot and is not data: grids, ticks, legends.
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/validation/digitise/drawn_stroke.hpp"
#include "validation/digitise/clear.hpp"
#include "validation/digitise/colour.hpp"
#include "validation/digitise/legend.hpp"

namespace bedscope::digitise {
namespace {

constexpr int rows = 300, columns = 400;

InkMap empty() {
  return {cv::Mat::zeros(rows, columns, CV_32F), cv::Mat::zeros(rows, columns, CV_8U)};
}

double ink_between(const InkMap& map, int top, int bottom) {
  return cv::sum(map.coverage.rowRange(top, bottom))[0];
}

TEST(Clear, AConstantIsNoGrid) {
  for (const bool grey : {false, true}) {
    auto map = empty();
    map.coverage.rowRange(0, 2).setTo(1);  // the frame
    map.coverage.colRange(0, 2).setTo(1);
    map.coverage.rowRange(120, 122).setTo(1);
    auto grid = map;
    grid.coverage = map.coverage.clone();
    grid.unknown = map.unknown.clone();
    grid.coverage.rowRange(200, 202).setTo(1);
    clear_rules(map, grey);
    EXPECT_GT(ink_between(map, 115, 130), 1.9 * (columns - 8)) << grey;
    EXPECT_EQ(ink_between(map, 0, 100), 0) << grey;
    clear_rules(grid, grey);
    EXPECT_EQ(ink_between(grid, 100, 250), 0) << grey;
  }
}

TEST(Clear, ADottedLineAsDarkAsAMarkerDoesNotCutIt) {
  auto map = empty();
  for (int y = 0; y < rows; y += 6)  // its dots paler and darker, as on a turned page
    for (const int x : {100, 200})
      map.coverage(cv::Rect(x, y, 2, 3)).setTo(y % 18 == 0 ? 0.9 : 0.55);
  cv::circle(map.coverage, {201, 150}, 10, cv::Scalar(1), cv::FILLED);
  map.coverage(cv::Rect(100, 200, 2, 60)).setTo(1);  // a bar along the other
  clear_rules(map, true);
  const cv::Mat cut = (map.coverage < 0.5F) | map.unknown;
  EXPECT_EQ(cv::countNonZero(cut(cv::Rect(200, 143, 2, 14))), 0);
  EXPECT_EQ(cv::countNonZero(cut(cv::Rect(100, 200, 2, 60))), 0);
  EXPECT_EQ(cv::countNonZero(map.coverage(cv::Rect(200, 0, 2, 130))), 0);
}

TEST(Clear, AGreyLineOfZeroBesideACurveIsNotData) {
  auto map = empty();
  map.coverage.rowRange(150, 151).setTo(1);
  map.coverage = cv::max(map.coverage, drawn_stroke({5, 280}, {395, 20}, 3, {columns, rows}));
  clear_rules(map, true);
  EXPECT_LT(cv::sum(map.coverage.rowRange(150, 151).colRange(0, 150))[0], 1);
  EXPECT_GT(cv::sum(map.coverage)[0], 1000);
}

TEST(Legend, AFrameMayTouchAGridLineAndAnOpenSquareIsNone) {
  cv::Mat ink = cv::Mat::zeros(rows, columns, CV_32F);
  const auto frame = [&](cv::Rect box) { cv::rectangle(ink, box, cv::Scalar(1), 2); };
  const cv::Rect legend(230, 20, 130, 60), marker(60, 180, 40, 40);
  frame(legend);
  frame(marker);
  for (int i = 0; i < 6; ++i) ink(cv::Rect(245 + 9 * i, 30, 6, 8)).setTo(1);  // letters
  ink(cv::Rect(310, 50, 8, 8)).setTo(1);
  ink.rowRange(79, 80).setTo(1);  // a grid line where the frame ends
  const cv::Rect area({0, 0}, ink.size());
  const auto boxes = find_boxes(find_rules(ink, 12, 8), ink, area);
  ASSERT_GE(boxes.size(), 1U);
  for (const auto& box : boxes) {
    EXPECT_NEAR(box.x, legend.x, 8);
    EXPECT_NEAR(box.br().y, legend.br().y, 8);
    EXPECT_NEAR(box.width, legend.width, 14);
  }
}

TEST(Colour, TwoGuessesOfOneInkAreOneThoughItsEdgesArePaler) {
  // Steps along the edge of a turned picture: 0.85 of the way from paper to ink.
  const cv::Vec3b paper(238, 238, 238), ink(80, 78, 196), edge(104, 102, 202);
  cv::Mat page(200, 300, CV_8UC3, cv::Scalar(paper[0], paper[1], paper[2]));
  cv::rectangle(page, {60, 80, 60, 60}, cv::Scalar(ink[0], ink[1], ink[2]), cv::FILLED);
  cv::rectangle(page, {60, 80, 60, 60}, cv::Scalar(edge[0], edge[1], edge[2]), 1);
  const auto colours =
      separate(page, {10, 10, 280, 180}, false, {cv::Vec3f(95, 100, 210), cv::Vec3f(70, 84, 190)});
  EXPECT_EQ(colours.ink_of_asked[0], colours.ink_of_asked[1]);
  EXPECT_LT(cv::norm(colours.inks[0] - cv::Vec3f(80, 78, 196)), 12);
}

TEST(Colour, TheBlurredEdgeOfADarkLineIsNotAPalerInk) {
  const cv::Scalar dark(178, 114, 0), pale(233, 180, 86);  // BGR
  cv::Mat page(200, 300, CV_8UC3, cv::Scalar::all(255));
  page(cv::Rect(20, 58, 260, 4)).setTo(dark);
  page(cv::Rect(20, 138, 260, 4)).setTo(pale);
  cv::GaussianBlur(page, page, {}, 1.0);
  const auto vector = [](const cv::Scalar& c) {
    return cv::Vec3f(static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2]));
  };
  const auto colours = separate(page, {10, 10, 280, 180}, true, {vector(pale), vector(dark)});
  const cv::Mat of_pale = coverage_of(colours, colours.ink_of_asked[0]) > 0.1,
                of_dark = coverage_of(colours, colours.ink_of_asked[1]) > 0.1;
  EXPECT_EQ(cv::countNonZero(of_pale(cv::Rect(30, 50, 240, 20))), 0);
  EXPECT_EQ(cv::countNonZero(of_dark(cv::Rect(30, 130, 240, 20))), 0);
  EXPECT_GT(cv::countNonZero(of_pale(cv::Rect(30, 130, 240, 20))), 4 * 240);
}

}  // namespace
}  // namespace bedscope::digitise
