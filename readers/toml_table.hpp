// SPDX-License-Identifier: BSD-3-Clause
// A TOML file read key by key: what is of another type, missing or unknown is one clear line. And
// how values are written so that they are read back.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "readers/error.hpp"

namespace bedscope::readers {

/// Throws FileError, or InputError naming the line.
toml::table parse_toml(const std::string& path);

/// What a TOML node is, for messages: its value, "a table", "an array".
std::string found_text(const toml::node& node);

/// The name nearest to `name` by the number of letters to insert, delete or replace.
std::string nearest_name(std::string_view name, const std::set<std::string>& names);

/// A table of a TOML file. Functions that take a key give nothing where it is absent and throw
/// InputError (path, line, key, what was expected and found) where its value is of another type.
class TomlTable {
 public:
  /// `name`: of the table in the file, "" for the root. `table` and `path` must outlive it.
  TomlTable(const toml::table& table, std::string name, const std::string& path)
      : table_(&table), name_(std::move(name)), path_(&path) {}

  template <class... T>
  [[noreturn]] void fail(const toml::node& node, fmt::format_string<T...> text,
                         T&&... values) const {
    throw InputError("{}: line {}: {}", path_of(node), node.source().begin.line,
                     fmt::format(text, std::forward<T>(values)...));
  }

  const toml::node* find(std::string_view key);
  std::string key(std::string_view name) const {
    return name_.empty() ? std::string(name) : fmt::format("{}.{}", name_, name);
  }

  std::optional<std::string> text(std::string_view name);
  std::optional<double> number(std::string_view name);
  double number(const toml::node& node, const std::string& what) const;
  std::optional<double> positive(std::string_view name);
  std::optional<std::int64_t> integer(std::string_view name);
  std::optional<bool> boolean(std::string_view name);
  std::optional<std::vector<double>> numbers(std::string_view name);
  std::optional<std::vector<std::string>> texts(std::string_view name);
  std::optional<TomlTable> table(std::string_view name);
  std::vector<TomlTable> tables(std::string_view name);
  const toml::table& raw() const { return *table_; }
  const std::string& path() const { return *path_; }
  /// The file that a node or key was read from, where tables of several files were merged.
  template <class Node>
  const std::string& path_of(const Node& node) const {
    return node.source().path ? *node.source().path : *path_;
  }

  /// Every key that nobody asked for is an error that names the nearest known one.
  void finish() const;

 private:
  const toml::table* table_;
  std::string name_;
  const std::string* path_;
  std::set<std::string> known_;
};

/// A text as a basic string of TOML, in its quotes.
std::string toml_text(std::string_view text);

/// The shortest that reads back to the same bits, with a point or an exponent: always a float.
std::string toml_number(double value);

}  // namespace bedscope::readers
