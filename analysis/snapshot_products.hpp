// SPDX-License-Identifier: BSD-3-Clause
// What one snapshot gives: computed independently of all others, so snapshots go in parallel.
#pragma once

#include <algorithm>
#include <vector>

#include "analysis/bed_height.hpp"
#include "analysis/bubbles.hpp"
#include "analysis/cluster_sensitivity.hpp"
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

template <class Archive>
void archive(Archive& ar, SlotKey& key) {
  auto& [type, rule] = key;
  ar(type, rule);
}

/// Sums over solids, wherever they are: in the domain or beside it.
struct SolidsSum {
  std::int64_t particles = 0;  ///< those without a size included
  double volume = 0;           ///< [m3]
  double moment = 0;           ///< sum of volume x height above the domain's floor [m4]
  double mass = 0;             ///< [kg]; NaN where no density is known
  double mass_moment = 0;      ///< sum of mass x height above the floor [kg m]

  void add(double of_volume, double of_mass, double height) {
    volume += of_volume;
    moment += of_volume * height;
    mass += of_mass;
    mass_moment += of_mass * height;
  }
  SolidsSum& operator+=(const SolidsSum& other) {
    particles += other.particles;
    volume += other.volume;
    moment += other.moment;
    mass += other.mass;
    mass_moment += other.mass_moment;
    return *this;
  }
};

template <class Archive>
void archive(Archive& ar, SolidsSum& sum) {
  auto& [particles, volume, moment, mass, mass_moment] = sum;
  ar(particles, volume, moment, mass, mass_moment);
}

/// Sums over temperatures less T0, that of the snapshot's first particle, so that the spread does
/// not drown in the squares of absolute temperatures.
struct TemperatureSum {
  std::int64_t particles = 0;
  double sum = 0, squares = 0;      ///< of T - T0 [K], [K2]
  double coldest = 0, hottest = 0;  ///< [K]

  void add(double temperature, double zero) {
    coldest = particles == 0 ? temperature : std::min(coldest, temperature);
    hottest = particles == 0 ? temperature : std::max(hottest, temperature);
    ++particles;
    sum += temperature - zero;
    squares += (temperature - zero) * (temperature - zero);
  }
  TemperatureSum& operator+=(const TemperatureSum& other) {
    if (other.particles == 0) return *this;
    coldest = particles == 0 ? other.coldest : std::min(coldest, other.coldest);
    hottest = particles == 0 ? other.hottest : std::max(hottest, other.hottest);
    particles += other.particles;
    sum += other.sum;
    squares += other.squares;
    return *this;
  }
};

template <class Archive>
void archive(Archive& ar, TemperatureSum& s) {
  auto& [particles, sum, squares, coldest, hottest] = s;
  ar(particles, sum, squares, coldest, hottest);
}

/// What the particles of one slot give in one snapshot.
struct SlotProduct {
  SlotKey key;
  std::vector<double> fields;    ///< [cell][3]: phi, phi v_lateral, phi v_up
  std::vector<double> profiles;  ///< [layer][2], then [height][lateral cell][2]: phi, phi v_up
  SolidsSum solids;
  TemperatureSum temperature;
  std::vector<double> histogram;  ///< particles a bin, and last all with a temperature
  std::vector<double> warmth;     ///< [layer][2], by centres: volume [m3], volume x T [m3 K]
};

template <class Archive>
void archive(Archive& ar, SlotProduct& slot) {
  auto& [key, fields, profiles, solids, temperature, histogram, warmth] = slot;
  ar(key, fields, profiles, solids, temperature, histogram, warmth);
}

struct SnapshotProduct {
  std::size_t snapshot = 0;
  std::vector<SlotProduct> slots;  ///< the first `used` are valid; the rest are buffers
  std::size_t used = 0;
  double volume = 0, volume_inside = 0;  ///< [m3]
  double temperature_zero = 0;           ///< T0 [K]
  std::int64_t without_temperature = 0;
  ClusterImage image;
  ClusterSensitivity sensitivity;  ///< of some snapshots
  BedHeights bed;
  BubbleProduct bubbles;       ///< where the study asks for them
  std::vector<double> holdup;  ///< depth-averaged, all types
  readers::Flaws flaws;
  std::uint64_t bytes_read = 0;
};

template <class Archive>
void archive(Archive& ar, SnapshotProduct& product) {
  auto& [snapshot, slots, used, volume, volume_inside, temperature_zero, without_temperature, image,
         sensitivity, bed, bubbles, holdup, flaws, bytes_read] = product;
  ar(snapshot, slots, used, volume, volume_inside, temperature_zero, without_temperature, image,
     sensitivity, bed, bubbles, holdup, flaws, bytes_read);
}

/// Buffers of one worker.
struct ProductScratch {
  readers::Snapshot snapshot;
  readers::Scratch reader;
  std::vector<double> mass, mass_vx, mass_vz;
  std::vector<std::uint64_t> marks;
};

/// Doubled ids are a flaw of the whole series (pieces counted twice), so a sample shows them; the
/// column is not read for the others.
bool ids_wanted(std::size_t i, std::size_t snapshots);

/// Computes all sums of snapshot i, whose columns (as RunSetup::request has them, those of the id
/// may be missing) are in scratch.snapshot, into `out`, whose buffers are re-used.
void sum_snapshot(const RunSetup& setup, std::size_t i, SnapshotProduct& out,
                  ProductScratch& scratch);

/// Reads snapshot i and does the same.
void make_product(const RunSetup& setup, const readers::Series& series, std::size_t i,
                  SnapshotProduct& out, ProductScratch& scratch);

}  // namespace bedscope::analysis
