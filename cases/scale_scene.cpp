// SPDX-License-Identifier: BSD-3-Clause
#include "cases/scale_scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "physics/heat_transfer.hpp"
#include "readers/error.hpp"

namespace bedscope::cases {
namespace {

int rounded(double cells) { return std::max(1, static_cast<int>(std::lround(cells))); }

/// physics/scaling.hpp speaks in ratios of units, users in quantities.
std::string name_of(std::string_view group) {
  static const std::map<std::string_view, std::string> names{
      {"N_gamma", "N_gamma_n"}, {"N_rho", "density ratio"},
      {"Eu", "pressure drop"},  {"t_c u/H", "contact time"},
      {"overlap/d", "overlap"}, {"cluster cells", "cells in the smallest cluster"}};
  const auto known = names.find(group);
  return known == names.end() ? std::string(group) : known->second;
}

double cells(const std::array<int, 3>& grid) {
  return static_cast<double>(grid[0]) * grid[1] * grid[2];
}

void remark_on_heat(const Scene& scene, double K, ScalingReport& report) {
  if (!scene.models.energy) return;
  const auto& gas = *scene.gas;
  const double pr = physics::prandtl(gas.viscosity, gas.heat_capacity, gas.conductivity);
  report.groups.push_back({"Pr", "mu C_p / k", pr, K * pr, K, std::abs(K - 1) <= 1e-9});
  report.remarks.push_back(
      "the rule does not speak of heat: conductivities, heat capacities and sources are left, so "
      "Pr is not kept");
}

}  // namespace

Scene scale_scene(const Scene& scene, double K, physics::MappingCondition condition) {
  if (!(K >= 0.01 && K <= 100))
    throw InputError("scaling factor: expected a number from 0.01 to 100, found {:g}", K);
  const auto factors = physics::scaling_factors(K, condition);
  Scene scaled = scene;
  scaled.title = fmt::format("{}{}K = {:g}, {}", scene.title, scene.title.empty() ? "" : ", ", K,
                             "abcd"[static_cast<int>(condition)]);
  scaled.gravity *= factors.gravity;
  if (scaled.gas) scaled.gas->viscosity *= factors.gas_viscosity;
  for (auto& s : scaled.species) {
    s.diameter *= factors.diameter;
    s.spread *= factors.diameter;
  }
  for (auto* contact : {&scaled.contacts.particle, &scaled.contacts.wall})
    contact->normal_stiffness *= factors.stiffness;
  scaled.geometry.depth *= factors.depth;
  auto& p = scaled.particles;
  if (p.arrangement == Arrangement::lattice) {
    const std::array<double, 3> edge{K, factors.depth == 1 ? K : 1, K};
    for (std::size_t i = 0; i < 3; ++i) p.lattice[i] = rounded(p.lattice[i] / edge[i]);
    p.number = std::int64_t{p.lattice[0]} * p.lattice[1] * p.lattice[2];
  } else if (p.arrangement != Arrangement::single) {
    p.number = std::llround(static_cast<double>(p.number) * factors.number);
  }
  if (p.number < 1) throw InputError("scaling factor: K = {:g} leaves no particle", K);
  auto& grid = scaled.numerics.grid;
  const std::array<double, 3> extent{1, factors.depth, 1};
  if (grid[0] > 0)
    for (std::size_t i = 0; i < 3; ++i) grid[i] = rounded(grid[i] * extent[i] / factors.cell_edge);
  return scaled;
}

ScalingReport scaling_report(const Scene& scene, double K, physics::MappingCondition condition) {
  ScalingReport report;
  const bool complete =
      scene.gas && scene.gas->velocity > 0 && scene.gravity > 0 && scene.numerics.grid[0] > 0;
  if (complete)
    for (const auto& g : physics::groups_under_scaling(as_scaled_scene(scene, 0), K, condition,
                                                       scene.smallest_cluster))
      report.groups.push_back(
          {name_of(g.name), std::string(g.definition), g.value, g.scaled_value, g.ratio, g.kept});
  else
    report.remarks.push_back("without gas, grid and gravity there are no groups to compare");
  const auto factors = physics::scaling_factors(K, condition);
  const auto scaled = scale_scene(scene, K, condition);
  report.cells_by_rule = cells(scene.numerics.grid) * factors.cell_number;
  if (std::abs(cells(scaled.numerics.grid) - report.cells_by_rule) > 1e-6 * report.cells_by_rule)
    report.remarks.push_back(fmt::format(
        "the grid has {:.0f} cells, by the rule {:.1f}: a grid has whole cells along each axis, so "
        "the volume of a cell is {:+.1f} % off",
        cells(scaled.numerics.grid), report.cells_by_rule,
        100 * (report.cells_by_rule / cells(scaled.numerics.grid) - 1)));
  const double number = static_cast<double>(scene.particles.number) * factors.number;
  if (scene.particles.arrangement != Arrangement::lattice &&
      std::abs(number - std::round(number)) > 1e-6)
    report.remarks.push_back(fmt::format("{:.2f} particles were rounded", number));
  report.remarks.push_back(
      "the time steps are left as they are; the contact time goes with K, so the DEM step may");
  remark_on_heat(scene, K, report);
  return report;
}

}  // namespace bedscope::cases
