// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/read_bed_tables.hpp"
#include "analysis/table_rows.hpp"
#include "analysis/tables.hpp"
#include "readers/error.hpp"

namespace bedscope::analysis {
namespace {

namespace fs = std::filesystem;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double even = 1e-4;  // of a cell: coordinates printed with six digits pass on 600 cells

// Which rows to take: those of `label`, or all where there is one run only.
RunName chosen_run(const std::vector<fs::path>& tables, const fs::path& folder,
                   const std::string& label) {
  std::set<std::string, std::less<>> names;
  for (const fs::path& path : tables) {
    CsvReader rows(path);
    if (const auto run = rows.column("run"))
      while (rows.next())
        if (!names.contains(rows.text(*run))) names.emplace(rows.text(*run));
  }
  if (names.size() < 2) return std::nullopt;
  if (!names.contains(label))
    throw InputError("{}: expected a run '{}' in the tables, found '{}'", folder.string(), label,
                     fmt::join(names, "', '"));
  return label;
}

SpeciesResult& species_of(RunResult& run, const std::string& type) {
  const auto found = std::find(run.types.begin(), run.types.end(), type);
  const auto at = found - run.types.begin();
  if (found == run.types.end()) {
    run.types.push_back(type);
    run.species.emplace_back().type = type;
  }
  return run.species[static_cast<std::size_t>(at)];
}

struct ProfileRow {
  std::string type;
  double height = 0, coordinate = 0;
  Estimate holdup, velocity_z, mass_flux_z;
  std::size_t line = 0;
};

// The rows of a profile table sorted by type, height and coordinate, none twice.
std::vector<ProfileRow> profile_rows(RunRows& table, std::string_view coordinate, bool lateral) {
  const std::size_t at = table.needed(coordinate);
  const std::size_t height = lateral ? table.needed("height [m]") : at;
  const auto holdup = table.pair("holdup", "-"), velocity = table.pair("velocity_z", "m/s"),
             flux = table.pair("mass_flux_z", "kg/m2/s");
  std::vector<ProfileRow> rows;
  while (table.next())
    rows.push_back({table.type(), lateral ? table.finite(height, "height") : 0,
                    table.finite(at, "coordinate"), table.estimate(holdup),
                    table.estimate(velocity), table.estimate(flux), table.line()});
  return rows;
}

void append(Profile& profile, const ProfileRow& row) {
  profile.coordinate.push_back(row.coordinate);
  profile.holdup.push_back(row.holdup);
  profile.velocity_z.push_back(row.velocity_z);
  profile.mass_flux_z.push_back(row.mass_flux_z);
}

// Each row into the profile that `profile_of` gives for it, by ascending coordinate.
template <class ProfileOf>
void fill_profiles(const fs::path& path, std::vector<ProfileRow> rows, ProfileOf profile_of) {
  std::stable_sort(rows.begin(), rows.end(), [](const ProfileRow& a, const ProfileRow& b) {
    return a.coordinate < b.coordinate;
  });
  for (const ProfileRow& row : rows) {
    Profile& profile = profile_of(row);
    if (!profile.coordinate.empty() && profile.coordinate.back() == row.coordinate)
      throw FormatError("{}: line {}: expected one row for each place, found a second at {} m",
                        path.string(), row.line, row.coordinate);
    append(profile, row);
  }
}

void read_axial(const fs::path& path, const RunName& run_name, RunResult& run) {
  RunRows table(path, run_name);
  auto rows = profile_rows(table, "z [m]", false);
  for (const ProfileRow& row : rows) species_of(run, row.type);  // types in the table's order
  fill_profiles(path, std::move(rows),
                [&](const ProfileRow& row) -> Profile& { return species_of(run, row.type).axial; });
}

void read_lateral(const fs::path& path, const RunName& run_name, RunResult& run) {
  RunRows table(path, run_name);
  auto rows = profile_rows(table, "x [m]", true);
  for (const ProfileRow& row : rows) {
    species_of(run, row.type);
    if (std::find(run.heights.begin(), run.heights.end(), row.height) == run.heights.end())
      run.heights.push_back(row.height);
  }
  for (SpeciesResult& species : run.species) species.lateral.resize(run.heights.size());
  fill_profiles(path, std::move(rows), [&](const ProfileRow& row) -> Profile& {
    const auto height = std::find(run.heights.begin(), run.heights.end(), row.height);
    return species_of(run, row.type)
        .lateral[static_cast<std::size_t>(height - run.heights.begin())];
  });
}

void read_inventory(const fs::path& path, const RunName& run_name, RunResult& run) {
  RunRows table(path, run_name);
  const std::size_t time = table.needed("time [s]"), particles = table.needed("particles");
  const auto mass = table.column("solids_mass [kg]"), holdup = table.column("holdup [-]"),
             height = table.column("mean_height [m]");
  while (table.next()) {
    species_of(run, table.type());
    run.inventory.push_back({table.number(time), table.type(), table.whole(particles, 0),
                             table.number(mass), table.number(holdup), table.number(height)});
  }
}

void read_occurrence(const fs::path& path, const RunName& run_name, RunResult& run) {
  RunRows table(path, run_name);
  const std::size_t time = table.needed("time [s]"), clusters = table.needed("clusters");
  const auto area = table.column("area_fraction [-]");
  while (table.next())
    run.occurrence.push_back({table.number(time), table.count(clusters, 0), table.number(area)});
}

std::vector<int> parents_of(const RunRows& table, std::size_t at) {
  std::vector<int> parents;
  const std::string_view text = table.text(at);
  const char* const end = text.data() + text.size();
  for (const char* next = text.data(); next != end;) {
    int track = 0;
    const auto [after, error] = std::from_chars(next, end, track);
    const bool more = after != end && *after == ';';
    if (error != std::errc() || (after != end && !more))
      table.fail("track numbers joined by ';' for 'parents'", fmt::format("'{}'", text));
    parents.push_back(track);
    next = more ? after + 1 : after;
  }
  return parents;
}

// The snapshot that each row of clusters.csv belongs to, see read_tables.
class SnapshotOf {
 public:
  explicit SnapshotOf(const std::vector<OccurrenceSample>& occurrence) : occurrence_(occurrence) {}

  std::size_t operator()(const RunRows& table, double time, int cluster) {
    const bool same = std::isnan(time) ? std::isnan(time_) && cluster > cluster_ : time == time_;
    if (!same || first_) {
      if (!first_) ++group_;
      first_ = false;
      if (!occurrence_.empty() && !std::isnan(time)) find(table, time);
      if (std::isnan(time) && !occurrence_.empty() && group_ >= occurrence_.size())
        table.fail("no more snapshots than cluster_occurrence.csv has", "another one");
    }
    time_ = time;
    cluster_ = cluster;
    return occurrence_.empty() || std::isnan(time) ? group_ : found_;
  }

 private:
  void find(const RunRows& table, double time) {
    // rows follow the snapshots as a rule: look on from the last place, then once from the start
    const auto is_it = [&](const OccurrenceSample& sample) { return sample.time == time; };
    const auto from = occurrence_.begin() + static_cast<std::ptrdiff_t>(found_);
    auto at = std::find_if(from, occurrence_.end(), is_it);
    if (at == occurrence_.end()) {
      at = std::find_if(occurrence_.begin(), from, is_it);
      if (at == from) table.fail("a time of cluster_occurrence.csv", fmt::format("{} s", time));
    }
    found_ = static_cast<std::size_t>(at - occurrence_.begin());
  }

  const std::vector<OccurrenceSample>& occurrence_;
  bool first_ = true;
  double time_ = not_a_number;
  int cluster_ = 0;
  std::size_t group_ = 0, found_ = 0;
};

void read_clusters(const fs::path& path, const RunName& run_name, RunResult& run) {
  RunRows table(path, run_name);
  const std::size_t time = table.needed("time [s]"), x = table.needed("x [m]"),
                    z = table.needed("z [m]");
  const auto cluster = table.column("cluster"), track = table.column("track"),
             area = table.column("area [m2]"), holdup = table.column("holdup [-]"),
             holdup_max = table.column("holdup_max [-]"),
             velocity_x = table.column("velocity_x [m/s]"),
             velocity_z = table.column("velocity_z [m/s]"),
             track_velocity_x = table.column("track_velocity_x [m/s]"),
             track_velocity_z = table.column("track_velocity_z [m/s]"),
             major = table.column("major [m]"), minor = table.column("minor [m]"),
             angle = table.column("angle [rad]"), parents = table.column("parents");
  SnapshotOf snapshot_of(run.occurrence);
  while (table.next()) {
    Cluster c;
    c.time = table.number(time);
    c.cluster = table.count(cluster, 0);
    c.track = table.count(track, 0);
    c.snapshot = snapshot_of(table, c.time, c.cluster);
    c.centre = {table.number(x), table.number(z)};
    c.area = table.number(area);
    c.holdup = table.number(holdup);
    c.holdup_max = table.number(holdup_max);
    c.velocity_x = table.number(velocity_x);
    c.velocity_z = table.number(velocity_z);
    c.track_velocity_x = table.number(track_velocity_x);
    c.track_velocity_z = table.number(track_velocity_z);
    c.major = table.number(major);
    c.minor = table.number(minor);
    c.angle = table.number(angle);
    if (parents) c.parents = parents_of(table, *parents);
    run.clusters.push_back(std::move(c));
  }
}

void read_temperature(const fs::path& path, const RunName& run_name, RunResult& run) {
  RunRows table(path, run_name);
  const std::size_t time = table.needed("time [s]"), mean = table.needed("mean [K]");
  const auto deviation = table.column("std [K]"), least = table.column("min [K]"),
             most = table.column("max [K]");
  while (table.next()) {
    species_of(run, table.type());
    run.temperature.push_back({table.number(time), table.type(), table.number(mean),
                               table.number(deviation), table.number(least), table.number(most)});
  }
}

void read_series(const fs::path& path, const RunName& run_name, RunResult& run) {
  RunRows table(path, run_name);
  const std::size_t name = table.needed("series"), unit = table.needed("unit"),
                    time = table.needed("time [s]"), value = table.needed("value");
  while (table.next()) {
    auto signal = std::find_if(run.series.begin(), run.series.end(),
                               [&](const Signal& s) { return s.name == table.text(name); });
    if (signal == run.series.end())
      signal = run.series.insert(
          signal, Signal{std::string(table.text(name)), std::string(table.text(unit)), {}, {}});
    if (signal->unit != table.text(unit))
      table.fail(fmt::format("the unit {} of its first row", signal->unit), table.text(unit));
    const double at = table.finite(time, "time");
    if (!signal->times.empty() && !(at > signal->times.back()))
      table.fail(fmt::format("a time after {} s", signal->times.back()), fmt::format("{} s", at));
    signal->times.push_back(at);
    signal->values.push_back(table.number(value));
  }
}

// Into the layers of axial_profile.csv, or where a species has none there into its own.
void read_axial_temperature(const fs::path& path, const RunName& run_name, RunResult& run) {
  RunRows table(path, run_name);
  const std::size_t z = table.needed("z [m]");
  table.needed("temperature [K]");
  const auto temperature = table.pair("temperature", "K");
  std::set<std::string> layered;
  for (const SpeciesResult& species : run.species)
    if (!species.axial.coordinate.empty()) layered.insert(species.type);
  while (table.next()) {
    SpeciesResult& species = species_of(run, table.type());
    auto& layers = species.axial.coordinate;
    const double at = table.finite(z, "coordinate");
    auto layer = std::lower_bound(layers.begin(), layers.end(), at);
    if (layer == layers.end() || *layer != at) {
      if (layered.contains(species.type))
        table.fail("a height of axial_profile.csv", fmt::format("{} m", at));
      if (layer != layers.end()) table.fail("ascending heights", fmt::format("{} m", at));
      append(species.axial, {.type = species.type, .coordinate = at});
      layer = layers.end() - 1;
    }
    const auto k = static_cast<std::size_t>(layer - layers.begin());
    species.axial_temperature.resize(layers.size());
    species.axial_temperature[k] = table.estimate(temperature);
  }
}

// A PDF is stored without its bins, n equal ones from 0 to 1: so must those of the table be.
void read_temperature_pdf(const fs::path& path, const RunName& run_name, RunResult& run) {
  RunRows table(path, run_name);
  const std::size_t centre = table.needed("bin_centre [-]");
  table.needed("probability_density [-]");
  const auto density = table.pair("probability_density", "-");
  struct Bin {
    double centre;
    std::size_t line;
  };
  std::vector<std::vector<Bin>> bins_of;  // in the order of run.species
  while (table.next()) {
    SpeciesResult& species = species_of(run, table.type());
    bins_of.resize(run.species.size());
    bins_of[static_cast<std::size_t>(&species - run.species.data())].push_back(
        {table.finite(centre, "bin centre"), table.line()});
    const Estimate bin = table.estimate(density);
    species.temperature_pdf.push_back(bin.value);
    species.temperature_pdf_ci95.push_back(bin.ci95);
  }
  for (const std::vector<Bin>& bins : bins_of)
    for (std::size_t i = 0; i < bins.size(); ++i) {
      const auto count = static_cast<double>(bins.size());
      const double expected = (static_cast<double>(i) + 0.5) / count;
      if (!(std::abs(bins[i].centre - expected) * count <= 0.01))  // of a bin: two digits suffice
        throw FormatError(
            "{}: line {}: expected {}, the centre of one of {} equal bins from 0 to 1, "
            "found {}",
            path.string(), bins[i].line, expected, bins.size(), bins[i].centre);
    }
}

struct TableReader {
  const char* name;
  void (*read)(const fs::path& path, const RunName& run_name, RunResult& run);
};

// In the order in which they are read: clusters need the times of the occurrence, the axial
// temperature the layers of the axial profile.
constexpr TableReader table_readers[] = {{"axial_profile.csv", read_axial},
                                         {"lateral_profile.csv", read_lateral},
                                         {"inventory.csv", read_inventory},
                                         {"cluster_occurrence.csv", read_occurrence},
                                         {"clusters.csv", read_clusters},
                                         {"temperature.csv", read_temperature},
                                         {"temperature_axial.csv", read_axial_temperature},
                                         {"temperature_pdf.csv", read_temperature_pdf},
                                         {"bed_height.csv", read_bed_height},
                                         {"bubbles.csv", read_bubbles},
                                         {"bubble_profile.csv", read_bubble_profile},
                                         {"fluctuation.csv", read_fluctuation},
                                         {"gas_axial.csv", read_gas_axial},
                                         {"gas_lateral.csv", read_gas_lateral},
                                         {"pressure_drop.csv", read_pressure_drop},
                                         {"series.csv", read_series}};

// One axis of the grid from the cell centres of a profile.
void set_axis(RunResult& run, Axis axis, const std::vector<double>& centres) {
  const std::size_t n = centres.size();
  if (n == 0) return;
  run.grid.cells[axis] = static_cast<int>(n);
  const double first = n > 1 ? centres[1] - centres[0] : 0;
  const double last = n > 1 ? centres[n - 1] - centres[n - 2] : 0;
  run.grid.min[axis] = centres[0] - first / 2;
  run.grid.max[axis] = centres[n - 1] + last / 2;
  for (std::size_t i = 0; i < n; ++i)
    if (!(std::abs(run.grid.centre(axis, static_cast<int>(i)) - centres[i]) <=
          even * run.grid.width(axis))) {
      run.problems.push_back(fmt::format(
          "tables: the {} coordinates are not evenly spaced: the grid is not that of the profiles",
          axis == lateral ? "lateral" : "axial"));
      return;
    }
}

// "all" first, as everywhere; every species with a profile a height.
void arrange(RunResult& run) {
  const auto all = std::find(run.types.begin(), run.types.end(), "all");
  if (all != run.types.end()) {
    const auto at = all - run.types.begin();
    std::rotate(run.types.begin(), all, all + 1);
    std::rotate(run.species.begin(), run.species.begin() + at, run.species.begin() + at + 1);
  }
  for (SpeciesResult& species : run.species) species.lateral.resize(run.heights.size());
  if (run.species.empty()) return;
  const SpeciesResult& first = run.species.front();
  set_axis(run, up, first.axial.coordinate);
  if (!first.lateral.empty()) set_axis(run, lateral, first.lateral.front().coordinate);
}

bool any_time(const RunResult& run) {
  const auto known = [](const auto& sample) { return !std::isnan(sample.time); };
  return std::any_of(run.inventory.begin(), run.inventory.end(), known) ||
         std::any_of(run.occurrence.begin(), run.occurrence.end(), known) ||
         std::any_of(run.clusters.begin(), run.clusters.end(), known) ||
         std::any_of(run.temperature.begin(), run.temperature.end(), known) || !run.series.empty();
}

// False only where masses or fluxes stand beside holdups and all are NaN.
bool any_density(const RunResult& run) {
  const auto mass = [](const InventorySample& sample) { return !std::isnan(sample.solids_mass); };
  if (std::any_of(run.inventory.begin(), run.inventory.end(), mass)) return true;
  const auto flux = [](const Estimate& e) { return !std::isnan(e.value); };
  const auto any_flux = [&](const Profile& p) {
    return std::any_of(p.mass_flux_z.begin(), p.mass_flux_z.end(), flux);
  };
  return std::any_of(run.species.begin(), run.species.end(), [&](const SpeciesResult& species) {
    return any_flux(species.axial) ||
           std::any_of(species.lateral.begin(), species.lateral.end(), any_flux);
  });
}

}  // namespace

RunResult read_tables(const fs::path& folder, const std::string& label) {
  const auto tables_in = [](const fs::path& place) {
    std::vector<fs::path> found;
    std::error_code ignored;
    for (const TableReader& table : table_readers)
      if (fs::exists(place / table.name, ignored)) found.push_back(place / table.name);
    return found;
  };
  fs::path place = folder;
  std::vector<fs::path> tables = tables_in(place);
  if (tables.empty()) tables = tables_in(place = folder / "tables");
  if (tables.empty())
    throw InputError("{}: expected tables such as axial_profile.csv, found none", folder.string());

  const RunName run_name = chosen_run(tables, folder, label);
  RunResult run;
  run.label = label;
  run.mapping = "unknown";
  run.window = {not_a_number, not_a_number, 0, 0, false, true};
  run.temperature_from = run.temperature_to = not_a_number;
  run.independent_samples = run.outside_fraction = run.band = not_a_number;
  for (const TableReader& table : table_readers)
    if (std::find(tables.begin(), tables.end(), place / table.name) != tables.end())
      table.read(place / table.name, run_name, run);
  arrange(run);
  run.time_known = any_time(run);
  run.density_known = any_density(run);
  for (const fs::path& path : tables) run.inputs.push_back(path.string());
  return run;
}

}  // namespace bedscope::analysis
