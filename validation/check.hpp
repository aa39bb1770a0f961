// SPDX-License-Identifier: BSD-3-Clause
// A [[check]] of a study: what is judged, against what, by which measure.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "readers/toml_table.hpp"
#include "validation/quantity.hpp"

namespace bedscope::validation {

struct Check {
  Place place;
  std::string run;      ///< label; empty: every run
  std::string against;  ///< "varas_2017/...", "theory:...", "run:...", "baseline:..."; or empty
  std::optional<double> number;        ///< a value given in the study itself, instead of `against`
  double number_u = 0;                 ///< its standard uncertainty
  std::map<std::string, double> with;  ///< parameters of a theory
  std::string metric;                  ///< or a shape
  std::optional<double> limit;         ///< of a shape: its own where left out
  double accuracy =
      0.1;               ///< "e over u" holds only where 1.96 u_val is below this share of the mean
  std::size_t line = 0;  ///< in the study
};

/// The checks of a study file, whose other keys are left alone. Throws InputError with line and
/// key: an unknown key, quantity or metric, a limit that is missing, a reference where a shape
/// needs none.
std::vector<Check> read_checks(const std::string& study);
std::vector<Check> read_checks(readers::TomlTable& study);

}  // namespace bedscope::validation
