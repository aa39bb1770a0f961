// SPDX-License-Identifier: BSD-3-Clause
#include "cases/observed.hpp"

#include <fmt/format.h>

#include <cmath>

#include "readers/error.hpp"

namespace bedscope::cases {
namespace {

void put_species(const Observed& observed, Scene& scene, std::vector<std::string>& remarks) {
  auto before = scene.species;
  before.resize(observed.species.size(), before.empty() ? Species{} : before.back());
  if (!scene.species.empty() && scene.species.size() != observed.species.size())
    remarks.push_back(fmt::format("the scene has {} species, the run {} types",
                                  scene.species.size(), observed.species.size()));
  double volume = 0, number = 0;
  for (std::size_t i = 0; i < observed.species.size(); ++i) {
    const auto& seen = observed.species[i];
    const auto differs = [&](const char* what, double told, double found) {
      if (told > 0 && found > 0 && std::abs(found / told - 1) > 1e-4)
        remarks.push_back(fmt::format("{} of type {}: the run has {:.5g}, the scene says {:.5g}",
                                      what, seen.name, found, told));
    };
    differs("diameter", before[i].diameter, seen.diameter);
    if (before[i].name.empty()) before[i].name = seen.name;
    if (seen.diameter > 0) before[i].diameter = seen.diameter;
    if (!(before[i].diameter > 0))
      throw InputError(
          "type {}: no size is known: expected a radius in the dump, the study or a scene",
          seen.name);
    before[i].spread = seen.spread;
    if (seen.density > 0) {
      differs("density", before[i].density, seen.density);
      before[i].density = seen.density;
    }
    before[i].fraction = observed.numbers[i] * physics::sphere_volume(before[i].diameter);
    volume += before[i].fraction;
    number += observed.numbers[i];
  }
  for (auto& s : before) s.fraction = volume > 0 ? s.fraction / volume : 1;
  scene.species = before;
  scene.particles.number = std::llround(number);
}

}  // namespace

Scene observed_scene(const std::optional<Scene>& scene, const Observed& observed,
                     std::vector<std::string>& remarks) {
  Scene seen = scene.value_or(Scene{});
  if (!scene) {
    seen.title = "what the run tells";
    seen.geometry = {observed.extent[0], observed.extent[1], observed.extent[2]};
    seen.particles.arrangement = Arrangement::uniform;
    remarks.emplace_back(
        "no scene is known: gas, contacts, grid and steps, and all that depends on them, are left "
        "out (--scene SCENE.toml)");
  }
  put_species(observed, seen, remarks);
  if (observed.impact_velocity > 0) seen.contacts.impact_velocity = observed.impact_velocity;
  if (seen.gas && observed.gas_density > 0) seen.gas->density = observed.gas_density;
  return seen;
}

}  // namespace bedscope::cases
