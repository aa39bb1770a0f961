// SPDX-License-Identifier: BSD-3-Clause
// The mesh that the cells of VTK files make: hexahedra, tetrahedra, wedges, pyramids, voxels,
// prisms and polyhedra. Internal to this room.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "readers/openfoam_mesh.hpp"

namespace bedscope::readers {

/// The cells of one piece, as they are on disk; whole numbers in doubles, as decoders give them.
struct VtkCells {
  std::vector<Point> points;
  double resolution = 0;             ///< that these are rounded to [m]
  std::vector<double> connectivity;  ///< points of all cells
  std::vector<double> ends;          ///< of each cell in these
  std::vector<double> types;         ///< of each cell (vtkCellType.h)
  /// Of polyhedra: [faces] and for each [points] point ...; where each ends, less than 0 for
  /// others.
  std::vector<double> faces, face_ends;
  std::vector<bool> ghosts;  ///< cells that another piece owns; empty: none
};

/// Throws FormatError for a point that is not finite.
std::vector<Point> points_of(const std::array<std::vector<double>, 3>& axes,
                             const std::string& path);
/// What coordinates are rounded to [m]: the sixth digit in text, as OpenFOAM prints them, the last
/// bit of a float.
double resolution_of(std::span<const Point> points, bool text, bool single);

/// True for cells that fill a volume.
bool is_volume(double vtk_type);

/// Centres and volumes as OpenFOAM has them (cell_geometry), of all pieces but their ghosts.
/// Decomposed polyhedra stay the cells that they were cut into.
/// Throws FormatError naming the cell: labels out of range, a type that fills no volume, a cell of
/// the wrong number of points, that is not closed or has no volume.
Mesh mesh_of(std::span<const VtkCells> pieces, const std::string& path);

}  // namespace bedscope::readers
