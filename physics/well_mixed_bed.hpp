// SPDX-License-Identifier: BSD-3-Clause
// A fluidised bed whose particles are heated from inside, as one stirred vessel.
#pragma once

#include <span>
#include <vector>

namespace bedscope::physics {

struct WellMixedBed {
  double inlet_temperature;          ///< of the gas [K]
  double superficial_velocity;       ///< [m/s]
  double gas_heat_capacity;          ///< rho_g C_pg [J/m3/K], of a volume of gas
  double solids_height;              ///< H (1 - eps) [m]: the solids' volume over the cross-section
  double diameter;                   ///< of the particles [m]
  double heat_transfer_coefficient;  ///< h [W/m2/K]
};

/// Particles that are heated alike.
struct HeatedFraction {
  double fraction;  ///< of the solids' volume
  double source;    ///< q [W/m3], in a volume of solids
};

struct EquilibriumTemperatures {
  double gas;                    ///< [K]; the bed's and the outlet's
  std::vector<double> particle;  ///< [K], one for each fraction
};

/// Temperatures at which all that the particles give off leaves with the gas.
///
///   T_g   = T_in + H (1 - eps) sum_i x_i q_i / (rho_g C_pg u)
///   T_p,i = T_g + q_i (1 - eps) / (h a_s) = T_g + q_i d / (6 h)
///
/// No losses through walls, no conduction between particles, gas perfectly mixed. The particles'
/// heat capacity is not in it. Source: Mu (2022), Eqs. 2.15-2.17, with a_s = 6 (1 - eps) / d.
/// Throws std::domain_error where the fractions do not add up to 1 within 1e-9.
EquilibriumTemperatures equilibrium_temperatures(const WellMixedBed& bed,
                                                 std::span<const HeatedFraction> fractions);

/// Time in which such a bed comes within 1/e of its equilibrium [s], for particles at the gas'
/// temperature:
///
///   t = H (1 - eps) rho_p C_pp / (rho_g C_pg u)
double thermal_time(const WellMixedBed& bed, double solids_heat_capacity);

/// Mean particle temperature of a bed after a time [K] from a uniform start:
/// T(t) = T_eq + (T_0 - T_eq) e^(-t / thermal time).
double relaxing_temperature(double start, double equilibrium, double thermal_time, double time);

/// Heating without any exchange: q / (rho_p C_pp) [K/s].
double adiabatic_heating_rate(double source, double solids_heat_capacity);

}  // namespace bedscope::physics
