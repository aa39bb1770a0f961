// SPDX-License-Identifier: BSD-3-Clause
// What a marker looks like where it is seen best: the median of many.
#pragma once

#include <optional>
#include <vector>

#include "validation/digitise/template.hpp"

namespace bedscope::digitise {

/// `marker` taken again from the map as the median of what lies at the places where it fits well;
/// nothing where these are fewer than three.
std::optional<Template> typical(const InkMap& map, const Template& marker,
                                const std::vector<cv::Point2d>& guesses);

}  // namespace bedscope::digitise
