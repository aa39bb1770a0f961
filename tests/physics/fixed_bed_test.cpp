// SPDX-License-Identifier: BSD-3-Clause
#include "physics/fixed_bed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "physics/heat_transfer.hpp"
#include "physics/well_mixed_bed.hpp"

namespace bedscope::physics {
namespace {

/// Poisson probabilities e^-x x^k / k! for k = 0 ... n - 1.
std::vector<double> poisson(double x, int n) {
  std::vector<double> p(n);
  for (int k = 0; k < n; ++k) p[k] = std::exp(k * std::log(x) - x - std::lgamma(k + 1.0));
  return p;
}

/// Anzelius' gas temperature as a series of positive terms: the probability that a Poisson number
/// of mean xi does not exceed one of mean tau. Follows from I0's own series, term by term.
double gas_by_series(double xi, double tau) {
  const int n = static_cast<int>(std::max(xi, tau) + 15 * std::sqrt(std::max(xi, tau)) + 60);
  const auto along = poisson(xi, n), elapsed = poisson(tau, n);
  double at_most = 0, sum = 0;
  for (int k = 0; k < n; ++k) {
    at_most += along[k];
    sum += elapsed[k] * at_most;
  }
  return sum;
}

TEST(Anzelius, IsItsSeries) {
  for (const double xi : {0.01, 0.3, 1.0, 5.0, 18.8, 60.0, 300.0})
    for (const double tau : {0.01, 0.3, 1.0, 5.0, 18.8, 60.0, 300.0}) {
      const auto [gas, particle] = anzelius(xi, tau);
      // lgamma and exp of numbers up to 2000 carry 2000 roundings: 4e-13
      EXPECT_NEAR(gas, gas_by_series(xi, tau), 1e-12) << xi << " " << tau;
      EXPECT_NEAR(particle, 1 - gas_by_series(tau, xi), 1e-12) << xi << " " << tau;
    }
}

TEST(Anzelius, HasItsLimits) {
  for (const double x : {0.0, 1e-9, 0.5, 20.0, 1e3, 1e6}) {
    EXPECT_DOUBLE_EQ(anzelius(0, x).gas, 1);                       // the inlet
    EXPECT_NEAR(anzelius(0, x).particle, -std::expm1(-x), 1e-13);  // a particle at the inlet
    EXPECT_NEAR(anzelius(x, 0).gas, std::exp(-x), 1e-13);          // the front
    EXPECT_DOUBLE_EQ(anzelius(x, 0).particle, 0);                  // still cold there
    EXPECT_EQ(anzelius(x, -1e-9).gas, 0);                          // before the front
  }
  EXPECT_TRUE(std::isnan(anzelius(1, std::nan("")).gas));
  EXPECT_THROW(anzelius(-1, 1), std::domain_error);
}

TEST(Anzelius, OnTheDiagonalIsGoldsteinsClosedForm) {
  // gas = (1 + e^-2x I0(2x)) / 2; I0(2) = 2.2795853023, I0(10) = 2815.7166284 (Abramowitz and
  // Stegun 1964, table 9.8)
  EXPECT_NEAR(anzelius(1, 1).gas, (1 + std::exp(-2) * 2.2795853023360673) / 2, 1e-13);
  EXPECT_NEAR(anzelius(5, 5).gas, (1 + std::exp(-10) * 2815.716628466254) / 2, 1e-12);
  // for large x: 1/2 + 1 / (4 sqrt(pi x)) (1 + 1 / (16 x))
  const double x = 1e6, pi = std::acos(-1);
  EXPECT_NEAR(anzelius(x, x).gas, 0.5 + (1 + 1 / (16 * x)) / (4 * std::sqrt(pi * x)), 1e-12);
}

/// Mu (2022), Tables 2.1 and 2.2, with a velocity and a source of our choice (not stated there).
FixedBed thesis_bed(double source) {
  const double voidage = 0.496, d = 3.95e-3, u = 0.1;
  const double Nu = gunn_nusselt(voidage, 1000 * u * d / 1e-3, prandtl(1e-3, 4187, 0.5));
  const double exchange =
      volumetric_heat_exchange(heat_transfer_coefficient(Nu, 0.5, d), voidage, d);
  return {voidage, u, 1000.0 * 4187, 8400.0 * 385, exchange, 273, 373, source};
}

/// A gas: little heat in it compared with the solids', 5 %, so that the numerical solution stays
/// affordable.
FixedBed gas_bed(double source) { return {0.4, 0.5, 1e5, 4e5 / 0.3, 2e5, 300, 400, source}; }

/// Temperatures in the middles of the cells at one time, by a numerical solution that shares
/// nothing with the formulas: the gas moves by one cell a step, so the front stays sharp and on a
/// face, and exchanges heat by the trapezoidal rule, half a step before and half a step after.
/// Second order.
std::vector<BedTemperatures> march(const FixedBed& bed, double length, int cells, double end) {
  const double dz = length / cells, dt = dz * bed.voidage / bed.superficial_velocity;
  const double to_gas = bed.heat_exchange / (bed.voidage * bed.gas_heat_capacity);
  const double to_solids = bed.heat_exchange / ((1 - bed.voidage) * bed.solids_heat_capacity);
  const double heating = bed.source / bed.solids_heat_capacity;
  std::vector<BedTemperatures> T(cells, {bed.initial_temperature, bed.initial_temperature});
  const auto exchange = [&](double h) {
    const double difference_rate = (to_gas + to_solids) * h / 2;
    for (auto& [gas, particle] : T) {
      const double old = particle - gas;
      const double next = (old * (1 - difference_rate) + heating * h) / (1 + difference_rate);
      gas += to_gas * h * (old + next) / 2;
      particle += heating * h - to_solids * h * (old + next) / 2;
    }
  };
  const int steps = static_cast<int>(std::lround(end / dt));
  for (int n = 0; n < steps; ++n) {
    exchange(dt / 2);
    for (int i = cells - 1; i > 0; --i) T[i].gas = T[i - 1].gas;
    T[0].gas = bed.inlet_temperature;
    exchange(dt / 2);
  }
  return T;
}

struct Flow {
  const char* name;
  FixedBed bed;
  double length;
  double passages;  ///< end time in passages of the gas
};

const Flow flows[] = {
    {"liquid, step", thesis_bed(0), 0.5, 0.625},
    {"liquid, step, later", thesis_bed(0), 0.5, 2.5},
    {"liquid, source", thesis_bed(5e7), 0.5, 0.625},
    {"liquid, source, later", thesis_bed(5e7), 0.5, 2.5},
    {"gas, step", gas_bed(0), 0.5, 15},
    {"gas, source", gas_bed(1e7), 0.5, 15},
    {"gas, cooling source", gas_bed(-1e7), 0.5, 15},
};

TEST(FixedBed, AgreesWithANumericalSolutionThatConvergesToIt) {
  const auto worse = [](const BedTemperatures& a, const BedTemperatures& b) {
    return std::max(std::abs(a.gas - b.gas), std::abs(a.particle - b.particle));
  };
  for (const Flow& flow : flows) {
    const int cells = 400;
    const double end =
        flow.passages * flow.length * flow.bed.voidage / flow.bed.superficial_velocity;
    const auto coarse = march(flow.bed, flow.length, cells, end);
    const auto fine = march(flow.bed, flow.length, 3 * cells, end);  // has the coarse middles too
    double of_coarse = 0, of_fine = 0, of_limit = 0;
    for (int i = 0; i < cells; ++i) {
      const auto exact = fixed_bed_temperatures(flow.bed, (i + 0.5) * flow.length / cells, end);
      const BedTemperatures &a = coarse[i], &b = fine[3 * i + 1];
      const BedTemperatures limit{b.gas + (b.gas - a.gas) / 8,  // Richardson, second order
                                  b.particle + (b.particle - a.particle) / 8};
      of_coarse = std::max(of_coarse, worse(a, exact));
      of_fine = std::max(of_fine, worse(b, exact));
      of_limit = std::max(of_limit, worse(limit, exact));
    }
    RecordProperty(flow.name, testing::PrintToString(of_limit / 100));
    EXPECT_NEAR(of_coarse / of_fine, 9, 0.05) << flow.name;  // second order: 3^2
    EXPECT_LT(of_limit, 100 * 1e-8) << flow.name << ": of the step of 100 K";
  }
}

TEST(FixedBed, SolvesItsEquations) {
  // Residuals by differences of the formula itself, fourth order: the step of 1e-2 of a unit of
  // length and time leaves 1e-9 of truncation and 1e-13 / 1e-2 of rounding.
  for (const Flow& flow : flows) {
    const FixedBed& bed = flow.bed;
    const double C_g = bed.voidage * bed.gas_heat_capacity;
    const double C_s = (1 - bed.voidage) * bed.solids_heat_capacity;
    const double heat = bed.heat_exchange, source = (1 - bed.voidage) * bed.source;
    const double speed = bed.superficial_velocity / bed.voidage;
    const double scale = 100 * heat;  // K of the step times W/m3/K
    const double dz = 1e-2 * bed.gas_heat_capacity * bed.superficial_velocity / heat;
    const double dt = 1e-2 / (heat / C_g + heat / C_s);
    for (const double z : {0.05, 0.2, 0.4})
      for (const double t : {0.2, 0.6, 3.0, 12.0}) {
        if (std::abs(t - z / speed) < 3 * (dt + dz / speed)) continue;  // the front is no place
        const auto T = fixed_bed_temperatures(bed, z, t);
        const auto derivative = [&](double a, double b, double h) {
          const auto at = [&](int i) { return fixed_bed_temperatures(bed, z + i * a, t + i * b); };
          const auto m2 = at(-2), m1 = at(-1), p1 = at(1), p2 = at(2);
          return BedTemperatures{
              (m2.gas - 8 * m1.gas + 8 * p1.gas - p2.gas) / (12 * h),
              (m2.particle - 8 * m1.particle + 8 * p1.particle - p2.particle) / (12 * h)};
        };
        const auto in_time = derivative(0, dt, dt), along = derivative(dz, 0, dz);
        const double flux = heat * (T.particle - T.gas);
        EXPECT_NEAR((C_g * (in_time.gas + speed * along.gas) - flux) / scale, 0, 1e-8)
            << flow.name << " " << z << " " << t;
        EXPECT_NEAR((C_s * in_time.particle + flux - source) / scale, 0, 1e-8)
            << flow.name << " " << z << " " << t;
      }
  }
}

TEST(FixedBed, StartsAtItsInitialTemperatureAndHasTheInletsAtTheInlet) {
  const FixedBed bed = thesis_bed(5e7);
  EXPECT_EQ(fixed_bed_temperatures(bed, 0.3, 0).gas, 273);
  EXPECT_EQ(fixed_bed_temperatures(bed, 0.3, 0).particle, 273);
  for (const double t : {0.0, 1.0, 100.0})
    EXPECT_NEAR(fixed_bed_temperatures(bed, 0, t).gas, 373, 1e-10);  // rounding
}

TEST(FixedBed, HasParticlesThatDoNotNoticeTheFrontItselfAndGasThatJumps) {
  const FixedBed bed = thesis_bed(5e7);
  const double z = 0.2, front = z * bed.voidage / bed.superficial_velocity, dt = 1e-9;
  const auto before = fixed_bed_temperatures(bed, z, front - dt);
  const auto after = fixed_bed_temperatures(bed, z, front + dt);
  EXPECT_NEAR(after.particle, before.particle, 1e-5);  // dt times the largest rate
  const double xi = bed.heat_exchange * z / (bed.gas_heat_capacity * bed.superficial_velocity);
  // The jump decays along the front: started by inlet less initial temperature, nothing feeds it.
  EXPECT_NEAR((after.gas - before.gas) / (100 * std::exp(-xi)), 1, 1e-4);  // dt times the rate
}

TEST(FixedBed, EndsWhereTheGasCarriesAwayAllTheHeat) {
  const FixedBed bed = gas_bed(1e7);
  const double z = 0.5, rise = 0.6 * 1e7 * z / (1e5 * 0.5);
  const auto end = fixed_bed_temperatures(bed, z, 1e5);
  EXPECT_NEAR(end.gas, 400 + rise, 1e-9);                         // rounding
  EXPECT_NEAR(end.particle, 400 + rise + 0.6 * 1e7 / 2e5, 1e-9);  // (1 - eps) q / (h a_s)
  // the well-mixed bed's gas leaves at the same temperature
  const HeatedFraction all{1, 1e7};
  const double d = 1e-3, h = 2e5 * d / (6 * 0.6);
  const auto mixed = equilibrium_temperatures({400, 0.5, 1e5, 0.6 * z, d, h}, {&all, 1});
  EXPECT_NEAR(mixed.gas, end.gas, 1e-9);
  EXPECT_NEAR(mixed.particle[0], end.particle, 1e-9);
}

TEST(FixedBed, SuperposesStepAndSource) {
  FixedBed both = thesis_bed(5e7), step = thesis_bed(0), heated = both;
  heated.inlet_temperature = heated.initial_temperature;
  for (const double t : {0.3, 1.0, 4.0}) {
    const auto a = fixed_bed_temperatures(both, 0.2, t), b = fixed_bed_temperatures(step, 0.2, t),
               c = fixed_bed_temperatures(heated, 0.2, t);
    EXPECT_NEAR(a.gas, b.gas + c.gas - 273, 1e-10);                 // rounding
    EXPECT_NEAR(a.particle, b.particle + c.particle - 273, 1e-10);  // rounding
  }
}

TEST(FixedBed, SolvesItsEquationsInLongBedsAndWhateverTheRatioOfHeatCapacities) {
  // In units of its own length and time: dG/dxi = P - G, dP/dtau = G - P + Q with Q = 1 K. For r =
  // 1000 what the front finds has a layer of xi / 1000.
  for (const double r : {1e-3, 1.0, 1000.0}) {
    const FixedBed bed{0.5, 1, 2 * r, 2, 2 * r, 300, 300, 4 * r};
    const auto at = [&](double xi, double tau) {
      return fixed_bed_temperatures(bed, xi, xi / 2 + tau / (2 * r));
    };
    for (const double xi : {0.1, 1.0, 10.0, 200.0})
      for (const double tau : {0.1, 1.0, 8.0, 200.0}) {
        const double h = 2e-3;  // fourth order: truncation of 1e-11
        const double along = (at(xi - 2 * h, tau).gas - 8 * at(xi - h, tau).gas +
                              8 * at(xi + h, tau).gas - at(xi + 2 * h, tau).gas) /
                             (12 * h);
        const double in_time = (at(xi, tau - 2 * h).particle - 8 * at(xi, tau - h).particle +
                                8 * at(xi, tau + h).particle - at(xi, tau + 2 * h).particle) /
                               (12 * h);
        const auto T = at(xi, tau);
        const double rounding = 1e-8 * (1 + xi);  // of 300 K and of the time, over the step
        EXPECT_NEAR(along, T.particle - T.gas, rounding) << r << " " << xi << " " << tau;
        EXPECT_NEAR(in_time, T.gas - T.particle + 1, rounding) << r << " " << xi << " " << tau;
      }
  }
}

TEST(FixedBed, RefusesWhatIsNoBed) {
  const FixedBed good = gas_bed(0);
  for (const auto spoil :
       {+[](FixedBed& bed) { bed.voidage = 1; }, +[](FixedBed& bed) { bed.voidage = 0; },
        +[](FixedBed& bed) { bed.superficial_velocity = 0; },
        +[](FixedBed& bed) { bed.gas_heat_capacity = -1; },
        +[](FixedBed& bed) { bed.solids_heat_capacity = 0; },
        +[](FixedBed& bed) { bed.heat_exchange = std::nan(""); }}) {
    FixedBed bed = good;
    spoil(bed);
    EXPECT_THROW(fixed_bed_temperatures(bed, 0.1, 1), std::domain_error);
  }
  EXPECT_THROW(fixed_bed_temperatures(good, -0.1, 1), std::domain_error);
  EXPECT_THROW(fixed_bed_temperatures(good, 0.1, -1), std::domain_error);
}

}  // namespace
}  // namespace bedscope::physics
