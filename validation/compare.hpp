// SPDX-License-Identifier: BSD-3-Clause
// A result's curve brought to the abscissae of its reference.
#pragma once

#include <cstddef>
#include <vector>

#include "validation/curve.hpp"

namespace bedscope::validation {

/// What a single value is of the series in time that it stands for: a reference that is a series
/// is reduced to the same.
enum class Statistic { mean, deviation, frequency };

/// A quantity of a run, along an abscissa or (one point, x = 0) a single value.
struct Sampled {
  Title x, y;
  std::vector<double> at;  ///< ascending
  std::vector<double> value;
  std::vector<double> u;         ///< standard error of each value; nan: of this one not known
  bool error_known = true;       ///< false: the run has no intervals (tables of another program)
  bool is_scalar = false;        ///< one value, no abscissa
  bool is_distribution = false;  ///< value is a probability density of `at`
  double duration = 0;           ///< [s] averaged over; 0: not known
  Statistic statistic = Statistic::mean;  ///< of a single value
  std::vector<std::string> notes;         ///< what is to be said of it, for people
  std::string unseen;  ///< why there is no value, where the run looked for it; else empty
};

/// Result and reference at one abscissa.
struct ComparedPoint {
  double x = 0, result = 0, reference = 0;
  double u_result = 0;         ///< standard error of the time average
  double u_interpolation = 0;  ///< of the result between its own abscissae
  double u_reference = 0;      ///< of its ordinate, and of its abscissa through the result's slope
                               ///< over its reach; towards the result where a bar has unequal arms
  double u_reference_away = -1;  ///< away from it; below 0: as u_reference

  double error() const { return result - reference; }
  double away() const { return u_reference_away < 0 ? u_reference : u_reference_away; }
  /// Root mean square of both arms.
  double u_reference_mean() const;
  /// u_val of ASME V&V 20 (2009), eq. 1-5-4.
  double u_validation() const;
  /// Whether result and reference are above 0 by more than their 95 % uncertainty: others have no
  /// logarithm, or none with an error to speak of.
  bool has_logarithm() const;
};

struct Comparison {
  Title x, y;
  std::vector<ComparedPoint> points;
  std::vector<CurvePoint> outside;  ///< points of the reference that the result does not reach
  std::size_t in_gaps = 0;  ///< of these, between two points of the result that has none there
  std::vector<CurvePoint>
      without_error;      ///< where the result has no interval, though elsewhere it has
  bool mirrored = false;  ///< the reference's abscissa was turned round: see compare()
  bool error_known = true;
  double duration = 0;
};

/// The reference's points from the other wall: x becomes first + last - x of the result's
/// abscissae.
std::vector<CurvePoint> turned_round(const Sampled& result, std::vector<CurvePoint> points);

/// The result interpolated linearly to the abscissae of the reference, nowhere extrapolated (half a
/// cell at the ends is not either). The interpolation's error is taken as its difference from the
/// cubic through four neighbours. Where the result has no finite value it reaches nothing. Where
/// the error of the result is not known at a point, though it is at others, it is not compared
/// there. Where the reference does not say which end of its abscissa is which wall, it is turned
/// round within the result's range if it fits better so, and `mirrored` says it. Errors of averages
/// over the same snapshots (Curve::of_same_snapshots) are common, and count 0. Throws InputError
/// where fewer than `least` points of the reference are reached, or where units differ.
Comparison compare(const Sampled& result, const Curve& reference, std::size_t least = 1);

}  // namespace bedscope::validation
