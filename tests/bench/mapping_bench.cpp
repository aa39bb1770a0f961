// SPDX-License-Identifier: BSD-3-Clause
// Time a particle of the mapping kernels, with the sum into the cells: volume, and volume times two
// components of velocity. Riser of 28 x 600 cells of 2.5 mm; 3-D: 28 x 3 x 600 of the same.
#include <benchmark/benchmark.h>

#include <array>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "analysis/mapping.hpp"

namespace {
using namespace bedscope::analysis;

struct Particle {
  Vec3 centre;
  double vx, vz;
};

std::vector<Particle> random_particles(const Grid& grid) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Particle> particles(50'000);
  for (Particle& p : particles) {
    for (int axis = 0; axis < 3; ++axis)
      p.centre[axis] = grid.min[axis] + grid.length(axis) * unit(random);
    p.vx = unit(random);
    p.vz = unit(random);
  }
  return particles;
}

/// Arguments: cells in depth; diameter in thousandths of a lateral cell.
void share(benchmark::State& state, const char* name) {
  const int in_depth = static_cast<int>(state.range(0));
  const Grid grid{{0, 0, 0}, {0.07, 0.0075, 1.5}, {28, in_depth, 600}, {}};
  const double radius = 0.5 * grid.width(lateral) * 1e-3 * static_cast<double>(state.range(1));
  const auto particles = random_particles(grid);
  std::vector<std::array<double, 3>> sums(grid.size());
  double inside = 0.0;
  std::visit(
      [&](const auto& kernel) {
        for (auto _ : state) {
          for (const Particle& p : particles)
            inside += kernel.share(p.centre, radius, [&](std::size_t cell, double volume) {
              auto& sum = sums[cell];
              sum[0] += volume;
              sum[1] += volume * p.vx;
              sum[2] += volume * p.vz;
            });
          benchmark::ClobberMemory();
        }
      },
      make_kernel(name, grid));
  benchmark::DoNotOptimize(inside);
  state.counters["time/particle"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * static_cast<double>(particles.size()),
      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(share, centre, "centre")->Args({1, 333})->Args({3, 333});
BENCHMARK_CAPTURE(share, exact, "exact")
    ->Args({1, 333})
    ->Args({1, 1000})
    ->Args({1, 3000})
    ->Args({3, 333})
    ->Args({3, 1000})
    ->Args({3, 3000});
BENCHMARK_CAPTURE(share, divided, "divided")->Args({1, 333})->Args({3, 333});
BENCHMARK_CAPTURE(share, gaussian, "gaussian")->Args({1, 333})->Args({3, 333});
}  // namespace
