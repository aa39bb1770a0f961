// SPDX-License-Identifier: BSD-3-Clause
// Rules on the run as a whole: its steps, its inventory, its log.
#include <fmt/format.h>

#include <array>

#include "readers/checkup.hpp"

namespace bedscope::readers {
namespace {

using Said = std::optional<std::string>;
using enum Rule::Weight;

// --- steps

Said missing_steps(const Facts& facts) {
  const auto& gaps = facts.spacing.gaps;
  if (gaps.empty()) return {};
  const auto& first = gaps.front();
  const auto missing = first.missing();
  std::string steps = fmt::format("{}", first.before + first.spacing);
  if (missing > 1) steps += fmt::format(" to {}", first.after - first.spacing);
  return fmt::format("step{} {} {} missing between {} and {}{}", missing > 1 ? "s" : "", steps,
                     missing > 1 ? "are" : "is", first.before, first.after,
                     gaps.size() == 1 ? ""
                                      : fmt::format("; {} gaps in all, {} steps missing",
                                                    gaps.size(), facts.spacing.missing()));
}

Said changed_spacing(const Facts& facts) {
  const auto& changes = facts.spacing.changes;
  if (changes.empty()) return {};
  const auto& first = changes.front();
  return fmt::format(
      "the spacing changes from {} to {} steps at step {}{}: snapshots weigh by the "
      "time that they stand for",
      first.from, first.to, first.step,
      changes.size() == 1 ? "" : fmt::format(", {} times in all", changes.size()));
}

Said irregular_steps(const Facts& facts) {
  if (facts.spacing.irregular == 0) return {};
  return fmt::format("{} of {} intervals between steps are irregular (the most common one is {})",
                     facts.spacing.irregular, facts.survey.steps.size() - 1, facts.spacing.usual);
}

// --- inventory

Said particles_lost(const Facts& facts) {
  const auto& survey = facts.survey;
  const auto i = sudden_change(survey.counts, -1);
  if (!i) return {};
  return fmt::format("particles are lost: {} at step {}, {} at step {}", survey.counts[*i],
                     survey.steps[*i], survey.counts[*i + 1], survey.steps[*i + 1]);
}

Said particles_added(const Facts& facts) {
  const auto& survey = facts.survey;
  const auto i = sudden_change(survey.counts, 1);
  if (!i) return {};
  return fmt::format("the number of particles jumps: {} at step {}, {} at step {}",
                     survey.counts[*i], survey.steps[*i], survey.counts[*i + 1],
                     survey.steps[*i + 1]);
}

Said drift(const Facts& facts) {
  const auto line = [](const char* what, const Trend& trend) {
    return fmt::format(
        "{} drifts by {:+.3g} +- {:.2g} % from the first to the last snapshot "
        "(99 % interval): is the run steady?",
        what, 100 * trend.change, 100 * trend.ci99);
  };
  if (facts.particles && facts.particles->significant())
    return line("the number of particles", *facts.particles);
  if (facts.volume && facts.volume->significant())
    return line("the volume of the solids", *facts.volume);
  return {};
}

// --- the log

Said units_of_log(const Facts& facts) {
  const auto& units = facts.log.units;
  if (units.empty() || units == "si") return {};
  const auto* what = units == "cgs"     ? " (cm, g, s; densities in g/cm3)"
                     : units == "micro" ? " (micrometres, picograms, microseconds)"
                                        : "";
  return fmt::format("{} says units {}{}: bedscope takes all numbers for SI", facts.log.path, units,
                     what);
}

Said errors_of_log(const Facts& facts) {
  const auto& errors = facts.log.errors;
  if (errors.count == 0) return {};
  return fmt::format("{}: line {}: error: {}", facts.log.path, errors.line, errors.first);
}

Said warnings_of_log(const Facts& facts) {
  const auto& warnings = facts.log.warnings;
  if (warnings.count == 0) return {};
  return fmt::format("{}: {} warning{}, first in line {}: {}", facts.log.path, warnings.count,
                     warnings.count == 1 ? "" : "s", warnings.line, warnings.first);
}

Said several_time_steps(const Facts& facts) {
  if (!facts.log.several_time_steps) return {};
  return fmt::format("{} sets several time steps: {} s, the last, is taken for all", facts.log.path,
                     *facts.log.time_step);
}

Said log_of_another_run(const Facts& facts) {
  const auto& last = facts.log.last_step;
  if (!last || facts.survey.steps.back() <= *last || !facts.log.ended) return {};
  return fmt::format("{} ends at step {}, the dumps at {}: is it the log of another run?",
                     facts.log.path, *last, facts.survey.steps.back());
}

Said run_not_ended(const Facts& facts) {
  if (!facts.log.last_step || facts.log.ended) return {};
  return fmt::format(
      "{} breaks off at step {} (no \"Loop time\"): the run was stopped, or still "
      "goes on",
      facts.log.path, *facts.log.last_step);
}

constexpr std::array rules{
    Rule{"missing steps", problem, missing_steps},
    Rule{"changed spacing", note, changed_spacing},
    Rule{"irregular steps", note, irregular_steps},
    Rule{"particles lost", problem, particles_lost},
    Rule{"particles added", note, particles_added},
    Rule{"drift", note, drift},
    Rule{"units of the log", problem, units_of_log},
    Rule{"errors in the log", problem, errors_of_log},
    Rule{"warnings in the log", note, warnings_of_log},
    Rule{"several time steps", note, several_time_steps},
    Rule{"log of another run", note, log_of_another_run},
    Rule{"run not ended", note, run_not_ended},
};

}  // namespace

std::span<const Rule> run_rules() { return rules; }

}  // namespace bedscope::readers
