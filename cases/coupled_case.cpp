// SPDX-License-Identifier: BSD-3-Clause
// What bedscope-coupled reads: cases/coupled/README.md.
#include <fmt/format.h>

#include <cmath>

#include "cases/deck.hpp"
#include "cases/foam_text.hpp"

namespace bedscope::cases {
namespace {

std::string triple(const Vector& v) {
  return fmt::format("({:.9g} {:.9g} {:.9g})", v[0], v[1], v[2]);
}

std::string outlet(const Scene& scene) {
  const auto& g = scene.geometry;
  switch (scene.outlet.place) {
    case Place::left:
      return "{ point (0 0 0); normal (-1 0 0); }";
    case Place::right:
      return fmt::format("{{ point {}; normal (1 0 0); }}", triple({g.width, 0, 0}));
    default:
      return fmt::format("{{ point {}; normal (0 0 1); }}", triple({0, 0, g.height}));
  }
}

std::string inventory(const Scene& scene) {
  const auto& in = scene.inlet;
  if (in.particles == Supply::closed) return "inventory { policy closed; }\n";
  const auto [low, high] = entry_box(scene);
  auto text = fmt::format(R"(inventory
{{
    policy  {};
    outlet  {}
    entry   {{ min {}; max {}; velocity {}; }}
    seed    {};
)",
                          in.particles == Supply::feed ? "fed" : "constant", outlet(scene),
                          triple(low), triple(high), triple(in.velocity), scene.particles.seed);
  if (in.particles == Supply::feed) {
    double of_mass = 0;
    for (const auto& s : scene.species) of_mass += s.fraction * s.density;
    text +=
        fmt::format("    massFlow {:.9g};\n    species\n    (\n", in.flux * cross_section(scene));
    for (std::size_t i = 0; i < scene.species.size(); ++i) {
      const auto& s = scene.species[i];
      text +=
          fmt::format("        {{ type {}; diameter {:.9g}; density {:.9g}; fraction {:.9g}; }}\n",
                      i + 1, s.diameter, s.density, s.fraction * s.density / of_mass);
    }
    text += "    );\n";
  }
  return text + "}\n";
}

}  // namespace

DeckFile coupled_properties(const Scene& scene) {
  const auto& n = scene.numerics;
  const auto& m = scene.models;
  std::string title;
  for (const char c : scene.title)
    if (c != '"' && c != '\\' && c != '$') title += c;
  auto text = fmt::format(R"(title        "{}";
gas          {{ density {:.9g}; viscosity {:.9g}; }}
gravity      (0 0 {:.9g});
drag         {};
dragCoupling {};
voidFraction {{ method {}; }}
demSteps     {};
)",
                          title, scene.gas->density, scene.gas->viscosity, -scene.gravity, m.drag,
                          m.implicit_drag ? "implicit" : "explicit",
                          m.void_fraction == VoidFraction::centre ? "centre" : "divided",
                          std::llround(n.gas_step / n.dem_step));
  if (scene.outlet.head == Head::rough_bend)
    text += fmt::format("wallTypes    ({});\n", scene.species.size() + 2);
  text += inventory(scene);
  if (m.energy)
    text += fmt::format("energy       {{ heatCapacity {:.9g}; conductivity {:.9g}; }}\n",
                        scene.gas->heat_capacity, scene.gas->conductivity);
  text += fmt::format("output       {{ checkpoint {:.9g}; history {:.9g}; }}\n",
                      std::min(n.end, 10 * n.output), std::min(n.output, 10 * n.gas_step));
  return {"CFD/constant/coupledProperties", foam_file("dictionary", "coupledProperties", text)};
}

}  // namespace bedscope::cases
