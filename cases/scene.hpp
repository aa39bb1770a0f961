// SPDX-License-Identifier: BSD-3-Clause
// A scene: what a simulation of a fluidised bed, a riser or an impact is, told once. Everything
// else (decks, limits, advice, scaled scenes) follows from it. SI units; x is lateral, y the depth,
// z up; the origin is a corner of the box.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "physics/drag.hpp"
#include "physics/phases.hpp"
#include "physics/scaling.hpp"

namespace bedscope::cases {

using Vector = std::array<double, 3>;

/// The straight part; the head of a lateral outlet comes on top of it.
struct Geometry {
  double width = 0, depth = 0, height = 0;  ///< along x, y, z [m]
};

/// Absent in a scene without gas.
struct GasPhase {
  double density = 1.2;       ///< [kg/m3]
  double viscosity = 1.8e-5;  ///< dynamic [Pa s]
  double velocity = 0;        ///< superficial, at the inlet [m/s]
  double heat_capacity = 0;   ///< [J/kg/K]; 0: not given
  double conductivity = 0;    ///< [W/m/K]; 0: not given
  double temperature = 300;   ///< at the inlet [K]

  physics::Gas gas() const { return {density, viscosity}; }
};

struct Species {
  std::string name;
  double diameter = 0;       ///< [m]
  double spread = 0;         ///< diameters are uniform within +- spread [m]
  double density = 0;        ///< [kg/m3]
  double fraction = 1;       ///< of the solids' volume
  double heat_capacity = 0;  ///< [J/kg/K]; 0: not given
  double conductivity = 0;   ///< [W/m/K]; 0: not given
  double source = 0;         ///< heat, in a volume of solids [W/m3]

  physics::Sphere sphere() const { return {diameter, density}; }
};

enum class Arrangement {
  bed,      ///< close above the bottom, to settle
  uniform,  ///< all over the straight part
  lattice,  ///< simple cubic, `lattice` particles along x, y, z
  single,   ///< one, at `position`
};

struct Particles {
  std::int64_t number = 0;  ///< of all species
  Arrangement arrangement = Arrangement::bed;
  std::array<int, 3> lattice{};
  Vector position{}, velocity{};
  bool fixed = false;  ///< they do not move
  double temperature = 300;
  std::uint64_t seed = 1;
};

/// Of two particles, or of a particle and a wall.
struct Contact {
  double normal_stiffness = 0;  ///< [N/m], linear
  double young = 0;             ///< [Pa], Hertz
  double poisson = 0;           ///< Hertz
  double restitution = 1;
  double tangential_restitution = 1;  ///< linear
  double friction = 0;

  double tangential_stiffness() const;  ///< [N/m], linear: equal contact times
};

enum class ContactModel { linear, hertz };

struct Contacts {
  ContactModel model = ContactModel::linear;
  Contact particle, wall;
  double impact_velocity = 0;  ///< of two particles, for the limits [m/s]; 0: by the scene
};

enum class Place { bottom, left, right, top };

enum class Supply {
  closed,     ///< nothing leaves: the outlet is a sieve
  inventory,  ///< what leaves is put back
  feed,       ///< a constant mass flow; the inventory is free
};

struct Inlet {
  Supply particles = Supply::closed;
  double flux = 0;              ///< of the feed, over the cross-section of the riser [kg/m2/s]
  Place place = Place::bottom;  ///< where particles enter
  double from = 0, to = 0;      ///< of the slit in a side wall [m]
  Vector velocity{};            ///< with which they enter [m/s]
};

enum class Head { box, bend, rough_bend };

struct Outlet {
  Place place = Place::top;
  double height = 0;  ///< of a lateral outlet: from the top of the straight part upwards [m]
  Head head = Head::box;

  bool lateral() const { return place != Place::top; }
};

struct Walls {
  bool sides_slip = false, front_back_slip = false;  ///< of the gas
};

struct Numerics {
  std::array<int, 3> grid{};                               ///< gas cells of the straight part
  double dem_step = 0, gas_step = 0, output = 0, end = 0;  ///< [s]
  double average_from = 0;                                 ///< [s]
};

enum class VoidFraction { divided, centre };

struct Models {
  std::string drag = "beetstra";  ///< of physics::drag_laws()
  VoidFraction void_fraction = VoidFraction::divided;
  bool implicit_drag = true;
  bool energy = false;
};

struct Scene {
  std::string title;
  std::vector<std::string> notes;  ///< what was chosen or changed, and why
  double gravity = 9.81;           ///< [m/s2], downwards
  Geometry geometry;
  std::optional<GasPhase> gas;
  std::vector<Species> species;
  Particles particles;
  Contacts contacts;
  Inlet inlet;
  Outlet outlet;
  Walls walls;
  Numerics numerics;
  Models models;
  double smallest_cluster = 60e-6;  ///< [m2]
};

/// Number of each species; they add up to particles.number.
std::vector<std::int64_t> species_numbers(const Scene& scene);

double solids_volume(const Scene& scene);  ///< [m3]
double solids_mass(const Scene& scene);    ///< [kg]
double cross_section(const Scene& scene);  ///< [m2]
double mean_holdup(const Scene& scene);    ///< of the straight part
Vector cell_edges(const Scene& scene);     ///< [m]; 0 without a grid
int head_layers(const Scene& scene);       ///< of cells above the straight part
double total_height(const Scene& scene);   ///< with the head [m]
double smallest_diameter(const Scene& scene);
double largest_diameter(const Scene& scene);

/// Area through which fed particles enter [m2], and their velocity normal to it [m/s].
double inlet_area(const Scene& scene);
double inlet_velocity(const Scene& scene);
/// Holdup with which the feed must come in: flux / (density velocity), of the area.
double inlet_holdup(const Scene& scene);

/// The box in which particles enter, low and high corner [m]: above the bottom or behind the slit,
/// at least 3 largest diameters thick, for a feed so thick that a millisecond of it has a holdup of
/// 0.2 at most.
std::pair<Vector, Vector> entry_box(const Scene& scene);

/// By `density` for a mixture: of its volume [kg/m3].
double mean_density(const Scene& scene);

/// One species as the scaling rule sees it.
physics::ScaledScene as_scaled_scene(const Scene& scene, std::size_t species);

}  // namespace bedscope::cases
