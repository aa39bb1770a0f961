// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "cases/check.hpp"
#include "cases/scene_physics.hpp"
#include "physics/heat_transfer.hpp"
#include "physics/minimum_fluidisation.hpp"
#include "physics/packing.hpp"
#include "physics/particle_motion.hpp"
#include "physics/regimes.hpp"

namespace bedscope::cases {
namespace {

using namespace physics;

class Numbers {
 public:
  void add(std::string name, double value, std::string unit = "-") {
    list.push_back({std::move(name), value, std::move(unit)});
  }
  std::vector<SceneNumber> list;
};

/// "u_t", or "u_t (large)" where there are several species.
std::string named(const Scene& scene, const char* name, const Species& species) {
  return scene.species.size() == 1 ? name : fmt::format("{} ({})", name, species.name);
}

void of_species(const Scene& scene, const Species& s, Numbers& numbers) {
  const auto add = [&](const char* name, double value, const char* unit = "-") {
    numbers.add(named(scene, name, s), value, unit);
  };
  if (!scene.gas || !(s.density > 0)) return;
  const auto gas = scene.gas->gas();
  const double u = scene.gas->velocity;
  add("Re", reynolds(gas, u, s.diameter));
  if (scene.gravity > 0) {
    add("Ar", archimedes(s.sphere(), gas, scene.gravity));
    add("Fr", froude(u, scene.gravity, s.diameter));
  }
  if (scene.geometry.height > 0)
    add("St", stokes_number(relaxation_time(s.sphere(), gas), u, scene.geometry.height));
  if (falls(scene, s)) {
    add("u_mf", minimum_fluidisation(scene, s), "m/s");
    add("u_mf by Wen and Yu's correlation",
        minimum_fluidisation_velocity_wen_yu(s.sphere(), gas, scene.gravity), "m/s");
    add("u_t", terminal_velocity(scene, s), "m/s");
    add("u_t by Schiller and Naumann", physics::terminal_velocity(s.sphere(), gas, scene.gravity),
        "m/s");
    numbers.list.push_back({named(scene, "Geldart group", s), std::nan(""),
                            std::string(1, geldart_group(s.sphere(), gas.density, scene.gravity))});
  }
  if (const double h = heat_transfer(scene, s); h > 0) {
    add("h", h, "W/m2/K");
    if (s.conductivity > 0) add("Bi", biot(h, s.diameter, s.conductivity));
    add("conductivity of Bi = 0.1", h * s.diameter / 0.6, "W/m/K");
  }
}

void of_contacts(const Scene& scene, Numbers& numbers) {
  const double contact = shortest_contact(scene);
  if (scene.particles.fixed || contact == 0) return;
  numbers.add("contact time", contact, "s");
  if (scene.numerics.dem_step > 0)
    numbers.add("steps in a contact", contact / scene.numerics.dem_step);
  numbers.add("impact velocity", impact_velocity(scene), "m/s");
  numbers.add("impact velocity of 1 % overlap", particle_overlap(scene).velocity_of_one_percent,
              "m/s");
  numbers.add("impact velocity of 1 % overlap at walls",
              wall_overlap(scene).velocity_of_one_percent, "m/s");
  if (scene.contacts.model == ContactModel::linear) {
    numbers.add("tangential stiffness", scene.contacts.particle.tangential_stiffness(), "N/m");
    numbers.add("tangential stiffness at walls", scene.contacts.wall.tangential_stiffness(), "N/m");
  }
}

void of_bed(const Scene& scene, Numbers& numbers) {
  const double holdup = mean_holdup(scene);
  if (!std::isfinite(holdup)) return;
  numbers.add("particles", static_cast<double>(scene.particles.number));
  numbers.add("holdup", holdup);
  const double density = mean_density(scene);
  if (!(density > 0)) return;
  numbers.add("solids mass", solids_mass(scene), "kg");
  if (!scene.gas) return;
  const auto& gas = *scene.gas;
  if (holdup < 1) numbers.add("mass loading", mass_loading(holdup, density, gas.density));
  if (holdup < random_close_packing && scene.geometry.width > 0)
    numbers.add("Bagnold", bagnold({smallest_diameter(scene), density}, gas.viscosity, holdup,
                                   2 * gas.velocity / scene.geometry.width, random_close_packing));
  if (scene.gravity > 0)
    numbers.add("pressure drop of the weight",
                bed_pressure_drop(solids_mass(scene), cross_section(scene), density, gas.density,
                                  scene.gravity),
                "Pa");
  if (scene.inlet.particles == Supply::feed) numbers.add("feed holdup", inlet_holdup(scene));
}

void of_heat(const Scene& scene, Numbers& numbers) {
  if (!scene.models.energy || !(scene.gas->velocity > 0)) return;
  const auto& gas = *scene.gas;
  numbers.add("Pr", prandtl(gas.viscosity, gas.heat_capacity, gas.conductivity));
  const auto heat = bed_heat(scene);
  numbers.add("thermal time", heat.time, "s");
  if (!scene.particles.fixed)
    numbers.add("mean particle temperature at equilibrium", heat.equilibrium, "K");
}

void of_grid(const Scene& scene, Numbers& numbers) {
  const auto edge = cell_edges(scene);
  if (edge[0] == 0) return;
  const double d = largest_diameter(scene);
  numbers.add("dV/V_p", edge[0] * edge[1] * edge[2] / sphere_volume(d));
  numbers.add("D/d", scene.geometry.depth / d);
  numbers.add("cells in the smallest cluster", scene.smallest_cluster / (edge[0] * edge[2]));
}

}  // namespace

std::vector<SceneNumber> scene_numbers(const Scene& scene) {
  Numbers numbers;
  for (const auto& s : scene.species) of_species(scene, s, numbers);
  of_bed(scene, numbers);
  of_contacts(scene, numbers);
  of_grid(scene, numbers);
  of_heat(scene, numbers);
  return numbers.list;
}

CheckReport check_scene(const Scene& scene) {
  return {scene_numbers(scene), scene_limits(scene), scene_advice(scene)};
}

}  // namespace bedscope::cases
