// SPDX-License-Identifier: BSD-3-Clause
// What all figures and the page share: curve styles, axes with sensible ticks, numbers for people.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/result.hpp"

namespace bedscope::report {

/// gnuplot's words for curve `i`: colours of Okabe and Ito (2008, yellow left out: too pale on
/// white), and a dash and a marker of its own, so that curves are told apart in grey too.
struct CurveStyle {
  std::string colour;  ///< "#0072B2"
  std::string line;    ///< "lc rgb '#0072B2' dt (6,3)", without a width
  std::string marker;  ///< "pt 7 ps 0.35"
};
CurveStyle curve_style(std::size_t i);

/// The range of an axis and its ticks: first, first + step ... up to last, within [lo, hi].
struct Axis {
  double lo = 0, hi = 1, first = 0, step = 1, last = 1;
  int decimals = 0;
  bool logarithmic = false;  ///< ticks at powers of ten, `step` being their ratio
};
/// Widens [lo, hi] to whole ticks of 1, 2 or 5 times a power of ten, at most `intervals` of them.
Axis rounded_axis(double lo, double hi, int intervals);
/// Keeps [lo, hi] as it is, for the domain and for time.
Axis exact_axis(double lo, double hi, int intervals);

/// Whole powers of ten around [lo, hi], both above 0.
Axis log_axis(double lo, double hi);

/// Least and greatest of the finite values seen.
struct Range {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();
  void add(double value);  ///< NaN and infinities are left out
  /// With a margin of 5 % at both ends, so that a curve does not lie on the frame.
  Range padded() const { return {lo - 0.05 * (hi - lo), hi + 0.05 * (hi - lo)}; }
  bool empty() const { return lo > hi; }
};

/// Range of values without the outermost `share` at each end, for colours that outliers shall not
/// spoil.
Range central_range(std::vector<double> values, double share);

/// A unit in which numbers of the size of `magnitude` are easy to read, as factor * SI.
struct Unit {
  std::string name;
  double factor = 1;
};
Unit length_unit(double magnitude);  ///< m or mm
Unit mass_unit(double magnitude);    ///< kg, g or mg

/// "0.0255" with so many significant digits; "–" for NaN.
std::string number(double value, int digits = 4);
/// "0.0255 ± 0.0003": the interval with two significant digits where it begins with 1 or 2, else
/// with one, and the value to the same decimal, at most 5 digits ("0.024378 ± < 0.000001"); without
/// an interval the value with 3 digits.
std::string plus_minus(const analysis::Estimate& estimate, double factor = 1);

/// Width of a text at the figures' font size, rather too wide than too narrow [mm].
double text_width(std::string_view text);
/// The text, cut with an ellipsis where it is wider than `width` [mm].
std::string shortened(const std::string& text, double width);

}  // namespace bedscope::report
