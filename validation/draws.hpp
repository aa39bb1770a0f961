// SPDX-License-Identifier: BSD-3-Clause
// Draws of errors, and the intervals that they give; for validation/ alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace bedscope::validation {

constexpr int draws = 2000;

/// An interval is drawn at so many points at most: a mean square over them is off by the share
/// 1/sqrt(2 * 1000) = 2.2 % of its own size where errors are normal, less than the ends of 2,000
/// draws, which are off by 3 % of the half-width.
constexpr std::size_t most_drawn = 1000;

/// The points that take part in draws, of n: all of them, or one at random of each of `most_drawn`
/// equal stretches, for every k-th may keep time with a wave of the curve. Always the same.
std::vector<std::size_t> drawn_points(std::size_t n);

/// How the errors of neighbouring points may go together: not at all; over a part of the curve, as
/// where neighbours see the same clusters or a shift moves both flanks of a peak; all alike. In a
/// difference between walls and core the first and the last cancel, and the second does not.
enum class Errors { independent, neighbours, common };
inline constexpr std::array all_errors{Errors::independent, Errors::neighbours, Errors::common};

/// How much of its left neighbour's error each point has, for abscissae that ascend.
std::vector<double> memory_of(std::span<const double> x, Errors errors);

/// Always the same draws: a report must not change from run to run.
class Draw {
 public:
  double normal() { return distribution_(engine_); }
  /// Standard normal, with this much of the one before.
  double after(double before, double memory);

 private:
  std::mt19937_64 engine_{20260101};  // any
  std::normal_distribution<double> distribution_;
};

/// Standard normal errors of the points of one curve.
std::vector<double> draw_errors(std::span<const double> memory, Draw& draw);

/// Errors in units of u, added to the values of one curve.
std::vector<double> perturbed(std::span<const double> values, std::span<const double> u,
                              std::span<const double> errors);

struct Interval {
  double lo = 0, hi = 0;
};

/// Ends between which the middle 95 % of the draws lie. Sorts them.
Interval percentiles(std::vector<double>& values);

/// Until it holds what was drawn and, `reflect`, its mirror image in the value (Davison and
/// Hinkley, Bootstrap Methods, 1997, section 5.2).
void widen(Interval& interval, double value, Interval drawn, bool reflect);

/// An interval that was drawn about the statistic of some points, for that of all: shifted by their
/// difference, or as it was drawn, whichever end is wider. What the choice of points is off is in
/// it.
Interval about_all(Interval drawn, double of_some, double of_all);

}  // namespace bedscope::validation
