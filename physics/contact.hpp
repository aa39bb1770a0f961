// SPDX-License-Identifier: BSD-3-Clause
// Collisions of two spheres, or of a sphere and a wall: linear spring-dashpot and Hertz.
//
// All restitutions here belong to a contact that ends when the overlap is back at zero, the usual
// definition. Codes that cut the attractive force at the end (LIGGGHTS: limitForce) give more at
// small e (Schwager and Poeschel, Granular Matter 9 (2007) 465).
#pragma once

namespace bedscope::physics {

/// 1 / (1/m1 + 1/m2) [kg]; a wall has infinite mass. Same form for the effective radius [m].
double effective_mass(double mass_1, double mass_2);
double effective_radius(double radius_1, double radius_2);

// Linear spring-dashpot: m_eff x'' + eta x' + k x = 0.

/// Dashpot coefficient that gives the restitution e [kg/s].
///
///   eta = -2 ln(e) sqrt(m_eff k) / sqrt(pi^2 + ln^2(e))
///
/// 0 <= e <= 1; e = 0 is the critically damped limit 2 sqrt(m_eff k), which Mu (2022), Eq. 4.10,
/// prints for every e. Source: the damped linear oscillator, half a period.
double damping_coefficient(double stiffness, double effective_mass, double restitution);

/// The inverse: e = exp(-pi zeta / sqrt(1 - zeta^2)), zeta = eta / (2 sqrt(m_eff k)); 0 where the
/// contact is damped critically or more.
double restitution_from_damping(double stiffness, double effective_mass, double damping);

/// Duration of a contact [s]: half a period of the damped oscillator.
///
///   t_c = sqrt(m_eff / k) sqrt(pi^2 + ln^2(e))
///
/// 0 < e <= 1: the time tends to infinity for e -> 0.
double contact_time(double stiffness, double effective_mass, double restitution = 1);

/// Largest overlap of a head-on impact [m].
///
///   delta = v sqrt(m_eff / k) exp(-zeta / sqrt(1 - zeta^2) atan(sqrt(1 - zeta^2) / zeta))
///
/// Without damping v sqrt(m_eff / k). 0 < e <= 1.
double largest_overlap(double stiffness, double effective_mass, double impact_velocity,
                       double restitution = 1);

/// k_t / k_n for which the tangential contact of solid spheres lasts as long as the normal one.
///
///   k_t / k_n = (2/7) (pi^2 + ln^2(e_t)) / (pi^2 + ln^2(e_n))
///
/// The effective tangential mass of a solid sphere is 2/7 of the normal one. 0 < e <= 1 for both.
/// Source: van der Hoef et al., Adv. Chem. Eng. 31 (2006) 65; Mu (2022), Eq. 4.14, is misprinted.
double tangential_stiffness_ratio(double normal_restitution, double tangential_restitution);

// Hertz: F = (4/3) E_eff sqrt(R_eff) delta^(3/2).

/// E_eff = 1 / ((1 - nu1^2)/E1 + (1 - nu2^2)/E2) [Pa].
double effective_modulus(double young_1, double poisson_1, double young_2, double poisson_2);

/// Largest overlap of an elastic head-on impact [m].
///
///   delta = [15 m_eff v^2 / (16 E_eff sqrt(R_eff))]^(2/5)
double hertz_largest_overlap(double modulus, double radius, double effective_mass,
                             double impact_velocity);

/// Duration of an elastic head-on impact [s].
///
///   t_c = 2.9433 delta / v = 2.8683 [m_eff^2 / (R_eff E_eff^2 v)]^(1/5)
///
/// The number is (4/5) B(2/5, 1/2). Grows without limit for v -> 0: v > 0.
/// Source: Hertz (1882); Johnson, Contact Mechanics (1985), section 11.4.
double hertz_contact_time(double modulus, double radius, double effective_mass,
                          double impact_velocity);

/// Dashpot coefficient at an overlap that gives the restitution e at every velocity [kg/s]; what
/// LIGGGHTS' `model hertz` uses.
///
///   eta = -2 sqrt(5/6) ln(e) / sqrt(pi^2 + ln^2(e)) sqrt(S_n m_eff),  S_n = 2 E_eff sqrt(R_eff
///   delta)
///
/// 0 <= e <= 1. Source: Tsuji et al., Powder Technol. 71 (1992) 239 (the form); Antypov and
/// Elliott, EPL 94 (2011) 50004 (exact for this e).
double hertz_damping_coefficient(double modulus, double radius, double effective_mass,
                                 double overlap, double restitution);

}  // namespace bedscope::physics
