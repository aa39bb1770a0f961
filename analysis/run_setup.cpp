// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/run_setup.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "readers/columns.hpp"
#include "readers/error.hpp"
#include "readers/flaws.hpp"
#include "readers/liggghts_log.hpp"

namespace bedscope::analysis {
namespace {

constexpr double most_cells = 1e8;  // 2.4 GB of sums for one type: a mistyped cell size
/// Cells of a default grid in particle diameters: the thesis' riser has 2.5 mm for 0.85 mm.
constexpr double default_cell_in_diameters = 3;

std::array<int, 3> bed_axes(const RunSettings& settings) {
  return {settings.lateral, 3 - settings.lateral - settings.up, settings.up};
}

bool in_dumps(const readers::Series& series, const std::string& column) {
  return readers::has_column(series.parts(), column);
}

/// The rows of the first snapshot with particles, for what the study leaves open; read only then.
class FirstRows {
 public:
  enum { x, y, z, radius, type };
  explicit FirstRows(const readers::Series& series) : series_(series) {}

  const std::vector<double>& column(std::size_t k) {
    if (snapshot_.columns.empty()) {
      std::size_t first = 0;
      while (first + 1 < series_.size() && series_.particles(first) == 0) ++first;
      readers::Scratch scratch;
      series_.read(first, {{"x"}, {"y"}, {"z"}, {"radius", false}, {"type", false}}, snapshot_,
                   scratch);
    }
    return snapshot_.columns[k];
  }

 private:
  const readers::Series& series_;
  readers::Snapshot snapshot_;
};

void find_time_step(const readers::LiggghtsLog& log, bool has_steps, RunSetup& setup) {
  if (!has_steps) {
    if (setup.settings.time_step)
      setup.problems.emplace_back("time_step is not used: the snapshots tell their times");
    return;
  }
  setup.time_step = setup.settings.time_step;
  if (setup.time_step || !log.time_step) return;
  setup.time_step = log.time_step;
  setup.problems.push_back(fmt::format("time_step of {} s taken from {}{}", *log.time_step,
                                       log.path,
                                       log.several_time_steps ? ", the last of several" : ""));
}

double mean_radius(const RunSetup& setup, FirstRows& first) {
  const auto& radius = first.column(FirstRows::radius);
  const auto& type = first.column(FirstRows::type);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < first.column(FirstRows::x).size(); ++i) {
    const double r =
        setup.radius_in_dumps
            ? radius[i]
            : setup.settings.radius.at(type.empty() ? 0 : readers::whole_type(type[i]));
    if (!(r > 0) || !std::isfinite(r)) continue;
    sum += r;
    count += 1;
  }
  return count > 0 ? sum / count : readers::unknown;
}

void set_domain(const readers::Series& series, FirstRows& first, RunSetup& setup) {
  const auto& settings = setup.settings;
  std::array<double, 3> min{}, max{};
  std::array<bool, 3> periodic = settings.periodic.value_or(std::array<bool, 3>{});
  if (settings.domain) {
    min = (*settings.domain)[0];
    max = (*settings.domain)[1];
  } else if (const auto& box = series.located(0).box; box.known) {
    setup.domain_assumed = true;
    min = box.min;
    max = box.max;
    const bool tilted = box.tilt != std::array<double, 3>{};  // min and max are then around it
    if (!settings.periodic && !tilted) periodic = box.periodic;
    setup.problems.emplace_back("domain assumed: the box of the first dump");
    if (tilted)
      setup.problems.emplace_back(
          "the box of the first dump is tilted: the domain is the one around it, holdups count the "
          "room between the two, and periodic sides are not wrapped");
  } else {
    setup.domain_assumed = true;
    const double r = mean_radius(setup, first);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& x = first.column(axis);
      double low = INFINITY, high = -INFINITY;
      for (const double value : x) {
        if (!std::isfinite(value)) continue;
        low = std::min(low, value);
        high = std::max(high, value);
      }
      if (!(low <= high))
        throw InputError(
            "run \"{}\": domain is missing, and no particle tells it; expected "
            "domain = {{ min = [...], max = [...] }} [m] in [scene]",
            settings.label);
      min[axis] = low - r;
      max[axis] = high + r;
    }
    setup.problems.emplace_back(
        "domain assumed: the extent of the particles of the first snapshot");
  }
  const auto axes = bed_axes(settings);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(axes[k]);
    if (!(max[axis] > min[axis]))
      throw InputError("run \"{}\": domain has no width in {}: expected min < max, found {} and {}",
                       settings.label, "xyz"[axis], min[axis], max[axis]);
    setup.grid.min[k] = min[axis];
    setup.grid.max[k] = max[axis];
    setup.grid.periodic[k] = periodic[axis];
  }
}

/// A domain in millimetres or centimetres makes every holdup a billionth, and nothing else odd.
void doubt_domain(const readers::Series& series, RunSetup& setup) {
  const auto& box = series.located(0).box;
  if (setup.domain_assumed || !box.known) return;
  constexpr double far_wider = 30;  // half-way (of logarithms) between 1 and mm for m
  const auto axes = bed_axes(setup.settings);
  for (const int k : {lateral, depth}) {  // a box may follow the particles upwards
    const auto axis = static_cast<std::size_t>(axes[static_cast<std::size_t>(k)]);
    const double width = box.max[axis] - box.min[axis];
    if (!(setup.grid.length(k) > far_wider * width)) continue;
    setup.problems.push_back(fmt::format(
        "the domain is {:.4g} m wide in {}, the box of the dumps {:.4g} m: are both in metres?",
        setup.grid.length(k), "xyz"[axis], width));
    return;
  }
}

void set_cells(FirstRows& first, RunSetup& setup) {
  const auto& settings = setup.settings;
  auto& grid = setup.grid;
  // Two numbers: lateral and up; three: lateral, depth, up.
  const auto axis_of = [](std::size_t k, std::size_t count) {
    return count == 3 ? static_cast<int>(k) : k == 0 ? lateral : up;
  };
  if (!settings.cells.empty()) {
    for (std::size_t k = 0; k < settings.cells.size(); ++k) {
      if (settings.cells[k] < 1)
        throw InputError("run \"{}\": cells: expected at least 1, found {}", settings.label,
                         settings.cells[k]);
      grid.cells[static_cast<std::size_t>(axis_of(k, settings.cells.size()))] = settings.cells[k];
    }
  } else {
    auto cell = settings.cell;
    if (cell.empty()) {
      const double width = 2 * default_cell_in_diameters * mean_radius(setup, first);
      if (!(width > 0))
        throw InputError("run \"{}\": cell is missing, and no particle tells a size for it",
                         settings.label);
      cell = {width, width};
      setup.problems.push_back(
          fmt::format("cell assumed: {} particle diameters", default_cell_in_diameters));
    }
    for (std::size_t k = 0; k < cell.size(); ++k) {
      const int axis = axis_of(k, cell.size());
      if (!(cell[k] > 0) || !std::isfinite(cell[k]))
        throw InputError("run \"{}\": cell: expected a size above 0 m, found {}", settings.label,
                         cell[k]);
      const double exact = grid.length(axis) / cell[k];
      if (exact > most_cells)
        throw InputError("run \"{}\": cell of {} m is too small for a domain of {} m",
                         settings.label, cell[k], grid.length(axis));
      grid.cells[static_cast<std::size_t>(axis)] =
          std::max(1, static_cast<int>(std::lround(exact)));
      if (!settings.cell.empty() && std::abs(grid.width(axis) / cell[k] - 1) > 1e-6)
        setup.problems.push_back(
            fmt::format("cell of {} m does not divide the domain: {:.6g} m is used ({} cells)",
                        cell[k], grid.width(axis), grid.cells[static_cast<std::size_t>(axis)]));
    }
  }
  const double cells = 1.0 * grid.cells[0] * grid.cells[1] * grid.cells[2];
  if (cells > most_cells)
    throw InputError("run \"{}\": a grid of {} cells is beyond the limit of {}", settings.label,
                     cells, most_cells);
}

/// The density of all templates in the log, where they have the same.
std::optional<double> one_density(const readers::LiggghtsLog& log) {
  for (const auto& [type, density] : log.density)
    if (density != log.density.begin()->second) return std::nullopt;
  if (log.density.empty()) return std::nullopt;
  return log.density.begin()->second;
}

/// A density of the study that is not the log's: one of them is wrong, or the run was scaled.
void compare_density(const readers::LiggghtsLog& log, RunSetup& setup) {
  constexpr double fair = 0.01;
  for (const auto& [type, logged] : log.density) {
    const auto own = setup.density.of_type.find(type);
    const auto told = own != setup.density.of_type.end() ? own->second : setup.density.all;
    if (told && std::abs(*told - logged) > fair * logged)
      setup.problems.push_back(
          fmt::format("density of type {} is {} kg/m3, {} says {}", type, *told, log.path, logged));
  }
}

void set_density(const readers::Series& series, const readers::LiggghtsLog& log, RunSetup& setup) {
  using From = RunSetup::Density;
  const auto& names = series.columns();
  // In dumps of multi-sphere bodies each row carries the mass of the whole body.
  const bool bodies = std::any_of(names.begin(), names.end(), [](const std::string& name) {
    return name == "id_multisphere" || name == "mol";
  });
  setup.density = setup.settings.density;
  if (setup.density.given()) {
    setup.density_from = From::by_type;
    compare_density(log, setup);
  } else if (in_dumps(series, "density")) {
    setup.density_from = From::density_column;
  } else if (in_dumps(series, "mass") && !bodies) {
    setup.density_from = From::mass_column;
  } else if (one_density(log) || (!log.density.empty() && in_dumps(series, "type"))) {
    setup.density_from = From::by_type;
    setup.density.all = one_density(log);
    setup.density.of_type = log.density;
    setup.problems.push_back(fmt::format("density taken from {}", log.path));
  } else {
    setup.problems.emplace_back(
        "no density (key density, a column, or log.liggghts): masses and mass fluxes are nan");
  }
}

readers::ColumnRequest density_column(const RunSetup& setup) {
  switch (setup.density_from) {
    case RunSetup::Density::density_column:
      return {"density"};
    case RunSetup::Density::mass_column:
      return {"mass"};
    default:
      return {"no density needed", false};
  }
}

/// How much of each layer of cells belongs to the band around a height; their sum is 1.
std::vector<double> layer_weights(const RunSetup& setup, double height, double band) {
  const auto& grid = setup.grid;
  std::vector<double> weights(static_cast<std::size_t>(grid.cells[up]));
  double sum = 0;
  for (int k = 0; k < grid.cells[up]; ++k) {
    const double overlap = std::min(grid.face(up, k + 1), height + band / 2) -
                           std::max(grid.face(up, k), height - band / 2);
    weights[static_cast<std::size_t>(k)] = std::max(overlap, 0.);
    sum += std::max(overlap, 0.);
  }
  if (!(sum > 0))
    throw InputError("run \"{}\": heights: {} m lies outside the domain ({} to {} m)",
                     setup.settings.label, height, grid.min[up], grid.max[up]);
  for (auto& weight : weights) weight /= sum;
  return weights;
}

void set_heights(RunSetup& setup) {
  const auto& settings = setup.settings;
  const auto& grid = setup.grid;
  setup.heights = settings.heights;
  if (!settings.wanted.lateral)
    setup.heights.clear();
  else if (setup.heights.empty())
    for (const double part : {0.25, 0.5, 0.75})
      setup.heights.push_back(grid.min[up] + part * grid.length(up));
  setup.band = settings.band > 0 ? settings.band : 2 * grid.width(up);
  for (const double height : setup.heights)
    setup.band_weights.push_back(layer_weights(setup, height, setup.band));
}

/// Bands around the study's heights, else 20 (or a layer each) that fill the domain; and what the
/// study leaves open of the thresholds.
void set_bubbles(RunSetup& setup) {
  auto& wanted = setup.settings.bubbles;
  if (!wanted) return;
  constexpr int most_bands = 20;
  constexpr double least_cells = 4;  // a smaller void is a gap between particles
  const auto& grid = setup.grid;
  if (!(wanted->min_area > 0))
    wanted->min_area = least_cells * grid.width(lateral) * grid.width(up);
  std::vector<double> heights = setup.settings.heights;
  double width = setup.band;
  if (heights.empty()) {
    const int bands = std::min(grid.cells[up], most_bands);
    width = grid.length(up) / bands;
    for (int b = 0; b < bands; ++b) heights.push_back(grid.min[up] + (b + 0.5) * width);
  }
  for (const double height : heights)
    setup.bubble_bands.push_back({height, width, layer_weights(setup, height, width)});
}

/// What the grid is too coarse for; docs/stability.md has the maps.
void doubt_grid(RunSetup& setup) {
  const auto& settings = setup.settings;
  const auto& grid = setup.grid;
  constexpr int fewest_cells = 5;  // two walls, a core, and what is between
  if (settings.wanted.lateral && grid.cells[lateral] < fewest_cells)
    setup.problems.push_back(
        fmt::format("{} cells across: too few for a lateral profile to tell walls from core",
                    grid.cells[lateral]));
  double widest = std::max(grid.width(lateral), grid.width(up));
  if (!grid.depth_averaged()) widest = std::max(widest, grid.width(depth));
  if (settings.mapping == "gaussian" && settings.gaussian_width > 0 &&
      settings.gaussian_width < widest * (1 - 1e-9))
    setup.problems.push_back(
        fmt::format("gaussian_width of {:g} m is narrower than a cell ({:g} m): holdups jump as "
                    "particles cross faces",
                    settings.gaussian_width, widest));
}

/// Times on disk are sums of steps: 0.3 s may be written 0.29999999999999998 [s].
double rounding_of(const std::vector<double>& times) {
  double gap = INFINITY;
  for (std::size_t i = 1; i < times.size(); ++i) gap = std::min(gap, times[i] - times[i - 1]);
  return 1e-6 * (std::isfinite(gap) ? gap : std::abs(times.front()));
}

}  // namespace

void update_times(RunSetup& setup, const readers::Series& series) {
  const auto& settings = setup.settings;
  setup.times.clear();
  if (setup.time_step && series.has_steps()) {
    for (std::size_t i = 0; i < series.size(); ++i)
      setup.times.push_back(static_cast<double>(series.step(i) - settings.step_zero) *
                            *setup.time_step);
    setup.half_step = *setup.time_step / 2;
    return;
  }
  for (std::size_t i = 0; i < series.size() && !std::isnan(series.time(i)); ++i)
    setup.times.push_back(series.time(i));  // some forms store it
  if (setup.times.size() == series.size()) {
    setup.half_step = rounding_of(setup.times);
    return;
  }
  if (settings.time_required)
    throw InputError(
        "run \"{}\": time_step is missing: no log.liggghts beside the dumps tells it; expected "
        "time_step = ... [s a step] in the [[run]]",
        settings.label);
  setup.times.clear();
  for (std::size_t i = 0; i < series.size(); ++i)
    setup.times.push_back(static_cast<double>(series.step(i)));
  setup.half_step = 0.5;
  if (!setup.time_known) return;
  setup.time_known = false;
  setup.problems.emplace_back(
      "time step unknown (no study, no log.liggghts beside the dumps): times are nan, snapshots "
      "weigh by their steps");
}

RunSetup set_up(const RunSettings& settings, const readers::Series& series) {
  RunSetup setup;
  setup.settings = settings;
  const auto& wanted = settings.wanted;
  if (!wanted.species) setup.settings.species.clear();
  const auto log = readers::find_log(series.path(0));
  find_time_step(log, series.has_steps(), setup);
  update_times(setup, series);

  const bool empty = series.parts().empty();  // not one particle in all dumps, and no columns
  setup.radius_in_dumps = !settings.radius.given() && !empty;
  if (setup.radius_in_dumps && !in_dumps(series, "radius"))
    throw InputError(
        "run \"{}\": radius is missing: the dumps have none (columns: {}); expected radius = ... "
        "[m] in [scene]",
        settings.label, fmt::join(series.columns(), " "));
  FirstRows first(series);
  set_domain(series, first, setup);
  doubt_domain(series, setup);
  set_cells(first, setup);
  set_density(series, log, setup);
  set_heights(setup);
  set_bubbles(setup);
  setup.kernel =
      make_kernel(settings.mapping, setup.grid, {.gaussian_width = settings.gaussian_width});
  doubt_grid(setup);

  const auto axes = bed_axes(settings);
  const auto name = [&](const char* prefix, int k) {
    return prefix + std::string(1, "xyz"[axes[static_cast<std::size_t>(k)]]);
  };
  const bool needs_type =
      wanted.species || !setup.density.of_type.empty() || !settings.radius.of_type.empty();
  // Mean fields and clusters have a lateral velocity, profiles need the one along `up` only.
  const bool needs_lateral = wanted.fields || wanted.clusters;
  setup.has_velocity =
      (!needs_lateral || in_dumps(series, name("v", lateral))) && in_dumps(series, name("v", up));
  if (!setup.has_velocity)
    setup.problems.emplace_back("no velocity columns: velocities and mass fluxes are nan");
  setup.has_temperature = wanted.temperature && in_dumps(series, settings.temperature_column);
  if (wanted.temperature && !setup.has_temperature && settings.temperature_column != "temperature")
    throw InputError("run \"{}\": temperature.column: the dumps have no \"{}\" (columns: {})",
                     settings.label, settings.temperature_column, fmt::join(series.columns(), " "));
  setup.request = {
      {name("", lateral)},
      {name("", depth)},
      {name("", up)},
      {needs_lateral ? name("v", lateral) : "no lateral velocity needed",
       needs_lateral && setup.has_velocity},
      {name("v", up), setup.has_velocity},
      {setup.radius_in_dumps ? "radius" : "no radius needed", setup.radius_in_dumps},
      {needs_type ? "type" : "no type needed", needs_type && in_dumps(series, "type")},
      {wanted.id_check ? "id" : "no id needed", false},
      {setup.has_temperature ? readers::name_on_disk(series.parts(), settings.temperature_column)
                             : "no temperature",
       setup.has_temperature},
      density_column(setup)};
  for (const auto& rule : setup.settings.species) setup.request.push_back({rule.column});
  setup.request_without_id = setup.request;
  setup.request_without_id[column_id] = {"no id needed", false};
  return setup;
}

}  // namespace bedscope::analysis
