// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/analyse_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "analysis/fluctuations.hpp"
#include "analysis/gas_run.hpp"
#include "analysis/run_sums.hpp"
#include "readers/error.hpp"

namespace bedscope::analysis {
namespace {

constexpr std::size_t most_frames = 8;

struct Item {
  SnapshotProduct product;
  ProductScratch scratch;
  std::optional<VoidageCheck> check;  // against the gas of the same time
  GasScratch gas_scratch;
};

struct GasItem {
  GasProduct product;
  GasScratch scratch;
};

/// Calls make(i, item) for each i in [first, last), in parallel on items of their own, and
/// take(item) in order.
template <class Made, class Make, class Take>
void for_each_in_order(std::size_t first, std::size_t last, int threads, Make&& make, Take&& take) {
  struct Job {
    Made item;
    std::exception_ptr error;
  };
  const auto make_job = [&](std::size_t i, Job& job) {
    try {
      make(i, job.item);
    } catch (...) {  // thrown again in the order of the series, whoever met it first
      job.error = std::current_exception();
    }
  };
  const auto deliver = [&](Job& job) {
    if (job.error) std::rethrow_exception(job.error);
    take(job.item);
  };
  if (threads == 1 || last - first < 2) {
    Job job;
    for (std::size_t i = first; i < last; ++i) {
      make_job(i, job);
      deliver(job);
    }
    return;
  }
  // Each thread takes the next snapshot and makes its product; whoever finishes the one whose turn
  // it is hands over all that are ready. One product more than threads, so that nobody waits for a
  // slow neighbour.
  std::vector<Job> items(static_cast<std::size_t>(threads) + 1);
  std::vector<Job*> idle;
  idle.reserve(items.size());
  for (auto& item : items) idle.push_back(&item);
  std::map<std::size_t, Job*> ready;
  std::mutex mutex;
  std::condition_variable delivered;
  std::size_t next = first, turn = first;
  std::exception_ptr failure;
  const auto work = [&] {
    std::unique_lock lock(mutex);
    while (true) {
      delivered.wait(lock, [&] { return !idle.empty() || next == last || failure; });
      if (next == last || failure) return;
      const std::size_t i = next++;
      Job* const item = idle.back();
      idle.pop_back();
      lock.unlock();
      make_job(i, *item);
      lock.lock();
      ready[i] = item;
      try {
        for (; !failure && !ready.empty() && ready.begin()->first == turn; ++turn) {
          idle.push_back(ready.begin()->second);
          ready.erase(ready.begin());
          deliver(*idle.back());
        }
      } catch (...) {
        failure = std::current_exception();
      }
      delivered.notify_all();
    }
  };
  {
    std::vector<std::jthread> team;
    team.reserve(static_cast<std::size_t>(threads));
    for (int k = 0; k < threads; ++k) team.emplace_back(work);
  }
  if (failure) std::rethrow_exception(failure);
}

/// Computes the products of snapshots [first, last) and their checks against the gas.
template <class Take>
void for_each_product(const RunSetup& setup, const readers::Series& series, const GasRun* gas,
                      std::size_t first, std::size_t last, int threads, Take&& take) {
  const auto matched = gas == nullptr ? std::vector<std::size_t>{} : gas->unchecked();
  const auto make = [&](std::size_t i, Item& item) {
    make_product(setup, series, i, item.product, item.scratch);
    item.check.reset();
    if (!std::binary_search(matched.begin(), matched.end(), i)) return;
    gas->make_check(item.product, item.check.emplace(), item.gas_scratch);
  };
  for_each_in_order<Item>(first, last, threads, make, take);
}

bool same_steps(const readers::Series& a, const readers::Series& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a.step(i) != b.step(i)) return false;
  return true;
}

/// Equal spacing (to rounding): then every snapshot weighs the same wherever the window begins.
bool evenly_spaced(const std::vector<double>& times) {
  if (times.size() < 3) return true;
  const double gap = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  for (std::size_t i = 1; i < times.size(); ++i)
    if (std::abs(times[i] - times[i - 1] - gap) > 1e-6 * gap) return false;
  return true;
}

IndexRange window_of(const RunSetup& setup) {
  if (!setup.settings.average) return {0, setup.times.size()};
  const auto [from, to] = *setup.settings.average;
  const auto window = select_window(setup.times, from, to, setup.half_step);
  if (window.count == 0)
    throw EmptyWindow(
        "run \"{}\": average: no snapshot between {} and {} s; the dumps run from {} to {} s",
        setup.settings.label, from, to, setup.times.front(), setup.times.back());
  return window;
}

/// A weight for every snapshot, 0 outside the window.
std::vector<double> weights_of(const RunSetup& setup, const IndexRange& window) {
  std::vector<double> weights(setup.times.size(), 0.);
  const auto inside = time_weights(std::span(setup.times).subspan(window.first, window.count));
  std::copy(inside.begin(), inside.end(),
            weights.begin() + static_cast<std::ptrdiff_t>(window.first));
  return weights;
}

void keep_frames(const RunSetup& setup, const readers::Series& series, RunResult& result) {
  const auto count = std::min(result.window.snapshots, most_frames);
  Item item;
  for (std::size_t k = 0; k < count; ++k) {
    const auto i =
        result.window.first + (count == 1 ? 0 : k * (result.window.snapshots - 1) / (count - 1));
    make_product(setup, series, i, item.product, item.scratch);
    result.frames.push_back({i, setup.times[i], item.product.holdup});
  }
}

}  // namespace

struct LiveAnalysis::State {
  RunSettings settings;
  AnalysisOptions options;
  std::optional<readers::Series> series;
  std::unique_ptr<RunSetup> setup;  // RunSums keep a pointer to it
  std::optional<RunSums> sums;      // of the snapshots whose weights are final: all but the last
  std::optional<GasRun> gas;
  std::vector<std::string> gas_times;  // their names, as last seen
  RunResult result;
  double seconds = 0;
  bool live = true;  // update() will be called again

  bool is_auto() const { return !settings.average.has_value(); }

  void begin() {
    setup = std::make_unique<RunSetup>(set_up(settings, *series));
    sums.emplace(*setup, is_auto(), options.pictures);
    gas.reset();
  }

  /// The gas as it is on disk now, if the run has any.
  std::optional<readers::GasSeries> open_gas() const {
    if (settings.gas.path.empty()) return std::nullopt;
    return readers::GasSeries::open(settings.gas.path, settings.gas.options);
  }

  static std::vector<std::string> names_of(const std::optional<readers::GasSeries>& series) {
    std::vector<std::string> names;
    if (series)
      for (const auto& time : series->times()) names.push_back(time.name);
    return names;
  }

  /// Whether the snapshots that were added are still the first ones of the series; one that came
  /// late, in the middle, means to begin anew.
  bool continues(const readers::Series& found) const {
    if (!sums || found.size() <= sums->snapshots()) return false;
    for (std::size_t i = 0; i < sums->snapshots(); ++i)
      if (found.step(i) != series->step(i)) return false;
    return true;
  }

  bool update() {
    const auto started = std::chrono::steady_clock::now();
    auto found = readers::Series::open(
        settings.particles,
        {.repeated = settings.repeated, .columns = settings.columns, .names_needed = true});
    auto gas_found = open_gas();
    const bool first_time = !series.has_value();
    if (!first_time && same_steps(found, *series) && names_of(gas_found) == gas_times) return false;
    const bool goes_on = !first_time && continues(found);
    series.emplace(std::move(found));
    if (goes_on)
      update_times(*setup, *series);
    else
      begin();
    gas_times = names_of(gas_found);
    if (gas_found) {
      if (!gas) gas.emplace(*setup);
      gas->set_series(std::move(*gas_found));
    }
    if (is_auto() && !evenly_spaced(setup->times)) {
      uneven_auto();
    } else {
      const auto range = window_of(*setup);
      Window window{.first = range.first, .snapshots = range.count};
      auto complete = add_all(weights_of(*setup, range));
      if (is_auto()) window = complete.choose_window();
      result = std::move(complete).finish(*series, window);
    }
    result.label = settings.label;
    result.inputs = series->files();
    add_fluctuations(*setup, result);
    if (gas) add_gas();
    if (options.pictures) keep_frames(*setup, *series, result);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    result.seconds = seconds;
    return true;
  }

  /// Adds what is new; the last snapshot, whose weight a successor would change, only to the copy
  /// that is returned.
  RunSums add_all(const std::vector<double>& weights) {
    const std::size_t all = series->size();
    std::optional<RunSums> complete;
    for_each_product(*setup, *series, gas_run(), sums->snapshots(), all, threads(),
                     [&](Item& item) {
                       auto& product = item.product;
                       if (item.check) gas->add_check(*item.check);
                       const auto i = product.snapshot;
                       if (i + 1 == all) {
                         if (live)
                           complete.emplace(*sums);
                         else
                           complete.emplace(std::move(*sums));
                       }
                       (complete ? *complete : *sums).add(product, weights[i]);
                       if (options.progress) options.progress(i + 1, all);
                     });
    return std::move(*complete);
  }

  const GasRun* gas_run() const { return gas ? &*gas : nullptr; }

  /// The gas over the window of the particles, and what its times came too late for.
  void add_gas() {
    const auto late = gas->unchecked();
    for_each_in_order<Item>(
        0, late.size(), threads(),
        [&](std::size_t k, Item& item) {
          make_product(*setup, *series, late[k], item.product, item.scratch);
          gas->make_check(item.product, item.check.emplace(), item.gas_scratch);
        },
        [&](Item& item) { gas->add_check(*item.check); });
    gas->begin_window(result.window);
    const auto times = gas->todo();
    for_each_in_order<GasItem>(
        0, times.size(), threads(),
        [&](std::size_t k, GasItem& item) {
          gas->make_product(times[k], item.product, item.scratch);
        },
        [&](GasItem& item) { gas->add_product(item.product); });
    gas->finish(*series, result);
  }

  /// With uneven spacing the weight of a snapshot depends on where the window begins, so the run is
  /// read twice: once to choose the window, once to average over it.
  void uneven_auto() {
    sums.emplace(*setup, true, options.pictures);
    const auto window = add_all(weights_of(*setup, {0, setup->times.size()})).choose_window();
    setup->settings.average = {setup->times[window.first], setup->times.back()};
    const auto range = window_of(*setup);
    sums.emplace(*setup, false, options.pictures);
    result = add_all(weights_of(*setup, range)).finish(*series, window);
    setup->settings.average.reset();
    sums.emplace(*setup, true, options.pictures);
  }

  int threads() const {
    return options.threads > 0 ? options.threads
                               : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }
};

LiveAnalysis::LiveAnalysis(RunSettings settings, AnalysisOptions options)
    : state_(std::make_unique<State>()) {
  state_->settings = std::move(settings);
  state_->options = std::move(options);
}
LiveAnalysis::~LiveAnalysis() = default;
LiveAnalysis::LiveAnalysis(LiveAnalysis&&) noexcept = default;
bool LiveAnalysis::update() { return state_->update(); }
const RunResult& LiveAnalysis::result() const { return state_->result; }

RunResult analyse_run(const RunSettings& settings, const AnalysisOptions& options) {
  LiveAnalysis::State state;
  state.settings = settings;
  state.options = options;
  state.live = false;
  state.update();
  return std::move(state.result);
}

}  // namespace bedscope::analysis
