// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/info_report.hpp"

namespace bedscope::app {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json range(const readers::Range& values) {
  if (!values.any()) return nullptr;
  return {{"min", values.min}, {"max", values.max}};
}

Json spacing(const readers::StepSpacing& found) {
  Json json{{"usual", found.usual}, {"even", found.even()}, {"missing", found.missing()}};
  json["gaps"] = Json::array();
  for (const auto& gap : found.gaps)
    json["gaps"].push_back(
        {{"before", gap.before}, {"after", gap.after}, {"missing", gap.missing()}});
  json["changes"] = Json::array();
  for (const auto& change : found.changes)
    json["changes"].push_back({{"step", change.step}, {"from", change.from}, {"to", change.to}});
  json["irregular"] = found.irregular;
  return json;
}

Json trend(const std::optional<readers::Trend>& found) {
  if (!found) return nullptr;
  return {{"change", found->change}, {"ci99", found->ci99}, {"significant", found->significant()}};
}

Json inventory(const InfoReport& report) {
  const auto& survey = report.survey;
  if (survey.read.empty()) return nullptr;  // dumps that name no columns
  const auto ends = [&](const readers::SnapshotSurvey& snapshot) {
    return Json{{"step", survey.steps[snapshot.index]},
                {"particles", survey.counts[snapshot.index]},
                {"volume", number(snapshot.volume)},
                {"mass", number(snapshot.mass)},
                {"holdup_of_box", number(snapshot.holdup)}};
  };
  return {{"first", ends(survey.read.front())},
          {"last", ends(survey.read.back())},
          {"particles_trend", trend(report.checkup.particles)},
          {"volume_trend", trend(report.checkup.volume)}};
}

Json columns(const readers::Survey& survey) {
  Json list = Json::array();
  for (const auto& column : survey.columns) {
    Json item{{"name", column.name},
              {"min", column.range.any() ? Json(column.range.min) : Json(nullptr)},
              {"max", column.range.any() ? Json(column.range.max) : Json(nullptr)},
              {"mean", number(column.mean())},
              {"zeros", column.zeros},
              {"not_finite", column.not_finite},
              {"constant", column.constant()}};
    if (column.not_finite > 0) item["first_not_finite"] = column.first_not_finite;
    list.push_back(std::move(item));
  }
  return list;
}

Json species(const readers::Survey& survey) {
  Json list = Json::array();
  for (const auto& [type, found] : survey.types)
    list.push_back({{"type", type},
                    {"particles", found.particles},
                    {"radius", range(found.radius)},
                    {"mass", range(found.mass)},
                    {"density", range(found.density)},
                    {"implied_density", range(found.implied_density)}});
  return list;
}

Json log(const readers::LiggghtsLog& found) {
  if (found.path.empty()) return nullptr;
  Json json{{"path", found.path}, {"version", found.version}, {"units", found.units}};
  json["time_step"] = found.time_step ? Json(*found.time_step) : Json(nullptr);
  json["density"] = Json::object();
  for (const auto& [type, density] : found.density) json["density"][std::to_string(type)] = density;
  json["radius"] = Json::object();
  for (const auto& [type, radius] : found.radius) json["radius"][std::to_string(type)] = radius;
  json["gravity"] = found.gravity ? Json(*found.gravity) : Json(nullptr);
  json["properties"] = found.properties;
  json["last_step"] = found.last_step ? Json(*found.last_step) : Json(nullptr);
  json["ended"] = found.ended;
  json["warnings"] = found.warnings.count;
  json["errors"] = found.errors.count;
  return json;
}

Json plan(const Plan& planned) {
  Json json{{"bytes", planned.bytes}};
  if (!planned.setup) {
    json["stops"] = planned.stops;
    return json;
  }
  const auto& setup = *planned.setup;
  json["domain"] = {{"min", setup.grid.min}, {"max", setup.grid.max}};
  json["cells"] = setup.grid.cells;
  json["density"] = planned.density;
  json["time"] = planned.time;
  json["products"] = planned.products;
  json["memory"] = planned.memory;
  json["remarks"] = setup.problems;
  return json;
}

Json texts(const std::vector<readers::Finding>& findings) {
  Json list = Json::array();
  for (const auto& finding : findings) list.push_back(finding.text);
  return list;
}

}  // namespace

std::string info_json(const InfoReport& report) {
  const auto& [series, survey, log_found, checkup, planned] = report;
  Json json;
  json["form"] = series.form().name;
  json["snapshots"] = series.size();
  json["steps"] = survey.steps;
  if (const auto times = times_of(report); !times.empty()) json["times"] = times;
  json["particles"] = {{"min", survey.particles[0]}, {"max", survey.particles[1]}};
  json["columns"] = series.columns();
  json["types"] = Json::array();
  for (const auto& [type, found] : survey.types) json["types"].push_back(type);
  json["radius"] = survey.has_radius ? Json{{"min", survey.radius[0]}, {"max", survey.radius[1]}}
                                     : Json(nullptr);
  json["bounds"] =
      survey.has_particles ? Json{{"min", survey.min}, {"max", survey.max}} : Json(nullptr);
  if (survey.box.known) {
    json["box"] = {{"min", survey.box.min}, {"max", survey.box.max}};
    json["periodic"] = Json::array();
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (survey.box.periodic[axis]) json["periodic"].push_back(std::string(1, "xyz"[axis]));
  }
  json["snapshots_read"] = survey.snapshots_read;
  json["problems"] = survey.problems;
  for (auto& text : texts(checkup.problems)) json["problems"].push_back(std::move(text));
  json["notes"] = series.notes();
  for (auto& text : texts(checkup.notes)) json["notes"].push_back(std::move(text));
  json["spacing"] = spacing(checkup.spacing);
  json["column_ranges"] = columns(survey);
  json["species"] = species(survey);
  json["inventory"] = inventory(report);
  json["fastest"] = survey.fastest;
  if (survey.overlap.tested) json["deepest_overlap"] = survey.overlap.found.deepest;
  json["log"] = log(log_found);
  json["analyse"] = plan(planned);
  json["left_out"] = series.left_out();
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace bedscope::app
