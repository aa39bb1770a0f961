// SPDX-License-Identifier: BSD-3-Clause
// Particles that must not enter a mean: not finite, or without a size. Excluded, counted and named;
// and those of which something else is doubtful: named.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "readers/series.hpp"

namespace bedscope::readers {

/// The type that a number of a dump stands for: the number where it is a whole one below 10^9, 0
/// for all others.
inline int whole_type(double value) {
  return std::abs(value) < 1e9 && value == std::trunc(value) ? static_cast<int>(value) : 0;
}

/// The flawed particles of one snapshot, or, merged, of many.
struct Flaws {
  struct Kind {
    std::int64_t particles = 0;
    std::int64_t snapshots = 0;
    std::size_t snapshot = 0;       ///< the first one that has some
    std::vector<std::size_t> rows;  ///< its first rows, at most 4
    std::vector<double> ids;        ///< their ids, NaN where not known

    void add(std::size_t in_snapshot, std::size_t row, double id);
    void merge(const Kind& later);
  };
  Kind not_finite;      ///< position, velocity or radius
  Kind no_size;         ///< radius zero or negative
  Kind doubled_id;      ///< an id that occurred before in the snapshot
  Kind no_type;         ///< a type that is no whole number
  double farthest = 0;  ///< largest coordinate [m]

  void merge(const Flaws& later);
  /// One line for each kind that occurred, with file and place of the first.
  std::vector<std::string> describe(const Series& series) const;
};

template <class Archive>
void archive(Archive& ar, Flaws::Kind& kind) {
  auto& [particles, snapshots, snapshot, rows, ids] = kind;
  ar(particles, snapshots, snapshot, rows, ids);
}

template <class Archive>
void archive(Archive& ar, Flaws& flaws) {
  auto& [not_finite, no_size, doubled_id, no_type, farthest] = flaws;
  ar(not_finite, no_size, doubled_id, no_type, farthest);
}

/// Counts the ids that occur more than once. `scratch` is re-used.
void find_doubled_ids(std::span<const double> ids, std::size_t snapshot,
                      std::vector<std::uint64_t>& scratch, Flaws& flaws);

/// Names the types that are no whole numbers (whole_type). `ids`: of the same rows, or empty.
void find_no_types(std::span<const double> types, std::span<const double> ids, std::size_t snapshot,
                   Flaws& flaws);

}  // namespace bedscope::readers
