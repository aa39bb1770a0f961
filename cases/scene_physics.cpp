// SPDX-License-Identifier: BSD-3-Clause
#include "cases/scene_physics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/contact.hpp"
#include "physics/heat_transfer.hpp"
#include "physics/minimum_fluidisation.hpp"
#include "physics/packing.hpp"
#include "physics/particle_motion.hpp"
#include "physics/well_mixed_bed.hpp"

namespace bedscope::cases {
namespace {

using namespace physics;

/// Two particles, or a particle and a wall, that can meet.
struct Pair {
  const Contact& contact;
  bool wall;
  double modulus, mass, radius;  ///< effective; the modulus of Hertz only
  double smaller_radius;
};

template <class Visit>
void each_pair(const Scene& scene, Visit visit) {
  const auto& c = scene.contacts;
  const auto modulus = [&](const Contact& other) {
    if (c.model == ContactModel::linear) return 0.0;
    return effective_modulus(c.particle.young, c.particle.poisson, other.young, other.poisson);
  };
  for (std::size_t i = 0; i < scene.species.size(); ++i) {
    const auto& a = scene.species[i];
    if (!(a.density > 0)) continue;
    const double mass = sphere_mass(a.sphere()), radius = a.diameter / 2;
    visit(Pair{c.wall, true, modulus(c.wall), mass, radius, radius});
    for (std::size_t j = i; j < scene.species.size(); ++j) {
      const auto& b = scene.species[j];
      if (!(b.density > 0)) continue;
      visit(Pair{c.particle, false, modulus(c.particle),
                 effective_mass(mass, sphere_mass(b.sphere())),
                 effective_radius(radius, b.diameter / 2), std::min(radius, b.diameter / 2)});
    }
  }
}

bool contact_known(const Scene& scene) {
  const auto& c = scene.contacts;
  return c.model == ContactModel::linear ? c.particle.normal_stiffness > 0 : c.particle.young > 0;
}

Overlap worst_overlap(const Scene& scene, bool walls) {
  const double v = impact_velocity(scene);
  if (!contact_known(scene)) return {0, 0};
  Overlap worst{0, std::numeric_limits<double>::infinity()};
  each_pair(scene, [&](const Pair& pair) {
    if (pair.wall != walls) return;
    const bool linear = scene.contacts.model == ContactModel::linear;
    const auto at = [&](double speed) {
      return linear ? largest_overlap(pair.contact.normal_stiffness, pair.mass, speed,
                                      pair.contact.restitution)
                    : hertz_largest_overlap(pair.modulus, pair.radius, pair.mass, speed);
    };
    if (v > 0) worst.ratio = std::max(worst.ratio, at(v) / pair.smaller_radius);
    const double power = linear ? 1 : 0.8;  // overlap ~ v or v^(4/5)
    worst.velocity_of_one_percent = std::min(
        worst.velocity_of_one_percent, std::pow(0.01 * pair.smaller_radius / at(1), 1 / power));
  });
  return worst;
}

}  // namespace

double settled_voidage(const Scene& scene) {
  constexpr double settled = 0.4;
  if (scene.particles.arrangement != Arrangement::lattice) return settled;
  return std::max(1 - densest_packing, 1 - mean_holdup(scene));
}

double dense_voidage(const Scene& scene) {
  if (scene.particles.arrangement != Arrangement::single) return settled_voidage(scene);
  const auto edge = cell_edges(scene);
  const double cell = edge[0] * edge[1] * edge[2];
  const double room = cell > 0 ? cell : cross_section(scene) * scene.geometry.height;
  return std::max(1 - densest_packing, 1 - sphere_volume(largest_diameter(scene)) / room);
}

const NamedDragLaw& law_of(const Scene& scene) { return drag_law(scene.models.drag); }

bool falls(const Scene& scene, const Species& species) {
  return scene.gas && scene.gravity > 0 && species.density > scene.gas->density;
}

double terminal_velocity(const Scene& scene, const Species& species) {
  return physics::terminal_velocity(species.sphere(), scene.gas->gas(), scene.gravity,
                                    law_of(scene).law);
}

double minimum_fluidisation(const Scene& scene, const Species& species) {
  return minimum_fluidisation_velocity(species.sphere(), scene.gas->gas(), scene.gravity,
                                       settled_voidage(scene), law_of(scene).law);
}

double dense_exchange(const Scene& scene) {
  const double voidage = dense_voidage(scene), d = smallest_diameter(scene);
  const double re = reynolds(scene.gas->gas(), scene.gas->velocity, d);
  return momentum_exchange(law_of(scene).law(voidage, re), voidage, scene.gas->gas(), d);
}

double dense_slope(const Scene& scene) {
  if (!(scene.gas->velocity > 0)) return 0;
  const double re = reynolds(scene.gas->gas(), scene.gas->velocity, smallest_diameter(scene));
  return drag_slope(law_of(scene).law, dense_voidage(scene), re);
}

double impact_velocity(const Scene& scene) {
  if (scene.contacts.impact_velocity > 0) return scene.contacts.impact_velocity;
  double fastest = 0;
  if (scene.gas)
    for (const auto& s : scene.species)
      if (falls(scene, s)) fastest = std::max(fastest, terminal_velocity(scene, s));
  if (scene.gas) fastest = std::min(fastest, scene.gas->velocity);
  const auto& v = scene.particles.velocity;
  return std::max({fastest, std::hypot(v[0], v[1], v[2]), std::abs(inlet_velocity(scene))});
}

double shortest_contact(const Scene& scene) {
  const double v = impact_velocity(scene);
  double shortest = std::numeric_limits<double>::infinity();
  if (contact_known(scene))
    each_pair(scene, [&](const Pair& pair) {
      const auto& c = pair.contact;
      if (scene.contacts.model == ContactModel::linear)
        shortest = std::min(shortest, contact_time(c.normal_stiffness, pair.mass, c.restitution));
      else if (v > 0)
        shortest = std::min(shortest, hertz_contact_time(pair.modulus, pair.radius, pair.mass, v));
    });
  return std::isfinite(shortest) ? shortest : 0;
}

Overlap particle_overlap(const Scene& scene) { return worst_overlap(scene, false); }
Overlap wall_overlap(const Scene& scene) { return worst_overlap(scene, true); }

double heat_transfer(const Scene& scene, const Species& species) {
  if (!scene.gas || scene.gas->heat_capacity == 0 || scene.gas->conductivity == 0) return 0;
  const auto& gas = *scene.gas;
  const double re = reynolds(gas.gas(), gas.velocity, species.diameter);
  const double pr = prandtl(gas.viscosity, gas.heat_capacity, gas.conductivity);
  return heat_transfer_coefficient(gunn_nusselt(dense_voidage(scene), re, pr), gas.conductivity,
                                   species.diameter);
}

BedHeat bed_heat(const Scene& scene) {
  const auto& gas = *scene.gas;
  const auto& first = scene.species[0];
  const WellMixedBed bed{gas.temperature,
                         gas.velocity,
                         gas.density * gas.heat_capacity,
                         solids_volume(scene) / cross_section(scene),
                         first.diameter,
                         heat_transfer(scene, first)};
  std::vector<HeatedFraction> fractions;
  double capacity = 0;
  for (const auto& s : scene.species) {
    fractions.push_back({s.fraction, s.source});
    capacity += s.fraction * s.density * s.heat_capacity;
  }
  const auto temperatures = equilibrium_temperatures(bed, fractions);
  double mean = 0;
  for (std::size_t i = 0; i < fractions.size(); ++i)
    mean += fractions[i].fraction * temperatures.particle[i];
  return {mean, thermal_time(bed, capacity)};
}

}  // namespace bedscope::cases
