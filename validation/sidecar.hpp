// SPDX-License-Identifier: BSD-3-Clause
// The sidecar of a file of curves: <name>.toml beside <name>.csv.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "validation/curve.hpp"

namespace bedscope::validation {

/// How the uncertainty of an axis is told: by a column, a number, a share of the value, or not.
struct UncertaintyRule {
  std::string column;
  bool is_interval = false;  ///< the column holds half-widths of 95 % intervals
  std::optional<double> absolute, relative;
  bool stated() const { return !column.empty() || absolute || relative; }
};

struct Sidecar {
  Provenance about;
  std::string abscissa, ordinate;  ///< names of columns; empty: the last two that are no others'
  bool table = false;
  UncertaintyRule u_x, u_y;
};

/// The whole text as a number; nothing where it is none.
std::optional<double> to_number(std::string_view text);

/// The sidecar of a CSV file; an empty one where there is none. Throws InputError (line and key).
Sidecar sidecar_of(const std::string& csv);

}  // namespace bedscope::validation
