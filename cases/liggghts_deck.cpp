// SPDX-License-Identifier: BSD-3-Clause
// The script runs alone (liggghts -in DEM/in.liggghts) and inside a coupled program, which sets the
// index variables at its top from the command line. What Debian's 3.8.0 minds: `if` compares
// numbers only; properties of hooke/stiffness are kn, kt, gamman, gammat; `set` of a property needs
// a `run 0` first; moduli below 5e6 Pa need `soft_particles`; mesh walls cannot be read with
// `-screen none`.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <functional>

#include "cases/deck.hpp"
#include "cases/initial_particles.hpp"
#include "cases/liggghts_walls.hpp"
#include "physics/contact.hpp"

namespace bedscope::cases {
namespace {

using physics::damping_coefficient;
using physics::effective_mass;
using physics::sphere_mass;

bool rough(const Scene& scene) { return scene.outlet.head == Head::rough_bend; }
std::size_t wall_type(const Scene& scene) { return scene.species.size() + 1; }
std::size_t type_count(const Scene& scene) { return scene.species.size() + (rough(scene) ? 2 : 1); }

std::int64_t steps(double time, double step) { return std::llround(time / step); }

/// A property of each pair of types; `value` gets the contact and its effective mass.
std::string pairs(const Scene& scene, const std::string& name,
                  const std::function<double(const Contact&, double)>& value) {
  const auto n = type_count(scene);
  std::string text = fmt::format("fix {0} all property/global {0} peratomtypepair {1}", name, n);
  for (std::size_t i = 0; i < n; ++i) {
    text += " &\n   ";
    for (std::size_t j = 0; j < n; ++j) {
      const auto mass = [&](std::size_t k) {
        return sphere_mass(scene.species[std::min(k, scene.species.size() - 1)].sphere());
      };
      const bool of_particles = std::max(i, j) < scene.species.size();
      // A wall and a fixed particle are infinitely heavy.
      const double m = of_particles ? effective_mass(mass(i), mass(j)) : mass(std::min(i, j));
      const auto& contact = of_particles ? scene.contacts.particle : scene.contacts.wall;
      text += fmt::format(" {:.9g}", value(contact, m));
    }
  }
  return text + "\n";
}

std::string per_type(const Scene& scene, const std::string& name, double particle, double wall) {
  std::string text = fmt::format("fix {0} all property/global {0} peratomtype", name);
  for (std::size_t i = 0; i < type_count(scene); ++i)
    text += fmt::format(" {:.9g}", i < scene.species.size() ? particle : wall);
  return text + "\n";
}

std::string contact_properties(const Scene& scene) {
  std::string text =
      pairs(scene, "coefficientFriction", [](const Contact& c, double) { return c.friction; });
  if (scene.contacts.model == ContactModel::hertz)
    return text +
           per_type(scene, "youngsModulus", scene.contacts.particle.young,
                    scene.contacts.wall.young) +
           per_type(scene, "poissonsRatio", scene.contacts.particle.poisson,
                    scene.contacts.wall.poisson) +
           pairs(scene, "coefficientRestitution",
                 [](const Contact& c, double) { return c.restitution; });
  // LIGGGHTS multiplies gamman and gammat [1/s] by the effective mass. The tangential one of solid
  // spheres is 2/7 of it (van der Hoef et al. 2006).
  return text + pairs(scene, "kn", [](const Contact& c, double) { return c.normal_stiffness; }) +
         pairs(scene, "kt", [](const Contact& c, double) { return c.tangential_stiffness(); }) +
         pairs(scene, "gamman",
               [](const Contact& c, double m) {
                 return damping_coefficient(c.normal_stiffness, m, c.restitution) / m;
               }) +
         pairs(scene, "gammat", [](const Contact& c, double m) {
           return damping_coefficient(c.tangential_stiffness(), m * 2 / 7,
                                      c.tangential_restitution) /
                  m;
         });
}

std::string contact_model(const Scene& scene) {
  return scene.contacts.model == ContactModel::hertz ? "model hertz tangential history"
                                                     : "model hooke/stiffness tangential history";
}

/// LIGGGHTS takes moduli below 5e6 Pa or above 1e9 only when told so.
std::string unusual_moduli(const Scene& scene) {
  if (scene.contacts.model == ContactModel::linear) return "";
  const double low = std::min(scene.contacts.particle.young, scene.contacts.wall.young);
  const double high = std::max(scene.contacts.particle.young, scene.contacts.wall.young);
  return std::string(low < 5e6 ? "soft_particles yes\n" : "") +
         (high > 1e9 ? "hard_particles yes\n" : "");
}

std::string head(const Scene& scene) {
  const auto& n = scene.numerics;
  const double skin = 0.5 * largest_diameter(scene);
  // Bins as wide as the reach of a contact. LIGGGHTS' own are half of that, in a riser 50 of them a
  // particle, and each is cleared when neighbours are looked for: 30 % of a run.
  return fmt::format(R"(# Scene: "{0}"
# Written by bedscope case make. Run in the folder above: liggghts -in DEM/in.liggghts
variable folder  index DEM
variable steps   index {1}
variable coupled index 0
variable resumed index 0
variable restart index none

atom_style  granular
atom_modify map array sort 1000 {4:.6g}
boundary    f f f
newton      off
communicate single vel yes
units       si
processors  1 1 *
{2}if "${{resumed}} == 0" then "read_data ${{folder}}/particles.data" else "read_restart ${{restart}}"
neighbor     {3:.6g} bin
neigh_modify delay 0 binsize {4:.6g}
timestep     {5:.12g}
)",
                     scene.title, steps(n.end, n.dem_step), unusual_moduli(scene), skin,
                     largest_diameter(scene) + skin, n.dem_step);
}

std::string walls(const Scene& scene, const ParticleWalls& walls) {
  const auto model = contact_model(scene);
  std::string text;
  for (const auto& [name, plane, at] : walls.planes)
    text += fmt::format("fix {:<6} all wall/gran {} primitive type {} {} {:.9g}\n", name, model,
                        wall_type(scene), plane, at);
  for (const auto& mesh : walls.meshes)
    text += fmt::format("fix {0} all mesh/surface file ${{folder}}/{0}.stl type {1}\n", mesh,
                        wall_type(scene));
  if (!walls.meshes.empty())
    text += fmt::format("fix meshes all wall/gran {} mesh n_meshes {} meshes {}\n", model,
                        walls.meshes.size(), fmt::join(walls.meshes, " "));
  return text;
}

std::string groups(const Scene& scene) {
  std::string types;
  for (std::size_t i = 1; i <= scene.species.size(); ++i) types += fmt::format(" {}", i);
  auto text = fmt::format("group particles type{}\n", types);
  if (rough(scene))
    text += fmt::format("group rough type {}\nfix hold rough freeze\n", wall_type(scene) + 1);
  if (!scene.particles.fixed)
    text += fmt::format(
        "fix gravity particles gravity {:.9g} vector 0 0 -1\n"
        "fix integrate particles nve/sphere\n",
        scene.gravity);
  return text;
}

std::string heat(const Scene& scene) {
  if (!scene.models.energy) return "";
  std::string text;
  const auto values = [&](const char* name, double Species::*value, double absent) {
    text += fmt::format("fix {0} all property/global {0} peratomtype", name);
    for (std::size_t i = 0; i < type_count(scene); ++i) {
      const double v = i < scene.species.size() ? scene.species[i].*value : absent;
      text += fmt::format(" {:.9g}", v > 0 ? v : absent);
    }
    text += '\n';
  };
  // Without a conductivity there is no conduction from particle to particle.
  values("thermalConductivity", &Species::conductivity, 1e-12);
  values("thermalCapacity", &Species::heat_capacity, 1000);
  text += fmt::format("fix heat all heat/gran initial_temperature {:.9g}\n",
                      scene.particles.temperature);
  return text;
}

std::string coupling(const Scene& scene) {
  if (!scene.gas) return "";
  std::string text =
      R"(if "${coupled} == 1" then "fix cfd all couple/cfd couple_every 1000000 mpi")";
  text += R"( "fix drag all couple/cfd/force")";
  if (scene.models.energy)
    text += fmt::format(R"( "fix convection all couple/cfd/convection T0 {:.9g}")",
                        scene.particles.temperature);
  return text + "\n";
}

/// Heat that a particle makes [W], by its species' volume.
std::string sources(const Scene& scene) {
  std::string text;
  if (scene.models.energy)
    for (std::size_t i = 0; i < scene.species.size(); ++i)
      if (const auto& s = scene.species[i]; s.source != 0)
        text += fmt::format(
            "if \"${{resumed}} == 0\" then \"set type {} property/atom heatSource {:.9g}\"\n",
            i + 1, s.source * physics::sphere_volume(s.diameter));
  return text.empty() ? "" : "if \"${resumed} == 0\" then \"run 0\"\n" + text;
}

/// The feed of a lone run; a coupled program feeds by itself.
std::string feed(const Scene& scene) {
  const auto& in = scene.inlet;
  if (in.particles != Supply::feed) return "";
  const auto [low, high] = entry_box(scene);
  std::string text = "\n# The feed of a run without gas; a coupled program feeds by itself.\n";
  std::string templates;
  double of_mass = 0;
  for (const auto& s : scene.species) of_mass += s.fraction * s.density;
  const std::string when = "if \"${coupled} == 0\" then ";
  constexpr std::array
      seeds{15485863, 15485867, 32452843, 32452867, 49979687, 49979693,
            67867967, 67867979, 86028121, 86028157, 10487,    10499,
            11587,    11593,    12611,    12613};  // LIGGGHTS takes primes above 10000
  for (std::size_t i = 0; i < scene.species.size(); ++i) {
    const auto& s = scene.species[i];
    text += when + fmt::format(
                       "\"fix fed{0} particles particletemplate/sphere {1} atom_type {0} "
                       "density constant {2:.9g} radius constant {3:.9g}\"\n",
                       i + 1, seeds[i], s.density, s.diameter / 2);
    templates += fmt::format(" fed{} {:.9g}", i + 1, s.fraction * s.density / of_mass);
  }
  text += when + fmt::format("\"fix fed particles particledistribution/discrete 32452867 {}{}\"\n",
                             scene.species.size(), templates);
  text += fmt::format("region entry block {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} units box\n",
                      low[0], high[0], low[1], high[1], low[2], high[2]);
  text +=
      when + fmt::format(
                 "\"fix feed particles insert/rate/region seed 49979687 "
                 "distributiontemplate fed mass INF massrate {:.9g} insert_every {} overlapcheck "
                 "yes all_in yes vel constant {:.9g} {:.9g} {:.9g} region entry\"\n",
                 in.flux * cross_section(scene),
                 steps(std::max(scene.numerics.gas_step, 1e-3), scene.numerics.dem_step),
                 in.velocity[0], in.velocity[1], in.velocity[2]);
  return text;
}

std::string output(const Scene& scene) {
  const auto every = steps(scene.numerics.output, scene.numerics.dem_step);
  return fmt::format(
      R"(
shell mkdir ${{folder}}/post
dump particles particles custom {0} ${{folder}}/post/dump*.liggghts_run id type x y z vx vy vz radius{1}{2}
dump_modify particles format "%d %d %.9g %.9g %.9g %.9g %.9g %.9g %.9g{3}"
thermo_style  custom step atoms ke
thermo        {0}
thermo_modify lost ignore norm no
run ${{steps}}
)",
      every, scene.gas ? "" : " omegax omegay omegaz", scene.models.energy ? " f_Temp[0]" : "",
      std::string(scene.gas ? "" : " %.9g %.9g %.9g") + (scene.models.energy ? " %.9g" : ""));
}

std::string particles_data(const Scene& scene) {
  const auto particles = initial_particles(scene);
  const auto grains = rough_wall(scene);
  const auto& g = scene.geometry;
  const double m = margin(scene);
  auto text = fmt::format(
      "{}\n\n{} atoms\n{} atom types\n{:.9g} {:.9g} xlo xhi\n{:.9g} {:.9g} ylo yhi\n{:.9g} {:.9g} "
      "zlo zhi\n\nAtoms\n\n",
      "Particles of \"" + scene.title + "\"", particles.size() + grains.size(), type_count(scene),
      -m, g.width + m, -m, g.depth + m, -m, total_height(scene) + m);
  std::size_t id = 0;
  for (const auto& p : particles)
    text += fmt::format("{} {} {:.9g} {:.9g} {:.12g} {:.12g} {:.12g}\n", ++id, p.species + 1,
                        p.diameter, scene.species[static_cast<std::size_t>(p.species)].density,
                        p.position[0], p.position[1], p.position[2]);
  for (const auto& centre : grains)
    text += fmt::format("{} {} {:.9g} {:.9g} {:.12g} {:.12g} {:.12g}\n", ++id, wall_type(scene) + 1,
                        scene.species[0].diameter, scene.species[0].density, centre[0], centre[1],
                        centre[2]);
  const auto& v = scene.particles.velocity;
  if (v == Vector{}) return text;
  text += "\nVelocities\n\n";
  for (std::size_t i = 1; i <= id; ++i)
    text += i <= particles.size()
                ? fmt::format("{} {:.12g} {:.12g} {:.12g} 0 0 0\n", i, v[0], v[1], v[2])
                : fmt::format("{} 0 0 0 0 0 0\n", i);
  return text;
}

}  // namespace

std::vector<DeckFile> liggghts_deck(const Scene& scene) {
  auto wall = particle_walls(scene);
  const auto script = head(scene) + "\n# Contacts\n" + contact_properties(scene) +
                      fmt::format("pair_style gran {}\npair_coeff * *\n", contact_model(scene)) +
                      "\n# Walls\n" + walls(scene, wall) + "\n# Particles\n" + groups(scene) +
                      heat(scene) + coupling(scene) + feed(scene) + sources(scene) + output(scene);
  std::vector<DeckFile> files{{"DEM/in.liggghts", script},
                              {"DEM/particles.data", particles_data(scene)}};
  files.insert(files.end(), wall.files.begin(), wall.files.end());
  return files;
}

}  // namespace bedscope::cases
