// SPDX-License-Identifier: BSD-3-Clause
// From pixels to the values of an axis, with the uncertainty of that.
#pragma once

#include <string>
#include <vector>

#include "validation/digitise/figure.hpp"

namespace bedscope::digitise {

/// A calibration point's place along its axis in the upright page [px], with its standard
/// uncertainties: its own, and that of an error that it shares with all others that have one.
struct Place {
  double at = 0, u = 0, shared = 0;
};

/// value = a + b t, t the pixel along the axis from the points' mean; of the logarithm where log.
struct Calibration {
  bool log = false;
  double origin = 0, a = 0, b = 0;
  std::vector<Place> places;  ///< that it was made from

  double value(double pixel) const;
  double pixel(double value) const;
  /// Standard uncertainty of the value at `pixel`, read with standard uncertainty `u` there.
  double uncertainty(double pixel, double u) const;
};

/// The places of an axis' points at `along` [px]. Whole pixels were picked by eye, which may take a
/// line's neighbouring pixel for its middle: uniform within one pixel to each side. Where one of
/// the lines across the axis (frame, grid, ticks; `lines` are their middles) is within one and a
/// half, and no other is near, that line was meant, and programs draw it on whole pixels: uniform
/// within half a pixel. A line on the middle of a pixel (of an odd thickness) is drawn there by
/// gnuplot because that is its place; matplotlib rounds to the edge between two pixels and then
/// draws half a pixel to the right and below of that, all lines of a plot alike. So it is taken for
/// half of that half off, give or take the other half, an error that such places share; so are
/// those of a `turned` page, where it cannot be told. Fractions were measured, to a tenth; one
/// within three tenths of a line's middle is that line's. `pixel` is the size of the picture's in
/// the page's.
std::vector<Place> places_of(const AxisSpec& axis, const std::vector<double>& along,
                             const std::vector<double>& lines, double pixel, bool turned);

/// Least squares through the points (two or more); more uncertain than their places say where three
/// or more scatter more. Where these scatter less, the rest of their uncertainty is an error that
/// they share: the rounding of lines a whole number of pixels apart. A scatter above 3 pixels is an
/// error: the scale is not what the file says. Throws InputError, `where` first.
Calibration calibrate(const AxisSpec& axis, const std::vector<Place>& places,
                      const std::string& where);

/// Of a scan [degrees anticlockwise], with its standard uncertainty.
struct Angle {
  double angle = nan, u = 0;
};

/// The angle that the calibration points show; NaN where the points of an axis do not lie along one
/// line of the axes' directions.
Angle angle_of_points(const Figure& figure);

}  // namespace bedscope::digitise
