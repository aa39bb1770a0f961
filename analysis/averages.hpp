// SPDX-License-Identifier: BSD-3-Clause
// Weighted sums over snapshots whose bits do not depend on threads, on how often the series was
// looked at, or on how much of it is kept apart: a fixed binary tree over the snapshots' indices.
#pragma once

#include <algorithm>
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

template <class Archive>
void archive(Archive& ar, WeightedSum& sum) {
  auto& [weight, slots] = sum;
  ar(weight, slots);
}

/// Sums of a series in leaves of 2^k consecutive snapshots, aligned to the index in the series.
/// When there are more than `limit`, pairs of neighbours merge and k grows, so that memory stays
/// bounded. Whatever was merged early is what the tree over all indices would merge: the total has
/// the same bits for any limit, and for a series that was looked at while it grew.
class Leaves {
 public:
  /// `first_power`: snapshots of one leaf of 2^first_power are added one after the other.
  /// `limit` 0: nothing is kept apart; the total takes leaf after leaf in the order of the series,
  /// which is a fixed tree too, of one sum instead of as many as the tree is high.
  Leaves(int first_power, std::size_t limit)
      : first_power_(first_power), power_(first_power), limit_(limit) {}

  /// The sum to add snapshot `index` to; indices must not decrease.
  WeightedSum& at(std::size_t index) {
    const std::size_t number = index >> first_power_;
    if (number != open_) {
      close();
      open_ = number;
    }
    return sum_;
  }

  /// Snapshots in a leaf.
  std::size_t size() const { return std::size_t{1} << power_; }

  /// By number; leaf n holds the snapshots n * size() ... (n + 1) * size() - 1 that were added.
  std::map<std::size_t, WeightedSum> leaves() const { return climb(0, power_); }

  /// Merged over the leaves from `first_leaf` on.
  WeightedSum total(std::size_t first_leaf = 0) const {
    if (limit_ == 0) {
      auto sum = nodes_.empty() ? WeightedSum{} : nodes_.front().sum;
      sum.merge(sum_);
      return sum;
    }
    constexpr int top = 62;  // above any index
    auto root = climb(first_leaf << power_, top);
    return root.empty() ? WeightedSum{} : std::move(root.begin()->second);
  }

  /// Into and out of one of the same powers and limit.
  template <class Archive>
  void archive(Archive& ar) {
    ar(power_, nodes_, open_, sum_);
  }

 private:
  static constexpr std::size_t none = ~std::size_t{0};
  /// The sum over the snapshots number * 2^power ... (number + 1) * 2^power - 1.
  struct Node {
    int power = 0;
    std::size_t number = 0;
    WeightedSum sum;

    template <class Archive>
    void archive(Archive& ar) {
      ar(power, number, sum);
    }
  };

  /// The open leaf is whole: it becomes a node, and merges with its sibling as far as leaves go.
  void close() {
    if (open_ == none) return;
    if (limit_ == 0 && !nodes_.empty()) {
      nodes_.front().sum.merge(sum_);
      sum_ = {};
      return;
    }
    nodes_.push_back({first_power_, open_, std::move(sum_)});
    sum_ = {};
    if (limit_ == 0) return;
    merge_siblings();
    const auto whole = [this](const Node& node) { return node.power == power_; };
    while (static_cast<std::size_t>(std::count_if(nodes_.begin(), nodes_.end(), whole)) > limit_) {
      ++power_;
      merge_siblings();
    }
  }

  void merge_siblings() {
    std::vector<Node> merged;
    for (auto& node : nodes_) {
      merged.push_back(std::move(node));
      // Before the first one there is nothing: where it is a right-hand child its sibling is empty.
      for (auto& first = merged.front();
           merged.size() == 1 && first.power < power_ && first.number % 2 == 1;) {
        ++first.power;
        first.number /= 2;
      }
      while (merged.size() > 1) {
        auto &left = merged[merged.size() - 2], &right = merged.back();
        if (left.power != right.power || left.power >= power_ || left.number % 2 != 0 ||
            left.number + 1 != right.number)
          break;
        left.sum.merge(right.sum);
        ++left.power;
        left.number /= 2;
        merged.pop_back();
      }
    }
    nodes_ = std::move(merged);
  }

  /// All that begins at snapshot `first` or later, merged pairwise up the tree to nodes of 2^power.
  std::map<std::size_t, WeightedSum> climb(std::size_t first, int power) const {
    std::map<std::size_t, WeightedSum> level;
    for (int p = first_power_;; ++p) {
      for (const auto& node : nodes_)
        if (node.power == p && node.number << p >= first) level[node.number] = node.sum;
      if (p == first_power_ && open_ != none && open_ << p >= first) level[open_] = sum_;
      if (p == power) return level;
      std::map<std::size_t, WeightedSum> above;
      for (auto& [number, sum] : level) {  // in ascending order: left before right
        const auto [place, is_new] = above.try_emplace(number / 2);
        if (is_new)
          place->second = std::move(sum);
        else
          place->second.merge(sum);
      }
      level = std::move(above);
    }
  }

  int first_power_, power_;
  std::size_t limit_;
  std::vector<Node> nodes_;  // in the order of the series
  std::size_t open_ = none;
  WeightedSum sum_;  // of the open leaf
};

}  // namespace bedscope::analysis
