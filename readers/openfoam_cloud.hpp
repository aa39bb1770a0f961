// SPDX-License-Identifier: BSD-3-Clause
// Where the parcels of a Lagrangian cloud are: cartesian positions and barycentric coordinates.
#pragma once

#include <cstddef>
#include <vector>

#include "readers/openfoam_blocks.hpp"
#include "readers/openfoam_mesh.hpp"

namespace bedscope::readers {

/// The mesh of one rank as parcels refer to it.
struct CloudMesh {
  PolyMesh poly;
  std::vector<Point> centres;  ///< of its cells
  /// The first point of the triangles of each face (tet_base_points); empty: 0 of all.
  std::vector<std::int32_t> base;
};

struct CloudPoints {
  std::vector<Point> at;      ///< [m]
  std::size_t off_sum = 0;    ///< parcels whose barycentric coordinates do not sum to 1
  std::size_t first_off = 0;  ///< the first of them,
  double first_sum = 1;       ///< and its sum
};

/// The number of parcels that an open file of class Cloud<...> declares; at most what its bytes can
/// hold.
std::size_t read_cloud_count(FoamBlocks& file);

/// Adds the positions in an open file of class Cloud<...>. Its name does not tell the form:
/// `(x y z) cell`, or `(a b c d) cell tetFace tetPt` (also in `positions`, Foundation 5 and later);
/// in binary records of 3 scalars + 1 label, 4 scalars + 3 labels, or the 40 bytes of old versions.
///
///   x = a centre(cell) + b p[0] + c p[i] + d p[i+1],  p the points of tetFace from its base on, i
///   = tetPt,
///
/// c and d exchanged where the cell does not own tetFace. Throws FormatError where tetFace does not
/// bound the cell or has no such triangle. `mesh` is asked for only if needed.
/// Source: OpenFOAM, particle::currentTetTransform and tetIndices (v1706 and later).
void read_cloud_points(FoamBlocks& file, const std::function<const CloudMesh&()>& mesh,
                       CloudPoints& out);

}  // namespace bedscope::readers
