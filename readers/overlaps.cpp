// SPDX-License-Identifier: BSD-3-Clause
#include "readers/overlaps.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

namespace bedscope::readers {
namespace {

/// A dense packing gives fewer than 300 looks a sphere and 6 contacts; more means many spheres in
/// one place. A contact costs as much time as ten looks.
constexpr std::int64_t looks_a_sphere = 1000, looks_a_contact = 10;

using Cell = std::array<std::int64_t, 3>;

/// Half a unit of the sixth significant digit.
double digit_of(double x) {
  const double size = std::abs(x);
  return size > 0 ? 0.5 * std::pow(10., std::floor(std::log10(size)) - 5) : 0;
}

/// Spheres of one class of sizes (diameters within a factor of 2) in cells as wide as the largest
/// of them. Cells are hashed so that neighbours along x share a run of buckets.
class Level {
 public:
  Level(const Spheres& spheres, const std::vector<std::size_t>& rows) : spheres_(&spheres) {
    double largest = 0;
    for (const auto row : rows) largest = std::max(largest, spheres.radius[row]);
    width_ = 2 * largest;
    const auto buckets = std::bit_ceil(2 * rows.size());
    mask_ = buckets - 1;
    starts_.assign(buckets + 1, 0);
    for (const auto row : rows) ++starts_[bucket(cell_of(row)) + 1];
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    rows_.resize(rows.size());
    auto next = starts_;
    for (const auto row : rows) rows_[next[bucket(cell_of(row))]++] = row;
  }

  /// Calls visit(row) for the spheres of the 27 cells around a place; it returns false to stop.
  template <class Visit>
  bool around(std::size_t sphere, Visit&& visit) const {
    const Cell at = cell_of(sphere);
    for (std::int64_t k = at[2] - 1; k <= at[2] + 1; ++k)
      for (std::int64_t j = at[1] - 1; j <= at[1] + 1; ++j)
        for (std::int64_t i = at[0] - 1; i <= at[0] + 1; ++i) {
          const auto b = bucket({i, j, k});
          for (auto n = starts_[b]; n < starts_[b + 1]; ++n)
            if (!visit(rows_[n], Cell{i, j, k})) return false;
        }
    return true;
  }

  Cell cell_of(std::size_t row) const {
    return {static_cast<std::int64_t>(std::floor(spheres_->x[row] / width_)),
            static_cast<std::int64_t>(std::floor(spheres_->y[row] / width_)),
            static_cast<std::int64_t>(std::floor(spheres_->z[row] / width_))};
  }

 private:
  std::size_t bucket(const Cell& cell) const {
    const auto hash = static_cast<std::uint64_t>(cell[0]) +
                      static_cast<std::uint64_t>(cell[1]) * 73856093U +
                      static_cast<std::uint64_t>(cell[2]) * 19349663U;
    return static_cast<std::size_t>(hash) & mask_;
  }

  const Spheres* spheres_;
  double width_ = 0;
  std::size_t mask_ = 0;
  std::vector<std::size_t> starts_, rows_;
};

/// Rows by size: class n holds diameters from 2^n to 2^(n+1).
std::map<int, std::vector<std::size_t>> by_size(const Spheres& s) {
  std::map<int, std::vector<std::size_t>> classes;
  for (std::size_t row = 0; row < s.x.size(); ++row) {
    const double r = s.radius[row];
    // Coordinates beyond 1e12 diameters have no digits left to tell an overlap from.
    const double farthest = std::max({std::abs(s.x[row]), std::abs(s.y[row]), std::abs(s.z[row])});
    if (std::isfinite(r) && r > 1e-100 && farthest < 1e12 * r)
      classes[std::ilogb(r)].push_back(row);
  }
  return classes;
}

/// Judges pairs that may touch.
class Judge {
 public:
  Judge(const Spheres& spheres, Overlaps& found) : s_(&spheres), found_(&found) {}

  bool touch(std::size_t a, std::size_t b) const {
    const double dx = s_->x[a] - s_->x[b], dy = s_->y[a] - s_->y[b], dz = s_->z[a] - s_->z[b];
    const double reach = s_->radius[a] + s_->radius[b];
    return dx * dx + dy * dy + dz * dz < reach * reach;
  }

  void take(std::size_t a, std::size_t b) {
    if (!s_->body.empty() && s_->body[a] > 0 && s_->body[a] == s_->body[b]) return;
    double squared = 0;
    for (const auto& x : {s_->x, s_->y, s_->z}) squared += (x[a] - x[b]) * (x[a] - x[b]);
    const double reach = s_->radius[a] + s_->radius[b];
    const double smaller = std::min(s_->radius[a], s_->radius[b]);
    double depth = reach - std::sqrt(squared);
    if (depth <= std::min(found_->deepest, overlap_rule) * smaller) return;
    const double rounding = open_digits(a, b);
    depth -= rounding;
    if (depth > overlap_rule * smaller) ++found_->beyond_rule;
    if (depth > 0.1 * reach) ++found_->deep;
    if (depth <= found_->deepest * smaller) return;
    found_->deepest = depth / smaller;
    found_->rounding = rounding / smaller;
    found_->a = std::min(a, b);
    found_->b = std::max(a, b);
  }

 private:
  /// What rounding may have added to an overlap.
  double open_digits(std::size_t a, std::size_t b) const {
    double squared = 0;
    for (const auto& x : {s_->x, s_->y, s_->z})
      squared += std::pow(digit_of(x[a]) + digit_of(x[b]), 2);
    return std::sqrt(squared) + digit_of(s_->radius[a]) + digit_of(s_->radius[b]);
  }

  const Spheres* s_;
  Overlaps* found_;
};

}  // namespace

Overlaps find_overlaps(const Spheres& spheres) {
  Overlaps found;
  Judge judge(spheres, found);
  std::int64_t looks = looks_a_sphere * static_cast<std::int64_t>(spheres.x.size());
  const auto classes = by_size(spheres);
  // Each sphere against its own class and all larger ones: a cell there is as wide as both.
  std::vector<Level> larger;
  for (auto own = classes.rbegin(); own != classes.rend() && found.complete; ++own) {
    larger.emplace_back(spheres, own->second);
    for (const auto a : own->second) {
      for (const auto& level : larger) {
        const bool same = &level == &larger.back();
        looks -= 27;  // the cells themselves
        found.complete = level.around(a, [&](std::size_t b, const Cell& cell) {
          if ((!same || b > a) && judge.touch(a, b) && level.cell_of(b) == cell) {
            judge.take(a, b);
            looks -= looks_a_contact;
          }
          return --looks > 0;
        });
        if (!found.complete) return found;
      }
    }
  }
  return found;
}

}  // namespace bedscope::readers
