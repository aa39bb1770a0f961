// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/fluctuations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/spectrum.hpp"
#include "analysis/statistics.hpp"
#include "analysis/time_window.hpp"
#include "readers/openfoam_tables.hpp"

namespace bedscope::analysis {
namespace {

/// Means over so many stretches tell the errors of a longer series as well: probes are sampled each
/// time step of the gas, hundreds of times as often as they change.
constexpr std::size_t most_stretches = 4096;

Estimate mean_of(std::span<const double> values, std::span<const double> weights) {
  const std::size_t each = (values.size() + most_stretches - 1) / most_stretches;
  std::vector<double> means, sums;
  for (std::size_t first = 0; first < values.size(); first += each) {
    double mean = 0, sum = 0;
    for (std::size_t i = first; i < std::min(first + each, values.size()); ++i) {
      mean += weights[i] * values[i];
      sum += weights[i];
    }
    means.push_back(mean / sum);
    sums.push_back(sum);
  }
  return estimate_mean(means, sums).estimate();
}

bool even(const std::vector<double>& times, double gap) {
  for (std::size_t i = 0; i < times.size(); ++i)
    if (std::abs(times[i] - times[0] - static_cast<double>(i) * gap) > 0.01 * gap) return false;
  return true;
}

/// The values at evenly spaced times.
std::vector<double> interpolated(const Signal& signal, double gap) {
  std::vector<double> values;
  std::size_t next = 1;
  for (std::size_t i = 0; i < signal.times.size(); ++i) {
    const double time = signal.times[0] + static_cast<double>(i) * gap;
    while (next + 1 < signal.times.size() && signal.times[next] < time) ++next;
    const double part =
        (time - signal.times[next - 1]) / (signal.times[next] - signal.times[next - 1]);
    values.push_back(std::lerp(signal.values[next - 1], signal.values[next], std::min(part, 1.)));
  }
  return values;
}

/// The part of a signal in the window; of samples at one time the last.
Signal within(const Signal& signal, double from, double to, double slack) {
  Signal part{signal.name, signal.unit, {}, {}};
  for (std::size_t i = 0; i < signal.times.size(); ++i) {
    if (signal.times[i] < from - slack || signal.times[i] > to + slack) continue;
    if (!part.times.empty() && signal.times[i] == part.times.back()) {
      part.values.back() = signal.values[i];
      continue;
    }
    part.times.push_back(signal.times[i]);
    part.values.push_back(signal.values[i]);
  }
  return part;
}

/// A member of all samples of a series, as a signal.
template <class Sample>
Signal signal_of(std::string name, std::string unit, const std::vector<Sample>& samples,
                 double Sample::*value) {
  Signal signal{std::move(name), std::move(unit), {}, {}};
  for (const Sample& sample : samples) {
    signal.times.push_back(sample.time);
    signal.values.push_back(sample.*value);
  }
  return signal;
}

/// The signals that every analysis of a bed has; a new one is a line here.
std::vector<Signal> signals_of(const RunResult& run) {
  std::vector<InventorySample> all;
  std::copy_if(run.inventory.begin(), run.inventory.end(), std::back_inserter(all),
               [](const InventorySample& sample) { return sample.type == "all"; });
  return {signal_of("mean height", "m", all, &InventorySample::mean_height),
          signal_of("bed surface", "m", run.bed.samples, &BedHeightSample::surface),
          signal_of("mean holdup", "-", all, &InventorySample::holdup)};
}

std::vector<Signal> pressure_probes(const RunSettings& settings,
                                    std::vector<std::string>& problems) {
  auto table = readers::open_foam_table(settings.probes, "p");
  problems.insert(problems.end(), table.problems.begin(), table.problems.end());
  problems.push_back(
      settings.gas.density
          ? fmt::format("probes: p is taken as p/rho and multiplied by gas_density, {} kg/m3",
                        *settings.gas.density)
          : "probes: p is taken as Pa; where it is p/rho, the key gas_density makes it so");
  std::vector<Signal> signals;
  for (auto& column : table.columns) {
    if (!column.words.empty() || (column.point && !table.points[*column.point].found)) continue;
    Signal signal{"p " + column.title, "Pa", table.times, std::move(column.values)};
    if (column.point) {
      const auto& place = table.points[*column.point].place;
      signal.name = fmt::format("p at ({} {} {}) m", place[0], place[1], place[2]);
    }
    for (double& value : signal.values) value *= settings.gas.density.value_or(1);
    signals.push_back(std::move(signal));
  }
  return signals;
}

}  // namespace

Fluctuation fluctuation_of(const Signal& signal, double segment,
                           std::vector<std::string>& problems) {
  Fluctuation found;
  found.signal = signal.name;
  found.unit = signal.unit;
  const std::size_t n = found.samples = signal.values.size();
  const auto weights = time_weights(signal.times);
  found.mean = mean_of(signal.values, weights);
  std::vector<double> squares;
  for (const double x : signal.values)
    squares.push_back((x - found.mean.value) * (x - found.mean.value));
  const auto variance = mean_of(squares, weights);
  found.deviation.value = std::sqrt(variance.value);
  if (!(found.deviation.value > 1e-9 * std::abs(found.mean.value))) {
    found.deviation = {0, variance.ci95 >= 0 ? 0 : variance.ci95};  // constant but for rounding
    return found;
  }
  found.deviation.ci95 = variance.ci95 / (2 * found.deviation.value);
  if (n < least_record) {
    problems.push_back(fmt::format("spectrum of {}: {} samples in the window, {} are needed",
                                   signal.name, n, least_record));
    return found;
  }
  const double gap = (signal.times.back() - signal.times.front()) / static_cast<double>(n - 1);
  std::vector<double> values = signal.values;
  if (!even(signal.times, gap)) {
    values = interpolated(signal, gap);
    problems.push_back(
        fmt::format("spectrum of {}: samples are uneven in time and interpolated linearly at every "
                    "{:.4g} s, which damps the highest frequencies",
                    signal.name, gap));
  }
  const auto wanted = static_cast<std::size_t>(std::max(segment / gap, 0.)) / 2 * 2;
  const std::size_t length =
      segment > 0 ? std::clamp<std::size_t>(wanted, 4, n / 2 * 2) : segment_length(values);
  found.spectrum = welch(values, gap, length);
  found.dominant = dominant_frequency(found.spectrum);
  if (found.spectrum.segments == 1)
    problems.push_back(
        fmt::format("spectrum of {}: the window holds only some {:.2g} periods of its dominant "
                    "frequency: one segment, whose interval is wide",
                    signal.name, found.dominant.value * gap * static_cast<double>(n)));
  return found;
}

void add_fluctuations(const RunSetup& setup, RunResult& result) {
  const auto& settings = setup.settings;
  if (!settings.spectra && settings.probes.empty()) return;
  if (!setup.time_known) {
    result.problems.emplace_back("no spectra: no time step is known");
    return;
  }
  auto signals = signals_of(result);
  if (!settings.probes.empty())
    for (auto& probe : pressure_probes(settings, result.problems))
      signals.push_back(std::move(probe));
  for (const Signal& whole : signals) {
    const auto signal = within(whole, result.window.from, result.window.to, setup.half_step);
    const bool finite = std::all_of(signal.values.begin(), signal.values.end(),
                                    [](double value) { return std::isfinite(value); });
    if (signal.values.empty() || !finite)
      result.problems.push_back(
          fmt::format("spectrum of {}: {}", whole.name,
                      finite ? "no sample in the averaging window" : "undefined at some times"));
    else
      result.fluctuations.push_back(
          fluctuation_of(signal, settings.segment.value_or(0), result.problems));
  }
}

}  // namespace bedscope::analysis
