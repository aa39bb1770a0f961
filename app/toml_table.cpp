// SPDX-License-Identifier: BSD-3-Clause
#include "app/toml_table.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <numeric>
#include <sstream>

namespace bedscope::app {
namespace {

/// Levenshtein (1966): the least number of insertions, deletions and replacements.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (const char letter : a) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (letter != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j + 1] + 1, row[j] + 1, replaced});
    }
  }
  return row.back();
}

}  // namespace

toml::table parse_toml(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError("{}: cannot be read", path);
  const std::string content((std::istreambuf_iterator<char>(file)),
                            std::istreambuf_iterator<char>());
  try {
    return toml::parse(content, path);
  } catch (const toml::parse_error& error) {
    throw InputError("{}: line {}: {}", path, error.source().begin.line, error.description());
  }
}

std::string found_text(const toml::node& node) {
  std::ostringstream text;
  switch (node.type()) {
    case toml::node_type::string:
      text << '"' << node.value_or(std::string{}) << '"';
      break;
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    default:
      node.visit([&](const auto& value) {
        if constexpr (toml::is_value<decltype(value)>) text << value.get();
      });
  }
  return text.str();
}

void Table::finish() const {
  for (const auto& [name, node] : *table_) {
    if (known_.contains(std::string(name.str()))) continue;
    std::string nearest;
    std::size_t least = ~std::size_t{0};
    for (const auto& candidate : known_) {
      const auto distance = edit_distance(name.str(), candidate);
      if (distance < least) {
        least = distance;
        nearest = candidate;
      }
    }
    throw InputError("{}: line {}: unknown key {}; the nearest known one is {}", *path_,
                     name.source().begin.line, key(name.str()), key(nearest));
  }
}

}  // namespace bedscope::app
