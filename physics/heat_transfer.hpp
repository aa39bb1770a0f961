// SPDX-License-Identifier: BSD-3-Clause
// Heat from gas to particles, and along the gas of a bed.
#pragma once

namespace bedscope::physics {

/// Pr = mu C_p / k.
double prandtl(double viscosity, double gas_heat_capacity, double gas_conductivity);

/// Nusselt number h d / k_g of a particle in a bed or suspension.
///
///   Nu = (7 - 10 eps + 5 eps^2) (1 + 0.7 Re^0.2 Pr^(1/3))
///      + (1.33 - 2.4 eps + 1.2 eps^2) Re^0.7 Pr^(1/3)
///
/// Re superficial: rho_g eps |u - v| d / mu. Meant for 0.35 <= eps <= 1 and Re up to 1e5; 2 for a
/// lone sphere in gas at rest. Source: Gunn, Int. J. Heat Mass Transfer 21 (1978) 467. Throws
/// std::domain_error outside 0 < eps <= 1, Re >= 0, Pr > 0.
double gunn_nusselt(double voidage, double reynolds, double prandtl);

/// h = Nu k_g / d [W/m2/K].
double heat_transfer_coefficient(double nusselt, double gas_conductivity, double diameter);

/// Effective conductivity of the gas phase of a bed [W/m/K].
///
///   k_eff = k_g (1 - sqrt(1 - eps)) / eps
///
/// Source: Syamlal and Gidaspow, AIChE J. 31 (1985) 127, as in Mu (2022), ch. 2.
double effective_gas_conductivity(double gas_conductivity, double voidage);

/// Surface of the particles in a volume of bed: a_s = 6 (1 - eps) / d [1/m].
double specific_surface(double voidage, double diameter);

/// h a_s [W/m3/K]: heat exchanged in a volume of bed for each kelvin between gas and particles.
double volumetric_heat_exchange(double heat_transfer_coefficient, double voidage, double diameter);

}  // namespace bedscope::physics
