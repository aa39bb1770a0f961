// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "app/info_report.hpp"

namespace bedscope::app {
namespace {

constexpr std::size_t most_types = 12, most_companions = 8;

/// Lines of a label and a value; an empty label goes on with the one above.
std::string line(std::string_view label, const std::string& value) {
  return fmt::format("{:<12}{}\n", label, value);
}

std::string range_text(const readers::Range& range) {
  if (!range.any()) return "-";
  if (range.min == range.max) return fmt::format("{:.6g}", range.min);
  return fmt::format("{:.6g} to {:.6g}", range.min, range.max);
}

std::string bytes_text(double bytes) {
  constexpr std::array units{"bytes", "kB", "MB", "GB", "TB"};
  std::size_t k = 0;
  for (; bytes >= 1000 && k + 1 < units.size(); ++k) bytes /= 1000;
  return fmt::format("{:.3g} {}", bytes, units[k]);
}

std::string steps_text(const InfoReport& report) {
  const auto& steps = report.survey.steps;
  const auto& spacing = report.checkup.spacing;
  if (steps.size() == 1) return fmt::format("{}", steps.front());
  return fmt::format("{} to {}, {} {}{}", steps.front(), steps.back(),
                     spacing.even() ? "every" : "mostly every", spacing.usual,
                     spacing.gaps.empty() ? "" : fmt::format(", {} missing", spacing.missing()));
}

std::string times_text(const InfoReport& report) {
  const auto times = times_of(report);
  if (times.empty()) return "unknown: no time step in the dumps, no log.liggghts beside them";
  const auto source =
      report.survey.times.empty()
          ? fmt::format("time step {} s, {}", *report.log.time_step, report.log.path)
          : std::string("as stored in the dumps");
  if (times.size() == 1) return fmt::format("{:.6g} s ({})", times.front(), source);
  return fmt::format("{:.6g} to {:.6g} s ({})", times.front(), times.back(), source);
}

std::string solids_text(const InfoReport& report) {
  const auto end = [&](const readers::SnapshotSurvey& snapshot) {
    std::string text = fmt::format("{:.5g} m3", snapshot.volume);
    if (std::isfinite(snapshot.mass)) text += fmt::format(" ({:.5g} kg)", snapshot.mass);
    return text;
  };
  const auto& read = report.survey.read;
  if (end(read.front()) == end(read.back())) return end(read.front());
  return fmt::format("{} first, {} last", end(read.front()), end(read.back()));
}

std::string overview(const InfoReport& report) {
  const auto& [series, survey, log, checkup, plan] = report;
  std::string text =
      line("form", fmt::format("{} ({})", series.form().name, series.form().description));
  text += line("snapshots", fmt::format("{} in {} file{}", series.size(), series.files().size(),
                                        series.files().size() == 1 ? "" : "s"));
  text += line("steps", steps_text(report)) + line("times", times_text(report));
  text +=
      line("particles", survey.particles[0] == survey.particles[1]
                            ? fmt::format("{}", survey.particles[0])
                            : fmt::format("{} to {}", survey.particles[0], survey.particles[1]));
  text += line("radius", survey.has_radius ? range_text({survey.radius[0], survey.radius[1]}) + " m"
                                           : "none in the dumps");
  if (survey.has_radius && survey.has_particles) text += line("solids", solids_text(report));
  for (std::size_t axis = 0; axis < 3 && survey.has_particles; ++axis) {
    auto value = fmt::format("centres {:.6g} to {:.6g} m", survey.min[axis], survey.max[axis]);
    if (survey.box.known)
      value += fmt::format(", box {:.6g} to {:.6g} m{}", survey.box.min[axis], survey.box.max[axis],
                           survey.box.periodic[axis] ? ", periodic" : "");
    text += line(std::string(1, "xyz"[axis]), value);
  }
  if (survey.fastest > 0) text += line("speed", fmt::format("up to {:.4g} m/s", survey.fastest));
  return text;
}

std::string remark(const readers::ColumnSurvey& column) {
  std::string text;
  const auto add = [&](const std::string& what) {
    if (!text.empty()) text += ", ";
    text += what;
  };
  if (column.not_finite > 0)
    add(fmt::format("{} not finite, first: {}", column.not_finite, column.first_not_finite));
  if (column.constant())
    add("constant");
  else if (column.zeros > 0)
    add(fmt::format("{} zero", column.zeros));
  return text;
}

std::string columns_text(const InfoReport& report) {
  const auto& survey = report.survey;
  std::size_t width = 10;
  for (const auto& column : survey.columns) width = std::max(width, column.name.size());
  std::string text = fmt::format(
      "\ncolumns, over {} of {} snapshots{}\n", survey.snapshots_read, report.series.size(),
      survey.snapshots_read < report.series.size() ? " (--full reads all)" : "");
  text += fmt::format("  {:<{}}  {:>12}  {:>12}  {:>12}\n", "", width, "min", "max", "mean");
  for (const auto& column : survey.columns) {
    if (column.range.any())
      text += fmt::format("  {:<{}}  {:>12.6g}  {:>12.6g}  {:>12.6g}", column.name, width,
                          column.range.min, column.range.max, column.mean());
    else
      text += fmt::format("  {:<{}}  {:>12}  {:>12}  {:>12}", column.name, width, "-", "-", "-");
    const auto said = remark(column);
    text += said.empty() ? "\n" : "  " + said + "\n";
  }
  for (const auto& name : report.series.columns())
    if (readers::holds_text(name)) text += fmt::format("  {:<{}}  text, not read\n", name, width);
  return text;
}

std::string species_text(const readers::Survey& survey) {
  if (survey.types.empty()) return {};
  bool has_mass = false, has_density = false;
  for (const auto& [type, found] : survey.types) {
    has_mass = has_mass || found.mass.any();
    has_density = has_density || found.density.any() || found.implied_density.any();
  }
  const auto row = [&](const std::string& type, const std::string& share, const std::string& radius,
                       const std::string& mass, const std::string& density) {
    auto text = fmt::format("  {:<6}{:>10}  {:<26}", type, share, radius);
    if (has_mass) text += fmt::format("{:<28}", mass);
    if (has_density) text += density;
    return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
  };
  std::string text = "\n";
  text += row("types", "particles", "radius [m]", "mass [kg]", "density [kg/m3]");
  std::size_t shown = 0;
  for (const auto& [type, found] : survey.types) {
    if (++shown > most_types) break;
    text += row(fmt::format("{}", type),
                fmt::format("{:.6g}", static_cast<double>(found.particles) /
                                          static_cast<double>(survey.snapshots_read)),
                range_text(found.radius), range_text(found.mass),
                range_text(found.density.any() ? found.density : found.implied_density));
  }
  if (survey.types.size() > most_types)
    text += fmt::format("  and {} more\n", survey.types.size() - most_types);
  return text;
}

std::string log_text(const readers::LiggghtsLog& log) {
  if (log.path.empty()) return {};
  std::string text =
      fmt::format("\nlog {}{}\n", log.path, log.version.empty() ? "" : ", " + log.version);
  const auto add = [&](std::string_view label, const std::string& value) {
    text += fmt::format("  {:<10}{}\n", label, value);
  };
  if (log.time_step)
    add("time step",
        fmt::format("{} s{}", *log.time_step, log.units.empty() ? "" : ", units " + log.units));
  std::string material;
  for (const auto& [type, density] : log.density) {
    const auto radius = log.radius.find(type);
    material += fmt::format(
        "{}type {}: {} kg/m3{}", material.empty() ? "" : "; ", type, density,
        radius == log.radius.end()
            ? ""
            : fmt::format(", radius {} m", range_text({radius->second[0], radius->second[1]})));
  }
  if (!material.empty()) add("particles", material);
  for (const auto& [name, unit] : {std::pair{"youngsModulus", "Pa"}, {"kn", "N/m"}})
    if (const auto found = log.properties.find(name); found != log.properties.end())
      add(name == std::string("kn") ? "kn" : "modulus",
          fmt::format("{} {}", fmt::join(found->second, ", "), unit));
  if (log.gravity)
    add("gravity", fmt::format("{:.4g}, {:.4g}, {:.4g} m/s2", (*log.gravity)[0], (*log.gravity)[1],
                               (*log.gravity)[2]));
  if (log.last_step)
    add("run", fmt::format("to step {}, {}", *log.last_step, log.ended ? "ended" : "not ended"));
  return text;
}

std::string plan_text(const Plan& plan, bool from_box) {
  std::string text = "\nanalyse would";
  if (!plan.setup) return fmt::format("{} stop: {}\n", text, plan.stops);
  const auto& setup = *plan.setup;
  const auto& grid = setup.grid;
  text += fmt::format(" read {} and need about {} of memory\n",
                      bytes_text(static_cast<double>(plan.bytes)), bytes_text(plan.memory));
  const auto add = [&](std::string_view label, const std::string& value) {
    text += fmt::format("  {:<10}{}\n", label, value);
  };
  add("domain",
      fmt::format("{:.6g} x {:.6g} x {:.6g} m (lateral, depth, up), {}", grid.length(0),
                  grid.length(1), grid.length(2),
                  from_box ? "the box of the first dump" : "the extent of the first snapshot"));
  add("grid", fmt::format("{} x {} cells of {:.4g} x {:.4g} m", grid.cells[analysis::lateral],
                          grid.cells[analysis::up], grid.width(analysis::lateral),
                          grid.width(analysis::up)));
  add("times", plan.time);
  add("density", plan.density);
  add("window", "auto");
  add("products", fmt::format("{}", fmt::join(plan.products, ", ")));
  return text + "  bedscope info PATH --study writes a study file to begin with\n";
}

std::string findings_text(const InfoReport& report) {
  std::string text;
  if (const auto companions = companions_of(report.series.left_out()); !companions.empty()) {
    text += "\nother files, left out\n";
    for (std::size_t k = 0; k < std::min(companions.size(), most_companions); ++k)
      text += fmt::format(
          "  {:>5} {}, {}\n", companions[k].files, companions[k].what,
          companions[k].files == 1 ? companions[k].first : "such as " + companions[k].first);
    if (companions.size() > most_companions)
      text += fmt::format("  and {} more kinds\n", companions.size() - most_companions);
  }
  const auto& how_read = report.series.notes();
  if (!report.checkup.notes.empty() || !how_read.empty()) text += "\nworth knowing\n";
  for (const auto& note : how_read) text += fmt::format("  - {}\n", note);
  for (const auto& note : report.checkup.notes) text += fmt::format("  - {}\n", note.text);
  const auto& survey = report.survey;
  if (survey.problems.empty() && report.checkup.problems.empty())
    return text + "\nno problems found\n";
  text += "\nproblems\n";
  for (const auto& problem : survey.problems) text += fmt::format("  - {}\n", problem);
  for (const auto& problem : report.checkup.problems) text += fmt::format("  - {}\n", problem.text);
  return text;
}

}  // namespace

std::vector<double> times_of(const InfoReport& report) {
  const auto& survey = report.survey;
  if (!survey.times.empty() || !report.log.time_step) return survey.times;
  std::vector<double> times;
  for (const auto step : survey.steps)
    times.push_back(static_cast<double>(step) * *report.log.time_step);
  return times;
}

std::vector<Companions> companions_of(const std::vector<std::string>& left_out) {
  std::map<std::string, Companions> kinds;  // numbers put aside: "64 polygons"
  for (const auto& text : left_out) {
    const auto name_begin = text.rfind('/', text.find(": ")) + 1;
    const auto name_end = std::min(text.find(": ", name_begin), text.size());
    const auto what = name_end + 2 < text.size() ? text.substr(name_end + 2) : std::string("?");
    std::string kind;
    for (const char c : what)
      if (c < '0' || c > '9') kind += c;
    auto& found = kinds.try_emplace(kind, Companions{what, 0, ""}).first->second;
    const auto name = text.substr(name_begin, name_end - name_begin);
    if (found.files++ == 0) found.first = name;
  }
  std::vector<Companions> sorted;
  for (auto& [kind, found] : kinds) sorted.push_back(std::move(found));
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Companions& a, const Companions& b) { return a.files > b.files; });
  return sorted;
}

std::string info_text(const InfoReport& report) {
  auto text = overview(report) + columns_text(report) + species_text(report.survey) +
              log_text(report.log) + plan_text(report.plan, report.survey.box.known) +
              findings_text(report);
  std::error_code ignored;
  const auto here = std::filesystem::current_path(ignored).string() + "/";
  for (auto at = text.find(here); at != text.npos && here.size() > 1; at = text.find(here, at))
    text.erase(at, here.size());  // files below the current folder by the path from there
  return text;
}

}  // namespace bedscope::app
