// SPDX-License-Identifier: BSD-3-Clause
// Power spectral density of an evenly sampled series, and what is read off it.
#pragma once

#include <cstddef>
#include <span>

#include "analysis/bed_result.hpp"

namespace bedscope::analysis {

/// One-sided power spectral density by the mean over segments that overlap by half, a straight line
/// taken off each, a Hann window on each:
///
///   P(f_k) = 2 dt / (K sum w^2) sum_segments |sum_n w_n x_n exp(-2 pi i k n / L)|^2,
///
/// f_k = k / (L dt), without the 2 at k = 0 and L/2. So sum P / (L dt) is the mean over segments of
/// sum (w x)^2 / sum w^2 exactly (Parseval), which is the variance inside a segment on average.
/// The 95 % interval is that of chi-squared with
///
///   2 K / (1 + 2 (K - 1)/K rho),   rho = (sum w_n w_{n + L/2} / sum w^2)^2
///
/// degrees of freedom, half as many at k = 0 and L/2: for a signal that is Gaussian and smooth over
/// the resolution. Sources: Welch, IEEE Trans. Audio Electroacoust. 15 (1967) 70; Hann window in
/// its periodic form, Harris, Proc. IEEE 66 (1978) 51.
///
/// `values` [unit], all finite, every `step` [s]; `length` [samples], even, 4 to values.size().
/// Samples behind the last whole segment are not used.
Spectrum welch(std::span<const double> values, double step, std::size_t length);

/// The length of a segment that we choose: at most 8 segments (each has 1 / 4.5 of the record), but
/// so few that each holds 5 periods of the record's dominant frequency, because a peak nearer to 0
/// is not told from the mean and the trend. The record is one segment where it has fewer than 5.
/// Then down to an even number of factors 2, 3 and 5. values.size() >= least_record.
std::size_t segment_length(std::span<const double> values);
constexpr std::size_t least_record = 16;

/// The frequency of the largest density above 0 [Hz], between its neighbours by the parabola
/// through the logarithms of three; ci95: half the width of the stretch around it on which the
/// density lies in the largest one's interval, at least the resolution.
/// NaN where the density is 0 throughout.
Estimate dominant_frequency(const Spectrum& spectrum);

/// The x with P(chi-squared <= x) = probability, to 1e-10 of x; probability from 1e-6 to
/// 1 - 1e-6, degrees of freedom (need not be whole) from 0.5 up. Source: the incomplete gamma
/// function by its series, DLMF 8.11.4, solved by bisection.
double chi_squared(double probability, double degrees_of_freedom);

}  // namespace bedscope::analysis
