// SPDX-License-Identifier: BSD-3-Clause
// Takes frame, grid lines and ticks out of an ink's coverage where they are of its colour.
#pragma once

#include "validation/digitise/template.hpp"

namespace bedscope::digitise {

/// Lines over the whole width or height of the map, unbroken or dashed. A pale line is taken out of
/// the mixture, c = (seen - pale) / (1 - pale); under a dark one nothing is known. Then the ticks:
/// what sticks in from the edges, thin and short. A single line that is not on the edge stays: it
/// is a constant, not a grid; in grey (`is_grey`) if it holds most of the ink.
void clear_rules(InkMap& map, bool is_grey);

}  // namespace bedscope::digitise
