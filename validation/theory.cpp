// SPDX-License-Identifier: BSD-3-Clause
#include "validation/theory.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "readers/error.hpp"
#include "readers/toml_table.hpp"
#include "validation/theory_parts.hpp"

namespace bedscope::validation {
namespace {

using analysis::RunResult;

/// By name.
const std::vector<Theory>& all_theories() {
  static const auto all = [] {
    auto theories = theories_of_beds();
    for (auto& theory : theories_of_closures()) theories.push_back(std::move(theory));
    std::ranges::sort(theories, {}, &Theory::name);
    return theories;
  }();
  return all;
}

const Theory& find_theory(const std::string& name) {
  std::set<std::string> names;
  for (const auto& theory : all_theories()) {
    if (theory.name == name) return theory;
    names.emplace(theory.name);
  }
  throw InputError("no theory \"{}\"; the nearest known one is \"{}\"", name,
                   readers::nearest_name(name, names));
}

void require_parameters(const Theory& theory, const std::map<std::string, double>& with) {
  std::set<std::string> known;
  for (const auto name : theory.needed) {
    known.emplace(name);
    if (!with.contains(std::string(name)))
      throw InputError("theory \"{}\": with.{} is missing; it needs {}", theory.name, name,
                       fmt::join(theory.needed, ", "));
  }
  for (const auto name : theory.optional) known.emplace(name);
  for (const auto& [name, value] : with)
    if (!known.contains(name))
      throw InputError("theory \"{}\": unknown key with.{}; the nearest known one is with.{}",
                       theory.name, name, readers::nearest_name(name, known));
}

}  // namespace

std::vector<NamedTheory> theories() {
  std::vector<NamedTheory> named;
  for (const auto& theory : all_theories()) named.push_back(theory);
  return named;
}

void require_theory(const std::string& name, const std::map<std::string, double>& with) {
  require_parameters(find_theory(name), with);
}

Curve theory_curve(const std::string& name, const std::map<std::string, double>& with,
                   const RunResult& run, const Sampled& result) {
  const auto& theory = find_theory(name);
  require_parameters(theory, with);
  if (theory.unit != result.y.unit)
    throw InputError("theory \"{}\": gives {}, {} is in {}", name, theory.unit, result.y.name,
                     result.y.unit);
  Curve curve{.name = "theory " + name, .x = result.x, .y = result.y};
  curve.about.citation = theory.source;
  curve.about.caveats.emplace_back(theory.limits);
  curve.about.kind = "theory";
  const Parameters parameters(with);
  try {
    for (const double x : result.at) curve.points.push_back({x, theory.value(parameters, run, x)});
  } catch (const std::domain_error& error) {
    throw InputError("theory \"{}\": {}", name, error.what());
  }
  return curve;
}

}  // namespace bedscope::validation
