// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/gas_tables.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "analysis/csv.hpp"
#include "analysis/table_parts.hpp"

namespace bedscope::analysis {
namespace {

constexpr std::string_view profile_columns =
    "voidage [-],velocity_z [m/s],temperature [K],pressure [Pa],slip_z [m/s],voidage_ci95 [-],"
    "velocity_z_ci95 [m/s],temperature_ci95 [K],pressure_ci95 [Pa],slip_z_ci95 [m/s]";

template <class... Key>
void write_profile(CsvWriter& table, const GasProfile& p, const Key&... key) {
  for (std::size_t i = 0; i < p.coordinate.size(); ++i)
    table.row(key..., p.coordinate[i], p.voidage[i].value, p.velocity_z[i].value,
              p.temperature[i].value, p.pressure[i].value, p.slip_z[i].value, p.voidage[i].ci95,
              p.velocity_z[i].ci95, p.temperature[i].ci95, p.pressure[i].ci95, p.slip_z[i].ci95);
}

void write_axial(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path, fmt::format("run,z [m],{}", profile_columns));
  for (const RunResult& run : runs) write_profile(table, run.gas.axial, run.label);
  table.commit();
}

void write_lateral(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path, fmt::format("run,height [m],x [m],{}", profile_columns));
  for (const RunResult& run : runs)
    for (std::size_t h = 0; h < run.gas.lateral.size(); ++h)
      write_profile(table, run.gas.lateral[h], run.label, run.heights[h]);
  table.commit();
}

void write_checks(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path,
                  "run,time [s],solids_volume_particles [m3],solids_volume_gas [m3],ratio [-],"
                  "mean_difference [-],rms_difference [-],largest_difference [-],cells");
  for (const RunResult& run : runs)
    for (const VoidageCheck& check : run.gas.checks)
      table.row(run.label, check.time, check.solids_volume, check.gas_side_volume, check.ratio(),
                check.mean_difference, check.rms_difference, check.largest_difference,
                static_cast<std::int64_t>(check.cells));
  table.commit();
}

void write_pressure(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path, "run,time [s],pressure_drop [Pa],bed_weight_over_area [Pa]");
  for (const RunResult& run : runs)
    for (const PressureSample& sample : run.gas.pressure)
      table.row(run.label, sample.time, sample.drop, sample.weight_by_area);
  table.commit();
}

}  // namespace

void write_gas_tables(std::span<const RunResult> runs, const std::filesystem::path& folder) {
  const auto gas = [](const RunResult& run) { return run.gas.present; };
  const auto pressure = [](const RunResult& run) { return run.gas.has_pressure; };
  write_or_remove(runs, folder / "gas_axial.csv", gas, write_axial);
  write_or_remove(runs, folder / "gas_lateral.csv", gas, write_lateral);
  write_or_remove(runs, folder / "voidage_check.csv", gas, write_checks);
  write_or_remove(runs, folder / "pressure_drop.csv", pressure, write_pressure);
}

}  // namespace bedscope::analysis
