// SPDX-License-Identifier: BSD-3-Clause
// What a researcher wants to know before trusting a folder of dumps: rules on what a survey and the
// log say. docs/check-up.md lists them all.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "readers/checkup_series.hpp"
#include "readers/liggghts_log.hpp"
#include "readers/survey.hpp"

namespace bedscope::readers {

/// What the rules look at.
struct Facts {
  const Survey& survey;
  const LiggghtsLog& log;  ///< path empty: there is none
  StepSpacing spacing;
  std::optional<Trend> particles;  ///< over all snapshots
  std::optional<Trend> volume;     ///< of the solids, over the snapshots read
};

/// One rule: what it says where it is broken, nothing where it holds or cannot be judged.
struct Rule {
  /// A problem: something is wrong with the data. A note: worth knowing, and often meant so.
  enum class Weight { note, problem };
  std::string_view name;
  Weight weight;
  std::optional<std::string> (*test)(const Facts&);
};

/// Rules on steps, inventory and the log (checkup_run.cpp), and on the sizes of values
/// (checkup_values.cpp). To add one: a function and its row in one of the two, its line in
/// docs/check-up.md, a dump that breaks it in tests/readers/checkup_test.cpp.
std::span<const Rule> run_rules();
std::span<const Rule> value_rules();

struct Finding {
  std::string_view rule;
  std::string text;
};

struct Checkup {
  StepSpacing spacing;
  std::optional<Trend> particles, volume;
  std::vector<Finding> problems, notes;
};

Checkup check_up(const Survey& survey, const LiggghtsLog& log);

}  // namespace bedscope::readers
