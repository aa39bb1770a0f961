// SPDX-License-Identifier: BSD-3-Clause
// Markers found by drawing shapes of all sizes: thin and open ones on lines and bars.
#pragma once

#include <optional>
#include <vector>

#include "validation/digitise/template.hpp"

namespace bedscope::digitise {

/// Of drawn shapes of all sizes the one that explains most ink where it lies well. A smaller one of
/// the same kind would lie as well, but explains less. Of `shapes`; where the ink shows some of
/// `rivals` too, places where one of these lies better do not count.
std::optional<Template> search_drawn(const InkMap& map, const std::vector<Shape>& shapes,
                                     const std::vector<Shape>& rivals = {});

}  // namespace bedscope::digitise
