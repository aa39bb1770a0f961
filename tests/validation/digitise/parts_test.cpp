// SPDX-License-Identifier: BSD-3-Clause
// The parts of the digitiser that have a closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "readers/error.hpp"
#include "tests/validation/digitise/drawn_stroke.hpp"
#include "validation/digitise/calibration.hpp"
#include "validation/digitise/clear.hpp"
#include "validation/digitise/colour.hpp"
#include "validation/digitise/doubt.hpp"
#include "validation/digitise/legend.hpp"
#include "validation/digitise/lines.hpp"
#include "validation/digitise/page.hpp"
#include "validation/digitise/rules.hpp"
#include "validation/digitise/stroke.hpp"
#include "validation/digitise/table.hpp"
#include "validation/digitise/template.hpp"
#include "validation/digitise/ticks.hpp"
#include "validation/digitise/triangle.hpp"
#include "validation/digitise/uncertainty.hpp"

namespace bedscope::digitise {
namespace {

AxisSpec axis(std::vector<CalibrationPoint> points, bool log = false) {
  return {"v", "-", log, std::move(points)};
}

TEST(Calibration, TwoPointsAreALineAndTheirErrorIsThatOfTheirPixels) {
  const auto spec = axis({{{100, 0}, 2.0}, {{300, 0}, 6.0}});
  const auto found = calibrate(spec, {{100, 0.29}, {300, 0.29}}, "f");
  EXPECT_DOUBLE_EQ(found.value(150), 3.0);
  EXPECT_DOUBLE_EQ(found.pixel(5.0), 250.0);
  // In the middle the mean of two, at an end that of one.
  EXPECT_NEAR(found.uncertainty(200, 0), 0.02 * 0.29 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(found.uncertainty(300, 0), 0.02 * 0.29, 1e-12);
  EXPECT_NEAR(found.uncertainty(200, 1.0), 0.02 * std::hypot(1.0, 0.29 / std::sqrt(2.0)), 1e-12);
}

TEST(Calibration, LogAxisIsLinearInTheLogarithm) {
  const auto spec = axis({{{0.5, 0}, 0.01}, {{200.5, 0}, 100}}, true);
  const auto found = calibrate(spec, {{0.5, 0.1}, {200.5, 0.1}}, "f");
  EXPECT_NEAR(found.value(100.5), 1.0, 1e-12);
  EXPECT_NEAR(found.pixel(10), 150.5, 1e-9);
  // du/u = ln(10) du_log: one pixel is 0.02 decades.
  EXPECT_NEAR(found.uncertainty(100.5, 1.0),
              std::log(10.0) * 0.02 * std::hypot(1.0, 0.1 / std::sqrt(2.0)), 1e-12);
}

TEST(Calibration, SingularAndImpossibleOnesAreErrors) {
  EXPECT_THROW(calibrate(axis({{{5, 0}, 1.0}, {{5, 9}, 2.0}}), {{5, 0.1}, {5, 0.1}}, "f"),
               InputError);
  EXPECT_THROW(calibrate(axis({{{5, 0}, 1.0}, {{95, 0}, 1.0}}), {{5, 0.1}, {95, 0.1}}, "f"),
               InputError);
  EXPECT_THROW(calibrate(axis({{{5, 0}, 0.0}, {{95, 0}, 1.0}}, true), {{5, 0.1}, {95, 0.1}}, "f"),
               InputError);
  EXPECT_THROW(calibrate(axis({{{0, 0}, 0}, {{50, 0}, 8}, {{100, 0}, 10}}),
                         {{0, 0.1}, {50, 0.1}, {100, 0.1}}, "f"),
               InputError);
}

TEST(Calibration, APickedPixelStandsForTheOneLineBesideIt) {
  const auto picked = axis({{{100, 0}, 0}, {{300, 0}, 1}});
  // The line at 101 was meant; at 300 it cannot be told which, and there is none at 500.
  const auto places = places_of(picked, {100, 300, 500}, {101, 299, 301}, 1, false);
  EXPECT_DOUBLE_EQ(places[0].at, 101);
  EXPECT_DOUBLE_EQ(places[1].at, 300);
  EXPECT_DOUBLE_EQ(places[2].at, 500);
  EXPECT_NEAR(places[0].u, 0.5 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(places[1].u, 1 / std::sqrt(3.0), 1e-12);
  // A tick that the frame two pixels away hides was meant.
  EXPECT_DOUBLE_EQ(places_of(picked, {100, 300}, {102, 300}, 1, false)[0].at, 100);
  // What was measured is left as it is.
  const auto measured = axis({{{100.25, 0}, 0}, {{300, 0}, 1}});
  EXPECT_DOUBLE_EQ(places_of(measured, {100.25, 300}, {101}, 1, false)[0].at, 100.25);
  EXPECT_DOUBLE_EQ(places_of(measured, {100.25, 300}, {101}, 1, false)[0].u, 0.1);
}

TEST(Calibration, AFractionThatIsALinesMiddleIsKnownToTheLinesRoundingOnly) {
  const auto spec = axis({{{100.07, 0}, 0}, {{300.5, 0}, 1}, {{400.25, 0}, 2}});
  const auto places = places_of(spec, {100.07, 300.5, 400.25}, {100, 300.5, 401}, 1, false);
  EXPECT_DOUBLE_EQ(places[0].at, 100);
  EXPECT_NEAR(places[0].u, 0.5 / std::sqrt(3.0), 1e-12);
  EXPECT_EQ(places[0].shared, 0);
  EXPECT_DOUBLE_EQ(places[1].at, 300.25);  // on the middle of a pixel
  EXPECT_DOUBLE_EQ(places[1].shared, 0.25);
  EXPECT_DOUBLE_EQ(places[2].at, 400.25);  // no line is there
  EXPECT_DOUBLE_EQ(places[2].u, 0.1);
}

TEST(Calibration, RoundingThatDoesNotScatterIsShared) {
  const auto spec = axis({{{100, 0}, 0}, {{200, 0}, 1}, {{300, 0}, 2}, {{400, 0}, 3}});
  // A whole number of pixels apart: all are off by the same, which their mean is too.
  const auto alike = calibrate(spec, {{100, 0.3}, {200, 0.3}, {300, 0.3}, {400, 0.3}}, "f");
  EXPECT_NEAR(alike.uncertainty(250, 0), 0.01 * 0.3, 1e-12);
  // Residuals of 0.06 px, two less than there are points free: 0.12 / sqrt(2) to each its own.
  const auto apart =
      calibrate(spec, {{100.06, 0.3}, {199.94, 0.3}, {299.94, 0.3}, {400.06, 0.3}}, "f");
  const double own = 0.12 / std::sqrt(2.0);
  EXPECT_NEAR(apart.uncertainty(250, 0), 0.01 * std::sqrt(0.09 - own * own + own * own / 4), 1e-5);
}

TEST(Calibration, LinesOnTheMiddlesOfPixelsShareAnError) {
  const auto picked = axis({{{100, 0}, 0.0}, {{300, 0}, 2.0}});
  // What one program draws at 101 another draws at 101.5: a quarter to each side of 101.25.
  const auto places = places_of(picked, {100, 300}, {101.5, 300.5}, 1, false);
  EXPECT_DOUBLE_EQ(places[0].at, 101.25);
  EXPECT_DOUBLE_EQ(places[1].at, 300.25);
  // It does not become smaller in the middle between them, as that of their rounding does.
  const double rounding = 0.5 / std::sqrt(3.0), value_of_pixel = 2.0 / 199;
  const auto found = calibrate(picked, places, "f");
  EXPECT_NEAR(found.uncertainty(200.75, 0),
              value_of_pixel * std::hypot(rounding / std::sqrt(2.0), 0.25), 1e-12);
  EXPECT_NEAR(found.uncertainty(101.25, 0), value_of_pixel * std::hypot(rounding, 0.25), 1e-12);
  // Between two pixels it can only be rounded; on a turned page that cannot be seen.
  EXPECT_DOUBLE_EQ(places_of(picked, {100, 300}, {101, 300}, 1, false)[0].shared, 0);
  EXPECT_DOUBLE_EQ(places_of(picked, {100, 300}, {101, 300}, 1, true)[0].shared, 0.25);
  // Two pixels of the picture in one of the page: 50.75 is the middle of its pixel 101.
  EXPECT_DOUBLE_EQ(places_of(picked, {50, 150}, {50.75, 150}, 0.5, false)[0].shared, 0.125);
  EXPECT_DOUBLE_EQ(places_of(picked, {50, 150}, {50.75, 150}, 0.5, false)[1].shared, 0);
}

TEST(Calibration, AngleOfPointsNeedsAxesThatAgree) {
  Figure figure;
  figure.x = axis({{{100, 500}, 0}, {{500, 486}, 1}});
  figure.y = axis({{{100, 500}, 0}, {{86, 100}, 1}});
  EXPECT_NEAR(angle_of_points(figure).angle, std::atan2(14, 400) * 180 / M_PI, 1e-9);
  // Pixels picked by eye, uniform within one to each side, at the ends of two lines.
  const double length = std::hypot(14, 400);
  EXPECT_NEAR(angle_of_points(figure).u, std::sqrt(1 / 3.0) / length * 180 / M_PI, 1e-9);
  figure.y = axis({{{100, 500}, 0}, {{500, 100}, 1}});  // the far corner for both axes
  EXPECT_TRUE(std::isnan(angle_of_points(figure).angle));
}

TEST(Page, PointsGoThereAndBack) {
  const cv::Mat picture(300, 400, CV_8UC3, cv::Scalar::all(255));
  const Page page(picture, 2.0, 2);
  const cv::Point2d point(123.25, 77.5), back = page.to_picture(page.to_page(point));
  EXPECT_NEAR(back.x, point.x, 1e-9);
  EXPECT_NEAR(back.y, point.y, 1e-9);
  // What leans 2 degrees anticlockwise is level on the page.
  const auto a = page.to_page({0, 200}),
             b = page.to_page({300, 200 - 300 * std::tan(2 * M_PI / 180)});
  EXPECT_NEAR(a.y, b.y, 1e-9);
}

TEST(Rules, AFrameIsFoundBelowAPixel) {
  cv::Mat ink = cv::Mat::zeros(300, 400, CV_32F);
  // A line 2 px thick from y = 50.25 to 52.25: rows 50 to 52 covered by 0.75, 1, 0.25.
  for (const auto& [row, share] : {std::pair{50, 0.75F}, {51, 1.0F}, {52, 0.25F}})
    ink.row(row).colRange(40, 360).setTo(share);
  const auto rules = find_rules(ink, 100, 5);
  ASSERT_EQ(rules.rows.size(), 1U);
  EXPECT_NEAR(rules.rows[0].at, 51.25, 0.01);
  EXPECT_NEAR(rules.rows[0].thickness, 2.0, 0.01);
  EXPECT_DOUBLE_EQ(rules.rows[0].from, 40);
  EXPECT_DOUBLE_EQ(rules.rows[0].to, 360);
}

TEST(Rules, GridLinesTellThePlotWhereAFrameInThePapersColourCutsThem) {
  Rules rules;
  for (const double y : {60.0, 120.0, 180.0}) rules.rows.push_back({y, 54, 646, 2, 0});
  for (const double x : {150.0, 300.0, 450.0}) rules.columns.push_back({x, 24, 276, 2, 0});
  const auto area = plot_area(rules, {50, 20, 600, 260}, {800, 400});
  EXPECT_FALSE(area.guess);
  EXPECT_EQ(area.box, cv::Rect2d(50, 20, 600, 260));
}

TEST(Rules, AFrameMayLieAroundTheCalibrationPoints) {
  Rules rules;
  for (const double y : {20.0, 320.0}) rules.rows.push_back({y, 50, 550, 2, 0});
  for (const double x : {50.0, 550.0}) rules.columns.push_back({x, 20, 320, 2, 0});
  // A line far from them, and one that does not go along the whole box.
  rules.rows.push_back({395, 20, 580, 2, 0});
  rules.rows.push_back({310, 300, 500, 2, 0});
  const auto area = plot_area(rules, {90, 60, 400, 235}, {600, 400});
  EXPECT_FALSE(area.guess);
  EXPECT_EQ(area.box, cv::Rect2d(50, 20, 500, 300));
  EXPECT_TRUE(plot_area(rules, {200, 60, 200, 235}, {600, 400}).guess);  // too far
}

/// A plot in a black frame of `thick` pixels about (60, 40) to (560, 340), with ticks of that
/// thickness inwards, centred at 160.5, 260.5 ... and at 140.5, 240.5.
cv::Mat framed_plot(int thick) {
  cv::Mat page(400, 620, CV_8UC3, cv::Scalar::all(255));
  const auto fill = [&](int x, int y, int width, int height) {
    page(cv::Rect(x, y, width, height)).setTo(cv::Scalar::all(0));
  };
  const int half = thick / 2;
  for (const int y : {40, 340}) fill(60 - half, y - half, 500 + thick, thick);
  for (const int x : {60, 560}) fill(x - half, 40 - half, thick, 300 + thick);
  for (const int x : {160, 260, 360, 460}) fill(x - half, 315, thick, 25);
  for (const int y : {140, 240}) fill(60, y - half, 25, thick);
  return page;
}

TEST(Ticks, AreAtTheMiddleOfTheirInkHoweverThick) {
  for (const auto& [thick, times] : {std::pair(1, 1), {3, 1}, {5, 1}, {3, 2}, {3, 4}}) {
    cv::Mat page;
    cv::resize(framed_plot(thick), page, {}, times, times, cv::INTER_NEAREST);
    const cv::Rect2d area(60.5 * times, 40.5 * times, 500 * times, 300 * times);
    const auto ticks = find_ticks(page, area);
    ASSERT_EQ(ticks.x.size(), 6U) << thick;  // with the frame's sides
    ASSERT_EQ(ticks.y.size(), 4U) << thick;
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(ticks.x[i], times * (60.5 + 100 * i), 1e-6) << times;
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(ticks.y[i], times * (40.5 + 100 * i), 1e-6) << times;
  }
}

TEST(Ticks, CurvesThatStartAtAnAxisAreNone) {
  cv::Mat page = framed_plot(3);
  cv::line(page, {60, 190}, {300, 190}, cv::Scalar(180, 119, 31), 3);  // level and blue
  cv::line(page, {60, 290}, {300, 170}, cv::Scalar(0, 0, 0), 4);       // leaning and black
  cv::line(page, {60, 100}, {300, 100}, cv::Scalar(75, 86, 140), 3);   // brown
  EXPECT_EQ(find_ticks(page, {60.5, 40.5, 500, 300}).y.size(), 4U);
}

TEST(Shapes, NamesInManyWords) {
  EXPECT_EQ(shape_of("open triangle")->outline, Outline::triangle);
  EXPECT_EQ(shape_of("open triangle")->fill, Fill::open);
  EXPECT_EQ(shape_of("Triangle-down")->outline, Outline::triangle_down);
  EXPECT_EQ(shape_of("s")->outline, Outline::square);
  EXPECT_EQ(shape_of("filled_circle")->fill, Fill::filled);
  EXPECT_FALSE(shape_of("heart"));
}

TEST(Shapes, DrawnShapesHaveTheAreaOfTheirGeometry) {
  const auto area = [](Outline outline, Fill fill, double stroke) {
    return cv::sum(draw_shape({outline, fill}, {20, 20}, stroke, {40, 40}))[0];
  };
  // Corners are rounded to an eighth of a pixel, and edges drawn a sixteenth outside.
  EXPECT_NEAR(area(Outline::square, Fill::filled, 1), 400, 8);
  EXPECT_NEAR(area(Outline::circle, Fill::filled, 1), M_PI * 100, 6);
  EXPECT_NEAR(area(Outline::triangle, Fill::filled, 1), 200, 6);
  EXPECT_NEAR(area(Outline::square, Fill::open, 2), 400 - 256, 10);
  EXPECT_NEAR(area(Outline::plus, Fill::any, 2), 2 * 40 - 4, 6);
}

TEST(Shapes, EveryDrawnShapeIsRecognised) {
  for (const auto& shape : candidates(std::nullopt)) {
    const auto [found, likeness] =
        recognise(draw_shape(shape, {21, 21}, 2, {27, 27}), candidates(std::nullopt));
    EXPECT_EQ(found.outline, shape.outline) << name_of(shape);
    EXPECT_EQ(found.fill, shape.fill) << name_of(shape);
    EXPECT_GT(likeness, 0.95) << name_of(shape);
  }
}

TEST(Template, FitFindsAShiftedMarkerBelowATenthOfAPixel) {
  for (const auto outline : {Outline::circle, Outline::triangle, Outline::x}) {
    const Shape shape{outline, Fill::filled};
    const auto marker = make_template(draw_shape(shape, {16, 16}, 2, {20, 20}), shape);
    for (const cv::Point2d off : {cv::Point2d(0.3, -0.4), cv::Point2d(-0.15, 0.25)}) {
      const InkMap map{draw_shape(shape, {16, 16}, 2, {60, 60}, off),
                       cv::Mat::zeros(60, 60, CV_8U)};
      const auto found = fit(marker, map, {31, 29});
      EXPECT_NEAR(found.origin.x, 30 + off.x, 0.1);
      EXPECT_NEAR(found.origin.y, 30 + off.y, 0.1);
      EXPECT_GT(found.score, 0.95);
    }
  }
}

TEST(Template, AThickRingIsToldFromADisc) {
  const Shape ring{Outline::circle, Fill::open}, disc{Outline::circle, Fill::filled};
  for (const auto& shape : {ring, disc}) {
    cv::Mat ink = draw_shape(shape, {26, 26}, 9.4, {32, 32});  // its hole a quarter of its width
    cv::GaussianBlur(ink, ink, {}, 1.2);
    EXPECT_EQ(recognise(ink, {ring, disc}).first.fill, shape.fill);
  }
}

TEST(Template, ReferenceOfATriangleIsTheMiddleOfItsBox) {
  const Shape shape{Outline::triangle, Fill::filled};
  const auto marker = make_template(draw_shape(shape, {24, 24}, 1, {30, 30}), shape);
  EXPECT_NEAR(marker.reference.x, 0, 0.1);
  EXPECT_NEAR(marker.reference.y, reference_of(shape, {24, 24}, 1).at.y * 24, 0.25);
  EXPECT_NEAR(marker.box.height, 24, 0.5);
}

TEST(Shapes, AnOpenTrianglesPointIsBelowTheMiddleOfItsInkByTheMitre) {
  // Path 20 wide and high; the edges of a stroke of 2 meet 1 / sin(26.57 deg) above its tip and
  // lie 1 below its base.
  const double shift = (1 / std::sin(std::atan(0.5)) - 1) / 2 / 23.2;
  const auto rule = reference_of({Outline::triangle, Fill::open}, {23.2, 23.2}, 2);
  EXPECT_NEAR(rule.at.y, shift, 0.001);
  EXPECT_LT(rule.uncertain, shift / 2);
  EXPECT_NEAR(reference_of({Outline::triangle_down, Fill::open}, {23.2, 23.2}, 2).at.y, -shift,
              0.001);
}

TEST(Shapes, ABarInASmallTrianglesHoleIsNotItsStroke) {
  const Shape open{Outline::triangle, Fill::open};
  const cv::Size2d box(22.5, 22.5);
  EXPECT_EQ(reference_of(open, box, 8).at.y, reference_of(open, box, 0.7 * 0.289 * 22.5).at.y);
}

TEST(Shapes, ATriangleOfGnuplotLacksAPixelAtItsBaseAndAnEquilateralOneAnEighth) {
  const auto below_middle = [](double width, double height) {  // rows, and their uncertainty
    const auto rule = reference_of({Outline::triangle, Fill::open}, {width, height}, 1.5);
    return std::pair(rule.at.y * height, rule.uncertain * height);
  };
  const double mitre = below_middle(40, 40).first;
  EXPECT_NEAR(below_middle(40, 39).first, mitre + 0.5, 0.01);
  EXPECT_NEAR(below_middle(40, 0.866 * 40).first, 0.866 * 40 / 6, 0.01);
  // Of 14 pixels they differ by 0.9 in height and by 0.8 in their point.
  const auto [small, known_to] = below_middle(14, 12.6);
  EXPECT_GT(small, mitre + 0.5);
  EXPECT_LT(small, 12.6 / 6);
  EXPECT_GT(2 * known_to, std::max(12.6 / 6 - small, small - mitre - 0.5));
}

TEST(Template, DashesLeftAtATrianglesSidesDoNotMakeItFlat) {
  const Shape shape{Outline::triangle, Fill::filled};
  const cv::Mat bare = draw_shape(shape, {20, 20}, 1, {34, 28});
  const auto clean = make_template(bare, shape);
  for (int top = 9; top < 19; ++top)
    for (int beyond = 1; beyond < 5; ++beyond) {
      cv::Mat dashed = bare.clone();
      const int half = (top + 2 - 4) / 2;  // of the triangle's width there
      dashed(cv::Rect(17, top, half + beyond, 4)).setTo(1);
      dashed(cv::Rect(17 - half - beyond, top + 1, half + beyond, 4)).setTo(1);
      const auto marker = make_template(dashed, shape);
      EXPECT_LT(std::abs(marker.reference.y - clean.reference.y),
                std::max(0.5, 2.5 * marker.reference_u[1]))
          << top << " " << beyond;
    }
}

TEST(Triangle, IsWhereItsSidesMeetThoughABarHidesItsTip) {
  const cv::Size size(60, 70);
  const cv::Point2d off(0.3, 8.4);
  for (const auto fill : {Fill::filled, Fill::open}) {
    cv::Mat ink = draw_shape({Outline::triangle, fill}, {30, 30}, 3, size, off);
    const double left = 15.3, top = 28.4;
    for (const bool barred : {false, true}) {
      if (barred) {
        ink.colRange(28, 33).rowRange(2, 40).setTo(1);  // a bar
        ink.rowRange(46, 49).colRange(0, 30).setTo(1);  // a line from the left
      }
      const auto box = box_by_sides(ink, {left + 2, top - 5, 27, 36});
      ASSERT_TRUE(box);
      EXPECT_NEAR(box->y, top, 0.4);
      EXPECT_NEAR(box->br().y, top + 30, 0.15);  // between two pixels
      EXPECT_NEAR(box->x, left, 0.2);
      EXPECT_NEAR(box->br().x, left + 30, 0.2);
    }
  }
  EXPECT_FALSE(box_by_sides(cv::Mat::zeros(size, CV_32F), {15, 28, 30, 30}));
}

TEST(Stroke, WidthIsThatOfMostOfTheLength) {
  cv::Mat ink = cv::Mat::zeros(200, 300, CV_32F);
  ink.rowRange(50, 53).colRange(20, 280).setTo(1);   // a line of 3
  ink.rowRange(100, 120).colRange(40, 60).setTo(1);  // a filled marker
  EXPECT_NEAR(stroke_width(ink), 3, 0.2);
}

TEST(Stroke, ManyFilledMarkersOnALineDoNotPassForAThickStroke) {
  cv::Mat ink = cv::Mat::zeros(200, 300, CV_32F);
  ink.rowRange(98, 102).colRange(10, 290).setTo(1);  // a line of 4
  for (int x = 25; x < 290; x += 25) cv::circle(ink, {x, 100}, 9, cv::Scalar(1), cv::FILLED);
  EXPECT_NEAR(line_width(ink), 4, 0.3);
}

std::vector<Marker> markers_at(const std::vector<double>& x) {
  std::vector<Marker> markers(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    markers[i].at = {x[i], 10.0 * static_cast<double>(i)};
    markers[i].fit.score = 0.95;
  }
  return markers;
}

TEST(Uncertainty, WholePixelsAreExcludedOnlyByWhatIsSeen) {
  const std::vector<double> on_edges = {3, 18, 40, 77, 91, 120, 133, 150},
                            anywhere = {3.1, 18.9, 40.4, 77.6, 91.25, 120.75, 133.5, 150.05};
  const auto expect = [](const std::vector<double>& x, int reduction, bool turned, double shift,
                         double u) {
    auto markers = markers_at(x);
    complete(markers, reduction, turned, false);
    EXPECT_NEAR(markers[0].at.x, x[0] - shift, 1e-12);
    EXPECT_NEAR(markers[0].u[0], u, 1e-12);
  };
  expect(on_edges, 1, false, 0, 0.25);
  expect(anywhere, 1, false, 0, 0.08);
  // A page that was turned, and a few markers, show nothing of the pixels they were drawn on.
  expect(anywhere, 1, true, 0.25, 0.33);
  expect({3.1, 18.9, 40.4}, 1, false, 0.25, 0.33);
  expect(anywhere, 2, false, 0.125, 0.165);
}

/// A dashed straight line through (`x`, 20) of `width` pixels.
InkMap dashed_line(double x, double slope, double width, double dash, double gap) {
  const cv::Size size(200, 240);
  InkMap map{cv::Mat::zeros(size, CV_32F), cv::Mat::zeros(size, CV_8U)};
  const cv::Point2d along = cv::Point2d(1, slope) / std::hypot(1, slope), first(x, 20);
  for (double t = 0; first.y + t * along.y < 95; t += dash + gap) {
    const cv::Point2d from = first + t * along;
    map.coverage = cv::max(map.coverage, drawn_stroke(from, from + dash * along, width, size));
  }
  return map;
}

TEST(Clear, DashedRulesAreTakenAwayAndMarkersAtOneHeightAreNot) {
  InkMap map{cv::Mat::zeros(200, 495, CV_32F), cv::Mat::zeros(200, 495, CV_8U)};
  for (int x = 0; x < 495; x += 9) map.coverage(cv::Rect(x, 150, 6, 2)).setTo(0.3F);
  // In each sixteenth of the width one marker; between two of them up to 40 pixels of paper.
  for (int x = 10; x < 480; x += 30)
    map.coverage(cv::Rect(x + (x / 30 % 2) * 10, 60, 14, 14)).setTo(0.9F);
  const double markers = cv::sum(map.coverage.rowRange(0, 140))[0];
  clear_rules(map, true);
  EXPECT_DOUBLE_EQ(cv::sum(map.coverage.rowRange(0, 140))[0], markers);
  EXPECT_EQ(cv::sum(map.coverage.rowRange(140, 200))[0], 0);
}

TEST(Lines, DashesAndDotsOfSteepLinesAreReadWhereTheirEndsDoNotShift) {
  // At a slope of 6 the dashes lie above each other, two in a column.
  for (const double slope : {0.5, 1.3, 6.0})
    for (const auto& [dash, gap] : {std::pair(16.0, 7.0), {3.0, 5.0}}) {
      const auto line = trace_line(dashed_line(20, slope, 3, dash, gap), {}, 200);
      ASSERT_GT(line.points.size(), 8U);
      // The corners are on eighths of a pixel; an end's shift would be up to 1.5 px.
      for (const auto& point : line.points)
        EXPECT_NEAR((point.at.y - 20 - slope * (point.at.x - 20)) / std::hypot(1, slope), 0, 0.15)
            << slope << " " << dash << " " << point.at.x;
    }
}

TEST(Lines, OtherInkOfTheSameColourDoesNotMoveThePoints) {
  auto map = dashed_line(20, 0.2, 3, 500, 0);
  const auto alone = trace_line(map, {}, 200);
  for (const int x : {60, 100, 140}) {  // bars, and a stroke that grows out of the line
    map.coverage(cv::Rect(x, 10, 2, 60)).setTo(1);
    cv::line(map.coverage, {x + 10, cvRound(20 + 0.2 * (x - 10))},
             {x + 25, cvRound(20 + 0.2 * (x - 10)) + 9}, cv::Scalar(1), 2);
  }
  const auto line = trace_line(map, {}, 200);
  ASSERT_GT(line.points.size(), alone.points.size() / 2);
  for (const auto& point : line.points)
    EXPECT_NEAR((point.at.y - 20 - 0.2 * (point.at.x - 20)) / std::hypot(1, 0.2), 0, 0.15)
        << point.at.x;
}

TEST(Lines, TicksThatWereNotClearedAreNotTheLine) {
  constexpr int rows = 240, columns = 300;
  InkMap map{cv::Mat::zeros(rows, columns, CV_32F), cv::Mat::zeros(rows, columns, CV_8U)};
  for (int x = 4; x < columns; x += 6) map.coverage(cv::Rect(x, 230, 1, 8)).setTo(1);
  for (int x = 20; x < 260; x += 80)  // most of a thick line is hidden by its markers
    map.coverage =
        cv::max(map.coverage, drawn_stroke({x + 0.0, 150 - x / 4.0},
                                           {x + 30.0, 150 - (x + 30) / 4.0}, 8, {columns, rows}));
  const auto line = trace_line(map, {}, 60);
  ASSERT_GT(line.points.size(), 10U);
  for (const auto& point : line.points)
    EXPECT_NEAR(point.at.y, 150 - point.at.x / 4, 0.3) << point.at.x;
}

TEST(Page, PointsOffByTheirPixelsDoNotTurnAnUprightPicture) {
  Figure figure;
  figure.x = axis({{{50, 200}, 0}, {{350, 201}, 1}});  // 0.2 degrees
  figure.y = axis({{{50, 200}, 0}, {{50, 50}, 1}});
  SeriesSpec series;
  series.name = "a";
  series.kind = Kind::line;
  series.colour = {0, 0, 255};
  figure.series = {series};
  const cv::Mat paper(250, 400, CV_8UC3, cv::Scalar::all(255));
  // Nor does a curve that is nearly straight and level.
  cv::Mat flat = paper.clone();
  cv::line(flat, {75, 152}, {325, 150}, cv::Scalar(0, 0, 255), 1, cv::LINE_AA);
  EXPECT_EQ(digitise(flat, false, figure, "f").angle, 0);
  cv::Mat picture = paper.clone();
  cv::line(picture, {75, 190}, {325, 75}, cv::Scalar(0, 0, 255), 3, cv::LINE_AA);
  const auto straight = digitise(picture, false, figure, "f");
  EXPECT_EQ(straight.angle, 0);
  // Six pixels are no pixel's error; the angle's own is that of points far from the axes.
  figure.x.points[1].pixel.y = 194;
  figure.y.points[1].pixel.x = 47;
  const auto found = digitise(picture, false, figure, "f");
  EXPECT_NEAR(found.angle, std::atan2(6, 300) * 180 / M_PI, 0.02);
  EXPECT_GT(found.series[0].points.back().x_u, 1.08 * straight.series[0].points.back().x_u);
}

TEST(Doubt, AMarkerThatFitsMuchWorseThanItsSeries) {
  auto markers = markers_at({10, 20, 30, 40, 50});
  markers[1].fit.score = 0.85;  // a bar goes through it
  EXPECT_TRUE(unlike_others(markers).empty());
  markers[3].fit.score = 0.65;
  ASSERT_EQ(unlike_others(markers).size(), 1U);
  EXPECT_EQ(unlike_others(markers)[0], markers[3].at);
}

TEST(Doubt, WhatLooksLikeAMarkerAndWasNotTaken) {
  const Shape square{Outline::square, Fill::filled}, ring{Outline::circle, Fill::open};
  const auto marker = make_template(draw_shape(square, {14, 14}, 2, {18, 18}), square);
  InkMap rest{cv::Mat::zeros(100, 200, CV_32F), cv::Mat::zeros(100, 200, CV_8U)};
  cv::line(rest.coverage, {10, 90}, {190, 60}, cv::Scalar(1), 2);   // a curve
  cv::line(rest.coverage, {100, 10}, {114, 24}, cv::Scalar(1), 2);  // a piece of one
  EXPECT_TRUE(missed_markers(rest, {marker}).empty());
  rest.coverage(cv::Rect(150, 20, 14, 14)).setTo(1);  // one of them
  ASSERT_EQ(missed_markers(rest, {marker}).size(), 1U);
  EXPECT_NEAR(missed_markers(rest, {marker})[0].x, 157, 1);
  rest.coverage(cv::Rect(167, 18, 6, 16)).setTo(1);  // a letter beside it: it is one too
  EXPECT_TRUE(missed_markers(rest, {marker}).empty());
  rest.coverage(cv::Rect(167, 18, 6, 16)).setTo(0);
  rest.coverage(cv::Rect(150, 20, 14, 14)).setTo(0);
  // Three of another shape.
  for (const int x : {20, 50, 80})
    draw_shape(ring, {16, 16}, 2, {20, 20}).copyTo(rest.coverage(cv::Rect(x, 20, 20, 20)));
  EXPECT_EQ(missed_markers(rest, {marker}).size(), 3U);
}

TEST(Doubt, AnInkThatNoiseCannotTellFromAnother) {
  Colours colours;
  colours.inks = {{82, 132, 221}, {82, 78, 196}, {104, 168, 85}};
  colours.lossy = true;
  EXPECT_EQ(ink_beside(colours, 0), 1);
  EXPECT_EQ(ink_beside(colours, 2), -1);
  colours.lossy = false;
  EXPECT_EQ(ink_beside(colours, 0), -1);
}

TEST(Colour, AFineLineThatShowsItsColourThinnedOnly) {
  cv::Mat page(120, 200, CV_8UC3, cv::Scalar::all(255));
  page.row(60).setTo(cv::Scalar(255, 140, 140));  // blue (BGR) at 45 %
  const auto colours = separate(page, {0, 0, 200, 120}, false, {{244, 0, 8}});
  EXPECT_NEAR(coverage_of(colours, colours.ink_of_asked[0]).at<float>(60, 100), 0.45, 0.05);
  const auto none = separate(page, {0, 0, 200, 120}, false, {{0, 200, 0}, {244, 0, 8}});
  EXPECT_EQ(none.ink_of_asked, (std::vector{-1, 0}));
}

TEST(Colour, SuggestedInksAreThoseOfTheFullestPlacesOfTheirStrokes) {
  cv::Mat page(200, 300, CV_8UC3, cv::Scalar::all(255));
  const std::vector<cv::Vec3f> drawn = {{40, 39, 214}, {178, 114, 0}, {0, 159, 230}, {0, 0, 0}};
  // Lines that lean over the rows of pixels: shares of 0.5 to 1.
  for (int k = 0; k < 4; ++k)
    for (int x = 0; x < 300; ++x) {
      const float share = 0.5F + 0.5F * static_cast<float>(x % 40) / 39;
      page.at<cv::Vec3b>(20 + 40 * k, x) =
          cv::Vec3b((1 - share) * cv::Vec3f(255, 255, 255) + share * drawn[k]);
    }
  const auto inks = inks_in(page, {0, 0, 300, 200}, false);
  EXPECT_EQ(inks.size(), 4U);
  for (const auto& ink : drawn)
    EXPECT_TRUE(std::any_of(inks.begin(), inks.end(), [&](cv::Vec3f found) {
      return cv::norm(found - ink) < 20;
    })) << hex_of(ink);
}

TEST(Legend, DashesBetweenMarkersWithBarsAreNoWords) {
  cv::Mat ink = cv::Mat::zeros(400, 500, CV_32F);  // a dashed line through markers with bars
  for (const int x : {100, 160, 220}) {
    cv::circle(ink, {x, 100}, 8, cv::Scalar(1), cv::FILLED);
    ink(cv::Rect(x, 85, 1, 30)).setTo(1);
    ink(cv::Rect(x + 14, 97, 14, 6)).setTo(1);
    ink(cv::Rect(x + 33, 97, 14, 6)).setTo(1);
  }
  EXPECT_TRUE(find_legend_rows(ink, ink, {0, 0, 500, 400}).empty());
}

TEST(Legend, MarkersOfTwoSeriesSideBySideAreNoWord) {
  cv::Mat ink = cv::Mat::zeros(400, 500, CV_32F);
  const auto ring = [&](int x, int y) { cv::circle(ink, {x, y}, 9, cv::Scalar(1), 2); };
  const auto box = [&](int x, int y) {
    cv::rectangle(ink, cv::Rect(x - 12, y - 12, 25, 25), cv::Scalar(1), 2);
  };
  ring(100, 100);
  box(125, 98);
  box(190, 102);
  const auto rows = [&] { return find_legend_rows(ink, ink, {0, 0, 500, 400}).size(); };
  EXPECT_GT(rows(), 0U);  // what a short word and a sample look like
  for (const int x : {150, 210, 270, 330}) ring(x, 300);
  for (const int x : {60, 270, 330}) box(x, 200);
  EXPECT_EQ(rows(), 0U);
}

TEST(Legend, RingsOnADashedLineAreNoWord) {
  cv::Mat ink = cv::Mat::zeros(400, 500, CV_32F);
  const auto ring = [&](int x, int y) { cv::circle(ink, {x, y}, 10, cv::Scalar(1), 2); };
  for (const int x : {190, 241}) ring(x, 100);
  for (const int x : {120, 206}) ink(cv::Rect(x, 97, 32, 6)).setTo(1);  // the second meets a ring
  const auto rows = [&] { return find_legend_rows(ink, ink, {0, 0, 500, 400}).size(); };
  EXPECT_GT(rows(), 0U);
  ring(300, 200);
  ring(350, 240);
  EXPECT_EQ(rows(), 0U);
}

TEST(Legend, FilledMarkersOnALevelDashedLineAreNoWord) {
  cv::Mat ink = cv::Mat::zeros(400, 500, CV_32F);
  const auto disc = [&](int x, int y) { cv::circle(ink, {x, y}, 9, cv::Scalar(1), cv::FILLED); };
  for (const int x : {100, 198, 252}) disc(x, 100);
  for (const int x : {125, 212}) ink(cv::Rect(x, 97, 32, 6)).setTo(1);  // the second meets a disc
  EXPECT_TRUE(find_legend_rows(ink, ink, {0, 0, 500, 400}).empty());
}

TEST(Legend, PaleLettersAndASampleAtItsFrameAreALegend) {
  cv::Mat text = cv::Mat::zeros(200, 300, CV_32F);
  int x = 150;
  for (const int width : {8, 4, 9, 5}) {  // letters, and the blur that joins them
    cv::rectangle(text, cv::Rect(x, 100, width, 10), cv::Scalar(0.38), 1);
    text(cv::Rect(x + width, 104, 2, 3)).setTo(0.25);
    x += width + 2;
  }
  cv::Mat ink = text.clone();
  ink(cv::Rect(100, 90, 2, 30)).setTo(1);    // the frame's side
  ink(cv::Rect(102, 98, 2, 14)).setTo(0.4);  // blur
  ink(cv::Rect(104, 97, 15, 15)).setTo(1);   // half again as high as the letters
  cv::Mat seen = cv::Mat::zeros(ink.size(), CV_8U);
  for (const auto& row : find_legend_rows(text, ink, {0, 0, 300, 200})) seen(row).setTo(1);
  EXPECT_EQ(cv::countNonZero(seen(cv::Rect(104, 97, 15, 15))), 15 * 15);
  EXPECT_EQ(cv::countNonZero(seen.rowRange(0, 80)), 0);
}

TEST(Markers, AtTheEndOfALineHaveItOnOneSideOnly) {
  const Shape shape{Outline::x, Fill::any};
  const cv::Mat drawn = draw_shape(shape, {15, 15}, 2, {19, 19});
  cv::Mat with_line = drawn.clone();
  with_line(cv::Rect(2, 8, 15, 3)).setTo(1);
  const auto marker = make_template(with_line, shape);
  InkMap map{cv::Mat::zeros(100, 200, CV_32F), cv::Mat::zeros(100, 200, CV_8U)};
  for (const int x : {30, 80, 130}) {
    cv::Mat there = map.coverage(cv::Rect(x - 9, 41, 19, 19));
    cv::max(there, drawn, there);
  }
  map.coverage(cv::Rect(30, 49, 100, 3)).setTo(1);
  const auto found = find_markers(map, {marker});
  ASSERT_EQ(found[0].size(), 3U);
  for (const auto& one : found[0]) {
    const double nearest = 30.5 + 50 * std::round((one.at.x - 30.5) / 50);
    EXPECT_NEAR(one.at.x, nearest, 0.5);
    EXPECT_NEAR(one.at.y, 50.5, 0.5);
  }
  // Two arms less, and it is none.
  map.coverage(cv::Rect(20, 53, 20, 8)).setTo(0);
  EXPECT_EQ(find_markers(map, {marker})[0].size(), 2U);
}

TEST(Doubt, AMarkerUnderTheEdgeOfAnotherCurve) {
  const Shape square{Outline::square, Fill::filled};
  const auto marker = make_template(draw_shape(square, {14, 14}, 2, {18, 18}), square);
  InkMap rest{cv::Mat::zeros(100, 200, CV_32F), cv::Mat::zeros(100, 200, CV_8U)};
  cv::line(rest.coverage, {10, 90}, {190, 60}, cv::Scalar(1), 2);
  EXPECT_TRUE(incomplete_markers(rest, {marker}).empty());
  rest.coverage(cv::Rect(50, 20, 14, 14)).setTo(1);
  rest.coverage(cv::Rect(56, 2, 2, 50)).setTo(1);   // its bar
  rest.coverage(cv::Rect(58, 20, 4, 14)).setTo(0);  // the other curve
  EXPECT_TRUE(find_markers(rest, {marker})[0].empty());
  EXPECT_TRUE(missed_markers(rest, {marker}).empty());
  ASSERT_EQ(incomplete_markers(rest, {marker}).size(), 1U);
  EXPECT_LT(cv::norm(incomplete_markers(rest, {marker})[0] - cv::Point2d(57, 27)), 3);
}

TEST(Doubt, BarsAtAFewMarkersAreNone) {
  std::vector<Point> points(9);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].pixel = {10.0 * static_cast<double>(i), 50};
  points[2].bar_pixel[0] = 60;
  points[2].lo = 1.5;
  points[5].bar_pixel[1] = 40;
  points[5].hi = 2.5;
  const auto stray = drop_stray_bars(points);
  ASSERT_EQ(stray.size(), 2U);
  EXPECT_EQ(stray[1], points[5].pixel);
  EXPECT_TRUE(std::isnan(points[2].lo) && std::isnan(points[2].bar_pixel[0]));
  EXPECT_TRUE(std::isnan(points[5].hi) && std::isnan(points[5].bar_pixel[1]));
  points.resize(8);
  for (const std::size_t i : {1, 4}) points[i].lo = 1;
  EXPECT_TRUE(drop_stray_bars(points).empty());
  EXPECT_EQ(points[4].lo, 1);
}

TEST(Doubt, AnErrorBarOfWhichAnEndIsNotSeenWhileMostAre) {
  std::vector<Point> points(5);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].pixel = {10.0 * static_cast<double>(i), 50};
    points[i].bar_pixel[1] = 40;
  }
  EXPECT_TRUE(without_bar(points).empty());  // bars to one side
  points[3].bar_pixel[1] = nan;
  ASSERT_EQ(without_bar(points).size(), 1U);
  EXPECT_EQ(without_bar(points)[0], points[3].pixel);
  points[1].bar_pixel[1] = points[2].bar_pixel[1] = nan;
  EXPECT_TRUE(without_bar(points).empty());  // what is seen is something else
  points[2].bar_pixel[1] = points[3].bar_pixel[1] = 40;
  points.resize(10, points[0]);
  EXPECT_TRUE(without_bar(points).empty());  // one in ten
}

TEST(Doubt, ALineThatIsNotSeenToWithinATwentiethOfAnAxis) {
  const cv::Size area(200, 240);
  auto map = dashed_line(20, 0.2, 3, 500, 0);
  EXPECT_TRUE(gaps_in(trace_line(map, {}, 200), area).empty());
  // Ink of another colour beside the line: it goes on there, but its place cannot be told.
  map.unknown(cv::Rect(0, 10, 45, 10)).setTo(255);
  auto gaps = gaps_in(trace_line(map, {}, 200), area);
  ASSERT_EQ(gaps.size(), 1U);
  EXPECT_LT(gaps[0].x, 45);
  map.unknown(cv::Rect(100, 0, 30, 80)).setTo(255);  // over it
  gaps = gaps_in(trace_line(map, {}, 200), area);
  ASSERT_EQ(gaps.size(), 2U);
  EXPECT_NEAR(gaps[1].x, 115, 4);
}

TEST(Table, QuotesNamesAndWritesNan) {
  Figure figure;
  figure.x.name = "z";
  figure.x.unit = "m";
  figure.y.name = "holdup";
  Digitised found;
  Point point;
  point.x = 1;
  point.x_u = 0.01;
  point.y = 0.5;
  point.y_u = 0.002;
  point.hi = 0.6;
  found.series.push_back({"a, \"b\"", Kind::markers, "", {point}});
  EXPECT_EQ(table_of(found, figure),
            "series,z [m],z_u [m],holdup [-],holdup_u [-],holdup_lo [-],holdup_hi [-]\n"
            "\"a, \"\"b\"\"\",1,0.01,0.5,0.002,nan,0.6\n");
}

}  // namespace
}  // namespace bedscope::digitise
