// SPDX-License-Identifier: BSD-3-Clause
// Means of correlated time series and their errors; the start of the steady part.
// docs/statistics.md tells users what is done and how often the intervals hold.
#pragma once

#include <cstddef>
#include <span>

#include "analysis/result.hpp"

namespace bedscope::analysis {

/// A mean with its error and with what is to be said about that error.
struct MeanEstimate : Estimate {
  /// The mean and its interval alone.
  const Estimate& estimate() const { return *this; }
  double independent_samples = 0;  ///< n / integrated autocorrelation time, at most n
  double enough_samples = 0;       ///< independent ones from which the interval is trusted
  bool few_samples = false;        ///< they are too few for it
  bool disagree = false;  ///< batch means and autocorrelation time give errors a factor 2.5 apart
};

/// Weighted time average of a correlated series and its 95 % interval.
///
///   m = sum w x / sum w,   ci95 = t(0.95, B - 1) max(se_batches, se_tau)
///
/// se_batches: batch means, B batches of consecutive samples, B = n / (5 tau) kept within 4 and 10;
/// se_tau = sqrt(tau / n) sigma, the second opinion, widens the interval only where tau > 2 (else
/// that of white noise would hold 98.0 % of the time). tau: see autocorrelation_time.
/// few_samples: n < 10, or n / tau, taken one standard error of tau lower, below 10 or below 12 g^2
/// with the skewness g (a series of rare bursts; Cochran's rule asks for 25 g^2).
///
/// `values`: snapshots or means over consecutive ones, all finite; `weights`: the time each stands
/// for, positive, as many. No samples: NaN. One: ci95 NaN. 2 to 9: a batch each, tau taken as 1.
/// Constant to 1e-12 of its magnitude: ci95 0, n independent samples, no warning.
/// Sources: batch means with Student's t, Schmeiser, Oper. Res. 30 (1982) 556; the skewness rule,
/// Cochran, Sampling Techniques (1977) section 2.15.
MeanEstimate estimate_mean(std::span<const double> values, std::span<const double> weights);

/// Ratio of two weighted means R = sum w num / sum w den and its 95 % interval by the jackknife:
/// each batch is left out in turn of numerator and denominator together.
///
/// Batches and widening as in estimate_mean, on the linearised series num - R den. R is NaN where
/// the denominator is 0; ci95 is NaN where it is 0 without one of the batches, or n < 2.
/// Source: Miller, Biometrika 61 (1974) 1.
Estimate estimate_ratio(std::span<const double> numerator, std::span<const double> denominator,
                        std::span<const double> weights);

struct SteadyStart {
  std::size_t start = 0;  ///< index of the first sample to keep
  bool steady = true;     ///< false: no steady part found
  bool constant = false;  ///< to 1e-12 of its magnitude: says nothing about the start
};

/// Start of the steady part of a series, by the marginal standard error rule on means of five
/// samples (MSER-5; fewer below 100 samples): the d that minimises
///
///   sum_{i >= d} (y_i - mean_d)^2 / (k - d)^2,   k means y_i, at least 5 kept.
///
/// In the first half the latest d within 10 % of the minimum there is taken: the minimum is flat
/// and noisy, and this costs little and leaves far less of a transient. `steady` is false
/// where the minimum lies in the second half *and* what the first half's best start leaves changes
/// for certain: a line through it rises by 3 of its standard errors or, where that fits better, the
/// mean jumps once by 5, correlation included; `start` is then that minimum. (On its own
/// the minimum of a stationary AR(1) series, rho = 0.95, n = 400, lies in the second half every
/// second time.) A rest that is exactly constant is kept whole. Fewer than 20 samples, or a value
/// that is not finite: start 0, not steady.
/// Sources: White, Simulation 69 (1997) 323; White, Cobb and Spratt, Proc. Winter Simulation Conf.
/// (2000) 755.
SteadyStart steady_start(std::span<const double> series);

/// A straight line through a series by least squares.
struct Drift {
  double change = 0;        ///< from its first to its last sample
  double significance = 0;  ///< |change| over its standard error, correlation included
};

/// Of a constant series, one with a value that is not finite, or fewer than 20 samples: 0, 0.
/// The correlation is that of what the line leaves, never below white noise's. Of white noise 1 %
/// (400 samples) to 2 % (20, by Student's t) lie beyond significant_drift; docs/statistics.md has
/// the shares of correlated series.
Drift drift_of(std::span<const double> series);
inline constexpr double significant_drift = 2.5;

/// Integrated autocorrelation time in samples.
struct AutocorrelationTime {
  double value = 1;           ///< 1 + 2 sum rho(k); 1 for white noise
  double relative_error = 0;  ///< one standard error / value
};

/// Integrated autocorrelation time of a series of zero mean:
///
///   tau(M) = (1 + (2 M + 1) / n) (1 + 2 sum_{k=1}^{M} rho(k)),
///
/// with the smallest window M >= 4 max(tau, 1), at most n / 4; the first factor makes up for the
/// mean having been estimated from the same series. At least 1/n; 1 for zeros.
/// Sources: window and error sqrt(2 (2 M + 1) / n), Madras and Sokal, J. Stat. Phys. 50 (1988) 109
/// (their time is half of ours, so their c is 8); first factor, Wolff, Comput. Phys. Commun. 156
/// (2004) 143. Cost: O(n M).
AutocorrelationTime autocorrelation_time(std::span<const double> deviations);

/// The t with P(|T| <= t) = confidence for Student's T, to rounding; confidence in (0, 1), degrees
/// of freedom >= 1. Source: Abramowitz and Stegun (1964) 26.7.3 and 26.7.4, solved by bisection.
/// Cost: O(degrees of freedom).
double student_t(double confidence, int degrees_of_freedom);

}  // namespace bedscope::analysis
