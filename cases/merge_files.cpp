// SPDX-License-Identifier: BSD-3-Clause
#include "cases/merge_files.hpp"

#include <array>
#include <filesystem>

#include "readers/toml_table.hpp"

namespace bedscope::cases {
namespace {

constexpr std::array<std::string_view, 3> amounts{"number", "mass", "holdup"};

void drop_other_amounts(const toml::table& upper, toml::table& lower) {
  for (const auto key : amounts)
    if (upper.contains(key))
      for (const auto other : amounts) lower.erase(other);
}

void lay_over(toml::table& lower, toml::table&& upper) {
  drop_other_amounts(upper, lower);
  for (auto&& [key, node] : upper) {
    auto* under = lower.get(key.str());
    if (under != nullptr && under->is_table() && node.is_table())
      lay_over(*under->as_table(), std::move(*node.as_table()));
    else  // a moved node keeps its place in the file, a copied one does not
      node.visit([&](auto& value) { lower.insert_or_assign(key, std::move(value)); });
  }
}

toml::table merged(const std::filesystem::path& path, int depth) {
  constexpr int deepest = 8;
  auto table = readers::parse_toml(path.string());
  const auto* base = table.get("base");
  if (base == nullptr) return table;
  readers::TomlTable root(table, "", path.string());
  const auto below = path.parent_path() / *root.text("base");
  if (depth == deepest)
    root.fail(*base, "base: expected at most {} files, one under the other, found another", deepest);
  auto lower = merged(below, depth + 1);
  table.erase("base");
  lay_over(lower, std::move(table));
  return lower;
}

}  // namespace

toml::table merged_file(const std::string& path) { return merged(path, 1); }

}  // namespace bedscope::cases
