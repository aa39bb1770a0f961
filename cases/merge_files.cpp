// SPDX-License-Identifier: BSD-3-Clause
#include "cases/merge_files.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "readers/toml_table.hpp"

namespace bedscope::cases {
namespace {

constexpr std::array<std::string_view, 5> amounts{"number", "mass", "holdup", "lattice",
                                                  "position"};

void drop_other_amounts(const toml::table& upper, toml::table& lower) {
  for (const auto key : amounts)
    if (upper.contains(key))
      for (const auto other : amounts) lower.erase(other);
}

void lay_over(toml::table& lower, toml::table&& upper);

/// [[species]]: the first over the first, and so on; more are added.
void lay_over(toml::array& lower, toml::array&& upper) {
  for (std::size_t i = 0; i < upper.size(); ++i) {
    auto* above = upper[i].as_table();
    auto* under = i < lower.size() ? lower[i].as_table() : nullptr;
    if (above != nullptr && under != nullptr)
      lay_over(*under, std::move(*above));
    else
      upper[i].visit([&](auto& value) { lower.push_back(std::move(value)); });
  }
}

void lay_over(toml::table& lower, toml::table&& upper) {
  drop_other_amounts(upper, lower);
  for (auto&& item : upper) {
    const auto& key = item.first;
    auto& node = item.second;
    auto* under = lower.get(key.str());
    if (under != nullptr && under->is_table() && node.is_table())
      lay_over(*under->as_table(), std::move(*node.as_table()));
    else if (under != nullptr && under->is_array_of_tables() && node.is_array_of_tables())
      lay_over(*under->as_array(), std::move(*node.as_array()));
    else  // a moved node keeps its place in the file, a copied one does not
      node.visit([&](auto& value) { lower.insert_or_assign(key, std::move(value)); });
  }
}

toml::table merged(const std::filesystem::path& path, int depth) {
  constexpr int deepest = 8;
  const auto name = path.string();
  auto table = readers::parse_toml(name);
  const auto* base = table.get("base");
  if (base == nullptr) return table;
  readers::TomlTable root(table, "", name);
  std::vector<std::string> files;
  if (base->is_array())
    files = *root.texts("base");
  else
    files.push_back(*root.text("base"));
  if (depth == deepest)
    root.fail(*base, "base: expected at most {} files, one under the other, found another",
              deepest);
  toml::table lower;
  for (const auto& file : files) lay_over(lower, merged(path.parent_path() / file, depth + 1));
  table.erase("base");
  lay_over(lower, std::move(table));
  return lower;
}

}  // namespace

toml::table merged_file(const std::string& path) { return merged(path, 1); }

}  // namespace bedscope::cases
