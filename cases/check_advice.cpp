// SPDX-License-Identifier: BSD-3-Clause
// No more model than the scene needs: for each what decides, with the scene's numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/check.hpp"
#include "cases/scene_physics.hpp"
#include "physics/contact.hpp"
#include "physics/particle_motion.hpp"
#include "physics/regimes.hpp"

namespace bedscope::cases {
namespace {

using namespace physics;

constexpr const char* no_heat_data =
    "cannot be told: the gas has no heat capacity and conductivity in the scene";

/// Densest holdup that must be reckoned with: of the bed, not of the freeboard above it.
double dense_holdup(const Scene& scene) {
  const bool bed = scene.particles.arrangement == Arrangement::bed;
  return bed ? 1 - dense_voidage(scene) : std::min(mean_holdup(scene), 1.0);
}

Advice two_way(const Scene& scene) {
  const double loading =
      mass_loading(std::min(dense_holdup(scene), 0.99), mean_density(scene), scene.gas->density);
  const bool needed = needed_coupling(dense_holdup(scene)) != Coupling::one_way || loading > 0.1;
  return {
      "two-way coupling", needed,
      fmt::format("holdup {:.3g}, mass loading {:.3g}: the particles move the gas above a holdup "
                  "of 1e-6 (Elghobashi 1994) or a loading of 0.1",
                  dense_holdup(scene), loading)};
}

Advice four_way(const Scene& scene) {
  if (scene.particles.fixed)
    return {"four-way coupling", false, "the particles are fixed: they never meet"};
  const auto coupling = needed_coupling(dense_holdup(scene));
  return {"four-way coupling", coupling == Coupling::four_way,
          fmt::format("holdup {:.3g}: particles meet each other above 1e-3 (Elghobashi 1994)",
                      dense_holdup(scene))};
}

Advice rotation(const Scene& scene) {
  const double friction = scene.contacts.particle.friction;
  const bool meet =
      !scene.particles.fixed && needed_coupling(dense_holdup(scene)) == Coupling::four_way;
  const bool impact = scene.particles.arrangement == Arrangement::single;
  return {
      "rotation and friction", (meet || impact) && friction > 0,
      meet || impact
          ? fmt::format("contacts decide the motion and the friction coefficient is {:.3g}: "
                        "rotating, rubbing spheres lose several times the energy of smooth ones "
                        "(Goldschmidt, Beetstra and Kuipers 2004)",
                        friction)
          : "too few contacts for friction to matter"};
}

Advice added_mass(const Scene& scene) {
  const double ratio = added_mass_ratio(mean_density(scene), scene.gas->density);
  if (scene.particles.fixed)
    return {"added mass", false, "the particles are fixed: nothing is accelerated"};
  return {"added mass", ratio > 0.01,
          fmt::format("rho_g / (2 rho_s) = {:.2g}; below 1 % it is left out (Auton, Hunt and "
                      "Prud'homme 1988)",
                      ratio)};
}

Advice lift(const Scene& scene) {
  if (scene.particles.fixed)
    return {"lift", false, "the particles are fixed: nothing is moved across the flow"};
  const double d = largest_diameter(scene), u = scene.gas->velocity;
  if (!(u > 0)) return {"lift", false, "the gas is at rest"};
  const double slip = std::max(1e-6, impact_velocity(scene));
  const double shear = 2 * u / scene.geometry.width;
  const auto gas = scene.gas->gas();
  const double ratio =
      lift_over_drag(gas, d, slip, shear, law_of(scene).law(1, reynolds(gas, slip, d)));
  return {"lift", ratio > 0.1,
          fmt::format("{:.2g} of the drag in the mean shear {:.3g} 1/s; below 10 % it is left out "
                      "(Saffman 1965, Mei 1992)",
                      ratio, shear)};
}

Advice turbulence(const Scene& scene) {
  const auto gas = scene.gas->gas();
  const double u = scene.gas->velocity;
  const double re = duct_reynolds(gas, u, scene.geometry.width, scene.geometry.depth);
  const double loading =
      mass_loading(std::min(dense_holdup(scene), 0.99), mean_density(scene), scene.gas->density);
  const auto& s = scene.species[0];
  const double gap = 2 * scene.geometry.width * scene.geometry.depth /
                     (scene.geometry.width + scene.geometry.depth);
  const double stokes = u > 0 ? stokes_number(relaxation_time(s.sphere(), gas), u, gap) : 0;
  const bool bed = dense_holdup(scene) > 0.1;
  return {
      "gas turbulence", re > 2300 && !bed && (loading < 1 || stokes < 10),
      fmt::format("Re of the duct {:.3g} (turbulent above 2300), mass loading {:.3g}, Stokes "
                  "number of the large eddies {:.3g}, dense holdup {:.2g}: particles that do not "
                  "follow the eddies (above 10) and outweigh the gas (above 1) rule its motion "
                  "(Elghobashi 1994); in a bed the drag law holds what happens between them",
                  re, loading, stokes, dense_holdup(scene))};
}

bool heated(const Scene& scene) {
  bool sources = false;
  for (const auto& s : scene.species) sources = sources || s.source != 0;
  return sources || (scene.models.energy && scene.gas->temperature != scene.particles.temperature);
}

Advice temperature(const Scene& scene) {
  return {"temperature", heated(scene),
          heated(scene) ? "particles are heated, or gas enters at another temperature"
                        : "no source and one temperature throughout: nothing changes"};
}

/// Contact radius of a particle that carries the bed above it, with the modulus of a hard solid:
/// that of the simulation is often softened, which would exaggerate the contact.
double carrying_contact(const Scene& scene) {
  constexpr double hard = 5e9;  // Pa
  const double d = scene.species[0].diameter;
  const double force = solids_mass(scene) * scene.gravity / cross_section(scene) * d * d;
  const double modulus = effective_modulus(hard, 0.3, hard, 0.3);
  return std::cbrt(0.75 * force * effective_radius(d / 2, d / 2) / modulus);
}

Advice conduction(const Scene& scene) {
  if (!heated(scene)) return {"conduction between particles", false, "no temperature"};
  const auto& s = scene.species[0];
  const auto& n = scene.particles.lattice;
  if (scene.particles.arrangement == Arrangement::lattice &&
      scene.geometry.width / n[0] > s.diameter && scene.geometry.depth / n[1] > s.diameter)
    return {"conduction between particles", false, "the particles of the lattice do not touch"};
  if (heat_transfer(scene, s) == 0) return {"conduction between particles", false, no_heat_data};
  const double k = s.conductivity > 0 ? s.conductivity : 1;
  const double through = 6 * contact_conductance(k, carrying_contact(scene));
  const double to_gas = heat_transfer(scene, s) * std::numbers::pi * s.diameter * s.diameter;
  return {
      "conduction between particles", through > 0.1 * to_gas,
      fmt::format("six contacts under the whole bed, of solids of 5e9 Pa and {:.3g} W/m/K{}, "
                  "carry {:.2g} of what goes to the gas; below 10 % it is left out (Batchelor and "
                  "O'Brien 1977)",
                  k, s.conductivity > 0 ? "" : " (assumed)", through / to_gas)};
}

Advice radiation(const Scene& scene) {
  if (!heated(scene)) return {"radiation", false, "no temperature"};
  if (heat_transfer(scene, scene.species[0]) == 0) return {"radiation", false, no_heat_data};
  double hottest = std::max(scene.gas->temperature, scene.particles.temperature);
  if (!scene.particles.fixed) hottest = std::max(hottest, bed_heat(scene).equilibrium);
  const double h = radiation_coefficient(0.9, hottest);
  const double h_gas = heat_transfer(scene, scene.species[0]);
  return {
      "radiation", h > 0.1 * h_gas,
      fmt::format("4 sigma e T^3 = {:.2g} W/m2/K at {:.0f} K (e = 0.9 assumed) beside {:.3g} to "
                  "the gas; below 10 % it is left out (Stefan-Boltzmann law)",
                  h, hottest, h_gas)};
}

Advice third_dimension(const Scene& scene) {
  const auto& g = scene.geometry;
  const double shape = g.depth / std::min(g.width, g.height);
  const bool slip = scene.walls.front_back_slip;
  const bool thin = shape < 0.2;
  std::string reason;
  if (!thin)
    reason =
        fmt::format("the depth is {:.2g} of the smaller other side: flow along it is free", shape);
  else if (!slip)
    reason = fmt::format(
        "a thin domain ({:.2g}), but the gas sticks to front and back: 12 mu U / D^2 = {:.3g} Pa/m "
        "and more where it is turbulent, against {:.3g} of the solids' weight; resolve the depth",
        shape, plate_friction(scene.gas->viscosity, scene.gas->velocity, g.depth),
        mean_holdup(scene) * mean_density(scene) * scene.gravity);
  else
    reason = fmt::format(
        "a thin domain ({:.2g}) whose front and back let the gas slip: one cell of gas in depth "
        "would "
        "do. {} cells are set; Mu (2022) keeps them so that cells are near cubic",
        shape, scene.numerics.grid[1]);
  return {"third dimension", !thin || !slip,
          reason + ". Spheres are three-dimensional in any case"};
}

Advice polydispersity(const Scene& scene) {
  const double ratio = largest_diameter(scene) / smallest_diameter(scene);
  std::string fall;
  bool apart = false;
  if (scene.species.size() > 1 && falls(scene, scene.species[0]))
    for (const auto& s : scene.species) {
      const double u = terminal_velocity(scene, s) / terminal_velocity(scene, scene.species[0]);
      apart = apart || std::max(u, 1 / u) > 1.25;
      fall += fmt::format(", u_t of {} is {:.3g} of that of {}", s.name, u, scene.species[0].name);
    }
  return {"polydispersity", ratio > 1.25 || apart,
          fmt::format("largest over smallest diameter {:.3g}{}; sizes segregate above about 1.25 "
                      "(Hoomans, Kuipers and van Swaaij 2000)",
                      ratio, fall)};
}

}  // namespace

std::vector<Advice> scene_advice(const Scene& scene) {
  std::vector<Advice> advice;
  const bool solids = scene.geometry.height > 0 && mean_density(scene) > 0;
  if (solids && scene.gas) {
    advice.push_back(two_way(scene));
    advice.push_back(four_way(scene));
    advice.push_back(added_mass(scene));
    advice.push_back(lift(scene));
    advice.push_back(turbulence(scene));
    advice.push_back(temperature(scene));
    advice.push_back(conduction(scene));
    advice.push_back(radiation(scene));
    advice.push_back(third_dimension(scene));
  }
  const auto& contact = scene.contacts.particle;
  if (solids && (contact.normal_stiffness > 0 || contact.young > 0))
    advice.push_back(rotation(scene));
  advice.push_back(polydispersity(scene));
  return advice;
}

}  // namespace bedscope::cases
