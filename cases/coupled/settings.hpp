// SPDX-License-Identifier: GPL-3.0-or-later
// What CFD/constant/coupledProperties and CFD/system/controlDict say: see README.md.
// C++17, as all headers here that OpenFOAM's side includes.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace bedscope::coupled {

using Vec3 = std::array<double, 3>;

enum class Policy { closed, constant, fed };

struct Species {
  int type;
  double diameter, density;  ///< [m], [kg/m3]
  double fraction;           ///< of the mass fed
};

struct Inventory {
  Policy policy = Policy::closed;
  Vec3 outlet_point{}, outlet_normal{};
  Vec3 entry_min{}, entry_max{}, entry_velocity{};
  double mass_flow = 0;  ///< [kg/s]
  std::vector<Species> species;
  int every = 5;  ///< gas steps
  int seed = 1;
};

struct Energy {
  double heat_capacity, conductivity;          ///< of the gas [J/kg/K], [W/m/K]
  std::optional<double> exchange;              ///< h [W/m2/K]; Gunn's where empty
  std::string axial_conduction = "effective";  ///< effective, molecular, none
};

struct Settings {
  std::string title;
  double gas_density = 0, gas_viscosity = 0;
  Vec3 gravity{};
  std::string drag;  ///< a law of physics/drag.hpp, or none
  bool implicit_drag = true;
  bool divided = true;  ///< void fraction by satellite points
  double voidage_floor = 0.25;
  int dem_steps = 1;
  std::vector<int> wall_types;
  Inventory inventory;
  std::optional<Energy> energy;
  double checkpoint_interval = 0, history_interval = 0;  ///< [s]
  double progress_interval = 10;                         ///< wall clock [s]
  std::string inlet = "inlet", outlet = "outlet";
  double time_step = 0, end_time = 0, write_interval = 0;  ///< [s]
};

}  // namespace bedscope::coupled
