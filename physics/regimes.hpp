// SPDX-License-Identifier: BSD-3-Clause
// In which regime a gas-solid flow is: numbers and boundaries by which a model is kept or left out.
#pragma once

#include "physics/phases.hpp"

namespace bedscope::physics {

/// Fr = u^2 / (g L).
double froude(double velocity, double gravity, double length);

/// Mass of solids over mass of gas in a volume: phi rho_s / ((1 - phi) rho_g). 0 <= phi < 1.
double mass_loading(double holdup, double particle_density, double gas_density);

/// Ba = rho_s d^2 sqrt(lambda) gamma / mu, lambda = 1 / ((phi_max / phi)^(1/3) - 1): below 40 the
/// gas' viscosity rules a sheared suspension, above 450 the impacts of its grains.
/// shear_rate gamma in 1/s, 0 < phi < phi_max. Source: Bagnold, Proc. R. Soc. A 225 (1954) 49.
double bagnold(const Sphere& sphere, double viscosity, double holdup, double shear_rate,
               double largest_holdup);

/// Bi = h d / (6 k_s), with volume over surface as length: below 0.1 a sphere is isothermal within
/// 5 %. h in W/m2/K, k_s in W/m/K. Source: Incropera and DeWitt, Fundamentals of Heat and Mass
/// Transfer, section 5.1.
double biot(double heat_transfer_coefficient, double diameter, double conductivity);

/// Geldart's group of a powder in a gas: 'A', 'B', 'C' or 'D'.
///
///   A | B: (rho_s - rho_g) d   = 0.225 kg/m2,  B | D: (rho_s - rho_g) d^2 = 1e-3 kg/m
///   C | A: (rho_s - rho_g) d^3 g = 1e-3 F_H,   F_H = 8.76e-8 N
///
/// Source: Geldart, Powder Technol. 7 (1973) 285, and, for C, Molerus, Powder Technol. 33 (1982)
/// 81 (hard particles).
char geldart_group(const Sphere& sphere, double gas_density, double gravity);

/// What must be coupled at a holdup: below 1e-6 the gas moves the particles only, below 1e-3 they
/// move it too, above they also meet each other. Source: Elghobashi, Appl. Sci. Res. 52 (1994) 309.
enum class Coupling { one_way = 1, two_way = 2, four_way = 4 };
Coupling needed_coupling(double holdup);

/// Added over own inertia of a sphere: rho_g / (2 rho_s). Source: Auton, Hunt and Prud'homme, J.
/// Fluid Mech. 197 (1988) 241.
double added_mass_ratio(double particle_density, double gas_density);

/// Lift over drag of a sphere that slips by `slip` [m/s] in a flow sheared by `shear_rate` [1/s].
///
///   F_L = 1.615 mu d u sqrt(Re_g) C,  Re_g = rho_g gamma d^2 / mu,  beta = gamma d / (2 u)
///   C = (1 - 0.3314 sqrt(beta)) e^(-Re/10) + 0.3314 sqrt(beta)  for Re <= 40
///   C = 0.0524 sqrt(beta Re)                                     above
///
/// over F_d = 3 pi mu d u F. Source: Saffman, J. Fluid Mech. 22 (1965) 385; Mei, Int. J. Multiphase
/// Flow 18 (1992) 145.
double lift_over_drag(const Gas& gas, double diameter, double slip, double shear_rate,
                      double dimensionless_drag);

/// Radiation between surfaces of nearly one temperature: h_r = 4 sigma e T^3 [W/m2/K].
double radiation_coefficient(double emissivity, double temperature);

/// Re of a rectangular duct, with the hydraulic diameter 2 w d / (w + d); turbulent above about
/// 2300.
double duct_reynolds(const Gas& gas, double velocity, double width, double depth);

/// Pressure gradient of a laminar flow between two plates: 12 mu U / h^2 [Pa/m].
double plate_friction(double viscosity, double velocity, double gap);

/// Heat through the contact of two spheres, per kelvin: 2 k_s a [W/K], a the contact's radius [m].
/// Source: Batchelor and O'Brien, Proc. R. Soc. A 355 (1977) 313.
double contact_conductance(double conductivity, double contact_radius);

}  // namespace bedscope::physics
