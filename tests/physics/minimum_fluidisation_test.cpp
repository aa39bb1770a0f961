// SPDX-License-Identifier: BSD-3-Clause
#include "physics/minimum_fluidisation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "physics/particle_motion.hpp"

namespace bedscope::physics {
namespace {

constexpr double g = 9.81;
constexpr Gas air{1.2, 1.8e-5};  // Mu (2022), Table 3.1
constexpr Sphere riser_particle{0.85e-3, 2500};
constexpr Gas bubbling_gas{1.49, 1e-5};  // Mu (2022), Table 2.3
constexpr Sphere bubbling_particle{0.995e-3, 667};

TEST(MinimumFluidisation, IsWhatTheThesisStatesAtAPlausibleVoidage) {
  // Mu (2022), section 2.4: 0.262 m/s; the bed's number of particles gives a voidage of 0.400.
  EXPECT_NEAR(minimum_fluidisation_velocity(bubbling_particle, bubbling_gas, g, 0.400), 0.262,
              5e-4);  // last digit
  // Section 3.4.3: 0.52 m/s, its voidage is not stated.
  EXPECT_NEAR(minimum_fluidisation_velocity(riser_particle, air, g, 0.419), 0.52, 5e-3);  // digit
}

TEST(MinimumFluidisation, DependsOnTheLaw) {
  EXPECT_NEAR(minimum_fluidisation_velocity(riser_particle, air, g, 0.42, beetstra), 0.496, 5e-4);
  EXPECT_NEAR(minimum_fluidisation_velocity_wen_yu(riser_particle, air, g), 0.436, 5e-4);  // digit
}

TEST(MinimumFluidisation, SolvesErgunsQuadraticEquation) {
  for (const double eps : {0.38, 0.42, 0.5}) {
    const double Ar = archimedes(riser_particle, air, g), a = 1.75 / std::pow(eps, 3),
                 b = 150 * (1 - eps) / std::pow(eps, 3);
    const double Re = (-b + std::sqrt(b * b + 4 * a * Ar)) / (2 * a);
    const double expected = Re * air.viscosity / (air.density * riser_particle.diameter);
    EXPECT_NEAR(minimum_fluidisation_velocity(riser_particle, air, g, eps) / expected, 1, 1e-12);
  }
}

TEST(MinimumFluidisation, HasTheLimitsOfWenAndYu) {
  // Ar / 1650 in creeping flow, sqrt(Ar / 24.5) in inertial flow, as Wen and Yu give them.
  const Sphere fine{20e-6, 2500}, coarse{50e-3, 2500};
  const auto Re = [](const Sphere& sphere) {
    return reynolds(air, minimum_fluidisation_velocity_wen_yu(sphere, air, g), sphere.diameter);
  };
  EXPECT_NEAR(Re(fine) / (archimedes(fine, air, g) / 1650), 1, 0.002);  // 1650 is 1651.96 rounded
  const double inertial = std::sqrt(archimedes(coarse, air, g) / 24.5);
  EXPECT_NEAR(Re(coarse) / inertial, 1, 0.005);  // 33.7 / Re
}

TEST(MinimumFluidisation, IsWhereThePressureDropEqualsTheWeight) {
  for (const NamedDragLaw& entry : drag_laws()) {
    const double eps = 0.42, height = 0.1, area = 1e-3;
    const double mass = (1 - eps) * height * area * riser_particle.density;
    const double u = minimum_fluidisation_velocity(riser_particle, air, g, eps, entry.law);
    const double drop =
        height * fixed_bed_pressure_gradient(riser_particle, air, eps, u, entry.law);
    const double weight = bed_pressure_drop(mass, area, 2500, 1.2, g);
    EXPECT_NEAR(drop / weight, 1, 1e-12) << entry.name;  // rounding
  }
}

TEST(PressureGradient, ByTwoLawsKeepsTheRatioFoundInACoupledRun) {
  // Pressure drops of a bed of 0.85 mm at a voidage of 0.426, Beetstra over Ergun, in whole Pa:
  // 87/78, 157/143, 238/219, 329/304 at these velocities.
  const double U[] = {0.15, 0.25, 0.35, 0.45}, by_beetstra[] = {87, 157, 238, 329},
               by_ergun[] = {78, 143, 219, 304};
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(fixed_bed_pressure_gradient(riser_particle, air, 0.426, U[i], beetstra) /
                    fixed_bed_pressure_gradient(riser_particle, air, 0.426, U[i]),
                by_beetstra[i] / by_ergun[i], 0.01);  // half a Pa on both
}

TEST(BedPressureDrop, IsTheWeightOverTheArea) {
  // 50,000 particles of the riser, 40.2 g on 0.07 x 0.006 m
  const double mass = 50000 * sphere_mass(riser_particle);
  EXPECT_NEAR(mass, 40.2e-3, 5e-5);                                                 // last digit
  EXPECT_NEAR(bed_pressure_drop(mass, 0.07 * 0.006, 2500, 0, g), 938.83, 5e-3);     // last digit
  EXPECT_NEAR(bed_pressure_drop(1, 1, 2500, 1.2, g), g * (1 - 1.2 / 2500), 1e-12);  // rounding
  EXPECT_THROW(bed_pressure_drop(1, 0, 2500, 1.2, g), std::domain_error);
  EXPECT_THROW(bed_pressure_drop(-1, 1, 2500, 1.2, g), std::domain_error);
}

TEST(MinimumFluidisation, OfWhatFloatsIsRefused) {
  EXPECT_THROW(minimum_fluidisation_velocity({1e-3, 1}, air, g, 0.4), std::domain_error);
  EXPECT_THROW(minimum_fluidisation_velocity_wen_yu({1e-3, 1}, air, g), std::domain_error);
  EXPECT_THROW(minimum_fluidisation_velocity(riser_particle, air, g, 0), std::domain_error);
}

}  // namespace
}  // namespace bedscope::physics
