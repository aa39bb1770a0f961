// SPDX-License-Identifier: BSD-3-Clause
#include "physics/well_mixed_bed.hpp"

#include <cmath>

#include "physics/require.hpp"

namespace bedscope::physics {
namespace {

void require_gas_flow(const WellMixedBed& bed) {
  require_positive(bed.superficial_velocity, "superficial velocity");
  require_positive(bed.gas_heat_capacity, "heat capacity of the gas");
  require_positive(bed.solids_height, "height of solids");
}

}  // namespace

EquilibriumTemperatures equilibrium_temperatures(const WellMixedBed& bed,
                                                 std::span<const HeatedFraction> fractions) {
  require_gas_flow(bed);
  require_positive(bed.diameter, "diameter");
  require_positive(bed.heat_transfer_coefficient, "heat transfer coefficient");
  double total = 0, source = 0;
  for (const HeatedFraction& part : fractions) {
    require_between(part.fraction, 0, 1, "fraction");
    total += part.fraction;
    source += part.fraction * part.source;
  }
  if (!(std::abs(total - 1) < 1e-9))
    throw std::domain_error(fmt::format("expected fractions that add up to 1, found {}", total));

  EquilibriumTemperatures result{
      bed.inlet_temperature +
          source * bed.solids_height / (bed.gas_heat_capacity * bed.superficial_velocity),
      {}};
  for (const HeatedFraction& part : fractions)
    result.particle.push_back(result.gas +
                              part.source * bed.diameter / (6 * bed.heat_transfer_coefficient));
  return result;
}

double thermal_time(const WellMixedBed& bed, double solids_heat_capacity) {
  require_gas_flow(bed);
  require_positive(solids_heat_capacity, "heat capacity of the solids");
  return bed.solids_height * solids_heat_capacity /
         (bed.gas_heat_capacity * bed.superficial_velocity);
}

double relaxing_temperature(double start, double equilibrium, double thermal_time, double time) {
  require_positive(thermal_time, "thermal time");
  return equilibrium + (start - equilibrium) * std::exp(-time / thermal_time);
}

double adiabatic_heating_rate(double source, double solids_heat_capacity) {
  require_positive(solids_heat_capacity, "heat capacity of the solids");
  return source / solids_heat_capacity;
}

}  // namespace bedscope::physics
