// SPDX-License-Identifier: BSD-3-Clause
// Quantities along the height and across the bed.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "readers/error.hpp"
#include "validation/quantity_parts.hpp"

namespace bedscope::validation {

using analysis::Estimate;
using analysis::RunResult;

Sampled along(const char* axis, const char* unit, const std::vector<double>& at,
              const std::vector<Estimate>& estimates) {
  Sampled sampled{.x = {axis, unit}, .error_known = false};
  if (estimates.size() != at.size()) return sampled;  // a run without it
  sampled.at = at;
  for (const auto& estimate : estimates) {
    sampled.value.push_back(estimate.value);
    sampled.u.push_back(estimate.ci95 / coverage_factor);
    sampled.error_known = sampled.error_known || std::isfinite(estimate.ci95);
  }
  if (!sampled.error_known) sampled.u.assign(sampled.u.size(), 0);
  return sampled;
}

const analysis::SpeciesResult& species_of(const RunResult& run, const Place& place) {
  for (const auto& species : run.species)
    if (species.type == place.species) return species;
  static const analysis::SpeciesResult none;
  if (run.types.empty()) return none;
  throw InputError("run \"{}\": {}: no species \"{}\", there are {}", run.label, place.quantity,
                   place.species, fmt::join(run.types, ", "));
}

namespace {

double needed(const RunResult& run, const Place& place, const char* key) {
  const auto found = place.at.find(key);
  if (found == place.at.end())
    throw InputError("run \"{}\": {}: expected at = {{ height = ..., x = ... }} [m]", run.label,
                     place.quantity);
  return found->second;
}

/// A profile's value at one place of it, interpolated linearly between its own.
Sampled value_at(const RunResult& run, const Place& place, const Sampled& profile) {
  const double x = needed(run, place, "x");
  Curve there{.name = place.quantity, .x = profile.x, .y = profile.y, .points = {{x, 0}}};
  const auto found = compare(profile, there).points.front();
  return {.at = {0},
          .value = {found.result},
          .u = {std::hypot(found.u_result, found.u_interpolation)},
          .error_known = profile.error_known,
          .is_scalar = true};
}

std::size_t height_of(const RunResult& run, const Place& place) {
  const auto wanted = place.at.find("height");
  if (wanted == place.at.end())
    throw InputError("run \"{}\": {}: expected at = {{ height = ... }} [m]", run.label,
                     place.quantity);
  const double rounding = 1e-6 * std::abs(wanted->second);
  const double tolerance = std::isfinite(run.band) ? std::max(run.band / 2, rounding) : rounding;
  std::size_t nearest = 0;
  for (std::size_t h = 1; h < run.heights.size(); ++h)
    if (std::abs(run.heights[h] - wanted->second) < std::abs(run.heights[nearest] - wanted->second))
      nearest = h;
  if (run.heights.empty() || std::abs(run.heights[nearest] - wanted->second) > tolerance)
    throw InputError("run \"{}\": {}: no profile at {} m, there are {} m", run.label,
                     place.quantity, wanted->second, fmt::join(run.heights, ", "));
  return nearest;
}

bool any_known(const std::vector<Estimate>& estimates) {
  return std::any_of(estimates.begin(), estimates.end(),
                     [](const Estimate& e) { return std::isfinite(e.value); });
}

Sampled axial(const RunResult& run, const Place& place,
              std::vector<Estimate> analysis::Profile::*part) {
  const auto& profile = species_of(run, place).axial;
  return along("z", "m", profile.coordinate, profile.*part);
}

Sampled lateral(const RunResult& run, const Place& place,
                std::vector<Estimate> analysis::Profile::*part) {
  const auto& profiles = species_of(run, place).lateral;
  if (profiles.empty() && place.at.contains("height")) return {};
  const auto h = height_of(run, place);
  if (h >= profiles.size()) return {};
  return along("x", "m", profiles[h].coordinate, profiles[h].*part);
}

Sampled axial_gas(const RunResult& run, std::vector<Estimate> analysis::GasProfile::*part) {
  return along("z", "m", run.gas.axial.coordinate, run.gas.axial.*part);
}

Sampled lateral_gas(const RunResult& run, const Place& place,
                    std::vector<Estimate> analysis::GasProfile::*part) {
  const auto h = height_of(run, place);
  if (h >= run.gas.lateral.size()) return {};
  return along("x", "m", run.gas.lateral[h].coordinate, run.gas.lateral[h].*part);
}

/// Of the gas where the run has it, else what the solids leave.
Sampled or_of_solids(Sampled gas, const Sampled& solids) {
  if (std::any_of(gas.value.begin(), gas.value.end(), [](double v) { return std::isfinite(v); }))
    return gas;
  gas = solids;
  for (double& value : gas.value) value = 1 - value;
  return gas;
}

Sampled bands(const RunResult& run, Estimate analysis::BubbleBand::*part) {
  std::vector<double> at;
  std::vector<Estimate> estimates;
  if (run.bubbles)
    for (const auto& band : run.bubbles->bands) {
      at.push_back(band.height);
      estimates.push_back(band.*part);
    }
  return along("z", "m", at, estimates);
}

}  // namespace

Sampled axial_holdup(const RunResult& run, const Place& place) {
  return axial(run, place, &analysis::Profile::holdup);
}
Sampled axial_velocity(const RunResult& run, const Place& place) {
  return axial(run, place, &analysis::Profile::velocity_z);
}
Sampled axial_mass_flux(const RunResult& run, const Place& place) {
  return axial(run, place, &analysis::Profile::mass_flux_z);
}

Sampled axial_temperature(const RunResult& run, const Place& place) {
  const auto& species = species_of(run, place);
  if (any_known(species.axial_temperature) || place.species != "all")
    return along("z", "m", species.axial.coordinate, species.axial_temperature);
  auto gas = axial_gas_temperature(run, place);
  gas.notes.push_back("run \"" + run.label +
                      "\": axial temperature is that of the gas: it has none of the solids");
  return gas;
}

Sampled axial_voidage(const RunResult& run, const Place& place) {
  return or_of_solids(axial_gas(run, &analysis::GasProfile::voidage), axial_holdup(run, place));
}
Sampled axial_gas_velocity(const RunResult& run, const Place&) {
  return axial_gas(run, &analysis::GasProfile::velocity_z);
}
Sampled axial_gas_temperature(const RunResult& run, const Place&) {
  return axial_gas(run, &analysis::GasProfile::temperature);
}
Sampled axial_pressure(const RunResult& run, const Place&) {
  return axial_gas(run, &analysis::GasProfile::pressure);
}
Sampled axial_slip_velocity(const RunResult& run, const Place&) {
  return axial_gas(run, &analysis::GasProfile::slip_z);
}
Sampled axial_bubble_diameter(const RunResult& run, const Place&) {
  return bands(run, &analysis::BubbleBand::diameter);
}
Sampled axial_bubble_velocity(const RunResult& run, const Place&) {
  return bands(run, &analysis::BubbleBand::velocity);
}
Sampled axial_bubble_frequency(const RunResult& run, const Place&) {
  return bands(run, &analysis::BubbleBand::frequency);
}
Sampled axial_bubble_fraction(const RunResult& run, const Place&) {
  return bands(run, &analysis::BubbleBand::area_fraction);
}

Sampled lateral_holdup(const RunResult& run, const Place& place) {
  return lateral(run, place, &analysis::Profile::holdup);
}
Sampled lateral_velocity(const RunResult& run, const Place& place) {
  return lateral(run, place, &analysis::Profile::velocity_z);
}
Sampled lateral_mass_flux(const RunResult& run, const Place& place) {
  return lateral(run, place, &analysis::Profile::mass_flux_z);
}
Sampled lateral_voidage(const RunResult& run, const Place& place) {
  return or_of_solids(lateral_gas(run, place, &analysis::GasProfile::voidage),
                      lateral_holdup(run, place));
}
Sampled local_holdup(const RunResult& run, const Place& place) {
  return value_at(run, place, lateral_holdup(run, place));
}
Sampled local_voidage(const RunResult& run, const Place& place) {
  return value_at(run, place, lateral_voidage(run, place));
}
Sampled lateral_gas_velocity(const RunResult& run, const Place& place) {
  return lateral_gas(run, place, &analysis::GasProfile::velocity_z);
}
Sampled lateral_gas_temperature(const RunResult& run, const Place& place) {
  return lateral_gas(run, place, &analysis::GasProfile::temperature);
}
Sampled lateral_pressure(const RunResult& run, const Place& place) {
  return lateral_gas(run, place, &analysis::GasProfile::pressure);
}
Sampled lateral_slip_velocity(const RunResult& run, const Place& place) {
  return lateral_gas(run, place, &analysis::GasProfile::slip_z);
}

}  // namespace bedscope::validation
