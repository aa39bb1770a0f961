// SPDX-License-Identifier: BSD-3-Clause
#include "readers/checkup.hpp"

namespace bedscope::readers {
namespace {

std::optional<Trend> trend_of_counts(const Survey& survey) {
  const std::vector<double> steps(survey.steps.begin(), survey.steps.end());
  const std::vector<double> counts(survey.counts.begin(), survey.counts.end());
  return trend_of(steps, counts);
}

std::optional<Trend> trend_of_volume(const Survey& survey) {
  std::vector<double> steps, volumes;
  for (const auto& snapshot : survey.read) {
    steps.push_back(static_cast<double>(survey.steps[snapshot.index]));
    volumes.push_back(snapshot.volume);
  }
  return trend_of(steps, volumes);
}

}  // namespace

Checkup check_up(const Survey& survey, const LiggghtsLog& log) {
  const Facts facts{survey, log, spacing_of(survey.steps), trend_of_counts(survey),
                    trend_of_volume(survey)};
  Checkup found{facts.spacing, facts.particles, facts.volume, {}, {}};
  for (const auto rules : {run_rules(), value_rules()})
    for (const auto& rule : rules)
      if (auto text = rule.test(facts))
        (rule.weight == Rule::Weight::problem ? found.problems : found.notes)
            .push_back({rule.name, std::move(*text)});
  return found;
}

}  // namespace bedscope::readers
