// SPDX-License-Identifier: BSD-3-Clause
#include "app/case_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace bedscope::app {
namespace {

using Json = nlohmann::ordered_json;
using cases::Scene;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string dumped(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json particles_json(const Scene& scene) {
  Json list = Json::array();
  const auto numbers = cases::species_numbers(scene);
  for (std::size_t i = 0; i < scene.species.size(); ++i) {
    const auto& s = scene.species[i];
    list.push_back({{"type", i + 1},
                    {"name", s.name},
                    {"diameter", s.diameter},
                    {"density", s.density},
                    {"number", numbers[i]}});
  }
  return list;
}

std::string value_text(double value, const std::string& unit) {
  if (std::isnan(value)) return unit;  // a letter
  return fmt::format("{:.5g}{}", value, unit == "-" ? "" : " " + unit);
}

}  // namespace

std::string scale_json(const Scene& scaled, const cases::ScalingReport& report) {
  Json json;
  json["title"] = scaled.title;
  json["particles"] = particles_json(scaled);
  if (scaled.gas) json["gas_viscosity"] = scaled.gas->viscosity;
  json["gravity"] = scaled.gravity;
  const auto& c = scaled.contacts;
  if (c.model == cases::ContactModel::linear) {
    json["normal_stiffness"] = c.particle.normal_stiffness;
    json["tangential_stiffness"] = c.particle.tangential_stiffness();
    json["wall_normal_stiffness"] = c.wall.normal_stiffness;
    json["wall_tangential_stiffness"] = c.wall.tangential_stiffness();
  } else {
    json["young"] = c.particle.young;
  }
  json["grid"] = scaled.numerics.grid;
  json["cells_by_rule"] = report.cells_by_rule;
  json["depth"] = scaled.geometry.depth;
  json["holdup"] = cases::mean_holdup(scaled);
  json["kept"] = Json::object();
  json["not_kept"] = Json::object();
  json["groups"] = Json::array();
  for (const auto& g : report.groups) {
    json[g.kept ? "kept" : "not_kept"][g.name] = g.ratio;
    json["groups"].push_back({{"name", g.name},
                              {"definition", g.definition},
                              {"before", g.before},
                              {"after", g.after},
                              {"ratio", g.ratio},
                              {"kept", g.kept}});
  }
  json["remarks"] = report.remarks;
  return dumped(json);
}

std::string scale_text(const Scene& scaled, const cases::ScalingReport& report) {
  auto text = scaled.title + "\n";
  const auto numbers = cases::species_numbers(scaled);
  for (std::size_t i = 0; i < scaled.species.size(); ++i)
    text += fmt::format("  {} particles of {:.6g} mm ({})\n", numbers[i],
                        1e3 * scaled.species[i].diameter, scaled.species[i].name);
  if (scaled.gas) text += fmt::format("  gas viscosity {:.6g} Pa s\n", scaled.gas->viscosity);
  text += fmt::format("  gravity {:.6g} m/s2\n", scaled.gravity);
  if (scaled.contacts.model == cases::ContactModel::linear)
    text += fmt::format("  stiffness {:.6g} N/m, tangential {:.6g} N/m, at walls {:.6g} N/m\n",
                        scaled.contacts.particle.normal_stiffness,
                        scaled.contacts.particle.tangential_stiffness(),
                        scaled.contacts.wall.tangential_stiffness());
  const auto& n = scaled.numerics.grid;
  text += fmt::format("  depth {:.6g} mm, grid {} x {} x {}\n", 1e3 * scaled.geometry.depth, n[0],
                      n[1], n[2]);
  for (const bool kept : {true, false}) {
    text += kept ? "kept\n" : "not kept\n";
    for (const auto& g : report.groups)
      if (g.kept == kept)
        text += fmt::format("  {:<30} x {:<9.6g} {:.5g} -> {:.5g}  ({})\n", g.name, g.ratio,
                            g.before, g.after, g.definition);
  }
  for (const auto& remark : report.remarks) text += "note: " + remark + "\n";
  return text;
}

std::string check_json(const Scene& scene, const cases::CheckReport& report,
                       const std::vector<std::string>& remarks) {
  Json json;
  json["title"] = scene.title;
  json["notes"] = scene.notes;
  json["numbers"] = Json::object();
  json["units"] = Json::object();
  for (const auto& n : report.numbers)
    if (std::isnan(n.value)) {
      json["numbers"][n.name] = n.unit;
    } else {
      json["numbers"][n.name] = number(n.value);
      json["units"][n.name] = n.unit;
    }
  json["limits"] = Json::array();
  for (const auto& l : report.limits)
    json["limits"].push_back({{"name", l.name},
                              {"value", number(l.value)},
                              {"limit", l.limit},
                              {"margin", number(l.margin)},
                              {"ok", l.ok},
                              {"must", l.must},
                              {"unit", l.unit},
                              {"rule", l.rule}});
  json["advice"] = Json::array();
  for (const auto& a : report.advice)
    json["advice"].push_back({{"model", a.model}, {"needed", a.needed}, {"reason", a.reason}});
  json["remarks"] = remarks;
  return dumped(json);
}

std::string check_text(const Scene& scene, const cases::CheckReport& report,
                       const std::vector<std::string>& remarks) {
  auto text = scene.title + "\n";
  for (const auto& note : scene.notes) text += "note: " + note + "\n";
  for (const auto& remark : remarks) text += "note: " + remark + "\n";
  text += "numbers\n";
  for (const auto& n : report.numbers)
    text += fmt::format("  {:<38} {}\n", n.name, value_text(n.value, n.unit));
  text += "limits\n";
  for (const auto& l : report.limits)
    text += fmt::format("  {:<8} {:<46} {} (limit {}, margin {:.3g})\n           {}\n",
                        l.ok     ? "ok"
                        : l.must ? "REFUSED"
                                 : "beyond",
                        l.name, value_text(l.value, l.unit), value_text(l.limit, l.unit), l.margin,
                        l.rule);
  text += "models\n";
  for (const auto& a : report.advice)
    text += fmt::format("  {:<10} {}: {}\n", a.needed ? "needed" : "not needed", a.model, a.reason);
  return text;
}

}  // namespace bedscope::app
