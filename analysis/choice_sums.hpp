// SPDX-License-Identifier: BSD-3-Clause
// What the variants of an analysis give for the same snapshots, as sums over blocks of the window
// from which any choice of snapshots can be averaged afterwards. A snapshot is read once for all.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "analysis/choice.hpp"
#include "analysis/result.hpp"

namespace bedscope::analysis {

/// A window has two halves of eight blocks of consecutive snapshots each.
inline constexpr std::size_t half_blocks = 8, window_blocks = 2 * half_blocks;

/// The snapshots phase, phase + every, ... of the window.
struct Thinning {
  int every = 1, phase = 0;
};

/// Weighted sums of one variant over one thinning's snapshots in one block.
struct BlockSum {
  double weight = 0;
  std::vector<double> sum;  ///< as ChoiceLayout says
};

/// Where the parts of a BlockSum are: 3 numbers (phi, phi v_up, rho phi v_up) a layer of cells,
/// then a height and a lateral cell; single values; particles a bin of temperature.
struct ChoiceLayout {
  std::size_t layers = 0, columns = 0, heights = 0, bins = 0;
  std::vector<double> z, x;  ///< centres of layers and columns [m]
  enum Single : std::size_t {
    inside,  ///< holdup of the domain
    mass,    ///< of the dump [kg]
    clusters,
    cluster_holdup,    ///< sum over clusters
    cluster_velocity,  ///< sum over clusters [m/s]
    mean_temperature,
    temperature_spread,
    with_temperature,  ///< 1 where the snapshot has one
    particles,         ///< with a temperature
    singles
  };
  std::size_t lateral_first() const { return 3 * layers; }
  std::size_t single_first() const { return 3 * (layers + columns * heights); }
  std::size_t bins_first() const { return single_first() + singles; }
  std::size_t size() const { return bins_first() + bins; }
};

struct VariantSums {
  ChoiceLayout layout;
  std::vector<std::vector<BlockSum>> sums;  ///< [thinning][block]
};

struct ChoiceSums {
  std::vector<Thinning> thinnings;    ///< all phases of every `every`; the first is every snapshot
  std::vector<VariantSums> variants;  ///< in their order; shown-only ones for the first thinning
  Window window;
};

/// From and to [s] of the first 1/part of a window, at snapshots.
std::array<double, 2> part_of_window(const std::vector<double>& times, const Window& window,
                                     int part);

/// Values of a kind that belong together: a profile, or one value.
struct ProductRange {
  std::string name;  ///< as in validation's quantities
  std::size_t first = 0, count = 0;
};

/// The products that a run with this setup has, and where values_of puts them.
std::vector<ProductRange> products_of(const ChoiceLayout& finest, const RunSetup& setup);

/// All products out of a sum over snapshots, profiles at the points of `finest`: those of wider
/// cells are interpolated linearly between their centres, and constant beyond the outermost (half a
/// cell). NaN where no solids, or no clusters, were seen.
std::vector<double> values_of(const ChoiceLayout& layout, const BlockSum& sum,
                              const ChoiceLayout& finest);

using ChoiceProgress = std::function<void(std::size_t done, std::size_t all)>;

/// Reads every snapshot of the window once. `window` is of the series with every snapshot.
/// Results do not depend on `threads`, to the bit. Throws as analyse_run.
ChoiceSums sum_choices(const readers::Series& series, const std::vector<RunSetup>& setups,
                       const std::vector<Variant>& variants, const Window& window,
                       const std::vector<int>& everies, int threads,
                       const ChoiceProgress& progress);

}  // namespace bedscope::analysis
