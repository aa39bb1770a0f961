// SPDX-License-Identifier: BSD-3-Clause
#include "validation/quantity.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

#include "analysis/statistics.hpp"
#include "readers/error.hpp"
#include "readers/toml_table.hpp"

namespace bedscope::validation {
namespace {

using analysis::Estimate;
using analysis::RunResult;

constexpr double coverage_factor = 1.96;
constexpr int distribution_bins = 20;

constexpr std::array all_quantities{
    NamedQuantity{"axial holdup", "-", true},
    NamedQuantity{"axial velocity", "m/s", true},
    NamedQuantity{"axial mass flux", "kg/m2/s", true},
    NamedQuantity{"lateral holdup", "-", true, true},
    NamedQuantity{"lateral velocity", "m/s", true, true},
    NamedQuantity{"lateral mass flux", "kg/m2/s", true, true},
    NamedQuantity{"occurrence", "-"},
    NamedQuantity{"cluster holdup", "-"},
    NamedQuantity{"cluster velocity", "m/s"},
    NamedQuantity{"cluster position", "-", true},
    NamedQuantity{"mean holdup", "-"},
    NamedQuantity{"inventory", "kg"},
    NamedQuantity{"mean temperature", "K"},
    NamedQuantity{"temperature spread", "K"},
    NamedQuantity{"temperature pdf", "-", true},
};

Sampled single(const Estimate& estimate, const NamedQuantity& quantity) {
  Sampled sampled{.y = {std::string(quantity.name), std::string(quantity.unit)}, .is_scalar = true};
  sampled.at = {0};
  sampled.value = {estimate.value};
  sampled.error_known = std::isfinite(estimate.ci95);
  sampled.u = {sampled.error_known ? estimate.ci95 / coverage_factor : 0};
  return sampled;
}

Sampled along(const std::vector<double>& at, const std::vector<Estimate>& estimates,
              const NamedQuantity& quantity, const char* axis) {
  Sampled sampled{.x = {axis, "m"}, .y = {std::string(quantity.name), std::string(quantity.unit)}};
  sampled.at = at;
  sampled.error_known = false;
  for (const auto& estimate : estimates) {
    sampled.value.push_back(estimate.value);
    sampled.u.push_back(std::isfinite(estimate.ci95) ? estimate.ci95 / coverage_factor : 0);
    sampled.error_known = sampled.error_known || std::isfinite(estimate.ci95);
  }
  return sampled;
}

const std::vector<Estimate>& part_of(const analysis::Profile& profile, std::string_view name) {
  if (name.ends_with("holdup")) return profile.holdup;
  return name.ends_with("velocity") ? profile.velocity_z : profile.mass_flux_z;
}

const analysis::SpeciesResult& species_of(const RunResult& run, const Place& place) {
  for (const auto& species : run.species)
    if (species.type == place.species) return species;
  throw InputError("run \"{}\": {}: no species \"{}\", there are {}", run.label, place.quantity,
                   place.species, fmt::join(run.types, ", "));
}

std::size_t height_of(const RunResult& run, const Place& place) {
  const auto wanted = place.at.find("height");
  if (wanted == place.at.end())
    throw InputError("run \"{}\": {}: expected at = {{ height = ... }} [m]", run.label,
                     place.quantity);
  const double tolerance = std::max(run.band / 2, 1e-6 * std::abs(wanted->second));
  std::size_t nearest = 0;
  for (std::size_t h = 1; h < run.heights.size(); ++h)
    if (std::abs(run.heights[h] - wanted->second) < std::abs(run.heights[nearest] - wanted->second))
      nearest = h;
  if (run.heights.empty() || std::abs(run.heights[nearest] - wanted->second) > tolerance)
    throw InputError("run \"{}\": {}: no profile at {} m, there are {} m", run.label,
                     place.quantity, wanted->second, fmt::join(run.heights, ", "));
  return nearest;
}

bool in_window(const RunResult& run, double time) {
  return run.window.snapshots == 0 || (time >= run.window.from && time <= run.window.to);
}

/// Mean over the snapshots of the window of something that each of them has.
Estimate mean_of(const std::vector<double>& values) {
  const std::vector<double> weights(values.size(), 1);
  return analysis::estimate_mean(values, weights).estimate();
}

/// A property of clusters averaged over them; each snapshot's clusters count as one sample, so that
/// the interval takes their correlation in time into account.
Estimate cluster_mean(const RunResult& run, double analysis::Cluster::*property) {
  std::vector<double> sum(run.occurrence.size()), count(run.occurrence.size());
  for (const auto& cluster : run.clusters) {
    if (cluster.snapshot >= sum.size() || !std::isfinite(cluster.*property)) continue;
    sum[cluster.snapshot] += cluster.*property;
    count[cluster.snapshot] += 1;
  }
  std::vector<double> numerator, denominator;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (!in_window(run, run.occurrence[i].time)) continue;
    numerator.push_back(sum[i]);
    denominator.push_back(count[i]);
  }
  const std::vector<double> weights(numerator.size(), 1);
  return analysis::estimate_ratio(numerator, denominator, weights);
}

/// Probability density of the clusters' lateral places in the domain, 0 to 1, with the errors of
/// counts (Poisson).
Sampled cluster_positions(const RunResult& run, const NamedQuantity& quantity) {
  Sampled sampled{.x = {"x over width", "-"},
                  .y = {std::string(quantity.name), std::string(quantity.unit)},
                  .is_distribution = true};
  std::vector<double> counts(distribution_bins);
  const double low = run.grid.min[0], width = run.grid.max[0] - low;
  for (const auto& cluster : run.clusters) {
    const double share = (cluster.centre.x - low) / width;
    if (!(share >= 0 && share <= 1)) continue;
    counts[static_cast<std::size_t>(
        std::min<double>(share * distribution_bins, distribution_bins - 1))] += 1;
  }
  const double all = std::accumulate(counts.begin(), counts.end(), 0.);
  if (all == 0) return sampled;
  for (int k = 0; k < distribution_bins; ++k) {
    sampled.at.push_back((k + .5) / distribution_bins);
    sampled.value.push_back(counts[k] / all * distribution_bins);
    sampled.u.push_back(std::sqrt(counts[k] + 1) / all * distribution_bins);
  }
  return sampled;
}

Estimate temperature_of(const RunResult& run, const Place& place,
                        double analysis::TemperatureSample::*part) {
  std::vector<double> values;
  for (const auto& sample : run.temperature)
    if (sample.type == place.species && in_window(run, sample.time) && std::isfinite(sample.*part))
      values.push_back(sample.*part);
  return mean_of(values);
}

Sampled temperature_pdf(const RunResult& run, const Place& place, const NamedQuantity& quantity) {
  const auto& pdf = species_of(run, place).temperature_pdf;
  Sampled sampled{.x = {"bin_centre", "-"},
                  .y = {std::string(quantity.name), std::string(quantity.unit)},
                  .error_known = false,
                  .is_distribution = true};
  for (std::size_t k = 0; k < pdf.size(); ++k) {
    sampled.at.push_back((static_cast<double>(k) + .5) / static_cast<double>(pdf.size()));
    sampled.value.push_back(pdf[k]);
    sampled.u.push_back(0);
  }
  return sampled;
}

Estimate occurrence_of(const RunResult& run) {
  if (std::isfinite(run.mean_occurrence.value)) return run.mean_occurrence;
  std::vector<double> values;
  for (const auto& sample : run.occurrence) values.push_back(sample.clusters);
  return mean_of(values);
}

/// Of the result, or from the tables of one: the mean of what inventory.csv has.
Estimate inventory_mean(const RunResult& run, const Place& place, const Estimate& known,
                        double analysis::InventorySample::*part) {
  if (place.species == "all" && std::isfinite(known.value)) return known;
  std::vector<double> values;
  for (const auto& sample : run.inventory)
    if (sample.type == place.species && in_window(run, sample.time)) values.push_back(sample.*part);
  return mean_of(values);
}

Sampled sample_of(const RunResult& run, const Place& place, const NamedQuantity& quantity) {
  const auto& name = quantity.name;
  if (name.starts_with("axial")) {
    const auto& profile = species_of(run, place).axial;
    return along(profile.coordinate, part_of(profile, name), quantity, "z");
  }
  if (name.starts_with("lateral")) {
    const auto& lateral = species_of(run, place).lateral;
    const auto h = height_of(run, place);
    if (h >= lateral.size()) return Sampled{};
    return along(lateral[h].coordinate, part_of(lateral[h], name), quantity, "x");
  }
  if (name == "occurrence") return single(occurrence_of(run), quantity);
  if (name == "cluster holdup")
    return single(cluster_mean(run, &analysis::Cluster::holdup), quantity);
  if (name == "cluster velocity")
    return single(cluster_mean(run, &analysis::Cluster::velocity_z), quantity);
  if (name == "cluster position") return cluster_positions(run, quantity);
  if (name == "mean holdup")
    return single(inventory_mean(run, place, run.mean_holdup, &analysis::InventorySample::holdup),
                  quantity);
  if (name == "inventory")
    return single(
        inventory_mean(run, place, run.inventory_mass, &analysis::InventorySample::solids_mass),
        quantity);
  if (name == "mean temperature")
    return single(temperature_of(run, place, &analysis::TemperatureSample::mean), quantity);
  if (name == "temperature spread")
    return single(temperature_of(run, place, &analysis::TemperatureSample::std), quantity);
  return temperature_pdf(run, place, quantity);
}

}  // namespace

std::span<const NamedQuantity> quantities() { return all_quantities; }

Sampled sample(const RunResult& run, const Place& place) {
  const auto quantity = std::find_if(all_quantities.begin(), all_quantities.end(),
                                     [&](const auto& q) { return q.name == place.quantity; });
  if (quantity == all_quantities.end()) {
    std::set<std::string> names;
    for (const auto& each : all_quantities) names.emplace(each.name);
    throw InputError("no quantity \"{}\"; the nearest known one is \"{}\"", place.quantity,
                     readers::nearest_name(place.quantity, names));
  }
  auto sampled = sample_of(run, place, *quantity);
  if (std::none_of(sampled.value.begin(), sampled.value.end(),
                   [](double value) { return std::isfinite(value); }))
    throw InputError("run \"{}\": it has no {}{}", run.label, place.quantity,
                     place.species == "all" ? "" : " of species " + place.species);
  if (run.window.snapshots > 1) sampled.duration = run.window.to - run.window.from;
  return sampled;
}

Curve as_curve(const Sampled& sampled, const std::string& name) {
  Curve curve{.name = name, .x = sampled.x, .y = sampled.y};
  for (std::size_t i = 0; i < sampled.at.size(); ++i)
    if (std::isfinite(sampled.value[i]))
      curve.points.push_back({sampled.at[i], sampled.value[i], 0, sampled.u[i]});
  if (!sampled.error_known)
    curve.assumptions.push_back(name + ": has no intervals; taken as exact");
  return curve;
}

}  // namespace bedscope::validation
