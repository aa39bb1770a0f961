// SPDX-License-Identifier: BSD-3-Clause
// References out of physics/: closed forms with the parameters that a check gives.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/result.hpp"
#include "validation/compare.hpp"

namespace bedscope::validation {

struct NamedTheory {
  std::string_view name, unit;
  std::vector<std::string_view> needed, optional;  ///< its parameters, SI
  std::string_view source, limits;
};

/// All, by name.
std::vector<NamedTheory> theories();

/// Throws InputError where there is no such theory, or a parameter is missing or unknown.
void require_theory(const std::string& name, const std::map<std::string, double>& with);

/// The curve of a theory at the abscissae of `result`. `with`: its parameters (SI), by name.
/// Throws InputError: no such theory (names the nearest), a parameter that is missing or unknown, a
/// theory of another quantity.
Curve theory_curve(const std::string& name, const std::map<std::string, double>& with,
                   const analysis::RunResult& run, const Sampled& result);

}  // namespace bedscope::validation
