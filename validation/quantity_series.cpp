// SPDX-License-Identifier: BSD-3-Clause
// Single values, series in time and distributions of a run.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/bubbles.hpp"
#include "analysis/fluctuations.hpp"
#include "analysis/statistics.hpp"
#include "analysis/time_window.hpp"
#include "readers/error.hpp"
#include "validation/quantity_parts.hpp"

namespace bedscope::validation {
namespace {

using analysis::Estimate;
using analysis::RunResult;
using analysis::Signal;

constexpr int distribution_bins = 20;

Sampled single(const Estimate& estimate, Statistic statistic = Statistic::mean) {
  Sampled sampled{.at = {0}, .value = {estimate.value}, .is_scalar = true, .statistic = statistic};
  sampled.error_known = std::isfinite(estimate.ci95);
  sampled.u = {sampled.error_known ? estimate.ci95 / coverage_factor : 0};
  return sampled;
}

bool in_window(const RunResult& run, double time) {
  return run.window.snapshots == 0 || !std::isfinite(time) ||
         (time >= run.window.from && time <= run.window.to);
}

/// A member of the rows that are wanted, against time; rows without a value are left out.
template <class Row, class Value, class Wanted>
Signal series(const std::vector<Row>& rows, Value Row::*value, Wanted wanted) {
  Signal signal;
  for (const Row& row : rows) {
    const auto number = static_cast<double>(row.*value);
    if (!wanted(row) || !std::isfinite(number)) continue;
    signal.times.push_back(row.time);
    signal.values.push_back(number);
  }
  return signal;
}

bool ascending(const std::vector<double>& times) {
  return std::adjacent_find(times.begin(), times.end(),
                            [](double a, double b) { return !(a < b); }) == times.end();
}

/// Its mean, and what makes that or its interval doubtful.
Sampled mean_of(const RunResult& run, const std::string& what, const Signal& signal) {
  const auto weights = ascending(signal.times) ? analysis::time_weights(signal.times)
                                               : std::vector<double>(signal.times.size(), 1);
  const auto mean = analysis::estimate_mean(signal.values, weights);
  auto sampled = single(mean.estimate());
  const auto note = [&](const std::string& words) {
    sampled.notes.push_back(fmt::format("run \"{}\": {}: {}", run.label, what, words));
  };
  if (mean.few_samples && signal.values.size() > 1)
    note(fmt::format(
        "{:.3g} independent samples, too few for its interval to be trusted ({:.3g} are enough)",
        mean.independent_samples, mean.enough_samples));
  if (mean.disagree) note("batch means and autocorrelation time disagree on the error");
  const auto drift = analysis::drift_of(signal.values);
  if (drift.significance > analysis::significant_drift)
    note(fmt::format(
        "drifts by {:.3g} over the window ({:.3g} standard errors): it may not be steady",
        drift.change, drift.significance));
  return sampled;
}

/// Over the window, unless the analysis of dumps already knows it.
template <class Row, class Value>
Sampled window_mean(const RunResult& run, const Place& place, const Estimate& known,
                    const std::vector<Row>& rows, Value Row::*value) {
  if (std::isfinite(known.value)) return single(known);
  return mean_of(run, place.quantity,
                 series(rows, value, [&](const Row& row) { return in_window(run, row.time); }));
}

/// The same of rows that have a species.
template <class Row>
Sampled species_mean(const RunResult& run, const Place& place, const Estimate& known,
                     const std::vector<Row>& rows, double Row::*value) {
  if (place.species == "all" && std::isfinite(known.value)) return single(known);
  return mean_of(run, place.quantity, series(rows, value, [&](const Row& row) {
                   return row.type == place.species && in_window(run, row.time);
                 }));
}

/// A series as it is: each instant one value of one realisation, which has no error of a mean.
Sampled history(const Signal& signal) {
  Sampled sampled{.x = {"time", "s"}, .error_known = false};
  sampled.at = signal.times;
  sampled.value = signal.values;
  sampled.u.assign(signal.values.size(), 0);
  if (!ascending(signal.times)) return {.notes = {"its times are not known, or do not ascend"}};
  return sampled;
}

Sampled fluctuation(const Signal& signal, Statistic statistic) {
  std::vector<std::string> problems;
  if (signal.values.empty() || !ascending(signal.times)) return {};
  const auto found = analysis::fluctuation_of(signal, 0, problems);
  return single(statistic == Statistic::deviation ? found.deviation : found.dominant, statistic);
}

/// A property of clusters averaged over them; each snapshot's clusters count as one sample, so that
/// the interval takes their correlation in time into account.
Estimate cluster_mean(const RunResult& run, double analysis::Cluster::*property) {
  std::vector<double> sum(run.occurrence.size()), count(run.occurrence.size());
  for (const auto& cluster : run.clusters) {
    if (cluster.snapshot >= sum.size() || !std::isfinite(cluster.*property)) continue;
    sum[cluster.snapshot] += cluster.*property;
    count[cluster.snapshot] += 1;
  }
  std::vector<double> numerator, denominator;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (!in_window(run, run.occurrence[i].time)) continue;
    numerator.push_back(sum[i]);
    denominator.push_back(count[i]);
  }
  const std::vector<double> weights(numerator.size(), 1);
  return analysis::estimate_ratio(numerator, denominator, weights);
}

/// The mean of what there may be none of, which a run that looked for it is not blamed for.
Sampled seen(Sampled sampled, const char* what, std::size_t snapshots, bool looked_and_saw_none) {
  if (looked_and_saw_none)
    sampled.unseen = fmt::format("no {} in the {} snapshot{} of the window", what, snapshots,
                                 snapshots == 1 ? "" : "s");
  return sampled;
}

Sampled of_clusters(const RunResult& run, Sampled sampled) {
  std::size_t snapshots = 0;
  double clusters = 0;
  for (const auto& sample : run.occurrence) {
    if (!in_window(run, sample.time)) continue;
    snapshots += 1;
    clusters += static_cast<double>(sample.clusters);
  }
  return seen(std::move(sampled), "cluster", snapshots, snapshots > 0 && clusters == 0);
}

Sampled of_bubbles(const RunResult& run, const Estimate& estimate) {
  return seen(single(estimate), "bubble", run.window.snapshots,
              run.bubbles && run.bubbles->number.value == 0);
}

/// Of each bubble once in each snapshot; the interval takes the snapshots as samples.
template <class Property>
Estimate bubble_mean(const analysis::Bubbles& bubbles, Property property) {
  std::vector<double> times, sum, count;
  for (const auto& bubble : bubbles.bubbles) {
    if (times.empty() || bubble.time != times.back()) {
      times.push_back(bubble.time);
      sum.push_back(0);
      count.push_back(0);
    }
    const double value = property(bubble);
    if (!std::isfinite(value)) continue;
    sum.back() += value;
    count.back() += 1;
  }
  return analysis::estimate_ratio(sum, count, std::vector<double>(sum.size(), 1));
}

constexpr auto every = [](const auto&) { return true; };

Signal surface_of(const RunResult& run) {
  auto signal = series(run.bed.samples, &analysis::BedHeightSample::surface,
                       [&](const auto& row) { return in_window(run, row.time); });
  signal.name = "bed surface";
  signal.unit = "m";
  return signal;
}

Signal drop_of(const RunResult& run) {
  auto signal = series(run.gas.pressure, &analysis::PressureSample::drop,
                       [&](const auto& row) { return in_window(run, row.time); });
  signal.name = "pressure drop";
  signal.unit = "Pa";
  return signal;
}

/// The probe of at = { probe = n }, from 1; the only one where left out.
const analysis::Fluctuation& probe_of(const RunResult& run, const Place& place) {
  std::vector<const analysis::Fluctuation*> probes;
  for (const auto& one : run.fluctuations)
    if (one.signal.starts_with("p ")) probes.push_back(&one);
  if (probes.empty())
    throw InputError("run \"{}\": it has no probes: expected the key probes in the run", run.label);
  const auto wanted = place.at.find("probe");
  if (wanted == place.at.end() && probes.size() > 1)
    throw InputError("run \"{}\": expected at = {{ probe = 1 ... {} }}", run.label, probes.size());
  const double number = wanted == place.at.end() ? 1 : wanted->second;
  for (std::size_t k = 0; k < probes.size(); ++k)
    if (number == static_cast<double>(k + 1)) return *probes[k];
  throw InputError("run \"{}\": expected a probe from 1 to {}, found {}", run.label, probes.size(),
                   number);
}

}  // namespace

Sampled occurrence(const RunResult& run, const Place& place) {
  return window_mean(run, place, run.mean_occurrence, run.occurrence,
                     &analysis::OccurrenceSample::clusters);
}
Sampled cluster_holdup(const RunResult& run, const Place&) {
  return of_clusters(run, single(cluster_mean(run, &analysis::Cluster::holdup)));
}
Sampled cluster_velocity(const RunResult& run, const Place&) {
  return of_clusters(run, single(cluster_mean(run, &analysis::Cluster::velocity_z)));
}
Sampled mean_holdup(const RunResult& run, const Place& place) {
  return species_mean(run, place, run.mean_holdup, run.inventory,
                      &analysis::InventorySample::holdup);
}
Sampled inventory(const RunResult& run, const Place& place) {
  return species_mean(run, place, run.inventory_mass, run.inventory,
                      &analysis::InventorySample::solids_mass);
}
Sampled mean_temperature(const RunResult& run, const Place& place) {
  return species_mean(run, place, {}, run.temperature, &analysis::TemperatureSample::mean);
}
Sampled temperature_spread(const RunResult& run, const Place& place) {
  return species_mean(run, place, {}, run.temperature, &analysis::TemperatureSample::std);
}
Sampled pressure_drop(const RunResult& run, const Place& place) {
  return window_mean(run, place, run.gas.pressure_drop, run.gas.pressure,
                     &analysis::PressureSample::drop);
}
Sampled bed_voidage(const RunResult& run, const Place&) { return single(run.bed_voidage); }
Sampled bed_height(const RunResult& run, const Place& place) {
  return window_mean(run, place, run.bed.surface, run.bed.samples,
                     &analysis::BedHeightSample::surface);
}

Sampled bubble_number(const RunResult& run, const Place&) {
  return single(run.bubbles ? run.bubbles->number : Estimate{});
}
Sampled bubble_diameter(const RunResult& run, const Place&) {
  if (!run.bubbles || std::isfinite(run.bubbles->diameter.value))
    return single(run.bubbles ? run.bubbles->diameter : Estimate{});
  return of_bubbles(run, bubble_mean(*run.bubbles, analysis::equivalent_diameter));
}
Sampled bubble_velocity(const RunResult& run, const Place&) {
  if (!run.bubbles || std::isfinite(run.bubbles->velocity.value))
    return single(run.bubbles ? run.bubbles->velocity : Estimate{});
  return of_bubbles(run, bubble_mean(*run.bubbles, [](const analysis::Cluster& b) {
                      return b.track_velocity_z;
                    }));
}

Sampled bed_height_deviation(const RunResult& run, const Place&) {
  return fluctuation(surface_of(run), Statistic::deviation);
}
Sampled bed_height_frequency(const RunResult& run, const Place&) {
  return fluctuation(surface_of(run), Statistic::frequency);
}
Sampled pressure_drop_deviation(const RunResult& run, const Place&) {
  return fluctuation(drop_of(run), Statistic::deviation);
}
Sampled pressure_drop_frequency(const RunResult& run, const Place&) {
  return fluctuation(drop_of(run), Statistic::frequency);
}
Sampled probe_pressure_deviation(const RunResult& run, const Place& place) {
  return single(probe_of(run, place).deviation, Statistic::deviation);
}
Sampled probe_pressure_frequency(const RunResult& run, const Place& place) {
  return single(probe_of(run, place).dominant, Statistic::frequency);
}

Sampled bed_height_history(const RunResult& run, const Place&) {
  return history(series(run.bed.samples, &analysis::BedHeightSample::surface, every));
}
Sampled pressure_drop_history(const RunResult& run, const Place&) {
  return history(series(run.gas.pressure, &analysis::PressureSample::drop, every));
}
Sampled inventory_history(const RunResult& run, const Place& place) {
  return history(series(run.inventory, &analysis::InventorySample::solids_mass,
                        [&](const auto& row) { return row.type == place.species; }));
}
Sampled temperature_history(const RunResult& run, const Place& place) {
  return history(series(run.temperature, &analysis::TemperatureSample::mean,
                        [&](const auto& row) { return row.type == place.species; }));
}

Sampled series_mean(const RunResult& run, const Signal& signal) {
  Signal kept;
  for (std::size_t i = 0; i < signal.times.size(); ++i)
    if (in_window(run, signal.times[i]) && std::isfinite(signal.values[i])) {
      kept.times.push_back(signal.times[i]);
      kept.values.push_back(signal.values[i]);
    }
  return mean_of(run, signal.name, kept);
}
Sampled series_history(const Signal& signal) { return history(signal); }

/// Probability density of the clusters' lateral places in the domain, 0 to 1, over the window. Its
/// errors are those of the snapshots as samples, for a cluster is seen in many of them; at least
/// those of counts (Poisson), which also a bin has that saw none.
Sampled cluster_position(const RunResult& run, const Place&) {
  Sampled sampled{.x = {"x over width", "-"}, .is_distribution = true};
  std::vector<std::size_t> sample_of(run.occurrence.size());  // of each snapshot in the window
  std::size_t samples = 0;
  for (std::size_t i = 0; i < sample_of.size(); ++i)
    sample_of[i] = in_window(run, run.occurrence[i].time) ? samples++ : sample_of.size();
  std::vector<std::vector<double>> counts(distribution_bins, std::vector<double>(samples));
  std::vector<double> all(samples);
  const double low = run.grid.min[0], width = run.grid.max[0] - low;
  for (const auto& cluster : run.clusters) {
    const double share = (cluster.centre.x - low) / width;
    if (cluster.snapshot >= sample_of.size() || sample_of[cluster.snapshot] >= samples ||
        !(share >= 0 && share <= 1))
      continue;
    const auto bin = static_cast<std::size_t>(
        std::min<double>(share * distribution_bins, distribution_bins - 1));
    counts[bin][sample_of[cluster.snapshot]] += 1;
    all[sample_of[cluster.snapshot]] += 1;
  }
  const double total = std::accumulate(all.begin(), all.end(), 0.);
  if (total == 0) return of_clusters(run, std::move(sampled));
  const std::vector<double> weights(samples, 1);
  for (int k = 0; k < distribution_bins; ++k) {
    const double count = std::accumulate(counts[k].begin(), counts[k].end(), 0.);
    const double of_snapshots =
        analysis::estimate_ratio(counts[k], all, weights).ci95 / coverage_factor;
    sampled.at.push_back((k + .5) / distribution_bins);
    sampled.value.push_back(count / total * distribution_bins);
    sampled.u.push_back(std::fmax(std::sqrt(count + 1) / total, of_snapshots) * distribution_bins);
  }
  return sampled;
}

Sampled temperature_pdf(const RunResult& run, const Place& place) {
  const auto& species = species_of(run, place);
  std::vector<double> at;
  std::vector<Estimate> density;
  for (std::size_t k = 0; k < species.temperature_pdf.size(); ++k) {
    at.push_back((static_cast<double>(k) + .5) /
                 static_cast<double>(species.temperature_pdf.size()));
    density.push_back({species.temperature_pdf[k], k < species.temperature_pdf_ci95.size()
                                                       ? species.temperature_pdf_ci95[k]
                                                       : std::nan("")});
  }
  auto sampled = along("scaled temperature", "-", at, density);
  sampled.is_distribution = true;
  return sampled;
}

}  // namespace bedscope::validation
