// SPDX-License-Identifier: BSD-3-Clause
// bedscope info: what is on disk.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/info_case.hpp"
#include "readers/series.hpp"
#include "readers/survey.hpp"

namespace bedscope::app {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  Common common;
  std::string path;
  bool full = false;
};

Json to_json(const readers::Series& series, const readers::Survey& survey) {
  Json json;
  json["form"] = series.form().name;
  json["snapshots"] = series.size();
  json["steps"] = Json::array();
  for (std::size_t i = 0; i < series.size(); ++i) json["steps"].push_back(series.step(i));
  json["particles"] = {{"min", survey.particles[0]}, {"max", survey.particles[1]}};
  json["columns"] = series.columns();
  json["types"] = Json::array();
  for (const auto& [type, count] : survey.types) json["types"].push_back(type);
  if (survey.has_radius)
    json["radius"] = {{"min", survey.radius[0]}, {"max", survey.radius[1]}};
  else
    json["radius"] = nullptr;
  if (survey.has_particles)
    json["bounds"] = {{"min", survey.min}, {"max", survey.max}};
  else
    json["bounds"] = nullptr;
  if (const auto& box = series.located(0).box; box.known) {
    json["box"] = {{"min", box.min}, {"max", box.max}};
    json["periodic"] = Json::array();
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (box.periodic[axis]) json["periodic"].push_back(std::string(1, "xyz"[axis]));
  }
  json["snapshots_read"] = survey.snapshots_read;
  json["problems"] = survey.problems;
  json["left_out"] = series.left_out();
  return json;
}

void print(const readers::Series& series, const readers::Survey& survey) {
  fmt::print("{:<12}{} ({})\n", "form", series.form().name, series.form().description);
  fmt::print("{:<12}{}, steps {} to {}\n", "snapshots", series.size(), series.step(0),
             series.step(series.size() - 1));
  fmt::print("{:<12}{} to {}\n", "particles", survey.particles[0], survey.particles[1]);
  fmt::print("{:<12}{}\n", "columns", fmt::join(series.columns(), " "));
  std::string types;
  for (const auto& [type, count] : survey.types) types += fmt::format("{} ", type);
  if (!types.empty()) fmt::print("{:<12}{}\n", "types", types);
  if (survey.has_radius)
    fmt::print("{:<12}{:.6g} to {:.6g} m\n", "radius", survey.radius[0], survey.radius[1]);
  else
    fmt::print("{:<12}none in the dumps\n", "radius");
  if (survey.has_particles)
    for (std::size_t axis = 0; axis < 3; ++axis)
      fmt::print("{:<12}{:.6g} to {:.6g} m\n", fmt::format("{} centres", "xyz"[axis]),
                 survey.min[axis], survey.max[axis]);
  if (const auto& box = series.located(0).box; box.known)
    for (std::size_t axis = 0; axis < 3; ++axis)
      fmt::print("{:<12}{:.6g} to {:.6g} m{}\n", fmt::format("{} box", "xyz"[axis]), box.min[axis],
                 box.max[axis], box.periodic[axis] ? ", periodic" : "");
  if (survey.snapshots_read < series.size())
    fmt::print("rows of {} of {} snapshots read; --full reads all\n", survey.snapshots_read,
               series.size());
  for (const auto& file : series.left_out()) fmt::print("left out: {}\n", file);
  for (const auto& problem : survey.problems) fmt::print("problem: {}\n", problem);
}

void run(const Options& options) {
  if (info_openfoam(options.path, options.full, options.common.json)) return;
  const auto series = readers::Series::open(options.path);
  const bool one_file = series.files().size() == 1;
  const auto survey = readers::survey(series, options.full || one_file);
  if (options.common.json)
    fmt::print("{}\n", to_json(series, survey).dump(2, ' ', false, Json::error_handler_t::replace));
  else
    print(series, survey);
}

}  // namespace

void add_info(CLI::App& app) {
  auto options = std::make_shared<Options>();
  auto* command =
      app.add_subcommand("info", "what is on disk: form, steps, columns, ranges, problems");
  command
      ->add_option("path", options->path,
                   "a dump, a folder of dumps, a pattern, or an OpenFOAM case")
      ->required();
  command->add_flag("--full", options->full, "read the rows of every snapshot");
  add_common(*command, options->common);
  command->callback([options] { run(*options); });
}

}  // namespace bedscope::app
