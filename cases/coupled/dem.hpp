// SPDX-License-Identifier: GPL-3.0-or-later
// LIGGGHTS as a library: runs the deck's particles and lets the program see and change them.
#pragma once

#include <mpi.h>

#include <memory>
#include <string>
#include <vector>

#include "cases/coupled/settings.hpp"

namespace bedscope::coupled {

/// A particle to be placed.
struct NewParticle {
  int type;
  double diameter, density;
  Vec3 position, velocity;
};

/// The particles of this rank that move in the gas, as LIGGGHTS has them: a copy, in its order.
struct Particles {
  std::vector<int> local;  ///< LIGGGHTS' index on this rank
  std::vector<int> type;
  std::vector<double> position, velocity;  ///< 3 an entry [m], [m/s]
  std::vector<double> radius, mass;        ///< [m], [kg]
  std::vector<double> temperature;         ///< [K], with heat
  int count() const { return int(local.size()); }
};

class Dem {
 public:
  Dem(MPI_Comm comm, std::string deck, std::vector<int> wall_types, bool heat);
  ~Dem();

  /// Reads the deck; from LIGGGHTS' restart file where a name is given. Anything that was open is
  /// closed first: a run that goes on after a checkpoint reads it as one that is resumed does.
  void open(const std::string& restart = {});
  void write_restart(const std::string& file);

  void run(int steps);
  void read(Particles& particles);
  /// Force of the gas on each particle [N] and heat from it [W], held during the next run.
  void set_force(const Particles& particles, const std::vector<double>& force);
  void set_heat(const Particles& particles, const std::vector<double>& heat);

  /// Deletes particles of this rank.
  void remove(std::vector<int> local);
  /// Every rank gives the same list; the one whose part it is places the particle, under new ids.
  /// It joins the groups to which all particles of its type belonged when the deck was read; throws
  /// BadInput where the deck has groups and there was none of its type.
  void place(const std::vector<NewParticle>& particles);

  long count() const;        ///< all of LIGGGHTS' particles, on all ranks
  double time_step() const;  ///< [s]
  long step() const;
  MPI_Comm comm() const { return comm_; }

 private:
  void set_property(const char* name, bool vector, const Particles& particles,
                    const std::vector<double>& values);
  bool is_wall(int type) const;
  void learn_groups();
  void renumber();

  struct Handle;
  MPI_Comm comm_;
  std::string deck_;
  std::vector<int> wall_types_;
  bool heat_;
  std::unique_ptr<Handle> handle_;
  std::vector<int> groups_;  ///< of each type, LIGGGHTS' bits; 0 while none of it has been seen
  int next_id_ = 1;
  long log_start_ = 0;   ///< where the log of the deck ends and that of the runs begins
  bool changed_ = true;  ///< positions were touched: LIGGGHTS must set up before it runs
};

}  // namespace bedscope::coupled
