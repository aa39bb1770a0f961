// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contact.hpp"

#include <cmath>
#include <numbers>

#include "physics/require.hpp"

namespace bedscope::physics {
namespace {

constexpr double pi = std::numbers::pi;

/// zeta = -ln(e) / sqrt(pi^2 + ln^2(e)); 1 at e = 0.
double damping_ratio(double restitution) {
  require_between(restitution, 0, 1, "restitution");
  return restitution == 0 ? 1 : -std::log(restitution) / std::hypot(pi, std::log(restitution));
}

void require_rebound(double restitution) {
  require_between(restitution, 0, 1, "restitution");
  require_positive(restitution, "restitution");
}

double harmonic(double a, double b, const char* what) {
  for (const double x : {a, b})
    if (!(x > 0)) require_positive(x, what);  // infinity is a wall
  if (std::isinf(a) && std::isinf(b))
    throw std::domain_error(fmt::format("expected a finite {}, found two walls", what));
  return 1 / (1 / a + 1 / b);
}

}  // namespace

double effective_mass(double mass_1, double mass_2) { return harmonic(mass_1, mass_2, "mass"); }

double effective_radius(double radius_1, double radius_2) {
  return harmonic(radius_1, radius_2, "radius");
}

double damping_coefficient(double stiffness, double effective_mass, double restitution) {
  require_positive(stiffness, "stiffness");
  require_positive(effective_mass, "effective mass");
  return 2 * damping_ratio(restitution) * std::sqrt(effective_mass * stiffness);
}

double restitution_from_damping(double stiffness, double effective_mass, double damping) {
  require_positive(stiffness, "stiffness");
  require_positive(effective_mass, "effective mass");
  require_not_negative(damping, "damping");
  const double zeta = damping / (2 * std::sqrt(effective_mass * stiffness));
  return zeta >= 1 ? 0 : std::exp(-pi * zeta / std::sqrt((1 - zeta) * (1 + zeta)));
}

double contact_time(double stiffness, double effective_mass, double restitution) {
  require_positive(stiffness, "stiffness");
  require_positive(effective_mass, "effective mass");
  require_rebound(restitution);
  return std::sqrt(effective_mass / stiffness) * std::hypot(pi, std::log(restitution));
}

double largest_overlap(double stiffness, double effective_mass, double impact_velocity,
                       double restitution) {
  require_positive(stiffness, "stiffness");
  require_positive(effective_mass, "effective mass");
  require_not_negative(impact_velocity, "impact velocity");
  require_rebound(restitution);
  const double slope = -std::log(restitution) / pi;  // zeta / sqrt(1 - zeta^2)
  return impact_velocity * std::sqrt(effective_mass / stiffness) *
         std::exp(-slope * std::atan2(1, slope));
}

double tangential_stiffness_ratio(double normal_restitution, double tangential_restitution) {
  require_rebound(normal_restitution);
  require_rebound(tangential_restitution);
  const double ratio = std::hypot(pi, std::log(tangential_restitution)) /
                       std::hypot(pi, std::log(normal_restitution));
  return 2.0 / 7.0 * ratio * ratio;
}

double effective_modulus(double young_1, double poisson_1, double young_2, double poisson_2) {
  require_positive(young_1, "Young's modulus");
  require_positive(young_2, "Young's modulus");
  require_between(poisson_1, -1, 0.5, "Poisson ratio");
  require_between(poisson_2, -1, 0.5, "Poisson ratio");
  return 1 / ((1 - poisson_1 * poisson_1) / young_1 + (1 - poisson_2 * poisson_2) / young_2);
}

double hertz_largest_overlap(double modulus, double radius, double effective_mass,
                             double impact_velocity) {
  require_positive(modulus, "modulus");
  require_positive(radius, "radius");
  require_positive(effective_mass, "effective mass");
  require_not_negative(impact_velocity, "impact velocity");
  return std::pow(
      15 * effective_mass * impact_velocity * impact_velocity / (16 * modulus * std::sqrt(radius)),
      0.4);
}

double hertz_contact_time(double modulus, double radius, double effective_mass,
                          double impact_velocity) {
  require_positive(impact_velocity, "impact velocity");
  static const double number = 0.8 * std::tgamma(0.4) * std::sqrt(pi) / std::tgamma(0.9);
  return number * hertz_largest_overlap(modulus, radius, effective_mass, impact_velocity) /
         impact_velocity;
}

double hertz_damping_coefficient(double modulus, double radius, double effective_mass,
                                 double overlap, double restitution) {
  require_positive(modulus, "modulus");
  require_positive(radius, "radius");
  require_positive(effective_mass, "effective mass");
  require_not_negative(overlap, "overlap");
  const double stiffness = 2 * modulus * std::sqrt(radius * overlap);
  return 2 * std::sqrt(5.0 / 6.0) * damping_ratio(restitution) *
         std::sqrt(stiffness * effective_mass);
}

}  // namespace bedscope::physics
