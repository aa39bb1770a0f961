// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/check.hpp"
#include "cases/initial_particles.hpp"
#include "cases/scene_physics.hpp"
#include "physics/heat_transfer.hpp"
#include "physics/packing.hpp"
#include "physics/time_steps.hpp"

namespace bedscope::cases {
namespace {

using namespace physics;

class Limits {
 public:
  void at_most(std::string name, double value, double limit, std::string unit, bool must,
               std::string rule) {
    add(std::move(name), value, limit, value > 0 ? limit / value : HUGE_VAL, std::move(unit), must,
        std::move(rule));
  }
  void at_least(std::string name, double value, double limit, bool must, std::string rule) {
    add(std::move(name), value, limit, value / limit, "-", must, std::move(rule));
  }
  std::vector<Limit> list;

 private:
  /// A value on the limit holds, whatever rounding made of it.
  void add(std::string name, double value, double limit, double margin, std::string unit, bool must,
           std::string rule) {
    list.push_back({std::move(name), value, limit, margin, margin >= 1 - 1e-9, must,
                    std::move(unit), std::move(rule)});
  }
};

void of_contacts(const Scene& scene, Limits& limits) {
  const double step = scene.numerics.dem_step, contact = shortest_contact(scene);
  if (scene.particles.fixed) return;
  if (contact > 0 && step > 0) {
    limits.at_most("DEM step in the contact time", step, contact / 2, "s", true,
                   "half a contact: beyond, contacts that last gain energy in every step (velocity "
                   "Verlet, docs/stability.md)");
    limits.at_most("DEM step", step, contact / 5, "s", false,
                   fmt::format("a fifth of the contact is tolerable, a tenth ({:.3g} s) good: e is "
                               "off by up to (pi / n)^2 / 8 with n steps a contact, 5 % and 1.2 % "
                               "(docs/stability.md)",
                               contact / 10));
  }
  if (scene.contacts.model == ContactModel::hertz && step > 0) {
    double rayleigh = HUGE_VAL;
    for (const auto& s : scene.species)
      if (s.density > 0)
        rayleigh = std::min(rayleigh, rayleigh_time(s.sphere(), scene.contacts.particle.young,
                                                    scene.contacts.particle.poisson));
    if (std::isfinite(rayleigh))
      limits.at_most("DEM step in the Rayleigh time", step, 0.2 * rayleigh, "s", false,
                     "a fifth of the time of a surface wave around the sphere (Li, Xu and Thornton "
                     "2005)");
  }
  const auto keep_overlap = [&](const char* name, const Overlap& overlap) {
    if (overlap.ratio > 0)
      limits.at_most(name, overlap.ratio, 0.01, "-", false,
                     fmt::format("1 % of the radius (Mu 2022, section 4.2.3), for an impact of "
                                 "{:.3g} m/s{}; kept below {:.3g} m/s",
                                 impact_velocity(scene),
                                 scene.contacts.impact_velocity > 0
                                     ? ""
                                     : ", the fastest that gas and gravity can make",
                                 overlap.velocity_of_one_percent));
  };
  if (scene.particles.arrangement != Arrangement::single)
    keep_overlap("overlap over radius", particle_overlap(scene));
  keep_overlap("overlap over radius at walls", wall_overlap(scene));
}

void of_grid(const Scene& scene, Limits& limits) {
  const auto edge = cell_edges(scene);
  if (edge[0] == 0) return;
  const double d = largest_diameter(scene);
  const double smallest = std::min({edge[0], edge[1], edge[2]});
  const bool centre = scene.models.void_fraction == VoidFraction::centre;
  const double ratio = centre ? 3 : 1.8;
  limits.at_least("cell edge holds a particle", smallest / d, 1, true,
                  "a cell smaller than a particle has no voidage of its own");
  limits.at_least("cell edge over diameter", smallest / d, ratio, false,
                  centre ? "3 where a particle counts whole in one cell: below, cells overfill"
                         : "1.8 for divided particles: the pressure drop moves by 13 % from 1.8 to "
                           "0.9 (docs/scenes.md)");
  limits.at_least("dV/V_p", edge[0] * edge[1] * edge[2] / sphere_volume(d),
                  ratio * ratio * ratio * 6 / std::numbers::pi, false,
                  "of a cube with that edge; Mu (2022), ch. 4, goes from 60 to 3.6");
  if (!scene.particles.fixed && scene.gas)
    limits.at_least("D/d", scene.geometry.depth / d, 3, false,
                    "with 1.8 diameters of depth a riser had no clusters, with 3.5 it had "
                    "(docs/scenes.md)");
  if (scene.gas && scene.inlet.particles != Supply::closed)
    limits.at_least("cells in the smallest cluster", scene.smallest_cluster / (edge[0] * edge[2]),
                    9, false, "three each way, or its shape and its occurrence are the grid's");
  if (scene.gas && scene.inlet.particles != Supply::closed) {
    constexpr double threshold = 0.2;
    const double number =
        threshold * scene.smallest_cluster * scene.geometry.depth / sphere_volume(d);
    limits.at_most(
        "scatter of the smallest cluster's holdup", number_scatter(threshold, number), 0.1, "-",
        false,
        fmt::format("sqrt(S / N) of the {:.3g} particles that make a holdup of 0.2 in it, with no "
                    "clusters about (Carnahan and Starling 1969)",
                    number));
  }
}

void of_supply(const Scene& scene, Limits& limits) {
  if (scene.inlet.particles == Supply::feed)
    limits.at_most(
        "feed", inlet_holdup(scene), 0.6, "-", true,
        fmt::format("holdup in which {:.4g} kg/m2s must enter at {:.4g} m/s; grains pass "
                    "an opening at 0.6 at most",
                    scene.inlet.flux, inlet_velocity(scene)));
  if (scene.numerics.dem_step > 0 && scene.particles.arrangement != Arrangement::single)
    limits.at_most("height of the particles at the start", initial_height(scene),
                   scene.geometry.height, "m", true, "they must fit in before they settle");
}

void of_gas_step(const Scene& scene, Limits& limits) {
  const double step = scene.numerics.gas_step, u = scene.gas->velocity;
  const auto edge = cell_edges(scene);
  if (!(step > 0) || !(u > 0) || edge[0] == 0) return;
  const double voidage = dense_voidage(scene);
  limits.at_most("Courant number", courant(u / voidage, step, edge[2]), 1, "-", false,
                 fmt::format("at the interstitial velocity in a settled bed, {:.3g} m/s (Courant, "
                             "Friedrichs and Lewy 1928)",
                             u / voidage));
  const double beta = dense_exchange(scene), growth = 1 + dense_slope(scene);
  if (!scene.models.implicit_drag)
    limits.at_most("explicit drag on the gas",
                   step * growth / gas_relaxation_time(voidage, scene.gas->density, beta), 1, "-",
                   false,
                   fmt::format("(1 + n) beta dt / (eps rho_g) in the densest part, n = d ln beta / "
                               "d ln Re = {:.2g}: beyond 1 the gas overshoots, beyond 2 it grows "
                               "without limit (docs/stability.md)",
                               growth - 1));
  if (!scene.particles.fixed)
    limits.at_most(
        "gas step over the particles' relaxation time",
        step * growth / (longest_drag_step(voidage, mean_density(scene), beta) / 2), 1, "-", false,
        fmt::format("the drag on particles is held for a gas step: half the step from which their "
                    "slip grows, in the densest part, with the pressure gradient that their drag "
                    "makes and n = {:.2g} (docs/stability.md)",
                    growth - 1));
}

void of_heat(const Scene& scene, Limits& limits) {
  const auto& gas = *scene.gas;
  if (!scene.models.energy || !(gas.velocity > 0)) return;
  const auto& s = scene.species[0];
  const double voidage = dense_voidage(scene), h = heat_transfer(scene, s);
  const double edge = cell_edges(scene)[2], step = scene.numerics.gas_step;
  const double exchange = volumetric_heat_exchange(h, voidage, s.diameter);
  const double gas_heat = gas.density * gas.heat_capacity;
  if (h > 0 && edge > 0 && s.heat_capacity > 0) {
    const double solids = (1 - voidage) * s.density * s.heat_capacity / exchange;
    const double longest = longest_heat_step(step / gas_thermal_time(voidage, gas_heat, exchange),
                                             courant(gas.velocity / voidage, step, edge));
    limits.at_most("gas step over the particles' thermal time", step / solids / (longest / 2), 1,
                   "-", false,
                   fmt::format("the heat of particles is held for a gas step: half the step from "
                               "which their temperature swings ever farther, {:.3g} times "
                               "(1 - eps) rho_p C_pp / (h a_s) (docs/stability.md)",
                               longest));
  }
  if (scene.particles.fixed && h > 0 && edge > 0)
    limits.at_most(
        "cell height over exchange length", edge * exchange / (gas_heat * gas.velocity), 1, "-",
        false,
        "h a_s dz / (rho_g C_pg u): linear interpolation between cells overshoots from 2 "
        "on; at half of it the front is right within 1 % (docs/stability.md)");
  if (scene.particles.fixed) return;
  const auto heat = bed_heat(scene);
  const double rise = std::abs(heat.equilibrium - gas.temperature);
  if (rise > 0)
    limits.at_most(
        "distance from thermal equilibrium at the end",
        std::abs(scene.particles.temperature - heat.equilibrium) / rise *
            std::exp(-scene.numerics.end / heat.time),
        0.05, "-", false,
        fmt::format("over the rise from the inlet's temperature to {:.1f} K; the thermal "
                    "time is {:.3g} s (Mu 2022, Eqs. 2.15-2.17)",
                    heat.equilibrium, heat.time));
}

}  // namespace

std::vector<Limit> scene_limits(const Scene& scene) {
  Limits limits;
  of_contacts(scene, limits);
  of_grid(scene, limits);
  of_supply(scene, limits);
  if (scene.gas) {
    of_gas_step(scene, limits);
    of_heat(scene, limits);
  }
  return limits.list;
}

std::vector<std::string> what_cannot_run(const std::vector<Limit>& limits) {
  std::vector<std::string> lines;
  for (const auto& l : limits)
    if (l.must && !l.ok)
      lines.push_back(fmt::format("{}: found {:.4g}{}, the limit is {:.4g} ({})", l.name, l.value,
                                  l.unit == "-" ? "" : " " + l.unit, l.limit, l.rule));
  return lines;
}

}  // namespace bedscope::cases
