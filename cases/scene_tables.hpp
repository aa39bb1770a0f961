// SPDX-License-Identifier: BSD-3-Clause
// Reading the tables of a scene file; of use inside this room only.
#pragma once

#include <cmath>
#include <set>
#include <string>

#include "cases/scene_names.hpp"
#include "readers/toml_table.hpp"

namespace bedscope::cases {

using Table = readers::TomlTable;

template <class T, std::size_t N>
T choice(Table& table, std::string_view key, const Words<T, N>& words, T otherwise) {
  const auto text = table.text(key);
  if (!text) return otherwise;
  std::string known;
  for (const auto& [word, value] : words) {
    if (word == *text) return value;
    known += fmt::format("{}\"{}\"", known.empty() ? "" : ", ", word);
  }
  table.fail(*table.find(key), "{}: expected one of {}, found \"{}\"", table.key(key), known,
             *text);
}

/// A number that must be there and be above 0.
inline double needed(Table& table, std::string_view key, const char* unit) {
  const auto value = table.positive(key);
  if (!value)
    table.fail(table.raw(), "{} is missing: expected a number [{}]", table.key(key), unit);
  return *value;
}

inline double at_least_zero(Table& table, std::string_view key, double otherwise) {
  const auto value = table.number(key);
  if (value && *value < 0)
    table.fail(*table.find(key), "{}: expected a number of at least 0, found {}", table.key(key),
               *value);
  return value.value_or(otherwise);
}

/// `positive`: 0 is not allowed.
inline double up_to(Table& table, std::string_view key, double limit, bool positive,
                    double otherwise) {
  const auto value = table.number(key);
  if (value && (*value < 0 || *value > limit || (positive && *value == 0)))
    table.fail(*table.find(key), "{}: expected a number {} 0 and up to {}, found {}",
               table.key(key), positive ? "above" : "from", limit, *value);
  return value.value_or(otherwise);
}

inline Vector vector_of(Table& table, std::string_view key, const Vector& otherwise) {
  const auto values = table.numbers(key);
  if (!values) return otherwise;
  if (values->size() != 3)
    table.fail(*table.find(key), "{}: expected three numbers, found {}", table.key(key),
               values->size());
  return {(*values)[0], (*values)[1], (*values)[2]};
}

/// Three counts from 1 to a million.
inline std::array<int, 3> counts_of(Table& table, std::string_view key) {
  const auto values = vector_of(table, key, {});
  std::array<int, 3> counts{};
  const auto* node = table.find(key);
  if (node == nullptr) return counts;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(values[i] >= 1 && values[i] <= 1e6) || values[i] != std::floor(values[i]))
      table.fail(*node, "{}: expected three whole numbers from 1 to 1000000, found {}",
                 table.key(key), values[i]);
    counts[i] = static_cast<int>(values[i]);
  }
  return counts;
}

}  // namespace bedscope::cases
