// SPDX-License-Identifier: BSD-3-Clause
// Sines, noise and what must add up; scipy.signal.welch judges in tests/app.
#include "analysis/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

namespace bedscope::analysis {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<double> sine(std::size_t n, double frequency, double amplitude, double phase = 0.4) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i)
    values[i] = amplitude * std::sin(2 * pi * frequency * static_cast<double>(i) + phase);
  return values;
}

std::vector<double> noise(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(3, 2);
  std::vector<double> values(n);
  for (double& value : values) value = normal(random);
  return values;
}

double power(const Spectrum& spectrum) {
  return spectrum.resolution *
         std::accumulate(spectrum.density.begin(), spectrum.density.end(), 0.);
}

/// The right-hand side of Parseval's theorem, straight from the definition.
double windowed_variance(const std::vector<double>& values, std::size_t length) {
  double sum = 0;
  int segments = 0;
  for (std::size_t first = 0; first + length <= values.size(); first += length / 2, ++segments) {
    double n = 0, t = 0, x = 0, tt = 0, tx = 0;
    for (std::size_t i = 0; i < length; ++i) {
      const auto at = static_cast<double>(i);
      n += 1;
      t += at;
      x += values[first + i];
      tt += at * at;
      tx += at * values[first + i];
    }
    const double slope = (n * tx - t * x) / (n * tt - t * t), origin = (x - slope * t) / n;
    double squares = 0, weights = 0;
    for (std::size_t i = 0; i < length; ++i) {
      const auto at = static_cast<double>(i);
      const double s = std::sin(pi * at / static_cast<double>(length));
      squares += std::pow(s * s * (values[first + i] - origin - slope * at), 2);
      weights += std::pow(s, 4);
    }
    sum += squares / weights;
  }
  return sum / segments;
}

TEST(Spectrum, adds_up_to_the_windowed_variance_of_its_segments) {
  for (const std::size_t length : {4, 6, 30, 100, 256, 998, 1000}) {
    const auto values = noise(1000, 7);
    const auto spectrum = welch(values, 0.01, length);
    EXPECT_NEAR(power(spectrum) / windowed_variance(values, length), 1, 1e-12) << length;
    EXPECT_DOUBLE_EQ(spectrum.frequency.back(), 50);  // Nyquist
  }
}

TEST(Spectrum, of_white_noise_is_flat_at_twice_variance_over_the_sampling_rate) {
  const auto spectrum = welch(noise(200000, 3), 0.01, 200);
  for (std::size_t k = 3; k + 2 < spectrum.density.size(); ++k)
    EXPECT_NEAR(spectrum.density[k], 2 * 4 * 0.01, 0.016);  // 6 standard errors: 0.08 / sqrt(2000)
}

TEST(Spectrum, interval_holds_as_often_as_it_says) {
  // White noise of variance 4: the true density is 8 dt. 500 records, 8 segments, well apart bins.
  int held = 0, all = 0;
  for (unsigned seed = 0; seed < 500; ++seed) {
    const auto spectrum = welch(noise(288, 100 + seed), 1, 64);
    ASSERT_EQ(spectrum.segments, 8);
    for (std::size_t k = 4; k < 30; k += 4, ++all)
      held += spectrum.low[k] < 8 && 8 < spectrum.high[k];
  }
  EXPECT_NEAR(static_cast<double>(held) / all, 0.95, 0.02);  // 3500: 5 standard errors
}

TEST(Spectrum, degrees_of_freedom_are_those_of_welch_for_the_hann_window) {
  const auto spectrum = welch(noise(4500, 1), 1, 1000);
  ASSERT_EQ(spectrum.segments, 8);
  // rho = (1/6)^2 of half-overlapping Hann windows
  EXPECT_NEAR(spectrum.degrees_of_freedom, 16 / (1 + 2 * (7. / 8) / 36), 1e-9);
}

TEST(Spectrum, finds_the_frequency_of_a_sine_between_its_bins) {
  for (const double frequency : {0.05, 0.0512, 0.0531, 0.21, 0.333}) {
    const auto values = sine(900, frequency, 3);
    const auto spectrum = welch(values, 1, 200);
    const auto found = dominant_frequency(spectrum);
    EXPECT_NEAR(found.value, frequency, 0.02 * spectrum.resolution);
    EXPECT_GE(found.ci95, spectrum.resolution);
    EXPECT_NEAR(power(spectrum), 4.5, 0.01);  // A^2 / 2
  }
}

TEST(Spectrum, does_not_see_a_straight_line) {
  auto values = sine(900, 0.1, 1);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += 50 + 0.3 * static_cast<double>(i);
  const auto spectrum = welch(values, 1, 200);
  EXPECT_NEAR(dominant_frequency(spectrum).value, 0.1, 1e-3);
  EXPECT_LT(spectrum.density[0], 1e-3 * spectrum.density[20]);
}

TEST(Spectrum, of_a_constant_has_no_dominant_frequency) {
  EXPECT_TRUE(std::isnan(dominant_frequency(welch(std::vector<double>(64, 0.), 1, 32)).value));
}

TEST(SegmentLength, is_eight_segments_where_each_holds_five_periods) {
  EXPECT_EQ(segment_length(sine(4500, 0.05, 1)), 1000u);
  EXPECT_EQ(welch(sine(4500, 0.05, 1), 1, 1000).segments, 8);
}

TEST(SegmentLength, keeps_five_periods_where_the_record_is_short) {
  const auto values = sine(1000, 0.012, 1);  // 12 periods: 2 n / (K + 1) holds 5 for K = 3
  EXPECT_EQ(segment_length(values), 500u);
  EXPECT_EQ(segment_length(sine(1000, 0.004, 1)), 1000u);  // 4 periods
  EXPECT_EQ(segment_length(noise(17, 1)) % 2, 0u);
}

TEST(ChiSquared, quantiles_are_those_of_tables) {
  // Abramowitz and Stegun, table 26.8
  EXPECT_NEAR(chi_squared(0.975, 1), 5.02389, 5e-6);
  EXPECT_NEAR(chi_squared(0.025, 2), 0.0506356, 5e-8);
  EXPECT_NEAR(chi_squared(0.95, 10), 18.3070, 5e-5);
  EXPECT_NEAR(chi_squared(0.025, 30), 16.7908, 5e-5);
  EXPECT_NEAR(chi_squared(0.975, 100), 129.561, 5e-4);
  EXPECT_NEAR(chi_squared(0.5, 20000), 20000 - 2. / 3, 1e-3);  // Wilson and Hilferty
}

}  // namespace
}  // namespace bedscope::analysis
