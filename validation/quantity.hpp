// SPDX-License-Identifier: BSD-3-Clause
// The quantities of a run that can be judged, by the names that a study uses.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "analysis/result.hpp"
#include "validation/compare.hpp"

namespace bedscope::validation {

/// What of which run, and where.
struct Place {
  std::string quantity;              ///< "lateral holdup"
  std::map<std::string, double> at;  ///< height [m], of lateral profiles; x [m]; time [s],
                                     ///< of an instant; probe, from 1
  std::string species = "all";
};

/// The keys of `at` that a quantity knows; others can only be parameters of a curve.
std::set<std::string> place_keys(std::string_view quantity);

/// Throws InputError naming those that can be, where a key of `at` is neither among those of the
/// quantity nor one of `others`.
void require_place_keys(const Place& place, const std::set<std::string>& others = {});

/// `of` gives the values of a run; `from` names the column and the table that hold them, for people
/// whose run lacks it; a new quantity is a line of the table in quantity.cpp.
struct NamedQuantity {
  std::string_view name, unit, from;
  Sampled (*of)(const analysis::RunResult& run, const Place& place) = nullptr;
};

std::span<const NamedQuantity> quantities();

/// "series: NAME" and "series: NAME history" are quantities, too: of the run's series of that name.
bool is_series(std::string_view quantity);

/// The quantity of a run with its standard errors (half-widths of 95 % intervals / 1.96; nan at a
/// point that has none; 0 and `error_known` false where the run has none at all). Profiles along z
/// or x [m], histories along time [s], distributions along their own abscissa, single values at 0.
/// Throws InputError: no such quantity (names the nearest), no such species or height in the run
/// (lists what there is), no value (names the table that would hold it). A run that looked for
/// clusters or bubbles and saw none gives `unseen`.
Sampled sample(const analysis::RunResult& run, const Place& place);

/// The same as a reference for another run.
Curve as_curve(const Sampled& sampled, const std::string& name);

}  // namespace bedscope::validation
