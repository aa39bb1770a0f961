// SPDX-License-Identifier: BSD-3-Clause
// How faces are cut into triangles, which barycentric coordinates of parcels refer to. Internal to
// this room.
#pragma once

#include <cstdint>
#include <vector>

#include "readers/openfoam_blocks.hpp"
#include "readers/openfoam_mesh.hpp"

namespace bedscope::readers {

/// The point of each face, counted along it, that its triangles have in common: what an open
/// tetBasePtIs of the mesh says, else (`file` null) the first point from which all tetrahedra of
/// the triangles and the centres of the cells on both sides have a positive volume. That is 0 but
/// for faces that are warped or not convex; 0, too, where no point will do (-1 in the file). Of
/// faces between processors and of cyclic ones only the side that is here is looked at, where
/// OpenFOAM looks at both. Throws FormatError.
/// Source: OpenFOAM v1912, polyMeshTetDecomposition::findFaceBasePts, tetIndices.
std::vector<std::int32_t> tet_base_points(const PolyMesh& mesh, const std::vector<Point>& centres,
                                          FoamBlocks* file);

}  // namespace bedscope::readers
