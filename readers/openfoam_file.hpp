// SPDX-License-Identifier: BSD-3-Clause
// One OpenFOAM file by itself, whatever its class: what it is, how many values, their ranges.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "readers/openfoam_survey.hpp"

namespace bedscope::readers {

struct FoamFileSummary {
  std::string class_name;  ///< as its header says: volScalarField, labelList, Cloud<...>
  bool binary = false, compressed = false;
  std::string arch;
  bool collated = false;
  std::vector<std::size_t> blocks;  ///< values of each rank; one for a plain file
  /// Values (cells, points, faces, parcels, labels, entries); nothing for a uniform field, whose
  /// number the mesh tells, and for classes that are not looked into.
  std::optional<std::size_t> count;
  std::string what;  ///< "cells", "faces", "points", "parcels", "labels", "values", "entries" ...
  bool uniform = false;
  std::vector<FoamRange> ranges;  ///< a component each; x, y, z of positions; corners of faces
  std::size_t non_finite = 0;     ///< values
  std::array<double, 7> dimensions{};
  bool dimensions_known = false;
  std::vector<std::string> problems;
};

/// Does the file begin with FoamFile { ... }, comments aside? Throws FileError.
bool is_openfoam_file(const std::string& path);

/// Reads one file. Positions by barycentric coordinates need the mesh of the case around it; a
/// uniform list of a cloud the positions beside it. Throws FormatError, CutError, FileError.
FoamFileSummary summarise_openfoam_file(const std::string& path);

}  // namespace bedscope::readers
