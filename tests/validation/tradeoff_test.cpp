// SPDX-License-Identifier: BSD-3-Clause
// Errors against the finest choice, the front and the recommendation, on sums made by hand.
#include "validation/tradeoff.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bedscope::validation {
namespace {

using analysis::BlockSum;
using analysis::ChoiceLayout;
using analysis::window_blocks;

/// One layer of cells, one product ("axial holdup"), blocks of one snapshot.
TradeoffRun run_of(const std::vector<std::vector<double>>& holdups, std::vector<double> seconds) {
  TradeoffRun run;
  run.label = "a";
  run.sums.thinnings = {{1, 0}};
  run.sums.window.snapshots = window_blocks;
  run.products = {{"axial holdup", 0, 1}};
  for (const auto& holdup : holdups) {
    analysis::VariantSums sums;
    sums.layout.layers = 1;
    sums.layout.z = {0.5};
    sums.sums.resize(1);
    for (std::size_t b = 0; b < window_blocks; ++b) {
      BlockSum block{1, std::vector<double>(sums.layout.size(), 0.)};
      block.sum[0] = holdup[b % holdup.size()];
      sums.sums[0].push_back(block);
    }
    run.sums.variants.push_back(sums);
  }
  for (const double s : seconds) run.costs.push_back({.read = s / window_blocks});
  return run;
}

std::vector<analysis::Variant> variants(std::size_t n) {
  std::vector<analysis::Variant> all(n);
  for (std::size_t v = 0; v < n; ++v) all[v].name = std::string(1, static_cast<char>('a' + v));
  all.front().present = true;
  return all;
}

const Setting& setting(const Tradeoff& tradeoff, const std::string& name) {
  for (const auto& one : tradeoff.settings)
    if (one.name == name + ", every snapshot, whole window") return one;
  throw std::runtime_error(name);
}

TEST(Tradeoff, TheIntervalOfAPairedErrorIsStudentsOfTheDifferences) {
  // Differences alternate between 1 and 3 % of a constant reference: their mean is 2 %, its
  // standard error that of 16 values of standard deviation sqrt(16 / 15) %.
  const TradeoffRun run[] = {run_of({{1.}, {1.01, 1.03}}, {2, 1})};
  const auto tradeoff = weigh(run, variants(2), 1);
  const auto& error = setting(tradeoff, "b").errors[0].whole;
  EXPECT_NEAR(error.value, 0.02, 1e-14);
  EXPECT_NEAR(error.ci95, 2.131449545559 * 0.01 * std::sqrt(16. / 15.) / 4, 1e-12);
  EXPECT_EQ(setting(tradeoff, "a").errors[0].whole.value, 0);
  EXPECT_EQ(setting(tradeoff, "a").errors[0].whole.ci95, 0);
}

TEST(Tradeoff, NoisePairedAwayDoesNotCount) {
  // The reference scatters by half its mean, the setting is 1 % higher in every block.
  std::vector<double> noisy(window_blocks), higher(window_blocks);
  for (std::size_t b = 0; b < window_blocks; ++b) {
    noisy[b] = 1 + 0.5 * std::sin(7. * static_cast<double>(b));
    higher[b] = 1.01 * noisy[b];
  }
  const TradeoffRun run[] = {run_of({noisy, higher}, {2, 1})};
  const auto tradeoff = weigh(run, variants(2), 1);
  EXPECT_NEAR(setting(tradeoff, "b").errors[0].whole.value, 0.01, 1e-13);
  EXPECT_LT(setting(tradeoff, "b").errors[0].whole.ci95, 1e-12);
  EXPECT_GT(tradeoff.noise[0], 0.1);
}

TEST(Tradeoff, TheFrontHoldsWhatNothingCheaperBeats) {
  const TradeoffRun run[] = {run_of({{1.}, {1.02}, {1.05}, {1.03}, {1.2}}, {10, 5, 4, 6, 1})};
  auto tradeoff = weigh(run, variants(5), 1);
  for (auto& one : tradeoff.settings) one.candidate = one.every * one.part == 1;
  const auto front = tradeoff.front(0);
  const auto is_on = [&](const char* name) {
    return front[static_cast<std::size_t>(&setting(tradeoff, name) - tradeoff.settings.data())];
  };
  EXPECT_TRUE(is_on("a"));
  EXPECT_TRUE(is_on("b"));
  EXPECT_TRUE(is_on("c"));
  EXPECT_FALSE(is_on("d"));  // b is cheaper and nearer
  EXPECT_TRUE(setting(tradeoff, "e").errors[0].whole.value > 0.19);
}

TEST(Tradeoff, RecommendsTheCheapestWhoseErrorAndIntervalAreWithin) {
  // b has an error of 2 % and an interval of a third of its size.
  const TradeoffRun run[] = {run_of({{1.}, {1.015, 1.025}, {1.05}}, {10, 5, 1})};
  auto tradeoff = weigh(run, variants(3), 1);
  for (auto& one : tradeoff.settings) one.candidate = one.every * one.part == 1;
  for (const auto& [tolerance, name] :
       {std::pair(0.019, "a"), {0.0201, "a"}, {0.03, "b"}, {0.06, "c"}}) {
    tradeoff.tolerance = tolerance;
    const auto found = recommend(tradeoff);
    EXPECT_EQ(tradeoff.settings[found.setting].name.substr(0, 1), name) << tolerance;
    EXPECT_TRUE(found.kept);
  }
}

TEST(Tradeoff, APromiseBrokenByTheSecondHalfIsReplaced) {
  std::vector<double> late(window_blocks, 1.);
  for (std::size_t b = 8; b < window_blocks; ++b) late[b] = 1.1;
  const TradeoffRun run[] = {run_of({{1.}, late, {1.001}}, {10, 1, 5})};
  auto tradeoff = weigh(run, variants(3), 1);
  for (auto& one : tradeoff.settings) one.candidate = one.every * one.part == 1;
  const auto found = recommend(tradeoff);
  EXPECT_EQ(tradeoff.settings[found.chosen].name.substr(0, 1), "b");
  EXPECT_FALSE(found.kept);
  EXPECT_EQ(tradeoff.settings[found.setting].name.substr(0, 1), "c");
}

TEST(Tradeoff, OfSeveralRunsTheWorstCountsAndCostsAddUp) {
  const TradeoffRun runs[] = {run_of({{1.}, {1.01}}, {2, 1}), run_of({{1.}, {0.96}}, {6, 3})};
  const auto tradeoff = weigh(runs, variants(2), 1);
  EXPECT_NEAR(setting(tradeoff, "b").errors[0].whole.value, 0.04, 1e-13);
  EXPECT_NEAR(setting(tradeoff, "b").seconds, 4, 1e-12);
}

}  // namespace
}  // namespace bedscope::validation
