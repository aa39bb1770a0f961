// SPDX-License-Identifier: BSD-3-Clause
// How fast a series is read by one thread: positions, velocities and radius of every snapshot of
// the folders named in BEDSCOPE_BENCH_INPUT (separated by colons), as bytes on disk a second.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <sstream>
#include <string>

#include "readers/series.hpp"

namespace {
using namespace bedscope::readers;

void read_series(benchmark::State& state, const std::string& folder) {
  const auto series = Series::open(folder);
  const Request request{{"x"}, {"z"}, {"vx"}, {"vz"}, {"radius"}};
  Snapshot snapshot;
  Scratch scratch;
  std::uint64_t bytes = 0, particles = 0;
  for (auto _ : state)
    for (std::size_t i = 0; i < series.size(); ++i) {
      series.read(i, request, snapshot, scratch);
      bytes += snapshot.bytes_read;
      particles += snapshot.particles;
      benchmark::DoNotOptimize(snapshot.columns.data());
    }
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes));
  state.SetItemsProcessed(static_cast<std::int64_t>(particles));
}

void open_series(benchmark::State& state, const std::string& folder) {
  for (auto _ : state) benchmark::DoNotOptimize(Series::open(folder).size());
}

}  // namespace

int main(int argc, char** argv) {
  const char* folders = std::getenv("BEDSCOPE_BENCH_INPUT");
  std::istringstream list(folders != nullptr ? folders : "");
  for (std::string folder; std::getline(list, folder, ':');) {
    benchmark::RegisterBenchmark(("open " + folder).c_str(), open_series, folder)
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("read " + folder).c_str(), read_series, folder)
        ->Unit(benchmark::kMillisecond);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
