// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "physics/phases.hpp"

namespace bedscope::physics {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Sphere riser_particle{0.85e-3, 2500};  // Mu (2022), Table 3.1
constexpr double k_n = 1600;

struct Impact {
  double time, overlap, restitution;
};

/// Integrates m x'' = -force(x, x') from x = 0 at velocity v until x is 0 again: classical
/// Runge-Kutta, the last step cut linearly.
Impact collide(double mass, double v, double dt,
               const std::function<double(double, double)>& force) {
  double x = 0, u = v, t = 0, deepest = 0;
  for (;;) {
    const auto a = [&](double at, double speed) { return -force(at, speed) / mass; };
    const double a1 = a(x, u), u2 = u + dt / 2 * a1;
    const double a2 = a(x + dt / 2 * u, u2), u3 = u + dt / 2 * a2;
    const double a3 = a(x + dt / 2 * u2, u3), u4 = u + dt * a3;
    const double a4 = a(x + dt * u3, u4);
    const double next = x + dt / 6 * (u + 2 * u2 + 2 * u3 + u4);
    const double faster = u + dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    if (next <= 0) {
      const double part = x / (x - next);
      return {t + part * dt, deepest, -(u + part * (faster - u)) / v};
    }
    x = next, u = faster, t += dt;
    deepest = std::max(deepest, x);
  }
}

TEST(EffectiveMass, IsHalfForEqualsAndTheWholeAtAWall) {
  EXPECT_DOUBLE_EQ(effective_mass(2, 2), 1);
  EXPECT_DOUBLE_EQ(effective_mass(2, infinity), 2);
  EXPECT_DOUBLE_EQ(effective_radius(1, 3), 0.75);
  EXPECT_THROW(effective_mass(0, 1), std::domain_error);
  EXPECT_THROW(effective_mass(infinity, infinity), std::domain_error);
}

TEST(LinearContact, LastsAsLongAsTheRiserAndTheBinaryRiserNeed) {
  const auto elastic = [](double d, double rho) {
    const double m = sphere_mass({d, rho});
    return contact_time(k_n, effective_mass(m, m));
  };
  EXPECT_NEAR(elastic(0.85e-3, 2500), 49.8e-6, 5e-8);  // last digit; 5 steps of 1e-5 s
  EXPECT_NEAR(elastic(125e-6, 2400), 2.75e-6, 5e-9);   // last digit; below a step of 1e-5 s
  EXPECT_NEAR(elastic(185e-6, 2400), 4.95e-6, 5e-9);   // last digit
}

TEST(LinearContact, StaysBelowOnePerCentOfTheRadiusOnlyInSlowImpacts) {
  const double m = sphere_mass(riser_particle);
  const double v = 0.27;  // Mu (2022), section 4.2.3 asks for 1 %
  EXPECT_NEAR(largest_overlap(k_n, m / 2, v) / (0.85e-3 / 2), 0.01, 1e-4);  // 0.27 is two digits
}

TEST(LinearContact, HasDurationDepthAndRestitutionOfItsEquationOfMotion) {
  const double m = sphere_mass(riser_particle) / 2;
  for (const double e : {1.0, 0.96, 0.86, 0.33, 0.05})
    for (const double v : {0.1, 5.0}) {
      const double eta = damping_coefficient(k_n, m, e);
      const double expected = contact_time(k_n, m, e);
      const Impact found =
          collide(m, v, expected / 20000, [eta](double x, double u) { return k_n * x + eta * u; });
      EXPECT_NEAR(found.time / expected, 1, 1e-6);  // the cut of the last step
      EXPECT_NEAR(found.restitution / e, 1, 1e-6);  // the same
      EXPECT_NEAR(found.overlap / largest_overlap(k_n, m, v, e), 1, 1e-6);  // half a step squared
    }
}

TEST(Damping, AndRestitutionAreEachOthersInverse) {
  for (const double e : {1e-6, 0.1, 0.33, 0.86, 0.96, 0.999, 1.0})
    EXPECT_NEAR(restitution_from_damping(1600, 4e-7, damping_coefficient(1600, 4e-7, e)) / e, 1,
                1e-9);  // rounding, times 1 / (1 - zeta^2) near critical damping
}

TEST(Damping, AsPrintedInTheThesisIsThatOfNoRebound) {
  const double m = 4e-7, printed = 2 * std::sqrt(m * k_n);  // Mu (2022), Eq. 4.10
  EXPECT_DOUBLE_EQ(damping_coefficient(k_n, m, 0), printed);
  EXPECT_EQ(restitution_from_damping(k_n, m, printed), 0);
  EXPECT_EQ(restitution_from_damping(k_n, m, 2 * printed), 0);
  EXPECT_NEAR(printed / damping_coefficient(k_n, m, 0.96), 77, 0.5);  // so much too large
}

TEST(TangentialStiffness, IsThatOfTheThesisTablesWithinTheirRounding) {
  EXPECT_NEAR(k_n * tangential_stiffness_ratio(0.96, 0.33), 514, 0.02);     // Table 4.1: 513.99
  EXPECT_NEAR(k_n * tangential_stiffness_ratio(0.86, 0.33), 512.89, 5e-3);  // it prints 512.95
  EXPECT_NEAR(k_n * tangential_stiffness_ratio(0.97, 0.33), 514.03, 5e-3);  // Table 5.1: 514.08
  EXPECT_LT(k_n * tangential_stiffness_ratio(1, 0.33), 514.08);             // which no e_n reaches
}

TEST(TangentialStiffness, MakesBothPeriodsEqual) {
  // The tangential oscillator: mass 2/7 of the normal one, k_t, and the dashpot that gives e_t.
  const double m = 4e-7;
  for (const double e_n : {0.6, 0.96})
    for (const double e_t : {0.33, 0.9}) {
      const double k_t = k_n * tangential_stiffness_ratio(e_n, e_t);
      EXPECT_NEAR(contact_time(k_t, 2 * m / 7, e_t) / contact_time(k_n, m, e_n), 1, 1e-12);
    }
}

// Mu (2022), Table 2.3
constexpr double young = 5e5, poisson = 0.45;
const double modulus = effective_modulus(young, poisson, young, poisson);
const double radius = effective_radius(0.995e-3 / 2, 0.995e-3 / 2);
const double mass = sphere_mass({0.995e-3, 667}) / 2;

TEST(HertzContact, HasTheModulusOfEqualAndOfRigidPartners) {
  EXPECT_NEAR(modulus / (young / (2 * (1 - 0.45 * 0.45))), 1, 1e-15);   // rounding
  EXPECT_NEAR(effective_modulus(young, 0, 1e30, 0) / young, 1, 1e-12);  // rounding
  EXPECT_THROW(effective_modulus(young, 0.6, young, 0), std::domain_error);
}

TEST(HertzContact, HasTheConstantsOfTextbooks) {
  // 2.94 delta / v and 2.87 (m^2 / (R E^2 v))^(1/5): Johnson (1985)
  const double v = 0.5, t = hertz_contact_time(modulus, radius, mass, v);
  const double delta = hertz_largest_overlap(modulus, radius, mass, v);
  EXPECT_NEAR(t * v / delta, 2.94, 5e-3);  // last digit
  EXPECT_NEAR(t / std::pow(mass * mass / (radius * modulus * modulus * v), 0.2), 2.87, 5e-3);
}

TEST(HertzContact, HasDurationAndDepthOfItsEquationOfMotion) {
  for (const double v : {0.01, 1.0}) {
    const double expected = hertz_contact_time(modulus, radius, mass, v);
    const Impact found = collide(mass, v, expected / 20000, [](double x, double) {
      return 4.0 / 3.0 * modulus * std::sqrt(radius * std::max(x, 0.0)) * x;
    });
    EXPECT_NEAR(found.time / expected, 1, 1e-6);  // x^1.5 is not smooth at 0
    EXPECT_NEAR(found.overlap / hertz_largest_overlap(modulus, radius, mass, v), 1, 1e-6);  // same
  }
}

TEST(HertzContact, ReboundsWithTheSameRestitutionAtEveryVelocity) {
  for (const double e : {0.9, 0.6, 0.3})
    for (const double v : {0.01, 1.0}) {
      const double dt = hertz_contact_time(modulus, radius, mass, v) / 20000;
      const Impact found = collide(mass, v, dt, [e](double x, double u) {
        const double overlap = std::max(x, 0.0);
        return 4.0 / 3.0 * modulus * std::sqrt(radius * overlap) * overlap +
               hertz_damping_coefficient(modulus, radius, mass, overlap, e) * u;
      });
      EXPECT_NEAR(found.restitution, e, 1e-4);  // x^(1/4) in the dashpot: low order at the ends
    }
}

TEST(Contact, RefusesWhatIsNoRestitution) {
  for (const double e : {-0.1, 1.1, std::nan("")}) {
    EXPECT_THROW(damping_coefficient(k_n, mass, e), std::domain_error);
    EXPECT_THROW(contact_time(k_n, mass, e), std::domain_error);
    EXPECT_THROW(tangential_stiffness_ratio(e, 0.33), std::domain_error);
    EXPECT_THROW(hertz_damping_coefficient(modulus, radius, mass, 1e-6, e), std::domain_error);
  }
  EXPECT_THROW(contact_time(k_n, mass, 0), std::domain_error);  // lasts for ever
  EXPECT_THROW(contact_time(0, mass), std::domain_error);
  EXPECT_THROW(hertz_contact_time(modulus, radius, mass, 0), std::domain_error);
}

}  // namespace
}  // namespace bedscope::physics
