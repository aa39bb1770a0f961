// SPDX-License-Identifier: BSD-3-Clause
#include "validation/sidecar.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>

#include "readers/toml_table.hpp"

namespace bedscope::validation {
namespace {

/// 0.002 (in the unit of the axis), "3 %" (of the value), "holdup_u" (a column), "not stated".
UncertaintyRule uncertainty(readers::TomlTable& table, const char* key) {
  UncertaintyRule rule;
  const auto* node = table.find(key);
  if (node == nullptr) return rule;
  if (node->is_number()) {
    rule.absolute = table.number(*node, key);
    if (*rule.absolute < 0)
      table.fail(*node, "{}: expected a standard uncertainty of at least 0, found {}", key,
                 *rule.absolute);
    return rule;
  }
  const auto text = table.text(key).value_or("");
  if (text == "not stated") return rule;
  if (text.ends_with('%')) {
    const auto share = to_number(text.substr(0, text.find_last_not_of("% ") + 1));
    if (!share || !(*share >= 0 && std::isfinite(*share)))
      table.fail(*node, "{}: expected a share such as \"3 %\", found \"{}\"", key, text);
    rule.relative = *share / 100;
  } else {
    rule.column = text;
  }
  return rule;
}

void read_conditions(readers::TomlTable& table, Provenance& about) {
  auto conditions = table.table("conditions");
  if (!conditions) return;
  for (const auto& [key, node] : conditions->raw())
    about.conditions.emplace_back(
        key.str(), node.is_string() ? node.value_or(std::string{}) : readers::found_text(node));
}

Sidecar read_sidecar(const std::string& path) {
  const auto parsed = readers::parse_toml(path);
  readers::TomlTable table(parsed, "", path);
  Sidecar sidecar;
  auto& about = sidecar.about;
  const auto text = [&](const char* key) { return table.text(key).value_or(""); };
  about.title = text("title");
  about.quantity = text("quantity");
  about.citation = text("citation");
  about.doi = text("doi");
  about.kind = text("kind");
  about.method = text("method");
  about.by = text("by");
  about.measurement = text("measurement");
  about.source = text("source");
  about.licence = text("licence");
  about.processing = text("processing");
  about.uncertainty_note = text("uncertainty_note");
  for (const char* key : {"series", "source_files"}) table.find(key);  // for people only
  if (const auto pass_on = table.text("redistribute")) {
    if (*pass_on != "yes" && *pass_on != "no")
      table.fail(*table.find("redistribute"),
                 "redistribute: expected \"yes\" or \"no\", found \"{}\"", *pass_on);
    about.redistribute = *pass_on == "yes";
  }
  if (const auto orientation = table.text("orientation")) {
    if (*orientation != "known" && *orientation != "unknown")
      table.fail(*table.find("orientation"),
                 "orientation: expected \"known\" or \"unknown\", found \"{}\"", *orientation);
    about.orientation_known = *orientation == "known";
  }
  about.caveats = table.texts("caveats").value_or(std::vector<std::string>{});
  about.checks = table.texts("checks").value_or(std::vector<std::string>{});
  read_conditions(table, about);
  sidecar.abscissa = text("abscissa");
  sidecar.ordinate = text("ordinate");
  sidecar.table = table.boolean("table").value_or(false);
  sidecar.u_x = uncertainty(table, "abscissa_uncertainty");
  sidecar.u_y = uncertainty(table, "ordinate_uncertainty");
  table.finish();
  return sidecar;
}

}  // namespace

std::optional<double> to_number(std::string_view text) {
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Sidecar sidecar_of(const std::string& csv) {
  const auto path = std::filesystem::path(csv).replace_extension(".toml");
  if (!std::filesystem::exists(path)) return {};
  try {
    return read_sidecar(path.string());
  } catch (const InputError& error) {  // a study that is named as a curve beside it, say
    throw InputError("{} (read as the sidecar of {})", error.what(), csv);
  }
}

}  // namespace bedscope::validation
