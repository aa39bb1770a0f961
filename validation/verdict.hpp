// SPDX-License-Identifier: BSD-3-Clause
// From a check to a verdict: holds, does not hold, or cannot be decided by what is at hand.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/result.hpp"
#include "validation/check.hpp"
#include "validation/curves.hpp"
#include "validation/metrics.hpp"

namespace bedscope::validation {

enum class Outcome { holds, does_not_hold, undecided, skipped };

/// "holds", "does not hold", "undecided", "skipped".
std::string_view name_of(Outcome outcome);

struct Verdict {
  Check check;
  std::string run;  ///< label
  double limit = 0;
  bool small_is_good = true;
  MetricValue metric;
  Outcome outcome = Outcome::undecided;
  std::string reason;  ///< one sentence for people
  Sampled result;
  Curve reference;                       ///< no points for shapes
  Comparison comparison;                 ///< no points for shapes and distributions
  std::vector<std::string> notes;        ///< what else is to be known of the result
  std::vector<std::string> assumptions;  ///< uncertainties and orientations that nobody stated
};

/// A number for people, rounded to so many digits; with an exponent only from a million on.
std::string in_digits(double value, int digits);

/// " K" of a metric that has a unit, nothing of one that has none.
std::string unit_text(const MetricValue& metric);

/// Digits in which a verdict's interval and limit are told apart as they were judged: three, or as
/// many as it takes.
int digits_of(const Verdict& verdict);

/// What was or, where it is missing, should have been the reference; empty for shapes.
std::string reference_name(const Verdict& verdict);

/// Whether two verdicts are of the same values of the same run against the same reference: they
/// differ by metric or limit at most.
bool same_comparison(const Verdict& a, const Verdict& b);

/// Holds if the whole 95 % interval of the metric keeps the limit, does not hold if none of it
/// does, else undecided: the interval is [lo, hi].
Outcome judge(const MetricValue& metric, double limit, bool small_is_good);

/// Judges a check on each run that it names. What cannot be decided says how many more seconds of
/// simulation would settle it (errors of means fall with the square root of the time), or that the
/// reference's uncertainty alone forbids it. A reference that the user has to supply gives skipped.
/// `study`: the study file, to name its line in messages. Throws InputError.
std::vector<Verdict> evaluate(const Check& check, std::span<const analysis::RunResult> runs,
                              const Curves& curves, const std::string& study);

}  // namespace bedscope::validation
