// SPDX-License-Identifier: BSD-3-Clause
// From names on disk to the field's names: which columns to parse, and what to do with them.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "readers/snapshot.hpp"

namespace bedscope::readers {

/// How a request is served by the columns of one file: which to parse, then how to finish them.
struct ColumnPlan {
  std::vector<int> parse;  ///< indices into the names on disk, ascending, without repetition
  struct Output {
    std::array<int, 3> raw{-1, -1, -1};  ///< positions in `parse`; several for triclinic scaling
    double factor = 1;                   ///< diameter to radius
    int scaled_axis = -1;                ///< 0..2: a box fraction along this axis, else -1
    int parcels = -1;  ///< position in `parse` of how many particles a row stands for, else -1
  };
  std::vector<Output> outputs;  ///< one a requested column; raw[0] < 0: absent
  /// Positions in `parse` of columns that carry one name: they must agree (`type type` is usual).
  std::vector<std::array<int, 2>> twins;
};

/// What a row of a parcel stands for (OpenFOAM). Its radius is that of one sphere of the volume of
/// so many particles.
inline constexpr std::string_view parcel_column = "nParticle";

/// Finds the columns asked for among `names` (doubled names: the last is taken, and
/// both are parsed so that the reader can compare them).
/// `where` ("path: line 9") begins the text of the FormatError for a required column that is
/// absent.
ColumnPlan plan_columns(std::span<const std::string> names, const Request& request,
                        const std::string& where);

/// Whether a request for this name can be served.
bool has_column(std::span<const std::string> names, const std::string& wanted);

/// The name on disk that serves the field's name (`temperature`: f_Temp[0]); the same name where
/// none does.
std::string name_on_disk(std::span<const std::string> names, const std::string& wanted);

/// Moves or computes the requested columns out of the parsed ones (raw[k] belongs to parse[k]).
/// Throws FormatError where a scaled coordinate needs a box that is not known.
void finish_columns(const ColumnPlan& plan, std::vector<std::vector<double>>& raw, Snapshot& out,
                    const std::string& where);

/// Names of the components of a vector array of a VTK file, in LIGGGHTS' spelling:
/// `v` gives vx vy vz, `f_dragforce[1-3]` gives f_dragforce[1] f_dragforce[2] f_dragforce[3].
std::vector<std::string> component_names(std::string_view array, int components);

}  // namespace bedscope::readers
