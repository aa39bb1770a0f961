// SPDX-License-Identifier: BSD-3-Clause
// How often the 95 % intervals hold the true value, and the start of the steady part the truth:
// 4,000 series of 400 samples of processes with known means. The program prints the tables of
// docs/statistics.md. Four thousand series give a share of 90 % to 0.5 % (one standard error).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "analysis/statistics.hpp"
#include "tests/analysis/random_series.hpp"

namespace bedscope::analysis {
namespace {

constexpr int repetitions = 4000;
constexpr std::size_t samples = 400;
using Series = std::vector<double>;

using tests::Random;

Series ar1(Random& random, double rho) { return tests::ar1(random, rho, samples); }

/// AR(2) x = a x' + b x'', after 500 steps of running in.
Series ar2(Random& random, double a, double b, std::size_t n = samples) {
  constexpr std::size_t running_in = 500;
  Series series(n + running_in);
  for (std::size_t i = 2; i < series.size(); ++i)
    series[i] = a * series[i - 1] + b * series[i - 2] + random.normal();
  return {series.begin() + running_in, series.end()};
}

/// Damped oscillation: correlation damping^k times a cosine of the given period.
Series oscillating(Random& random, double period, double damping, std::size_t n = samples) {
  const double angle = 2 * std::numbers::pi / period;
  return ar2(random, 2 * damping * std::cos(angle), -damping * damping, n);
}

Series two_scales(Random& random, std::size_t n = samples) {
  Series sum = ar1(random, 0.5, n);
  const Series slow = ar1(random, 0.98, n);
  for (std::size_t i = 0; i < n; ++i) sum[i] += slow[i];
  return sum;
}

/// Bursts of height 1: two states with the given chances a sample to go on and to go off.
Series bursts(Random& random, double on, double off, double noise, std::size_t n = samples) {
  Series series(n);
  bool state = random.uniform() < on / (on + off);
  for (double& x : series) {
    x = (state ? 1.0 : 0.0) + noise * random.normal();
    state = state ? random.uniform() >= off : random.uniform() < on;
  }
  return series;
}

struct Shares {
  double held = 0;             ///< the interval holds the true mean
  double missed_unwarned = 0;  ///< it does not, and nothing warns
  double few = 0, disagree = 0, warned = 0;
  double independent = 0;  ///< mean of independent_samples
  double width = 0;        ///< mean ci95 / (1.96 standard deviations of the mean)
};

Shares measure(const std::string& name, double truth,
               const std::function<Series(Random&)>& process) {
  Random random(20240611);
  Shares shares;
  double squares = 0;
  for (int i = 0; i < repetitions; ++i) {
    const Series series = process(random);
    const MeanEstimate mean = estimate_mean(series, Series(series.size(), 1.0));
    const bool held = std::abs(mean.value - truth) <= mean.ci95;
    const bool warned = mean.few_samples || mean.disagree;
    shares.held += held;
    shares.missed_unwarned += !held && !warned;
    shares.few += mean.few_samples;
    shares.disagree += mean.disagree;
    shares.warned += warned;
    shares.independent += mean.independent_samples;
    shares.width += mean.ci95;
    squares += (mean.value - truth) * (mean.value - truth);
  }
  for (double* share : {&shares.held, &shares.missed_unwarned, &shares.few, &shares.disagree,
                        &shares.warned, &shares.independent, &shares.width})
    *share /= repetitions;
  shares.width /= 1.96 * std::sqrt(squares / repetitions);
  std::printf("| %s | %.1f %% | %.1f %% | %.1f %% | %.1f %% | %.0f | %.2f |\n", name.c_str(),
              100 * shares.held, 100 * shares.missed_unwarned, 100 * shares.few,
              100 * shares.disagree, shares.independent, shares.width);
  return shares;
}

TEST(Coverage, OfWhiteNoiseIs95PercentAndHardlyEverWarned) {
  const Shares white = measure("white noise", 0, [](Random& r) { return ar1(r, 0); });
  EXPECT_GE(white.held, 0.93);
  EXPECT_LE(white.held, 0.97);
  EXPECT_LE(white.warned, 0.03);  // a few percent
}

TEST(Coverage, OfWhiteNoiseIs95PercentForShortSeriesToo) {
  for (const std::size_t n : {2U, 5U, 9U, 10U, 16U, 25U, 60U}) {
    const Shares white = measure("white noise, n = " + std::to_string(n), 0,
                                 [n](Random& r) { return ar1(r, 0, n); });
    EXPECT_GE(white.held, 0.93) << n;
    EXPECT_LE(white.held, 0.975) << n;  // the second opinion widens some of them
  }
}

TEST(Coverage, OfAr1IsAtLeast90Percent) {
  for (const double rho : {-0.5, 0.3, 0.5, 0.8, 0.9}) {
    const Shares shares = measure("AR(1), rho = " + std::to_string(rho).substr(0, 4), 0,
                                  [rho](Random& r) { return ar1(r, rho); });
    EXPECT_GE(shares.held, 0.90) << rho;
    EXPECT_LE(shares.width, 1.7) << rho;  // not bought with intervals of twice the width
  }
}

TEST(Coverage, OfVerySlowAr1IsAtLeast90PercentOrWarned) {
  for (const double rho : {0.95, 0.98, 0.99}) {
    const Shares shares = measure("AR(1), rho = " + std::to_string(rho).substr(0, 4), 0,
                                  [rho](Random& r) { return ar1(r, rho); });
    EXPECT_LT(shares.missed_unwarned, 0.10) << rho;
    EXPECT_GT(shares.few, 0.5) << rho;  // 10, 4 and 2 independent samples
  }
}

TEST(Coverage, OfAr2IsAtLeast90Percent) {
  EXPECT_GE(measure("AR(2), period 20, damping 0.95", 0,
                    [](Random& r) { return oscillating(r, 20, 0.95); })
                .held,
            0.90);
  EXPECT_GE(
      measure("AR(2), period 8, damping 0.9", 0, [](Random& r) { return oscillating(r, 8, 0.9); })
          .held,
      0.90);
  EXPECT_GE(
      measure("AR(2), slow: roots 0.9 and 0.8", 0, [](Random& r) { return ar2(r, 1.7, -0.72); })
          .held,
      0.90);
}

TEST(Coverage, OfTwoTimeScalesIsAtLeast90PercentOrWarned) {
  const Shares shares =
      measure("AR(1) 0.5 + AR(1) 0.98", 0, [](Random& r) { return two_scales(r); });
  EXPECT_LT(shares.missed_unwarned, 0.10);
}

TEST(Coverage, OfBurstsIsAtLeast90PercentOrWarned) {
  struct Bursts {
    double on, off, noise;
  };
  for (const Bursts& b :
       {Bursts{0.05, 0.2, 0}, {0.02, 0.2, 0}, {0.02, 0.5, 0}, {0.01, 0.1, 0}, {0.01, 0.1, 0.1}}) {
    char name[80];
    std::snprintf(name, sizeof name, "bursts of %g samples, %g apart, noise %g", 1 / b.off,
                  1 / b.on, b.noise);
    const Shares shares = measure(name, b.on / (b.on + b.off),
                                  [&](Random& r) { return bursts(r, b.on, b.off, b.noise); });
    EXPECT_LT(shares.missed_unwarned, 0.10) << name;
  }
}

TEST(Coverage, OfTheMeansOfSixteenSamplesIsThatOfTheSamples) {
  const auto leaves = [](const Series& series) {
    Series means(series.size() / 16);
    for (std::size_t i = 0; i < means.size() * 16; ++i) means[i / 16] += series[i] / 16;
    return means;
  };
  const Shares shares = measure("AR(1), rho = 0.90, 25 means of 16", 0,
                                [&](Random& r) { return leaves(ar1(r, 0.9)); });
  EXPECT_GE(shares.held, 0.90);
}

TEST(Coverage, OfARatioIsAtLeast90Percent) {
  // Density exp(z / 2), velocity 2 + z / 2 + noise, z AR(1): <density velocity> / <density> is
  // 2 + 1/4, as the weight exp(a z) moves the mean of a standard normal z to a.
  for (const double rho : {0.0, 0.5, 0.9}) {
    Random random(7);
    int held = 0;
    for (int i = 0; i < repetitions; ++i) {
      const Series z = ar1(random, rho), noise = ar1(random, rho);
      Series flux(samples), density(samples);
      for (std::size_t k = 0; k < samples; ++k) {
        density[k] = std::exp(z[k] / 2);
        flux[k] = density[k] * (2 + z[k] / 2 + noise[k]);
      }
      const Estimate ratio = estimate_ratio(flux, density, Series(samples, 1.0));
      held += std::abs(ratio.value - 2.25) <= ratio.ci95;
    }
    const double share = static_cast<double>(held) / repetitions;
    std::printf("| ratio, AR(1), rho = %g | %.1f %% |\n", rho, 100 * share);
    EXPECT_GE(share, rho == 0 ? 0.93 : 0.90) << rho;
    EXPECT_LE(share, rho == 0 ? 0.97 : 1.00) << rho;
  }
}

// Shares of series called steady, and of start-up transients cut deep enough.

Series with(Series series, const std::function<double(double)>& added) {
  for (std::size_t i = 0; i < series.size(); ++i) series[i] += added(static_cast<double>(i));
  return series;
}

double start_up(double time) { return 10 * std::exp(-time / 30); }

TEST(SteadyStart, FindsStationarySeriesSteady) {
  for (const double rho : {0.0, 0.5, 0.9, 0.95}) {
    Random random(11);
    int steady = 0;
    double cut = 0;
    for (int i = 0; i < repetitions; ++i) {
      const SteadyStart found = steady_start(ar1(random, rho));
      steady += found.steady;
      cut += static_cast<double>(found.start) / samples;
    }
    std::printf("| stationary, rho = %g | steady %.1f %% | cut %.0f %% |\n", rho,
                100.0 * steady / repetitions, 100 * cut / repetitions);
    EXPECT_GE(steady, 0.95 * repetitions) << rho;
    EXPECT_LE(cut, 0.20 * repetitions) << rho;  // of good samples thrown away, in the mean
  }
}

TEST(SteadyStart, LeavesLessOfATransientThanTheStatisticalError) {
  for (const double rho : {0.0, 0.5, 0.9, 0.95}) {
    Random random(13);
    int below = 0, steady = 0;
    for (int i = 0; i < repetitions; ++i) {
      const SteadyStart found = steady_start(with(ar1(random, rho), start_up));
      double bias = 0;
      for (std::size_t k = found.start; k < samples; ++k) bias += start_up(static_cast<double>(k));
      const auto kept = static_cast<double>(samples - found.start);
      const double standard_error = std::sqrt((1 + rho) / (1 - rho) / kept);
      below += bias / kept < standard_error;
      steady += found.steady;
    }
    std::printf("| transient, rho = %g | bias below error %.1f %% | steady %.1f %% |\n", rho,
                100.0 * below / repetitions, 100.0 * steady / repetitions);
    EXPECT_GE(below, 0.90 * repetitions) << rho;
    EXPECT_GE(steady, 0.95 * repetitions) << rho;
  }
}

TEST(SteadyStart, FlagsADrift) {
  for (const double rho : {0.0, 0.5, 0.9, 0.95}) {
    std::printf("| drift, rho = %g |", rho);
    for (const double drift : {2.0, 5.0, 10.0, 20.0}) {  // standard deviations over the series
      Random random(17);
      int flagged = 0;
      for (int i = 0; i < repetitions; ++i)
        flagged += !steady_start(with(ar1(random, rho), [=](double t) {
                      return drift * t / samples;
                    })).steady;
      std::printf(" %g: %.1f %% |", drift, 100.0 * flagged / repetitions);
      const double least = drift < 10 ? 0 : drift < 20 ? 0.85 : 0.99;
      EXPECT_GE(flagged, least * repetitions) << rho;
    }
    std::printf("\n");
  }
}

TEST(SteadyStart, AWindowThatItChoseHoldsTheMeanOrIsWarnedOf) {
  constexpr std::size_t block = 16;  // snapshots, to which `auto` rounds up its start
  for (const double rho : {0.0, 0.5, 0.8, 0.9, 0.95, 0.98, 0.99}) {
    Random random(31);
    int held = 0, warned = 0, silent = 0;
    for (int i = 0; i < repetitions; ++i) {
      const Series series = ar1(random, rho);
      const auto found = steady_start(series);
      const auto first = static_cast<std::ptrdiff_t>((found.start + block - 1) / block * block);
      const Series kept(series.begin() + first, series.end());
      const auto mean = estimate_mean(kept, Series(kept.size(), 1));
      const bool holds = std::abs(mean.value) <= mean.ci95;
      const bool doubtful = !found.steady || mean.few_samples || mean.disagree ||
                            drift_of(kept).significance > significant_drift;
      held += holds;
      warned += doubtful;
      silent += !holds && !doubtful;
    }
    std::printf("| auto, rho = %.2f | held %.1f %% | warned %.1f %% | missed, unwarned %.1f %% |\n",
                rho, 100.0 * held / repetitions, 100.0 * warned / repetitions,
                100.0 * silent / repetitions);
    // What 95 % intervals may miss, and three standard errors of 4,000 series.
    EXPECT_LE(silent, 0.06 * repetitions) << rho;
  }
}

TEST(Drift, OfStationarySeriesIsSeldomSignificant) {
  for (const double rho : {0.0, 0.5, 0.8, 0.9}) {
    std::printf("| drift of a stationary series, rho = %g |", rho);
    for (const std::size_t n : {20, 40, 100, 400}) {
      Random random(29);
      int flagged = 0;
      for (int i = 0; i < repetitions; ++i)
        flagged += drift_of(tests::ar1(random, rho, n)).significance > significant_drift;
      std::printf(" n = %zu: %.1f %% |", n, 100.0 * flagged / repetitions);
      // White noise by Student's t with n - 2 degrees of freedom: 2.2 % at 20, 1.3 % at 400; the
      // rest is three standard errors of 4,000 series.
      if (rho == 0) {
        EXPECT_LE(flagged, (0.022 + 3 * 0.0023) * repetitions) << n;
      }
    }
    std::printf("\n");
  }
}

TEST(SteadyStart, FlagsAJumpOfTheMeanInTheSecondHalf) {
  for (const double rho : {0.0, 0.5, 0.9}) {
    Random random(23);
    int flagged = 0;
    for (int i = 0; i < repetitions; ++i) {
      const auto jump = [](double t) { return t < 0.7 * samples ? 0.0 : 5.0; };
      flagged += !steady_start(with(ar1(random, rho), jump)).steady;
    }
    std::printf("| jump of 5, rho = %g | flagged %.1f %% |\n", rho, 100.0 * flagged / repetitions);
    EXPECT_GE(flagged, 0.90 * repetitions) << rho;
  }
}

TEST(SteadyStart, FindsShortStationarySeriesSteady) {
  struct Case {
    std::size_t n;
    double rho, least;
  };
  // At rho = 0.8 forty samples are four independent ones: the 95 % of 400 are out of reach.
  for (const auto& [n, rho, least] :
       {Case{20, 0, 0.95}, {40, 0, 0.95}, {40, 0.8, 0.90}, {100, 0, 0.95}, {100, 0.8, 0.95}}) {
    Random random(19);
    int steady = 0;
    for (int i = 0; i < repetitions; ++i) steady += steady_start(ar1(random, rho, n)).steady;
    std::printf("| stationary, n = %zu, rho = %g | steady %.1f %% |\n", n, rho,
                100.0 * steady / repetitions);
    EXPECT_GE(steady, least * repetitions) << n << " " << rho;
  }
}

}  // namespace
}  // namespace bedscope::analysis
