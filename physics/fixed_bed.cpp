// SPDX-License-Identifier: BSD-3-Clause
#include "physics/fixed_bed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "physics/require.hpp"

namespace bedscope::physics {
namespace {

/// e^-x I_n(x) for n = 0 and 1. Not std::cyl_bessel_i: it overflows at x = 713 and is not in every
/// standard library. Series of positive terms below 30, Hankel's expansion above: its smallest term
/// is of the order of e^-2x. Abramowitz and Stegun (1964), 9.6.10 and 9.7.1.
double scaled_bessel(int n, double x) {
  double term = 1, sum = 1;
  if (x < 30) {
    if (n == 1) term = sum = x / 2;
    for (int k = 1; term > 1e-18 * sum; ++k) {
      term *= x * x / (4.0 * k * (k + n));
      sum += term;
    }
    return sum * std::exp(-x);
  }
  for (int k = 1; std::abs(term) > 1e-18 && k < 40; ++k) {
    const double odd = 2 * k - 1;
    term *= (odd * odd - 4.0 * n * n) / (8 * k * x);
    sum += term;
  }
  return sum / std::sqrt(2 * std::numbers::pi * x);
}

/// Gauss and Legendre, eight points.
template <class F>
double integrate_panel(const F& f, double from, double to) {
  constexpr std::array nodes{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                             0.9602898564975363};
  constexpr std::array weights{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                               0.1012285362903763};
  const double centre = (from + to) / 2, half = (to - from) / 2;
  double sum = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    sum += weights[i] * (f(centre - half * nodes[i]) + f(centre + half * nodes[i]));
  return half * sum;
}

/// integral_0^xi w(xi - s) K_n(s, tau) ds with K_0 = e^(-tau-s) I0(2 sqrt(tau s)) and
/// K_1 = e^(-tau-s) sqrt(tau/s) I1(2 sqrt(tau s)).
///
/// In y = sqrt(s) both kernels are a Gaussian of unit width at sqrt(tau) times a slow function, so
/// panels of half that width do, within 7 widths (e^-49). `rate` is how fast w decays from its
/// argument 0, which is at the upper end: panels there are as narrow as it needs and then double.
template <class F>
double kernel_integral(int n, const F& w, double rate, double xi, double tau) {
  const double root = std::sqrt(tau), end = std::sqrt(xi);
  const auto integrand = [&](double y) {
    const double slow = n == 0 ? y : root;
    return 2 * slow * scaled_bessel(n, 2 * root * y) * std::exp(-(y - root) * (y - root)) *
           w((end - y) * (end + y));
  };
  const double low = std::max(0.0, root - 7), high = std::min(end, root + 7);
  double width = rate * end > 1 && high == end ? std::min(0.5, 1 / (rate * end)) : 0.5;
  double sum = 0, to = high;
  while (to > low) {
    const double from = std::max(low, to - width);
    sum += integrate_panel(integrand, from, to);
    to = from;
    width = std::min(2 * width, 0.5);
  }
  return sum;
}

/// Particle temperature and its excess over the gas before the front, in units of Q.
struct Uniform {
  double particle;
  double excess;
};

Uniform heated_uniformly(double x, double r) {
  const double excess = r / (1 + r) * -std::expm1(-(1 + r) * x);
  return {r / (1 + r) * (x + excess), excess};
}

/// What a source alone does behind the front, in units of Q.
StepResponse heated_behind_front(double xi, double tau, double r) {
  const auto w = [r](double x) { return heated_uniformly(x, r).particle - (x + 1); };
  return {xi + kernel_integral(0, w, 1 + r, xi, tau),
          xi + 1 + kernel_integral(1, w, 1 + r, xi, tau) + std::exp(-tau) * w(xi)};
}

void require_bed(const FixedBed& bed) {
  require_between(bed.voidage, 0, 1, "voidage");
  require_positive(bed.voidage * (1 - bed.voidage), "voidage and holdup");
  require_positive(bed.superficial_velocity, "superficial velocity");
  require_positive(bed.gas_heat_capacity, "heat capacity of the gas");
  require_positive(bed.solids_heat_capacity, "heat capacity of the solids");
  require_positive(bed.heat_exchange, "heat exchange");
}

}  // namespace

StepResponse anzelius(double xi, double tau) {
  require_not_negative(xi, "length");
  if (!(tau >= 0)) return {std::isnan(tau) ? tau : 0, std::isnan(tau) ? tau : 0};
  const auto one = [](double) { return 1.0; };
  return {1 - kernel_integral(0, one, 0, xi, tau), kernel_integral(0, one, 0, tau, xi)};
}

BedTemperatures fixed_bed_temperatures(const FixedBed& bed, double height, double time) {
  require_bed(bed);
  require_not_negative(height, "height");
  require_not_negative(time, "time");
  const double gas = bed.voidage * bed.gas_heat_capacity;
  const double solids = (1 - bed.voidage) * bed.solids_heat_capacity;
  const double source = (1 - bed.voidage) * bed.source / bed.heat_exchange;
  const double since_front = time - bed.voidage * height / bed.superficial_velocity;
  if (since_front < 0) {
    const auto [particle, excess] = heated_uniformly(bed.heat_exchange * time / gas, gas / solids);
    return {bed.initial_temperature + source * (particle - excess),
            bed.initial_temperature + source * particle};
  }
  const double xi = bed.heat_exchange * height / (bed.gas_heat_capacity * bed.superficial_velocity);
  const double tau = bed.heat_exchange * since_front / solids;
  const auto step = anzelius(xi, tau);
  const auto heated = source == 0 ? StepResponse{0, 0} : heated_behind_front(xi, tau, gas / solids);
  const double jump = bed.inlet_temperature - bed.initial_temperature;
  return {bed.initial_temperature + jump * step.gas + source * heated.gas,
          bed.initial_temperature + jump * step.particle + source * heated.particle};
}

}  // namespace bedscope::physics
