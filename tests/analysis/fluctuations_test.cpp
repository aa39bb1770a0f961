// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/fluctuations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

#include "analysis/csv.hpp"

namespace bedscope::analysis {
namespace {

Signal sine(std::size_t n, double dt, double frequency, double amplitude, double mean) {
  Signal signal{"sine", "Pa", {}, {}};
  for (std::size_t i = 0; i < n; ++i) {
    signal.times.push_back(5 + static_cast<double>(i) * dt);
    signal.values.push_back(
        mean + amplitude * std::sin(2 * std::numbers::pi * frequency * signal.times.back()));
  }
  return signal;
}

TEST(Fluctuation, of_a_sine_has_its_mean_deviation_and_frequency) {
  std::vector<std::string> problems;
  const auto found = fluctuation_of(sine(3000, 0.01, 2.5, 40, 1000), 0, problems);  // 75 periods
  EXPECT_NEAR(found.mean.value, 1000, 1e-9);
  EXPECT_NEAR(found.deviation.value, 40 / std::numbers::sqrt2, 1e-9);
  EXPECT_NEAR(found.dominant.value, 2.5, 0.005);
  EXPECT_GE(found.spectrum.segments, 8);
  EXPECT_TRUE(problems.empty());
}

TEST(Fluctuation, interval_of_the_deviation_holds_as_often_as_it_says) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  int held = 0;
  for (int record = 0; record < 200; ++record) {
    Signal signal{"noise", "m", {}, {}};
    double x = normal(random);
    for (int i = 0; i < 1000; ++i) {  // AR(1): deviation 1, correlated over some 10 samples
      x = 0.8 * x + 0.6 * normal(random);
      signal.times.push_back(i);
      signal.values.push_back(x);
    }
    std::vector<std::string> problems;
    const auto found = fluctuation_of(signal, 0, problems);
    held += std::abs(found.deviation.value - 1) < found.deviation.ci95;
  }
  EXPECT_GE(held, 180);  // 95 % of 200 less 3 standard errors
}

TEST(Fluctuation, of_long_records_takes_stretches_and_keeps_the_mean) {
  std::vector<std::string> problems;
  const auto found = fluctuation_of(sine(50000, 0.001, 1.2, 3, 7), 0, problems);
  EXPECT_NEAR(found.mean.value, 7, 1e-9);
  EXPECT_NEAR(found.deviation.value, 3 / std::numbers::sqrt2, 1e-9);
  EXPECT_NEAR(found.dominant.value, 1.2, 0.005);
}

TEST(Fluctuation, takes_the_segment_that_is_asked_for) {
  std::vector<std::string> problems;
  const auto found = fluctuation_of(sine(3000, 0.01, 2.5, 40, 0), 5.0, problems);
  EXPECT_NEAR(found.spectrum.resolution, 0.2, 1e-9);
  EXPECT_EQ(found.spectrum.segments, 11);
}

TEST(Fluctuation, of_uneven_samples_is_interpolated_and_said) {
  auto signal = sine(2000, 0.01, 1.5, 2, 0);
  for (std::size_t i = 1; i + 1 < signal.times.size(); i += 2) {
    signal.times[i] += 0.003;
    signal.values[i] = 2 * std::sin(2 * std::numbers::pi * 1.5 * signal.times[i]);
  }
  std::vector<std::string> problems;
  const auto found = fluctuation_of(signal, 0, problems);
  EXPECT_NEAR(found.dominant.value, 1.5, 0.01);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_NE(problems[0].find("uneven"), std::string::npos);
}

TEST(Fluctuation, of_a_constant_is_zero_without_a_spectrum) {
  std::vector<std::string> problems;
  const auto found = fluctuation_of(sine(100, 0.1, 0, 0, 1e5), 0, problems);
  EXPECT_EQ(found.deviation.value, 0);
  EXPECT_TRUE(found.spectrum.frequency.empty());
  EXPECT_TRUE(std::isnan(found.dominant.value));
}

TEST(Fluctuation, of_a_short_record_has_no_spectrum) {
  std::vector<std::string> problems;
  const auto found = fluctuation_of(sine(15, 0.1, 1.3, 1, 0), 0, problems);
  EXPECT_TRUE(found.spectrum.frequency.empty());
  EXPECT_GT(found.deviation.value, 0);
  EXPECT_EQ(problems.size(), 1u);
}

// Van Wachem et al. (2001): some 3 s of relative pressure in a bed of 1.545 mm spheres at 0.9 m/s,
// digitised at 87 uneven times; their spectrum has its peak at 2.4 Hz.
TEST(Fluctuation, of_a_measured_pressure_has_a_sensible_frequency) {
  const std::filesystem::path path =
      std::filesystem::path(BEDSCOPE_SHARED) / "curves/wachem_2001_pressure_fluctuation.csv";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  CsvReader table(path);
  Signal signal{"pressure", "Pa", {}, {}};
  while (table.next()) {
    signal.times.push_back(table.number(table.needed("t_s")));
    signal.values.push_back(table.number(table.needed("relative_pressure_Pa")));
  }
  std::vector<std::string> problems;
  const auto found = fluctuation_of(signal, 0, problems);
  EXPECT_EQ(found.samples, 87u);
  EXPECT_NEAR(found.dominant.value, 2.4, found.dominant.ci95);
  EXPECT_LT(found.dominant.ci95, 1);
  std::printf("dominant %.3f +- %.3f Hz, deviation %.1f +- %.1f Pa, %d segments\n",
              found.dominant.value, found.dominant.ci95, found.deviation.value,
              found.deviation.ci95, found.spectrum.segments);
  for (const auto& problem : problems) std::printf("%s\n", problem.c_str());
}

}  // namespace
}  // namespace bedscope::analysis
