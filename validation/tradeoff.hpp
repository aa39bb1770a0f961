// SPDX-License-Identifier: BSD-3-Clause
// Accuracy against cost: the error of every choice of an analysis against the finest one, the
// Pareto front, the cheapest choice within a tolerance, and whether it keeps what it promised.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/choice_cost.hpp"
#include "analysis/choice_sums.hpp"
#include "analysis/estimate.hpp"

namespace bedscope::validation {

using analysis::Estimate;

/// One run with its sums and costs; all runs of a tradeoff have the same variants and thinnings.
struct TradeoffRun {
  std::string label;
  analysis::ChoiceSums sums;
  std::vector<analysis::ChoiceCost> costs;  ///< of each variant
  std::vector<analysis::ProductRange> products;
};

/// Error of one product under one setting, relative to the finest choice; of several runs the
/// largest.
///
///   e = sqrt(mean over ways and points of (a - r)^2) / mean |r|
///
/// r: the finest choice over all snapshots; a: the setting; points: those of the finest profile
/// where both are defined (see analysis::values_of); ways: all phases of every n-th snapshot and
/// all positions of a shorter window, so that no lucky one counts. A value that the setting cannot
/// give at all (no cluster seen) is an error of 1. ci95: half-width of the interval by the
/// jackknife over the blocks of the window, each left out of setting and finest choice together,
/// Student's t (Miller, Biometrika 61 (1974) 1); blocks count as independent. Errors below 1e-12
/// are rounding: 0.
struct ProductError {
  Estimate whole, first, second;  ///< over the window, and over its two halves
};

/// A way to analyse the study.
struct Setting {
  std::string name;  ///< "exact, cells x 2, every 4th snapshot, 1/2 of the window"
  std::size_t variant = 0;
  int every = 1, part = 1;           ///< every n-th snapshot of 1/part of the window
  bool candidate = true;             ///< may be recommended
  bool present = false;              ///< the study's own
  double seconds = 0;                ///< CPU time to read, map and sum, of all runs [s]
  double bytes = 0;                  ///< read from disk
  std::vector<ProductError> errors;  ///< in the order of Tradeoff::products
};

struct Tradeoff {
  std::vector<std::string> products;
  std::vector<Setting> settings;  ///< the finest choice first
  /// How well the finest choice knows each product: root mean square of the half-widths of its 95 %
  /// interval over the profile, relative as the errors are.
  std::vector<double> noise;
  double tolerance = 0.01;
  std::vector<std::size_t> required;  ///< products that a recommendation must hold

  std::size_t present() const;
  /// Of one product: no candidate is both cheaper and at least as near (over the whole window).
  std::vector<bool> front(std::size_t product) const;
};

/// Errors of every setting. `present_every`: of the study.
Tradeoff weigh(std::span<const TradeoffRun> runs, std::span<const analysis::Variant> variants,
               int present_every);

/// The cheapest candidate for which error + ci95 of all `products` stays within the tolerance on
/// the first half.
std::size_t cheapest(const Tradeoff& tradeoff, std::span<const std::size_t> products);
/// The same on both halves.
std::size_t cheapest_on_both(const Tradeoff& tradeoff, std::span<const std::size_t> products);
/// Whether the error on the second half is within the tolerance, for all of `products`.
bool kept_promise(const Tradeoff& tradeoff, std::size_t setting,
                  std::span<const std::size_t> products);

/// What is recommended: chosen on the first half and, where it did not keep its promise on the
/// second, replaced by what keeps it on both (which nothing is left to check).
struct Recommendation {
  std::size_t chosen = 0;   ///< on the first half
  bool kept = true;         ///< on the second half
  std::size_t setting = 0;  ///< to be used: `chosen` where it kept its promise
};
Recommendation recommend(const Tradeoff& tradeoff);

}  // namespace bedscope::validation
