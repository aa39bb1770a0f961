// SPDX-License-Identifier: BSD-3-Clause
// The table of what was found.
#pragma once

#include <string>

#include "validation/digitise/figure.hpp"

namespace bedscope::digitise {

/// CSV: series, x, its standard uncertainty, y, its standard uncertainty, and the values at the
/// ends of error bars where any were seen; series in the figure's order, points by x.
std::string table_of(const Digitised& found, const Figure& figure);

}  // namespace bedscope::digitise
