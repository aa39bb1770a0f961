// SPDX-License-Identifier: BSD-3-Clause
// One row of a postProcessing table, and what its values are called.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace bedscope::readers {

struct FoamTable;

/// A row taken apart: "0.1 (1 2 3) word" has five leaves in three items. Blanks and commas
/// separate.
struct FoamRow {
  static constexpr std::size_t deepest = 3;  ///< forces have two levels of parentheses
  struct Leaf {
    std::string_view text;
    double number = 0;
    bool is_number = false;
    std::size_t item = 0;                      ///< counted from 0 outside of parentheses
    std::size_t depth = 0;                     ///< parentheses around it
    std::array<std::size_t, deepest> place{};  ///< at each level, from 0
    std::array<std::size_t, deepest> count{};  ///< of members of its group at each level
  };
  std::vector<Leaf> leaves;

  /// Takes `text` apart, into which the leaves then point; says what is wrong with it.
  std::string parse(std::string_view text);
};

/// "U" and the second leaf of three: "U y"; "forces(pressure viscous)" with groups in a group:
/// "forces pressure y"; a member of a group of any other size has its number.
std::string leaf_title(const std::string& item, const FoamRow::Leaf& leaf);

/// Words of a line of titles; blanks within parentheses belong to the title.
std::vector<std::string> split_titles(std::string_view line);

/// "p" of ".../0/p", "surfaceFieldValue" of ".../0/surfaceFieldValue.dat.gz".
std::string field_name(const std::string& path);

/// Drops the rows from the first one at `time` or later on.
void drop_from(FoamTable& table, double time);

}  // namespace bedscope::readers
