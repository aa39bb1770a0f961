// SPDX-License-Identifier: GPL-3.0-or-later
// Which share of each particle is in which gas cell: the one set of weights by which volume and
// momentum go to the gas and the gas' velocity and pressure gradient come back.
#pragma once

#include <vector>

#include "cases/coupled/cell_finder.hpp"
#include "cases/coupled/exchange.hpp"

namespace bedscope::coupled {

class Mapping {
 public:
  /// divided: 29 points in each sphere, its centre and two shells of 14 (as CFDEMcoupling's
  /// dividedVoidFraction); else the centre alone.
  Mapping(const CellFinder& finder, MPI_Comm comm, bool divided);

  /// Spheres of this rank of LIGGGHTS. What lies outside of the mesh counts to the cells that the
  /// rest of the sphere is in; a sphere wholly outside has no cell. Collective, as all here.
  void map(int particles, const double* positions, const double* radii);

  /// Adds to each cell its share of the particles' values (width numbers each).
  void deposit(const std::vector<double>& owned, std::vector<double>& cells, int width);

  /// Each particle's weighted mean of the cells' values (width numbers a cell).
  void gather(const std::vector<double>& cells, std::vector<double>& owned, int width);

  /// 0 where no point of the particle lies in the mesh.
  bool inside(int particle) const { return points_[particle] > 0; }

 private:
  void add(int cell);

  const CellFinder& finder_;
  Exchange exchange_;
  bool divided_;
  std::vector<double> points_;                      // found, of each owned particle, on all ranks
  std::vector<int> first_, cell_;                   // of each copy: its cells here ...
  std::vector<double> weight_;                      // ... and their share of the particle
  std::vector<double> spheres_, copied_, partial_;  // kept to spare allocations
};

}  // namespace bedscope::coupled
