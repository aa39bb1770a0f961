// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "analysis/bed_tables.hpp"
#include "analysis/csv.hpp"
#include "analysis/gas_tables.hpp"
#include "analysis/output_file.hpp"

namespace bedscope::analysis {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double shown_time(const RunResult& run, double time) {
  return run.time_known ? time : not_a_number;
}

constexpr std::string_view profile_columns =
    "holdup [-],holdup_ci95 [-],velocity_z [m/s],velocity_z_ci95 [m/s],mass_flux_z [kg/m2/s],"
    "mass_flux_z_ci95 [kg/m2/s]";

void write_axial(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path, fmt::format("run,type,z [m],{}", profile_columns));
  for (const RunResult& run : runs)
    for (const SpeciesResult& species : run.species)
      for (std::size_t i = 0; i < species.axial.coordinate.size(); ++i) {
        const Profile& p = species.axial;
        table.row(run.label, species.type, p.coordinate[i], p.holdup[i].value, p.holdup[i].ci95,
                  p.velocity_z[i].value, p.velocity_z[i].ci95, p.mass_flux_z[i].value,
                  p.mass_flux_z[i].ci95);
      }
  table.commit();
}

void write_lateral(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path, fmt::format("run,type,height [m],x [m],{}", profile_columns));
  for (const RunResult& run : runs)
    for (const SpeciesResult& species : run.species)
      for (std::size_t h = 0; h < species.lateral.size(); ++h)
        for (std::size_t i = 0; i < species.lateral[h].coordinate.size(); ++i) {
          const Profile& p = species.lateral[h];
          table.row(run.label, species.type, run.heights[h], p.coordinate[i], p.holdup[i].value,
                    p.holdup[i].ci95, p.velocity_z[i].value, p.velocity_z[i].ci95,
                    p.mass_flux_z[i].value, p.mass_flux_z[i].ci95);
        }
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
  std::string parents;
  for (const RunResult& run : runs)
    for (const Cluster& c : run.clusters) {
      parents.clear();
      for (const int track : c.parents)
        fmt::format_to(std::back_inserter(parents), "{}{}", parents.empty() ? "" : ";", track);
      table.row(run.label, shown_time(run, c.time), c.cluster, c.track, c.centre.x, c.centre.z,
                c.area, c.holdup, c.holdup_max, c.velocity_x, c.velocity_z, c.track_velocity_x,
                c.track_velocity_z, c.major, c.minor, c.angle, parents);
    }
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
  if (std::all_of(runs.begin(), runs.end(), [](const auto& run) { return run.series.empty(); }))
    return remove_file(path);
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
  write_series(runs, folder / "series.csv");

  const bool temperature = std::any_of(
      runs.begin(), runs.end(), [](const RunResult& run) { return !run.temperature.empty(); });
  const bool pdf = std::any_of(runs.begin(), runs.end(), [](const RunResult& run) {
    return std::any_of(run.species.begin(), run.species.end(),
                       [](const SpeciesResult& s) { return !s.temperature_pdf.empty(); });
  });
  if (temperature) {
    write_temperature(runs, folder / "temperature.csv");
    write_axial_temperature(runs, folder / "temperature_axial.csv");
  } else {
    remove_file(folder / "temperature.csv");
    remove_file(folder / "temperature_axial.csv");
  }
  if (pdf) {
    write_temperature_pdf(runs, folder / "temperature_pdf.csv");
  } else {
    remove_file(folder / "temperature_pdf.csv");
  }
}

}  // namespace bedscope::analysis
