// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/gas_setup.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <set>

#include "readers/error.hpp"

namespace bedscope::analysis {
namespace {

/// Names of solid phases in Euler-Euler and parcel cases.
constexpr std::array<std::string_view, 9> solid_phases{
    "particles", "particle", "solids", "solid", "sand", "granular", "powder", "s", "p"};

class FieldFinder {
 public:
  FieldFinder(const std::string& label, const GasSettings& settings,
              const readers::GasSeries& series)
      : label_(label), settings_(settings), series_(series) {
    for (std::size_t t = 0; t < series.times().size(); ++t)
      names_.insert(series.fields_at(t).begin(), series.fields_at(t).end());
  }

  GasFieldNames find() const {
    GasFieldNames found;
    voidage(found);
    const auto& of = found.voidage.empty() ? found.solids : found.voidage;
    const auto phase = found.voidage.empty() ? std::string{} : phase_of(of);
    found.velocity = named("velocity", settings_.fields.velocity);
    if (found.velocity.empty())
      found.velocity = first({phase.empty() ? "U" : "U." + phase, "U", "U.air", "U.gas"});
    found.temperature = named("temperature", settings_.fields.temperature);
    if (found.temperature.empty())
      found.temperature = first({phase.empty() ? "T" : "T." + phase, "T", "T.air", "T.gas"});
    found.pressure = named("pressure", settings_.fields.pressure);
    if (found.pressure.empty()) found.pressure = first({"p", "p_rgh"});
    return found;
  }

 private:
  static std::string phase_of(const std::string& field) {
    const auto dot = field.find('.');
    return dot == std::string::npos ? "" : field.substr(dot + 1);
  }

  /// What the study names must be there.
  std::string named(std::string_view key, const std::string& name) const {
    if (!name.empty() && !names_.contains(name))
      throw InputError("run \"{}\": gas.{}: expected a field of {} ({}), found \"{}\"", label_, key,
                       series_.path(), fmt::join(names_, ", "), name);
    return name;
  }

  std::string first(std::initializer_list<std::string> candidates) const {
    for (const auto& name : candidates)
      if (names_.contains(name)) return name;
    return {};
  }

  void voidage(GasFieldNames& found) const {
    found.voidage = named("voidage", settings_.fields.voidage);
    if (!found.voidage.empty()) return;
    found.solids = named("solids", settings_.fields.solids);
    if (!found.solids.empty()) return;
    found.voidage = first({"voidfraction", "alpha.air", "alpha.gas"});
    if (!found.voidage.empty()) return;
    std::vector<std::string> solids, others;
    for (const auto& name : names_) {
      const auto phase = phase_of(name);
      if (name != "alpha." + phase || phase.find_first_of(".(:") != std::string::npos) continue;
      const bool solid =
          std::find(solid_phases.begin(), solid_phases.end(), phase) != solid_phases.end();
      (solid ? solids : others).push_back(name);
    }
    if (others.size() == 1 && solids.size() == 1) {
      found.voidage = others.front();
    } else if (others.empty() && solids.size() == 1) {
      found.solids = solids.front();
    } else {
      throw InputError(
          "run \"{}\": gas: no voidage in {}: expected voidfraction, alpha.air or alpha.gas, found "
          "{}; [gas] voidage = \"...\" (or solids = \"...\") names it",
          label_, series_.path(), fmt::join(names_, ", "));
    }
  }

  const std::string& label_;
  const GasSettings& settings_;
  const readers::GasSeries& series_;
  std::set<std::string> names_;
};

std::array<std::string, 4> all_of(const GasFieldNames& fields) {
  return {fields.voidage.empty() ? fields.solids : fields.voidage, fields.velocity, fields.pressure,
          fields.temperature};
}

void find_unit_of_pressure(const std::string& label, const GasSettings& settings,
                           const readers::GasSeries& series, GasSetup& setup) {
  auto& name = setup.fields.pressure;
  std::size_t time = 0;
  while (time < setup.times && !series.has(time, name)) ++time;
  if (name.empty() || time == setup.times) {
    setup.problems.emplace_back("gas: no pressure (p, p_rgh): pressures are nan");
    return name.clear();
  }
  readers::FieldValues values;
  series.read(time, name, 1, values);
  const auto& power = values.dimensions;
  const auto is = [&](double mass, double length) {
    return power[0] == mass && power[1] == length && power[2] == -2;
  };
  if (!values.dimensions_known && settings.density) {
    setup.pressure_factor = *settings.density;
    setup.problems.push_back(fmt::format(
        "gas: {} has no dimensions: taken as p/rho [m2/s2], as gas_density is given", name));
  } else if (!values.dimensions_known) {
    setup.problems.push_back(fmt::format(
        "gas: {} has no dimensions: taken as Pa; gas_density makes it p/rho [m2/s2]", name));
  } else if (is(0, 2)) {
    if (settings.density) {
      setup.pressure_factor = *settings.density;
      return;
    }
    setup.problems.push_back(fmt::format(
        "gas: {} is p/rho [m2/s2] and gas_density is missing: pressures are nan", name));
    name.clear();
  } else if (!is(1, -1)) {
    throw InputError(
        "run \"{}\": gas: {} at time {}: expected a pressure, [1 -1 -2 ...] or [0 2 -2 ...], found "
        "[{}]",
        label, name, series.times()[time].name, fmt::join(power, " "));
  }
}

}  // namespace

GasSetup set_up_gas(const std::string& label, const GasSettings& settings,
                    const readers::GasSeries& series) {
  GasSetup setup;
  setup.fields = FieldFinder(label, settings, series).find();
  setup.times = series.times().size();
  // Fields are written one after the other: the last time of a run that goes on may lack some.
  const auto last = setup.times - 1;
  for (const auto& name : all_of(setup.fields)) {
    if (last == 0 || name.empty() || series.has(last, name) || !series.has(last - 1, name))
      continue;
    setup.problems.push_back(fmt::format("gas: time {} is left out: {} is not there (yet)",
                                         series.times()[last].name, name));
    setup.times = last;
    break;
  }
  find_unit_of_pressure(label, settings, series, setup);
  if (setup.fields.velocity.empty())
    setup.problems.emplace_back("gas: no velocity (U, U.air, U.gas): velocities are nan");
  return setup;
}

}  // namespace bedscope::analysis
