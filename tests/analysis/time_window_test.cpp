// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/time_window.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace bedscope::analysis {
namespace {

std::vector<double> times_of(std::vector<long> steps, double time_step) {
  std::vector<double> times;
  for (const long step : steps) times.push_back(static_cast<double>(step) * time_step);
  return times;
}

TEST(TimeWeights, AreEqualForEqualSpacing) {
  const std::vector<double> times{1.0, 1.25, 1.5, 1.75};  // exact in binary
  EXPECT_EQ(time_weights(times), std::vector<double>(4, 0.25));
}

TEST(TimeWeights, AreHalfTheGapsInsideAndTheOneGapAtTheEnds) {
  EXPECT_EQ(time_weights(std::vector<double>{0, 1, 3, 7}), (std::vector<double>{1, 1.5, 3, 4}));
}

TEST(TimeWeights, OfTwoAreTheirGap) {
  EXPECT_EQ(time_weights(std::vector<double>{2, 5}), (std::vector<double>{3, 3}));
}

TEST(TimeWeights, OfOneSnapshotIsOne) {
  EXPECT_EQ(time_weights(std::vector<double>{42}), std::vector<double>{1});
}

TEST(TimeWeights, OfNoneAreNone) { EXPECT_TRUE(time_weights({}).empty()); }

TEST(TimeWeights, SumToTheWindowAndHalfAGapAtEachEnd) {
  const std::vector<double> times{0.1, 0.2, 0.7, 0.8, 1.9};
  const std::vector<double> weights = time_weights(times);
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  EXPECT_NEAR(sum, 1.8 + 0.1 / 2 + 1.1 / 2, 1e-15);  // rounding of five sums of order 1
}

TEST(SelectWindow, TakesBothEnds) {
  const auto window = select_window(times_of({0, 10, 20, 30, 40}, 1.0), 10, 30, 0.5);
  EXPECT_EQ(window.first, 1U);
  EXPECT_EQ(window.count, 3U);
}

TEST(SelectWindow, TakesAnEndWhoseTimeIsOffByRounding) {
  const std::vector<double> times = times_of({1, 2, 3, 4, 6, 7}, 0.1);
  ASSERT_GT(times[2], 0.3);  // 3 * 0.1 in binary: the case this is about
  const auto upper = select_window(times, 0.1, 0.3, 0.05);
  EXPECT_EQ(upper.count, 3U);
  const auto lower = select_window(times, std::nextafter(0.6, 1) + 2e-16, 0.7, 0.05);
  EXPECT_EQ(lower.first, 4U);
  EXPECT_EQ(lower.count, 2U);
}

TEST(SelectWindow, TakesWhatLiesExactlyHalfAStepOutside) {
  const auto window = select_window(times_of({0, 1, 2, 3}, 1.0), 1.5, 1.5, 0.5);
  EXPECT_EQ(window.first, 1U);
  EXPECT_EQ(window.count, 2U);
}

TEST(SelectWindow, LeavesOutTheNeighboursOfASingleSnapshot) {
  const auto window = select_window(times_of({999, 1000, 1001}, 1e-5), 1e-2, 1e-2, 0.4e-5);
  EXPECT_EQ(window.first, 1U);
  EXPECT_EQ(window.count, 1U);
}

TEST(SelectWindow, IsEmptyOutsideTheSeriesBetweenSnapshotsAndUpsideDown) {
  const std::vector<double> times{0, 1, 2, 3};
  EXPECT_EQ(select_window(times, 5, 9, 0.1).count, 0U);
  EXPECT_EQ(select_window(times, -9, -5, 0.1).count, 0U);
  EXPECT_EQ(select_window(times, 1.3, 1.6, 0.1).count, 0U);
  EXPECT_EQ(select_window(times, 3, 1, 0.1).count, 0U);
  EXPECT_EQ(select_window({}, 0, 1, 0.1).count, 0U);
}

TEST(SelectWindow, TakesAllBetweenInfinities) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto window = select_window(std::vector<double>{0, 1, 2}, -infinity, infinity, 0.5);
  EXPECT_EQ(window.first, 0U);
  EXPECT_EQ(window.count, 3U);
}

}  // namespace
}  // namespace bedscope::analysis
