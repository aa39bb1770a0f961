// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/gas_products.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bedscope::analysis {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

}  // namespace

GasSource::GasSource(const RunSetup& run, readers::GasSeries series)
    : run_(&run),
      axes_{run.settings.lateral, 3 - run.settings.lateral - run.settings.up, run.settings.up},
      series_(std::move(series)),
      setup_(set_up_gas(run.settings.label, run.settings.gas, series_)) {
  mesh_ = series_.mesh_at(0);
  mapping_ = std::make_shared<GasMapping>(*mesh_, run.grid, axes_);
}

std::shared_ptr<const GasMapping> GasSource::mapping_at(std::size_t time) const {
  const auto mesh = series_.mesh_at(time);
  if (mesh == mesh_) return mapping_;
  return std::make_shared<GasMapping>(*mesh, run_->grid, axes_);
}

void GasSource::read_voidage(std::size_t time, readers::FieldValues& out) const {
  const auto& fields = setup_.fields;
  series_.read(time, fields.voidage.empty() ? fields.solids : fields.voidage, 1, out);
  if (!fields.voidage.empty()) return;
  for (auto& value : out.values) value = 1 - value;
}

/// False where the run has no such field, or not at this time.
bool GasSource::read(std::size_t time, const std::string& field, unsigned components,
                     readers::FieldValues& out) const {
  if (field.empty() || !series_.has(time, field)) return false;
  series_.read(time, field, components, out);
  return true;
}

void GasSource::sum_fields(const GasMapping& mapping, const GasScratch& scratch, bool velocity,
                           bool temperature, bool pressure, GasProduct& out) const {
  const auto x = static_cast<std::size_t>(axes_[lateral]), z = static_cast<std::size_t>(axes_[up]);
  out.fields.assign(gas_quantities * run_->grid.size(), 0.);
  std::array<double, gas_quantities> q{};  // of one cell, per volume
  for (std::size_t c = 0; c < mapping.cells(); ++c) {
    const double eps = scratch.voidage.values[c];
    if (!std::isfinite(eps)) {
      ++out.not_finite;
      continue;
    }
    out.beyond += eps < 0 || eps > 1 + 1e-6;
    q = {1, eps, 0, 0, 0, 0, 0, 0, 0};
    if (velocity) {
      const double u = scratch.velocity.values[3 * c + x], w = scratch.velocity.values[3 * c + z];
      if (std::isfinite(u + w)) {
        q[gas_with_u] = eps;
        q[gas_flux_x] = eps * u;
        q[gas_flux_z] = eps * w;
      } else {
        ++out.not_finite;
      }
    }
    const auto add = [&](bool known, const readers::FieldValues& field, double factor,
                         std::size_t with, std::size_t sum) {
      if (!known) return;
      const double value = factor * field.values[c];
      if (std::isfinite(value)) {
        q[with] = eps;
        q[sum] = eps * value;
      } else {
        ++out.not_finite;
      }
    };
    add(temperature, scratch.temperature, 1, gas_with_t, gas_heat);
    add(pressure, scratch.pressure, setup_.pressure_factor, gas_with_p, gas_pressure);
    mapping.share(c, [&](std::size_t cell, double volume) {
      double* const sum = out.fields.data() + gas_quantities * cell;
      for (std::size_t n = 0; n < gas_quantities; ++n) sum[n] += volume * q[n];
    });
  }
}

void GasSource::sum_profiles(GasProduct& out) const {
  const auto& grid = run_->grid;
  const auto nx = static_cast<std::size_t>(grid.cells[lateral]);
  const auto ny = static_cast<std::size_t>(grid.cells[depth]);
  const auto nz = static_cast<std::size_t>(grid.cells[up]);
  out.profiles.assign(gas_quantities * (nz + nx * run_->heights.size()), 0.);
  const double* q = out.fields.data();
  for (std::size_t k = 0; k < nz; ++k)
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t i = 0; i < nx; ++i, q += gas_quantities) {
        for (std::size_t n = 0; n < gas_quantities; ++n)
          out.profiles[gas_quantities * k + n] += q[n];
        for (std::size_t h = 0; h < run_->heights.size(); ++h) {
          const double weight = run_->band_weights[h][k];
          if (weight == 0) continue;
          double* const column = out.profiles.data() + gas_quantities * (nz + nx * h + i);
          for (std::size_t n = 0; n < gas_quantities; ++n) column[n] += weight * q[n];
        }
      }
}

void GasSource::make_product(std::size_t time, bool averaged, GasProduct& out,
                             GasScratch& scratch) const {
  out.time = time;
  out.not_finite = out.beyond = 0;
  const auto mapping = mapping_at(time);
  const auto& fields = setup_.fields;
  const bool pressure = read(time, fields.pressure, 1, scratch.pressure);
  out.pressure_drop = pressure && !mapping->pressure_drop().empty() ? 0 : undefined;
  if (pressure)
    for (const auto& [cell, weight] : mapping->pressure_drop())
      out.pressure_drop += setup_.pressure_factor * weight * scratch.pressure.values[cell];
  if (!averaged) return;
  read_voidage(time, scratch.voidage);
  const bool velocity = read(time, fields.velocity, 3, scratch.velocity);
  const bool temperature = read(time, fields.temperature, 1, scratch.temperature);
  sum_fields(*mapping, scratch, velocity, temperature, pressure, out);
  sum_profiles(out);
}

void GasSource::make_check(const SnapshotProduct& particles, std::size_t time, JudgedCheck& check,
                           GasScratch& scratch) const {
  const auto mapping = mapping_at(time);
  read_voidage(time, scratch.voidage);
  const auto cells = run_->grid.size();
  scratch.holdup.assign(cells, 0.);
  double mass = 0, volume = 0, number = 0;
  for (std::size_t s = 0; s < particles.used; ++s) {
    const auto& slot = particles.slots[s];
    if (slot.key.rule >= 0) continue;
    for (std::size_t k = 0; k < cells; ++k) scratch.holdup[k] += slot.fields[3 * k];
    if (!(slot.solids.volume > 0)) continue;
    mass += slot.solids.mass;
    volume += slot.solids.volume;
    number += static_cast<double>(slot.solids.particles);
  }
  const double in_domain = particles.volume > 0 ? particles.volume_inside / particles.volume : 1;
  check.bed_mass = run_->density_from == RunSetup::Density::unknown ? undefined : mass * in_domain;

  // A slanting wall cuts cells of the grid, and their particles are on its inner side. Box meshes
  // end where they end: whether particles lie beyond is not known.
  if (!mapping->boxes()) {
    const auto filled = mapping->covered();
    for (std::size_t k = 0; k < cells; ++k)
      if (filled[k] > 0) scratch.holdup[k] *= run_->grid.cell_volume() / filled[k];
  }
  // To the mesh and back, and the voidage to the grid: volume, phi V, (1 - eps) V of each cell.
  std::vector<std::array<double, 3>> sums(cells);
  check.solids_volume = check.gas_side_volume = 0;
  double variance = 0;  // Poisson's, of phi v in V: phi v/V with v of one particle; integrated
  for (std::size_t c = 0; c < mapping->cells(); ++c) {
    const double solids = 1 - scratch.voidage.values[c];
    if (!std::isfinite(solids)) continue;
    double inside = 0, of_particles = 0;
    mapping->share(c, [&](std::size_t k, double part) {
      inside += part;
      of_particles += part * scratch.holdup[k];
    });
    if (inside <= 0) continue;
    check.solids_volume += of_particles;
    check.gas_side_volume += inside * solids;
    if (number > 0)
      variance += of_particles * (volume / number) / std::max(inside, run_->grid.cell_volume());
    mapping->share(c, [&](std::size_t k, double part) {
      sums[k][0] += part;
      sums[k][1] += part * (of_particles / inside);
      sums[k][2] += part * solids;
    });
  }
  double covered = 0, difference = 0, squares = 0, phi = 0, phi_squares = 0;
  check.largest_difference = 0;
  check.cells = 0;
  for (const auto& [v, of_particles, of_gas] : sums) {
    if (v <= 0) continue;
    const double mine = of_particles / v, d = mine - of_gas / v;  // eps - (1 - phi) = phi - (1-eps)
    ++check.cells;
    covered += v;
    difference += v * d;
    squares += v * d * d;
    phi += v * mine;
    phi_squares += v * mine * mine;
    check.largest_difference = std::max(check.largest_difference, std::abs(d));
  }
  check.mean_difference = difference / covered;
  check.rms_difference = std::sqrt(squares / covered);
  check.holdup = phi / covered;
  check.spread = std::sqrt(std::max(0., phi_squares / covered - check.holdup * check.holdup));
  check.noise = std::sqrt(variance / covered);
}

}  // namespace bedscope::analysis
