// SPDX-License-Identifier: BSD-3-Clause
#include "physics/packing.hpp"

#include <cmath>

#include "physics/phases.hpp"
#include "physics/require.hpp"

namespace bedscope::physics {

double holdup(double number, double diameter, double volume) {
  require_not_negative(number, "number of particles");
  require_positive(diameter, "diameter");
  require_positive(volume, "volume");
  return number * sphere_volume(diameter) / volume;
}

double number_scatter(double holdup, double number) {
  require_between(holdup, 0, densest_packing, "holdup");
  require_positive(number, "number of particles");
  const double phi = holdup, free = 1 - phi;
  const double structure =
      free * free * free * free / (1 + 4 * phi + phi * phi * (4 - 4 * phi + phi * phi));
  return std::sqrt(structure / number);
}

double settled_bed_height(double number, double diameter, double area, double settled_holdup) {
  require_positive(settled_holdup, "holdup");
  require_between(settled_holdup, 0, densest_packing, "holdup");
  return holdup(number, diameter, area) / settled_holdup;
}

}  // namespace bedscope::physics
