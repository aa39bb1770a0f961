// SPDX-License-Identifier: GPL-3.0-or-later
// Who leaves and who enters: a constant inventory, or a constant feed.
#pragma once

#include <cstdint>
#include <vector>

#include "cases/coupled/dem.hpp"

namespace bedscope::coupled {

/// Everything of it that a checkpoint keeps.
struct FeedState {
  std::uint64_t draws = 0;     ///< random numbers used
  std::vector<double> due;     ///< of each species: mass that should have entered and has not [kg]
  long left = 0, entered = 0;  ///< particles
  double mass_left = 0, mass_entered = 0;  ///< [kg]
  std::vector<NewParticle> waiting;        ///< left, and found no free place yet
};

class Feed {
 public:
  Feed(const Inventory& inventory, double gas_step, MPI_Comm comm);

  /// Takes out who left and places who is due; true where anything changed, so that the particles
  /// must be mapped again. To be called each gas step. Collective.
  bool look(long step, const Particles& particles, Dem& dem);

  double due() const;  ///< of all species [kg]

  FeedState state;

 private:
  double random();
  void take_leavers(const Particles& particles, std::vector<int>& leaving);
  bool find_place(NewParticle& particle, std::vector<double>& occupied);
  std::vector<double> spheres_near_entry(const Particles& particles, double reach) const;

  const Inventory inventory_;
  double gas_step_;
  MPI_Comm comm_;
};

}  // namespace bedscope::coupled
