// SPDX-License-Identifier: BSD-3-Clause
// How densely equal spheres pack.
#pragma once

namespace bedscope::physics {

/// Holdup of random close packing, 0.6366 +- 0.0005: Scott and Kilgour, Brit. J. Appl. Phys. 2
/// (1969) 863. Far from walls; friction and a short shake leave 0.60 to 0.63.
inline constexpr double random_close_packing = 0.6366;

/// Holdup of random loose packing, 0.555 +- 0.005, the limit without gravity: Onoda and Liniger,
/// Phys. Rev. Lett. 64 (1990) 2727. A defluidised bed lies between it and random close packing.
inline constexpr double random_loose_packing = 0.555;

/// pi / 6, spheres that touch on a cubic lattice.
inline constexpr double simple_cubic_packing = 0.5235987755982989;

/// pi / sqrt(18), the densest of all.
inline constexpr double densest_packing = 0.7404804896930610;

/// Holdup of a number of equal spheres in a volume [m3].
double holdup(double number, double diameter, double volume);

/// Standard deviation over mean of the number of equal hard spheres in a volume, of `number` in the
/// mean, that are at rest among each other (no clusters): sqrt(S / N).
///
///   S = (1 - phi)^4 / (1 + 4 phi + 4 phi^2 - 4 phi^3 + phi^4)
///
/// The long-wave limit of their structure factor; small volumes scatter more, by their surface.
/// Source: Carnahan and Starling, J. Chem. Phys. 51 (1969) 635, by the compressibility.
double number_scatter(double holdup, double number);

/// Height of a settled bed of equal spheres [m] at a holdup between 0 and the densest packing.
double settled_bed_height(double number, double diameter, double area, double settled_holdup);

}  // namespace bedscope::physics
