// SPDX-License-Identifier: BSD-3-Clause
// What a check is held against, as a curve.
#pragma once

#include <span>
#include <string>

#include "analysis/result.hpp"
#include "validation/check.hpp"
#include "validation/curves.hpp"

namespace bedscope::validation {

/// The run of that label. Throws InputError listing the labels.
const analysis::RunResult& run_of(std::span<const analysis::RunResult> runs,
                                  const std::string& label);

/// What a number in the study is called as a reference.
std::string number_name(double number);

/// The reference of a check on a run: a number, a curve, a theory, other runs, an earlier result.
/// A curve along time is reduced to its mean (its deviation, its dominant frequency) where the
/// result is one; any other curve of several points against a single value is an error.
/// `study`: the study file, for paths relative to it. Throws InputError, MissingCurve and what the
/// readers of curves and tables throw.
Curve reference_of(const Check& check, const analysis::RunResult& run, const Sampled& result,
                   std::span<const analysis::RunResult> runs, const Curves& curves,
                   const std::string& study);

/// What is wrong with a check's reference whatever the runs hold: no such run, curve, choice,
/// theory, parameter or earlier result. A curve that the user has to supply is no fault. Throws
/// InputError that names the study's line, and what the readers of curves throw.
void require_reference(const Check& check, std::span<const std::string> labels,
                       const Curves& curves, const std::string& study);

}  // namespace bedscope::validation
