// SPDX-License-Identifier: BSD-3-Clause
#include "physics/drag.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "physics/particle_motion.hpp"
#include "physics/require.hpp"

namespace bedscope::physics {
namespace {

void require_flow(double voidage, double reynolds) {
  require_voidage(voidage);
  require_not_negative(reynolds, "Reynolds number");
}

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr std::array laws{
    NamedDragLaw{"beetstra", beetstra, 0.4, 0.9, 1000},
    NamedDragLaw{"di_felice", di_felice, 0.4, 1, infinity},
    NamedDragLaw{"ergun", ergun, 0.36, 0.8, infinity},
    NamedDragLaw{"gidaspow", gidaspow, 0.36, 1, infinity},
    NamedDragLaw{"wen_yu", wen_yu, 0.8, 1, infinity},
};

}  // namespace

double ergun(double voidage, double reynolds) {
  require_flow(voidage, reynolds);
  return (150 * (1 - voidage) + 1.75 * reynolds) / (18 * voidage * voidage);
}

double wen_yu(double voidage, double reynolds) {
  require_flow(voidage, reynolds);
  const double lone = reynolds < 1000 ? 1 + 0.15 * std::pow(reynolds, 0.687) : 0.44 * reynolds / 24;
  return lone * std::pow(voidage, -3.65);
}

double gidaspow(double voidage, double reynolds) {
  return voidage > 0.8 ? wen_yu(voidage, reynolds) : ergun(voidage, reynolds);
}

double di_felice(double voidage, double reynolds) {
  require_flow(voidage, reynolds);
  const double root = 0.63 * std::sqrt(reynolds) + 4.8;  // sqrt(Cd Re): finite at Re = 0
  const double distance = 1.5 - std::log10(reynolds);
  const double chi = 3.7 - 0.65 * std::exp(-distance * distance / 2);
  return root * root / 24 * std::pow(voidage, -chi);
}

double beetstra(double voidage, double reynolds) {
  require_flow(voidage, reynolds);
  const double holdup = 1 - voidage;
  const double square = voidage * voidage;
  const double creeping = 10 * holdup / square + square * (1 + 1.5 * std::sqrt(holdup));
  if (reynolds == 0) return creeping;  // the inertial part is 0 x inf / inf there
  const double above = 1 / voidage + 3 * voidage * holdup + 8.4 * std::pow(reynolds, -0.343);
  const double below = 1 + std::pow(10, 3 * holdup) * std::pow(reynolds, -(1 + 4 * holdup) / 2);
  return creeping + 0.413 * reynolds / (24 * square) * above / below;
}

std::span<const NamedDragLaw> drag_laws() { return laws; }

const NamedDragLaw& drag_law(std::string_view name) {
  std::string known;
  for (const NamedDragLaw& entry : laws) {
    if (entry.name == name) return entry;
    known += known.empty() ? "" : ", ";
    known += entry.name;
  }
  throw std::domain_error(fmt::format("expected a drag law ({}), found '{}'", known, name));
}

double momentum_exchange(double dimensionless_drag, double voidage, const Gas& gas,
                         double diameter) {
  require_voidage(voidage);
  require_positive(gas.viscosity, "viscosity");
  require_positive(diameter, "diameter");
  return 18 * gas.viscosity * voidage * (1 - voidage) * dimensionless_drag / (diameter * diameter);
}

double drag_slope(const DragLaw& law, double voidage, double reynolds) {
  require_positive(reynolds, "Reynolds number");
  constexpr double step = 1e-3;
  return (std::log(law(voidage, reynolds * (1 + step))) -
          std::log(law(voidage, reynolds * (1 - step)))) /
         (std::log1p(step) - std::log1p(-step));
}

double carrying_velocity(const Sphere& sphere, const Gas& gas, double gravity, double voidage,
                         const DragLaw& law) {
  require_voidage(voidage);
  const double load = archimedes(sphere, gas, gravity) / 18 * voidage;
  require_positive(load, "weight less buoyancy");
  const auto excess = [&](double reynolds) { return reynolds * law(voidage, reynolds) - load; };

  double low = load, high = load;  // Re of a lone sphere in creeping flow, to start from
  for (int i = 0; excess(low) > 0; ++i, low /= 4)
    if (i == 500) throw std::domain_error("the drag law exceeds the weight at every velocity");
  for (int i = 0; !(excess(high) >= 0); ++i, high *= 4)
    if (i == 500) throw std::domain_error("the drag law does not reach the weight at any velocity");
  // Bisection, not a faster method: laws have steps (Gidaspow in voidage, Wen-Yu at Re = 1000).
  while (high / low - 1 > 4 * std::numeric_limits<double>::epsilon()) {
    const double middle = std::sqrt(low * high);
    if (middle <= low || middle >= high) break;
    (excess(middle) < 0 ? low : high) = middle;
  }
  return high * gas.viscosity / (gas.density * sphere.diameter);
}

}  // namespace bedscope::physics
