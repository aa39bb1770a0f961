// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/gas_results_file.hpp"

#include <string>

#include "analysis/hdf5_rows.hpp"

namespace bedscope::analysis {
namespace {

void write_profile(Hdf5Group group, const GasProfile& profile, const char* coordinate) {
  group.write(coordinate, profile.coordinate, "m");
  write_curve(group, "voidage", profile.voidage, "-");
  write_curve(group, "velocity_z", profile.velocity_z, "m/s");
  write_curve(group, "temperature", profile.temperature, "K");
  write_curve(group, "pressure", profile.pressure, "Pa");
  write_curve(group, "slip_z", profile.slip_z, "m/s");
}

void write_checks(Hdf5Group group, const std::vector<VoidageCheck>& rows) {
  group.write("time", numbers(rows, &VoidageCheck::time), "s");
  group.write("solids_volume_particles", numbers(rows, &VoidageCheck::solids_volume), "m3");
  group.write("solids_volume_gas", numbers(rows, &VoidageCheck::gas_side_volume), "m3");
  group.write("ratio", numbers(rows, &VoidageCheck::ratio), "-");
  group.write("mean_difference", numbers(rows, &VoidageCheck::mean_difference), "-");
  group.write("rms_difference", numbers(rows, &VoidageCheck::rms_difference), "-");
  group.write("largest_difference", numbers(rows, &VoidageCheck::largest_difference), "-");
  group.write("cells", numbers(rows, &VoidageCheck::cells), "");
}

void write_pressure(Hdf5Group group, const std::vector<PressureSample>& rows) {
  group.write("time", numbers(rows, &PressureSample::time), "s");
  group.write("pressure_drop", numbers(rows, &PressureSample::drop), "Pa");
  group.write("bed_weight_over_area", numbers(rows, &PressureSample::weight_by_area), "Pa");
}

}  // namespace

void write_gas_group(Hdf5Group group, const RunResult& run, const Shape& shape) {
  const auto& gas = run.gas;
  group.attribute("times", static_cast<std::int64_t>(gas.times));
  group.attribute("from", gas.from);
  group.attribute("to", gas.to);
  write_profile(group.group("axial"), gas.axial, "z");
  Hdf5Group profiles = group.group("lateral");
  for (std::size_t h = 0; h < gas.lateral.size(); ++h) {
    Hdf5Group profile = profiles.group(std::to_string(h + 1));
    profile.attribute("height", run.heights[h]);
    write_profile(std::move(profile), gas.lateral[h], "x");
  }
  Hdf5Group fields = group.group("fields");
  for (const GasField& field : all_gas_fields)
    if (!(gas.fields.*field.values).empty())
      fields.write(field.name, gas.fields.*field.values, field.unit, shape);
  write_checks(group.group("voidage_check"), gas.checks);
  if (gas.has_pressure) write_pressure(group.group("pressure_drop"), gas.pressure);
  write_estimate(group, "mean_voidage_ratio", gas.voidage_ratio, "-");
  write_estimate(group, "mean_pressure_drop", gas.pressure_drop, "Pa");
  group.write("mean_bed_weight_over_area", std::array{gas.bed_weight_by_area}, "Pa");
}

}  // namespace bedscope::analysis
