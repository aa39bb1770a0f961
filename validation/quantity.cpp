// SPDX-License-Identifier: BSD-3-Clause
#include "validation/quantity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "readers/error.hpp"
#include "readers/toml_table.hpp"
#include "validation/quantity_parts.hpp"

namespace bedscope::validation {

std::set<std::string> place_keys(std::string_view quantity) {
  std::set<std::string> keys;
  const bool is_local = quantity.starts_with("local");
  if (is_local || quantity.starts_with("lateral")) keys.insert("height");
  if (is_local) keys.insert("x");
  if (quantity.starts_with("probe")) keys.insert("probe");
  if (!quantity.ends_with(" history")) keys.insert("time");
  return keys;
}

void require_place_keys(const Place& place, const std::set<std::string>& others) {
  auto known = place_keys(place.quantity);
  known.insert(others.begin(), others.end());
  for (const auto& [key, value] : place.at)
    if (!known.contains(key))
      throw InputError("unknown key at.{} of {}; expected {}{}", key, place.quantity,
                       known.empty() ? "none" : "at.", fmt::join(known, ", at."));
}

namespace {

constexpr std::array all_quantities{
    NamedQuantity{"axial holdup", "-", "holdup [-] of axial_profile.csv", axial_holdup},
    NamedQuantity{"axial velocity", "m/s", "velocity_z [m/s] of axial_profile.csv", axial_velocity},
    NamedQuantity{"axial mass flux", "kg/m2/s", "mass_flux_z [kg/m2/s] of axial_profile.csv",
                  axial_mass_flux},
    NamedQuantity{"axial temperature", "K", "temperature [K] of temperature_axial.csv",
                  axial_temperature},
    NamedQuantity{"axial voidage", "-", "voidage [-] of gas_axial.csv", axial_voidage},
    NamedQuantity{"axial gas velocity", "m/s", "velocity_z [m/s] of gas_axial.csv",
                  axial_gas_velocity},
    NamedQuantity{"axial gas temperature", "K", "temperature [K] of gas_axial.csv",
                  axial_gas_temperature},
    NamedQuantity{"axial pressure", "Pa", "pressure [Pa] of gas_axial.csv", axial_pressure},
    NamedQuantity{"axial slip velocity", "m/s", "slip_z [m/s] of gas_axial.csv",
                  axial_slip_velocity},
    NamedQuantity{"axial bubble diameter", "m", "diameter [m] of bubble_profile.csv",
                  axial_bubble_diameter},
    NamedQuantity{"axial bubble velocity", "m/s", "velocity_z [m/s] of bubble_profile.csv",
                  axial_bubble_velocity},
    NamedQuantity{"axial bubble frequency", "1/s", "frequency [1/s] of bubble_profile.csv",
                  axial_bubble_frequency},
    NamedQuantity{"axial bubble fraction", "-", "area_fraction [-] of bubble_profile.csv",
                  axial_bubble_fraction},
    NamedQuantity{"lateral holdup", "-", "holdup [-] of lateral_profile.csv", lateral_holdup},
    NamedQuantity{"lateral velocity", "m/s", "velocity_z [m/s] of lateral_profile.csv",
                  lateral_velocity},
    NamedQuantity{"lateral mass flux", "kg/m2/s", "mass_flux_z [kg/m2/s] of lateral_profile.csv",
                  lateral_mass_flux},
    NamedQuantity{"lateral voidage", "-", "voidage [-] of gas_lateral.csv", lateral_voidage},
    NamedQuantity{"lateral gas velocity", "m/s", "velocity_z [m/s] of gas_lateral.csv",
                  lateral_gas_velocity},
    NamedQuantity{"lateral gas temperature", "K", "temperature [K] of gas_lateral.csv",
                  lateral_gas_temperature},
    NamedQuantity{"lateral pressure", "Pa", "pressure [Pa] of gas_lateral.csv", lateral_pressure},
    NamedQuantity{"lateral slip velocity", "m/s", "slip_z [m/s] of gas_lateral.csv",
                  lateral_slip_velocity},
    NamedQuantity{"local holdup", "-", "holdup [-] of lateral_profile.csv", local_holdup},
    NamedQuantity{"local voidage", "-", "voidage [-] of gas_lateral.csv", local_voidage},
    NamedQuantity{"occurrence", "-", "clusters of cluster_occurrence.csv", occurrence},
    NamedQuantity{"cluster holdup", "-", "holdup [-] of clusters.csv", cluster_holdup},
    NamedQuantity{"cluster velocity", "m/s", "velocity_z [m/s] of clusters.csv", cluster_velocity},
    NamedQuantity{"cluster position", "-", "x [m] of clusters.csv", cluster_position},
    NamedQuantity{"mean holdup", "-", "holdup [-] of inventory.csv", mean_holdup},
    NamedQuantity{"inventory", "kg", "solids_mass [kg] of inventory.csv", inventory},
    NamedQuantity{"inventory history", "kg", "solids_mass [kg] of inventory.csv",
                  inventory_history},
    NamedQuantity{"mean temperature", "K", "mean [K] of temperature.csv", mean_temperature},
    NamedQuantity{"temperature spread", "K", "std [K] of temperature.csv", temperature_spread},
    NamedQuantity{"temperature pdf", "-", "probability_density [-] of temperature_pdf.csv",
                  temperature_pdf},
    NamedQuantity{"temperature history", "K", "mean [K] of temperature.csv", temperature_history},
    NamedQuantity{"pressure drop", "Pa", "pressure_drop [Pa] of pressure_drop.csv", pressure_drop},
    NamedQuantity{"pressure drop deviation", "Pa", "pressure_drop [Pa] of pressure_drop.csv",
                  pressure_drop_deviation},
    NamedQuantity{"pressure drop frequency", "Hz", "pressure_drop [Pa] of pressure_drop.csv",
                  pressure_drop_frequency},
    NamedQuantity{"pressure drop history", "Pa", "pressure_drop [Pa] of pressure_drop.csv",
                  pressure_drop_history},
    NamedQuantity{"probe pressure deviation", "Pa", "", probe_pressure_deviation},
    NamedQuantity{"probe pressure frequency", "Hz", "", probe_pressure_frequency},
    NamedQuantity{"bed height", "m", "height_surface [m] of bed_height.csv", bed_height},
    NamedQuantity{"bed height deviation", "m", "height_surface [m] of bed_height.csv",
                  bed_height_deviation},
    NamedQuantity{"bed height frequency", "Hz", "height_surface [m] of bed_height.csv",
                  bed_height_frequency},
    NamedQuantity{"bed height history", "m", "height_surface [m] of bed_height.csv",
                  bed_height_history},
    NamedQuantity{"bed voidage", "-", "", bed_voidage},
    NamedQuantity{"bubble number", "-", "", bubble_number},
    NamedQuantity{"bubble diameter", "m", "diameter [m] of bubbles.csv", bubble_diameter},
    NamedQuantity{"bubble velocity", "m/s", "velocity_z [m/s] of bubbles.csv", bubble_velocity},
};

constexpr std::string_view series_prefix = "series: ", series_suffix = " history";

const NamedQuantity& find_quantity(const std::string& name) {
  const auto quantity = std::find_if(all_quantities.begin(), all_quantities.end(),
                                     [&](const auto& q) { return q.name == name; });
  if (quantity != all_quantities.end()) return *quantity;
  std::set<std::string> names;
  for (const auto& each : all_quantities) names.emplace(each.name);
  throw InputError("no quantity \"{}\"; the nearest known one is \"{}\"", name,
                   readers::nearest_name(name, names));
}

Sampled of_table(const analysis::RunResult& run, const Place& place) {
  const auto& quantity = find_quantity(place.quantity);
  auto sampled = quantity.of(run, place);
  sampled.y = {std::string(quantity.name), std::string(quantity.unit)};
  return sampled;
}

/// A run has none: what would hold it, or why the one that it has does not do.
[[noreturn]] void fail_without(const analysis::RunResult& run, const Place& place,
                               const Sampled& sampled) {
  const auto from = is_series(place.quantity) ? "" : find_quantity(place.quantity).from;
  throw InputError("run \"{}\": it has no {}{}{}{}", run.label, place.quantity,
                   place.species == "all" ? "" : " of species " + place.species,
                   from.empty() ? "" : fmt::format(" ({})", from),
                   sampled.notes.empty() ? "" : ": " + sampled.notes.front());
}

Sampled of_series(const analysis::RunResult& run, const Place& place) {
  std::string_view name = place.quantity;
  name.remove_prefix(series_prefix.size());
  const bool whole = name.ends_with(series_suffix);
  if (whole) name.remove_suffix(series_suffix.size());
  const auto signal = std::find_if(run.series.begin(), run.series.end(),
                                   [&](const auto& each) { return each.name == name; });
  if (signal == run.series.end()) {
    std::vector<std::string> names;
    for (const auto& each : run.series) names.push_back(each.name);
    throw InputError("run \"{}\": no series \"{}\" in its series.csv, which has {}", run.label,
                     name, names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")));
  }
  auto sampled = whole ? series_history(*signal) : series_mean(run, *signal);
  sampled.y = {signal->name, signal->unit};
  return sampled;
}

}  // namespace

std::span<const NamedQuantity> quantities() { return all_quantities; }

bool is_series(std::string_view quantity) { return quantity.starts_with(series_prefix); }

Sampled sample(const analysis::RunResult& run, const Place& place) {
  auto sampled = is_series(place.quantity) ? of_series(run, place) : of_table(run, place);
  if (std::none_of(sampled.value.begin(), sampled.value.end(),
                   [](double value) { return std::isfinite(value); })) {
    if (sampled.unseen.empty()) fail_without(run, place, sampled);
    return sampled;
  }
  if (std::isfinite(run.window.to - run.window.from) && !sampled.x.is_time())
    sampled.duration = run.window.to - run.window.from;
  return sampled;
}

Curve as_curve(const Sampled& sampled, const std::string& name) {
  if (!sampled.unseen.empty()) throw InputError("{}: {}", name, sampled.unseen);
  Curve curve{.name = name, .x = sampled.x, .y = sampled.y};
  for (std::size_t i = 0; i < sampled.at.size(); ++i)
    if (std::isfinite(sampled.value[i]) && std::isfinite(sampled.u[i]))
      curve.points.push_back({sampled.at[i], sampled.value[i], 0, sampled.u[i]});
  const auto without =
      std::count_if(sampled.u.begin(), sampled.u.end(), [](double u) { return std::isnan(u); });
  if (without > 0)
    curve.assumptions.push_back(
        fmt::format("{}: {} points without an interval left out", name, without));
  if (!sampled.error_known)
    curve.assumptions.push_back(name + ": has no intervals; taken as exact");
  return curve;
}

}  // namespace bedscope::validation
