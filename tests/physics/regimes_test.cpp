// SPDX-License-Identifier: BSD-3-Clause
#include "physics/regimes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>

#include "physics/time_steps.hpp"

namespace bedscope::physics {
namespace {

constexpr Gas air{1.2, 1.8e-5};

TEST(Geldart, GroupsOfKnownPowders) {
  EXPECT_EQ(geldart_group({10e-6, 2500}, 1.2, 9.81), 'C');   // flour
  EXPECT_EQ(geldart_group({60e-6, 1500}, 1.2, 9.81), 'A');   // cracking catalyst
  EXPECT_EQ(geldart_group({200e-6, 2500}, 1.2, 9.81), 'B');  // sand
  EXPECT_EQ(geldart_group({1e-3, 2500}, 1.2, 9.81), 'D');    // glass beads
  EXPECT_THROW(geldart_group({1e-3, 1}, 1.2, 9.81), std::domain_error);
}

TEST(Bagnold, IsTheRatioOfImpactAndViscousStress) {
  // lambda = 1 where phi_max / phi = 8
  EXPECT_NEAR(bagnold({1e-3, 2500}, 1.8e-5, 0.08, 10, 0.64), 2500 * 1e-6 * 10 / 1.8e-5, 1e-9);
  EXPECT_THROW(bagnold({1e-3, 2500}, 1.8e-5, 0.7, 10, 0.64), std::domain_error);
}

TEST(Coupling, ChangesAtElghobashisHoldups) {
  EXPECT_EQ(needed_coupling(9e-7), Coupling::one_way);
  EXPECT_EQ(needed_coupling(2e-6), Coupling::two_way);
  EXPECT_EQ(needed_coupling(2e-3), Coupling::four_way);
}

TEST(Lift, IsSaffmansInCreepingFlow) {
  // F = 1: 1.615 / (3 pi) sqrt(Re_g), for Re -> 0 and a slip that outruns the shear
  const double slip = 1e-4, d = 1e-4, shear = 1e-3;
  const double re_shear = 1.2 * shear * d * d / 1.8e-5;
  EXPECT_NEAR(lift_over_drag(air, d, slip, shear, 1) / (1.615 / 9.42477796 * std::sqrt(re_shear)),
              1,
              0.02);  // Mei's factor there is 0.999 (1 - 0.33 sqrt(beta)) + ...
}

TEST(Lift, OfMeiStepsAtReOf40ByWhatIsLeftOfSaffmans) {
  // 0.0524 sqrt(40) = 0.3314: the fits part by (1 - 0.3314 sqrt(beta)) e^-4.
  const double d = 1e-3, u = 40 * 1.8e-5 / 1.2 / d, shear = 50;
  const double b = 0.3314 * std::sqrt(shear * d / (2 * u));
  EXPECT_NEAR(
      lift_over_drag(air, d, u * 1.0001, shear, 1) / lift_over_drag(air, d, u * 0.9999, shear, 1),
      b / ((1 - b) * std::exp(-4) + b), 1e-3);
}

TEST(Radiation, IsTheSlopeOfTheStefanBoltzmannLaw) {
  const double T = 500, dT = 0.01, sigma = 5.670374419e-8;
  EXPECT_NEAR(radiation_coefficient(0.8, T),
              0.8 * sigma * (std::pow(T + dT, 4) - std::pow(T - dT, 4)) / (2 * dT), 1e-6);
}

TEST(SmallNumbers, AreTheirDefinitions) {
  EXPECT_NEAR(mass_loading(0.02, 2500, 1.25), 0.02 * 2000 / 0.98, 1e-12);
  EXPECT_NEAR(biot(300, 1e-3, 0.5), 0.1, 1e-12);
  EXPECT_NEAR(added_mass_ratio(1000, 1), 5e-4, 1e-15);
  EXPECT_NEAR(froude(2, 10, 0.1), 4, 1e-12);
  EXPECT_NEAR(duct_reynolds({1, 1e-5}, 1, 0.1, 0.1), 1e4, 1e-8);  // a square duct: its side
  EXPECT_NEAR(plate_friction(1e-3, 0.1, 0.01), 12.0, 1e-12);
  EXPECT_NEAR(contact_conductance(100, 1e-5), 2e-3, 1e-15);
}

/// Largest modulus of the eigenvalues of v'' = p v' + q v.
double modulus(double p, double q) {
  const std::complex<double> root = std::sqrt(std::complex<double>(p * p + 4 * q));
  return std::max(std::abs(p + root), std::abs(p - root)) / 2;
}

TEST(TimeSteps, OfHeldDragAndHeatAreWhereTheirEigenvaluesLeaveTheUnitCircle) {
  for (const double eps : {0.35, 0.45, 0.6, 0.9}) {
    const double c = (1 - eps) / (2 * eps), longest = longest_drag_step(eps, 1000, 1000);
    const auto growth = [&](double step) {
      const double r = step / (eps * (1 - eps));  // over eps tau, tau = 1 - eps
      return modulus(1 - r * (1 + c), -r * c);
    };
    EXPECT_LT(growth(0.999 * longest), 1) << eps;
    EXPECT_GT(growth(1.001 * longest), 1) << eps;
  }
  for (const double a_over_b : {0.0, 0.3, 0.9})
    for (const double courant_over_b : {0.1, 1.0, 5.0}) {  // with 0 their heat is kept: 1
      double b = 2;
      for (int i = 0; i < 200; ++i) b = longest_heat_step(a_over_b * b, courant_over_b * b);
      const auto growth = [&](double step) {  // gas first, then particles with the gas' new value
        const double a = a_over_b * step, s = 1 + a + courant_over_b * step;
        const double trace = 1 / s + 1 - step + a * step / s, determinant = (1 - step) / s;
        return modulus(trace, -determinant);
      };
      EXPECT_LT(growth(0.999 * b), 1) << a_over_b << " " << courant_over_b;
      EXPECT_GT(growth(1.001 * b), 1) << a_over_b << " " << courant_over_b;
    }
}

TEST(TimeSteps, OfRayleighIsThatOfASurfaceWave) {
  // The wave runs at about (0.1631 nu + 0.8766) sqrt(G / rho): steel, 2.9 km/s
  const double t = rayleigh_time({0.01, 7800}, 2.1e11, 0.3);
  EXPECT_NEAR(3.14159265 * 0.005 / t, 2960, 30);
}

TEST(TimeSteps, OfDragAreMassOverExchange) {
  EXPECT_NEAR(gas_relaxation_time(0.4, 1.2, 4800), 1e-4, 1e-15);
  EXPECT_NEAR(solids_relaxation_time(0.4, 2500, 5000), 0.3, 1e-12);
  EXPECT_NEAR(gas_thermal_time(0.4, 2500, 1e6), 1e-3, 1e-15);
  EXPECT_NEAR(courant(5, 1e-4, 2.5e-3), 0.2, 1e-12);
  EXPECT_NEAR(longest_drag_step(1 - 1e-9, 2500, 5000e-9), 1, 1e-6);  // alone: twice 0.5 s
  EXPECT_NEAR(longest_drag_step(0.4, 2500, 5000), 2 * 0.4 / 0.6 * 0.4 * 0.3, 1e-12);
  EXPECT_NEAR(longest_drag_step(0.5, 2500, 5000), 2 * 0.5 * 0.25, 1e-12);
  EXPECT_NEAR(longest_heat_step(0, 0.3), 2, 1e-15);
  EXPECT_NEAR(longest_heat_step(6, 1), 6, 1e-15);
  EXPECT_THROW(gas_relaxation_time(0, 1.2, 4800), std::domain_error);
  EXPECT_THROW(rayleigh_time({0.01, 7800}, 0, 0.3), std::domain_error);
}

}  // namespace
}  // namespace bedscope::physics
