// SPDX-License-Identifier: BSD-3-Clause
// The gas in results.h5.
#pragma once

#include <array>
#include <vector>

#include "analysis/hdf5_file.hpp"
#include "analysis/result.hpp"

namespace bedscope::analysis {

struct GasField {
  const char* name;
  std::vector<double> GasFields::*values;
  const char* unit;
};
inline constexpr std::array<GasField, 5> all_gas_fields = {
    {{"voidage", &GasFields::voidage, "-"},
     {"gas_velocity_x", &GasFields::velocity_x, "m/s"},
     {"gas_velocity_z", &GasFields::velocity_z, "m/s"},
     {"gas_temperature", &GasFields::temperature, "K"},
     {"gas_pressure", &GasFields::pressure, "Pa"}}};

/// Writes the group gas of a run that has gas. `shape`: of a field.
void write_gas_group(Hdf5Group group, const RunResult& run, const Shape& shape);

}  // namespace bedscope::analysis
