// SPDX-License-Identifier: GPL-3.0-or-later
// The gas: volume-averaged Navier-Stokes equations, model A, by OpenFOAM's finite volumes.
//
//   d(eps)/dt + div(eps u) = 0
//   d(eps u)/dt + div(eps u u) = -eps grad p' + div(eps nu dev2 grad u) + (S - K u) / rho
//
// u interstitial; p' = (p - rho g.x) / rho; K and S = sum K_i v_i are what the particles exchange.
#pragma once

#include <cstdio>
#include <memory>
#include <vector>

#include "cases/coupled/cell_finder.hpp"
#include "cases/coupled/settings.hpp"

namespace bedscope::coupled {

/// Sums over all ranks that tell whether a step kept what it must.
struct GasBalance {
  double inflow = 0, outflow = 0;    ///< of gas volume [m3/s]
  double storage = 0;                ///< d/dt of the gas' volume [m3/s]
  double worst_cell = 0;             ///< largest |d(eps)/dt + div(eps u)| x time step
  double pressure_drop = 0;          ///< inlet to outlet, mean of the patch, without rho g h [Pa]
  double courant = 0;                ///< largest u dt / dx
  double heat_in = 0, heat_out = 0;  ///< convected rho c T above 0 K through the boundary [W]
  double heat_content = 0;           ///< of the gas, above 0 K [J]
  double outlet_temperature = 0;     ///< weighted by outflow [K]
};

class Gas {
 public:
  /// Opens the OpenFOAM case CFD/ of the current folder. Throws BadInput.
  explicit Gas(bool parallel);
  ~Gas();

  const Settings& settings() const;
  MeshGeometry geometry() const;
  double time() const;  ///< [s]
  long step() const;
  int cells() const;

  /// Cell values to and from, each rank's own. voidage: solids volume of each cell in, voidage with
  /// the floor applied out.
  void set_solids(const std::vector<double>& solids_volume);
  /// The voidage just set is that of the past, too: particles were put in or taken out.
  void forget_old_voidage();
  const std::vector<double>& voidage() const;
  void get_velocity(std::vector<double>& cells) const;           // 3 a cell [m/s]
  void get_pressure_gradient(std::vector<double>& cells) const;  // of p', 3 a cell [m/s2]
  void get_temperature(std::vector<double>& cells) const;
  /// K [kg/s] and S [N] of each cell, not yet divided by its volume.
  void set_exchange(const std::vector<double>& k, const std::vector<double>& k_velocity);
  /// sum h A [W/K] and sum h A T [W] of each cell.
  void set_heat_exchange(const std::vector<double>& ha, const std::vector<double>& ha_temperature);
  /// Mean velocity of the particles, for output.
  void set_solids_velocity(const std::vector<double>& cells);

  void begin_step();  ///< the time goes on; present fields become old ones
  void solve_flow();
  void solve_energy();
  double pressure_seconds() const;  ///< wall clock spent in pressure equations
  long floor_hits() const;  ///< cells x steps in which the voidage was below the floor; collective
  GasBalance balance() const;

  /// Force of the particles on the gas in the last step [N], as the momentum equation had it.
  Vec3 drag_on_particles() const;
  double heat_to_particles() const;  ///< [W]

  void write() const;                ///< a time directory
  void save(std::FILE* file) const;  ///< all state, to the bit
  void load(std::FILE* file);

 private:
  struct Fields;
  std::unique_ptr<Fields> f_;
};

}  // namespace bedscope::coupled
