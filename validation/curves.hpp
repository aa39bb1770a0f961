// SPDX-License-Identifier: BSD-3-Clause
// The registry of curves: folders of CSV files with units in their headers, each with a sidecar
// (<name>.toml) that says where its numbers come from. docs/validation.md tells what it may hold.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "readers/error.hpp"
#include "validation/curve.hpp"
#include "validation/quantity.hpp"

namespace bedscope::validation {

/// A set whose numbers must not be passed on and that the user has not supplied: what needs it is
/// skipped, not failed.
class MissingCurve : public InputError {
 public:
  using InputError::InputError;
};

/// A column besides abscissa, ordinate and their uncertainties: what a selection names.
struct Parameter {
  Title title;
  std::vector<std::string> values;  ///< that occur, ascending
};

/// One file of curves.
struct CurveSet {
  std::string name;  ///< "varas_2017/lateral_holdup"
  std::string path;  ///< of the CSV
  Title x, y;        ///< empty for tables, which hold no curve
  std::vector<Parameter> parameters;
  std::size_t points = 0;
  bool available = true;  ///< false: only the sidecar is there (redistribute = "no")
  Provenance about;
};

class Curves {
 public:
  /// Reads and checks every file of these folders (and of their subfolders); of two sets of one
  /// name the first folder's is taken. Throws FileError, FormatError (a column without unit, a
  /// value that is no number, with line), InputError (a sidecar with an unknown key). `base`: the
  /// folder that paths of CSV files are relative to; empty: where the program runs.
  static Curves open(std::span<const std::string> folders, const std::filesystem::path& base = {});

  const std::vector<CurveSet>& sets() const { return sets_; }

  /// The curve of a selection such as "varas_2017/lateral_holdup?U=5.55&height=0.8"; parameters
  /// that it does not name are taken from `at` where they occur there. A path of a CSV file works
  /// as a name, too. Throws InputError (no such curve: names the nearest; a selection that leaves
  /// no point, or several curves: lists what there is; a key of `at` that neither the quantity of
  /// the place nor the curve knows), MissingCurve.
  Curve curve(const std::string& selection, const Place& place = {}) const;

 private:
  std::vector<CurveSet> sets_;
  std::filesystem::path base_;
};

/// Standard uncertainties taken where a digitised plot states none, as shares of the curve's range:
/// two independent digitisations of one figure (Kharaz et al. 2001) differ by 0.3 to 1.5 %.
inline constexpr double assumed_u_x = 0.005, assumed_u_y = 0.01;

}  // namespace bedscope::validation
