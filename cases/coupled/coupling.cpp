// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/coupled/coupling.hpp"

#include <cmath>

#include "cases/coupled/closures.hpp"

namespace bedscope::coupled {

Coupling::Coupling(Gas& gas, Dem& dem, const CellFinder& finder, MPI_Comm comm, Timing& timing)
    : gas_(gas),
      dem_(dem),
      mapping_(finder, comm, gas.settings().divided),
      comm_(comm),
      timing_(timing) {}

void Coupling::map() {
  const Timing::Lap lap(timing_, Part::mapping);
  dem_.read(particles_);
  const int n = particles_.count();
  volume_.resize(n);
  for (int i = 0; i < n; ++i) volume_[i] = 4 * M_PI / 3 * std::pow(particles_.radius[i], 3);
  mapping_.map(n, particles_.position.data(), particles_.radius.data());
  std::vector<double> solids(gas_.cells(), 0.0);
  mapping_.deposit(volume_, solids, 1);
  gas_.set_solids(solids);
}

void Coupling::exchange() {
  const Timing::Lap lap(timing_, Part::drag);
  const int n = particles_.count();
  std::vector<double> cells, slip, voidage;
  gas_.get_velocity(cells);
  mapping_.gather(cells, slip, 3);
  mapping_.gather(gas_.voidage(), voidage, 1);
  for (int i = 0; i < 3 * n; ++i) slip[i] -= particles_.velocity[i];
  drag_coefficients(gas_.settings(), particles_.radius, voidage, slip, k_);

  std::vector<double> kv(3 * std::size_t(n));
  for (int i = 0; i < 3 * n; ++i) kv[i] = k_[i / 3] * particles_.velocity[i];
  std::vector<double> k_cells(gas_.cells(), 0.0), kv_cells(3 * std::size_t(gas_.cells()), 0.0);
  mapping_.deposit(k_, k_cells, 1);
  mapping_.deposit(kv, kv_cells, 3);
  gas_.set_exchange(k_cells, kv_cells);
  explicit_velocity_ = cells;
  if (!gas_.settings().energy) return;

  heat_coefficients(gas_.settings(), particles_.radius, voidage, slip, ha_);
  std::vector<double> hat(n), ha_cells(gas_.cells(), 0.0), hat_cells(gas_.cells(), 0.0);
  for (int i = 0; i < n; ++i) hat[i] = ha_[i] * particles_.temperature[i];
  mapping_.deposit(ha_, ha_cells, 1);
  mapping_.deposit(hat, hat_cells, 1);
  gas_.set_heat_exchange(ha_cells, hat_cells);
}

void Coupling::act() {
  const Timing::Lap lap(timing_, Part::drag);
  const Settings& settings = gas_.settings();
  const int n = particles_.count();
  std::vector<double> cells, u, gradient;
  gas_.get_velocity(cells);
  mapping_.gather(settings.implicit_drag ? cells : explicit_velocity_, u, 3);
  gas_.get_pressure_gradient(cells);
  mapping_.gather(cells, gradient, 3);
  force_.resize(3 * std::size_t(n));
  pressure_.resize(3 * std::size_t(n));
  for (int i = 0; i < n; ++i)
    for (int a = 0; a < 3; ++a) {
      const int j = 3 * i + a;
      pressure_[j] = mapping_.inside(i)
                         ? -volume_[i] * settings.gas_density * (gradient[j] + settings.gravity[a])
                         : 0;
      force_[j] = k_[i] * (u[j] - particles_.velocity[j]);
    }
  std::vector<double> total(force_);
  for (std::size_t j = 0; j < total.size(); ++j) total[j] += pressure_[j];
  dem_.set_force(particles_, total);
  if (!settings.energy) return;

  std::vector<double> gas_temperature;
  gas_.get_temperature(cells);
  mapping_.gather(cells, gas_temperature, 1);
  heat_.resize(n);
  for (int i = 0; i < n; ++i) heat_[i] = ha_[i] * (gas_temperature[i] - particles_.temperature[i]);
  dem_.set_heat(particles_, heat_);
}

void Coupling::output_fields() {
  const int n = particles_.count();
  std::vector<double> moment(3 * std::size_t(n));
  for (int i = 0; i < 3 * n; ++i) moment[i] = volume_[i / 3] * particles_.velocity[i];
  std::vector<double> volume(gas_.cells(), 0.0), velocity(3 * std::size_t(gas_.cells()), 0.0);
  mapping_.deposit(volume_, volume, 1);
  mapping_.deposit(moment, velocity, 3);
  for (std::size_t c = 0; c < volume.size(); ++c)
    for (int a = 0; a < 3; ++a) velocity[3 * c + a] /= volume[c] > 0 ? volume[c] : 1;
  gas_.set_solids_velocity(velocity);
}

ParticleSums Coupling::sums() const {
  const Vec3& g = gas_.settings().gravity;
  const double strength = std::hypot(g[0], g[1], g[2]);
  std::vector<double> sum(14, 0.0);
  for (int i = 0; i < particles_.count(); ++i) {
    const double m = particles_.mass[i];
    for (int a = 0; a < 3; ++a) {
      sum[a] += force_[3 * i + a];
      sum[3 + a] += pressure_[3 * i + a];
      sum[6 + a] += m * particles_.velocity[3 * i + a];
      if (strength > 0) sum[9] -= m * particles_.position[3 * i + a] * g[a] / strength;
    }
    sum[10] += m;
    sum[11] += volume_[i];
    if (!heat_.empty()) {
      sum[12] += heat_[i];
      sum[13] += particles_.temperature[i];
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), int(sum.size()), MPI_DOUBLE, MPI_SUM, comm_);
  long count = particles_.count();
  MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_LONG, MPI_SUM, comm_);
  ParticleSums result;
  result.drag = {sum[0], sum[1], sum[2]};
  result.pressure_force = {sum[3], sum[4], sum[5]};
  result.momentum = {sum[6], sum[7], sum[8]};
  result.mass = sum[10];
  result.volume = sum[11];
  result.height = sum[10] > 0 ? sum[9] / sum[10] : 0;
  result.heat = sum[12];
  result.temperature = count > 0 ? sum[13] / double(count) : 0;
  result.count = count;
  return result;
}

}  // namespace bedscope::coupled
