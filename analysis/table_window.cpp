// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "analysis/statistics.hpp"
#include "analysis/tables.hpp"
#include "analysis/time_window.hpp"
#include "readers/error.hpp"

namespace bedscope::analysis {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t block = 16;         // as the analysis of dumps begins its window
constexpr std::size_t least_series = 20;  // see steady_start

/// Times of the inventory, or of another series where there is none.
std::vector<double> times_of(const RunResult& run) {
  std::vector<double> times;
  const auto take = [&](const auto& rows, auto&& wanted) {
    if (!times.empty()) return;
    for (const auto& row : rows)
      if (wanted(row) && std::isfinite(row.time)) times.push_back(row.time);
  };
  const auto any = [](const auto&) { return true; };
  take(run.inventory, [&](const auto& row) { return row.type == run.inventory.front().type; });
  take(run.occurrence, any);
  take(run.temperature, [&](const auto& row) { return row.type == run.temperature.front().type; });
  take(run.bed.samples, any);
  take(run.gas.pressure, any);
  if (times.empty() && !run.series.empty()) times = run.series.front().times;
  std::sort(times.begin(), times.end());
  return times;
}

std::size_t steady_from(const RunResult& run, bool& steady) {
  std::vector<double> holdup, height;
  for (const auto& row : run.inventory) {
    if (row.type != run.inventory.front().type) continue;
    holdup.push_back(row.holdup);
    height.push_back(row.mean_height);
  }
  std::size_t start = 0;
  for (const auto& series : {holdup, height}) {
    if (series.size() < least_series) continue;
    const auto found = steady_start(series);
    if (found.constant) continue;
    start = std::max(start, found.start);
    steady = steady && found.steady;
  }
  return (start + block - 1) / block * block;
}

/// Mean of a member over the window.
template <class Row>
Estimate mean_within(const std::vector<Row>& rows, double Row::*member, const Window& window) {
  std::vector<double> times, values;
  for (const auto& row : rows) {
    if (!(row.time >= window.from && row.time <= window.to) || !std::isfinite(row.*member))
      continue;
    times.push_back(row.time);
    values.push_back(row.*member);
  }
  // Tables of another program may have their rows in any order.
  const bool ordered =
      std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end();
  return estimate_mean(values, ordered ? time_weights(times) : std::vector<double>(times.size(), 1))
      .estimate();
}

}  // namespace

void choose_window(RunResult& run, const std::optional<std::array<double, 2>>& average) {
  const auto times = times_of(run);
  const auto [from, to] = average.value_or(std::array{-infinity, infinity});
  if (times.empty()) {
    if (std::isfinite(from) && std::isfinite(to)) run.window = {.from = from, .to = to};
    return;
  }
  Window window{.from = from, .to = to, .automatic = !average};
  if (!average) {
    const std::size_t first = steady_from(run, window.steady);
    window.from = times[first < times.size() ? first : 0];
  }
  const double slack = times.size() > 1 ? 1e-6 * (times[1] - times[0]) : 0;  // rounded in tables
  std::vector<double> kept;
  for (const double time : times)
    if (time >= window.from - slack && time <= window.to + slack) kept.push_back(time);
  if (kept.empty())
    throw InputError(
        "run \"{}\": average: no time of its tables is in {} to {} s, they go from {} to {} s",
        run.label, from, to, times.front(), times.back());
  window.first =
      static_cast<std::size_t>(std::find(times.begin(), times.end(), kept.front()) - times.begin());
  window.snapshots = kept.size();
  window.from = kept.front();
  window.to = kept.back();
  run.window = window;
  run.bed.by_centre = mean_within(run.bed.samples, &BedHeightSample::by_centre, window);
  run.bed.surface = mean_within(run.bed.samples, &BedHeightSample::surface, window);
  run.bed.expansion = mean_within(run.bed.samples, &BedHeightSample::expansion, window);
  run.gas.pressure_drop = mean_within(run.gas.pressure, &PressureSample::drop, window);
}

}  // namespace bedscope::analysis
