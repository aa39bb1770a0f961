// SPDX-License-Identifier: BSD-3-Clause
#include "physics/heat_transfer.hpp"

#include <cmath>

#include "physics/require.hpp"

namespace bedscope::physics {

double prandtl(double viscosity, double gas_heat_capacity, double gas_conductivity) {
  require_positive(viscosity, "viscosity");
  require_positive(gas_heat_capacity, "heat capacity");
  require_positive(gas_conductivity, "conductivity");
  return viscosity * gas_heat_capacity / gas_conductivity;
}

double gunn_nusselt(double voidage, double reynolds, double prandtl) {
  require_voidage(voidage);
  require_not_negative(reynolds, "Reynolds number");
  require_positive(prandtl, "Prandtl number");
  const double root = std::cbrt(prandtl);
  const double square = voidage * voidage;
  return (7 - 10 * voidage + 5 * square) * (1 + 0.7 * std::pow(reynolds, 0.2) * root) +
         (1.33 - 2.4 * voidage + 1.2 * square) * std::pow(reynolds, 0.7) * root;
}

double heat_transfer_coefficient(double nusselt, double gas_conductivity, double diameter) {
  require_positive(nusselt, "Nusselt number");
  require_positive(gas_conductivity, "conductivity");
  require_positive(diameter, "diameter");
  return nusselt * gas_conductivity / diameter;
}

double effective_gas_conductivity(double gas_conductivity, double voidage) {
  require_positive(gas_conductivity, "conductivity");
  require_voidage(voidage);
  return gas_conductivity * (1 - std::sqrt(1 - voidage)) / voidage;
}

double specific_surface(double voidage, double diameter) {
  require_voidage(voidage);
  require_positive(diameter, "diameter");
  return 6 * (1 - voidage) / diameter;
}

double volumetric_heat_exchange(double heat_transfer_coefficient, double voidage, double diameter) {
  require_positive(heat_transfer_coefficient, "heat transfer coefficient");
  return heat_transfer_coefficient * specific_surface(voidage, diameter);
}

}  // namespace bedscope::physics
