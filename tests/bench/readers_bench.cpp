// SPDX-License-Identifier: BSD-3-Clause
// How fast a series is opened, and read by one thread: positions, velocities and radius of every
// snapshot of the folders named in BEDSCOPE_BENCH_INPUT (separated by colons), as bytes that came
// from disk and particles a second.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "readers/series.hpp"

namespace {
using namespace bedscope::readers;

std::vector<std::string> folders() {
  const char* named = std::getenv("BEDSCOPE_BENCH_INPUT");
  std::istringstream list(named != nullptr ? named : "");
  std::vector<std::string> found;
  for (std::string folder; std::getline(list, folder, ':');) found.push_back(folder);
  return found;
}

void each_folder(benchmark::internal::Benchmark* bench) {
  bench->Unit(benchmark::kMillisecond)->ArgName("folder");
  for (std::size_t i = 0; i < std::max<std::size_t>(folders().size(), 1); ++i)
    bench->Arg(static_cast<std::int64_t>(i));
}

/// The folder of this benchmark; empty, and said, where none is named.
std::string folder_of(benchmark::State& state) {
  const auto all = folders();
  if (all.empty()) {
    state.SkipWithError("BEDSCOPE_BENCH_INPUT names no folder of dumps");
    return {};
  }
  const auto& folder = all[static_cast<std::size_t>(state.range(0))];
  state.SetLabel(folder);
  return folder;
}

void open_series(benchmark::State& state) {
  const auto folder = folder_of(state);
  while (state.KeepRunning()) benchmark::DoNotOptimize(Series::open(folder).size());
}
BENCHMARK(open_series)->Apply(each_folder);

void read_series(benchmark::State& state) {
  const auto folder = folder_of(state);
  if (folder.empty()) return;
  const auto series = Series::open(folder);
  const Request request{{"x"}, {"z"}, {"vx"}, {"vz"}, {"radius"}};
  Snapshot snapshot;
  Scratch scratch;
  std::uint64_t bytes = 0, particles = 0;
  while (state.KeepRunning())
    for (std::size_t i = 0; i < series.size(); ++i) {
      series.read(i, request, snapshot, scratch);
      bytes += snapshot.bytes_read;
      particles += snapshot.particles;
      benchmark::DoNotOptimize(snapshot.columns.data());
    }
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes));
  state.SetItemsProcessed(static_cast<std::int64_t>(particles));
}
BENCHMARK(read_series)->Apply(each_folder);

}  // namespace
