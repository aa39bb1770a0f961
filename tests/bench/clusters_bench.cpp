// SPDX-License-Identifier: BSD-3-Clause
// Cost of the clusters of one snapshot on the thesis' grid (28 x 600): budget 150 us, 30 us if
// none.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "analysis/clusters.hpp"
#include "analysis/tracks.hpp"

namespace bedscope::analysis {
namespace {

struct Field {
  Grid grid;
  std::vector<double> holdup, holdup_vx, holdup_vz;
};

/// A riser: dilute core, `clusters` bell-shaped clusters that thicken towards walls and bottom, and
/// noise from cell to cell as 50,000 particles make it.
Field riser(int clusters) {
  Field field;
  field.grid.cells = {28, 1, 600};
  field.grid.max = {0.07, 0.006, 1.5};
  field.holdup.assign(field.grid.size(), 0.0);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal(0, 1);
  struct Bell {
    double x, z, half_width, half_height, peak;
  };
  std::vector<Bell> bells;
  for (int n = 0; n < clusters; ++n) {
    const double side = uniform(random);
    bells.push_back({0.07 * (side < 0.4   ? 0.05
                             : side < 0.8 ? 0.95
                                          : uniform(random)),
                     1.5 * std::pow(uniform(random), 1.5), 0.004 + 0.006 * uniform(random),
                     0.006 + 0.02 * uniform(random), 0.35 + 0.25 * uniform(random)});
  }
  for (std::size_t cell = 0; cell < field.holdup.size(); ++cell) {
    const double x = field.grid.centre(lateral, static_cast<int>(cell % 28));
    const double z = field.grid.centre(up, static_cast<int>(cell / 28));
    double phi = 0.03;
    for (const Bell& bell : bells)
      phi += bell.peak * std::exp(-std::pow((x - bell.x) / bell.half_width, 2) -
                                  std::pow((z - bell.z) / bell.half_height, 2));
    field.holdup[cell] = std::max(0.0, std::min(phi, 0.6) * (1 + 0.25 * normal(random)));
  }
  field.holdup_vx.assign(field.holdup.size(), 0.01);
  for (const double phi : field.holdup) field.holdup_vz.push_back(-0.5 * phi);
  return field;
}

ClusterImage find(const Field& field, const ClusterThresholds& thresholds = {}) {
  return find_clusters(field.grid, field.holdup, field.holdup, field.holdup_vx, field.holdup_vz,
                       thresholds);
}

void report(benchmark::State& state, const ClusterImage& image) {
  state.counters["clusters"] = static_cast<double>(image.clusters.size());
  state.counters["cells"] =
      static_cast<double>(image.labels.size() - static_cast<std::size_t>(std::count(
                                                    image.labels.begin(), image.labels.end(), 0)));
}

void find_clusters_riser(benchmark::State& state) {
  const Field field = riser(static_cast<int>(state.range(0)));
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(find(field));
  report(state, find(field));
}
BENCHMARK(find_clusters_riser)->Arg(10)->Arg(30)->Arg(100)->Unit(benchmark::kMicrosecond);

void find_clusters_none(benchmark::State& state) {
  const Field field = riser(30);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(find(field, {2, 2, 60e-6}));
}
BENCHMARK(find_clusters_none)->Unit(benchmark::kMicrosecond);

/// Worst case: every other cell at random, each smallest region a cluster.
void find_clusters_noise(benchmark::State& state) {
  Field field = riser(0);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0, 0.4);
  for (double& phi : field.holdup) phi = uniform(random);
  const ClusterThresholds thresholds{0.3, 0.3, 0};
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(find(field, thresholds));
  report(state, find(field, thresholds));
}
BENCHMARK(find_clusters_noise)->Unit(benchmark::kMicrosecond);

void link_clusters_riser(benchmark::State& state) {
  const Field field = riser(static_cast<int>(state.range(0)));
  ClusterImage image = find(field);
  Tracker tracker(field.grid);
  double time = 0;
  for ([[maybe_unused]] auto _ : state) tracker.link(image, time += 0.01);
  report(state, image);
}
BENCHMARK(link_clusters_riser)->Arg(10)->Arg(30)->Arg(100)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace bedscope::analysis

BENCHMARK_MAIN();
