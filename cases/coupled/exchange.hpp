// SPDX-License-Identifier: GPL-3.0-or-later
// Particles live where LIGGGHTS has them; their points may lie in the gas cells of other ranks.
#pragma once

#include <mpi.h>

#include <vector>

#include "cases/coupled/settings.hpp"

namespace bedscope::coupled {

/// Copies each particle to the ranks whose gas mesh it may touch, its own among them, and brings
/// sums back. On one rank all of it is the identity.
class Exchange {
 public:
  Exchange(MPI_Comm comm, const Vec3& mesh_low, const Vec3& mesh_high);

  /// Plans for these spheres (positions 3 an entry). Collective, as all that follows.
  void plan(int particles, const double* positions, const double* radii);

  int copies() const { return copies_; }  ///< here, from all ranks

  /// width numbers a particle, owner to copies.
  void forward(const std::vector<double>& owned, std::vector<double>& copied, int width) const;
  /// width numbers a copy, summed over the copies of a particle at its owner, in the order of
  /// ranks.
  void sum_back(const std::vector<double>& copied, std::vector<double>& owned, int width) const;

  MPI_Comm comm() const { return comm_; }
  bool alone() const { return ranks_ == 1; }

 private:
  MPI_Comm comm_;
  int ranks_ = 1;
  std::vector<double> boxes_;  // low and high of each rank's mesh
  int owned_ = 0, copies_ = 0;
  std::vector<int> sent_;                     // the owned particle of each entry sent
  std::vector<int> send_count_, recv_count_;  // particles to and from each rank
};

}  // namespace bedscope::coupled
