// SPDX-License-Identifier: BSD-3-Clause
// Particles that must not enter a mean: not finite, or without a size. Excluded, counted and named.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "readers/series.hpp"

namespace bedscope::readers {

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
  auto& [not_finite, no_size, doubled_id, farthest] = flaws;
  ar(not_finite, no_size, doubled_id, farthest);
}

/// Counts the ids that occur more than once. `scratch` is re-used.
void find_doubled_ids(std::span<const double> ids, std::size_t snapshot,
                      std::vector<std::uint64_t>& scratch, Flaws& flaws);

}  // namespace bedscope::readers
