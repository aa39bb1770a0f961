// SPDX-License-Identifier: BSD-3-Clause
// What the gas gives at one time, alone and against the particles of the same time: computed
// independently of all other times, so times go in parallel.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "analysis/gas_mapping.hpp"
#include "analysis/gas_setup.hpp"
#include "analysis/snapshot_products.hpp"

namespace bedscope::analysis {

/// Volumes and volume integrals in a cell of the grid, or in a layer or a column of a band.
/// A cell of the gas counts for a quantity only where that is finite, so each has its own volume.
enum GasQuantity : std::size_t {
  gas_covered,   ///< V
  gas_volume,    ///< eps V
  gas_with_u,    ///< eps V where the velocity is known
  gas_flux_x,    ///< eps u_lateral V
  gas_flux_z,    ///< eps u_up V
  gas_with_t,    ///< eps V where the temperature is known
  gas_heat,      ///< eps T V
  gas_with_p,    ///< eps V where the pressure is known
  gas_pressure,  ///< eps p V [Pa m3]
  gas_quantities
};

struct GasProduct {
  std::size_t time = 0;          ///< index into the series
  std::vector<double> fields;    ///< [cell][gas_quantities]; empty where only the drop was wanted
  std::vector<double> profiles;  ///< [layer][...], then [height][lateral cell][...]
  double pressure_drop = 0;      ///< [Pa]; NaN where it is unknown
  std::int64_t not_finite = 0;   ///< values that are nan or inf
  std::int64_t beyond = 0;       ///< voidages below 0 or above 1
};

/// A check and what it is judged by.
struct JudgedCheck : VoidageCheck {
  double holdup = 0;  ///< mean of phi over the cells compared [-]
  /// What `spread` would be of as many particles thrown at random: a particle counts in one cell or
  /// in the next, so that phi of a cell with n of them is known to phi/sqrt(n) [-].
  double noise = 0;
};

struct GasScratch {
  readers::FieldValues voidage, velocity, temperature, pressure;
  std::vector<double> holdup;
};

/// All that is constant while the gas of a run is read.
class GasSource {
 public:
  /// Throws what set_up_gas does.
  GasSource(const RunSetup& run, readers::GasSeries series);

  const GasSetup& setup() const { return setup_; }
  const readers::GasSeries& series() const { return series_; }
  const GasMapping& mapping() const { return *mapping_; }  ///< of the first time

  /// `averaged`: wanted for the averages too, not for the pressure drop alone.
  void make_product(std::size_t time, bool averaged, GasProduct& out, GasScratch& scratch) const;
  /// The particles of a snapshot against the gas at `time`; `check.snapshot` and `check.time` stay.
  ///
  /// Both sides are brought to the coarser of grid and mesh: phi is averaged over each cell of the
  /// mesh and brought back to the grid as the voidage is, so that a grid finer than the mesh does
  /// not blame the gas for what its cells cannot show, nor a coarser one the particles.
  void make_check(const SnapshotProduct& particles, std::size_t time, JudgedCheck& check,
                  GasScratch& scratch) const;

 private:
  std::shared_ptr<const GasMapping> mapping_at(std::size_t time) const;
  void read_voidage(std::size_t time, readers::FieldValues& out) const;
  bool read(std::size_t time, const std::string& field, unsigned components,
            readers::FieldValues& out) const;
  void sum_fields(const GasMapping& mapping, const GasScratch& scratch, bool velocity,
                  bool temperature, bool pressure, GasProduct& out) const;
  void sum_profiles(GasProduct& out) const;

  const RunSetup* run_;
  std::array<int, 3> axes_;
  readers::GasSeries series_;
  GasSetup setup_;
  std::shared_ptr<const readers::Mesh> mesh_;  // of the first time
  std::shared_ptr<const GasMapping> mapping_;
};

}  // namespace bedscope::analysis
