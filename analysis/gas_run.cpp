// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/gas_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/statistics.hpp"
#include "analysis/time_window.hpp"
#include "readers/error.hpp"

namespace bedscope::analysis {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

}  // namespace

/// Whether all that was summed so far is still the beginning of what is there now.
bool GasRun::continues(const GasSource& old) const {
  const auto &before = old.setup(), &now = source_->setup();
  const auto same = [](const GasFieldNames& a, const GasFieldNames& b) {
    return a.voidage == b.voidage && a.solids == b.solids && a.velocity == b.velocity &&
           a.pressure == b.pressure && a.temperature == b.temperature;
  };
  if (!same(before.fields, now.fields) || before.times > now.times) return false;
  const auto &a = old.series().times(), &b = source_->series().times();
  return std::equal(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(before.times), b.begin(),
                    [](const auto& x, const auto& y) { return x.name == y.name; });
}

void GasRun::set_series(readers::GasSeries series) {
  if (!run_->time_known)
    throw InputError("run \"{}\": gas: time_step is missing, which puts particles on its clock",
                     run_->settings.label);
  const auto old = std::move(source_);
  source_ = std::make_unique<GasSource>(*run_, std::move(series));
  if (old && !continues(*old)) {
    checks_.clear();
    drops_.clear();
    sums_ = {};
    next_ = first_ = last_ = 0;
  }
  places_.clear();
  times_.clear();
  const auto& fields = source_->setup().fields;
  for (std::size_t t = 0; t < source_->setup().times; ++t) {
    if (!source_->series().has(t, fields.voidage.empty() ? fields.solids : fields.voidage))
      continue;
    places_.push_back(t);
    times_.push_back(source_->series().times()[t].time);
  }
  match();
}

void GasRun::match() {
  tolerance_ = run_->half_step;
  if (times_.size() > 1)
    tolerance_ = std::max(tolerance_, 1e-6 * (times_.back() - times_.front()) /
                                          static_cast<double>(times_.size() - 1));
  gas_of_.assign(run_->times.size(), none);
  for (std::size_t i = 0; i < run_->times.size(); ++i) {
    const double time = run_->times[i];
    auto found = std::lower_bound(times_.begin(), times_.end(), time);
    if (found != times_.begin() && (found == times_.end() || time - *(found - 1) < *found - time))
      --found;
    if (found != times_.end() && std::abs(*found - time) <= tolerance_)
      gas_of_[i] = static_cast<std::size_t>(found - times_.begin());
  }
}

void GasRun::make_check(const SnapshotProduct& product, JudgedCheck& check,
                        GasScratch& scratch) const {
  check.snapshot = product.snapshot;
  check.time = run_->times[product.snapshot];
  source_->make_check(product, places_[gas_of_[product.snapshot]], check, scratch);
}

std::vector<std::size_t> GasRun::unchecked() const {
  std::vector<std::size_t> late;
  for (std::size_t i = 0; i < gas_of_.size(); ++i)
    if (gas_of_[i] != none && !checks_.contains(i)) late.push_back(i);
  return late;
}

void GasRun::begin_window(const Window& window) {
  double from = run_->times[window.first];
  double to = run_->times[window.first + window.snapshots - 1];
  if (const auto& average = run_->settings.average) {
    if (std::isfinite((*average)[0])) from = (*average)[0];
    if (std::isfinite((*average)[1])) to = (*average)[1];
  }
  const auto range = select_window(times_, from, to, tolerance_);
  const auto last = range.first + range.count;
  if (range.first != first_ || next_ >= std::max(last, std::size_t{1})) {
    sums_ = {};
    next_ = range.first;
  }
  next_ = std::max(next_, range.first);
  start_ = next_;
  first_ = range.first;
  last_ = last;
  weights_ = time_weights(std::span(times_).subspan(first_, last_ - first_));
  complete_ = {};
}

std::vector<std::size_t> GasRun::todo() const {
  std::vector<std::size_t> list;
  const bool pressure = !source_->setup().fields.pressure.empty();
  for (std::size_t n = 0; n < times_.size(); ++n)
    if (to_average(n) || (pressure && !drops_.contains(n))) list.push_back(n);
  return list;
}

void GasRun::make_product(std::size_t n, GasProduct& product, GasScratch& scratch) const {
  source_->make_product(places_[n], to_average(n), product, scratch);
  product.time = n;
}

void GasRun::add_product(const GasProduct& product) {
  const auto n = product.time;
  drops_[n] = product.pressure_drop;
  if (!to_average(n)) return;
  const double weight = weights_[n - first_];
  if (n + 1 == last_) {  // a successor would change its weight
    complete_ = sums_;
    complete_.add(product, weight);
  } else {
    sums_.add(product, weight);
    next_ = n + 1;
  }
}

void GasRun::checks_of(RunResult& result) const {
  auto& gas = result.gas;
  std::vector<double> particles, fields, times;
  for (const auto& [snapshot, check] : checks_) {
    gas.checks.push_back(check);
    if (snapshot < result.window.first || snapshot >= result.window.first + result.window.snapshots)
      continue;
    particles.push_back(check.solids_volume);
    fields.push_back(check.gas_side_volume);
    times.push_back(check.time);
  }
  if (!times.empty()) gas.voidage_ratio = estimate_ratio(particles, fields, time_weights(times));
  if (checks_.empty() && !times_.empty())
    result.problems.push_back(fmt::format(
        "gas: none of its times ({} to {} s) is that of a snapshot ({} to {} s), to {:.2g} s: no "
        "voidage check, no bed weight",
        times_.front(), times_.back(), run_->times.front(), run_->times.back(), tolerance_));
}

void GasRun::pressures_of(RunResult& result) const {
  auto& gas = result.gas;
  const auto& grid = run_->grid;
  const double by_area = run_->settings.gas.gravity / (grid.length(lateral) * grid.length(depth));
  std::vector<double> drops, bed, weights;
  auto next = gas.checks.begin();  // the first matched snapshot that is not earlier
  for (const auto& [n, drop] : drops_) {
    if (!gas.has_pressure) break;
    const double time = times_[n];
    while (next != gas.checks.end() && next->time < time) ++next;
    auto nearest = next;
    if (next != gas.checks.begin() &&
        (next == gas.checks.end() || time - (next - 1)->time < next->time - time))
      --nearest;
    const double weight = gas.checks.empty() ? undefined : nearest->bed_mass * by_area;
    gas.pressure.push_back({time, drop, weight});
    if (!in_window(n) || !std::isfinite(drop)) continue;
    drops.push_back(drop);
    bed.push_back(weight);
    weights.push_back(weights_[n - first_]);
  }
  gas.pressure_drop = estimate_mean(drops, weights).estimate();
  gas.bed_weight_by_area = undefined;
  if (!bed.empty() &&
      std::all_of(bed.begin(), bed.end(), [](double w) { return std::isfinite(w); }))
    gas.bed_weight_by_area = estimate_mean(bed, weights).value;
  if (gas.has_pressure && source_->mapping().pressure_drop().empty())
    result.problems.emplace_back(
        "gas: fewer than two layers of cells in the domain: no pressure drop");
}

void GasRun::finish(const readers::Series& particles, RunResult& result) const {
  auto& gas = result.gas;
  const auto& fields = source_->setup().fields;
  const auto& series = source_->series();
  gas.present = true;
  gas.times = last_ - first_;
  gas.from = gas.times > 0 ? times_[first_] : undefined;
  gas.to = gas.times > 0 ? times_[last_ - 1] : undefined;
  gas.has_velocity = !fields.velocity.empty();
  gas.has_temperature = !fields.temperature.empty();
  gas.has_pressure = !fields.pressure.empty();
  for (const auto& problem : series.problems()) result.problems.push_back("gas: " + problem);
  for (const auto& problem : source_->setup().problems) result.problems.push_back(problem);
  if (gas.times == 0)
    result.problems.push_back(fmt::format(
        "gas: no time in the averaging window ({} to {} s); its times run from {} to {} s",
        result.window.from, result.window.to, times_.front(), times_.back()));
  complete_.finish(*run_, result);
  checks_of(result);
  pressures_of(result);
  tell_cover(result);
  tell_clock(result);
  if (!tell_ratio(result)) tell_shift(particles, result);
  for (const auto place : places_)
    for (const auto& field :
         {fields.voidage + fields.solids, fields.velocity, fields.pressure, fields.temperature})
      if (!field.empty() && series.has(place, field))
        for (auto& file : series.files(place, field)) result.inputs.push_back(std::move(file));
}

}  // namespace bedscope::analysis
