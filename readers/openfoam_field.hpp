// SPDX-License-Identifier: BSD-3-Clause
// volScalarField, volVectorField ... and their ::Internal forms: one value for each cell.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "readers/openfoam_blocks.hpp"
#include "readers/openfoam_list.hpp"

namespace bedscope::readers {

/// The values of one field at one time, units as `dimensions` says (SI).
struct FieldValues {
  std::string class_name;      ///< volScalarField ...; empty where a file has no header
  unsigned components = 0;     ///< 1, 3, 6 (xx xy xz yy yz zz) or 9
  std::vector<double> values;  ///< components of a cell together, cells in the order of the mesh
  /// Powers of kg m s K mol A cd. A pressure has [1 -1 -2 ...], one over density [0 2 -2 ...].
  std::array<double, 7> dimensions{};
  bool dimensions_known = false;
  bool uniform = false;                     ///< one value on disk, repeated here
  NonFinite non_finite;                     ///< cells that hold nan or inf: never into a mean
  bool no_header = false;                   ///< read as ascii, its class from List<...>
  bool binary = false, compressed = false;  ///< how it lies on disk
};

/// A value that OpenFOAM computes when it reads the file (#calc, #codeStream): code is never run.
class CodeError : public FormatError {
 public:
  using FormatError::FormatError;
};

/// The class of a field as type of its values ("volVectorField", "volVectorField::Internal",
/// older "volVectorField::DimensionedInternalField"); null for other classes (surface and point
/// fields too).
const FoamType* vol_field_type(std::string_view class_name);

/// The same for all fields on a mesh: volScalarField, surfaceVectorField, pointScalarField ...
const FoamType* mesh_field_type(std::string_view class_name);

/// Reads a field out of an open file or block. `where` names the block in errors. The boundary is
/// only followed as far as its braces need.
/// Fields of faces and points are read alike.
/// Throws FormatError (line, expected, found), CodeError, and CutError where the file ends early.
/// With `places` (of the cells of a rank in the whole mesh) the values go there.
void read_field(FoamBlocks& file, std::optional<FoamCount> cells, FieldValues& out,
                const FoamPlaces* places = nullptr);

}  // namespace bedscope::readers
