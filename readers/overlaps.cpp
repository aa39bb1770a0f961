// SPDX-License-Identifier: BSD-3-Clause
#include "readers/overlaps.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <vector>

namespace bedscope::readers {
namespace {

/// A dense packing gives fewer than 300 looks a sphere and 6 contacts; more means many spheres in
/// one place. A contact costs as much time as ten looks.
constexpr std::int64_t looks_a_sphere = 1000, looks_a_contact = 10;

using Cell = std::array<std::int64_t, 3>;

struct Ball {
  double x, y, z, radius;
  std::size_t row;
};

bool touch(const Ball& a, const Ball& b) {
  const double dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z, reach = a.radius + b.radius;
  return dx * dx + dy * dy + dz * dz < reach * reach;
}

/// Half a unit of the sixth significant digit.
double digit_of(double x) {
  const double size = std::abs(x);
  return size > 0 ? 0.5 * std::pow(10., std::floor(std::log10(size)) - 5) : 0;
}

/// Spheres of one class of sizes (diameters within a factor of 2) in cells as wide as the largest
/// of them. Cells are hashed so that neighbours along x share a run of buckets.
class Level {
 public:
  Level(const Spheres& s, const std::vector<std::size_t>& rows) {
    double largest = 0;
    for (const auto row : rows) largest = std::max(largest, s.radius[row]);
    per_width_ = 1 / (2 * largest);
    const auto buckets = std::bit_ceil(2 * rows.size());
    mask_ = buckets - 1;
    starts_.assign(buckets + 1, 0);
    const auto ball = [&](std::size_t row) {
      return Ball{s.x[row], s.y[row], s.z[row], s.radius[row], row};
    };
    // Where each bucket ends, counted down to where it begins: no second list of them.
    for (const auto row : rows) ++starts_[bucket(cell_of(ball(row)))];
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    balls_.resize(rows.size());
    for (std::size_t n = rows.size(); n-- > 0;)
      balls_[--starts_[bucket(cell_of(ball(rows[n])))]] = ball(rows[n]);
  }

  const std::vector<Ball>& balls() const { return balls_; }

  /// Calls visit(ball, cell) for the spheres of the 27 cells around a place, or, so that pairs of
  /// one level come once, of the 14 that do not lie before its own. It returns false to stop.
  template <class Visit>
  bool around(const Ball& place, bool half, Visit&& visit) const {
    const Cell at = cell_of(place);
    for (int step = half ? 13 : 0; step < 27; ++step) {
      const Cell cell{at[0] + step % 3 - 1, at[1] + step / 3 % 3 - 1, at[2] + step / 9 - 1};
      const auto b = bucket(cell);
      for (auto n = starts_[b]; n < starts_[b + 1]; ++n) {
        if (half && step == 13 && balls_[n].row <= place.row) continue;
        if (!visit(balls_[n], cell)) return false;
      }
    }
    return true;
  }

  /// A product instead of a division moves cells by rounding, so by less than spheres shrink when
  /// the open digits are taken off.
  Cell cell_of(const Ball& ball) const {
    return {static_cast<std::int64_t>(std::floor(ball.x * per_width_)),
            static_cast<std::int64_t>(std::floor(ball.y * per_width_)),
            static_cast<std::int64_t>(std::floor(ball.z * per_width_))};
  }

 private:
  std::size_t bucket(const Cell& cell) const {
    const auto hash = static_cast<std::uint64_t>(cell[0]) +
                      static_cast<std::uint64_t>(cell[1]) * 73856093U +
                      static_cast<std::uint64_t>(cell[2]) * 19349663U;
    return static_cast<std::size_t>(hash) & mask_;
  }

  double per_width_ = 0;
  std::size_t mask_ = 0;
  std::vector<std::size_t> starts_;
  std::vector<Ball> balls_;
};

/// Rows by size, the largest first: class n holds radii from 2^n to 2^(n+1).
using SizeClasses = std::map<int, std::vector<std::size_t>, std::greater<>>;

SizeClasses by_size(const Spheres& s) {
  SizeClasses classes;
  for (std::size_t row = 0; row < s.x.size(); ++row) {
    const double r = s.radius[row];
    // Coordinates beyond 1e12 diameters have no digits left to tell an overlap from.
    const auto near = [&](double x) { return std::abs(x) < 1e12 * r; };  // false for NaN
    if (std::isfinite(r) && r > 1e-100 && near(s.x[row]) && near(s.y[row]) && near(s.z[row]))
      classes[std::ilogb(r)].push_back(row);
  }
  return classes;
}

/// Judges pairs that may touch.
class Judge {
 public:
  Judge(const Spheres& spheres, Overlaps& found) : s_(&spheres), found_(&found) {}

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
  for (const auto& [size, rows] : classes) {
    larger.emplace_back(spheres, rows);
    for (const auto& a : larger.back().balls()) {
      for (const auto& level : larger) {
        looks -= 27;  // the cells themselves
        const bool same = &level == &larger.back();
        found.complete = level.around(a, same, [&](const Ball& b, const Cell& cell) {
          if (touch(a, b) && level.cell_of(b) == cell) {
            judge.take(a.row, b.row);
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
