// SPDX-License-Identifier: BSD-3-Clause
// Drag of a gas on the spheres of a suspension or a bed, by the laws in use.
//
// All laws are given in one form, the dimensionless drag F of one sphere,
//
//   F_d = 3 pi mu d eps F (u - v),   Re = eps rho_g |u - v| d / mu
//
// u - v is the interstitial slip velocity, so eps (u - v) and Re are superficial. F_d leaves out
// the force of the mean pressure gradient (-V_p grad p acts besides: model A), so that a bed at
// rest has -dp/dz = beta (u - v) / eps. F is 1 for a lone sphere in creeping flow.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "physics/phases.hpp"

namespace bedscope::physics {

/// F(voidage, Re).
using DragLaw = std::function<double(double voidage, double reynolds)>;

/// Packed beds.
///
///   F = [150 (1 - eps) + 1.75 Re] / (18 eps^2)
///
/// From -dp/dz = 150 mu (1-eps)^2 U / (eps^3 d^2) + 1.75 rho_g (1-eps) U^2 / (eps^3 d).
/// For voidages below about 0.8; at eps = 1 it has no viscous part left.
/// Source: Ergun, Chem. Eng. Prog. 48 (1952) 89.
/// Throws std::domain_error outside 0 < eps <= 1, Re >= 0, as every law here does.
double ergun(double voidage, double reynolds);

/// Suspensions; at eps = 1 the lone sphere of Schiller and Naumann.
///
///   F = eps^-3.65 Cd Re / 24,   Cd = 24 (1 + 0.15 Re^0.687) / Re for Re < 1000, else 0.44
///
/// Source: Wen and Yu, Chem. Eng. Prog. Symp. Ser. 62 (1966) 100: 3/4 Cd eps^-2.65 in beta. The
/// step of Cd at Re = 1000 (0.4383 to 0.44) is theirs.
double wen_yu(double voidage, double reynolds);

/// Ergun up to a voidage of 0.8, Wen and Yu above. It jumps there.
/// Source: Gidaspow, Multiphase Flow and Fluidization (1994).
double gidaspow(double voidage, double reynolds);

/// All voidages, one form.
///
///   F = eps^-chi Cd Re / 24,   Cd = (0.63 + 4.8 / sqrt(Re))^2,
///   chi = 3.7 - 0.65 exp(-(1.5 - log10 Re)^2 / 2)
///
/// Cd is Dallavalle's fit: 0.96 in creeping flow, not 1; 11 % above Schiller and Naumann at Re =
/// 10, 37 % at 900. Source: Di Felice, Int. J. Multiphase Flow 20 (1994) 153.
double di_felice(double voidage, double reynolds);

/// Fit to lattice-Boltzmann simulations of fixed arrays.
///
///   F = 10 (1 - eps) / eps^2 + eps^2 (1 + 1.5 sqrt(1 - eps))
///     + 0.413 Re / (24 eps^2) [1/eps + 3 eps (1 - eps) + 8.4 Re^-0.343]
///                             / [1 + 10^(3 (1 - eps)) Re^(-(1 + 4 (1 - eps)) / 2)]
///
/// Fitted for 0.4 <= eps <= 0.9 and Re up to 1000; tends to Carman-Kozeny in a dense creeping flow.
/// A lone sphere at Re = 300 feels 37 % more by it than by Schiller and Naumann. Source: Beetstra,
/// van der Hoef and Kuipers, AIChE J. 53 (2007) 489, eq. 16. Mu (2022), Eq. 3.4 and 4.4, is
/// misprinted: see docs/physics.md.
double beetstra(double voidage, double reynolds);

struct NamedDragLaw {
  std::string_view name;
  double (*law)(double voidage, double reynolds);
  double voidage_low, voidage_high;  ///< where its authors mean it to hold
  double reynolds_high;              ///< the largest Re of its data; infinity where it has no limit
};

/// beetstra, di_felice, ergun, gidaspow, wen_yu.
std::span<const NamedDragLaw> drag_laws();

/// The law of that name. Throws std::domain_error that lists the known names.
const NamedDragLaw& drag_law(std::string_view name);

/// Momentum exchange of gas and solids [kg/m3/s]: the force on the solids in a volume is
/// beta (u - v), without the pressure gradient's.
///
///   beta = 18 mu eps (1 - eps) F / d^2
double momentum_exchange(double dimensionless_drag, double voidage, const Gas& gas,
                         double diameter);

/// n = d ln F / d ln Re, by which a small change of the slip velocity changes the drag 1 + n times
/// as much: 0 in creeping flow, 1 where inertia rules. Re > 0. A central difference over 0.2 %.
double drag_slope(const DragLaw& law, double voidage, double reynolds);

/// Superficial slip velocity at which the drag carries the spheres' weight less buoyancy at this
/// voidage [m/s]: u_t at a voidage of 1, u_mf at that of the settled bed, hindered settling
/// between.
///
///   Re F(eps, Re) / eps = Ar / 18
///
/// gravity in m/s2. Throws std::domain_error where the spheres are not heavier than the gas.
double carrying_velocity(const Sphere& sphere, const Gas& gas, double gravity, double voidage,
                         const DragLaw& law);

}  // namespace bedscope::physics
