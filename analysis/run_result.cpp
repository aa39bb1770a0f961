// SPDX-License-Identifier: BSD-3-Clause
// The last step of the analysis of a run: from sums to means with their errors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>

#include "analysis/run_sums.hpp"
#include "analysis/statistics.hpp"

namespace bedscope::analysis {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr double worth_a_word = 1e-3;  // of a mean, that a drift changes it

}  // namespace

std::vector<RunSums::Species> RunSums::species() const {
  std::vector<Species> found{{"all", {}}};
  std::set<int> types;
  for (std::size_t s = 0; s < slots_.size(); ++s) {
    if (slots_[s].rule >= 0) continue;
    found[0].slots.push_back(s);
    if (slots_[s].type != 0) types.insert(slots_[s].type);
  }
  const auto in_order = [&](std::vector<std::size_t>& slots) {
    // By type, so that sums do not depend on which type came first in a dump.
    std::sort(slots.begin(), slots.end(),
              [&](std::size_t a, std::size_t b) { return slots_[a].type < slots_[b].type; });
  };
  in_order(found[0].slots);
  for (const int type : setup_->settings.wanted.species ? types : std::set<int>{})
    for (std::size_t s = 0; s < slots_.size(); ++s)
      if (slots_[s] == SlotKey{type, -1}) found.push_back({std::to_string(type), {s}});
  for (std::size_t rule = 0; rule < setup_->settings.species.size(); ++rule) {
    Species chosen{setup_->settings.species[rule].name, {}};
    for (std::size_t s = 0; s < slots_.size(); ++s)
      if (slots_[s].rule == static_cast<int>(rule)) chosen.slots.push_back(s);
    in_order(chosen.slots);
    found.push_back(std::move(chosen));
  }
  return found;
}

void RunSums::inventory_of(const Species& species, RunResult& result) const {
  const auto& grid = setup_->grid;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const auto& sample = samples_[i];
    InventorySample row;
    row.time = setup_->times[i];
    row.type = species.name;
    SolidsSum solids;
    TemperatureSum heat;
    for (const std::size_t s : species.slots) {
      if (s >= sample.slots.size()) continue;
      const auto& slot = sample.slots[s].solids;
      if (slot.volume > 0)  // a type without volume would bring the mass 0 x nan
        solids += slot;
      else
        solids.particles += slot.particles;
      heat += sample.slots[s].temperature;
    }
    row.particles = solids.particles;
    row.solids_mass = density_known() ? solids.mass : undefined;
    row.holdup = solids.volume / grid.volume();
    // The centre of mass; of volume where no density is known (the same for one density).
    const bool by_mass = solids.mass > 0 && std::isfinite(solids.mass);
    row.mean_height = solids.volume > 0 ? grid.min[up] + (by_mass ? solids.mass_moment / solids.mass
                                                                  : solids.moment / solids.volume)
                                        : undefined;
    result.inventory.push_back(row);
    if (!setup_->has_temperature) continue;
    TemperatureSample temperature{row.time, row.type, undefined, undefined, undefined, undefined};
    if (heat.particles > 0) {
      const double mean = heat.sum / static_cast<double>(heat.particles);
      const double square = heat.squares / static_cast<double>(heat.particles);
      temperature.mean = sample.temperature_zero + mean;
      temperature.std = std::sqrt(std::max(0., square - mean * mean));
      temperature.min = heat.coldest;
      temperature.max = heat.hottest;
    }
    result.temperature.push_back(temperature);
  }
}

void RunSums::profiles_of(const Species& species, const Window& window, SpeciesResult& result,
                          std::vector<std::string>& doubts) const {
  const auto& grid = setup_->grid;
  const auto nx = static_cast<std::size_t>(grid.cells[lateral]);
  const auto nz = static_cast<std::size_t>(grid.cells[up]);
  const auto heights = setup_->heights.size();

  // One sample a leaf: its mean over the time that it stands for.
  const auto leaves = samples_of(profiles_, window);
  std::vector<double> weights;
  for (const auto& sum : leaves) weights.push_back(sum.weight);
  const auto density = densities();
  const std::size_t n = leaves.size();
  std::vector<double> holdup(n), moved(n), flux(n);
  int few = 0, disagree = 0, points = 0;
  const auto estimate = [&](std::size_t at, Profile& profile) {
    for (std::size_t leaf = 0; leaf < n; ++leaf) {
      holdup[leaf] = moved[leaf] = flux[leaf] = 0;
      for (const std::size_t s : species.slots) {
        if (s >= leaves[leaf].slots.size() || leaves[leaf].slots[s].empty()) continue;
        const double* const q = leaves[leaf].slots[s].data() + at;
        const double per_weight = 1 / weights[leaf];
        holdup[leaf] += q[0] * per_weight;
        moved[leaf] += q[1] * per_weight;
        if (q[0] != 0) flux[leaf] += density[s] * q[1] * per_weight;
      }
    }
    const auto mean = estimate_mean(holdup, weights);
    profile.holdup.push_back(mean);
    ++points;
    few += mean.few_samples;
    disagree += mean.disagree;
    const bool moves = setup_->has_velocity;
    profile.velocity_z.push_back(moves ? estimate_ratio(moved, holdup, weights) : Estimate{});
    const bool finite =
        std::all_of(flux.begin(), flux.end(), [](double g) { return std::isfinite(g); });
    profile.mass_flux_z.push_back(
        moves && finite && density_known() ? estimate_mean(flux, weights).estimate() : Estimate{});
  };
  for (std::size_t k = 0; k < nz; ++k) {
    result.axial.coordinate.push_back(grid.centre(up, static_cast<int>(k)));
    estimate(2 * k, result.axial);
  }
  for (std::size_t h = 0; h < heights; ++h) {
    Profile profile;
    for (std::size_t i = 0; i < nx; ++i) {
      profile.coordinate.push_back(grid.centre(lateral, static_cast<int>(i)));
      estimate(2 * nz + 2 * (nx * h + i), profile);
    }
    result.lateral.push_back(std::move(profile));
  }
  if (species.name != "all") return;
  if (few > 0)
    doubts.push_back(fmt::format(
        "profiles: at {} of {} points the window holds too few independent samples for the "
        "interval to be trusted",
        few, points));
  if (disagree > 0)
    doubts.push_back(fmt::format(
        "profiles: at {} of {} points batch means and autocorrelation time disagree on the error",
        disagree, points));
}

void RunSums::fields_of(const Species& species, const WeightedSum& sum,
                        SpeciesResult& result) const {
  if (!setup_->settings.wanted.fields) return;
  const auto cells = setup_->grid.size();
  auto& fields = result.fields;
  fields.holdup.assign(cells, 0);
  std::vector<double> moved_x(cells, 0), moved_z(cells, 0);
  fields.mass_flux_x.assign(cells, 0);
  fields.mass_flux_z.assign(cells, 0);
  const auto slot_densities = densities();
  for (const std::size_t s : species.slots) {
    if (s >= sum.slots.size() || sum.slots[s].empty()) continue;
    const double density = slot_densities[s];
    const double* q = sum.slots[s].data();
    for (std::size_t c = 0; c < cells; ++c, q += 3) {
      if (q[0] == 0) continue;
      fields.holdup[c] += q[0] / sum.weight;
      moved_x[c] += q[1] / sum.weight;
      moved_z[c] += q[2] / sum.weight;
      fields.mass_flux_x[c] += density * (q[1] / sum.weight);
      fields.mass_flux_z[c] += density * (q[2] / sum.weight);
    }
  }
  fields.velocity_x.assign(cells, undefined);
  fields.velocity_z.assign(cells, undefined);
  for (std::size_t c = 0; c < cells && setup_->has_velocity; ++c) {
    if (fields.holdup[c] <= 0) continue;
    fields.velocity_x[c] = moved_x[c] / fields.holdup[c];
    fields.velocity_z[c] = moved_z[c] / fields.holdup[c];
  }
  if (!density_known() || !setup_->has_velocity) {
    fields.mass_flux_x.assign(cells, undefined);
    fields.mass_flux_z.assign(cells, undefined);
  }
}

std::vector<WeightedSum> RunSums::samples_of(const Leaves& sums, const Window& window) const {
  std::vector<WeightedSum> found;
  for (auto& [number, sum] : sums.leaves()) {
    const bool before = number * sums.size() < window.first && !setup_->settings.average;
    if (!before && sum.weight > 0) found.push_back(sum);
  }
  return found;
}

namespace {

/// Sum over the slots of one quantity, a sample each; whatever a sample lacks is 0.
std::vector<double> series_of(const std::vector<WeightedSum>& samples,
                              const std::vector<std::size_t>& slots, std::size_t at) {
  std::vector<double> values;
  for (const auto& sample : samples) {
    double sum = 0;
    for (const std::size_t s : slots)
      if (s < sample.slots.size() && !sample.slots[s].empty()) sum += sample.slots[s][at];
    values.push_back(sum / sample.weight);
  }
  return values;
}

std::vector<double> weights_of(const std::vector<WeightedSum>& samples) {
  std::vector<double> weights;
  for (const auto& sample : samples) weights.push_back(sample.weight);
  return weights;
}

}  // namespace

void RunSums::pdf_of(const Species& species, const Window& window, SpeciesResult& result) const {
  if (!setup_->has_temperature || !setup_->settings.temperature) return;
  const auto bins = static_cast<std::size_t>(setup_->settings.temperature_bins);
  const auto samples = samples_of(histograms_, window);
  const auto weights = weights_of(samples);
  const auto all = series_of(samples, species.slots, bins);  // inside the range and outside
  double inside = 0;
  for (std::size_t b = 0; b < bins; ++b) {
    const auto share = estimate_ratio(series_of(samples, species.slots, b), all, weights);
    result.temperature_pdf.push_back(share.value * static_cast<double>(bins));
    result.temperature_pdf_ci95.push_back(share.ci95 * static_cast<double>(bins));
    inside += share.value;
  }
  if (species.name == "all" && inside < 1 - 1e-12) result.temperature_outside = 1 - inside;
}

void RunSums::axial_temperature_of(const Species& species, const Window& window,
                                   SpeciesResult& result) const {
  if (!setup_->has_temperature) return;
  const auto samples = samples_of(warmth_, window);
  const auto weights = weights_of(samples);
  for (std::size_t k = 0; k < static_cast<std::size_t>(setup_->grid.cells[up]); ++k)
    result.axial_temperature.push_back(estimate_ratio(series_of(samples, species.slots, 2 * k + 1),
                                                      series_of(samples, species.slots, 2 * k),
                                                      weights));
}

void RunSums::bed_of(const Window& window, RunResult& result) const {
  auto& bed = result.bed;
  bed.asked = setup_->settings.bed;
  const double floor = setup_->grid.min[up];
  std::vector<double> weights, centres, surfaces;
  for (const auto& row : result.inventory) {
    if (row.type != "all") continue;
    const auto& sample = samples_[bed.samples.size()];
    // A level bed of height H has its centre at H/2.
    bed.samples.push_back({row.time, 2 * (row.mean_height - floor), sample.bed.by_solids,
                           sample.bed.surface, undefined});
  }
  const auto solids = std::find_if(bed.samples.begin(), bed.samples.end(), [](const auto& sample) {
    return std::isfinite(sample.by_centre);
  });
  bed.at_rest = setup_->settings.height_at_rest.value_or(
      solids != bed.samples.end() ? solids->by_centre : undefined);
  for (auto& sample : bed.samples) sample.expansion = sample.by_centre / bed.at_rest;
  for (std::size_t i = window.first; i < window.first + window.snapshots; ++i) {
    if (!std::isfinite(bed.samples[i].by_centre + bed.samples[i].surface)) continue;  // empty
    weights.push_back(samples_[i].weight);
    centres.push_back(bed.samples[i].by_centre);
    surfaces.push_back(bed.samples[i].surface);
  }
  bed.by_centre = estimate_mean(centres, weights).estimate();
  bed.surface = estimate_mean(surfaces, weights).estimate();
  bed.expansion = {bed.by_centre.value / bed.at_rest, bed.by_centre.ci95 / bed.at_rest};
}

void RunSums::means_of(const Window& window, RunResult& result) const {
  std::vector<double> weights, holdup, mass, clusters, bed, volumes, heights;
  double volume = 0, outside = 0;
  const auto& grid = setup_->grid;
  const double area = grid.length(lateral) * grid.length(depth);
  for (std::size_t i = window.first; i < window.first + window.snapshots; ++i) {
    const auto& sample = samples_[i];
    weights.push_back(sample.weight);
    holdup.push_back(sample.volume_inside / grid.volume());
    if (!occurrence_.empty()) clusters.push_back(occurrence_[i].clusters);
    volumes.push_back(sample.volume);
    volume += sample.weight * sample.volume;
    outside += sample.weight * (sample.volume - sample.volume_inside);
    double kilograms = 0, moment = 0;
    for (std::size_t s = 0; s < sample.slots.size(); ++s) {
      if (slots_[s].rule >= 0 || sample.slots[s].solids.volume <= 0) continue;
      kilograms += sample.slots[s].solids.mass;
      moment += sample.slots[s].solids.moment;
    }
    mass.push_back(kilograms);
    if (moment > 0) heights.push_back(moment / sample.volume);
    // A level bed of height H has its centre at H/2, whatever the surface does.
    bed.push_back(moment > 0 ? 1 - sample.volume / (area * 2 * moment / sample.volume) : 1);
  }
  const auto mean = estimate_mean(holdup, weights);
  result.mean_holdup = mean.estimate();
  result.independent_samples = mean.independent_samples;
  if (!clusters.empty()) result.mean_occurrence = estimate_mean(clusters, weights).estimate();
  result.bed_voidage = estimate_mean(bed, weights).estimate();
  if (density_known() &&
      std::all_of(mass.begin(), mass.end(), [](double m) { return std::isfinite(m); }))
    result.inventory_mass = estimate_mean(mass, weights).estimate();
  for (const auto& [what, series, unit] :
       {std::tuple("mean holdup", &holdup, "-"), {"mean height", &heights, "m"}}) {
    const auto drift = drift_of(*series);
    const double size = series->empty() ? 0 : std::abs(series->front());
    if (drift.significance > significant_drift && std::abs(drift.change) > worth_a_word * size)
      result.problems.push_back(fmt::format(
          "the {} drifts by {:.2g} {} over the window ({:.2g} standard errors): is it steady?",
          what, drift.change, unit, drift.significance));
  }
  result.outside_fraction = volume > 0 ? std::max(0., outside / volume) : 0;
  const auto [least, most] = std::minmax_element(volumes.begin(), volumes.end());
  if (volumes.size() > 1 && *most - *least <= 1e-12 * *most)
    result.problems.emplace_back(
        "constant inventory: the interval of the mean holdup tells nothing of how well the rest is "
        "converged");
  if (mean.few_samples)
    result.problems.push_back(
        fmt::format("mean holdup: the window holds {:.3g} independent samples, too few for its "
                    "interval to be trusted ({:.3g} are enough)",
                    mean.independent_samples, mean.enough_samples));
  if (mean.disagree)
    result.problems.emplace_back(
        "mean holdup: batch means and autocorrelation time disagree on the error");
  if (result.outside_fraction > 1e-3)
    result.problems.push_back(fmt::format("{:.3g} % of the solids volume lies outside the domain",
                                          100 * result.outside_fraction));
}

RunResult RunSums::finish(const readers::Series& series, const Window& window) && {
  RunResult result;
  const auto& setup = *setup_;
  result.grid = setup.grid;
  result.mapping = setup.settings.mapping;
  result.domain_assumed = setup.domain_assumed;
  result.time_known = setup.time_known;
  result.density_known = density_known();
  result.heights = setup.heights;
  result.band = setup.band;
  result.thresholds = setup.settings.clusters;
  result.window = window;
  result.window.from = setup.times[window.first];
  result.window.to = setup.times[window.first + window.snapshots - 1];
  result.problems = series.problems();
  result.problems.insert(result.problems.end(), setup.problems.begin(), setup.problems.end());
  for (auto& line : flaws_.describe(series)) result.problems.push_back(std::move(line));
  if (without_temperature_ > 0)
    result.problems.push_back(fmt::format(
        "{} particles without a finite temperature, left out of its means", without_temperature_));
  if (setup.settings.temperature) {
    result.temperature_from = (*setup.settings.temperature)[0];
    result.temperature_to = (*setup.settings.temperature)[1];
  }
  const std::size_t first_leaf = setup.settings.average ? 0 : window.first / fields_.size();
  const auto sum = fields_.total(first_leaf);
  const auto kinds = species();
  const auto& total = kinds.front();
  for (const auto& kind : kinds) {
    result.types.push_back(kind.name);
    SpeciesResult found;
    if (!result.species.empty() && kind.slots == total.slots) {
      found = result.species.front();  // one type only: its numbers are the total's
    } else {
      profiles_of(kind, window, found, result.problems);
      fields_of(kind, sum, found);
      pdf_of(kind, window, found);
      axial_temperature_of(kind, window, found);
    }
    found.type = kind.name;
    inventory_of(kind, result);
    if (kind.name == "all" && found.temperature_outside > 0)
      result.problems.push_back(
          fmt::format("temperature PDF: {:.3g} % of the particles lie outside its range",
                      100 * found.temperature_outside));
    result.species.push_back(std::move(found));
  }
  if (auto edge = sensitivity_.describe(setup.settings.clusters); !edge.empty())
    result.problems.push_back(std::move(edge));
  result.occurrence = occurrence_;
  result.clusters = std::move(clusters_);
  keep_from(result.clusters, window.first);
  if (setup.settings.bubbles)
    result.bubbles = std::move(bubbles_).finish(setup, window.first, result.problems);
  bed_of(window, result);
  means_of(window, result);
  tell_missing(series, window, result);
  tell_losses(window, result);
  tell_packing(window, result);
  if (window.automatic && !window.steady)
    result.problems.push_back(
        samples_.size() < 20
            ? fmt::format("{} snapshots are too few to tell whether the run is steady",
                          samples_.size())
            : fmt::format("not steady: no steady part begins in the first half of the run, and the "
                          "average starts at {:.6g} s",
                          result.window.from));
  result.bytes_read = bytes_read_;
  return result;
}

}  // namespace bedscope::analysis
