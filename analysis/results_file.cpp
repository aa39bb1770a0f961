// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/results_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "analysis/bed_results_file.hpp"
#include "analysis/gas_results_file.hpp"
#include "analysis/hdf5_rows.hpp"
#include "analysis/output_file.hpp"

namespace bedscope::analysis {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct Field {
  const char* name;
  std::vector<double> MeanFields::*values;
  const char* unit;
};
constexpr std::array<Field, 5> all_fields = {
    {{"holdup", &MeanFields::holdup, "-"},
     {"velocity_x", &MeanFields::velocity_x, "m/s"},
     {"velocity_z", &MeanFields::velocity_z, "m/s"},
     {"mass_flux_x", &MeanFields::mass_flux_x, "kg/m2/s"},
     {"mass_flux_z", &MeanFields::mass_flux_z, "kg/m2/s"}}};

// A name that none of those taken is, and takes it.
std::string free_name(std::string_view wanted, std::vector<std::string>& taken) {
  std::string name = hdf5_name(wanted);
  while (std::find(taken.begin(), taken.end(), name) != taken.end()) name += '_';
  return taken.emplace_back(name);
}

template <class Row>
void write_types(Hdf5Group& group, const std::vector<Row>& rows) {
  std::vector<std::string> types(rows.size());
  std::transform(rows.begin(), rows.end(), types.begin(), [](const Row& row) { return row.type; });
  group.write("type", types);
}

void write_profile(Hdf5Group group, const Profile& profile, const char* coordinate) {
  group.write(coordinate, profile.coordinate, "m");
  write_curve(group, "holdup", profile.holdup, "-");
  write_curve(group, "velocity_z", profile.velocity_z, "m/s");
  write_curve(group, "mass_flux_z", profile.mass_flux_z, "kg/m2/s");
}

// [up][lateral], or [up][depth][lateral] of a 3-D grid.
Shape field_shape(const Grid& grid) {
  const auto cells = [&](Axis axis) { return static_cast<hsize_t>(grid.cells[axis]); };
  if (grid.depth_averaged()) return {cells(up), cells(lateral)};
  return {cells(up), cells(depth), cells(lateral)};
}

void write_species(Hdf5Group group, const RunResult& run, const SpeciesResult& species) {
  group.attribute("type", species.type);
  write_profile(group.group("axial"), species.axial, "z");
  Hdf5Group profiles = group.group("lateral");
  for (std::size_t h = 0; h < species.lateral.size(); ++h) {
    Hdf5Group profile = profiles.group(std::to_string(h + 1));
    profile.attribute("height", run.heights[h]);
    write_profile(std::move(profile), species.lateral[h], "x");
  }
  Hdf5Group fields = group.group("fields");
  for (const Field& field : all_fields) {
    const std::vector<double>& values = species.fields.*field.values;
    if (values.size() == run.grid.size())
      fields.write(field.name, values, field.unit, field_shape(run.grid));
  }
  if (!species.temperature_pdf.empty())
    group.write("temperature_pdf", species.temperature_pdf, "-");
}

void write_setup(Hdf5Group& group, const RunResult& run) {
  group.attribute("label", run.label);
  group.attribute("mapping", run.mapping);
  group.attribute("domain_assumed", std::int64_t{run.domain_assumed});
  group.attribute("time_known", std::int64_t{run.time_known});
  group.attribute("density_known", std::int64_t{run.density_known});
  group.write("types", run.types);
  group.write("problems", run.problems);
  group.write("inputs", run.inputs);

  Hdf5Group grid = group.group("grid");
  grid.write("min", run.grid.min, "m");
  grid.write("max", run.grid.max, "m");
  grid.write("cells", std::vector<std::int64_t>(run.grid.cells.begin(), run.grid.cells.end()));
  grid.write("periodic",
             std::vector<std::int64_t>(run.grid.periodic.begin(), run.grid.periodic.end()));

  Hdf5Group window = group.group("window");
  window.attribute("from", run.time_known ? run.window.from : not_a_number);
  window.attribute("to", run.time_known ? run.window.to : not_a_number);
  window.attribute("first", static_cast<std::int64_t>(run.window.first));
  window.attribute("snapshots", static_cast<std::int64_t>(run.window.snapshots));
  window.attribute("automatic", std::int64_t{run.window.automatic});
  window.attribute("steady", std::int64_t{run.window.steady});
}

void write_estimates(Hdf5Group group, const RunResult& run) {
  write_estimate(group, "mean_holdup", run.mean_holdup, "-");
  write_estimate(group, "inventory", run.inventory_mass, "kg");
  write_estimate(group, "mean_occurrence", run.mean_occurrence, "-");
  write_estimate(group, "mean_bed_voidage", run.bed_voidage, "-");
  group.attribute("independent_samples", run.independent_samples);
  group.attribute("outside_fraction", run.outside_fraction);
}

void write_series(Hdf5Group& group, const RunResult& run) {
  Hdf5Group inventory = group.group("inventory");
  inventory.write("time", times(run, run.inventory), "s");
  write_types(inventory, run.inventory);
  inventory.write("particles", numbers<std::int64_t>(run.inventory, &InventorySample::particles));
  std::vector<double> mass = numbers(run.inventory, &InventorySample::solids_mass);
  if (!run.density_known) std::fill(mass.begin(), mass.end(), not_a_number);
  inventory.write("solids_mass", mass, "kg");
  inventory.write("holdup", numbers(run.inventory, &InventorySample::holdup), "-");
  inventory.write("mean_height", numbers(run.inventory, &InventorySample::mean_height), "m");

  Hdf5Group occurrence = group.group("occurrence");
  occurrence.write("time", times(run, run.occurrence), "s");
  occurrence.write("clusters", numbers<std::int64_t>(run.occurrence, &OccurrenceSample::clusters));
  occurrence.write("area_fraction", numbers(run.occurrence, &OccurrenceSample::area_fraction), "-");

  if (run.temperature.empty()) return;
  Hdf5Group temperature = group.group("temperature");
  temperature.attribute("from", run.temperature_from);
  temperature.attribute("to", run.temperature_to);
  temperature.write("time", times(run, run.temperature), "s");
  write_types(temperature, run.temperature);
  temperature.write("mean", numbers(run.temperature, &TemperatureSample::mean), "K");
  temperature.write("std", numbers(run.temperature, &TemperatureSample::std), "K");
  temperature.write("min", numbers(run.temperature, &TemperatureSample::min), "K");
  temperature.write("max", numbers(run.temperature, &TemperatureSample::max), "K");
}

void write_clusters(Hdf5Group group, const RunResult& run, const std::vector<Cluster>& rows,
                    const ClusterThresholds& thresholds) {
  group.attribute("threshold", thresholds.threshold);
  group.attribute("core", thresholds.core);
  group.attribute("min_area", thresholds.min_area);
  group.write("snapshot", numbers<std::int64_t>(rows, &Cluster::snapshot));
  group.write("time", times(run, rows), "s");
  group.write("cluster", numbers<std::int64_t>(rows, &Cluster::cluster));
  group.write("track", numbers<std::int64_t>(rows, &Cluster::track));
  group.write("x", numbers(rows, [](const Cluster& c) { return c.centre.x; }), "m");
  group.write("z", numbers(rows, [](const Cluster& c) { return c.centre.z; }), "m");
  group.write("area", numbers(rows, &Cluster::area), "m2");
  group.write("holdup", numbers(rows, &Cluster::holdup), "-");
  group.write("holdup_max", numbers(rows, &Cluster::holdup_max), "-");
  group.write("velocity_x", numbers(rows, &Cluster::velocity_x), "m/s");
  group.write("velocity_z", numbers(rows, &Cluster::velocity_z), "m/s");
  group.write("track_velocity_x", numbers(rows, &Cluster::track_velocity_x), "m/s");
  group.write("track_velocity_z", numbers(rows, &Cluster::track_velocity_z), "m/s");
  group.write("major", numbers(rows, &Cluster::major), "m");
  group.write("minor", numbers(rows, &Cluster::minor), "m");
  group.write("angle", numbers(rows, &Cluster::angle), "rad");

  std::vector<std::int64_t> parents, begin{0};
  for (const Cluster& cluster : rows) {
    parents.insert(parents.end(), cluster.parents.begin(), cluster.parents.end());
    begin.push_back(static_cast<std::int64_t>(parents.size()));
  }
  group.write("parents", parents);
  group.write("parents_begin", begin);
}

void write_contours(Hdf5Group group, const std::vector<Cluster>& clusters) {
  std::vector<double> points;
  std::vector<std::int64_t> begin{0}, owner;
  for (std::size_t c = 0; c < clusters.size(); ++c)
    for (const std::vector<Point>& contour : clusters[c].contours) {
      for (const Point& point : contour) points.insert(points.end(), {point.x, point.z});
      begin.push_back(static_cast<std::int64_t>(points.size() / 2));
      owner.push_back(static_cast<std::int64_t>(c));
    }
  group.write("points", points, "m", {points.size() / 2, 2});
  group.write("begin", begin);
  group.write("cluster", owner);
}

void write_frames(Hdf5Group group, const RunResult& run) {
  const auto nx = static_cast<hsize_t>(run.grid.cells[lateral]);
  const auto nz = static_cast<hsize_t>(run.grid.cells[up]);
  std::vector<double> holdup;
  for (const Frame& frame : run.frames)
    holdup.insert(holdup.end(), frame.holdup.begin(), frame.holdup.end());
  group.write("snapshot", numbers<std::int64_t>(run.frames, &Frame::snapshot));
  group.write("time", times(run, run.frames), "s");
  group.write("holdup", holdup, "-", {run.frames.size(), nz, nx});
}

void write_run(Hdf5Group group, const RunResult& run) {
  write_setup(group, run);
  write_estimates(group.group("estimates"), run);
  Hdf5Group all_species = group.group("species");
  all_species.attribute("band", run.band);
  std::vector<std::string> taken;
  for (const SpeciesResult& species : run.species) {
    write_species(all_species.group(free_name(species.type, taken)), run, species);
  }
  write_series(group, run);
  write_clusters(group.group("clusters"), run, run.clusters, run.thresholds);
  write_contours(group.group("contours"), run.clusters);
  if (run.bubbles) {
    write_clusters(group.group("bubbles"), run, run.bubbles->bubbles, run.bubbles->thresholds);
    write_contours(group.group("bubble_contours"), run.bubbles->bubbles);
  }
  write_bed_groups(group, run);
  write_frames(group.group("frames"), run);
  if (run.gas.present) write_gas_group(group.group("gas"), run, field_shape(run.grid));
}

// The points of the image along an axis, see write_results_file.
struct ImageAxis {
  ImageAxis(const Grid& grid, Axis axis)
      : points(std::max(grid.cells[axis], 2)),
        origin(grid.cells[axis] > 1 ? grid.centre(axis, 0) : grid.min[axis]),
        spacing(grid.width(axis)) {}
  int points;
  double origin, spacing;
};

std::vector<double> image_values(const Grid& grid, const std::vector<double>& cells) {
  const auto points = [&](Axis axis) { return ImageAxis(grid, axis).points; };
  const auto cell = [&](Axis axis, int point) { return std::min(point, grid.cells[axis] - 1); };
  std::vector<double> values;
  for (int k = 0; k < points(up); ++k)
    for (int j = 0; j < points(depth); ++j)
      for (int i = 0; i < points(lateral); ++i)
        values.push_back(cells[grid.index(cell(lateral, i), cell(depth, j), cell(up, k))]);
  return values;
}

// The runs (by their index) on one grid as one image.
void write_image(Hdf5Group group, std::span<const RunResult> runs,
                 const std::vector<std::size_t>& members) {
  const Grid& grid = runs[members.front()].grid;
  const ImageAxis x(grid, lateral), y(grid, depth), z(grid, up);
  group.attribute("Version", std::array<std::int64_t, 2>{1, 0});
  group.ascii_attribute("Type", "ImageData");
  group.attribute("WholeExtent",
                  std::array<std::int64_t, 6>{0, x.points - 1, 0, y.points - 1, 0, z.points - 1});
  group.attribute("Origin", std::array{x.origin, y.origin, z.origin});
  group.attribute("Spacing", std::array{x.spacing, y.spacing, z.spacing});
  group.attribute("Direction", std::array{1., 0., 0., 0., 1., 0., 0., 0., 1.});
  const Shape shape = {static_cast<hsize_t>(z.points), static_cast<hsize_t>(y.points),
                       static_cast<hsize_t>(x.points)};

  Hdf5Group data = group.group("PointData");
  std::vector<std::string> taken;
  for (const std::size_t member : members) {
    const auto write = [&](std::string name, const std::vector<double>& values, const char* unit) {
      if (values.size() != grid.size()) return;
      if (runs.size() > 1) name += " [" + runs[member].label + "]";
      data.write(free_name(name, taken), image_values(grid, values), unit, shape);
    };
    for (const SpeciesResult& species : runs[member].species)
      for (const Field& field : all_fields)
        write(species.type == "all" ? field.name : field.name + (" of " + species.type),
              species.fields.*field.values, field.unit);
    for (const GasField& field : all_gas_fields)
      write(field.name, runs[member].gas.fields.*field.values, field.unit);
  }
}

// The runs that have fields, those on one grid together, in the order of their first.
std::vector<std::vector<std::size_t>> by_grid(std::span<const RunResult> runs) {
  const auto same = [](const Grid& a, const Grid& b) {
    return a.min == b.min && a.max == b.max && a.cells == b.cells;
  };
  std::vector<std::vector<std::size_t>> images;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].species.empty() || runs[i].species[0].fields.holdup.empty()) continue;
    const auto image = std::find_if(images.begin(), images.end(), [&](const auto& members) {
      return same(runs[members.front()].grid, runs[i].grid);
    });
    if (image == images.end()) {
      images.push_back({i});
    } else {
      image->push_back(i);
    }
  }
  return images;
}

// results_<n>.h5 beside results.h5
std::filesystem::path beside(const std::filesystem::path& path, std::size_t run) {
  std::filesystem::path name = path.stem();
  name += fmt::format("_{}", run + 1);
  name += path.extension();
  return path.parent_path() / name;
}

}  // namespace

void write_results_file(std::span<const RunResult> runs, const std::filesystem::path& path) {
  const std::vector<std::vector<std::size_t>> images = by_grid(runs);
  {
    Hdf5File file(path);
    Hdf5Group root = file.root();
    root.attribute("program", "bedscope " BEDSCOPE_VERSION);
    root.attribute("documentation", "docs/results.md of bedscope");
    Hdf5Group groups = root.group("runs");
    for (std::size_t i = 0; i < runs.size(); ++i)
      write_run(groups.group(std::to_string(i + 1)), runs[i]);
    if (!images.empty()) write_image(root.group("VTKHDF"), runs, images.front());
    file.commit();
  }
  for (std::size_t i = 1; i < runs.size(); ++i) {
    const auto image = std::find_if(images.begin(), images.end(), [&](const auto& members) {
      return members.front() == i && &members != &images.front();
    });
    if (image == images.end()) {
      remove_file(beside(path, i));
      continue;
    }
    Hdf5File file(beside(path, i));
    write_image(file.root().group("VTKHDF"), runs, *image);
    file.commit();
  }
}

}  // namespace bedscope::analysis
