// SPDX-License-Identifier: BSD-3-Clause
#include "validation/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "readers/error.hpp"
#include "validation/verdict.hpp"

namespace bedscope::validation {
namespace {

Sampled profile(const std::function<double(double)>& f, double u = 0, int n = 41) {
  Sampled s{.x = {"x", "m"}, .y = {"lateral holdup", "-"}};
  for (int i = 0; i < n; ++i) {
    s.at.push_back(.07 * i / (n - 1));
    s.value.push_back(f(2. * i / (n - 1) - 1));
    s.u.push_back(u);
  }
  return s;
}

Outcome verdict(const char* name, const Sampled& of) {
  const auto* shape = find_shape(name);
  return judge(evaluate(*shape, of), shape->limit, shape->small_is_good);
}

TEST(Shapes, EachIsFoundWhereItIsAndNotWhereItIsNot) {
  const auto u = profile([](double x) { return 1 + x * x; });
  const auto arch = profile([](double x) { return 2 - x * x; });
  const auto slope = profile([](double x) { return 2 - x; });
  const auto core = profile([](double x) { return .5 - x * x; });
  EXPECT_EQ(verdict("u-shaped", u), Outcome::holds);
  EXPECT_EQ(verdict("u-shaped", arch), Outcome::does_not_hold);
  EXPECT_EQ(verdict("u-shaped", slope), Outcome::does_not_hold);  // one wall only
  EXPECT_EQ(verdict("core-annulus", arch), Outcome::holds);
  EXPECT_EQ(verdict("core-annulus", u), Outcome::does_not_hold);
  EXPECT_EQ(verdict("down-flow at walls", core), Outcome::holds);
  EXPECT_EQ(verdict("down-flow at walls", u), Outcome::does_not_hold);
  EXPECT_EQ(verdict("decreasing", slope), Outcome::holds);
  EXPECT_EQ(verdict("decreasing", u), Outcome::does_not_hold);
  EXPECT_EQ(verdict("symmetric", u), Outcome::holds);
  EXPECT_EQ(verdict("symmetric", slope), Outcome::does_not_hold);
  EXPECT_EQ(verdict("near walls", u), Outcome::holds);
  EXPECT_EQ(verdict("near walls", arch), Outcome::does_not_hold);
}

TEST(Shapes, InNoiseAreUndecided) {
  const auto faint = profile([](double x) { return 1 + .01 * x * x; }, .5);
  EXPECT_EQ(verdict("u-shaped", faint), Outcome::undecided);
  EXPECT_EQ(verdict("decreasing", faint), Outcome::undecided);
}

TEST(Shapes, AreNotSmoothedByInflatedErrorBars) {
  // One of 24 points stands out of a steep fall, 0.058 of the mean; errors that all points share
  // are no noise that may be taken off, however wide the bars are.
  const auto bump = [](double x) { return 4 - 3 * x + (std::abs(x - 1 / 23.) < .01 ? 1.8 : 0); };
  ASSERT_EQ(verdict("decreasing", profile(bump, 0, 24)), Outcome::does_not_hold);
  for (const double u : {.1, .4, .57, .65, .73, .8, 2.})
    EXPECT_NE(verdict("decreasing", profile(bump, u, 24)), Outcome::holds) << u;
}

TEST(Shapes, OfADistanceReachDownToNothing) {
  const auto slope = [](double x) { return 2 - .4 * x; };
  for (const char* shape : {"decreasing", "symmetric"})
    EXPECT_EQ(evaluate(*find_shape(shape), profile(slope, .3)).lo, 0) << shape;
}

TEST(Shapes, DecreasingIsTheDistanceFromTheNearestFallingProfile) {
  // 3 1 2 0: the pair 1 2 pools to 1.5, so the rmse is sqrt(2 * 0.25 / 4) ... with a fifth point.
  Sampled s{.x = {"z", "m"},
            .y = {"axial holdup", "-"},
            .at = {0, 1, 2, 3, 4},
            .value = {3, 1, 2, 0, 0},
            .u = {0, 0, 0, 0, 0}};
  EXPECT_NEAR(evaluate(*find_shape("decreasing"), s).value, std::sqrt(.5 / 5) / 1.2, 1e-12);
}

TEST(Shapes, TakePointsWhereTheyLieHoweverTheyAreSpaced) {
  // 1 + x^2, x from -1 to 1: no point between -0.4 and 0.4, or most of them at one side.
  for (const auto& places : {std::vector<double>{-1, -.8, -.45, .45, .8, 1},
                             std::vector<double>{-1, -.9, -.8, -.7, -.6, -.4, -.1, .3, .7, 1}}) {
    Sampled s{.x = {"x", "m"}, .y = {"lateral holdup", "-"}};
    for (const double x : places) {
      s.at.push_back(x);
      s.value.push_back(1 + x * x);
      s.u.push_back(0);
    }
    EXPECT_EQ(verdict("u-shaped", s), Outcome::holds);
    EXPECT_EQ(verdict("core-annulus", s), Outcome::does_not_hold);
    EXPECT_LT(evaluate(*find_shape("symmetric"), s).value, .05);  // chords of the parabola
  }
}

TEST(Shapes, NeedAProfile) {
  EXPECT_EQ(find_shape("v-shaped"), nullptr);
  EXPECT_THROW(evaluate(*find_shape("symmetric"), profile([](double x) { return x; }, 0, 3)),
               InputError);
}

}  // namespace
}  // namespace bedscope::validation
