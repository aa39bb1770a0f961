// SPDX-License-Identifier: BSD-3-Clause
// The picture of one marker, and how it is laid over the page with a precision below a pixel.
#pragma once

#include <opencv2/core.hpp>

#include "validation/digitise/shapes.hpp"

namespace bedscope::digitise {

/// What is looked at: how much of each pixel the ink covers, and which pixels tell nothing (another
/// ink lies over them, a rule was taken away there, outside of the plot).
struct InkMap {
  cv::Mat coverage;  ///< CV_32F, 0 to 1
  cv::Mat unknown;   ///< CV_8U, not 0: nothing known
};

inline constexpr int margin = 2;  ///< px of paper that a template has round its marker

struct Template {
  cv::Mat ink;     ///< CV_32F with a margin of paper; the middle of the image is its origin
  cv::Mat inside;  ///< CV_8U: the marker with its inside, where extra ink counts in full
  Shape shape;
  cv::Size2d box;         ///< of the ink [px]
  cv::Point2d reference;  ///< the data point, from the origin
  double reference_u[2] = {0, 0};
};

/// Where a template lies best.
struct Fit {
  cv::Point2d origin;     ///< of the template, on the page
  double u[2] = {0, 0};   ///< standard uncertainties from what the fit leaves
  double score = -1;      ///< 1 where all is explained, 0 where it is no better than paper
  double known = 0;       ///< share of the template's ink on known pixels
  double least_part = 0;  ///< how much of the ink of its worst eighth (by direction) is there
  double next_part = 0;   ///< the same of its second worst eighth
};

/// The outline and fill that resemble `ink` best, of `among`, with their correlation.
std::pair<Shape, double> recognise(const cv::Mat& ink, const std::vector<Shape>& among);

/// All shapes that a bare series may have; of one outline or fill where `asked` says so.
std::vector<Shape> candidates(const std::optional<Shape>& asked);

/// A template without its reference point, to try a shape.
Template bare_template(const cv::Mat& ink, const Shape& shape);

/// A template from a picture of a marker, its reference point by symmetry and by the rules of
/// reference_of().
Template make_template(const cv::Mat& ink, const Shape& shape);

/// The template without what sticks out by more than half a pixel of the outline, of `shapes`, that
/// its silhouette resembles most: bars and lines. As it is where none resembles it, to `most` of
/// its area. Of plus, x and
/// asterisk what their mirror image has too: a line runs through them one way.
Template trimmed(const Template& marker, const std::vector<Shape>& shapes, double most = 1.0 / 8);

/// The template as that outline, of `shapes`, that its silhouette resembles most when each may take
/// its own size: correlation in one box takes a triangle that has lost its tip for a pentagon.
Template reshaped(const Template& marker, const std::vector<Shape>& shapes);

/// A template laid at `origin`, whether it lies well there or not; u is not known.
Fit seen_at(const Template& marker, const InkMap& map, cv::Point2d origin);

/// Least squares over the shift from the best whole pixel near `near`, with weights that leave out
/// what does not belong to the marker (lines through it, error bars, neighbours).
Fit fit(const Template& marker, const InkMap& map, cv::Point2d near);

/// By how much a template lies better than half its size farther on both sides, along the line or
/// bar where that is least: what a stroke that goes through explains is not the marker's. 0 below
/// 0.1, what a disc a quarter wider than its line lacks there.
double distinct(const Template& marker, const InkMap& map, const Fit& where);

/// The part of `image` of the size of `like` whose middle is at `origin` (sub-pixel, cubic), with
/// `outside` beyond the edges.
cv::Mat window(const cv::Mat& image, cv::Point2d origin, cv::Size size, double outside);

/// The template's ink as it falls on the pixels of a window of the page whose middle pixel is
/// `middle`.
cv::Mat laid(const Template& marker, cv::Point2d origin, cv::Point middle);

}  // namespace bedscope::digitise
