// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/analyse_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "analysis/fluctuations.hpp"
#include "analysis/gas_run.hpp"
#include "analysis/in_order.hpp"
#include "analysis/kept_run.hpp"
#include "readers/error.hpp"

namespace bedscope::analysis {
namespace {

constexpr std::size_t most_frames = 8;

struct Item {
  SnapshotProduct product;
  ProductScratch scratch;
  std::optional<JudgedCheck> check;  // against the gas of the same time
  GasScratch gas_scratch;
};

struct GasItem {
  GasProduct product;
  GasScratch scratch;
};

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

IndexRange window_of(const RunSetup& setup) {
  if (!setup.settings.average) return {0, setup.times.size()};
  const auto [from, to] = *setup.settings.average;
  const auto window = select_window(setup.times, from, to, setup.half_step);
  if (window.count == 0)
    throw EmptyWindow(
        "run \"{}\": average: no snapshot between {} and {} s; the dumps run from {:.9g} to {:.9g} "
        "s",
        setup.settings.label, from, to, setup.times.front(), setup.times.back());
  return window;
}

/// Some snapshots of the window, evenly spread; those at hand are not read again.
std::vector<Frame> choose_frames(const RunSetup& setup, const readers::Series& series,
                                 const Window& window, const KeptRun& kept) {
  std::vector<Frame> frames;
  Item item;
  for (const auto place : readers::evenly_spread(window.snapshots, most_frames)) {
    const auto i = window.first + place;
    const auto found = std::find_if(kept.frames.begin(), kept.frames.end(),
                                    [i](const Frame& frame) { return frame.snapshot == i; });
    if (found != kept.frames.end()) {
      frames.push_back(*found);
    } else if (kept.whole.last && kept.whole.last->snapshot == i) {
      frames.push_back({i, setup.times[i], kept.whole.last->holdup});
    } else {
      make_product(setup, series, i, item.product, item.scratch);
      frames.push_back({i, setup.times[i], item.product.holdup});
    }
  }
  return frames;
}

/// A state larger than this serves only where it is smaller than the dumps.
constexpr std::uint64_t small_state = std::uint64_t{16} << 20;  // bytes

}  // namespace

struct LiveAnalysis::State {
  RunSettings settings;
  AnalysisOptions options;
  readers::DumpIndex index;
  std::optional<readers::Series> series;
  std::unique_ptr<RunSetup> setup;  // RunSums keep a pointer to it
  std::optional<KeptRun> kept;
  std::optional<GasRun> gas;
  std::vector<std::string> gas_times;  // their names, as last seen
  RunResult result;
  bool up_to_date = false;  // result is that of series
  double seconds = 0;
  bool live = true;  // update() will be called again

  State(RunSettings asked, AnalysisOptions how)
      : settings(std::move(asked)),
        options(std::move(how)),
        index(options.keep.earlier_index, options.keep.index) {}

  bool is_auto() const { return !settings.average.has_value(); }
  bool goes_on() const { return live || !options.keep.state.empty(); }
  void note(const std::string& text) const {
    if (options.note) options.note(text);
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

  bool update() {
    const auto started = std::chrono::steady_clock::now();
    auto found = readers::Series::open(settings.particles, {.repeated = settings.repeated,
                                                            .index = &index,
                                                            .columns = settings.columns,
                                                            .names_needed = true});
    found.thin(static_cast<std::size_t>(settings.every));
    auto gas_found = open_gas();
    if (up_to_date && same_steps(found, *series) && names_of(gas_found) == gas_times) return false;
    up_to_date = false;
    series.emplace(std::move(found));
    begin();
    gas_times = names_of(gas_found);
    if (gas_found) {
      if (!gas || kept->changed) gas.emplace(*setup);
      gas->set_series(std::move(*gas_found));
    }
    bool news = false;
    Window window;
    if (is_auto() && !evenly_spaced(setup->times)) {
      // The weight of a snapshot depends on where the window begins, so the run is read twice: once
      // to choose the window, once to average over it.
      window = add_all(kept->whole, window_weights(setup->times, {0, setup->times.size()}), news)
                   .choose_window();
      setup->settings.average = {setup->times[window.first], setup->times.back()};
      const auto weights = window_weights(setup->times, window_of(*setup));
      result = add_all(kept->window, weights, news).finish(*series, window);
      result.snapshots_kept = std::min(kept->whole.read_from, kept->window.read_from);
      setup->settings.average.reset();
    } else {
      const auto range = window_of(*setup);
      window = {.first = range.first, .snapshots = range.count};
      auto complete = add_all(kept->whole, window_weights(setup->times, range), news);
      if (is_auto()) window = complete.choose_window();
      result = std::move(complete).finish(*series, window);
      result.snapshots_kept = kept->whole.read_from;
    }
    result.label = settings.label;
    result.inputs = series->files();
    add_fluctuations(*setup, result);
    if (gas) add_gas();
    if (options.pictures) {
      result.frames = choose_frames(*setup, *series, result.window, *kept);
      kept->frames = result.frames;
    }
    if (news) save();
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    result.seconds = seconds;
    return up_to_date = true;
  }

  /// The setup of today, and what was kept as far as it fits.
  void begin() {
    auto now = set_up(settings, *series);
    if (setup) {
      *setup = std::move(now);
    } else {
      setup = std::make_unique<RunSetup>(std::move(now));
      kept.emplace(*setup, is_auto(), options.pictures);
      load();
    }
    const auto why =
        kept->adapt(fingerprint_of(*setup, options.pictures), mark_of(*series, *setup));
    if (!why.empty()) note(fmt::format("run \"{}\" begins anew: {}", settings.label, why));
  }

  void load() {
    std::error_code ignored;
    const auto& path = options.keep.earlier_state;
    if (path.empty() || !std::filesystem::exists(path, ignored)) return;
    try {
      kept->load(path);
    } catch (const Error& error) {
      kept.emplace(*setup, is_auto(), options.pictures);
      note(fmt::format("run \"{}\" begins anew: {}", settings.label, error.what()));
    }
  }

  void save() {
    try {
      index.save();
      const auto& path = options.keep.state;
      if (path.empty() || kept->dumps.snapshots.empty()) return;
      const auto size = kept->save(path);
      std::error_code ignored;
      if (size > small_state && size > result.bytes_read) std::filesystem::remove(path, ignored);
    } catch (const FileError& error) {
      std::error_code ignored;
      std::filesystem::remove(options.keep.state, ignored);
      note(fmt::format("{}: the next analysis will read all dumps again", error.what()));
    }
  }

  /// Adds what is new; the last snapshot, whose weight a successor would change, only to the copy
  /// that is returned.
  RunSums add_all(Pass& pass, const std::vector<double>& weights, bool& news) {
    if (!pass.sums) pass.begin();
    if (!pass.sums->added_with(weights)) {
      note(fmt::format("run \"{}\" begins anew: the window has moved", settings.label));
      pass.begin();
    }
    const std::size_t all = series->size();
    std::optional<RunSums> complete;
    const auto take = [&](SnapshotProduct& product) {
      const auto i = product.snapshot;
      if (i + 1 == all && goes_on()) {
        pass.last = product;
        pass.last->slots.resize(product.used);
        complete.emplace(*pass.sums);
      } else if (i + 1 == all) {
        complete.emplace(std::move(*pass.sums));
      }
      (complete ? *complete : *pass.sums).add(product, weights[i]);
      if (options.progress) options.progress(i + 1, all);
    };
    auto first = pass.snapshots();
    if (auto last = std::exchange(pass.last, std::nullopt);
        last && last->snapshot == first && ids_wanted(last->snapshot, all)) {
      take(*last);
      ++first;
    }
    pass.read_from = std::min(pass.read_from, first);
    news = news || first < all;
    for_each_product(*setup, *series, gas_run(), first, all, threads(), [&](Item& item) {
      if (item.check) gas->add_check(*item.check);
      take(item.product);
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

  int threads() const { return thread_count(options.threads); }
};

LiveAnalysis::LiveAnalysis(RunSettings settings, AnalysisOptions options)
    : state_(std::make_unique<State>(std::move(settings), std::move(options))) {}
LiveAnalysis::~LiveAnalysis() = default;
LiveAnalysis::LiveAnalysis(LiveAnalysis&&) noexcept = default;
bool LiveAnalysis::update() { return state_->update(); }
const RunResult& LiveAnalysis::result() const { return state_->result; }

RunResult analyse_run(const RunSettings& settings, const AnalysisOptions& options) {
  LiveAnalysis::State state(settings, options);
  state.live = false;
  state.update();
  return std::move(state.result);
}

}  // namespace bedscope::analysis
