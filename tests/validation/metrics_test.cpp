// SPDX-License-Identifier: BSD-3-Clause
// Metrics against closed forms, and their intervals against how often they hold.
#include "validation/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "readers/error.hpp"

namespace bedscope::validation {
namespace {

Comparison comparison(const std::vector<double>& result, const std::vector<double>& reference,
                      double u_result = 0, double u_reference = 0) {
  Comparison c{.x = {"z", "m"}, .y = {"holdup", "-"}};
  for (std::size_t i = 0; i < result.size(); ++i)
    c.points.push_back({.x = static_cast<double>(i),
                        .result = result[i],
                        .reference = reference[i],
                        .u_result = u_result,
                        .u_reference = u_reference});
  return c;
}

double value(const char* metric, const Comparison& c) {
  return evaluate(find_metric(metric), c).value;
}

TEST(Metrics, AreTheirFormulas) {
  const auto c = comparison({1, 2, 6}, {2, 2, 4});
  EXPECT_DOUBLE_EQ(value("relative rmse", c), std::sqrt(5. / 3) / (8. / 3));
  EXPECT_DOUBLE_EQ(value("relative bias", c), (1. / 3) / (8. / 3));
  EXPECT_DOUBLE_EQ(value("max error", c), 2);
  EXPECT_DOUBLE_EQ(value("relative max error", c), 2 / (8. / 3));
}

TEST(Metrics, TheNoiseOfTheAverageIsTakenOffTheRmse) {
  const auto c = comparison({1, 3, 1, 3}, {2, 2, 2, 2}, .6);
  EXPECT_NEAR(value("relative rmse", c), std::sqrt(1 - .36) / 2, 1e-15);
  EXPECT_EQ(value("relative rmse", comparison({1, 3}, {2, 2}, 1.5)), 0);
}

TEST(Metrics, ErrorOverUncertaintyIsThatOfVAndV20) {
  EXPECT_NEAR(value("e over u", comparison({3, 3}, {2, 2}, .3, .4)), 2, 1e-12);
  EXPECT_THROW(value("e over u", comparison({3}, {2})), InputError);
}

TEST(Metrics, RankCorrelationKnowsTies) {
  EXPECT_DOUBLE_EQ(value("rank correlation", comparison({1, 2, 3, 4}, {10, 20, 30, 31})), 1);
  EXPECT_DOUBLE_EQ(value("rank correlation", comparison({4, 3, 2, 1}, {10, 20, 30, 31})), -1);
  // By hand: ranks 1 2.5 2.5 4 and 1 2 3 4 give 9 / sqrt(9 * 10) ... = 4.5 / sqrt(4.5 * 5).
  EXPECT_NEAR(value("rank correlation", comparison({1, 2, 2, 4}, {1, 2, 3, 4})),
              4.5 / std::sqrt(4.5 * 5), 1e-12);
  EXPECT_THROW(value("rank correlation", comparison({1, 2, 3, 4}, {1, 1, 1, 1})), InputError);
}

TEST(Metrics, NamesAndZeroMeansAreToldApart) {
  EXPECT_THROW(find_metric("relative rms"), InputError);
  EXPECT_THROW(value("relative rmse", comparison({1, 2}, {-1, 1})), InputError);
}

TEST(Metrics, ModelBiasAndScatterAreThoseOfTheFactor) {
  // R / E = 1.5 and 1.2 in turn: ln of mean (ln 1.8) / 2, variance (ln 1.25)^2 / 4 * 4 / 3.
  const auto c = comparison({3, 2.4, 6, 4.8}, {2, 2, 4, 4});
  const double mean = std::log(1.8) / 2, variance = std::pow(std::log(1.25), 2) / 3;
  EXPECT_NEAR(value("model scatter", c), std::sqrt(variance), 1e-12);
  EXPECT_NEAR(value("model bias", c), std::exp(mean + variance / 2) - 1, 1e-12);
  // What both uncertainties explain is taken out: 5 % and 4 % at each point.
  auto vague = c;
  for (auto& point : vague.points) {
    point.u_reference = .05 * point.reference;
    point.u_result = .04 * point.result;
  }
  EXPECT_NEAR(value("model scatter", vague), std::sqrt(variance - .0041), 1e-12);
  EXPECT_NEAR(value("model bias", vague), std::exp(mean + (variance - .0041 - .0025) / 2) - 1,
              1e-12);
  EXPECT_THROW(value("model scatter", comparison({1, -1, 1}, {1, 1, 1})), InputError);
}

TEST(Metrics, OfTheFactorLeaveOutWhatIsNotToldFromZero) {
  // A result that is right but for a factor of 1.1; where the reference is 1e-5 its relative
  // uncertainty of 2,000 would make a bias of e^-100,000.
  const auto c = comparison({1.1, 2.2, 1.1e-5, 1.1, 2.2}, {1, 2, 1e-5, 1, 2}, 0, .02);
  const auto bias = evaluate(find_metric("model bias"), c);
  EXPECT_NEAR(bias.value, .1, 2e-3);
  EXPECT_LT(bias.hi, .16);
  EXPECT_EQ(bias.points, 4U);
}

TEST(Intervals, OfALargestErrorAddTheErrorOfTheMeanThatScalesIt) {
  // Errors common to all points of the reference: E / m = R / m - 1 errs by u R / m^2.
  const auto found = evaluate(find_metric("relative max error"), comparison({3, 3}, {2, 2}, 0, .1));
  EXPECT_NEAR(found.hi, .5 + 1.959964 * .1 * 3 / 4, 1e-6);
}

TEST(Intervals, OfUnequalArmsReachFurtherOnTheLongerOne) {
  auto c = comparison({3, 3, 3, 3}, {2, 2, 2, 2});
  for (auto& point : c.points) point.u_reference = .3, point.u_reference_away = .05;
  for (const char* metric : {"relative bias", "max error"}) {
    const auto found = evaluate(find_metric(metric), c);
    EXPECT_GT(found.value - found.lo, .2) << metric;
  }
  const auto largest = evaluate(find_metric("max error"), c);
  EXPECT_NEAR(largest.hi, 1 + 1.959964 * .05, 1e-6);
  EXPECT_NEAR(largest.lo, 1 - 2.4977 * .3, 1e-4);
}

TEST(Intervals, OfADifferenceAllowForErrorsThatNeighboursShare) {
  // Of the lowest fifth and the middle two fifths of 41 points, errors of u = 0.1 with a memory of
  // a fifth of the curve: w' C w by the sum over all pairs.
  Sampled curve{.x = {"x", "m"}, .y = {"holdup", "-"}};
  std::vector<double> weight;
  for (int i = 0; i <= 40; ++i) {
    curve.at.push_back(i / 40.);
    curve.value.push_back(1);
    curve.u.push_back(.1);
    weight.push_back(i <= 8 ? 1 / 9. : i >= 12 && i <= 28 ? -1 / 17. : 0);
  }
  double variance = 0;
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; j <= 40; ++j)
      variance += weight[i] * weight[j] * .01 * std::exp(-std::abs(i - j) / 40. / .2);
  const auto found = with_interval(curve, [&](std::span<const double>, std::span<const double> y) {
    double sum = 0;
    for (std::size_t i = 0; i < y.size(); ++i) sum += weight[i] * y[i];
    return sum;
  });
  // 2,000 draws tell an end of the interval to 4 %; the wider of two is taken.
  EXPECT_NEAR((found.hi - found.lo) / 2, 1.96 * std::sqrt(variance),
              .1 * std::sqrt(variance) * 1.96);
}

TEST(Intervals, KeepOfInterpolationWhatNoLongerSimulationNarrows) {
  auto c = comparison({3, 3, 3, 3}, {2, 2, 2, 2});
  for (auto& point : c.points) point.u_interpolation = .1;
  for (const char* metric : {"relative rmse", "relative bias", "max error", "model bias"}) {
    const auto found = evaluate(find_metric(metric), c);
    EXPECT_GT(found.hi, found.value) << metric;
    EXPECT_DOUBLE_EQ(found.fixed_half_width,
                     std::max(found.hi - found.value, found.value - found.lo))
        << metric;
  }
}

TEST(Intervals, WithoutUncertaintyTheyAreTheValue) {
  const auto found = evaluate(find_metric("relative rmse"), comparison({1, 2, 6}, {2, 2, 4}));
  EXPECT_DOUBLE_EQ(found.lo, found.value);
  EXPECT_DOUBLE_EQ(found.hi, found.value);
  EXPECT_DOUBLE_EQ(found.fixed_half_width, 0);
}

TEST(Intervals, OfABiasAreThoseOfACommonError) {
  // A common error of 0.1 in a mean of 2: half-width 1.96 * 0.05.
  const auto found =
      evaluate(find_metric("relative bias"), comparison({3, 3, 3, 3}, {2, 2, 2, 2}, .1));
  EXPECT_NEAR(found.hi - found.value, 1.96 * .05, .006);
  EXPECT_NEAR(found.value - found.lo, 1.96 * .05, .006);
  EXPECT_DOUBLE_EQ(found.fixed_half_width, 0);
}

TEST(Intervals, OfOnePlaceMeasuredTwiceAreNumbers) {
  auto c = comparison({3, 3}, {2, 2.5}, .1, .1);
  c.points[1].x = c.points[0].x;
  const auto found = evaluate(find_metric("relative bias"), c);
  EXPECT_LT(found.lo, found.value);
  EXPECT_GT(found.hi, found.value);
}

TEST(Intervals, WidenWithTheUncertainties) {
  double last = 0;
  for (const double u : {.01, .1, 1., 10.}) {
    const auto found =
        evaluate(find_metric("relative rmse"), comparison({3, 2, 3, 4}, {2, 2, 3, 3}, u, u));
    EXPECT_GT(found.hi, last);
    last = found.hi;
  }
}

TEST(Intervals, HoldTheTrueRmseInNineteenOfTwentyOrMore) {
  // A model that is off by 20 % everywhere, seen through noise in result and reference.
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  int held = 0;
  constexpr int trials = 200, n = 30;
  for (int k = 0; k < trials; ++k) {
    std::vector<double> result, reference;
    for (int i = 0; i < n; ++i) {
      const double truth = 1 + i / 30.;
      result.push_back(1.2 * truth + .1 * normal(random));
      reference.push_back(truth + .1 * normal(random));
    }
    double squares = 0, mean = 0;
    for (int i = 0; i < n; ++i) {
      squares += std::pow(.2 * (1 + i / 30.), 2) / n;
      mean += (1 + i / 30.) / n;
    }
    const auto found =
        evaluate(find_metric("relative rmse"), comparison(result, reference, .1, .1));
    held += found.lo <= std::sqrt(squares) / mean && std::sqrt(squares) / mean <= found.hi;
  }
  EXPECT_GE(held, trials * 93 / 100);
}

TEST(Intervals, OfTheLargestErrorAllowForTheChoiceAmongPoints) {
  // 4 points, E = 1, u = 0.1: up 1.96 u, down 2.4977 u (2.5 % / 4 of a normal tail).
  const auto found = evaluate(find_metric("max error"), comparison({3, 3, 3, 3}, {2, 2, 2, 2}, .1));
  EXPECT_NEAR(found.hi, 1 + .195996, 1e-5);
  EXPECT_NEAR(found.lo, 1 - .249771, 1e-5);
  EXPECT_EQ(found.fixed_half_width, 0);
}

TEST(Intervals, OfErrorOverUncertaintyAreItsValue) {
  const auto found = evaluate(find_metric("e over u"), comparison({3, 3}, {2, 2}, .3, .4));
  EXPECT_DOUBLE_EQ(found.lo, found.value);
  EXPECT_DOUBLE_EQ(found.hi, found.value);
}

/// 20,000 points, E = 1 plus a wave of 20 points, which each 20th of them keeps time with.
Comparison wave(double u_reference) {
  std::vector<double> result;
  for (int i = 0; i < 20000; ++i) result.push_back(3 + .5 * std::sin(M_PI * i / 10));
  return comparison(result, std::vector<double>(result.size(), 2), 0, u_reference);
}

TEST(Intervals, OfManyPointsAreDrawnAtSomeAndTheValueIsOfAll) {
  const double rmse = std::sqrt(1 + .125) / 2;
  const auto exact = evaluate(find_metric("relative rmse"), wave(0));
  EXPECT_NEAR(exact.value, rmse, 1e-12);
  EXPECT_LE(exact.lo, exact.value);
  EXPECT_GE(exact.hi, exact.value);
  // E^2 has a deviation of 1.008 about 1.125; of 1,000 points a mean square errs by 2.8 %, three of
  // which are 4.3 % of the root.
  EXPECT_NEAR(exact.hi, exact.lo, .043 * rmse);
  EXPECT_EQ(exact.points, 20000);
  EXPECT_EQ(exact.points_drawn, 1000);
  // A common error of 0.1: the rmse moves by u / m to first order, as <E> / rms E = 0.94 of it, and
  // with the mean that it is in units of.
  const auto common = evaluate(find_metric("relative rmse"), wave(.1));
  const auto of_e = [](double e) { return std::sqrt(std::pow(1 - e, 2) + .125) / (2 + e); };
  EXPECT_NEAR(common.hi, of_e(-.196), .05 * (of_e(-.196) - rmse));
  EXPECT_NEAR(common.lo, of_e(.196), .1 * (rmse - of_e(.196)));
}

TEST(Intervals, OfAThousandPointsAreDrawnAtAll) {
  const auto found =
      evaluate(find_metric("relative bias"),
               comparison(std::vector<double>(1000, 3), std::vector<double>(1000, 2), .1));
  EXPECT_EQ(found.points_drawn, found.points);
}

TEST(Intervals, AreTheSameEachTime) {
  const auto c = comparison({1, 2, 6}, {2, 2, 4}, .2, .3);
  const auto a = evaluate(find_metric("max error"), c), b = evaluate(find_metric("max error"), c);
  EXPECT_EQ(a.lo, b.lo);
  EXPECT_EQ(a.hi, b.hi);
}

TEST(Area, OfAShiftedDensityIsTheShift) {
  std::vector<double> x, y, density;
  for (int i = 0; i < 200; ++i) {
    x.push_back(i * .05);
    y.push_back(i * .05 + .73);
    density.push_back(std::exp(-std::pow(i * .05 - 5, 2)));
  }
  EXPECT_NEAR(wasserstein(x, density, y, density), .73, 1e-12);
  EXPECT_NEAR(wasserstein(x, density, x, density), 0, 1e-15);
}

/// A normal density of deviation 1 about `centre`, and u = `shift` times its slope: what a shift of
/// that size does to it.
Sampled peak(double centre, double shift) {
  Sampled density{.x = {"T", "-"}, .y = {"density", "-"}, .is_distribution = true};
  for (int i = 0; i < 101; ++i) {
    const double x = i * .1, y = std::exp(-std::pow(x - centre, 2) / 2) / std::sqrt(2 * M_PI);
    density.at.push_back(x);
    density.value.push_back(y);
    density.u.push_back(shift * std::abs(x - centre) * y);
  }
  return density;
}

Curve curve_of(const Sampled& density, double u_x = 0) {
  Curve curve{.x = density.x, .y = density.y};
  for (std::size_t i = 0; i < density.at.size(); ++i)
    curve.points.push_back({density.at[i], density.value[i], u_x, 0});
  return curve;
}

TEST(Area, OfADistributionThatMovesHasTheErrorOfItsPlace) {
  // Both ends of 2,000 draws to 5 %; and a shift is one only to first order.
  const auto of_result = evaluate_area(peak(5.5, .1), curve_of(peak(5, 0)));
  EXPECT_NEAR(of_result.value, .5, 1e-3);
  EXPECT_NEAR(of_result.hi - of_result.value, 1.96 * .1, .1 * 1.96 * .1);
  EXPECT_NEAR(of_result.value - of_result.lo, 1.96 * .1, .1 * 1.96 * .1);
  EXPECT_EQ(of_result.fixed_half_width, 0);
}

TEST(Area, UnderErrorsThatLeaveNoDensityIsStillAnInterval) {
  // All on one half of the range at least, 2.5 from its middle on the mean.
  auto vague = peak(5.5, 0);
  for (double& u : vague.u) u = 100;
  const auto found = evaluate_area(vague, curve_of(peak(5, 0)));
  EXPECT_GT(found.hi, 2.5);
  EXPECT_EQ(found.lo, 0);
}

TEST(Area, OfAReferenceWithAnUncertainAbscissaHasItsError) {
  const auto found = evaluate_area(peak(5.5, 0), curve_of(peak(5, 0), .1));
  EXPECT_NEAR(found.hi - found.value, 1.96 * .1, .1 * 1.96 * .1);
  EXPECT_NEAR(found.fixed_half_width, 1.96 * .1, .1 * 1.96 * .1);
}

TEST(Area, OfTwoUniformDensitiesIsByHand) {
  // Uniform on [0, 1] against uniform on [0, 2]: integral of |F - G| = 1/2.
  std::vector<double> a, b, one;
  for (int i = 0; i < 10; ++i) {
    a.push_back(.05 + i * .1);
    b.push_back(.1 + i * .2);
    one.push_back(1);
  }
  EXPECT_NEAR(wasserstein(a, one, b, one), .5, 1e-12);
  const std::vector<double> falling{2, 1};
  EXPECT_THROW(wasserstein(falling, falling, b, one), InputError);
}

}  // namespace
}  // namespace bedscope::validation
