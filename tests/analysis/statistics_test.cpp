// SPDX-License-Identifier: BSD-3-Clause
// Closed forms and invariants of the statistics; coverage_test.cpp holds the random series.
#include "analysis/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

namespace bedscope::analysis {
namespace {

using Series = std::vector<double>;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Series ones(std::size_t n) { return Series(n, 1.0); }

/// AR(1) driven by uniform noise: enough here, and the same with every library.
Series correlated(std::size_t n, double rho, unsigned seed = 5) {
  std::mt19937 engine(seed);
  Series series(n);
  double state = 0;
  for (double& x : series) {
    state = rho * state + static_cast<double>(engine()) / 0x1p32 - 0.5;
    x = state;
  }
  return series;
}

double mean_of(const Series& series) {
  return std::accumulate(series.begin(), series.end(), 0.0) / static_cast<double>(series.size());
}

// Student's t

TEST(StudentT, AgreesWithPublishedTables) {
  struct Row {  // Abramowitz and Stegun, table 26.10, to its three decimals
    int dof;
    double t90, t95, t99;
  };
  for (const auto& [dof, t90, t95, t99] : {Row{1, 6.314, 12.706, 63.657},
                                           {2, 2.920, 4.303, 9.925},
                                           {3, 2.353, 3.182, 5.841},
                                           {4, 2.132, 2.776, 4.604},
                                           {5, 2.015, 2.571, 4.032},
                                           {9, 1.833, 2.262, 3.250},
                                           {10, 1.812, 2.228, 3.169},
                                           {30, 1.697, 2.042, 2.750},
                                           {120, 1.658, 1.980, 2.617}}) {
    EXPECT_NEAR(student_t(0.90, dof), t90, 5e-4) << dof;  // half of the last printed digit
    EXPECT_NEAR(student_t(0.95, dof), t95, 5e-4) << dof;
    EXPECT_NEAR(student_t(0.99, dof), t99, 5e-4) << dof;
  }
}

TEST(StudentT, HasItsClosedFormsForOneTwoAndFourDegreesOfFreedom) {
  for (const double p : {0.1, 0.5, 0.9, 0.95, 0.99, 0.999}) {
    const double alpha = (1 - p) * (1 + p);
    const double q = std::cos(std::acos(std::sqrt(alpha)) / 3) / std::sqrt(alpha);
    // Relative 1e-11: rounding, times the slope of tan near the pole at p = 0.999.
    EXPECT_NEAR(student_t(p, 1) / std::tan(std::numbers::pi * p / 2), 1, 1e-11) << p;
    EXPECT_NEAR(student_t(p, 2) / (p * std::sqrt(2 / alpha)), 1, 1e-11) << p;
    EXPECT_NEAR(student_t(p, 4) / (2 * std::sqrt(q - 1)), 1, 1e-11) << p;  // Shaw (2006)
  }
}

TEST(StudentT, IntegratesItsDensityToTheConfidence) {
  for (const int dof : {3, 5, 6, 7, 8, 9, 25}) {
    const double t = student_t(0.95, dof);
    constexpr int intervals = 2000;
    const double step = t / intervals;
    const auto density = [dof](double x) { return std::pow(1 + x * x / dof, -(dof + 1) / 2.0); };
    double simpson = density(0) + density(t);
    for (int i = 1; i < intervals; ++i) simpson += (i % 2 == 1 ? 4 : 2) * density(i * step);
    const double scale = std::exp(std::lgamma((dof + 1) / 2.0) - std::lgamma(dof / 2.0)) /
                         std::sqrt(dof * std::numbers::pi);
    EXPECT_NEAR(2 * scale * simpson * step / 3, 0.95, 1e-11) << dof;  // Simpson's error, h^4
  }
}

TEST(StudentT, TendsToTheNormalQuantile) {
  const double z = 1.959963984540054;
  const int dof = 100000;
  const double first_order = (z * z * z + z) / (4.0 * dof);
  EXPECT_NEAR(student_t(0.95, dof), z + first_order, 5e-10);  // next term is of order z^5 / dof^2
}

// Autocorrelation time

TEST(AutocorrelationTime, OfALongAr1SeriesIsItsClosedForm) {
  for (const double rho : {0.0, 0.5, 0.9}) {
    Series series = correlated(200000, rho);
    const double mean = mean_of(series);
    for (double& x : series) x -= mean;
    const AutocorrelationTime time = autocorrelation_time(series);
    const double exact = (1 + rho) / (1 - rho);
    EXPECT_NEAR(time.value / exact, 1, 4 * time.relative_error) << rho;  // four standard errors
    EXPECT_LT(time.relative_error, 0.05) << rho;
  }
}

TEST(AutocorrelationTime, OfZerosIsOne) {
  EXPECT_EQ(autocorrelation_time(Series(50, 0.0)).value, 1);
}

TEST(AutocorrelationTime, StaysPositiveForDifferencesWhoseTimeIsZero) {
  const Series noise = correlated(101, 0);
  Series differences(100);
  for (std::size_t i = 0; i < 100; ++i) differences[i] = noise[i + 1] - noise[i];
  const double time = autocorrelation_time(differences).value;
  EXPECT_GE(time, 0.01);
  EXPECT_LT(time, 0.5);
}

// Mean

TEST(EstimateMean, IsThePlainMeanToTheBitForEqualWeights) {
  const Series values = correlated(137, 0.6);
  EXPECT_EQ(estimate_mean(values, Series(137, 0.1)).value, mean_of(values));
}

TEST(EstimateMean, TakesEachOfFewSamplesAsABatch) {
  const MeanEstimate mean = estimate_mean(Series{1, 2, 3, 6}, ones(4));
  EXPECT_DOUBLE_EQ(mean.value, 3);
  // s^2 = (4 + 1 + 0 + 9) / 3, three degrees of freedom
  EXPECT_DOUBLE_EQ(mean.ci95, student_t(0.95, 3) * std::sqrt(14.0 / 3 / 4));
  EXPECT_EQ(mean.independent_samples, 4);
  EXPECT_TRUE(mean.few_samples);
}

TEST(EstimateMean, WarnsOfFewSamplesBelowTen) {
  for (std::size_t n = 2; n < 10; ++n)
    EXPECT_TRUE(estimate_mean(correlated(n, 0), ones(n)).few_samples) << n;
  EXPECT_FALSE(estimate_mean(correlated(400, 0), ones(400)).few_samples);
}

TEST(EstimateMean, UsesTenBatchesOfUncorrelatedSamples) {
  // Second implementation, by the definition; 403 samples do not divide by ten.
  const Series values = correlated(403, 0);
  Series weights = ones(403);
  for (std::size_t i = 0; i < 403; i += 3) weights[i] = 1.5;
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double mean =
      std::inner_product(values.begin(), values.end(), weights.begin(), 0.0) / total;
  double variance = 0;
  for (std::size_t b = 0; b < 10; ++b) {
    double weight = 0, sum = 0;
    for (std::size_t i = b * 403 / 10; i < (b + 1) * 403 / 10; ++i) {
      weight += weights[i];
      sum += weights[i] * values[i];
    }
    const double share = weight / total, deviation = sum / weight - mean;
    variance += share * share * deviation * deviation * 10 / 9;
  }
  const MeanEstimate estimate = estimate_mean(values, weights);
  EXPECT_NEAR(estimate.value, mean, 1e-14);  // rounding of sums of order 1
  EXPECT_NEAR(estimate.ci95, student_t(0.95, 9) * std::sqrt(variance), 1e-12);
}

TEST(EstimateMean, HasFewerAndLongerBatchesTheLongerTheCorrelation) {
  // Four batches: ci95 is at least t(3 dof) times the error by the autocorrelation time.
  const Series values = correlated(400, 0.98);
  Series deviations = values;
  const double mean = mean_of(values);
  for (double& x : deviations) x -= mean;
  const double variance =
      std::inner_product(deviations.begin(), deviations.end(), deviations.begin(), 0.0) / 399;
  const double time = autocorrelation_time(deviations).value;
  ASSERT_LT(400 / time, 25);  // so that n / (5 tau) < 5
  const MeanEstimate estimate = estimate_mean(values, ones(400));
  EXPECT_GE(estimate.ci95, student_t(0.95, 3) * std::sqrt(variance * time / 400) * (1 - 1e-12));
  EXPECT_NEAR(estimate.independent_samples, 400 / time, 1e-9);  // rounding
}

TEST(EstimateMean, ScalesWithTheValuesAndNotWithTheWeights) {
  const Series values = correlated(300, 0.7);
  Series scaled = values;
  for (double& x : scaled) x = 8 * x + 16;
  const MeanEstimate one = estimate_mean(values, ones(300));
  const MeanEstimate other = estimate_mean(scaled, Series(300, 0.25));
  EXPECT_NEAR(other.value, 8 * one.value + 16, 1e-13);  // rounding at 16
  EXPECT_NEAR(other.ci95, 8 * one.ci95, 1e-11);         // the same, through sums of squares
  EXPECT_NEAR(other.independent_samples, one.independent_samples, 1e-8);
  EXPECT_EQ(other.few_samples, one.few_samples);
}

TEST(EstimateMean, OfBlockMeansWeightedByTheirLengthsIsThatOfTheSamples) {
  const Series values = correlated(405, 0.5);  // 25 blocks of 16 and one of 5
  Series means, weights;
  for (std::size_t first = 0; first < values.size(); first += 16) {
    const std::size_t last = std::min<std::size_t>(first + 16, values.size());
    means.push_back(mean_of(Series(values.begin() + static_cast<std::ptrdiff_t>(first),
                                   values.begin() + static_cast<std::ptrdiff_t>(last))));
    weights.push_back(static_cast<double>(last - first));
  }
  EXPECT_NEAR(estimate_mean(means, weights).value, mean_of(values), 1e-15);  // rounding
}

TEST(EstimateMean, OfAConstantHasNoErrorAndNoWarning) {
  for (const double value : {0.0, 0.1, -3e7}) {
    const MeanEstimate mean = estimate_mean(Series(77, value), Series(77, 0.3));
    EXPECT_NEAR(mean.value, value, 77e-16 * std::abs(value));  // rounding of the sum
    EXPECT_EQ(mean.ci95, 0);
    EXPECT_EQ(mean.independent_samples, 77);
    EXPECT_FALSE(mean.few_samples || mean.disagree);
  }
}

TEST(EstimateMean, TakesAConstantThatIsOffByRoundingForOne) {
  Series values(50, 0.1);
  for (std::size_t i = 20; i < 50; ++i) values[i] = 0.1 + 1e-16;
  const MeanEstimate mean = estimate_mean(values, ones(50));
  EXPECT_EQ(mean.ci95, 0);
  EXPECT_FALSE(mean.few_samples || mean.disagree);
}

TEST(EstimateMean, OfOneSampleHasNoInterval) {
  const MeanEstimate mean = estimate_mean(Series{0.25}, ones(1));
  EXPECT_EQ(mean.value, 0.25);
  EXPECT_TRUE(std::isnan(mean.ci95));
  EXPECT_EQ(mean.independent_samples, 1);
  EXPECT_TRUE(mean.few_samples);
}

TEST(EstimateMean, OfNothingIsUndefined) {
  const MeanEstimate mean = estimate_mean({}, {});
  EXPECT_TRUE(std::isnan(mean.value));
  EXPECT_TRUE(std::isnan(mean.ci95));
  EXPECT_EQ(mean.independent_samples, 0);
}

TEST(EstimateMean, WarnsOfRareBursts) {
  Series values = correlated(400, 0);
  for (std::size_t i = 200; i < 208; ++i) values[i] += 20;
  EXPECT_TRUE(estimate_mean(values, ones(400)).few_samples);
}

TEST(EstimateMean, WarnsWhereASlowChangeHidesFromTheAutocorrelationTime) {
  // White noise and a slow wave: unseen in the first lags, plain in the batches.
  Series values = correlated(4000, 0);
  EXPECT_FALSE(estimate_mean(values, ones(4000)).disagree);
  for (std::size_t i = 0; i < 4000; ++i)
    values[i] += 0.09 * std::sin(2 * std::numbers::pi * static_cast<double>(i) / 2000);
  EXPECT_TRUE(estimate_mean(values, ones(4000)).disagree);
}

// Ratio

TEST(EstimateRatio, OverOnesIsTheMean) {
  // The jackknife of a mean over batches of equal length is the method of batch means.
  for (const double rho : {0.0, 0.9}) {
    const Series values = correlated(2000, rho);  // long enough for ten batches
    const Estimate ratio = estimate_ratio(values, ones(2000), ones(2000));
    const MeanEstimate mean = estimate_mean(values, ones(2000));
    EXPECT_NEAR(ratio.value, mean.value, 1e-14);  // rounding of sums of order 1
    EXPECT_NEAR(ratio.ci95, mean.ci95, 1e-12);
  }
}

TEST(EstimateRatio, OfProportionalSeriesHasNoError) {
  Series denominator = correlated(120, 0.8), numerator(120);
  for (std::size_t i = 0; i < 120; ++i) {
    denominator[i] += 5;
    numerator[i] = 3 * denominator[i];
  }
  const Estimate ratio = estimate_ratio(numerator, denominator, ones(120));
  EXPECT_NEAR(ratio.value, 3, 1e-14);  // rounding
  EXPECT_NEAR(ratio.ci95, 0, 1e-14);
}

TEST(EstimateRatio, DoesNotDependOnTheUnitOfWeights) {
  Series denominator = correlated(100, 0.3), numerator = correlated(100, 0.3, 9);
  for (double& x : denominator) x += 2;
  Series weights = ones(100);
  weights.back() = 0.25;
  Series scaled = weights;
  for (double& w : scaled) w *= 0.007;
  const Estimate one = estimate_ratio(numerator, denominator, weights);
  const Estimate other = estimate_ratio(numerator, denominator, scaled);
  EXPECT_NEAR(one.value, other.value, 1e-14);  // rounding
  EXPECT_NEAR(one.ci95, other.ci95, 1e-13);
}

TEST(EstimateRatio, TakesEachOfFewSamplesAsABatch) {
  // Left out in turn: 5/3, 4/3, 3/2; mean 3/2, squares 2/36; times (3 - 1) / 3.
  const Estimate ratio = estimate_ratio(Series{1, 2, 3}, Series{1, 1, 2}, ones(3));
  EXPECT_NEAR(ratio.value, 1.5, 1e-15);  // rounding
  EXPECT_NEAR(ratio.ci95, student_t(0.95, 2) * std::sqrt(2.0 / 36 * 2 / 3), 1e-14);
}

TEST(EstimateRatio, IsUndefinedWhereNothingWasSeen) {
  const Estimate ratio = estimate_ratio(Series(20, 0.0), Series(20, 0.0), ones(20));
  EXPECT_TRUE(std::isnan(ratio.value));
  EXPECT_TRUE(std::isnan(ratio.ci95));
  EXPECT_TRUE(std::isnan(estimate_ratio({}, {}, {}).value));
  EXPECT_TRUE(std::isnan(estimate_ratio(ones(20), Series(20, 0.0), ones(20)).value));
}

TEST(EstimateRatio, HasNoIntervalWhereOneBatchSawEverything) {
  Series denominator(40, 0.0), numerator(40, 0.0);
  denominator[7] = 0.1;
  numerator[7] = 0.3;
  const Estimate ratio = estimate_ratio(numerator, denominator, ones(40));
  EXPECT_DOUBLE_EQ(ratio.value, 3);
  EXPECT_TRUE(std::isnan(ratio.ci95));
}

TEST(EstimateRatio, OfOneSampleHasNoInterval) {
  const Estimate ratio = estimate_ratio(Series{6}, Series{2}, ones(1));
  EXPECT_EQ(ratio.value, 3);
  EXPECT_TRUE(std::isnan(ratio.ci95));
}

// Start of the steady part

TEST(SteadyStart, OfAConstantSeriesIsItsBeginning) {
  Series values(50, 0.1);
  values[30] = 0.1 + 1e-16;
  const SteadyStart found = steady_start(values);
  EXPECT_TRUE(found.constant);
  EXPECT_TRUE(found.steady);
  EXPECT_EQ(found.start, 0U);
}

TEST(SteadyStart, KeepsAllOfAnExactlyConstantRest) {
  Series step(400, 1.0), ramp(400, 1.0);
  for (std::size_t i = 0; i < 60; ++i) step[i] = 0;
  for (std::size_t i = 0; i < 150; ++i) ramp[i] = static_cast<double>(i) / 150;
  EXPECT_EQ(steady_start(step).start, 60U);
  EXPECT_EQ(steady_start(ramp).start, 150U);
  EXPECT_TRUE(steady_start(ramp).steady);
  EXPECT_FALSE(steady_start(ramp).constant);
}

TEST(SteadyStart, FlagsARampAndAStepInTheSecondHalf) {
  Series ramp(400), step(400), noisy = correlated(400, 0.5);
  for (std::size_t i = 0; i < 400; ++i) {
    ramp[i] = static_cast<double>(i);
    step[i] = i < 280 ? 0 : 1;
    noisy[i] += i < 280 ? 0 : 5;
  }
  for (const Series& series : {ramp, step, noisy}) {
    const SteadyStart found = steady_start(series);
    EXPECT_FALSE(found.steady);
    EXPECT_GE(found.start, 200U);
  }
  EXPECT_EQ(steady_start(step).start, 280U);
}

TEST(SteadyStart, DoesNotDependOnUnitAndOrigin) {
  for (const double drift : {0.0, 0.05}) {
    Series series = correlated(403, 0.9), other(403);
    for (std::size_t i = 0; i < 403; ++i) {
      series[i] += drift * static_cast<double>(i) + 5 * std::exp(-static_cast<double>(i) / 20);
      other[i] = 1024 * series[i] - 512;  // powers of two: hardly any rounding
    }
    EXPECT_EQ(steady_start(series).start, steady_start(other).start);
    EXPECT_EQ(steady_start(series).steady, steady_start(other).steady);
    EXPECT_EQ(steady_start(series).steady, drift == 0);
  }
}

TEST(EstimateMean, SaysHowManySamplesWouldBeEnough) {
  // One 1 among 99 zeros: skewness squared (1 - 2 p)^2 / (p (1 - p)) = 97, and 12 times that.
  std::vector<double> burst(100, 0.0);
  burst[50] = 1;
  const auto rare = estimate_mean(burst, std::vector<double>(100, 1.0));
  EXPECT_TRUE(rare.few_samples);
  EXPECT_GT(rare.enough_samples, 12 * 97.0);
  std::vector<double> regular(100);
  for (std::size_t i = 0; i < regular.size(); ++i) regular[i] = i % 2 == 0 ? 1 : -1;
  const auto plain = estimate_mean(regular, std::vector<double>(100, 1.0));
  EXPECT_FALSE(plain.few_samples);
  EXPECT_GT(plain.enough_samples, 10);
  EXPECT_LT(plain.enough_samples, 20);
}

TEST(SteadyStart, IsNotSaidOfTooFewOrUndefinedSamples) {
  EXPECT_FALSE(steady_start(correlated(19, 0)).steady);
  EXPECT_FALSE(steady_start({}).steady);
  Series series = correlated(100, 0);
  series[50] = nan;
  EXPECT_FALSE(steady_start(series).steady);
  EXPECT_EQ(steady_start(series).start, 0U);
}

}  // namespace
}  // namespace bedscope::analysis
