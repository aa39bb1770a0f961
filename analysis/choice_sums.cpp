// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/choice_sums.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/in_order.hpp"
#include "analysis/snapshot_products.hpp"
#include "analysis/time_window.hpp"

namespace bedscope::analysis {
namespace {

using Layout = ChoiceLayout;

Layout layout_of(const RunSetup& setup) {
  const auto& grid = setup.grid;
  Layout layout;
  layout.layers = static_cast<std::size_t>(grid.cells[up]);
  layout.columns = static_cast<std::size_t>(grid.cells[lateral]);
  layout.heights = setup.heights.size();
  if (setup.has_temperature && setup.settings.temperature)
    layout.bins = static_cast<std::size_t>(setup.settings.temperature_bins);
  for (int k = 0; k < grid.cells[up]; ++k) layout.z.push_back(grid.centre(up, k));
  for (int i = 0; i < grid.cells[lateral]; ++i) layout.x.push_back(grid.centre(lateral, i));
  return layout;
}

/// What one snapshot adds, summed over its types.
void pack(const SnapshotProduct& product, const RunSetup& setup, const Layout& layout,
          std::vector<double>& out) {
  out.assign(layout.size(), 0.);
  const std::size_t points = layout.layers + layout.columns * layout.heights;
  double* const single = out.data() + layout.single_first();
  double mass = 0, warmth = 0, squares = 0, particles = 0;
  for (std::size_t s = 0; s < product.used; ++s) {
    const auto& slot = product.slots[s];
    if (slot.key.rule >= 0) continue;
    const double density = slot.solids.volume > 0 ? slot.solids.mass / slot.solids.volume : 0;
    for (std::size_t p = 0; p < points; ++p) {
      const double holdup = slot.profiles[2 * p], moved = slot.profiles[2 * p + 1];
      out[3 * p] += holdup;
      out[3 * p + 1] += moved;
      if (moved != 0) out[3 * p + 2] += density * moved;
    }
    if (slot.solids.volume > 0) mass += slot.solids.mass;
    particles += static_cast<double>(slot.temperature.particles);
    warmth += slot.temperature.sum;
    squares += slot.temperature.squares;
    for (std::size_t b = 0; b < std::min(layout.bins, slot.histogram.size()); ++b)
      out[layout.bins_first() + b] += slot.histogram[b];
  }
  single[Layout::inside] = product.volume_inside / setup.grid.volume();
  single[Layout::mass] = mass;
  single[Layout::clusters] = static_cast<double>(product.image.clusters.size());
  for (const auto& cluster : product.image.clusters) {
    single[Layout::cluster_holdup] += cluster.holdup;
    single[Layout::cluster_velocity] += setup.has_velocity ? cluster.velocity_z : 0;
  }
  if (particles > 0) {
    const double mean = warmth / particles;
    single[Layout::mean_temperature] = product.temperature_zero + mean;
    single[Layout::temperature_spread] = std::sqrt(std::max(0., squares / particles - mean * mean));
    single[Layout::with_temperature] = 1;
    single[Layout::particles] = particles;
  }
}

/// A profile at other abscissae, both ascending.
void interpolate(const std::vector<double>& at, const std::vector<double>& values,
                 const std::vector<double>& wanted, double* out) {
  std::size_t right = 0;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    while (right < at.size() && at[right] < wanted[k]) ++right;
    if (right == 0 || right == at.size() || at.size() == wanted.size()) {
      out[k] = values[at.size() == wanted.size() ? k : right == 0 ? 0 : right - 1];
      continue;
    }
    const double share = (wanted[k] - at[right - 1]) / (at[right] - at[right - 1]);
    out[k] = (1 - share) * values[right - 1] + share * values[right];
  }
}

double ratio(double numerator, double denominator) {
  return denominator != 0 ? numerator / denominator : std::numeric_limits<double>::quiet_NaN();
}

/// Weights of the window's snapshots under each thinning, 0 for those that it leaves out.
std::vector<std::vector<double>> weights_of(const std::vector<double>& times,
                                            const std::vector<Thinning>& thinnings) {
  std::vector<std::vector<double>> all;
  for (const auto& [every, phase] : thinnings) {
    std::vector<double> kept;
    for (std::size_t j = static_cast<std::size_t>(phase); j < times.size();
         j += static_cast<std::size_t>(every))
      kept.push_back(times[j]);
    const auto of_kept = time_weights(kept);
    auto& weights = all.emplace_back(times.size(), 0.);
    for (std::size_t k = 0; k < kept.size(); ++k)
      weights[static_cast<std::size_t>(phase) + k * static_cast<std::size_t>(every)] = of_kept[k];
  }
  return all;
}

std::size_t block_of(std::size_t j, std::size_t snapshots) {
  const std::size_t first_half = snapshots / 2;
  return j < first_half ? j * half_blocks / first_half
                        : half_blocks + (j - first_half) * half_blocks / (snapshots - first_half);
}

}  // namespace

std::array<double, 2> part_of_window(const std::vector<double>& times, const Window& window,
                                     int part) {
  const std::size_t kept =
      std::max<std::size_t>(1, window.snapshots / static_cast<std::size_t>(part));
  return {times[window.first], times[window.first + kept - 1]};
}

std::vector<ProductRange> products_of(const Layout& finest, const RunSetup& setup) {
  std::vector<ProductRange> products;
  std::size_t at = 0;
  const auto add = [&](bool has, const char* name, std::size_t count) {
    if (has && count > 0) products.push_back({name, at, count});
    at += count;
  };
  const bool moves = setup.has_velocity;
  const bool flows = moves && setup.density_from != RunSetup::Density::unknown;
  const bool clusters = setup.settings.wanted.clusters;
  add(true, "axial holdup", finest.layers);
  add(moves, "axial velocity", finest.layers);
  add(flows, "axial mass flux", finest.layers);
  const auto lateral_points = finest.columns * finest.heights;
  add(true, "lateral holdup", lateral_points);
  add(moves, "lateral velocity", lateral_points);
  add(flows, "lateral mass flux", lateral_points);
  add(true, "mean holdup", 1);
  add(setup.density_from != RunSetup::Density::unknown, "inventory", 1);
  add(clusters, "occurrence", 1);
  add(clusters, "cluster holdup", 1);
  add(clusters && moves, "cluster velocity", 1);
  add(setup.has_temperature, "mean temperature", 1);
  add(setup.has_temperature, "temperature spread", 1);
  add(true, "temperature pdf", finest.bins);
  return products;
}

std::vector<double> values_of(const Layout& layout, const BlockSum& sum, const Layout& finest) {
  std::vector<double> values(3 * (finest.layers + finest.columns * finest.heights) + 7 +
                             finest.bins);
  double* out = values.data();
  const auto profiles = [&](std::size_t first, const std::vector<double>& at,
                            const std::vector<double>& wanted, std::size_t heights) {
    const std::size_t n = at.size();
    std::vector<double> own(n);
    for (std::size_t part = 0; part < 3; ++part)
      for (std::size_t h = 0; h < heights; ++h, out += wanted.size()) {
        for (std::size_t k = 0; k < n; ++k) {
          const double* const q = sum.sum.data() + first + 3 * (h * n + k);
          own[k] = part == 1 ? ratio(q[1], q[0]) : ratio(q[part], sum.weight);
        }
        interpolate(at, own, wanted, out);
      }
  };
  profiles(0, layout.z, finest.z, 1);
  profiles(layout.lateral_first(), layout.x, finest.x, layout.heights);
  const double* const single = sum.sum.data() + layout.single_first();
  *out++ = ratio(single[Layout::inside], sum.weight);
  *out++ = ratio(single[Layout::mass], sum.weight);
  *out++ = ratio(single[Layout::clusters], sum.weight);
  *out++ = ratio(single[Layout::cluster_holdup], single[Layout::clusters]);
  *out++ = ratio(single[Layout::cluster_velocity], single[Layout::clusters]);
  *out++ = ratio(single[Layout::mean_temperature], single[Layout::with_temperature]);
  *out++ = ratio(single[Layout::temperature_spread], single[Layout::with_temperature]);
  for (std::size_t b = 0; b < layout.bins; ++b)
    *out++ = ratio(sum.sum[layout.bins_first() + b] * static_cast<double>(layout.bins),
                   single[Layout::particles]);
  return values;
}

ChoiceSums sum_choices(const readers::Series& series, const std::vector<RunSetup>& setups,
                       const std::vector<Variant>& variants, const Window& window,
                       const std::vector<int>& everies, int threads,
                       const ChoiceProgress& progress) {
  ChoiceSums result;
  result.window = window;
  for (const int every : everies)
    for (int phase = 0; phase < every; ++phase) result.thinnings.push_back({every, phase});
  const auto& times = setups.front().times;
  const auto first = times.begin() + static_cast<std::ptrdiff_t>(window.first);
  const auto weights =
      weights_of({first, first + static_cast<std::ptrdiff_t>(window.snapshots)}, result.thinnings);
  for (std::size_t v = 0; v < variants.size(); ++v) {
    auto& sums = result.variants.emplace_back();
    sums.layout = layout_of(setups[v]);
    const BlockSum empty{0, std::vector<double>(sums.layout.size(), 0.)};
    sums.sums.assign(variants[v].candidate ? result.thinnings.size() : 1,
                     std::vector<BlockSum>(window_blocks, empty));
  }
  struct Item {
    std::size_t snapshot = 0;
    ProductScratch scratch;
    readers::Snapshot read;
    SnapshotProduct product;
    std::vector<std::vector<double>> packed;
  };
  const auto make = [&](std::size_t j, Item& item) {
    const std::size_t i = window.first + j;
    item.snapshot = j;
    item.packed.resize(variants.size());
    series.read(i, setups.front().request_without_id, item.scratch.snapshot, item.scratch.reader);
    item.read = item.scratch.snapshot;
    for (std::size_t v = 0; v < variants.size(); ++v) {
      const bool rounded = variants[v].form != readers::DumpForm::as_it_is;
      if (rounded) readers::round_as(variants[v].form, item.scratch.snapshot);
      sum_snapshot(setups[v], i, item.product, item.scratch);
      pack(item.product, setups[v], result.variants[v].layout, item.packed[v]);
      if (rounded) item.scratch.snapshot = item.read;
    }
  };
  const auto take = [&](const Item& item) {
    const auto block = block_of(item.snapshot, window.snapshots);
    for (std::size_t v = 0; v < variants.size(); ++v)
      for (std::size_t t = 0; t < result.variants[v].sums.size(); ++t) {
        const double weight = weights[t][item.snapshot];
        if (weight == 0) continue;
        auto& sum = result.variants[v].sums[t][block];
        sum.weight += weight;
        for (std::size_t k = 0; k < sum.sum.size(); ++k) sum.sum[k] += weight * item.packed[v][k];
      }
    if (progress) progress(item.snapshot + 1, window.snapshots);
  };
  for_each_in_order<Item>(0, window.snapshots, thread_count(threads), make, take);
  return result;
}

}  // namespace bedscope::analysis
