// SPDX-License-Identifier: BSD-3-Clause
// The rows of one run in one of the tables that an analysis writes.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "analysis/csv.hpp"
#include "analysis/estimate.hpp"

namespace bedscope::analysis {

class RunRows : public CsvReader {
 public:
  /// The rows of every run where `run` is nothing.
  RunRows(const std::filesystem::path& path, std::optional<std::string> run)
      : CsvReader(path), run_column_(column("run")), type_(column("type")), run_(std::move(run)) {}

  bool next() {
    while (CsvReader::next())
      if (!run_column_ || !run_ || text(*run_column_) == *run_) return true;
    return false;
  }
  std::string type() const { return type_ ? std::string(text(*type_)) : "all"; }
  double finite(std::size_t at, std::string_view what) const {
    const double value = number(at);
    if (!std::isfinite(value)) fail(fmt::format("a finite {}", what), fmt::format("{}", value));
    return value;
  }
  int count(std::size_t at, int least) const {
    const std::int64_t value = whole(at, least);
    if (value > std::numeric_limits<int>::max()) fail("a smaller number", std::to_string(value));
    return static_cast<int>(value);
  }
  int count(std::optional<std::size_t> at, int least) const { return at ? count(*at, least) : 0; }

  /// As CsvReader's; but a column "name [unit]" that is there in another unit, or without one, is
  /// an error and not a missing column.
  std::optional<std::size_t> column(std::string_view title) const {
    if (const auto found = CsvReader::column(title)) return found;
    const auto bare = [](std::string_view text) { return text.substr(0, text.find(" [")); };
    if (bare(title) != title)
      for (const auto& other : header())
        if (bare(other) == bare(title)) fail(fmt::format("a column '{}'", title), other);
    return std::nullopt;
  }

  /// Columns "name [unit]" and "name_ci95 [unit]", which may be missing.
  using Pair = std::pair<std::optional<std::size_t>, std::optional<std::size_t>>;
  Pair pair(std::string_view name, std::string_view unit) const {
    return {column(fmt::format("{} [{}]", name, unit)),
            column(fmt::format("{}_ci95 [{}]", name, unit))};
  }
  Estimate estimate(const Pair& columns) const {
    const double ci95 = number(columns.second);
    if (ci95 < 0 || std::isinf(ci95))
      fail(fmt::format("a half-width of at least 0 for '{}', or nan", header()[*columns.second]),
           fmt::format("{}", ci95));
    return {number(columns.first), ci95};
  }

 private:
  std::optional<std::size_t> run_column_, type_;
  std::optional<std::string> run_;
};

}  // namespace bedscope::analysis
