// SPDX-License-Identifier: BSD-3-Clause
// What a study says of the gas of a run.
#pragma once

#include <optional>
#include <string>

#include "readers/gas_series.hpp"

namespace bedscope::analysis {

/// Names of fields on disk; empty: found by themselves, or none. One of voidage and solids is used.
struct GasFieldNames {
  std::string voidage, solids, velocity, pressure, temperature;
};

struct GasSettings {
  std::string path;  ///< an OpenFOAM case; empty: no gas
  readers::GasOptions options;
  GasFieldNames fields;
  std::optional<double> density;  ///< [kg/m3], for pressures on disk as p/rho
  double gravity = 9.81;          ///< [m/s2]
};

}  // namespace bedscope::analysis
