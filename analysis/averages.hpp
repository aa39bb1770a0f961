// SPDX-License-Identifier: BSD-3-Clause
// Weighted sums over snapshots whose bits do not depend on threads, on how often the series was
// looked at, or on how much of it is kept apart: a fixed binary tree over the snapshots' indices.
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace bedscope::analysis {

/// Sum of weight x value over snapshots, for a growing list of slots (a slot is a type, or a type
/// under a rule; it may first occur late).
struct WeightedSum {
  double weight = 0;
  std::vector<std::vector<double>> slots;

  void add(double w, std::size_t slot, const std::vector<double>& values) {
    if (slots.size() <= slot) slots.resize(slot + 1);
    auto& sum = slots[slot];
    if (sum.empty()) sum.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) sum[i] += w * values[i];
  }

  void merge(const WeightedSum& later) {
    weight += later.weight;
    if (slots.size() < later.slots.size()) slots.resize(later.slots.size());
    for (std::size_t s = 0; s < later.slots.size(); ++s) {
      if (slots[s].empty()) slots[s].resize(later.slots[s].size());
      for (std::size_t i = 0; i < later.slots[s].size(); ++i) slots[s][i] += later.slots[s][i];
    }
  }
};

/// Sums of a series in leaves of 2^k consecutive snapshots. When there are more than `limit`, pairs
/// of neighbours merge and k grows: memory stays bounded, and since leaves are aligned to the index
/// in the series, the total is the same tree whatever the limit.
class Leaves {
 public:
  /// `first_power`: the smallest leaf holds 2^first_power snapshots, added one after the other.
  Leaves(int first_power, std::size_t limit) : power_(first_power), limit_(limit) {}

  /// The sum to add snapshot `index` to; indices must not decrease.
  WeightedSum& at(std::size_t index) {
    while (!leaves_.contains(index >> power_) && leaves_.size() >= limit_) halve();
    return leaves_[index >> power_];
  }

  /// By leaf number; leaf n holds the snapshots n * size() ... (n + 1) * size() - 1 that were
  /// added.
  const std::map<std::size_t, WeightedSum>& leaves() const { return leaves_; }
  std::size_t size() const { return std::size_t{1} << power_; }

  /// Merged over the leaves from `first_leaf` on, pairwise up the tree.
  WeightedSum total(std::size_t first_leaf = 0) const {
    std::map<std::size_t, WeightedSum> level(leaves_.lower_bound(first_leaf), leaves_.end());
    while (level.size() > 1) level = pairs(level);
    return level.empty() ? WeightedSum{} : std::move(level.begin()->second);
  }

 private:
  static std::map<std::size_t, WeightedSum> pairs(std::map<std::size_t, WeightedSum>& level) {
    std::map<std::size_t, WeightedSum> merged;
    for (auto& [number, sum] : level) {  // in ascending order: left before right
      const auto [place, is_new] = merged.try_emplace(number / 2);
      if (is_new)
        place->second = std::move(sum);
      else
        place->second.merge(sum);
    }
    return merged;
  }
  void halve() {
    leaves_ = pairs(leaves_);
    ++power_;
  }

  int power_;
  std::size_t limit_;
  std::map<std::size_t, WeightedSum> leaves_;
};

}  // namespace bedscope::analysis
