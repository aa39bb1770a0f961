// SPDX-License-Identifier: BSD-3-Clause
// The scaling rule of Mu (2022), ch. 4: fewer, larger particles with the same gas velocity,
// densities and holdup. K = 2 stands for particles of twice the diameter; K < 1 for smaller ones.
#pragma once

#include <string_view>
#include <vector>

namespace bedscope::physics {

/// What is scaled besides particles, gas and gravity.
enum class MappingCondition {
  a,  ///< nothing
  b,  ///< the grid: cell volume over particle volume is kept
  c,  ///< the depth: depth over diameter is kept
  d,  ///< both
};

/// The letter a, b, c or d. Throws std::domain_error.
MappingCondition mapping_condition(std::string_view letter);

/// The factor of every quantity that changes; for several species the same for each.
struct ScalingFactors {
  double diameter = 1;       ///< K
  double gas_viscosity = 1;  ///< K
  double gravity = 1;        ///< 1/K
  double stiffness = 1;      ///< K, normal and tangential
  double damping = 1;        ///< K^2, of the dashpot coefficient [kg/s]
  double number = 1;         ///< of particles: K^-3 (a, b), K^-2 (c, d)
  double depth = 1;          ///< of the domain: 1 (a, b), K (c, d)
  double cell_edge = 1;      ///< in all directions: 1 (a, c), K (b, d)
  double cell_number = 1;    ///< follows from the two above; a grid has to round it
};

/// Factors of the rule. Gas velocity, densities, restitution, friction, width and height stay.
/// K > 0. Throws std::domain_error.
ScalingFactors scaling_factors(double K, MappingCondition condition);

/// A scene as far as the rule and its dimensionless groups see it; of one species.
struct ScaledScene {
  double particle_diameter;       ///< [m]
  double particle_density;        ///< [kg/m3]
  double particle_number;         ///< [-]
  double gas_density;             ///< [kg/m3]
  double gas_viscosity;           ///< [Pa s]
  double gas_velocity;            ///< superficial [m/s]
  double gravity;                 ///< [m/s2]
  double normal_stiffness;        ///< [N/m]
  double damping;                 ///< normal dashpot coefficient [kg/s]
  double width, depth, height;    ///< of the domain [m]
  double cell_x, cell_y, cell_z;  ///< edges of a grid cell along width, depth and height [m]
};

/// The scene with every factor applied. Numbers are not rounded.
ScaledScene scale(const ScaledScene& scene, const ScalingFactors& factors);

struct DimensionlessGroup {
  std::string_view name;
  std::string_view definition;
  double value;
};

/// The groups of a scene, in a fixed order. First those that the rule means to keep, by Mu (2022),
/// ch. 4 (Re, Ar, Fr, stiffness, damping, densities, holdup; dV/V_p and D/d by condition),
/// then those that she does not mention: Stokes and Froude number of the riser, width over
/// diameter, pressure drop of the bed over the gas' dynamic pressure, contact time over the
/// riser's, overlap over diameter, cells in the smallest cluster. smallest_cluster: area in the
/// plane of width and height [m2]; 60 mm2 in Carlos Varas et al. (2016).
std::vector<DimensionlessGroup> dimensionless_groups(const ScaledScene& scene,
                                                     double smallest_cluster = 60e-6);

struct GroupUnderScaling {
  std::string_view name;
  std::string_view definition;
  double value;         ///< of the scene
  double scaled_value;  ///< of the scaled scene
  double ratio;         ///< scaled over unscaled
  bool kept;            ///< ratio is 1 within 1e-9
};

/// What the rule keeps and what it does not, by comparing the groups of both scenes.
std::vector<GroupUnderScaling> groups_under_scaling(const ScaledScene& scene, double K,
                                                    MappingCondition condition,
                                                    double smallest_cluster = 60e-6);

}  // namespace bedscope::physics
