// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/averages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace bedscope::analysis {
namespace {

constexpr std::size_t snapshots = 1000;

std::vector<double> values_of(std::size_t snapshot) {
  std::mt19937_64 random(snapshot);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return {uniform(random), 1e6 * uniform(random), 1e-6 * uniform(random)};
}

void add(Leaves& leaves, std::size_t snapshot, double weight = 0.1) {
  auto& sum = leaves.at(snapshot);
  sum.weight += weight;
  sum.add(weight, 0, values_of(snapshot));
}

Leaves filled(int first_power, std::size_t limit, std::size_t first = 0) {
  Leaves leaves(first_power, limit);
  for (std::size_t i = first; i < snapshots; ++i) add(leaves, i);
  return leaves;
}

TEST(Leaves, TheTotalHasTheSameBitsWhateverIsKeptApart) {
  const auto reference = filled(4, 7).total();
  for (const std::size_t limit : {1, 2, 9, 63, 1000}) {
    const auto total = filled(4, limit).total();
    EXPECT_EQ(total.weight, reference.weight);
    EXPECT_EQ(total.slots, reference.slots);
  }
}

TEST(Leaves, TheTotalIsTheSumToRounding) {
  const auto total = filled(0, 64).total();
  std::vector<long double> expected(3);
  for (std::size_t i = 0; i < snapshots; ++i)
    for (std::size_t k = 0; k < 3; ++k) expected[k] += 0.1L * values_of(i)[k];
  const std::array<double, 3> scale{1, 1e6, 1e-6};
  for (std::size_t k = 0; k < 3; ++k)  // 1000 roundings of numbers of size `scale`
    EXPECT_NEAR(total.slots[0][k], static_cast<double>(expected[k]), 1e-13 * snapshots * scale[k]);
  EXPECT_NEAR(total.weight, 100, 1e-10);
}

TEST(Leaves, AreBoundedAndAlignedToTheSeries) {
  const auto leaves = filled(0, 64);
  EXPECT_LE(leaves.leaves().size(), 65U);  // one is being filled
  EXPECT_GE(leaves.leaves().size(), 32U);
  EXPECT_EQ(leaves.size(), 16U);
  for (const auto& [number, sum] : leaves.leaves()) {
    const auto inside = std::min(snapshots - number * leaves.size(), leaves.size());
    EXPECT_NEAR(sum.weight, 0.1 * static_cast<double>(inside), 1e-12);  // 16 roundings
  }
}

TEST(Leaves, ASeriesThatGrewGivesTheBitsOfAFreshOne) {
  Leaves grown(4, 8);
  for (std::size_t i = 0; i < 300; ++i) add(grown, i);
  const Leaves copy = grown;  // a live analysis finishes a copy and goes on
  for (std::size_t i = 300; i < snapshots; ++i) add(grown, i);
  EXPECT_EQ(grown.total().slots, filled(4, 8).total().slots);
  EXPECT_NE(copy.total().slots, grown.total().slots);
}

TEST(Leaves, OfLimitZeroAreOneSumInTheOrderOfTheSeries) {
  Leaves leaves(4, 0);
  WeightedSum expected;
  for (std::size_t block = 0; block * 16 < snapshots; ++block) {
    WeightedSum sum;
    for (std::size_t i = block * 16; i < std::min((block + 1) * 16, snapshots); ++i) {
      add(leaves, i);
      sum.weight += 0.1;
      sum.add(0.1, 0, values_of(i));
    }
    expected.merge(sum);
    EXPECT_EQ(leaves.total().slots, expected.slots);
    EXPECT_EQ(leaves.total().weight, expected.weight);
  }
}

TEST(Leaves, ATotalCanBeginAtALeaf) {
  const auto all = filled(4, 128);
  const auto late = filled(4, 128, 160);
  EXPECT_EQ(all.total(160 / all.size()).slots, late.total().slots);
}

TEST(Leaves, AWindowMayBeginAndEndAnywhere) {
  for (const std::size_t first : {1, 17, 100, 333, 999}) {
    const auto reference = filled(4, 1000, first).total();
    for (const std::size_t limit : {1, 2, 5}) {
      const auto leaves = filled(4, limit, first);
      EXPECT_EQ(leaves.total().slots, reference.slots) << first << ' ' << limit;
      EXPECT_LE(leaves.leaves().size(), limit + 1);  // and the one that is being filled
    }
  }
}

TEST(Leaves, ASlotMayFirstOccurLate) {
  Leaves leaves(0, 4);
  for (std::size_t i = 0; i < 20; ++i) {
    add(leaves, i);
    if (i >= 10) leaves.at(i).add(1, 1, {1, 2});
  }
  const auto total = leaves.total();
  ASSERT_EQ(total.slots.size(), 2U);
  EXPECT_EQ(total.slots[1], (std::vector<double>{10, 20}));
}

TEST(Leaves, OfNothingAreNothing) {
  EXPECT_EQ(Leaves(0, 4).total().weight, 0);
  EXPECT_TRUE(Leaves(0, 4).total().slots.empty());
}

}  // namespace
}  // namespace bedscope::analysis
