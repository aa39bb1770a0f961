// SPDX-License-Identifier: GPL-3.0-or-later
// What gas and particles do to each other in a step: drag, pressure gradient, heat.
//
//   F_i = K_i (<u>_i - v_i) - V_i rho <grad p' + g>_i,  K_i = 3 pi mu d eps_i F(eps_i, Re_i)
//
// <.>_i is the mean over the particle's points, by the weights of Mapping, so that the gas loses
// what the particles get. Q_i = h A (<T>_i - T_i), h by Gunn.
#pragma once

#include "cases/coupled/dem.hpp"
#include "cases/coupled/gas.hpp"
#include "cases/coupled/mapping.hpp"
#include "cases/coupled/timing.hpp"

namespace bedscope::coupled {

/// Sums over the particles of all ranks.
struct ParticleSums {
  Vec3 drag{}, pressure_force{};  ///< [N]
  double mass = 0, volume = 0;    ///< [kg], [m3]
  Vec3 momentum{};                ///< [kg m/s]
  double height = 0;              ///< of the centre of mass along gravity's reverse [m]
  double heat = 0;                ///< from the gas [W]
  double temperature = 0;         ///< mean [K]
  long count = 0;
};

class Coupling {
 public:
  Coupling(Gas& gas, Dem& dem, const CellFinder& finder, MPI_Comm comm, Timing& timing);

  /// Reads the particles and maps them: their volume is in the gas' voidage then.
  void map();
  /// Exchange coefficients from the present gas and particles, handed to the gas.
  void exchange();
  /// Forces and heat from the present gas, handed to the particles.
  void act();
  /// Cell means of the particles' velocity, for output.
  void output_fields();

  const Particles& particles() const { return particles_; }
  ParticleSums sums() const;

 private:
  Gas& gas_;
  Dem& dem_;
  Mapping mapping_;
  MPI_Comm comm_;
  Timing& timing_;
  Particles particles_;
  std::vector<double> volume_;                   // of each particle [m3]
  std::vector<double> k_, ha_;                   // K_i [kg/s], h A [W/K]
  std::vector<double> force_, pressure_, heat_;  // drag, pressure force, heat of each particle
  std::vector<double> explicit_velocity_;        // the gas velocity that explicit drag used
};

}  // namespace bedscope::coupled
