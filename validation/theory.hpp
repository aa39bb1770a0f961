// SPDX-License-Identifier: BSD-3-Clause
// References out of physics/: closed forms with the parameters that a check gives.
#pragma once

#include <map>
#include <string>

#include "analysis/result.hpp"
#include "validation/compare.hpp"

namespace bedscope::validation {

/// The curve of a theory at the abscissae of `result`. `with`: its parameters (SI), by name.
/// Throws InputError: no such theory (names the nearest), a parameter that is missing or unknown, a
/// theory of another quantity.
Curve theory_curve(const std::string& name, const std::map<std::string, double>& with,
                   const analysis::RunResult& run, const Sampled& result);

}  // namespace bedscope::validation
