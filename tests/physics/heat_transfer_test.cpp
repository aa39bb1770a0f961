// SPDX-License-Identifier: BSD-3-Clause
#include "physics/heat_transfer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace bedscope::physics {
namespace {

TEST(Gunn, IsTwoForALoneSphereInGasAtRest) {
  EXPECT_NEAR(gunn_nusselt(1, 0, 0.7), 2, 1e-15);  // rounding
  EXPECT_NEAR(gunn_nusselt(1, 0, 7), 2, 1e-15);    // rounding
}

TEST(Gunn, IsNearRanzAndMarshallForALoneSphere) {
  // Nu = 2 + 0.6 Re^(1/2) Pr^(1/3), Ranz and Marshall, Chem. Eng. Prog. 48 (1952) 141.
  for (const double Re : {10.0, 100.0, 1000.0})
    for (const double Pr : {0.7, 7.0}) {
      const double other = 2 + 0.6 * std::sqrt(Re) * std::cbrt(Pr);
      EXPECT_NEAR(gunn_nusselt(1, Re, Pr) / other, 1, 0.35);  // two correlations, up to 33 % apart
    }
}

TEST(Gunn, IsNearWakaoAndKagueiInAPackedBed) {
  // Nu = 2 + 1.1 Re^0.6 Pr^(1/3), Wakao and Kaguei (1982), for packed beds.
  for (const double Re : {30.0, 100.0, 1000.0}) {
    const double other = 2 + 1.1 * std::pow(Re, 0.6) * std::cbrt(0.7);
    EXPECT_NEAR(gunn_nusselt(0.4, Re, 0.7) / other, 1, 0.5);  // two correlations, up to 46 % apart
  }
}

TEST(Gunn, AtAVoidageNearThreeFifthsGivesTheTemperatureDifferencesOfTheThesis) {
  // Mu (2022), Table 2.5: the ratio column holds 20.5, 19.2 and 18.1 K between active and inactive
  // particles at 0.4, 0.5, 0.6 m/s, whatever the height of the bed: 269, 287, 304 W/m2/K.
  const double Pr = prandtl(1e-5, 1670, 0.0209);
  const auto h = [Pr](double voidage, double u) {
    return heat_transfer_coefficient(gunn_nusselt(voidage, 1.49 * u * 0.995e-3 / 1e-5, Pr), 0.0209,
                                     0.995e-3);
  };
  EXPECT_NEAR(h(0.575, 0.4), 268.6, 1);  // 0.1 K of 20.5 is 1.3 W/m2/K
  EXPECT_NEAR(h(0.584, 0.5), 286.8, 1);
  EXPECT_NEAR(h(0.590, 0.6), 304.2, 1);
}

TEST(EffectiveConductivity, IsTheGasOwnWithoutParticlesAndHalfInDenseSolids) {
  EXPECT_DOUBLE_EQ(effective_gas_conductivity(0.0209, 1), 0.0209);
  EXPECT_NEAR(effective_gas_conductivity(0.0209, 1e-6), 0.0209 / 2, 1e-8);  // 1/2 + eps/8
}

TEST(SpecificSurface, IsThatOfTheSpheresInTheVolume) {
  const double d = 1e-3, holdup = 0.6, pi = std::acos(-1);
  const double number = holdup / (pi / 6 * d * d * d);
  EXPECT_NEAR(specific_surface(0.4, d) / (number * pi * d * d), 1, 1e-12);  // rounding
  EXPECT_DOUBLE_EQ(volumetric_heat_exchange(300, 0.4, d), 300 * specific_surface(0.4, d));
  EXPECT_EQ(specific_surface(1, d), 0);
}

TEST(HeatTransfer, RefusesWhatIsOutside) {
  EXPECT_THROW(gunn_nusselt(0, 1, 1), std::domain_error);
  EXPECT_THROW(gunn_nusselt(0.4, -1, 1), std::domain_error);
  EXPECT_THROW(gunn_nusselt(0.4, 1, 0), std::domain_error);
  EXPECT_THROW(effective_gas_conductivity(0.0209, 1.5), std::domain_error);
  EXPECT_THROW(specific_surface(0.4, 0), std::domain_error);
}

}  // namespace
}  // namespace bedscope::physics
