// SPDX-License-Identifier: GPL-3.0-or-later
// What a run tells: history.csv, run.json, progress, the table of costs at the end.
#pragma once

#include <mpi.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cases/coupled/coupling.hpp"
#include "cases/coupled/feed.hpp"
#include "cases/coupled/gas.hpp"
#include "cases/coupled/timing.hpp"

namespace bedscope::coupled {

/// Numbers that grow over the whole run, kept by checkpoints.
struct Tally {
  long steps = 0, dem_steps = 0;
  double particle_steps = 0;    ///< particles x DEM steps
  double worst_continuity = 0;  ///< |in - out - storage| / in, largest of all rows
  double worst_exchange = 0;    ///< |drag on gas + drag on particles| / drag, largest of all rows
  double gas_in = 0, gas_out = 0;  ///< [m3]
  double gas_stored = 0;           ///< change of the gas' volume, by the equation [m3]
  double heat_from_gas = 0;        ///< to the particles [J]
  double heat_carried = 0;         ///< into the domain by the gas, less out [J]
  double worst_courant = 0;
  double seconds = 0;      ///< wall clock of earlier parts of a resumed run
  double cpu_seconds = 0;  ///< CPU time of these, of all ranks; NaN where they did not count it
  std::array<double, part_names.size()> part_seconds{};
};

class Record {
 public:
  Record(MPI_Comm comm, const Gas& gas);

  void start(double resumed_at);  ///< opens history.csv; rows after resumed_at are dropped
  void step(const Gas& gas, const Dem& dem, const GasBalance& balance, double particles);
  void row(const Gas& gas, const ParticleSums& sums, const GasBalance& balance, const Feed& feed);
  void progress(const Gas& gas, long particles, const Timing& timing);
  void write_json(const Gas& gas, const ParticleSums& sums, const Feed& feed, const Timing& timing,
                  const std::string& state) const;  ///< collective
  void print_costs(const Timing& timing) const;     ///< collective

  nlohmann::json saved(const Timing& timing) const;  ///< collective
  void restore(const nlohmann::json& json);

 private:
  double cpu_seconds() const;  ///< of all ranks; collective
  nlohmann::json costs(const Timing& timing, double cpu) const;

  MPI_Comm comm_;
  bool first_;  ///< rank 0 alone tells
  int ranks_ = 1;
  long cells_ = 0;
  std::string history_;
  Tally tally_;
  double last_progress_ = 0;
  double start_time_ = 0;  ///< simulated, of this process [s]
  long start_steps_ = 0;
};

}  // namespace bedscope::coupled
