// SPDX-License-Identifier: BSD-3-Clause
// What one snapshot gives: computed independently of all others, so snapshots go in parallel.
#pragma once

#include <exception>
#include <vector>

#include "analysis/clusters.hpp"
#include "analysis/run_setup.hpp"
#include "readers/flaws.hpp"

namespace bedscope::analysis {

/// A type, or the particles of a type for which a rule holds.
struct SlotKey {
  int type = 0;
  int rule = -1;  ///< index into RunSettings::species; -1: no rule
  bool operator==(const SlotKey&) const = default;
};

/// Sums over the particles of one slot in one snapshot.
struct SlotProduct {
  SlotKey key;
  std::vector<double> fields;    ///< [cell][3]: phi, phi v_lateral, phi v_up
  std::vector<double> profiles;  ///< [layer][2], then [height][lateral cell][2]: phi, phi v_up
  std::int64_t particles = 0;
  double volume = 0;       ///< of every particle of the dump [m3]
  double moment = 0;       ///< sum of volume x height above the domain's floor [m4]
  double mass = 0;         ///< [kg]; NaN where no density is known
  double mass_moment = 0;  ///< sum of mass x height above the floor [kg m]
  std::int64_t with_temperature = 0;
  double shifted_sum = 0, shifted_squares = 0;  ///< of T - T0, T0 of the snapshot's first particle
  double coldest = 0, hottest = 0;
  std::vector<double> histogram;  ///< particles a bin, inside the PDF's range
};

struct SnapshotProduct {
  std::size_t snapshot = 0;
  std::vector<SlotProduct> slots;  ///< the first `used` are valid; the rest are buffers
  std::size_t used = 0;
  double volume = 0, volume_inside = 0;  ///< [m3]
  double temperature_zero = 0;           ///< T0 [K]
  std::int64_t without_temperature = 0;
  ClusterImage image;
  std::vector<double> holdup;  ///< depth-averaged, all types
  readers::Flaws flaws;
  std::uint64_t bytes_read = 0;
  std::exception_ptr error;  ///< what stopped it; thrown again in the order of the series
};

/// Buffers of one worker.
struct ProductScratch {
  readers::Snapshot snapshot;
  readers::Scratch reader;
  std::vector<double> mass, mass_vx, mass_vz;
  std::vector<std::uint64_t> marks;
};

/// Reads snapshot i and computes all its sums into `out`, whose buffers are re-used.
void make_product(const RunSetup& setup, const readers::Series& series, std::size_t i,
                  SnapshotProduct& out, ProductScratch& scratch);

}  // namespace bedscope::analysis
