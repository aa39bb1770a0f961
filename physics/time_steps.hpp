// SPDX-License-Identifier: BSD-3-Clause
// Times that the steps of a coupled simulation must stay below.
#pragma once

#include "physics/phases.hpp"

namespace bedscope::physics {

/// Time in which a Rayleigh wave crosses a sphere [s]; steps of a fifth of it are usual.
///
///   t_R = pi R sqrt(rho_s / G) / (0.1631 nu + 0.8766),  G = E / (2 (1 + nu))
///
/// Source: Thornton and Randall, Micromechanics of Granular Materials (1988); Li, Xu and Thornton,
/// Powder Technol. 160 (2005) 219.
double rayleigh_time(const Sphere& sphere, double young, double poisson);

/// Time in which the drag brings the gas of a volume to the particles' velocity: eps rho_g / beta
/// [s]. With the drag taken explicitly a step above twice this time grows without limit.
/// momentum_exchange beta in kg/m3/s.
double gas_relaxation_time(double voidage, double gas_density, double momentum_exchange);

/// Time in which it brings the particles to the gas' velocity: (1 - eps) rho_s / beta [s].
double solids_relaxation_time(double voidage, double particle_density, double momentum_exchange);

/// Longest gas step with which the particles' drag may be held [s]; beyond it their slip grows.
///
///   dt = 2 tau for a lone particle, tau = (1 - eps) rho_s / beta
///   dt = min(2, 2 eps / (1 - eps)) eps tau for particles that fill the cross-section
///
/// The latter also feel the pressure gradient that their drag makes (model A: 1 / eps), and where
/// the flow is given their displacement moves the gas: with r = dt / (eps tau) and c = (1 - eps) /
/// (2 eps) the velocity obeys v'' = v' (1 - r (1 + c)) - v r c + r U / eps, stable for r < 2 and r
/// c < 1 (Jury). Both are one form. Derived in docs/physics.md.
double longest_drag_step(double voidage, double particle_density, double momentum_exchange);

/// Longest step for a particle whose heat from the gas is held for a step while the gas takes its
/// own implicitly [s of particle_time, so without unit]:
///
///   dt / t_p < 2 [1 + (dt/t_g) / (2 + C)],   C = u dt / (eps dz)
///
/// t_p = (1 - eps) rho_p C_pp / (h a_s), t_g = eps rho_g C_pg / (h a_s); the gas enters the cell at
/// a given temperature. Alone, or in a fast stream, 2; gas that stays takes the particles'
/// temperature and holds them. Derived in docs/physics.md.
double longest_heat_step(double step_over_gas_time, double courant);

/// Time in which the gas of a volume takes the particles' temperature: eps rho_g C_pg / (h a_s)
/// [s]. gas_heat_capacity rho_g C_pg in J/m3/K, exchange h a_s in W/m3/K.
double gas_thermal_time(double voidage, double gas_heat_capacity, double heat_exchange);

/// u dt / dx.
double courant(double velocity, double step, double cell);

}  // namespace bedscope::physics
