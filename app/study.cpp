// SPDX-License-Identifier: BSD-3-Clause
#include "app/study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

#include "readers/error.hpp"
#include "readers/toml_table.hpp"

namespace bedscope::app {
namespace {

using analysis::RunSettings;
using analysis::SpeciesRule;
using Table = readers::TomlTable;
using readers::found_text;

int axis_number(Table& table, std::string_view key, int otherwise) {
  const auto text = table.text(key);
  if (!text) return otherwise;
  if (text->size() != 1 || (*text)[0] < 'x' || (*text)[0] > 'z')
    table.fail(*table.find(key), "{}: expected \"x\", \"y\" or \"z\", found \"{}\"", table.key(key),
               *text);
  return (*text)[0] - 'x';
}

std::array<double, 3> vector3(Table& table, std::string_view key) {
  const auto values = table.numbers(key);
  if (!values || values->size() != 3) {
    const auto* node = table.find(key);
    if (node == nullptr)
      table.fail(table.raw(), "{} is missing: expected three numbers [m]", table.key(key));
    table.fail(*node, "{}: expected three numbers [m]", table.key(key));
  }
  return {(*values)[0], (*values)[1], (*values)[2]};
}

/// `2500`, or a table by type: `{ 1 = 2400, 2 = 2600 }`.
void by_type(Table& table, std::string_view key, analysis::ByType& value) {
  const auto* node = table.find(key);
  if (node == nullptr) return;
  value = {};
  const auto positive = [&](const toml::node& at) {
    const double number = table.number(at, table.key(key));
    if (!(number > 0))
      table.fail(at, "{}: expected a number above 0, found {}", table.key(key), number);
    return number;
  };
  if (!node->is_table()) {
    value.all = positive(*node);
    return;
  }
  for (const auto& [type, item] : *node->as_table()) {
    const std::string name(type.str());
    if (name.empty() || name.find_first_not_of("0123456789") != name.npos || name.size() > 6)
      table.fail(item, "{}: expected a type number as key, found {}", table.key(key), name);
    value.of_type[std::stoi(name)] = positive(item);
  }
}

/// "q > 0": a column, a comparison, a number.
SpeciesRule parse_rule(const Table& table, const toml::node& node, const std::string& name) {
  using Comparison = SpeciesRule::Comparison;
  static constexpr std::array<std::pair<std::string_view, Comparison>, 6> comparisons{
      {{"<=", Comparison::less_equal},
       {">=", Comparison::greater_equal},
       {"==", Comparison::equal},
       {"!=", Comparison::not_equal},
       {"<", Comparison::less},
       {">", Comparison::greater}}};
  const auto text = node.value_or(std::string{});
  for (const auto& [sign, comparison] : comparisons) {
    const auto at = text.find(sign);
    if (at == text.npos) continue;
    const auto trim = [](const std::string& part) {
      const auto first = part.find_first_not_of(" \t");
      return first == part.npos ? std::string{}
                                : part.substr(first, part.find_last_not_of(" \t") - first + 1);
    };
    SpeciesRule rule{name, trim(text.substr(0, at)), comparison, 0};
    const auto number = trim(text.substr(at + sign.size()));
    std::istringstream stream(number);
    stream.imbue(std::locale::classic());
    if (!rule.column.empty() && stream >> rule.value && stream.peek() == EOF) return rule;
  }
  table.fail(node, "species.{}: expected a rule such as \"q > 0\", found {}", name,
             found_text(node));
}

std::optional<std::array<double, 2>> window(Table& table, RunSettings& settings) {
  const auto* node = table.find("average");
  if (node == nullptr) return settings.average;
  if (node->is_string()) {
    if (node->value_or(std::string{}) != "auto")
      table.fail(*node, "{}: expected \"auto\" or {{ from = ..., to = ... }}, found {}",
                 table.key("average"), found_text(*node));
    return std::nullopt;
  }
  auto range = table.table("average");
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double from = range->number("from").value_or(-infinity);
  const double to = range->number("to").value_or(infinity);
  range->finish();
  if (!(from <= to))
    table.fail(*node, "{}: expected from <= to, found {} and {}", table.key("average"), from, to);
  return std::array{from, to};
}

void read_grid(Table& table, RunSettings& settings) {
  const auto cell = table.numbers("cell");
  const auto cells = table.numbers("cells");
  if (cell && cells) table.fail(*table.find("cells"), "cell and cells: expected one of them");
  if (cell) {
    if (cell->size() != 2 && cell->size() != 3)
      table.fail(*table.find("cell"),
                 "{}: expected 2 sizes (lateral, up) or 3 (lateral, depth, up), found {}",
                 table.key("cell"), cell->size());
    for (const double size : *cell)
      if (!(size > 0))
        table.fail(*table.find("cell"), "{}: expected sizes above 0 m, found {}", table.key("cell"),
                   size);
    settings.cell = *cell;
    settings.cells.clear();
  }
  if (cells) {
    if (cells->size() != 2 && cells->size() != 3)
      table.fail(*table.find("cells"),
                 "{}: expected 2 numbers (lateral, up) or 3 (lateral, depth, up), found {}",
                 table.key("cells"), cells->size());
    settings.cell.clear();
    settings.cells.clear();
    for (const double count : *cells) {
      if (!(count >= 1 && count <= 1e8) || count != std::floor(count))
        table.fail(*table.find("cells"), "{}: expected whole numbers of at least 1, found {}",
                   table.key("cells"), count);
      settings.cells.push_back(static_cast<int>(count));
    }
  }
}

/// The keys of [scene], which a [[run]] may say otherwise.
void read_scene(Table& table, RunSettings& settings) {
  if (auto domain = table.table("domain")) {
    const auto min = vector3(*domain, "min"), max = vector3(*domain, "max");
    domain->finish();
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!(max[axis] > min[axis]))
        table.fail(*table.find("domain"), "{}: expected min < max in {}, found {} and {}",
                   table.key("domain"), "xyz"[axis], min[axis], max[axis]);
    settings.domain = {{min, max}};
  }
  settings.up = axis_number(table, "up", settings.up);
  settings.lateral =
      axis_number(table, "lateral",
                  settings.lateral == settings.up ? (settings.up == 0 ? 1 : 0) : settings.lateral);
  if (settings.up == settings.lateral) {
    const auto* node = table.find("lateral") != nullptr ? table.find("lateral") : table.find("up");
    table.fail(*node, "up and lateral: expected two axes, found \"{}\" twice", "xyz"[settings.up]);
  }
  read_grid(table, settings);
  if (const auto axes = table.texts("periodic")) {
    settings.periodic = std::array<bool, 3>{};
    for (const auto& axis : *axes) {
      if (axis.size() != 1 || axis[0] < 'x' || axis[0] > 'z')
        table.fail(*table.find("periodic"), "{}: expected axes \"x\", \"y\", \"z\", found \"{}\"",
                   table.key("periodic"), axis);
      (*settings.periodic)[static_cast<std::size_t>(axis[0] - 'x')] = true;
    }
  }
  by_type(table, "density", settings.density);
  by_type(table, "radius", settings.radius);
  if (const auto density = table.positive("gas_density")) settings.gas.density = density;
  settings.gas.gravity = table.positive("gravity").value_or(settings.gas.gravity);
  if (auto species = table.table("species")) {
    settings.species.clear();
    for (const auto& [name, node] : species->raw()) {
      const std::string label(name.str());
      if (!node.is_string())
        table.fail(node, "species.{}: expected a rule such as \"q > 0\", found {}", label,
                   found_text(node));
      if (label == "all" || label.find_first_not_of("0123456789") == label.npos)
        table.fail(node, "species.{}: this name is taken by {}", label,
                   label == "all" ? "the total" : "a type");
      settings.species.push_back(parse_rule(table, node, label));
    }
  }
  settings.average = window(table, settings);
  settings.gaussian_width = table.positive("gaussian_width").value_or(settings.gaussian_width);
  if (const auto every = table.integer("every")) {
    if (*every < 1 || *every > 1'000'000)
      table.fail(*table.find("every"), "{}: expected a whole number from 1 to 1000000, found {}",
                 table.key("every"), *every);
    settings.every = *every;
  }
  if (const auto mapping = table.text("mapping")) {
    static constexpr std::array<std::string_view, 4> kernels{"centre", "exact", "divided",
                                                             "gaussian"};
    if (std::find(kernels.begin(), kernels.end(), *mapping) == kernels.end())
      table.fail(*table.find("mapping"), "{}: expected one of {}, found \"{}\"",
                 table.key("mapping"), fmt::join(kernels, ", "), *mapping);
    settings.mapping = *mapping;
  }
}

/// `products = ["axial"]`: what else is neither read for nor computed.
void read_wanted(Table& study, analysis::WantedProducts& wanted) {
  const auto names = study.texts("products");
  if (!names) return;
  wanted = {false, false, false, false, false, false};
  const std::map<std::string, bool*> flags{{"lateral", &wanted.lateral},
                                           {"fields", &wanted.fields},
                                           {"clusters", &wanted.clusters},
                                           {"species", &wanted.species},
                                           {"temperature", &wanted.temperature}};
  for (const auto& name : *names) {
    const auto flag = flags.find(name);
    if (flag != flags.end())
      *flag->second = true;
    else if (name != "axial")  // which costs nothing beside the inventory
      study.fail(*study.find("products"),
                 "products: expected axial, clusters, fields, lateral, species or temperature, "
                 "found \"{}\"",
                 name);
  }
}

void read_thresholds(Table& table, analysis::ClusterThresholds& thresholds) {
  thresholds.threshold = table.positive("threshold").value_or(thresholds.threshold);
  thresholds.core = table.positive("core").value_or(thresholds.core);
  thresholds.min_area = table.positive("min_area").value_or(thresholds.min_area);
  table.finish();
}

void read_products(Table& study, RunSettings& settings) {
  read_wanted(study, settings.wanted);
  if (auto profiles = study.table("profiles")) {
    settings.heights = profiles->numbers("heights").value_or(std::vector<double>{});
    settings.band = profiles->positive("band").value_or(0);
    profiles->finish();
  }
  if (auto clusters = study.table("clusters")) read_thresholds(*clusters, settings.clusters);
  if (auto bubbles = study.table("bubbles")) {
    settings.bubbles = {.threshold = 0.8, .core = 0.9, .min_area = 0};
    read_thresholds(*bubbles, *settings.bubbles);
    const double highest = std::max(settings.bubbles->threshold, settings.bubbles->core);
    if (!(highest < 1))
      bubbles->fail(bubbles->raw(), "bubbles: expected voidages below 1, found {}", highest);
  }
  if (auto bed = study.table("bed")) {
    settings.height_at_rest = bed->positive("height_at_rest");
    bed->finish();
  }
  settings.bed = study.find("bed") != nullptr || settings.bubbles;
  if (auto spectra = study.table("spectra")) {
    settings.spectra = true;
    settings.segment = spectra->positive("segment");
    spectra->finish();
  }
  if (auto temperature = study.table("temperature")) {
    settings.temperature_column = temperature->text("column").value_or(settings.temperature_column);
    const auto from = temperature->number("from"), to = temperature->number("to");
    if (from.has_value() != to.has_value() || (from && !(*from < *to)))
      temperature->fail(temperature->raw(),
                        "temperature: expected from < to [K], both or none of them");
    if (from) settings.temperature = {{*from, *to}};
    const auto bins = temperature->integer("bins").value_or(settings.temperature_bins);
    if (bins < 1 || bins > 100000)
      temperature->fail(*temperature->find("bins"),
                        "temperature.bins: expected 1 to 100000, found {}", bins);
    settings.temperature_bins = static_cast<int>(bins);
    temperature->finish();
  }
  if (auto gas = study.table("gas")) {
    auto& fields = settings.gas.fields;
    fields.voidage = gas->text("voidage").value_or("");
    fields.solids = gas->text("solids").value_or("");
    if (!fields.voidage.empty() && !fields.solids.empty())
      gas->fail(*gas->find("solids"), "gas.voidage and gas.solids: expected one of them");
    fields.velocity = gas->text("velocity").value_or("");
    fields.pressure = gas->text("pressure").value_or("");
    fields.temperature = gas->text("temperature").value_or("");
    settings.gas.options.region = gas->text("region").value_or("");
    gas->finish();
  }
}

readers::Decomposition decomposition(Table& table, const std::string& name) {
  using readers::Decomposition;
  static const std::map<std::string, Decomposition> all{
      {"automatic", Decomposition::automatic},
      {"collated", Decomposition::collated},
      {"processors", Decomposition::processors},
      {"reconstructed", Decomposition::reconstructed},
      {"separate", Decomposition::separate}};
  const auto found = all.find(name);
  if (found == all.end())
    table.fail(*table.find("decomposition"),
               "{}: expected automatic, reconstructed, processors, separate or collated, found "
               "\"{}\"",
               table.key("decomposition"), name);
  return found->second;
}

StudyRun read_run(Table& table, RunSettings settings, const std::filesystem::path& folder,
                  std::size_t number) {
  StudyRun run;
  const auto in_folder = [&](const std::string& path) {
    return (std::filesystem::path(path).is_absolute() ? std::filesystem::path(path) : folder / path)
        .lexically_normal()
        .string();
  };
  read_scene(table, settings);
  settings.label = table.text("label").value_or(fmt::format("run {}", number));
  const auto particles = table.text("particles");
  const auto tables = table.text("tables");
  if (particles && tables)
    table.fail(*table.find("tables"), "run \"{}\": expected particles or tables, found both",
               settings.label);
  if (!particles && !tables)
    table.fail(table.raw(),
               "run \"{}\": particles is missing: expected a file, a folder or a pattern",
               settings.label);
  for (const auto& [key, value] :
       {std::pair("particles", &particles), std::pair("tables", &tables)})
    if (*value && (*value)->empty())
      table.fail(*table.find(key), "{}: expected a path, found \"\"", table.key(key));
  if (particles) settings.particles = in_folder(*particles);
  if (tables) run.tables = in_folder(*tables);
  if (const auto probes = table.text("probes")) settings.probes = in_folder(*probes);
  settings.time_step = table.positive("time_step");
  settings.step_zero = table.integer("step_zero").value_or(0);
  if (const auto repeated = table.text("repeated")) {
    if (*repeated != "first" && *repeated != "last")
      table.fail(*table.find("repeated"), "{}: expected \"first\" or \"last\", found \"{}\"",
                 table.key("repeated"), *repeated);
    settings.repeated = *repeated == "first" ? readers::Repeated::first : readers::Repeated::last;
  }
  settings.columns = table.texts("columns").value_or(std::vector<std::string>{});
  if (const auto gas = table.text("gas")) {
    if (tables)
      table.fail(*table.find("gas"), "run \"{}\": gas: expected particles beside it, found tables",
                 settings.label);
    settings.gas.path = in_folder(*gas);
  }
  if (const auto name = table.text("decomposition"))
    settings.gas.options.decomposition = decomposition(table, *name);
  table.finish();
  run.settings = std::move(settings);
  return run;
}

}  // namespace

Study read_study(const std::string& path) {
  const auto parsed = readers::parse_toml(path);
  Table table(parsed, "", path);
  Study study;
  study.title = table.text("title").value_or(std::filesystem::path(path).stem().string());
  RunSettings shared;
  if (auto scene = table.table("scene")) {
    read_scene(*scene, shared);
    scene->finish();
  }
  read_products(table, shared);
  if (auto tradeoff = table.table("tradeoff")) {
    auto& wishes = study.tradeoff;
    wishes.tolerance = tradeoff->positive("tolerance").value_or(wishes.tolerance);
    wishes.products = tradeoff->texts("products").value_or(std::vector<std::string>{});
    if (const auto* node = tradeoff->find("products")) wishes.line = node->source().begin.line;
    tradeoff->finish();
  }
  study.checks = validation::read_checks(table);
  auto runs = table.tables("run");
  const auto folder = std::filesystem::path(path).parent_path();
  for (const auto& curves : table.texts("curves").value_or(std::vector<std::string>{}))
    study.curves.push_back((folder / curves).lexically_normal().string());
  table.finish();
  if (runs.empty()) throw InputError("{}: no [[run]]: expected at least one", path);
  std::set<std::string> labels;
  for (auto& run : runs) {
    study.runs.push_back(read_run(run, shared, folder, study.runs.size() + 1));
    const auto& label = study.runs.back().settings.label;
    if (!labels.insert(label).second) run.fail(run.raw(), "run.label: \"{}\" occurs twice", label);
  }
  return study;
}

Study study_of_path(const std::string& path) {
  if (path.empty()) throw InputError("expected a study, a dump or a folder, found an empty path");
  Study study;
  auto name = std::filesystem::path(path).lexically_normal();
  if (!name.has_filename()) name = name.parent_path();
  std::error_code none;  // the current folder may be gone
  study.title = std::filesystem::absolute(name, none).filename().string();
  StudyRun run;
  run.settings.label = study.title;
  run.settings.particles = path;
  run.settings.time_required = false;
  study.runs.push_back(std::move(run));
  return study;
}

Study study_of(const std::string& input) {
  const bool is_study = std::filesystem::path(input).extension() == ".toml";
  return is_study ? read_study(input) : study_of_path(input);
}

}  // namespace bedscope::app
