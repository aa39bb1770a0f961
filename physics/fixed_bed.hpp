// SPDX-License-Identifier: BSD-3-Clause
// A fixed bed heated by the gas that flows through it and by a source in its particles, in one
// dimension and without conduction along the bed.
//
//   eps rho_g C_pg (dT_g/dt + U/eps dT_g/dz) = h a_s (T_p - T_g)
//   (1 - eps) rho_p C_pp dT_p/dt             = h a_s (T_g - T_p) + (1 - eps) q
//
// At t = 0 gas and particles have one temperature, from then on gas of another one enters at z = 0.
#pragma once

namespace bedscope::physics {

/// In units of the step at the inlet: 0 at the start, 1 at the inlet.
struct StepResponse {
  double gas;
  double particle;
};

/// The bed without a source, at length xi = h a_s z / (rho_g C_pg U) and time
/// tau = h a_s (t - eps z / U) / ((1 - eps) rho_p C_pp) since the gas front came by; 0 before it.
///
///   gas      = 1 - e^-tau integral_0^xi e^-s I0(2 sqrt(tau s)) ds
///   particle = e^-xi integral_0^tau e^-s I0(2 sqrt(xi s)) ds
///
/// By Gauss quadrature, within 1e-12 (docs/physics.md). xi >= 0; any tau.
/// Source: Anzelius, Z. angew. Math. Mech. 6 (1926) 291; Schumann, J. Franklin Inst. 208 (1929)
/// 405.
StepResponse anzelius(double xi, double tau);

struct FixedBed {
  double voidage;
  double superficial_velocity;  ///< U [m/s]
  double gas_heat_capacity;     ///< rho_g C_pg [J/m3/K], of a volume of gas
  double solids_heat_capacity;  ///< rho_p C_pp [J/m3/K], of a volume of solids
  double heat_exchange;         ///< h a_s [W/m3/K], in a volume of bed
  double initial_temperature;   ///< of gas and particles [K]
  double inlet_temperature;     ///< of the gas [K]
  double source = 0;            ///< q [W/m3], in a volume of solids; may be negative
};

struct BedTemperatures {
  double gas;       ///< [K]
  double particle;  ///< [K]
};

/// Temperatures at a height z >= 0 [m] and a time t >= 0 [s].
///
/// The step and the source superpose. With Q = (1 - eps) q / (h a_s) [K] and the ratio of the heat
/// capacities of gas and solids in the bed r = eps rho_g C_pg / ((1 - eps) rho_p C_pp), the source
/// gives, before the gas front t = eps z / U (where nothing depends on z; x = h a_s t / (eps rho_g
/// C_pg)),
///
///   T_p = f(x) = Q r/(1+r) [x + r/(1+r) (1 - e^-(1+r)x)],  T_p - T_g = Q r/(1+r) (1 - e^-(1+r)x)
///
/// and behind it, where x is xi at the front,
///
///   T_g = Q xi       + integral_0^xi w(xi-s) e^(-tau-s) I0(2 sqrt(tau s)) ds
///   T_p = Q (xi + 1) + integral_0^xi w(xi-s) e^(-tau-s) sqrt(tau/s) I1(2 sqrt(tau s)) ds
///                    + e^-tau w(xi),                      w(x) = f(x) - Q (x + 1)
///
/// that is the steady state and the decay of what the front finds less that state (derived in
/// docs/physics.md). Within 1e-10 of the larger of the step and Q (1 + xi). On the front itself the
/// gas behind it is given; at z = 0 the gas has the inlet's temperature at t = 0 already.
/// Throws std::domain_error where a property is not positive, z or t negative.
BedTemperatures fixed_bed_temperatures(const FixedBed& bed, double height, double time);

}  // namespace bedscope::physics
