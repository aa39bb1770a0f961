// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/snapshot_products.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <limits>
#include <string_view>

#include "readers/error.hpp"
#include "readers/processor.hpp"

namespace bedscope::analysis {
namespace {

constexpr std::size_t quantities = 3;  // phi, phi v_lateral, phi v_up

class Mapper {
 public:
  Mapper(const RunSetup& setup, const readers::Snapshot& snapshot, SnapshotProduct& out)
      : setup_(setup), columns_(snapshot.columns), rows_(snapshot.particles), out_(out) {}

  /// Throws InputError where a type occurs for which the study has no radius or density.
  template <class Kernel>
  void run(const Kernel& kernel) {
    run_for_processor(kernel);
    if (failure_) std::rethrow_exception(failure_);
  }

  void temperatures() {
    const double* const temperature = data(column_temperature);
    if (temperature == nullptr) return;
    const auto first =
        std::find_if(temperature, temperature + rows_, [](double t) { return std::isfinite(t); });
    if (first == temperature + rows_) return;
    out_.temperature_zero = *first;
    for (std::size_t i = 0; i < rows_; ++i) {
      if (!std::isfinite(temperature[i])) {
        ++out_.without_temperature;
        continue;
      }
      const int of = type_of(i);
      add_temperature(i, temperature[i], slot_of({of, -1}));
      for (std::size_t rule = 0; rule < setup_.settings.species.size(); ++rule)
        if (setup_.settings.species[rule].holds(columns_[column_first_rule + rule][i]))
          add_temperature(i, temperature[i], slot_of({of, static_cast<int>(rule)}));
    }
  }

 private:
  template <class Kernel>
  [[gnu::flatten]] BEDSCOPE_FOR_EACH_PROCESSOR void run_for_processor(
      const Kernel& kernel) noexcept {
    try {
      sum(kernel);
    } catch (...) {
      failure_ = std::current_exception();
    }
  }

  template <class Kernel>
  void sum(const Kernel& kernel) {
    const double* const x = columns_[column_lateral].data();
    const double* const y = columns_[column_depth].data();
    const double* const z = columns_[column_up].data();
    const double* const vx = data(column_v_lateral);
    const double* const vz = data(column_v_up);
    const double* const radius = data(column_radius);
    const double floor = setup_.grid.min[up];
    const double* const density = data(column_density);
    const bool by_mass =
        density != nullptr && setup_.density_from == RunSetup::Density::mass_column;
    const std::size_t rules = setup_.settings.species.size();
    // Sums of the loop live in registers: stores into the fields could alias members.
    Run sums;
    double total = 0, inside = 0, farthest = 0;
    const auto& types = columns_[column_type];
    const bool one_type =
        std::adjacent_find(types.begin(), types.end(), std::not_equal_to<>()) == types.end();
    const int only = rows_ > 0 ? type_of(0) : 0;
    for (std::size_t i = 0; i < rows_; ++i) {
      const int of = one_type ? only : type_of(i);
      const double r = radius != nullptr ? radius[i] : radius_of(of);
      const double u = vx != nullptr ? vx[i] : 0;
      const double w = vz != nullptr ? vz[i] : 0;
      const double m = density != nullptr ? density[i] : 0;
      if (!std::isfinite(u + w + r + m)) {  // one test for nan and inf in any
        out_.flaws.not_finite.add(out_.snapshot, i, id(i));
        continue;
      }
      if (of != sums.type) {
        flush(sums);
        sums = {of, slot_of({of, -1}).fields.data(), {}};
      }
      const double volume = r > 0 ? sphere_volume(r) : 0;
      const double part = share(kernel, {x[i], y[i], z[i]}, r, u, w, sums.fields);
      if (!(part >= volume)) {  // not wholly inside: is it anywhere?
        if (!std::isfinite(x[i] + y[i] + z[i])) {
          out_.flaws.not_finite.add(out_.snapshot, i, id(i));
          continue;
        }
        farthest = std::max({farthest, std::abs(x[i]), std::abs(y[i]), std::abs(z[i])});
      }
      ++sums.solids.particles;
      if (r <= 0) {
        out_.flaws.no_size.add(out_.snapshot, i, id(i));
        continue;
      }
      const double mass = by_mass ? m : m * volume;
      sums.solids.volume += volume;
      sums.solids.moment += volume * (z[i] - floor);
      if (density != nullptr) {
        sums.solids.mass += mass;
        sums.solids.mass_moment += mass * (z[i] - floor);
      }
      total += volume;
      inside += part;
      for (std::size_t rule = 0; rule < rules; ++rule) {
        if (!setup_.settings.species[rule].holds(columns_[column_first_rule + rule][i])) continue;
        auto& chosen = slot_of({of, static_cast<int>(rule)});
        ++chosen.solids.particles;
        chosen.solids.add(volume, mass, z[i] - floor);
        share(kernel, {x[i], y[i], z[i]}, r, u, w, chosen.fields.data());
      }
    }
    flush(sums);
    if (density == nullptr)  // one density a type
      for (std::size_t s = 0; s < out_.used; ++s) {
        auto& slot = out_.slots[s];
        const double of_type = density_of(slot.key.type);
        slot.solids.mass = of_type * slot.solids.volume;
        slot.solids.mass_moment = of_type * slot.solids.moment;
      }
    out_.volume += total;
    out_.volume_inside += inside;
    out_.flaws.farthest = std::max(out_.flaws.farthest, farthest);
  }

  /// Sums over the particles of one type, until another type comes.
  struct Run {
    int type = std::numeric_limits<int>::min();
    double* fields = nullptr;
    SolidsSum solids;
  };

  void flush(const Run& run) {
    if (run.solids.particles > 0) slot_of({run.type, -1}).solids += run.solids;
  }

  double radius_of(int type) const { return of_type(setup_.settings.radius, type, "radius"); }

  double density_of(int type) const {
    if (setup_.density_from == RunSetup::Density::unknown) return readers::unknown;
    return of_type(setup_.density, type, "density");
  }

  double of_type(const ByType& values, int type, std::string_view quantity) const {
    const double value = values.at(type);
    if (std::isnan(value))
      throw InputError("run \"{}\": {} has no value for type {}, which occurs in the dumps",
                       setup_.settings.label, quantity, type);
    return value;
  }

  const double* data(std::size_t column) const {
    return columns_[column].empty() ? nullptr : columns_[column].data();
  }
  int type_of(std::size_t row) const {
    const auto& types = columns_[column_type];
    return types.empty() ? 0 : readers::whole_type(types[row]);
  }
  double id(std::size_t row) const {
    return columns_[column_id].empty() ? readers::unknown : columns_[column_id][row];
  }

  SlotProduct& slot_of(SlotKey key) {
    for (std::size_t s = 0; s < out_.used; ++s)
      if (out_.slots[s].key == key) return out_.slots[s];
    if (out_.slots.size() == out_.used) out_.slots.emplace_back();
    auto& slot = out_.slots[out_.used++];
    auto fields = std::move(slot.fields);
    auto profiles = std::move(slot.profiles);
    slot = {};
    slot.key = key;
    slot.fields = std::move(fields);
    slot.profiles = std::move(profiles);
    slot.fields.assign(quantities * setup_.grid.size(), 0.);
    return slot;
  }

  template <class Kernel>
  static double share(const Kernel& kernel, const Vec3& centre, double r, double u, double w,
                      double* fields) {
    return kernel.share(centre, r, [=](std::size_t cell, double volume) {
      double* const q = fields + quantities * cell;
      q[0] += volume;
      q[1] += volume * u;
      q[2] += volume * w;
    });
  }

  void add_temperature(std::size_t row, double t, SlotProduct& slot) {
    slot.temperature.add(t, out_.temperature_zero);
    warm_layer(row, t, slot);
    if (!setup_.settings.temperature) return;
    const auto [from, to] = *setup_.settings.temperature;
    const int bins = setup_.settings.temperature_bins;
    slot.histogram.resize(static_cast<std::size_t>(bins) + 1);
    slot.histogram.back() += 1;
    if (t < from || t > to) return;
    // Edges decide, not the rounding of a division: from + k width, the last bin closed.
    const double width = (to - from) / bins;
    int bin = std::min(static_cast<int>((t - from) / width), bins - 1);
    if (t < from + bin * width) --bin;
    if (bin + 1 < bins && t >= from + (bin + 1) * width) ++bin;
    slot.histogram[static_cast<std::size_t>(bin)] += 1;
  }

  /// Where the centre is outside the domain the particle counts in no layer.
  void warm_layer(std::size_t row, double t, SlotProduct& slot) {
    const auto& grid = setup_.grid;
    for (const auto& [axis, column] : {std::pair(lateral, column_lateral),
                                       std::pair(depth, column_depth), std::pair(up, column_up)})
      if (!(columns_[column][row] >= grid.min[axis] && columns_[column][row] <= grid.max[axis]))
        return;
    const double* const radius = data(column_radius);
    const double r = radius != nullptr ? radius[row] : radius_of(type_of(row));
    if (!(r > 0 && std::isfinite(r))) return;
    slot.warmth.resize(2 * static_cast<std::size_t>(grid.cells[up]));
    const double share = (columns_[column_up][row] - grid.min[up]) / grid.width(up);
    const int layer = std::min(static_cast<int>(share), grid.cells[up] - 1);
    double* const q = slot.warmth.data() + 2 * layer;
    q[0] += sphere_volume(r);
    q[1] += sphere_volume(r) * t;
  }

  const RunSetup& setup_;
  const std::vector<std::vector<double>>& columns_;
  std::size_t rows_;
  SnapshotProduct& out_;
  std::exception_ptr failure_;
};

/// Density of a slot relative to the first one's; 1 throughout where none is known.
std::vector<double> relative_densities(const SnapshotProduct& product) {
  std::vector<double> relative(product.used, 1);
  for (std::size_t s = 0; s < product.used; ++s) {
    const auto &slot = product.slots[s], &first = product.slots[0];
    const double ratio =
        slot.solids.mass / slot.solids.volume / (first.solids.mass / first.solids.volume);
    if (std::isfinite(ratio)) relative[s] = ratio;
  }
  return relative;
}

/// Volumes to holdups; profiles and depth averages on the way.
void reduce(const RunSetup& setup, SnapshotProduct& out, ProductScratch& scratch) {
  const auto& grid = setup.grid;
  const auto nx = static_cast<std::size_t>(grid.cells[lateral]);
  const auto ny = static_cast<std::size_t>(grid.cells[depth]);
  const auto nz = static_cast<std::size_t>(grid.cells[up]);
  const double per_cell = 1 / grid.cell_volume();
  const double per_column = 1 / static_cast<double>(ny);
  out.holdup.assign(nx * nz, 0.);
  scratch.mass.assign(nx * nz, 0.);
  scratch.mass_vx.assign(nx * nz, 0.);
  scratch.mass_vz.assign(nx * nz, 0.);
  const auto densities = relative_densities(out);
  for (std::size_t s = 0; s < out.used; ++s) {
    auto& slot = out.slots[s];
    const double per_column_mass = per_column * densities[s];
    const bool in_total = slot.key.rule < 0;
    slot.profiles.assign(2 * nz + 2 * nx * setup.heights.size(), 0.);
    double* q = slot.fields.data();
    for (std::size_t k = 0; k < nz; ++k) {
      double layer = 0, layer_v = 0;
      for (std::size_t j = 0; j < ny; ++j)
        for (std::size_t i = 0; i < nx; ++i, q += quantities) {
          for (std::size_t n = 0; n < quantities; ++n) q[n] *= per_cell;
          layer += q[0];
          layer_v += q[2];
          if (!in_total) continue;
          out.holdup[i + nx * k] += per_column * q[0];
          scratch.mass[i + nx * k] += per_column_mass * q[0];
          scratch.mass_vx[i + nx * k] += per_column_mass * q[1];
          scratch.mass_vz[i + nx * k] += per_column_mass * q[2];
        }
      slot.profiles[2 * k] = layer / static_cast<double>(nx * ny);
      slot.profiles[2 * k + 1] = layer_v / static_cast<double>(nx * ny);
    }
    for (std::size_t h = 0; h < setup.heights.size(); ++h) {
      double* const profile = slot.profiles.data() + 2 * nz + 2 * nx * h;
      for (std::size_t k = 0; k < nz; ++k) {
        const double weight = setup.band_weights[h][k] * per_column;
        if (weight == 0) continue;
        for (std::size_t j = 0; j < ny; ++j)
          for (std::size_t i = 0; i < nx; ++i) {
            const double* const cell = slot.fields.data() + quantities * (i + nx * (j + ny * k));
            profile[2 * i] += weight * cell[0];
            profile[2 * i + 1] += weight * cell[2];
          }
      }
    }
  }
}

/// Of all solids in each layer of cells.
std::vector<double> layer_holdups(const Grid& grid, const SnapshotProduct& product) {
  std::vector<double> layers(static_cast<std::size_t>(grid.cells[up]), 0);
  for (std::size_t s = 0; s < product.used; ++s)
    for (std::size_t k = 0; k < layers.size() && product.slots[s].key.rule < 0; ++k)
      layers[k] += product.slots[s].profiles[2 * k];
  return layers;
}

}  // namespace

bool ids_wanted(std::size_t i, std::size_t snapshots) {
  constexpr std::size_t sample = 16;
  return i % sample == 0 || i + 1 == snapshots;
}

void sum_snapshot(const RunSetup& setup, std::size_t i, SnapshotProduct& out,
                  ProductScratch& scratch) {
  const auto& wanted = setup.settings.wanted;
  out.snapshot = i;
  out.used = 0;
  out.volume = out.volume_inside = 0;
  out.without_temperature = 0;
  out.flaws = {};
  out.bytes_read = scratch.snapshot.bytes_read;
  Mapper mapper(setup, scratch.snapshot, out);
  std::visit([&](const auto& kernel) { mapper.run(kernel); }, *setup.kernel);
  mapper.temperatures();
  const auto& ids = scratch.snapshot.columns[column_id];
  if (!ids.empty()) readers::find_doubled_ids(ids, i, scratch.marks, out.flaws);
  readers::find_no_types(scratch.snapshot.columns[column_type], ids, i, out.flaws);
  reduce(setup, out, scratch);
  out.sensitivity = {};
  if (wanted.clusters) {
    const auto& thresholds = setup.settings.clusters;
    out.image = find_clusters(setup.grid, out.holdup, scratch.mass, scratch.mass_vx,
                              scratch.mass_vz, thresholds);
    if (sensitivity_wanted(i)) out.sensitivity.add(setup.grid, out.holdup, thresholds, out.image);
  }
  out.bed = bed_heights(setup.grid, layer_holdups(setup.grid, out));
  if (setup.settings.bubbles) out.bubbles = make_bubbles(setup, out.holdup, out.bed.surface);
}

void make_product(const RunSetup& setup, const readers::Series& series, std::size_t i,
                  SnapshotProduct& out, ProductScratch& scratch) {
  series.read(i, ids_wanted(i, series.size()) ? setup.request : setup.request_without_id,
              scratch.snapshot, scratch.reader);
  sum_snapshot(setup, i, out, scratch);
}

}  // namespace bedscope::analysis
