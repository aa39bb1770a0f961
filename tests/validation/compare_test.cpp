// SPDX-License-Identifier: BSD-3-Clause
#include "validation/compare.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "readers/error.hpp"

namespace bedscope::validation {
namespace {

Sampled straight_line() {
  Sampled s{.x = {"z", "m"}, .y = {"axial holdup", "-"}};
  for (int i = 0; i <= 10; ++i) {
    s.at.push_back(i * .1);
    s.value.push_back(2 * s.at.back());
    s.u.push_back(.01);
  }
  return s;
}

Curve reference(std::vector<CurvePoint> points) {
  return {.name = "reference", .x = {"z", "m"}, .y = {"holdup", "-"}, .points = std::move(points)};
}

TEST(Compare, AStraightLineIsInterpolatedExactlyAndWithoutError) {
  const auto found = compare(straight_line(), reference({{.13, .3}, {.55, 1}}));
  ASSERT_EQ(found.points.size(), 2U);
  EXPECT_DOUBLE_EQ(found.points[0].result, .26);
  EXPECT_NEAR(found.points[0].u_interpolation, 0, 1e-14);
  EXPECT_NEAR(found.points[0].error(), -.04, 1e-15);
}

TEST(Compare, TheErrorOfInterpolationIsThatOfTheChord) {
  // y = x^2 on a grid of h: the chord is off by h^2 / 4 in the middle of a cell.
  Sampled parabola{.x = {"z", "m"}, .y = {"axial holdup", "-"}};
  for (int i = 0; i <= 10; ++i) {
    parabola.at.push_back(i);
    parabola.value.push_back(i * i);
    parabola.u.push_back(0);
  }
  const auto found = compare(parabola, reference({{4.5, 20}}));
  EXPECT_NEAR(found.points[0].u_interpolation, .25, 1e-12);
}

TEST(Compare, TheReferencesAbscissaErrsThroughTheSlope) {
  const auto found = compare(straight_line(), reference({{.5, 1, .03, .08}}));
  EXPECT_NEAR(found.points[0].u_reference, std::hypot(.08, 2 * .03), 1e-12);
  EXPECT_NEAR(found.points[0].u_validation(), std::sqrt(.01 * .01 + .08 * .08 + .06 * .06), 1e-12);
}

TEST(Compare, TheNoiseOfNeighboursIsNoSlope) {
  // y = 2 x + 0.1 to and fro between points 1 mm apart: over the reach of +-30 mm the noise moves
  // the ordinate by 0.1 at most, and the slope by 0.06.
  Sampled noisy{.x = {"z", "m"}, .y = {"axial holdup", "-"}};
  for (int i = 0; i <= 1000; ++i) {
    noisy.at.push_back(i * .001);
    noisy.value.push_back(2 * noisy.at.back() + (i % 2 == 0 ? .1 : -.1));
    noisy.u.push_back(0);
  }
  const auto found = compare(noisy, reference({{.5, 1, .03, 0}, {.9999, 2, .03, 0}}));
  EXPECT_LE(found.points[0].u_reference, .06 + .1);
  EXPECT_LE(found.points[1].u_reference, .06 + .2);  // the half of it that lies inside
  EXPECT_GE(found.points[0].u_reference, .06 - 1e-12);
}

TEST(Compare, TheArmOfABarThatFacesTheResultCounts) {
  const auto above = compare(straight_line(), reference({{.5, .9, 0, .3, .1}}));  // result 1
  EXPECT_DOUBLE_EQ(above.points[0].u_reference, .3);
  EXPECT_DOUBLE_EQ(above.points[0].away(), .1);
  const auto below = compare(straight_line(), reference({{.5, 1.1, 0, .3, .1}}));
  EXPECT_DOUBLE_EQ(below.points[0].u_reference, .1);
}

TEST(Compare, WhereTheResultHasNoErrorItIsNotComparedAndCounted) {
  auto line = straight_line();
  line.u[3] = NAN;
  const auto found = compare(line, reference({{.05, 0}, {.25, 0}, {.35, 0}, {.5, 1}}));
  EXPECT_EQ(found.points.size(), 2U);
  EXPECT_EQ(found.without_error.size(), 2U);
  line.u.assign(line.u.size(), NAN);
  EXPECT_THROW(compare(line, reference({{.5, 1}})), InputError);
}

TEST(Compare, NothingIsExtrapolatedAndWhatLiesOutsideIsKept) {
  const auto found = compare(straight_line(), reference({{-.01, 0}, {.5, 1}, {1.2, 3}}));
  EXPECT_EQ(found.points.size(), 1U);
  ASSERT_EQ(found.outside.size(), 2U);
  EXPECT_EQ(found.outside[1].x, 1.2);
  EXPECT_THROW(compare(straight_line(), reference({{1.5, 1}})), InputError);
}

TEST(Compare, ValuesThatNobodySawAreLeftOut) {
  auto line = straight_line();
  line.value[0] = line.value[10] = NAN;
  const auto found = compare(line, reference({{.05, 0}, {.5, 1}}));
  EXPECT_EQ(found.points.size(), 1U);
  EXPECT_EQ(found.outside.size(), 1U);
}

TEST(Compare, NothingIsInterpolatedAcrossAGap) {
  auto line = straight_line();
  line.value[4] = line.value[5] = line.value[8] = NAN;  // 0.3 to 0.6, 0.7 to 0.9
  const auto found =
      compare(line, reference({{.3, 0}, {.31, 0}, {.45, 0}, {.6, 0}, {.65, 0}, {.8, 0}, {1, 0}}));
  ASSERT_EQ(found.points.size(), 4U);
  EXPECT_EQ(found.points[1].x, .6);
  EXPECT_EQ(found.outside.size(), 3U);
  EXPECT_EQ(found.in_gaps, 3U);
}

TEST(Compare, UnitsHaveToAgree) {
  auto line = straight_line();
  line.y.unit = "kg/m2/s";
  EXPECT_THROW(compare(line, reference({{.5, 1}})), InputError);
}

TEST(Compare, AnUnknownOrientationIsTriedBothWays) {
  auto turned = reference({{.1, 1.8}, {.3, 1.4}, {.8, .4}});
  turned.about.orientation_known = false;
  const auto found = compare(straight_line(), turned);
  EXPECT_TRUE(found.mirrored);
  for (const auto& point : found.points) EXPECT_NEAR(point.error(), 0, 1e-12);
  turned.about.orientation_known = true;
  EXPECT_FALSE(compare(straight_line(), turned).mirrored);
}

}  // namespace
}  // namespace bedscope::validation
