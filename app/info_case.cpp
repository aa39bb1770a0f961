// SPDX-License-Identifier: BSD-3-Clause
#include "app/info_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "readers/error.hpp"
#include "readers/openfoam_file.hpp"
#include "readers/openfoam_survey.hpp"
#include "readers/survey.hpp"
#include "readers/vtk_gas.hpp"

namespace bedscope::app {
namespace {

using Json = nlohmann::ordered_json;
using readers::FoamRange;

// What stands for one region of a case.
struct Region {
  std::string name;  // empty: the default one
  std::string form, layout;
  std::size_t ranks = 1;
  bool moving = false;
  std::shared_ptr<const readers::GasForm> gas;
  readers::FoamSurvey survey;
};

Json range(const FoamRange& of, bool with_mean = false) {
  if (of.empty()) return nullptr;
  Json json{{"min", of.min}, {"max", of.max}};
  if (with_mean) json["mean"] = of.mean();
  return json;
}

Json ranges(const std::vector<FoamRange>& components) {
  Json json = Json::array();
  for (const auto& component : components) json.push_back(range(component, true));
  return json;
}

Json bounds(const FoamRange& x, const FoamRange& y, const FoamRange& z) {
  if (x.empty()) return nullptr;
  return {{"min", {x.min, y.min, z.min}}, {"max", {x.max, y.max, z.max}}};
}

Json dimensions(const std::array<double, 7>& powers, bool known) {
  return known ? Json(powers) : Json(nullptr);
}

std::string mesh_kind(const readers::Mesh& mesh) {
  if (!mesh.boxes) return "general";
  return mesh.boxes->rectilinear ? "rectilinear" : "boxes";
}

std::string layout(const readers::OpenFoamCase& foam) {
  return foam.collated() ? "collated" : foam.ranks() > 1 ? "decomposed" : "reconstructed";
}

Json to_json(const readers::FoamFieldSurvey& field) {
  Json json;
  json["name"] = field.name;
  json["class"] = field.class_name;
  json["dimensions"] = dimensions(field.dimensions, field.dimensions_known);
  if (field.kinematic_pressure()) json["kinematic"] = true;
  json["times"] = field.times;
  json["times_read"] = field.times_read;
  json["times_uniform"] = field.times_uniform;
  json["ranges"] = ranges(field.ranges);
  json["non_finite"] = field.non_finite;
  return json;
}

Json to_json(const readers::FoamCloudSurvey& cloud) {
  Json json;
  json["name"] = cloud.name;
  json["times"] = cloud.times;
  json["particles"] = {{"min", cloud.parcels[0]}, {"max", cloud.parcels[1]}};
  json["columns"] = cloud.columns;
  json["radius"] = range(cloud.radius);
  json["particles_a_parcel"] = range(cloud.particles);
  json["bounds"] = bounds(cloud.centres[0], cloud.centres[1], cloud.centres[2]);
  return json;
}

Json to_json(const Region& region) {
  const auto& survey = region.survey;
  const auto start = region.gas->mesh_at(0);
  const auto& mesh = *start;
  Json json;
  json["form"] = region.form;
  json["region"] = region.name;
  json["format"] = survey.format;
  json["layout"] = region.layout;
  json["ranks"] = region.ranks;
  json["snapshots"] = region.gas->times().size();
  json["times"] = Json::array();
  for (const auto& time : region.gas->times()) json["times"].push_back(time.time);
  json["cells"] = mesh.cells();
  json["columns"] = Json::array();
  for (const auto& field : survey.fields) json["columns"].push_back(field.name);
  json["bounds"] = {{"min", mesh.min}, {"max", mesh.max}};
  json["mesh"] = {{"kind", mesh_kind(mesh)}, {"volume", mesh.volume()}, {"moving", region.moving}};
  if (mesh.boxes && mesh.boxes->rectilinear)
    for (const auto& planes : mesh.boxes->faces) json["mesh"]["grid"].push_back(planes.size() - 1);
  json["mesh"]["patches"] = Json::array();
  for (const auto& patch : mesh.patches)
    json["mesh"]["patches"].push_back(
        {{"name", patch.name}, {"type", patch.type}, {"faces", patch.faces}});
  json["fields"] = Json::array();
  for (const auto& field : survey.fields) json["fields"].push_back(to_json(field));
  json["clouds"] = Json::array();
  for (const auto& cloud : survey.clouds) json["clouds"].push_back(to_json(cloud));
  if (survey.clouds.size() == 1) {
    json["particles"] = json["clouds"][0]["particles"];
    json["radius"] = json["clouds"][0]["radius"];
  }
  json["snapshots_read"] = survey.times_read;
  json["problems"] = survey.problems;
  return json;
}

void line(std::string_view what, const std::string& text) { fmt::print("{:<12}{}\n", what, text); }

std::string shown(const std::vector<FoamRange>& components) {
  std::string text;
  for (const auto& one : components) {
    if (!text.empty()) text += ", ";
    text += one.empty() ? "nothing finite"
            : one.min == one.max
                ? fmt::format("{:.6g}", one.min)
                : fmt::format("{:.6g} to {:.6g} (mean {:.6g})", one.min, one.max, one.mean());
  }
  return text;
}

std::string unit(const std::array<double, 7>& powers, bool known) {
  if (!known) return "[?]";
  static constexpr std::array names{"kg", "m", "s", "K", "mol", "A", "cd"};
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (powers[k] != 0)
      text += fmt::format("{}{}{}", text.empty() ? "" : " ", names[k],
                          powers[k] == 1 ? "" : fmt::format("{}", powers[k]));
  return fmt::format("[{}]", text.empty() ? "-" : text);
}

void print(const readers::FoamFieldSurvey& field, std::size_t times) {
  std::string notes;
  if (field.times < times) notes += fmt::format("; at {} of {} times", field.times, times);
  if (field.times_uniform > 0)
    notes += field.times_uniform == field.times_read
                 ? "; uniform"
                 : fmt::format("; uniform at {} of {} times read", field.times_uniform,
                               field.times_read);
  if (field.kinematic_pressure()) notes += "; kinematic: pressure over density";
  fmt::print("  {} ({}) {}: {}{}\n", field.name, field.class_name,
             unit(field.dimensions, field.dimensions_known), shown(field.ranges), notes);
}

void print(const readers::FoamCloudSurvey& cloud) {
  line("cloud", fmt::format("{}: {} to {} parcels at {} times", cloud.name, cloud.parcels[0],
                            cloud.parcels[1], cloud.times));
  fmt::print("  columns {}\n", fmt::join(cloud.columns, " "));
  if (!cloud.radius.empty())
    fmt::print("  d {:.6g} to {:.6g} m\n", 2 * cloud.radius.min, 2 * cloud.radius.max);
  if (!cloud.particles.empty() && (cloud.particles.min != 1 || cloud.particles.max != 1))
    fmt::print("  a parcel stands for {:.6g} to {:.6g} particles\n", cloud.particles.min,
               cloud.particles.max);
  for (std::size_t k = 0; k < 3 && !cloud.centres[k].empty(); ++k)
    fmt::print("  {} {:.6g} to {:.6g} m\n", "xyz"[k], cloud.centres[k].min, cloud.centres[k].max);
}

void print_mesh(const readers::Mesh& mesh, bool moving) {
  std::string kind = mesh.boxes ? "boxes, refined in places" : "general";
  if (mesh.boxes && mesh.boxes->rectilinear)
    kind = fmt::format("box grid of {} x {} x {}", mesh.boxes->faces[0].size() - 1,
                       mesh.boxes->faces[1].size() - 1, mesh.boxes->faces[2].size() - 1);
  line("cells", fmt::format("{}, {}, {:.6g} m3{}", mesh.cells(), kind, mesh.volume(),
                            moving ? ", moving (first time shown)" : ""));
  for (std::size_t axis = 0; axis < 3; ++axis)
    line(fmt::format("{} mesh", "xyz"[axis]),
         fmt::format("{:.6g} to {:.6g} m", mesh.min[axis], mesh.max[axis]));
  std::string patches;
  for (const auto& patch : mesh.patches)
    patches += fmt::format("{}{} ({}, {} faces)", patches.empty() ? "" : ", ", patch.name,
                           patch.type, patch.faces);
  if (!patches.empty()) line("patches", patches);
}

void print(const Region& region) {
  const auto& survey = region.survey;
  const auto& all = region.gas->times();
  const auto times = all.size();
  line("form", fmt::format("{} ({}{}{})", region.form, survey.format,
                           survey.format.empty() ? "" : ", ", region.layout));
  if (!region.name.empty()) line("region", region.name);
  if (region.ranks > 1) line("ranks", std::to_string(region.ranks));
  line("times", fmt::format("{}, {:.6g} to {:.6g} s", times, all.front().time, all.back().time));
  print_mesh(*region.gas->mesh_at(0), region.moving);
  line("fields", std::to_string(survey.fields.size()));
  for (const auto& field : survey.fields) print(field, times);
  for (const auto& cloud : survey.clouds) print(cloud);
  if (survey.times_read < times)
    fmt::print("values of {} of {} times read; --full reads all\n", survey.times_read, times);
  for (const auto& problem : survey.problems) fmt::print("problem: {}\n", problem);
}

void print(const std::vector<Region>& regions, bool json) {
  if (!json) {
    for (const auto& region : regions) print(region);
    return;
  }
  auto whole = to_json(regions.front());
  for (std::size_t k = 1; k < regions.size(); ++k)
    whole["other_regions"].push_back(to_json(regions[k]));
  fmt::print("{}\n", whole.dump(2, ' ', false, Json::error_handler_t::replace));
}

std::vector<Region> regions_of_case(const std::string& path, bool full) {
  std::vector<Region> regions;
  for (auto& name : readers::openfoam_regions(path)) {
    readers::OpenFoamOptions options;
    options.region = name;
    const auto foam =
        std::make_shared<const readers::OpenFoamCase>(readers::OpenFoamCase::open(path, options));
    regions.push_back({std::move(name), "openfoam-case", layout(*foam), foam->ranks(),
                       foam->moving(), foam, readers::survey(*foam, full)});
  }
  return regions;
}

Region region_of_vtk(const std::string& path, bool full) {
  const auto gas = readers::open_vtk_gas(path);
  bool moving = false;  // as far as the times tell that are read anyway
  for (const auto time : readers::chosen_snapshots(gas->times().size(), full))
    moving = moving || gas->mesh_at(time) != gas->mesh_at(0);
  return {"", "vtk-gas", "cells of VTK files", 1, moving, gas, readers::survey(*gas, full)};
}

std::string file_form(const readers::FoamFileSummary& file) {
  if (file.what == "parcels") return "openfoam-cloud-positions";
  if (file.what == "cells" || file.dimensions_known) return "openfoam-field";
  return "openfoam-file";
}

void info_file(const std::string& path, bool json) {
  const auto file = readers::summarise_openfoam_file(path);
  const auto format = fmt::format("{}{}{}", file.binary ? "binary" : "ascii",
                                  file.compressed ? " gz" : "", file.collated ? ", collated" : "");
  const auto name = std::filesystem::path(path).filename().string();
  if (!json) {
    line("form", fmt::format("{} ({})", file_form(file), format));
    line("class", file.class_name);
    if (file.count) line("holds", fmt::format("{} {}", *file.count, file.what));
    if (file.uniform) line("uniform", "one value");
    if (file.dimensions_known) line("unit", unit(file.dimensions, true));
    if (!file.ranges.empty()) line("values", shown(file.ranges));
    for (const auto& problem : file.problems) fmt::print("problem: {}\n", problem);
    return;
  }
  Json whole;
  whole["form"] = file_form(file);
  whole["class"] = file.class_name;
  whole["format"] = format;
  whole["arch"] = file.arch;
  whole["snapshots"] = 1;
  whole["columns"] = {name};
  const Json count = file.count ? Json(*file.count) : Json(nullptr);
  if (file.what == "parcels") {
    whole["columns"] = {"x", "y", "z"};
    whole["particles"] = {{"min", count}, {"max", count}};
  } else {
    whole[file.what == "cells" ? "cells" : "values"] = count;
  }
  whole["what"] = file.what;
  whole["blocks"] = file.blocks;
  whole["uniform"] = file.uniform;
  whole["dimensions"] = dimensions(file.dimensions, file.dimensions_known);
  whole["ranges"] = ranges(file.ranges);
  whole["non_finite"] = file.non_finite;
  const bool places = file.ranges.size() == 3 && (file.what == "parcels" || file.what == "points");
  whole["bounds"] = places ? bounds(file.ranges[0], file.ranges[1], file.ranges[2]) : Json(nullptr);
  whole["problems"] = file.problems;
  fmt::print("{}\n", whole.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace

bool info_openfoam(const std::string& path, bool full, bool json) {
  std::error_code error;
  if (!readers::openfoam_regions(path).empty())  // a case without a mesh may hold particles
    print(regions_of_case(path, full), json);
  else if (std::filesystem::is_regular_file(path, error) && readers::is_openfoam_file(path))
    info_file(path, json);
  else if (readers::is_vtk_gas(path))
    print({region_of_vtk(path, full)}, json);
  else
    return false;
  return true;
}

}  // namespace bedscope::app
