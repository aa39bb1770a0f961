// SPDX-License-Identifier: BSD-3-Clause
#include "app/info_plan.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <thread>

#include "app/study.hpp"
#include "readers/error.hpp"
#include "readers/toml_table.hpp"

namespace bedscope::app {
namespace {

using analysis::RunSetup;
using readers::toml_text;

std::string density_source(const RunSetup& setup, const readers::LiggghtsLog& log) {
  switch (setup.density_from) {
    case RunSetup::Density::density_column:
      return "column of the dumps";
    case RunSetup::Density::mass_column:
      return "mass and radius of the dumps";
    case RunSetup::Density::by_type:
      return log.path;
    default:
      return "none: masses and mass fluxes would be nan";
  }
}

std::string time_source(const RunSetup& setup, const readers::LiggghtsLog& log) {
  if (setup.time_step) return fmt::format("steps x {} s ({})", *setup.time_step, log.path);
  return setup.time_known ? "of the dumps" : "unknown: snapshots weigh by their steps";
}

std::vector<std::string> products_of(const RunSetup& setup) {
  std::vector<std::string> products{"inventory", "holdup", "profiles", "clusters"};
  if (setup.has_velocity) products.insert(products.begin() + 2, "velocity");
  if (setup.density_from != RunSetup::Density::unknown && setup.has_velocity)
    products.insert(products.begin() + 3, "mass flux");
  if (setup.has_temperature) products.emplace_back("temperature");
  return products;
}

/// Each thread and one more, but no more than there are snapshots, hold a snapshot's columns and
/// its sums; an average over a window that is still to be found keeps its sums in blocks of 16
/// snapshots, at most 128 of them, and once more while they are merged. Measured on three runs of
/// 27 to 535 MB: 2 % below to 18 % above.
double memory_of(const RunSetup& setup, const readers::Survey& survey) {
  constexpr double program = 20e6;
  const double types = std::max<double>(1, static_cast<double>(survey.types.size()));
  const double sums = 3 * 8 * static_cast<double>(setup.grid.size()) * types;
  const double columns =
      8 * static_cast<double>(setup.request.size()) * static_cast<double>(survey.particles[1]);
  const auto threads = std::max(1U, std::thread::hardware_concurrency());
  const auto snapshots = static_cast<double>(survey.steps.size());
  const double workers = threads == 1 ? 1 : std::min(threads + 1., snapshots);
  const double blocks = std::min(128., snapshots / 16 + 1);
  return program + workers * (sums + 1.5 * columns) + 2 * blocks * sums;
}

std::string vector_text(const analysis::Vec3& in_bed_axes, const RunSetup& setup) {
  std::array<double, 3> xyz{};
  const std::array axes{setup.settings.lateral, 3 - setup.settings.lateral - setup.settings.up,
                        setup.settings.up};
  for (std::size_t k = 0; k < 3; ++k) xyz[static_cast<std::size_t>(axes[k])] = in_bed_axes[k];
  return fmt::format("[{}, {}, {}]", xyz[0], xyz[1], xyz[2]);
}

std::string periodic_text(const RunSetup& setup, const readers::Survey& survey) {
  std::string axes;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (survey.box.known && survey.box.periodic[axis] && !setup.settings.periodic)
      axes += fmt::format("{}\"{}\"", axes.empty() ? "" : ", ", "xyz"[axis]);
  return axes;
}

std::string density_lines(const RunSetup& setup, const readers::LiggghtsLog& log) {
  using From = RunSetup::Density;
  if (setup.density_from == From::density_column)
    return "# density: the dumps have a column of it\n";
  if (setup.density_from == From::mass_column)
    return "# density: from the dumps' columns mass and radius\n";
  if (setup.density_from == From::unknown)
    return "# density  = 2500   # kg/m3: NOT KNOWN; without it no mass is written\n";
  std::string values;
  for (const auto& [type, density] : log.density)
    values += fmt::format("{}{} = {}", values.empty() ? "" : ", ", type, density);
  return fmt::format("density  = {{ {} }}   # kg/m3, by type, from {}\n", values, log.path);
}

/// Only where the dumps have none.
std::string radius_line(const RunSetup& setup, const readers::LiggghtsLog& log) {
  std::string values;
  for (const auto& [type, radius] : setup.settings.radius.of_type)
    values += fmt::format("{}{} = {}", values.empty() ? "" : ", ", type, radius);
  return values.empty()
             ? ""
             : fmt::format("radius   = {{ {} }}   # m, by type, from {}\n", values, log.path);
}

std::string scene_text(const RunSetup& setup, const readers::Survey& survey,
                       const readers::LiggghtsLog& log) {
  const auto& grid = setup.grid;
  std::string text = "[scene]\n";
  text += fmt::format(
      "# ASSUMED: the {}. Centres lie in\n# [{:.6g}, {:.6g}, {:.6g}] to [{:.6g}, {:.6g}, {:.6g}].\n"
      "domain   = {{ min = {}, max = {} }}   # m\n",
      survey.box.known ? "box of the first dump" : "extent of the first snapshot", survey.min[0],
      survey.min[1], survey.min[2], survey.max[0], survey.max[1], survey.max[2],
      vector_text(grid.min, setup), vector_text(grid.max, setup));
  text += "up       = \"z\"   # ASSUMED; against gravity\n";
  if (log.gravity)
    text += fmt::format("# gravity in {}: [{:.4g}, {:.4g}, {:.4g}] m/s2\n", log.path,
                        (*log.gravity)[0], (*log.gravity)[1], (*log.gravity)[2]);
  text += "lateral  = \"x\"   # ASSUMED; the third axis is averaged over\n";
  text += fmt::format(
      "cells    = [{}, {}]             # ASSUMED: 3 particle diameters, {:.4g} x "
      "{:.4g} m\n",
      grid.cells[analysis::lateral], grid.cells[analysis::up], grid.width(analysis::lateral),
      grid.width(analysis::up));
  text += fmt::format("periodic = [{}]\n", periodic_text(setup, survey));
  text += density_lines(setup, log) + radius_line(setup, log);
  text += "average  = \"auto\"   # or { from = ..., to = ... } in s\n";
  text += "mapping  = \"exact\"   # or centre, divided, gaussian\n";
  return text;
}

/// Twelve digits: without the last ones of a double, which nobody chose.
std::string rounded(const std::vector<double>& lengths) {
  std::string text;
  for (const double length : lengths)
    text += fmt::format("{}{:.12g}", text.empty() ? "" : ", ", length);
  return text;
}

std::string products_text(const RunSetup& setup, const readers::Survey& survey) {
  const auto& clusters = setup.settings.clusters;
  std::string text = fmt::format(
      "\n[profiles]\nheights  = [{}]   # m, of the lateral profiles\nband     = {}   # m\n",
      rounded(setup.heights), rounded({setup.band}));
  text += fmt::format("\n[clusters]\nthreshold = {}\ncore      = {}\nmin_area  = {}   # m2\n",
                      clusters.threshold, clusters.core, clusters.min_area);
  if (setup.has_temperature)
    text += fmt::format(
        "\n[temperature]\ncolumn = {}\n# from = ...   # K, made 0 in the distribution\n# to   = "
        "... "
        "  # K, made 1\n",
        toml_text(survey.temperature_column));
  return text + "\n# Of a bubbling bed: [bubbles], [bed] and [spectra], see docs/study.md\n";
}

std::string run_text(const std::string& path, const RunSetup& setup,
                     const readers::LiggghtsLog& log) {
  std::string text = fmt::format("\n[[run]]\nlabel     = {}\nparticles = {}\n",
                                 toml_text(setup.settings.label), toml_text(path));
  if (setup.time_step)
    text += fmt::format("time_step = {}   # s a step, from {}\n", *setup.time_step, log.path);
  else if (!setup.time_known)
    text += "time_step = 1   # NOT KNOWN: with 1, times count steps; put s a step here\n";
  return text + "step_zero = 0   # the step at t = 0\n";
}

}  // namespace

Plan make_plan(const analysis::RunSettings& settings, const readers::Series& series,
               const readers::Survey& survey, const readers::LiggghtsLog& log) {
  Plan plan;
  for (const auto& file : series.files()) {
    std::error_code ignored;
    const auto size = std::filesystem::file_size(file, ignored);
    if (!ignored) plan.bytes += size;
  }
  if (!series.named()) {
    plan.stops = fmt::format("{}: no names of columns: expected columns = [...] in the [[run]]",
                             series.path(0));
    return plan;
  }
  try {
    plan.setup = analysis::set_up(settings, series);
  } catch (const Error& error) {
    plan.stops = error.what();
    return plan;
  }
  plan.memory = memory_of(*plan.setup, survey);
  plan.density = density_source(*plan.setup, log);
  plan.time = time_source(*plan.setup, log);
  plan.products = products_of(*plan.setup);
  return plan;
}

analysis::RunSettings settings_with_log(const std::string& path, const readers::Survey& survey,
                                        const readers::LiggghtsLog& log) {
  auto settings = study_of_path(path).runs.front().settings;
  if (survey.has_radius) return settings;
  std::map<int, double> radii;
  for (const auto& [type, range] : log.radius)
    if (range[0] == range[1]) radii[type] = range[0];
  for (const auto& [type, found] : survey.types)
    if (!radii.contains(static_cast<int>(type))) return settings;
  settings.radius.of_type = std::move(radii);
  return settings;
}

std::string study_text(const std::string& path, const readers::Survey& survey,
                       const readers::LiggghtsLog& log, const Plan& plan) {
  if (!plan.setup) throw InputError("{}", plan.stops);
  const auto& setup = *plan.setup;
  return fmt::format("title = {}\n\n", toml_text(setup.settings.label)) +
         scene_text(setup, survey, log) + products_text(setup, survey) + run_text(path, setup, log);
}

}  // namespace bedscope::app
