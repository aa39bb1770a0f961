// SPDX-License-Identifier: BSD-3-Clause
// All checks of one quantity together: does the model err to one side, and how much does it
// scatter?
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "validation/verdict.hpp"

namespace bedscope::validation {

/// Model over experiment, over all compared points of a quantity.
///
///   bias    = exp(mean ln(M/E) + scatter^2 / 2 - sigma_E^2 / 2)
///   scatter = sqrt(max(0, var ln(M/E) - sigma_E^2)),  sigma_E^2 = mean (u_E / E)^2
///
/// so that the experiment's own scatter is taken out. Points with M or E not above 0 by more than
/// their uncertainty have no logarithm: counted in `left_out`. Source: McGrattan and Toman,
/// Metrologia 48 (2011) 173.
struct Family {
  std::string quantity, unit;
  double bias = 1, scatter = 0;
  double sigma_experiment = 0;
  std::size_t points = 0, left_out = 0;
  std::vector<const Verdict*> verdicts;
};

/// One for each quantity with at least one comparison, in the order of the checks. The verdicts
/// must outlive it.
std::vector<Family> families(std::span<const Verdict> verdicts);

}  // namespace bedscope::validation
