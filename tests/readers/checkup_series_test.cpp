// SPDX-License-Identifier: BSD-3-Clause
// Gaps and changes of spacing in made series of steps; trends of known slope in known noise.
#include "readers/checkup_series.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace bedscope::readers {
namespace {

using Steps = std::vector<std::int64_t>;

TEST(StepSpacing, OfEvenStepsHasNoGaps) {
  const auto found = spacing_of(Steps{9500, 10000, 10500});
  EXPECT_EQ(found.usual, 500);
  EXPECT_TRUE(found.even());
  EXPECT_EQ(spacing_of(Steps{5}).usual, 0);
  EXPECT_EQ(spacing_of(Steps{}).usual, 0);
  EXPECT_EQ(spacing_of(Steps{1, 8}).usual, 7);
}

TEST(StepSpacing, MissingStepsAreGaps) {
  const auto found = spacing_of(Steps{0, 100, 200, 300, 500, 600, 1000, 1100});
  EXPECT_EQ(found.usual, 100);
  ASSERT_EQ(found.gaps.size(), 2U);
  EXPECT_EQ(found.gaps[0].before, 300);
  EXPECT_EQ(found.gaps[0].after, 500);
  EXPECT_EQ(found.gaps[0].missing(), 1U);
  EXPECT_EQ(found.gaps[1].missing(), 3U);
  EXPECT_EQ(found.missing(), 4U);
  EXPECT_TRUE(found.changes.empty());
  EXPECT_EQ(found.irregular, 0U);
}

TEST(StepSpacing, AGapBeforeTheFirstLongStretchIsFoundToo) {
  const auto found = spacing_of(Steps{0, 200, 300, 400, 500});
  ASSERT_EQ(found.gaps.size(), 1U);
  EXPECT_EQ(found.gaps[0].before, 0);
}

TEST(StepSpacing, AnotherIntervalAfterARestartIsAChange) {
  const auto found = spacing_of(Steps{0, 100, 200, 300, 350, 400, 450});
  EXPECT_TRUE(found.gaps.empty());
  ASSERT_EQ(found.changes.size(), 1U);
  EXPECT_EQ(found.changes[0].step, 300);
  EXPECT_EQ(found.changes[0].from, 100);
  EXPECT_EQ(found.changes[0].to, 50);
  EXPECT_EQ(found.irregular, 0U);
  // A coarser one is a change as well, not a row of gaps.
  const auto coarser = spacing_of(Steps{0, 100, 200, 300, 500, 700, 900});
  EXPECT_TRUE(coarser.gaps.empty());
  ASSERT_EQ(coarser.changes.size(), 1U);
  EXPECT_EQ(coarser.changes[0].to, 200);
}

TEST(StepSpacing, WhatFitsNothingIsIrregular) {
  EXPECT_EQ(spacing_of(Steps{0, 100, 200, 300, 345, 400, 500, 600}).irregular, 2U);
  const auto none = spacing_of(Steps{0, 1, 10, 100, 1000});
  EXPECT_EQ(none.irregular, 3U);  // all but those of the most common spacing
  EXPECT_TRUE(none.gaps.empty());
}

TEST(StepSpacing, StepsOfAnySizeDoNotOverflow) {
  constexpr auto least = std::numeric_limits<std::int64_t>::min();
  constexpr auto most = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(spacing_of(Steps{least, most}).usual, most);
  const auto found = spacing_of(Steps{least, -2, -1, 0, 1, most});
  EXPECT_EQ(found.irregular, 2U);
  EXPECT_EQ(found.missing(), 0U);
}

TEST(Trend, OfAStraightLineIsItsSlope) {
  std::vector<double> x, y;
  for (int i = 0; i <= 40; ++i) {
    x.push_back(100 * i);
    y.push_back(1000 - 5 * i);  // 1000 to 800, mean 900
  }
  const auto trend = trend_of(x, y);
  ASSERT_TRUE(trend);
  EXPECT_NEAR(trend->mean, 900, 10);
  EXPECT_NEAR(trend->change, -200 / trend->mean, 1e-12);
  EXPECT_LT(trend->ci99, 1e-12);
  EXPECT_TRUE(trend->significant());
}

TEST(Trend, NeedsFivePointsAndFiniteValues) {
  const std::vector<double> x{1, 2, 3, 4, 5};
  EXPECT_FALSE(trend_of(std::span(x).first(4), std::span(x).first(4)));
  EXPECT_TRUE(trend_of(x, x));
  EXPECT_FALSE(trend_of(x, std::vector<double>{1, 2, std::nan(""), 4, 5}));
  EXPECT_FALSE(trend_of(x, std::vector<double>(5, 0.)));
  EXPECT_FALSE(trend_of(std::vector<double>(5, 1.), x));
}

/// Autoregressive noise that hangs together over 1/(1 - memory) points.
std::vector<double> noise(std::size_t count, double memory, std::mt19937_64& random) {
  std::normal_distribution<double> normal(0, 1);
  std::vector<double> values{normal(random) / std::sqrt(1 - memory * memory)};
  while (values.size() < count) values.push_back(memory * values.back() + normal(random));
  return values;
}

TEST(Trend, OfSteadyNoiseThatHangsTogetherIsRarelySignificant) {
  std::mt19937_64 random(5);
  std::vector<double> x(500);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<double>(i);
  int significant = 0, independent_points = 0;
  constexpr int runs = 1000;
  for (int run = 0; run < runs; ++run) {
    auto y = noise(x.size(), 0.8, random);
    for (auto& value : y) value = 10 + 0.3 * value;
    significant += trend_of(x, y)->significant() ? 1 : 0;
    // The same fit as if points were independent, by its textbook formula.
    double xx = 0, xy = 0, rest = 0, mean = 0;
    const double middle = (static_cast<double>(x.size()) - 1) / 2;
    for (const double value : y) mean += value / static_cast<double>(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      xx += (x[i] - middle) * (x[i] - middle);
      xy += (x[i] - middle) * (y[i] - mean);
    }
    for (std::size_t i = 0; i < x.size(); ++i)
      rest += std::pow(y[i] - mean - xy / xx * (x[i] - middle), 2);
    const double error = std::sqrt(rest / (static_cast<double>(x.size()) - 2) / xx);
    independent_points += std::abs(xy / xx) > 2.586 * error ? 1 : 0;
  }
  // 1 % by construction; 3 % leaves room for 1000 runs and for the rest of the correlation.
  EXPECT_LT(significant, 3 * runs / 100);
  EXPECT_GT(independent_points, 20 * runs / 100);  // which is why there are batches
}

}  // namespace
}  // namespace bedscope::readers
