// SPDX-License-Identifier: BSD-3-Clause
// What the gas of one run gives, beside its solids: plain data. Undefined values are NaN.
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/estimate.hpp"

namespace bedscope::analysis {

/// A time-averaged curve at `coordinate` (cell centres [m]); all vectors of one length.
struct GasProfile {
  std::vector<double> coordinate;
  std::vector<Estimate> voidage;      ///< <eps> [-]
  std::vector<Estimate> velocity_z;   ///< interstitial, <eps u>/<eps> [m/s]
  std::vector<Estimate> temperature;  ///< <eps T>/<eps> [K]
  std::vector<Estimate> pressure;     ///< <eps p>/<eps> [Pa]
  std::vector<Estimate> slip_z;       ///< gas less solids velocity of the same window [m/s]
};

/// Time-averaged fields on the analysis grid, as the solids' MeanFields; NaN where no gas cell is,
/// empty where the run has no such field.
struct GasFields {
  std::vector<double> voidage, velocity_x, velocity_z, temperature, pressure;
};

/// One snapshot of the particles against the gas of the same time.
struct VoidageCheck {
  std::size_t snapshot = 0;    ///< index into the series of particles
  double time = 0;             ///< [s]
  double solids_volume = 0;    ///< of the particles, where there is gas mesh inside the domain [m3]
  double gas_side_volume = 0;  ///< sum (1 - eps) V there [m3]
  double mean_difference = 0;  ///< of eps - (1 - phi), weighted by volume [-]
  double rms_difference = 0;
  double largest_difference = 0;  ///< |eps - (1 - phi)|
  double spread = 0;              ///< standard deviation of phi over the cells compared [-]
  std::size_t cells = 0;          ///< cells compared
  double bed_mass = 0;            ///< of the solids in the domain [kg]; NaN without density

  double ratio() const { return solids_volume / gas_side_volume; }
};

/// A row for each time of the gas, inside and outside the window.
struct PressureSample {
  double time = 0;            ///< [s]
  double drop = 0;            ///< bottom less top [Pa]
  double weight_by_area = 0;  ///< of the solids in the domain at the nearest matched snapshot [Pa]
};

struct GasResult {
  bool present = false;     ///< does the run have gas at all?
  std::size_t times = 0;    ///< of the gas in the window
  double from = 0, to = 0;  ///< the first and last of them [s]; NaN without
  bool has_velocity = false, has_temperature = false, has_pressure = false;

  GasProfile axial;
  std::vector<GasProfile> lateral;  ///< one for each of RunResult::heights
  GasFields fields;

  std::vector<VoidageCheck> checks;  ///< of all matched snapshots
  std::vector<PressureSample> pressure;
  Estimate voidage_ratio;         ///< mean of the checks' ratios inside the window
  Estimate pressure_drop;         ///< over the window [Pa]
  double bed_weight_by_area = 0;  ///< over the window [Pa]
};

}  // namespace bedscope::analysis
