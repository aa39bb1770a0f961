// SPDX-License-Identifier: BSD-3-Clause
// bedscope curves: the reference curves at hand, and what is known of them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "readers/error.hpp"
#include "validation/curves.hpp"
#include "validation/theory.hpp"

namespace bedscope::app {
namespace {

using Json = nlohmann::ordered_json;
using validation::Curve;
using validation::Curves;
using validation::CurveSet;

struct Options {
  Common common;
  std::string name;
  std::vector<std::string> folders;
};

Json to_json(const CurveSet& set) {
  Json json;
  json["name"] = set.name;
  json["title"] = set.about.title;
  json["kind"] = set.about.kind;
  json["method"] = set.about.method;
  json["citation"] = set.about.citation;
  json["abscissa"] = set.x.text();
  json["ordinate"] = set.y.text();
  json["points"] = set.points;
  json["available"] = set.available;
  for (const auto& parameter : set.parameters)
    json["parameters"][parameter.title.text()] = parameter.values;
  json["caveats"] = set.about.caveats;
  return json;
}

void list(const Curves& curves) {
  for (const auto& set : curves.sets()) {
    const auto what = set.x.name.empty() ? "table" : set.y.text() + " against " + set.x.text();
    fmt::print("{:<42} {:<12} {:>4} {}  {}\n", set.name, set.about.kind, set.points,
               set.x.name.empty() ? "rows  " : "points",
               set.available ? what : "not passed on: supply " + set.path);
  }
}

void list_theories() {
  fmt::print("\nClosed forms, as against = \"theory:NAME\" with = {{ ... }} of a check:\n");
  for (const auto& theory : validation::theories())
    fmt::print("{:<42} {:<5} {}\n", fmt::format("theory:{}", theory.name), theory.unit,
               theory.source);
}

void line(const char* what, const std::string& text) {
  if (!text.empty()) fmt::print("  {:<12} {}\n", what, text);
}

/// A selection that gives one curve, as an example of how, and what is assumed of such a curve.
void show_example(const Curves& curves, const CurveSet& set) {
  std::string selection = set.name;
  for (const auto& parameter : set.parameters)
    if (parameter.values.size() > 1 && !parameter.title.unit.empty())
      selection += (selection == set.name ? "?" : "&") + parameter.title.name + "=" +
                   parameter.values.front();
  try {
    const auto curve = curves.curve(selection);
    line("for example", selection);
    for (const auto& assumption : curve.assumptions) line("assumed", assumption);
  } catch (const InputError&) {
    return;  // a table, a set to be supplied, parameters that depend on each other
  }
}

void show(const Curves& curves, const CurveSet& set) {
  const auto& about = set.about;
  fmt::print("{}\n", set.name);
  line("title", about.title);
  line("citation", about.citation);
  line("doi", about.doi);
  line("kind", about.method.empty() ? about.kind : about.kind + ", " + about.method);
  line("by", about.by);
  line("measured by", about.measurement);
  line("source", about.source);
  line("licence", about.licence);
  line("processing", about.processing);
  line("uncertainty", about.uncertainty_note);
  if (!set.x.name.empty()) line("curve", set.y.text() + " against " + set.x.text());
  for (const auto& parameter : set.parameters)
    if (parameter.values.size() <= 24)
      line("choose",
           fmt::format("{} = {}", parameter.title.text(), fmt::join(parameter.values, ", ")));
  show_example(curves, set);
  for (const auto& [key, value] : about.conditions)
    line("condition", fmt::format("{}: {}", key, value));
  for (const auto& caveat : about.caveats) line("caveat", caveat);
  for (const auto& check : about.checks) line("checked", check);
  line("file", set.path);
}

void show(const validation::NamedTheory& theory) {
  fmt::print("theory:{}\n", theory.name);
  line("gives", std::string(theory.unit));
  line("source", std::string(theory.source));
  line("limits", std::string(theory.limits));
  line("with", fmt::format("{}", fmt::join(theory.needed, ", ")));
  line("or also", fmt::format("{}", fmt::join(theory.optional, ", ")));
}

/// As a file of curves: what is printed can be read again. What was assumed goes to stderr.
void show_points(const Curve& curve) {
  constexpr double coverage_factor = 1.96;
  const bool bars = std::any_of(curve.points.begin(), curve.points.end(),
                                [](const auto& point) { return point.down() != point.up(); });
  const auto title = [](const validation::Title& of, const char* suffix) {
    return validation::Title{of.name + suffix, of.unit}.text();
  };
  fmt::print("{},{},{},{}\n", curve.x.text(), title(curve.x, "_u"), curve.y.text(),
             bars ? title(curve.y, "_lo") + "," + title(curve.y, "_hi") : title(curve.y, "_u"));
  for (const auto& point : curve.points) {
    fmt::print("{},{:.3g},{},", point.x, point.u_x, point.y);
    if (bars)
      fmt::print("{:.6g},{:.6g}\n", point.y - coverage_factor * point.down(),
                 point.y + coverage_factor * point.up());
    else
      fmt::print("{:.3g}\n", point.up());
  }
  for (const auto& assumption : curve.assumptions) fmt::print(stderr, "assumed: {}\n", assumption);
}

void run(const Options& options) {
  auto folders = options.folders;
  folders.push_back(curves_folder());
  const auto curves = Curves::open(folders);
  if (options.common.json) {
    Json all = Json::array();
    for (const auto& set : curves.sets())
      if (options.name.empty() || set.name == options.name) all.push_back(to_json(set));
    fmt::print("{}\n", all.dump(2, ' ', false, Json::error_handler_t::replace));
    return;
  }
  if (options.name.empty()) {
    list(curves);
    return list_theories();
  }
  for (const auto& theory : validation::theories())
    if (options.name == fmt::format("theory:{}", theory.name)) return show(theory);
  for (const auto& set : curves.sets())
    if (set.name == options.name) return show(curves, set);
  show_points(curves.curve(options.name));
}

}  // namespace

std::string curves_folder() {
  namespace fs = std::filesystem;
  std::error_code error;
  const auto program = fs::read_symlink("/proc/self/exe", error);
  const auto installed = program.parent_path() / "../share/bedscope/curves";
  if (!error && fs::is_directory(installed)) return installed.lexically_normal().string();
  return BEDSCOPE_CURVES;
}

void add_curves(CLI::App& app) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("curves", "the reference curves at hand");
  command->add_option("name", options->name,
                      "one of them; with a selection (\"varas_2017/axial_holdup?U=5.55\") its "
                      "points as CSV");
  command->add_option("--curves", options->folders, "more folders of curves");
  add_common(*command, options->common);
  command->callback([options] { run(*options); });
}

}  // namespace bedscope::app
