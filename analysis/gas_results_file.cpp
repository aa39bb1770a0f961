// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/gas_results_file.hpp"

#include <algorithm>
#include <functional>
#include <string>

namespace bedscope::analysis {
namespace {

template <class Row, class Member>
std::vector<double> column(const std::vector<Row>& rows, Member member) {
  std::vector<double> values(rows.size());
  std::transform(rows.begin(), rows.end(), values.begin(),
                 [&](const Row& row) { return static_cast<double>(std::invoke(member, row)); });
  return values;
}

void write_profile(Hdf5Group group, const GasProfile& profile, const char* coordinate) {
  group.write(coordinate, profile.coordinate, "m");
  const auto write = [&](const std::string& name, const std::vector<Estimate>& curve,
                         const char* unit) {
    group.write(name, column(curve, &Estimate::value), unit);
    group.write(name + "_ci95", column(curve, &Estimate::ci95), unit);
  };
  write("voidage", profile.voidage, "-");
  write("velocity_z", profile.velocity_z, "m/s");
  write("temperature", profile.temperature, "K");
  write("pressure", profile.pressure, "Pa");
  write("slip_z", profile.slip_z, "m/s");
}

void write_checks(Hdf5Group group, const std::vector<VoidageCheck>& rows) {
  group.write("time", column(rows, &VoidageCheck::time), "s");
  group.write("solids_volume_particles", column(rows, &VoidageCheck::solids_volume), "m3");
  group.write("solids_volume_gas", column(rows, &VoidageCheck::gas_side_volume), "m3");
  group.write("ratio", column(rows, &VoidageCheck::ratio), "-");
  group.write("mean_difference", column(rows, &VoidageCheck::mean_difference), "-");
  group.write("rms_difference", column(rows, &VoidageCheck::rms_difference), "-");
  group.write("largest_difference", column(rows, &VoidageCheck::largest_difference), "-");
  group.write("cells", column(rows, &VoidageCheck::cells), "");
}

void write_pressure(Hdf5Group group, const std::vector<PressureSample>& rows) {
  group.write("time", column(rows, &PressureSample::time), "s");
  group.write("pressure_drop", column(rows, &PressureSample::drop), "Pa");
  group.write("bed_weight_over_area", column(rows, &PressureSample::weight_by_area), "Pa");
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
  const auto estimate = [&](const char* name, const Estimate& value, const char* unit) {
    group.write(name, std::array{value.value, value.ci95}, unit);
  };
  estimate("mean_voidage_ratio", gas.voidage_ratio, "-");
  estimate("mean_pressure_drop", gas.pressure_drop, "Pa");
  group.write("mean_bed_weight_over_area", std::array{gas.bed_weight_by_area}, "Pa");
}

}  // namespace bedscope::analysis
