// SPDX-License-Identifier: BSD-3-Clause
#include "validation/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "readers/error.hpp"
#include "validation/reference.hpp"
#include "validation/shapes.hpp"

namespace bedscope::validation {
namespace {

using analysis::RunResult;

constexpr double coverage_factor = 1.96;

/// How a value stands to its limit, in words.
std::string standing(const Verdict& verdict) {
  const int digits = digits_of(verdict);
  const auto unit = unit_text(verdict.metric);
  return fmt::format("{} {} [{}, {}]{} against {} {}{}", verdict.check.metric,
                     in_digits(verdict.metric.value, digits), in_digits(verdict.metric.lo, digits),
                     in_digits(verdict.metric.hi, digits), unit,
                     verdict.small_is_good ? "at most" : "at least",
                     in_digits(verdict.limit, digits), unit);
}

/// An average over `longer` times the time.
std::string in_time(double duration, double longer) {
  if (duration > 0)
    return fmt::format("{} s more of simulation would settle it ({} s were averaged)",
                       in_digits(duration * (longer - 1), 2), in_digits(duration, 3));
  return fmt::format("an average over {} times the time would settle it", in_digits(longer, 2));
}

/// Who sets the uncertainty that a longer simulation leaves: the reference, or cells so coarse that
/// the result is not known between them.
std::string_view what_limits(const Verdict& verdict) {
  double of_reference = 0, of_interpolation = 0;
  for (const auto& point : verdict.comparison.points) {
    of_reference += point.u_reference_mean() * point.u_reference_mean();
    of_interpolation += point.u_interpolation * point.u_interpolation;
  }
  if (of_interpolation > of_reference)
    return "no longer simulation can settle it, smaller cells might: interpolation between the "
           "result's points is too uncertain";
  return verdict.check.against.starts_with("run:")
             ? "a longer average of the run that it is judged by would settle it"
             : "the reference cannot settle it: its own uncertainty is too large";
}

/// What would settle an undecided check.
std::string what_would_settle(const Verdict& verdict) {
  const auto& metric = verdict.metric;
  const double distance = std::abs(verdict.limit - metric.value);
  // The wider side: the other one may end at 0, which no metric goes below.
  const double half_width = std::max(metric.hi - metric.value, metric.value - metric.lo);
  const double fixed = std::min(metric.fixed_half_width, half_width);
  if (fixed >= distance) return std::string(what_limits(verdict));
  const double longer =
      (half_width * half_width - fixed * fixed) / (distance * distance - fixed * fixed);
  if (longer > 1e4) return "the value is too near to the limit for any simulation to settle it";
  return in_time(verdict.result.duration, longer);
}

/// Points that a metric of logarithms leaves out.
std::size_t without_logarithm(const Verdict& verdict) {
  const auto& points = verdict.comparison.points;
  if (points.empty() || !find_metric(verdict.check.metric).of_logarithms) return 0;
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(),
                    [](const ComparedPoint& point) { return !point.has_logarithm(); }));
}

/// Uncertainties that leave too few points a logarithm: nothing can be said, which is no error of
/// the study. Values that are not above 0 are one, see evaluate().
bool leaves_too_few_logarithms(const Metric& metric, Verdict& verdict) {
  const auto& points = verdict.comparison.points;
  const auto positive = std::count_if(points.begin(), points.end(), [](const ComparedPoint& point) {
    return point.result > 0 && point.reference > 0;
  });
  const std::size_t left = points.size() - without_logarithm(verdict);
  if (left >= metric.least_points || positive < std::ptrdiff_t(metric.least_points)) return false;
  verdict.metric.value = verdict.metric.lo = verdict.metric.hi = std::nan("");
  verdict.outcome = Outcome::undecided;
  verdict.reason = fmt::format(
      "{}: {} of {} points are above 0 by more than their uncertainty, expected {} at least",
      metric.name, left, points.size(), metric.least_points);
  return true;
}

/// `why`: besides an interval that holds the limit, what keeps the check from being decided.
std::string reason_of(const Verdict& verdict, const std::string& why = "") {
  std::string text = standing(verdict);
  if (!verdict.comparison.outside.empty())
    text += fmt::format("; {} of {} points of the reference lie outside the result{}",
                        verdict.comparison.outside.size(), verdict.reference.points.size(),
                        verdict.comparison.in_gaps > 0 ? ", or in a gap of it" : "");
  if (!verdict.comparison.without_error.empty())
    text += fmt::format("; at {} more the result has no interval, and is not compared",
                        verdict.comparison.without_error.size());
  if (const auto without = without_logarithm(verdict); without > 0)
    text += fmt::format(
        "; {} of {} points are not above 0 by more than their uncertainty, and have no logarithm",
        without, verdict.comparison.points.size());
  const auto& of_profile = verdict.result.at;
  if (find_shape(verdict.check.metric) != nullptr && verdict.metric.points < of_profile.size())
    text += fmt::format("; {} of {} points of the profile have no value, or no interval",
                        of_profile.size() - verdict.metric.points, of_profile.size());
  if (const auto& m = verdict.metric; m.points_drawn < m.points)
    text += fmt::format("; its interval was drawn at {} of {} points", m.points_drawn, m.points);
  if (!why.empty()) return text + why;
  if (verdict.outcome == Outcome::undecided) text += "; " + what_would_settle(verdict);
  return text;
}

/// V&V 20 says nothing where u_val is large: any error would hide in it. Says what would help.
bool too_uncertain(const Verdict& verdict, std::string& why) {
  if (verdict.check.metric != "e over u") return false;
  const auto& points = verdict.comparison.points;
  double mean = 0;
  for (const auto& point : points) mean += point.reference / static_cast<double>(points.size());
  const double wanted = verdict.check.accuracy * std::abs(mean) / coverage_factor;
  double largest = 0, longer = 1;
  for (const auto& point : points) {
    largest = std::max(largest, point.u_validation());
    const double fixed = std::hypot(point.u_reference, point.u_interpolation);
    const double left = wanted * wanted - fixed * fixed;
    longer = std::max(longer, left > 0 ? point.u_result * point.u_result / left
                                       : std::numeric_limits<double>::infinity());
  }
  if (largest <= wanted) return false;
  why = fmt::format(
      "; 1.96 u_val reaches {:.2g} of the mean, above the accuracy of {:.2g} asked for: ",
      coverage_factor * largest / std::abs(mean), verdict.check.accuracy);
  if (!std::isfinite(longer))
    why += what_limits(verdict);
  else
    why += in_time(verdict.result.duration, longer);
  return true;
}

/// Whether the reference was turned round.
bool judge_area(Verdict& verdict) {
  if (!verdict.result.is_distribution)
    throw InputError("area: {} is no distribution: expected another metric",
                     verdict.check.place.quantity);
  verdict.metric = evaluate_area(verdict.result, verdict.reference);
  bool is_turned = false;
  if (!verdict.reference.about.orientation_known) {
    auto turned = verdict.reference;
    turned.points = turned_round(verdict.result, turned.points);
    const auto other = evaluate_area(verdict.result, turned);
    is_turned = other.value < verdict.metric.value;
    if (is_turned) {
      verdict.metric = other;
      verdict.reference = std::move(turned);
    }
  }
  verdict.outcome = judge(verdict.metric, verdict.limit, true);
  verdict.reason = reason_of(verdict);
  return is_turned;
}

bool judge_errors(Verdict& verdict) {
  const auto& metric = find_metric(verdict.check.metric);
  verdict.small_is_good = metric.small_is_good;
  verdict.comparison = compare(verdict.result, verdict.reference, metric.least_points);
  if (leaves_too_few_logarithms(metric, verdict)) return verdict.comparison.mirrored;
  verdict.metric = evaluate(metric, verdict.comparison);
  verdict.outcome = judge(verdict.metric, verdict.limit, metric.small_is_good);
  std::string why;
  if (verdict.outcome == Outcome::holds && too_uncertain(verdict, why))
    verdict.outcome = Outcome::undecided;
  verdict.reason = reason_of(verdict, why);
  return verdict.comparison.mirrored;
}

void compare_with_reference(Verdict& verdict) {
  const bool is_turned =
      verdict.check.metric == "area" ? judge_area(verdict) : judge_errors(verdict);
  if (!verdict.reference.about.orientation_known)
    verdict.assumptions.push_back(fmt::format(
        "{}: which wall is which is not stated; both ways were tried, {} it fits better",
        verdict.reference.name, is_turned ? "turned round" : "as it stands"));
}

std::size_t snapshots_of(const RunResult& run) {
  return static_cast<std::size_t>(
      std::count_if(run.inventory.begin(), run.inventory.end(),
                    [&](const auto& row) { return row.type == run.inventory.front().type; }));
}

bool is_instant(const RunResult& run, const Sampled& result) {
  return !result.error_known && !result.x.is_time() && run.window.snapshots == 1;
}

/// What the value of the run rests on, in words for people.
std::string without_intervals(const RunResult& run, const Sampled& result) {
  if (is_instant(run, result))
    return fmt::format(
        "run \"{}\": {} of one snapshot, taken as exact: how it fluctuates is not known", run.label,
        result.y.name);
  return fmt::format("run \"{}\": {} has no intervals; taken as exact", run.label, result.y.name);
}

/// One snapshot out of many is no average: whatever it says, the next one may say otherwise. An
/// instant that the check asks for, or a run that has no more, is taken as it is.
void decide_nothing_by_one_of_many(const RunResult& run, Verdict& verdict) {
  const auto all = snapshots_of(run);
  if (!is_instant(run, verdict.result) || all < 2) return;
  const auto& at = verdict.check.place.at;
  if (const auto asked = at.find("time"); asked != at.end()) {
    if (std::abs(asked->second - run.window.from) <= 1e-6 * std::abs(asked->second)) return;
    throw InputError("at.time = {} s: the only snapshot of the run's window is that of {} s",
                     asked->second, run.window.from);
  }
  verdict.outcome = Outcome::undecided;
  verdict.reason =
      standing(verdict) +
      fmt::format(
          "; the window holds 1 of {} snapshots, which is no average and has no error: "
          "expected a longer one, or at = {{ time = {:.9g} }} where this instant is meant",
          all, run.window.from);
}

/// An instant that a check asks for, of a run that averages over many.
void say_what_an_instant_is(const RunResult& run, Verdict& verdict) {
  const auto& at = verdict.check.place.at;
  const auto asked = at.find("time");
  if (asked == at.end() || run.window.snapshots < 2) return;
  const auto [from, to] = std::pair(run.window.from, run.window.to);
  if (!(asked->second >= from && asked->second <= to))
    throw InputError("at.time = {} s: the run averages over {} to {} s", asked->second, from, to);
  verdict.notes.push_back(
      fmt::format("run \"{}\": the average over {} to {} s stands for at.time = {} s", run.label,
                  from, to, asked->second));
}

Verdict judged_on(const Check& check, const RunResult& run, std::span<const RunResult> runs,
                  const Curves& curves, const std::string& study) {
  Verdict verdict{.check = check, .run = run.label, .limit = check.limit.value_or(0)};
  verdict.result = sample(run, check.place);
  verdict.notes = verdict.result.notes;
  say_what_an_instant_is(run, verdict);
  if (!verdict.result.unseen.empty()) {
    verdict.metric.value = verdict.metric.lo = verdict.metric.hi = std::nan("");
    verdict.outcome = Outcome::undecided;
    verdict.reason = verdict.result.unseen;
    return verdict;
  }
  if (!verdict.result.error_known)
    verdict.assumptions.push_back(without_intervals(run, verdict.result));
  if (const auto* shape = find_shape(check.metric)) {
    verdict.limit = check.limit.value_or(shape->limit);
    verdict.small_is_good = shape->small_is_good;
    verdict.metric = evaluate(*shape, verdict.result);
    verdict.outcome = judge(verdict.metric, verdict.limit, shape->small_is_good);
    verdict.reason = reason_of(verdict);
    return verdict;
  }
  try {
    verdict.reference = reference_of(check, run, verdict.result, runs, curves, study);
  } catch (const MissingCurve& missing) {
    verdict.outcome = Outcome::skipped;
    verdict.reason = missing.what();
    return verdict;
  }
  verdict.assumptions.insert(verdict.assumptions.end(), verdict.reference.assumptions.begin(),
                             verdict.reference.assumptions.end());
  compare_with_reference(verdict);
  return verdict;
}

Verdict evaluate_on(const Check& check, const RunResult& run, std::span<const RunResult> runs,
                    const Curves& curves, const std::string& study) {
  auto verdict = judged_on(check, run, runs, curves, study);
  if (verdict.outcome != Outcome::skipped && verdict.result.unseen.empty())
    decide_nothing_by_one_of_many(run, verdict);
  return verdict;
}

}  // namespace

std::string in_digits(double value, int digits) {
  std::string text = fmt::format("{:.{}g}", value, digits);
  if (text.find("e+") == text.npos || !(std::abs(value) < 1e6)) return text;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) + 1 - digits);
  return fmt::format("{:.0f}", std::round(value / unit) * unit);
}

std::string unit_text(const MetricValue& metric) {
  return metric.unit == "-" ? "" : " " + metric.unit;
}

int digits_of(const Verdict& verdict) {
  const auto rounded = [](double value, int digits) { return std::stod(in_digits(value, digits)); };
  constexpr int most = 17;  // which tell any two doubles apart
  for (int digits = 3; digits < most; ++digits) {
    const MetricValue shown{.lo = rounded(verdict.metric.lo, digits),
                            .hi = rounded(verdict.metric.hi, digits)};
    if (judge(shown, rounded(verdict.limit, digits), verdict.small_is_good) ==
        judge(verdict.metric, verdict.limit, verdict.small_is_good))
      return digits;
  }
  return most;
}

std::string reference_name(const Verdict& verdict) {
  const auto& check = verdict.check;
  if (!verdict.reference.name.empty()) return verdict.reference.name;
  return check.number ? number_name(*check.number) : check.against;
}

bool same_comparison(const Verdict& a, const Verdict& b) {
  const auto compared = [](const Verdict& v) {
    const auto& c = v.check;
    return std::tie(v.run, c.place.quantity, c.place.at, c.place.species, c.against, c.number,
                    c.number_u, c.with);
  };
  return compared(a) == compared(b);
}

std::string_view name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::holds:
      return "holds";
    case Outcome::does_not_hold:
      return "does not hold";
    case Outcome::undecided:
      return "undecided";
    default:
      return "skipped";
  }
}

Outcome judge(const MetricValue& metric, double limit, bool small_is_good) {
  const bool holds = small_is_good ? metric.hi <= limit : metric.lo >= limit;
  const bool fails = small_is_good ? metric.lo > limit : metric.hi < limit;
  if (holds) return Outcome::holds;
  return fails ? Outcome::does_not_hold : Outcome::undecided;
}

std::vector<Verdict> evaluate(const Check& check, std::span<const RunResult> runs,
                              const Curves& curves, const std::string& study) {
  try {
    std::vector<Verdict> verdicts;
    if (!check.run.empty()) {
      verdicts.push_back(evaluate_on(check, run_of(runs, check.run), runs, curves, study));
      return verdicts;
    }
    for (const auto& run : runs)
      if (check.against != "run:" + run.label)
        verdicts.push_back(evaluate_on(check, run, runs, curves, study));
    return verdicts;
  } catch (const InputError& error) {
    throw InputError("{}: line {}: check: {}", study, check.line, error.what());
  }
}

}  // namespace bedscope::validation
