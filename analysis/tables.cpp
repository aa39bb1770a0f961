// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/tables.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <string_view>

#include "analysis/bed_tables.hpp"
#include "analysis/csv.hpp"
#include "analysis/gas_tables.hpp"
#include "analysis/table_parts.hpp"

namespace bedscope::analysis {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

constexpr std::string_view profile_columns =
    "holdup [-],holdup_ci95 [-],velocity_z [m/s],velocity_z_ci95 [m/s],mass_flux_z [kg/m2/s],"
    "mass_flux_z_ci95 [kg/m2/s]";

template <class... Key>
void write_profile(CsvWriter& table, const Profile& p, const Key&... key) {
  for (std::size_t i = 0; i < p.coordinate.size(); ++i)
    table.row(key..., p.coordinate[i], p.holdup[i].value, p.holdup[i].ci95, p.velocity_z[i].value,
              p.velocity_z[i].ci95, p.mass_flux_z[i].value, p.mass_flux_z[i].ci95);
}

void write_axial(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path, fmt::format("run,type,z [m],{}", profile_columns));
  for (const RunResult& run : runs)
    for (const SpeciesResult& species : run.species)
      write_profile(table, species.axial, run.label, species.type);
  table.commit();
}

void write_lateral(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path, fmt::format("run,type,height [m],x [m],{}", profile_columns));
  for (const RunResult& run : runs)
    for (const SpeciesResult& species : run.species)
      for (std::size_t h = 0; h < species.lateral.size(); ++h)
        write_profile(table, species.lateral[h], run.label, species.type, run.heights[h]);
  table.commit();
}

void write_inventory(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path, "run,time [s],type,particles,solids_mass [kg],holdup [-],mean_height [m]");
  for (const RunResult& run : runs)
    for (const InventorySample& sample : run.inventory)
      table.row(run.label, shown_time(run, sample.time), sample.type, sample.particles,
                run.density_known ? sample.solids_mass : not_a_number, sample.holdup,
                sample.mean_height);
  table.commit();
}

void write_clusters(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path,
                  "run,time [s],cluster,track,x [m],z [m],area [m2],holdup [-],holdup_max [-],"
                  "velocity_x [m/s],velocity_z [m/s],track_velocity_x [m/s],track_velocity_z [m/s],"
                  "major [m],minor [m],angle [rad],parents");
  for (const RunResult& run : runs)
    for (const Cluster& c : run.clusters)
      table.row(run.label, shown_time(run, c.time), c.cluster, c.track, c.centre.x, c.centre.z,
                c.area, c.holdup, c.holdup_max, c.velocity_x, c.velocity_z, c.track_velocity_x,
                c.track_velocity_z, c.major, c.minor, c.angle,
                fmt::format("{}", fmt::join(c.parents, ";")));
  table.commit();
}

void write_occurrence(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path, "run,time [s],clusters,area_fraction [-]");
  for (const RunResult& run : runs)
    for (const OccurrenceSample& sample : run.occurrence)
      table.row(run.label, shown_time(run, sample.time), sample.clusters, sample.area_fraction);
  table.commit();
}

void write_series(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path, "run,series,unit,time [s],value");
  for (const RunResult& run : runs)
    for (const Signal& signal : run.series)
      for (std::size_t i = 0; i < signal.times.size(); ++i)
        table.row(run.label, signal.name, signal.unit, signal.times[i], signal.values[i]);
  table.commit();
}

void write_temperature(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path, "run,time [s],type,mean [K],std [K],min [K],max [K]");
  for (const RunResult& run : runs)
    for (const TemperatureSample& sample : run.temperature)
      table.row(run.label, shown_time(run, sample.time), sample.type, sample.mean, sample.std,
                sample.min, sample.max);
  table.commit();
}

void write_temperature_pdf(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path, "run,type,bin_centre [-],probability_density [-]");
  for (const RunResult& run : runs)
    for (const SpeciesResult& species : run.species) {
      const auto bins = static_cast<double>(species.temperature_pdf.size());
      for (std::size_t i = 0; i < species.temperature_pdf.size(); ++i)
        table.row(run.label, species.type, (static_cast<double>(i) + 0.5) / bins,
                  species.temperature_pdf[i]);
    }
  table.commit();
}

void write_axial_temperature(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path, "run,type,z [m],temperature [K],temperature_ci95 [K]");
  for (const RunResult& run : runs)
    for (const SpeciesResult& species : run.species)
      for (std::size_t i = 0; i < species.axial_temperature.size(); ++i)
        table.row(run.label, species.type, species.axial.coordinate[i],
                  species.axial_temperature[i].value, species.axial_temperature[i].ci95);
  table.commit();
}

}  // namespace

void write_tables(std::span<const RunResult> runs, const std::filesystem::path& folder) {
  write_axial(runs, folder / "axial_profile.csv");
  write_lateral(runs, folder / "lateral_profile.csv");
  write_inventory(runs, folder / "inventory.csv");
  write_clusters(runs, folder / "clusters.csv");
  write_occurrence(runs, folder / "cluster_occurrence.csv");
  write_bed_tables(runs, folder);
  write_gas_tables(runs, folder);

  const auto series = [](const RunResult& run) { return !run.series.empty(); };
  const auto temperature = [](const RunResult& run) { return !run.temperature.empty(); };
  const auto pdf = [](const RunResult& run) {
    return std::any_of(run.species.begin(), run.species.end(),
                       [](const SpeciesResult& s) { return !s.temperature_pdf.empty(); });
  };
  write_or_remove(runs, folder / "series.csv", series, write_series);
  write_or_remove(runs, folder / "temperature.csv", temperature, write_temperature);
  write_or_remove(runs, folder / "temperature_axial.csv", temperature, write_axial_temperature);
  write_or_remove(runs, folder / "temperature_pdf.csv", pdf, write_temperature_pdf);
}

}  // namespace bedscope::analysis
