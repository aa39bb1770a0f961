// SPDX-License-Identifier: BSD-3-Clause
#include "validation/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "analysis/tables.hpp"
#include "readers/error.hpp"
#include "validation/shapes.hpp"
#include "validation/theory.hpp"

namespace bedscope::validation {
namespace {

using analysis::RunResult;

constexpr double coverage_factor = 1.96;

const RunResult& run_of(std::span<const RunResult> runs, const std::string& label) {
  for (const auto& run : runs)
    if (run.label == label) return run;
  std::string labels;
  for (const auto& run : runs) labels += (labels.empty() ? "\"" : ", \"") + run.label + "\"";
  throw InputError("no run \"{}\", there are {}", label, labels);
}

Curve constant(const Check& check, const Sampled& result) {
  Curve curve{.name = fmt::format("{:.6g}", *check.number), .x = result.x, .y = result.y};
  for (const double x : result.at) curve.points.push_back({x, *check.number, 0, check.number_u});
  if (check.number_u == 0)
    curve.assumptions.emplace_back(
        "the number in the study is taken as exact (no uncertainty key)");
  return curve;
}

/// An earlier result: the tables that lie beside its summary.json.
Curve baseline(const std::string& path, const Check& check, const std::string& label,
               const std::string& study) {
  namespace fs = std::filesystem;
  const fs::path file =
      fs::path(path).is_absolute() ? fs::path(path) : fs::path(study).parent_path() / path;
  const auto folder = fs::is_directory(file) ? file : file.parent_path();
  const auto earlier = analysis::read_tables(folder, label);
  return as_curve(sample(earlier, check.place), "baseline " + path);
}

/// The mean of all other runs at the abscissae of this one: how far a family of runs falls
/// together.
Curve mean_of_others(const Check& check, const RunResult& run, const Sampled& result,
                     std::span<const RunResult> runs) {
  Curve mean{.name = "mean of the other runs", .x = result.x, .y = result.y};
  std::vector<Comparison> others;
  const auto here = as_curve(result, run.label);
  for (const auto& other : runs)
    if (other.label != run.label) others.push_back(compare(sample(other, check.place), here));
  if (others.empty()) throw InputError("run:others: expected a second run in the study");
  for (const double x : result.at) {
    double sum = 0, u = 0, count = 0;
    for (const auto& other : others)
      for (const auto& point : other.points)
        if (point.x == x) {
          sum += point.result;
          u += point.u_result * point.u_result + point.u_interpolation * point.u_interpolation;
          count += 1;
        }
    if (count == static_cast<double>(others.size()))
      mean.points.push_back({x, sum / count, 0, std::sqrt(u) / count});
  }
  if (mean.points.empty()) throw InputError("run:others: the runs have no abscissa in common");
  return mean;
}

Curve reference_of(const Check& check, const RunResult& run, const Sampled& result,
                   std::span<const RunResult> runs, const Curves& curves,
                   const std::string& study) {
  if (check.number) return constant(check, result);
  const auto after = [&](std::string_view prefix) { return check.against.substr(prefix.size()); };
  if (check.against.starts_with("theory:"))
    return theory_curve(after("theory:"), check.with, run, result);
  if (check.against == "run:others") return mean_of_others(check, run, result, runs);
  if (check.against.starts_with("run:")) {
    const auto label = after("run:");
    return as_curve(sample(run_of(runs, label), check.place), "run " + label);
  }
  if (check.against.starts_with("baseline:"))
    return baseline(after("baseline:"), check, run.label, study);
  return curves.curve(check.against, check.place.at);
}

/// How a value stands to its limit, in words.
std::string standing(const Verdict& verdict) {
  return fmt::format("{} {:.3g} [{:.3g}, {:.3g}] against {} {:.3g}", verdict.check.metric,
                     verdict.metric.value, verdict.metric.lo, verdict.metric.hi,
                     verdict.small_is_good ? "at most" : "at least", verdict.limit);
}

/// What would settle an undecided check.
std::string what_would_settle(const Verdict& verdict) {
  const auto& metric = verdict.metric;
  const double distance = std::abs(verdict.limit - metric.value);
  const double half_width =
      metric.value <= verdict.limit ? metric.hi - metric.value : metric.value - metric.lo;
  const double of_reference = std::min(metric.reference_half_width, half_width);
  if (of_reference >= distance)
    return "the reference cannot settle it: its own uncertainty reaches over the limit";
  const double of_result = std::sqrt(half_width * half_width - of_reference * of_reference);
  const double longer = of_result * of_result / (distance * distance - of_reference * of_reference);
  const double duration = verdict.result.duration;
  if (longer > 1e4) return "the value is too near to the limit for any simulation to settle it";
  if (duration > 0)
    return fmt::format("{:.2g} s more of simulation would settle it ({:.3g} s were averaged)",
                       duration * (longer - 1), duration);
  return fmt::format("an average over {:.2g} times the time would settle it", longer);
}

std::string reason_of(const Verdict& verdict) {
  std::string text = standing(verdict);
  if (!verdict.comparison.outside.empty())
    text += fmt::format("; {} of {} points of the reference lie outside the result",
                        verdict.comparison.outside.size(), verdict.reference.points.size());
  if (verdict.outcome == Outcome::undecided) text += "; " + what_would_settle(verdict);
  return text;
}

/// V&V 20 says nothing where u_val is large: any error would hide in it.
bool too_uncertain(const Verdict& verdict, std::string& why) {
  if (verdict.check.metric != "e over u") return false;
  double u = 0, mean = 0;
  for (const auto& point : verdict.comparison.points) {
    u = std::max(u, coverage_factor * point.u_validation());
    mean += point.reference / static_cast<double>(verdict.comparison.points.size());
  }
  if (u <= verdict.check.accuracy * std::abs(mean)) return false;
  why =
      fmt::format("; 1.96 u_val reaches {:.2g} of the mean, above the accuracy of {:.2g} asked for",
                  u / std::abs(mean), verdict.check.accuracy);
  return true;
}

void compare_with_reference(Verdict& verdict) {
  const auto& check = verdict.check;
  if (check.metric == "area") {
    if (!verdict.result.is_distribution)
      throw InputError("area: {} is no distribution: expected another metric",
                       check.place.quantity);
    verdict.metric = evaluate_area(verdict.result, verdict.reference);
    verdict.outcome = judge(verdict.metric, verdict.limit, true);
    verdict.reason = reason_of(verdict);
    return;
  }
  const auto& metric = find_metric(check.metric);
  verdict.small_is_good = metric.small_is_good;
  verdict.comparison = compare(verdict.result, verdict.reference, metric.least_points);
  verdict.metric = evaluate(metric, verdict.comparison);
  verdict.outcome = judge(verdict.metric, verdict.limit, metric.small_is_good);
  std::string why;
  if (verdict.outcome == Outcome::holds && too_uncertain(verdict, why))
    verdict.outcome = Outcome::undecided;
  verdict.reason = why.empty() ? reason_of(verdict) : standing(verdict) + why;
  if (verdict.comparison.mirrored)
    verdict.assumptions.push_back(
        verdict.reference.name +
        ": which wall is which is not stated; both ways were tried, turned "
        "round it fits better");
  else if (!verdict.reference.about.orientation_known)
    verdict.assumptions.push_back(
        verdict.reference.name +
        ": which wall is which is not stated; both ways were tried, as it "
        "stands it fits better");
}

Verdict evaluate_on(const Check& check, const RunResult& run, std::span<const RunResult> runs,
                    const Curves& curves, const std::string& study) {
  Verdict verdict{.check = check, .run = run.label, .limit = check.limit.value_or(0)};
  verdict.result = sample(run, check.place);
  if (!verdict.result.error_known)
    verdict.assumptions.push_back(fmt::format("run \"{}\": {} has no intervals; taken as exact",
                                              run.label, check.place.quantity));
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

}  // namespace

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
