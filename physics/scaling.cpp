// SPDX-License-Identifier: BSD-3-Clause
#include "physics/scaling.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "physics/phases.hpp"
#include "physics/require.hpp"

namespace bedscope::physics {
namespace {

void require_scene(const ScaledScene& s) {
  require_positive(s.particle_diameter, "diameter");
  require_positive(s.particle_density, "particle density");
  require_positive(s.particle_number, "number of particles");
  require_positive(s.gas_density, "gas density");
  require_positive(s.gas_viscosity, "viscosity");
  require_positive(s.gas_velocity, "gas velocity");
  require_positive(s.gravity, "gravity");
  require_positive(s.normal_stiffness, "stiffness");
  require_not_negative(s.damping, "damping");
  for (const double length : {s.width, s.depth, s.height}) require_positive(length, "extent");
  for (const double edge : {s.cell_x, s.cell_y, s.cell_z}) require_positive(edge, "cell edge");
}

}  // namespace

MappingCondition mapping_condition(std::string_view letter) {
  if (letter == "a") return MappingCondition::a;
  if (letter == "b") return MappingCondition::b;
  if (letter == "c") return MappingCondition::c;
  if (letter == "d") return MappingCondition::d;
  throw std::domain_error(fmt::format("expected a condition a, b, c or d, found '{}'", letter));
}

ScalingFactors scaling_factors(double K, MappingCondition condition) {
  require_positive(K, "scaling factor");
  const bool grid = condition == MappingCondition::b || condition == MappingCondition::d;
  const bool depth = condition == MappingCondition::c || condition == MappingCondition::d;
  ScalingFactors factors;
  factors.diameter = K;
  factors.gas_viscosity = K;
  factors.gravity = 1 / K;
  factors.stiffness = K;
  factors.damping = K * K;
  factors.depth = depth ? K : 1;
  factors.cell_edge = grid ? K : 1;
  factors.number = factors.depth / (K * K * K);
  factors.cell_number = factors.depth / std::pow(factors.cell_edge, 3);
  return factors;
}

ScaledScene scale(const ScaledScene& scene, const ScalingFactors& factors) {
  ScaledScene scaled = scene;
  scaled.particle_diameter *= factors.diameter;
  scaled.particle_number *= factors.number;
  scaled.gas_viscosity *= factors.gas_viscosity;
  scaled.gravity *= factors.gravity;
  scaled.normal_stiffness *= factors.stiffness;
  scaled.damping *= factors.damping;
  scaled.depth *= factors.depth;
  scaled.cell_x *= factors.cell_edge;
  scaled.cell_y *= factors.cell_edge;
  scaled.cell_z *= factors.cell_edge;
  return scaled;
}

std::vector<DimensionlessGroup> dimensionless_groups(const ScaledScene& s,
                                                     double smallest_cluster) {
  require_scene(s);
  require_positive(smallest_cluster, "area of the smallest cluster");
  const double d = s.particle_diameter, u = s.gas_velocity, g = s.gravity, mu = s.gas_viscosity;
  const double rho = s.particle_density, rho_g = s.gas_density, k = s.normal_stiffness;
  const double V_p = sphere_volume(d);
  const double holdup = s.particle_number * V_p / (s.width * s.depth * s.height);
  const double contact = std::sqrt(rho * V_p / 2 / k);  // of two equal spheres, over pi
  return {
      {"Re", "rho_g u d / mu", rho_g * u * d / mu},
      {"Ar", "rho_g (rho_s - rho_g) g d^3 / mu^2", rho_g * (rho - rho_g) * g * d * d * d / mu / mu},
      {"Fr", "u^2 / (g d)", u * u / (g * d)},
      {"N_kn", "k_n / (rho_s d^2 g)", k / (rho * d * d * g)},
      {"N_gamma", "gamma u / (rho_s d^3 g)", s.damping * u / (rho * d * d * d * g)},
      {"N_rho", "(rho_s - rho_g) / rho_s", (rho - rho_g) / rho},
      {"holdup", "N V_p / V", holdup},
      {"dV/V_p", "volume of a cell / volume of a particle", s.cell_x * s.cell_y * s.cell_z / V_p},
      {"D/d", "depth / d", s.depth / d},
      {"W/d", "width / d", s.width / d},
      {"St_L", "rho_s d^2 u / (18 mu H)", rho * d * d * u / (18 * mu * s.height)},
      {"Fr_L", "u^2 / (g H)", u * u / (g * s.height)},
      {"Eu", "pressure drop of the bed's weight / (rho_g u^2)",
       holdup * (rho - rho_g) * g * s.height / (rho_g * u * u)},
      {"t_c u/H", "contact time u / H", std::numbers::pi * contact * u / s.height},
      {"overlap/d", "u sqrt(m_eff / k_n) / d", u * contact / d},
      {"cluster cells", "smallest cluster / area of a cell in the plane",
       smallest_cluster / (s.cell_x * s.cell_z)},
  };
}

std::vector<GroupUnderScaling> groups_under_scaling(const ScaledScene& scene, double K,
                                                    MappingCondition condition,
                                                    double smallest_cluster) {
  const auto before = dimensionless_groups(scene, smallest_cluster);
  const auto after =
      dimensionless_groups(scale(scene, scaling_factors(K, condition)), smallest_cluster);
  std::vector<GroupUnderScaling> result;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool both_zero = before[i].value == 0 && after[i].value == 0;  // N_gamma without damping
    const double ratio = both_zero ? 1 : after[i].value / before[i].value;
    result.push_back({before[i].name, before[i].definition, before[i].value, after[i].value, ratio,
                      std::abs(ratio - 1) <= 1e-9});
  }
  return result;
}

}  // namespace bedscope::physics
