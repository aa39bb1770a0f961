// SPDX-License-Identifier: BSD-3-Clause
#include "validation/check.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "validation/metrics.hpp"
#include "validation/shapes.hpp"

namespace bedscope::validation {
namespace {

using readers::TomlTable;

/// One of `names`, or an error that names the nearest.
void require_name(const TomlTable& table, const toml::node& node, const char* key,
                  const std::string& found, const std::set<std::string>& names) {
  if (names.contains(found)) return;
  table.fail(node, "check.{}: no {} \"{}\"; the nearest known one is \"{}\"", key, key, found,
             readers::nearest_name(found, names));
}

std::map<std::string, double> numbers_of(TomlTable& table, const char* key) {
  std::map<std::string, double> values;
  auto part = table.table(key);
  if (!part) return values;
  for (const auto& [name, node] : part->raw())
    values[std::string(name.str())] = part->number(node, part->key(name.str()));
  return values;
}

void read_reference(TomlTable& table, Check& check) {
  const auto* node = table.find("against");
  check.number_u = table.number("uncertainty").value_or(0);
  if (check.number_u < 0)
    table.fail(*table.find("uncertainty"), "check.uncertainty: expected at least 0, found {}",
               check.number_u);
  if (node == nullptr) return;
  if (node->is_number())
    check.number = table.number(*node, "check.against");
  else
    check.against = table.text("against").value_or("");
}

/// An error is never below 0, nor a correlation outside -1 to 1.
void require_reachable(TomlTable& table, const Check& check) {
  const bool is_error = check.metric == "area" || find_metric(check.metric).small_is_good;
  if (is_error && *check.limit < 0)
    table.fail(*table.find("limit"), "check.limit: expected at least 0, found {}", *check.limit);
  if (!is_error && std::abs(*check.limit) > 1)
    table.fail(*table.find("limit"), "check.limit: expected -1 to 1, found {}", *check.limit);
}

/// A key that only one kind of check reads would be passed over in silence.
void require_use(TomlTable& table, const char* key, bool is_used, const char* belongs) {
  const auto* node = table.find(key);
  if (node != nullptr && !is_used) table.fail(*node, "check.{}: belongs to {}", key, belongs);
}

void require_uses(TomlTable& table, const Check& check) {
  require_use(table, "uncertainty", check.number.has_value(),
              "a number in against; that of a curve stands in its CSV or its sidecar");
  require_use(table, "with", check.against.starts_with("theory:"), "a theory in against");
  require_use(table, "accuracy", check.metric == "e over u", "the metric \"e over u\"");
}

void read_measure(TomlTable& table, Check& check) {
  std::set<std::string> names{"area"};
  for (const auto& metric : metrics()) names.emplace(metric.name);
  for (const auto& shape : shapes()) names.emplace(shape.name);
  const char* key = table.find("shape") != nullptr ? "shape" : "metric";
  const auto* node = table.find(key);
  if (node == nullptr)
    table.fail(table.raw(), "check.metric is missing: expected a metric or a shape");
  check.metric = table.text(key).value_or("");
  require_name(table, *node, key, check.metric, names);
  check.limit = table.number("limit");
  check.accuracy = table.positive("accuracy").value_or(check.accuracy);
  const bool is_shape = find_shape(check.metric) != nullptr;
  const bool has_reference = check.number || !check.against.empty();
  if (is_shape && has_reference)
    table.fail(*table.find("against"), "check.against: the shape \"{}\" needs none", check.metric);
  if (!is_shape && !has_reference)
    table.fail(table.raw(),
               "check.against is missing: expected a curve, \"theory:...\", \"run:...\", "
               "\"baseline:...\" or a number");
  if (!is_shape && !check.limit)
    table.fail(table.raw(), "check.limit is missing: expected a number");
  if (!is_shape) require_reachable(table, check);
}

Check read_check(TomlTable& table) {
  Check check;
  check.line = table.raw().source().begin.line;
  const auto quantity = table.text("quantity");
  if (!quantity) table.fail(table.raw(), "check.quantity is missing: expected a text");
  std::set<std::string> names;
  for (const auto& each : quantities()) names.emplace(each.name);
  if (!is_series(*quantity))
    require_name(table, *table.find("quantity"), "quantity", *quantity, names);
  check.place = {*quantity, numbers_of(table, "at"), table.text("species").value_or("all")};
  check.run = table.text("run").value_or("");
  check.with = numbers_of(table, "with");
  read_reference(table, check);
  read_measure(table, check);
  require_uses(table, check);
  table.finish();
  return check;
}

}  // namespace

std::vector<Check> read_checks(TomlTable& study) {
  std::vector<Check> checks;
  for (auto& table : study.tables("check")) checks.push_back(read_check(table));
  return checks;
}

std::vector<Check> read_checks(const std::string& study) {
  const auto parsed = readers::parse_toml(study);
  TomlTable table(parsed, "", study);
  return read_checks(table);
}

}  // namespace bedscope::validation
