// SPDX-License-Identifier: BSD-3-Clause
// Figures of verdicts: one panel a check, one scatter plot a quantity.
#pragma once

#include <string_view>

#include "report/figures.hpp"
#include "validation/family.hpp"

namespace bedscope::report {

/// Data with error bars, the result with its 95 % band, the errors beneath with 1.96 u_val.
/// Nothing to draw for single values, and checks that were skipped: `missing` says so.
Figure check_figure(const validation::Verdict& verdict, const std::string& name);

/// " m" of a height, " s" of a time: what follows the number of a check's place.
std::string_view unit_of_place(std::string_view key);

/// Result against reference, all compared points of a quantity, with bias and scatter.
Figure family_figure(const validation::Family& family, const std::string& name);

}  // namespace bedscope::report
