// SPDX-License-Identifier: BSD-3-Clause
// A TOML file read key by key, with errors that name file, line, key, what was expected and what
// was found.
#pragma once

#include <fmt/format.h>
#include <toml++/toml.h>

#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "readers/error.hpp"

namespace bedscope::app {

/// Reads and parses a file. Throws FileError or InputError.
toml::table parse_toml(const std::string& path);

/// What a TOML node is, for messages.
std::string found_text(const toml::node& node);

/// A table of the file, read key by key; what was never asked for is unknown.
class Table {
 public:
  Table(const toml::table& table, std::string name, const std::string& path)
      : table_(&table), name_(std::move(name)), path_(&path) {}

  template <class... T>
  [[noreturn]] void fail(const toml::node& node, fmt::format_string<T...> text,
                         T&&... values) const {
    throw InputError("{}: line {}: {}", *path_, node.source().begin.line,
                     fmt::format(text, std::forward<T>(values)...));
  }

  const toml::node* find(std::string_view key) {
    known_.insert(std::string(key));
    return table_->get(key);
  }
  std::string key(std::string_view name) const {
    return name_.empty() ? std::string(name) : fmt::format("{}.{}", name_, name);
  }

  std::optional<std::string> text(std::string_view name) {
    const auto* node = find(name);
    if (node == nullptr) return std::nullopt;
    if (!node->is_string())
      fail(*node, "{}: expected a text, found {}", key(name), found_text(*node));
    return node->value<std::string>();
  }

  std::optional<double> number(std::string_view name) {
    const auto* node = find(name);
    if (node == nullptr) return std::nullopt;
    return number(*node, key(name));
  }
  double number(const toml::node& node, const std::string& what) const {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value))
      fail(node, "{}: expected a number, found {}", what, found_text(node));
    return *value;
  }
  std::optional<double> positive(std::string_view name) {
    const auto value = number(name);
    if (value && !(*value > 0))
      fail(*find(name), "{}: expected a number above 0, found {}", key(name), *value);
    return value;
  }
  std::optional<bool> boolean(std::string_view name) {
    const auto* node = find(name);
    if (node == nullptr) return std::nullopt;
    if (!node->is_boolean())
      fail(*node, "{}: expected true or false, found {}", key(name), found_text(*node));
    return node->value<bool>();
  }
  std::optional<std::int64_t> integer(std::string_view name) {
    const auto* node = find(name);
    if (node == nullptr) return std::nullopt;
    if (!node->is_integer())
      fail(*node, "{}: expected an integer, found {}", key(name), found_text(*node));
    return node->value<std::int64_t>();
  }

  std::optional<std::vector<double>> numbers(std::string_view name) {
    const auto* node = find(name);
    if (node == nullptr) return std::nullopt;
    if (!node->is_array())
      fail(*node, "{}: expected an array of numbers, found {}", key(name), found_text(*node));
    std::vector<double> values;
    for (const auto& item : *node->as_array()) values.push_back(number(item, key(name)));
    return values;
  }
  std::optional<std::vector<std::string>> texts(std::string_view name) {
    const auto* node = find(name);
    if (node == nullptr) return std::nullopt;
    if (!node->is_array())
      fail(*node, "{}: expected an array of texts, found {}", key(name), found_text(*node));
    std::vector<std::string> values;
    for (const auto& item : *node->as_array()) {
      if (!item.is_string())
        fail(item, "{}: expected a text, found {}", key(name), found_text(item));
      values.push_back(item.value_or(std::string{}));
    }
    return values;
  }
  std::optional<Table> table(std::string_view name) {
    const auto* node = find(name);
    if (node == nullptr) return std::nullopt;
    if (!node->is_table())
      fail(*node, "{}: expected a table, found {}", key(name), found_text(*node));
    return Table(*node->as_table(), key(name), *path_);
  }
  std::vector<Table> tables(std::string_view name) {
    std::vector<Table> found;
    const auto* node = find(name);
    if (node == nullptr) return found;
    if (!node->is_array_of_tables())
      fail(*node, "{}: expected [[{}]], found {}", key(name), name, found_text(*node));
    for (const auto& item : *node->as_array())
      found.emplace_back(*item.as_table(), std::string(name), *path_);
    return found;
  }
  const toml::table& raw() const { return *table_; }

  /// Every key that nobody asked for is an error that names the nearest known one.
  void finish() const;

 private:
  const toml::table* table_;
  std::string name_;
  const std::string* path_;
  std::set<std::string> known_;
};

}  // namespace bedscope::app
