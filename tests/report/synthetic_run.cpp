// SPDX-License-Identifier: BSD-3-Clause
#include "tests/report/synthetic_run.hpp"

#include <cmath>
#include <limits>

namespace bedscope::tests {

using analysis::RunResult;

namespace {

constexpr double density = 2500, nan = std::numeric_limits<double>::quiet_NaN();

/// Holdup and velocity at a place of the unit square.
double holdup_at(double x, double z, double shift) {
  const double wall = 1 + 3 * std::pow(2 * x - 1, 4);
  return z > 0.98 ? 0.0 : (0.02 + shift + 0.08 * std::exp(-6 * z)) * wall;
}
double velocity_at(double x) { return 2.5 - 4 * std::pow(2 * x - 1, 2); }

analysis::Profile profile(const analysis::Grid& grid, int axis, double at, double share,
                          double shift) {
  analysis::Profile found;
  for (int i = 0; i < grid.cells[axis]; ++i) {
    const double place = (i + 0.5) / grid.cells[axis];
    const double x = axis == analysis::up ? at : place, z = axis == analysis::up ? place : at;
    const double holdup = share * holdup_at(x, z, shift);
    const double velocity = holdup > 0 ? velocity_at(x) : nan;
    found.coordinate.push_back(grid.centre(axis, i));
    found.holdup.push_back({holdup, 0.1 * holdup});
    found.velocity_z.push_back({velocity, holdup > 0 ? 0.15 : nan});
    found.mass_flux_z.push_back({holdup > 0 ? density * holdup * velocity : 0, 4});
  }
  return found;
}

analysis::SpeciesResult species(const RunResult& run, const std::string& type, double share,
                                const SyntheticOptions& options) {
  analysis::SpeciesResult found;
  found.type = type;
  found.axial = profile(run.grid, analysis::up, 0.5, share, options.shift);
  for (const double height : run.heights) {
    found.lateral.push_back(profile(run.grid, analysis::lateral,
                                    height / run.grid.length(analysis::up), share, options.shift));
  }
  for (int k = 0; k < run.grid.cells[2]; ++k) {
    for (int j = 0; j < run.grid.cells[1]; ++j) {
      for (int i = 0; i < run.grid.cells[0]; ++i) {
        const double x = (i + 0.5) / run.grid.cells[0], z = (k + 0.5) / run.grid.cells[2];
        const double holdup = share * holdup_at(x, z, options.shift);
        const double velocity = holdup > 0 ? velocity_at(x) : nan;
        found.fields.holdup.push_back(holdup);
        found.fields.velocity_x.push_back(holdup > 0 ? 0 : nan);
        found.fields.velocity_z.push_back(velocity);
        found.fields.mass_flux_x.push_back(0);
        found.fields.mass_flux_z.push_back(holdup > 0 ? density * holdup * velocity : 0);
      }
    }
  }
  for (int b = 0; b < 25 && options.temperature; ++b) {
    const double place = (b + 0.5) / 25 - 0.5;
    found.temperature_pdf.push_back(std::exp(-place * place / 0.02) / std::sqrt(0.02 * M_PI));
  }
  return found;
}

analysis::Cluster cluster(const RunResult& run, std::size_t snapshot, int number) {
  analysis::Cluster found;
  const double phase = 0.7 * static_cast<double>(snapshot) + 2.3 * number;
  const double wall = 0.5 + 0.45 * std::sin(phase);
  const double w = run.grid.width(analysis::lateral), h = run.grid.width(analysis::up);
  found.snapshot = snapshot;
  found.time = run.occurrence[snapshot].time;
  found.cluster = found.track = number;
  found.centre = {run.grid.length(analysis::lateral) * wall,
                  run.grid.length(analysis::up) * (0.1 + 0.8 * std::fmod(0.37 * phase, 1))};
  found.area = 6 * w * h;
  found.holdup = 0.3 + 0.05 * std::sin(3 * phase);
  found.holdup_max = 0.5;
  found.velocity_z = velocity_at(wall) + 0.5 * std::sin(5 * phase);
  found.major = 4 * h;
  found.minor = 2 * w;
  found.angle = 1 + 0.4 * std::sin(phase);
  const auto [x, z] = found.centre;
  found.contours = {
      {{x - w, z - h}, {x + w, z - h}, {x + w, z + h}, {x - w, z + h}, {x - w, z - h}}};
  return found;
}

void add_series(RunResult& run, const SyntheticOptions& options) {
  for (int s = 0; s < options.snapshots; ++s) {
    const double time = 0.05 * s, mass = 0.04 * (1 - 0.5 * std::exp(-time));
    for (const std::string& type : run.types) {
      run.inventory.push_back({time, type, 50000, mass, mass / density / run.grid.volume(),
                               0.6 + 0.05 * std::sin(time)});
      if (!options.temperature) continue;
      run.temperature.push_back({time, type, 345 + 5 * std::sin(time), 4, 330, 360});
    }
    const int clusters = options.clusters_each == 0 ? 0 : options.clusters_each + s % 3;
    run.occurrence.push_back({time, clusters, 0.01 * clusters});
  }
}

}  // namespace

RunResult synthetic_run(const SyntheticOptions& options) {
  RunResult run;
  run.label = options.label;
  run.grid = {{0, 0, 0}, {0.07, 0.006, 1.57}, options.cells, {}};
  run.types = {"all"};
  if (options.two_types) run.types = {"all", "1", "2"};
  run.heights = {0.3, 1.2};
  run.band = 0.01;
  const double shares[] = {1, 0.7, 0.3};
  for (std::size_t t = 0; t < run.types.size(); ++t) {
    run.species.push_back(species(run, run.types[t], shares[t], options));
  }
  add_series(run, options);
  const auto first = static_cast<std::size_t>(options.snapshots / 2);
  run.window = {run.occurrence[first].time,
                run.occurrence.back().time,
                first,
                run.occurrence.size() - first,
                false,
                true};
  for (std::size_t s = first; s < run.occurrence.size(); ++s) {
    for (int c = 1; c <= run.occurrence[s].clusters; ++c)
      run.clusters.push_back(cluster(run, s, c));
    if ((s - first) % 15 == 0 && run.frames.size() < 8) {
      run.frames.push_back({s, run.occurrence[s].time, run.species[0].fields.holdup});
    }
  }
  run.temperature_from = 330;
  run.temperature_to = 380;
  run.mean_holdup = {0.0255, 0.00031};
  run.inventory_mass = {0.0402, 0.0005};
  run.mean_occurrence = {5.02, 0.21};
  run.independent_samples = 23.4;
  return run;
}

}  // namespace bedscope::tests
