// SPDX-License-Identifier: BSD-3-Clause
#include "cases/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/contact.hpp"

namespace bedscope::cases {
namespace {

using physics::sphere_volume;

/// Mean of the volume over diameters uniform within +- spread: V (1 + (spread/d)^2).
double mean_volume(const Species& s) {
  return sphere_volume(s.diameter) * (1 + s.spread * s.spread / (s.diameter * s.diameter));
}

}  // namespace

double Contact::tangential_stiffness() const {
  return normal_stiffness *
         physics::tangential_stiffness_ratio(restitution, tangential_restitution);
}

std::vector<std::int64_t> species_numbers(const Scene& scene) {
  double sum = 0;
  for (const auto& s : scene.species) sum += s.fraction / mean_volume(s);
  std::vector<std::int64_t> numbers;
  std::int64_t rest = scene.particles.number;
  for (const auto& s : scene.species) {
    const double exact =
        static_cast<double>(scene.particles.number) * s.fraction / mean_volume(s) / sum;
    numbers.push_back(std::min(rest, static_cast<std::int64_t>(std::llround(exact))));
    rest -= numbers.back();
  }
  numbers.back() += rest;
  return numbers;
}

double solids_volume(const Scene& scene) {
  const auto numbers = species_numbers(scene);
  double volume = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    volume += static_cast<double>(numbers[i]) * mean_volume(scene.species[i]);
  return volume;
}

double solids_mass(const Scene& scene) {
  const auto numbers = species_numbers(scene);
  double mass = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    mass +=
        static_cast<double>(numbers[i]) * mean_volume(scene.species[i]) * scene.species[i].density;
  return mass;
}

double cross_section(const Scene& scene) { return scene.geometry.width * scene.geometry.depth; }

double mean_holdup(const Scene& scene) {
  return solids_volume(scene) / (cross_section(scene) * scene.geometry.height);
}

Vector cell_edges(const Scene& scene) {
  const auto& g = scene.geometry;
  const auto& n = scene.numerics.grid;
  if (n[0] == 0) return {};
  return {g.width / n[0], g.depth / n[1], g.height / n[2]};
}

int head_layers(const Scene& scene) {
  if (!scene.outlet.lateral() || scene.numerics.grid[0] == 0) return 0;
  return std::max(1, static_cast<int>(std::lround(scene.outlet.height / cell_edges(scene)[2])));
}

double total_height(const Scene& scene) {
  return scene.geometry.height + (scene.outlet.lateral() ? scene.outlet.height : 0);
}

double smallest_diameter(const Scene& scene) {
  double d = std::numeric_limits<double>::infinity();
  for (const auto& s : scene.species) d = std::min(d, s.diameter - s.spread);
  return d;
}

double largest_diameter(const Scene& scene) {
  double d = 0;
  for (const auto& s : scene.species) d = std::max(d, s.diameter + s.spread);
  return d;
}

double inlet_area(const Scene& scene) {
  if (scene.inlet.place == Place::bottom) return cross_section(scene);
  return (scene.inlet.to - scene.inlet.from) * scene.geometry.depth;
}

double inlet_velocity(const Scene& scene) {
  const auto& v = scene.inlet.velocity;
  switch (scene.inlet.place) {
    case Place::left:
      return v[0];
    case Place::right:
      return -v[0];
    default:
      return v[2];
  }
}

double inlet_holdup(const Scene& scene) {
  const double velocity = inlet_velocity(scene);
  if (!(velocity > 0)) return std::numeric_limits<double>::infinity();
  return scene.inlet.flux * cross_section(scene) /
         (mean_density(scene) * velocity * inlet_area(scene));
}

std::pair<Vector, Vector> entry_box(const Scene& scene) {
  const auto& g = scene.geometry;
  const auto& in = scene.inlet;
  constexpr double batch = 1e-3;   // s of feed that must find room at once
  constexpr double crowded = 0.2;  // holdup at which random places are still found quickly
  double thickness = 3 * largest_diameter(scene);
  if (in.particles == Supply::feed)
    thickness = std::max(thickness, in.flux * cross_section(scene) * batch /
                                        (mean_density(scene) * crowded * inlet_area(scene)));
  if (in.place == Place::bottom) {
    if (in.particles == Supply::inventory)  // as much room as half a second of leaving may need
      thickness = std::max(thickness, std::min(0.03, g.height / 10));
    return {{0, 0, 0}, {g.width, g.depth, std::min(thickness, g.height)}};
  }
  thickness = std::min(thickness, g.width);
  const double x = in.place == Place::left ? 0 : g.width - thickness;
  return {{x, 0, in.from}, {x + thickness, g.depth, in.to}};
}

double mean_density(const Scene& scene) { return solids_mass(scene) / solids_volume(scene); }

physics::ScaledScene as_scaled_scene(const Scene& scene, std::size_t species) {
  const auto& s = scene.species[species];
  const auto& g = scene.geometry;
  const auto cell = cell_edges(scene);
  const auto& contact = scene.contacts.particle;
  // A Hertz contact has no stiffness of its own; E d scales as the rule wants its k_n to.
  const double stiffness = scene.contacts.model == ContactModel::linear
                               ? contact.normal_stiffness
                               : contact.young * s.diameter;
  const double damping = physics::damping_coefficient(
      stiffness, physics::sphere_mass(s.sphere()) / 2, contact.restitution);
  const auto gas = scene.gas.value_or(GasPhase{});
  return {s.diameter,    s.density,     static_cast<double>(species_numbers(scene)[species]),
          gas.density,   gas.viscosity, gas.velocity,
          scene.gravity, stiffness,     damping,
          g.width,       g.depth,       g.height,
          cell[0],       cell[1],       cell[2]};
}

}  // namespace bedscope::cases
