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
constexpr int block_power = 4;            // 16 snapshots a block, added one by one
constexpr std::size_t kept_blocks = 128;  // of fields, where the window is chosen afterwards
constexpr std::size_t kept_leaves = 64;   // of profiles: enough for 10 batches, whatever the length

}  // namespace

RunSums::RunSums(const RunSetup& setup, bool keep_blocks, bool keep_contours)
    : setup_(&setup),
      keep_contours_(keep_contours),
      fields_(block_power, keep_blocks ? kept_blocks : 0),
      profiles_(0, kept_leaves),
      histograms_(0, kept_leaves),
      warmth_(0, kept_leaves),
      tracker_(setup.grid),
      bubbles_(setup.grid) {}

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
  sample.bed = product.bed;
  if (weight > 0) {
    fields_.at(i).weight += weight;
    profiles_.at(i).weight += weight;
    histograms_.at(i).weight += weight;
    warmth_.at(i).weight += weight;
  }
  for (std::size_t s = 0; s < product.used; ++s) {
    const auto& slot = product.slots[s];
    const auto number = slot_number(slot.key);
    if (sample.slots.size() <= number) sample.slots.resize(number + 1);
    sample.slots[number] = {slot.solids, slot.temperature};
    if (weight <= 0) continue;
    if (setup_->settings.wanted.fields) fields_.at(i).add(weight, number, slot.fields);
    profiles_.at(i).add(weight, number, slot.profiles);
    if (!slot.histogram.empty()) histograms_.at(i).add(weight, number, slot.histogram);
    if (!slot.warmth.empty()) warmth_.at(i).add(weight, number, slot.warmth);
  }
  samples_.push_back(std::move(sample));

  if (weight > 0) sensitivity_.merge(product.sensitivity);
  double area = 0;
  for (auto& cluster : product.image.clusters) {
    cluster.snapshot = i;
    cluster.time = setup_->time_known ? time : undefined;
    area += cluster.area;
    if (!keep_contours_) cluster.contours = {};
  }
  const auto& grid = setup_->grid;
  if (setup_->settings.wanted.clusters)
    occurrence_.push_back({time, static_cast<int>(product.image.clusters.size()),
                           area / (grid.length(lateral) * grid.length(up))});
  if (weight > 0) {
    if (setup_->settings.wanted.clusters)
      tracker_.link(product.image, setup_->time_known ? time : undefined);
    if (!setup_->has_velocity)
      for (auto& cluster : product.image.clusters)
        cluster.velocity_x = cluster.velocity_z = undefined;
    std::move(product.image.clusters.begin(), product.image.clusters.end(),
              std::back_inserter(clusters_));
    if (setup_->settings.bubbles)
      bubbles_.add(product.bubbles, i, setup_->time_known ? time : undefined, weight,
                   keep_contours_);
  }
  flaws_.merge(product.flaws);
  without_temperature_ += product.without_temperature;
  bytes_read_ += product.bytes_read;
}

bool RunSums::added_with(const std::vector<double>& weights) const {
  if (samples_.size() > weights.size()) return false;
  return std::equal(samples_.begin(), samples_.end(), weights.begin(),
                    [](const Sample& sample, double weight) { return sample.weight == weight; });
}

/// Of each slot [kg/m3]: mass over volume of all its particles in all snapshots.
std::vector<double> RunSums::densities() const {
  std::vector<double> mass(slots_.size(), 0), volume(slots_.size(), 0);
  for (const auto& sample : samples_)
    for (std::size_t s = 0; s < sample.slots.size(); ++s) {
      if (!(sample.slots[s].solids.volume > 0)) continue;
      mass[s] += sample.slots[s].solids.mass;
      volume[s] += sample.slots[s].solids.volume;
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
      if (slots_[s].rule < 0) moment += sample.slots[s].solids.moment;
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

}  // namespace bedscope::analysis
