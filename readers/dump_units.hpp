// SPDX-License-Identifier: BSD-3-Clause
// Units that LAMMPS names in its dumps (dump_modify units yes): a doubt where they are not SI.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "readers/tokens.hpp"

namespace bedscope::readers {

/// How units_problem() begins.
inline constexpr std::string_view units_said = "units ";

/// What is to be said of a dump of these units; empty where it names none, or SI. Only said, not
/// refused or converted: "lj", the default, often stands over numbers that are meant as SI.
inline std::string units_problem(std::string_view units) {
  const auto style = next_word(units);
  if (style.empty() || style == "si") return {};
  return fmt::format("{}{}: all numbers are taken as SI", units_said, style);
}

}  // namespace bedscope::readers
