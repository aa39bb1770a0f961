// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/coupled/closures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/drag.hpp"
#include "physics/heat_transfer.hpp"

namespace bedscope::coupled {
namespace {

// A particle partly outside of the mesh may see rounding above 1.
double within(double voidage) { return std::min(voidage, 1.0); }

double reynolds(const Settings& settings, double diameter, double voidage, const double* slip) {
  return voidage * settings.gas_density * std::hypot(slip[0], slip[1], slip[2]) * diameter /
         settings.gas_viscosity;
}

}  // namespace

void drag_coefficients(const Settings& settings, const std::vector<double>& radius,
                       const std::vector<double>& voidage, const std::vector<double>& slip,
                       std::vector<double>& k) {
  k.assign(radius.size(), 0);
  if (settings.drag == "none") return;
  const auto law = physics::drag_law(settings.drag).law;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const double eps = within(voidage[i]);
    if (!(eps > 0)) continue;  // outside of the mesh
    const double d = 2 * radius[i];
    k[i] = 3 * std::numbers::pi * settings.gas_viscosity * d * eps *
           law(eps, reynolds(settings, d, eps, &slip[3 * i]));
  }
}

void heat_coefficients(const Settings& settings, const std::vector<double>& radius,
                       const std::vector<double>& voidage, const std::vector<double>& slip,
                       std::vector<double>& ha) {
  ha.assign(radius.size(), 0);
  const Energy& energy = *settings.energy;
  const double prandtl =
      physics::prandtl(settings.gas_viscosity, energy.heat_capacity, energy.conductivity);
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const double eps = within(voidage[i]);
    if (!(eps > 0)) continue;
    const double d = 2 * radius[i];
    const double h =
        energy.exchange
            ? *energy.exchange
            : physics::heat_transfer_coefficient(
                  physics::gunn_nusselt(eps, reynolds(settings, d, eps, &slip[3 * i]), prandtl),
                  energy.conductivity, d);
    ha[i] = h * std::numbers::pi * d * d;
  }
}

}  // namespace bedscope::coupled
