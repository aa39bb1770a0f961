// SPDX-License-Identifier: BSD-3-Clause
// From pixels to the values of an axis, with the uncertainty of that.
#pragma once

#include <string>

#include "validation/digitise/figure.hpp"

namespace bedscope::digitise {

/// value = a + b t, t the pixel along the axis from the points' mean; of the logarithm where log.
struct Calibration {
  bool log = false;
  double origin = 0, a = 0, b = 0;
  double a_u = 0, b_u = 0;  ///< standard uncertainties, uncorrelated by the choice of the origin

  double value(double pixel) const;
  double pixel(double value) const;
  /// Standard uncertainty of the value at `pixel`, read with standard uncertainty `u` there.
  double uncertainty(double pixel, double u) const;
};

/// Least squares through the points (two or more; `along` are their pixels along the axis in the
/// upright page). A pixel is as uncertain as its digits say: whole numbers by half a pixel, others
/// by a tenth; more where three or more points scatter more. A scatter above 3 pixels is an error:
/// the scale is not what the file says. Throws InputError, `where` first.
Calibration calibrate(const AxisSpec& axis, const std::vector<double>& along,
                      const std::string& where);

/// The angle of the scan that the calibration points show [degrees anticlockwise]; NaN where the
/// points of an axis do not lie along one line of the axes' directions.
double angle_of_points(const Figure& figure);

}  // namespace bedscope::digitise
