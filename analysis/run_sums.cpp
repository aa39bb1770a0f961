// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/run_sums.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "analysis/statistics.hpp"
#include "readers/error.hpp"

namespace bedscope::analysis {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr int block_power = 4;            // 16 snapshots a block, DESIGN section 1
constexpr std::size_t kept_blocks = 128;  // of fields, where the window is chosen afterwards
constexpr std::size_t kept_leaves = 64;   // of profiles: enough for 10 batches, whatever the length

}  // namespace

/// A name, and the slots whose sum it is.
struct RunSums::Species {
  std::string name;
  std::vector<std::size_t> slots;
};

RunSums::RunSums(const RunSetup& setup, bool keep_blocks, bool keep_contours)
    : setup_(&setup),
      keep_contours_(keep_contours),
      fields_(block_power, keep_blocks ? kept_blocks : 2),
      profiles_(0, kept_leaves),
      histograms_(block_power, keep_blocks ? kept_blocks : 2),
      tracker_(setup.grid) {}

std::size_t RunSums::slot_number(SlotKey key) {
  const auto found = std::find(slots_.begin(), slots_.end(), key);
  if (found != slots_.end()) return static_cast<std::size_t>(found - slots_.begin());
  slots_.push_back(key);
  return slots_.size() - 1;
}

void RunSums::add(SnapshotProduct& product, double weight) {
  const std::size_t i = product.snapshot;
  const double time = setup_->times[i];
  Sample sample;
  sample.volume = product.volume;
  sample.volume_inside = product.volume_inside;
  sample.temperature_zero = product.temperature_zero;
  sample.weight = weight;
  if (weight > 0) {
    fields_.at(i).weight += weight;
    profiles_.at(i).weight += weight;
    histograms_.at(i).weight += weight;
  }
  for (std::size_t s = 0; s < product.used; ++s) {
    const auto& slot = product.slots[s];
    const auto number = slot_number(slot.key);
    if (sample.slots.size() <= number) sample.slots.resize(number + 1);
    sample.slots[number] = {slot.particles,   slot.volume,          slot.moment,
                            slot.mass,        slot.mass_moment,     slot.with_temperature,
                            slot.shifted_sum, slot.shifted_squares, slot.coldest,
                            slot.hottest};
    if (weight <= 0) continue;
    fields_.at(i).add(weight, number, slot.fields);
    profiles_.at(i).add(weight, number, slot.profiles);
    if (!slot.histogram.empty()) histograms_.at(i).add(weight, number, slot.histogram);
  }
  samples_.push_back(std::move(sample));

  double area = 0;
  for (auto& cluster : product.image.clusters) {
    cluster.snapshot = i;
    cluster.time = setup_->time_known ? time : undefined;
    area += cluster.area;
    if (!keep_contours_) cluster.contours = {};
  }
  const auto& grid = setup_->grid;
  occurrence_.push_back({time, static_cast<int>(product.image.clusters.size()),
                         area / (grid.length(lateral) * grid.length(up))});
  if (weight > 0) {
    tracker_.link(product.image, setup_->time_known ? time : undefined);
    if (!setup_->has_velocity)
      for (auto& cluster : product.image.clusters)
        cluster.velocity_x = cluster.velocity_z = undefined;
    std::move(product.image.clusters.begin(), product.image.clusters.end(),
              std::back_inserter(clusters_));
  }
  flaws_.merge(product.flaws);
  without_temperature_ += product.without_temperature;
  bytes_read_ += product.bytes_read;
}

/// Of each slot [kg/m3]: mass over volume of all its particles in all snapshots.
std::vector<double> RunSums::densities() const {
  std::vector<double> mass(slots_.size(), 0), volume(slots_.size(), 0);
  for (const auto& sample : samples_)
    for (std::size_t s = 0; s < sample.slots.size(); ++s) {
      if (!(sample.slots[s].volume > 0)) continue;
      mass[s] += sample.slots[s].mass;
      volume[s] += sample.slots[s].volume;
    }
  std::vector<double> density(slots_.size());
  for (std::size_t s = 0; s < slots_.size(); ++s) {
    const bool by_type = setup_->density_from == RunSetup::Density::by_type;
    density[s] = by_type ? setup_->density.at(slots_[s].type) : mass[s] / volume[s];
  }
  return density;
}

Window RunSums::choose_window() const {
  Window window;
  window.automatic = true;
  std::vector<double> volume, height;
  for (const auto& sample : samples_) {
    volume.push_back(sample.volume);
    double moment = 0;
    for (std::size_t s = 0; s < sample.slots.size(); ++s)
      if (slots_[s].rule < 0) moment += sample.slots[s].moment;
    height.push_back(sample.volume > 0 ? moment / sample.volume : 0);
  }
  std::size_t start = 0;
  for (const auto& series : {volume, height}) {
    const auto found = steady_start(series);
    if (found.constant) continue;
    start = std::max(start, found.start);
    window.steady = window.steady && found.steady;
  }
  // Sums are kept in blocks, so the window begins at one.
  const std::size_t block = std::max(fields_.size(), profiles_.size());
  std::size_t first = (start + block - 1) / block * block;
  if (first >= samples_.size()) {
    first = (samples_.size() - 1) / block * block;
    if (first < start) window.steady = false;
  }
  window.first = first;
  window.snapshots = samples_.size() - first;
  return window;
}

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
  for (const int type : types)
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
    double volume = 0, mass = 0, moment = 0, mass_moment = 0;
    TemperatureSample heat;
    std::int64_t with_temperature = 0;
    double sum = 0, squares = 0;
    heat.min = INFINITY;
    heat.max = -INFINITY;
    for (const std::size_t s : species.slots) {
      if (s >= sample.slots.size()) continue;
      const auto& slot = sample.slots[s];
      row.particles += slot.particles;
      volume += slot.volume;
      moment += slot.moment;
      if (slot.volume > 0) {
        mass += slot.mass;
        mass_moment += slot.mass_moment;
      }
      if (slot.with_temperature == 0) continue;
      with_temperature += slot.with_temperature;
      sum += slot.shifted_sum;
      squares += slot.shifted_squares;
      heat.min = std::min(heat.min, slot.coldest);
      heat.max = std::max(heat.max, slot.hottest);
    }
    row.solids_mass = density_known() ? mass : undefined;
    row.holdup = volume / grid.volume();
    // The centre of mass; of volume where no density is known (the same for one density).
    const bool by_mass = mass > 0 && std::isfinite(mass);
    row.mean_height =
        volume > 0 ? grid.min[up] + (by_mass ? mass_moment / mass : moment / volume) : undefined;
    result.inventory.push_back(row);
    if (!setup_->has_temperature) continue;
    heat.time = row.time;
    heat.type = species.name;
    if (with_temperature == 0) {
      heat.mean = heat.std = heat.min = heat.max = undefined;
    } else {
      const double n = static_cast<double>(with_temperature);
      heat.mean = sample.temperature_zero + sum / n;
      heat.std = std::sqrt(std::max(0., squares / n - (sum / n) * (sum / n)));
    }
    result.temperature.push_back(heat);
  }
}

void RunSums::profiles_of(const Species& species, const Window& window, SpeciesResult& result,
                          std::vector<std::string>& doubts) const {
  const auto& grid = setup_->grid;
  const auto nx = static_cast<std::size_t>(grid.cells[lateral]);
  const auto nz = static_cast<std::size_t>(grid.cells[up]);
  const auto heights = setup_->heights.size();

  // One sample a leaf: its mean over the time that it stands for.
  std::vector<const WeightedSum*> leaves;
  std::vector<double> weights;
  for (const auto& [number, sum] : profiles_.leaves()) {
    if (number * profiles_.size() < window.first && setup_->settings.average == std::nullopt)
      continue;
    if (sum.weight <= 0) continue;
    leaves.push_back(&sum);
    weights.push_back(sum.weight);
  }
  const auto density = densities();
  const std::size_t n = leaves.size();
  std::vector<double> holdup(n), moved(n), flux(n);
  int few = 0, disagree = 0, points = 0;
  const auto estimate = [&](std::size_t at, Profile& profile) {
    for (std::size_t leaf = 0; leaf < n; ++leaf) {
      holdup[leaf] = moved[leaf] = flux[leaf] = 0;
      for (const std::size_t s : species.slots) {
        if (s >= leaves[leaf]->slots.size() || leaves[leaf]->slots[s].empty()) continue;
        const double* const q = leaves[leaf]->slots[s].data() + at;
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
    profile.mass_flux_z.push_back(moves && finite && density_known()
                                      ? static_cast<Estimate>(estimate_mean(flux, weights))
                                      : Estimate{});
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

void RunSums::pdf_of(const Species& species, const Window& window, SpeciesResult& result) const {
  if (!setup_->has_temperature || !setup_->settings.temperature) return;
  const auto bins = static_cast<std::size_t>(setup_->settings.temperature_bins);
  const auto sum =
      histograms_.total(setup_->settings.average ? 0 : window.first / histograms_.size());
  std::vector<double> density(bins, 0);
  double all = 0;  // particles with a temperature, inside the range and outside
  for (std::size_t i = window.first; i < window.first + window.snapshots; ++i)
    for (const std::size_t s : species.slots)
      if (s < samples_[i].slots.size())
        all += samples_[i].weight * static_cast<double>(samples_[i].slots[s].with_temperature);
  for (const std::size_t s : species.slots)
    if (s < sum.slots.size() && !sum.slots[s].empty())
      for (std::size_t b = 0; b < bins; ++b) density[b] += sum.slots[s][b];
  const double inside = std::accumulate(density.begin(), density.end(), 0.);
  if (species.name == "all" && all > 0 && inside < all * (1 - 1e-12))
    result.temperature_outside = 1 - inside / all;
  for (auto& value : density) value *= static_cast<double>(bins) / all;
  result.temperature_pdf = std::move(density);
}

void RunSums::clusters_of(const Window& window, RunResult& result) const {
  std::map<int, int> numbers;  // tracks are counted from 1 inside the window
  for (const auto& cluster : clusters_) {
    if (cluster.snapshot < window.first) continue;
    numbers.try_emplace(cluster.track, static_cast<int>(numbers.size()) + 1);
  }
  for (const auto& cluster : clusters_) {
    if (cluster.snapshot < window.first) continue;
    auto kept = cluster;
    kept.track = numbers.at(cluster.track);
    kept.parents.clear();
    for (const int parent : cluster.parents)
      if (const auto found = numbers.find(parent); found != numbers.end())
        kept.parents.push_back(found->second);
    result.clusters.push_back(std::move(kept));
  }
}

void RunSums::means_of(const Window& window, RunResult& result) const {
  std::vector<double> weights, holdup, mass, clusters, bed;
  double volume = 0, outside = 0;
  const auto& grid = setup_->grid;
  const double area = grid.length(lateral) * grid.length(depth);
  for (std::size_t i = window.first; i < window.first + window.snapshots; ++i) {
    const auto& sample = samples_[i];
    weights.push_back(sample.weight);
    holdup.push_back(sample.volume_inside / grid.volume());
    clusters.push_back(occurrence_[i].clusters);
    volume += sample.weight * sample.volume;
    outside += sample.weight * (sample.volume - sample.volume_inside);
    double kilograms = 0, moment = 0;
    for (std::size_t s = 0; s < sample.slots.size(); ++s) {
      if (slots_[s].rule >= 0 || sample.slots[s].volume <= 0) continue;
      kilograms += sample.slots[s].mass;
      moment += sample.slots[s].moment;
    }
    mass.push_back(kilograms);
    // A level bed of height H has its centre at H/2: H = 2 x mean height, whatever the surface
    // does.
    bed.push_back(moment > 0 ? 1 - sample.volume / (area * 2 * moment / sample.volume) : 1);
  }
  const auto mean = estimate_mean(holdup, weights);
  result.mean_holdup = mean;
  result.independent_samples = mean.independent_samples;
  result.mean_occurrence = estimate_mean(clusters, weights);
  result.bed_voidage = estimate_mean(bed, weights);
  if (density_known() &&
      std::all_of(mass.begin(), mass.end(), [](double m) { return std::isfinite(m); }))
    result.inventory_mass = estimate_mean(mass, weights);
  result.outside_fraction = volume > 0 ? std::max(0., outside / volume) : 0;
  if (mean.few_samples)
    result.problems.push_back(
        fmt::format("mean holdup: the window holds {:.3g} independent samples, too few for its "
                    "interval to be trusted",
                    mean.independent_samples));
  if (mean.disagree)
    result.problems.emplace_back(
        "mean holdup: batch means and autocorrelation time disagree on the error");
  if (result.outside_fraction > 1e-3)
    result.problems.push_back(fmt::format("{:.3g} % of the solids volume lies outside the domain",
                                          100 * result.outside_fraction));
}

RunResult RunSums::finish(const readers::Series& series, const Window& window) const {
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
    }
    found.type = kind.name;
    inventory_of(kind, result);
    if (kind.name == "all" && found.temperature_outside > 0)
      result.problems.push_back(
          fmt::format("temperature PDF: {:.3g} % of the particles lie outside its range",
                      100 * found.temperature_outside));
    result.species.push_back(std::move(found));
  }
  result.occurrence = occurrence_;
  clusters_of(window, result);
  means_of(window, result);
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
