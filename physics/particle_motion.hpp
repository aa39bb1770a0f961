// SPDX-License-Identifier: BSD-3-Clause
// One sphere in a gas: dimensionless numbers, terminal velocity, relaxation time.
#pragma once

#include "physics/drag.hpp"
#include "physics/phases.hpp"

namespace bedscope::physics {

/// Ar = rho_g (rho_s - rho_g) g d^3 / mu^2; negative for a sphere lighter than the gas.
double archimedes(const Sphere& sphere, const Gas& gas, double gravity);

/// Re = rho_g u d / mu. With a superficial velocity it is the Re of the drag laws.
double reynolds(const Gas& gas, double velocity, double diameter);

/// Drag coefficient of a lone sphere.
///
///   Cd = 24 (1 + 0.15 Re^0.687) / Re  for Re < 1000,  0.44 above
///
/// Re > 0, up to about 2e5 (drag crisis). Source: Schiller and Naumann, Z. VDI 77 (1935) 318; the
/// constant is Newton's law as Wen and Yu (1966) join it.
double drag_coefficient_schiller_naumann(double reynolds);

/// Drag coefficient of a lone sphere by a law: Cd = 24 F(1, Re) / Re.
double drag_coefficient(double reynolds, const DragLaw& law);

/// Velocity of free fall in gas at rest [m/s]: the drag is the weight less buoyancy.
///
///   Re F(1, Re) = Ar / 18
///
/// Without a law: Schiller and Naumann. A law for suspensions is taken at a voidage of 1, where not
/// all of them are meant to hold: 0.85 mm, 2500 kg/m3 in air gives 5.95 m/s by Schiller and Naumann
/// and 4.94 m/s by Beetstra.
double terminal_velocity(const Sphere& sphere, const Gas& gas, double gravity,
                         const DragLaw& law = wen_yu);

/// Time in which a lone sphere in creeping flow loses all but 1/e of its slip [s].
///
///   tau = rho_s d^2 / (18 mu)
double relaxation_time(const Sphere& sphere, const Gas& gas);

/// The same at a finite slip velocity: slip / deceleration [s].
///
///   tau = rho_s d^2 / (18 mu F(1, Re))
double relaxation_time(const Sphere& sphere, const Gas& gas, double slip_velocity,
                       const DragLaw& law);

/// St = tau u / L: response time of the particle over the time of the flow.
double stokes_number(double relaxation_time, double velocity, double length);

}  // namespace bedscope::physics
