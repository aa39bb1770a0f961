// SPDX-License-Identifier: BSD-3-Clause
// The picture with what was found drawn on it.
#pragma once

#include "validation/digitise/figure.hpp"
#include "validation/digitise/page.hpp"

namespace bedscope::digitise {

/// The page, paled, with the plot area, what was left out (hatched), the calibration points, and
/// each point as a cross with its error bar.
cv::Mat draw_overlay(const Page& page, const Digitised& found, const Figure& figure);

}  // namespace bedscope::digitise
