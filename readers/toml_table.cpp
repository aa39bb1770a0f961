// SPDX-License-Identifier: BSD-3-Clause
#include "readers/toml_table.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "readers/text_file.hpp"

namespace bedscope::readers {
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

std::string text_of(const TomlTable& table, const toml::node& node, const std::string& what) {
  if (!node.is_string()) table.fail(node, "{}: expected a text, found {}", what, found_text(node));
  auto text = node.value_or(std::string{});
  if (text.find('\0') != text.npos)  // a path would end there
    table.fail(node, "{}: expected a text without NUL characters", what);
  return text;
}

}  // namespace

toml::table parse_toml(const std::string& path) {
  constexpr std::size_t longest = std::size_t{16} << 20;
  const auto content = read_text(path, longest);
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

std::string nearest_name(std::string_view name, const std::set<std::string>& names) {
  std::string nearest;
  std::size_t least = ~std::size_t{0};
  for (const auto& candidate : names) {
    const auto distance = edit_distance(name, candidate);
    if (distance < least) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

const toml::node* TomlTable::find(std::string_view key) {
  known_.insert(std::string(key));
  return table_->get(key);
}

std::optional<std::string> TomlTable::text(std::string_view name) {
  const auto* node = find(name);
  if (node == nullptr) return std::nullopt;
  return text_of(*this, *node, key(name));
}

std::optional<double> TomlTable::number(std::string_view name) {
  const auto* node = find(name);
  if (node == nullptr) return std::nullopt;
  return number(*node, key(name));
}

double TomlTable::number(const toml::node& node, const std::string& what) const {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !std::isfinite(*value))
    fail(node, "{}: expected a number, found {}", what, found_text(node));
  return *value;
}

std::optional<double> TomlTable::positive(std::string_view name) {
  const auto value = number(name);
  if (value && !(*value > 0))
    fail(*find(name), "{}: expected a number above 0, found {}", key(name), *value);
  return value;
}

std::optional<std::int64_t> TomlTable::integer(std::string_view name) {
  const auto* node = find(name);
  if (node == nullptr) return std::nullopt;
  if (!node->is_integer())
    fail(*node, "{}: expected an integer, found {}", key(name), found_text(*node));
  return node->value<std::int64_t>();
}

std::optional<bool> TomlTable::boolean(std::string_view name) {
  const auto* node = find(name);
  if (node == nullptr) return std::nullopt;
  if (!node->is_boolean())
    fail(*node, "{}: expected true or false, found {}", key(name), found_text(*node));
  return node->value<bool>();
}

std::optional<std::vector<double>> TomlTable::numbers(std::string_view name) {
  const auto* node = find(name);
  if (node == nullptr) return std::nullopt;
  if (!node->is_array())
    fail(*node, "{}: expected an array of numbers, found {}", key(name), found_text(*node));
  std::vector<double> values;
  for (const auto& item : *node->as_array()) values.push_back(number(item, key(name)));
  return values;
}

std::optional<std::vector<std::string>> TomlTable::texts(std::string_view name) {
  const auto* node = find(name);
  if (node == nullptr) return std::nullopt;
  if (!node->is_array())
    fail(*node, "{}: expected an array of texts, found {}", key(name), found_text(*node));
  std::vector<std::string> values;
  for (const auto& item : *node->as_array()) values.push_back(text_of(*this, item, key(name)));
  return values;
}

std::optional<TomlTable> TomlTable::table(std::string_view name) {
  const auto* node = find(name);
  if (node == nullptr) return std::nullopt;
  if (!node->is_table())
    fail(*node, "{}: expected a table, found {}", key(name), found_text(*node));
  return TomlTable(*node->as_table(), key(name), *path_);
}

std::vector<TomlTable> TomlTable::tables(std::string_view name) {
  std::vector<TomlTable> found;
  const auto* node = find(name);
  if (node == nullptr) return found;
  if (!node->is_array_of_tables())
    fail(*node, "{}: expected [[{}]], found {}", key(name), name, found_text(*node));
  for (const auto& item : *node->as_array())
    found.emplace_back(*item.as_table(), std::string(name), *path_);
  return found;
}

void TomlTable::finish() const {
  for (const auto& [name, node] : *table_)
    if (!known_.contains(std::string(name.str())))
      throw InputError("{}: line {}: unknown key {}; the nearest known one is {}", path_of(name),
                       name.source().begin.line, key(name.str()),
                       key(nearest_name(name.str(), known_)));
}

std::string toml_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f')
      quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      quoted += c;
  }
  return quoted + '"';
}

std::string toml_number(double value) {
  auto text = fmt::format("{}", value);
  if (text.find_first_of(".en") == text.npos) text += ".0";
  return text;
}

}  // namespace bedscope::readers
