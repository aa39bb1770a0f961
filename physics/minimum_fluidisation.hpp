// SPDX-License-Identifier: BSD-3-Clause
// When a bed fluidises, and the pressure drop before and after.
#pragma once

#include "physics/drag.hpp"
#include "physics/phases.hpp"

namespace bedscope::physics {

/// Superficial gas velocity at which the pressure drop of a bed at rest is its weight less buoyancy
/// [m/s]. By Ergun's law, without another one:
///
///   1.75 Re^2 / eps^3 + 150 (1 - eps) Re / eps^3 = Ar
///
/// A steep function of the voidage at rest (about eps^3): give the one of the bed in question.
double minimum_fluidisation_velocity(const Sphere& sphere, const Gas& gas, double gravity,
                                     double voidage, const DragLaw& law = ergun);

/// The same where the voidage is not known, within about 30 %.
///
///   Re = sqrt(33.7^2 + 0.0408 Ar) - 33.7
///
/// Source: Wen and Yu, AIChE J. 12 (1966) 610.
double minimum_fluidisation_velocity_wen_yu(const Sphere& sphere, const Gas& gas, double gravity);

/// Pressure gradient -dp/dz of a bed at rest at a superficial gas velocity [Pa/m]; p is the
/// pressure less the gas' own hydrostatic one.
///
///   -dp/dz = beta (u - v) / eps = 18 mu (1 - eps) F U / (eps d^2)
double fixed_bed_pressure_gradient(const Sphere& sphere, const Gas& gas, double voidage,
                                   double superficial_velocity, const DragLaw& law = ergun);

/// Pressure drop over a fluidised bed, of the pressure less the gas' own hydrostatic one [Pa].
///
///   dp = m g (1 - rho_g / rho_s) / A
///
/// Wall friction and acceleration are not in it. solids_mass in kg, area of the cross-section in
/// m2.
double bed_pressure_drop(double solids_mass, double area, double particle_density,
                         double gas_density, double gravity);

}  // namespace bedscope::physics
