// SPDX-License-Identifier: BSD-3-Clause
// polyMesh: the faces that bound the cells, and what the analysis needs of it: centres, volumes,
// and where the cells are boxes, the boxes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "readers/openfoam_blocks.hpp"

namespace bedscope::readers {

using Point = std::array<double, 3>;  ///< [m]

/// A patch of the boundary: faces start ... start + faces - 1.
struct FoamPatch {
  std::string name, type;
  std::int64_t start = 0, faces = 0;
};

/// The files of polyMesh as they are, checked: labels in range, counts agree.
struct PolyMesh {
  std::vector<Point> points;
  std::vector<std::int32_t> face_starts;  ///< of face f in face_points; one more than faces
  std::vector<std::int32_t> face_points;
  std::vector<std::int32_t> owner;      ///< a cell for each face
  std::vector<std::int32_t> neighbour;  ///< a cell for each internal face; these come first
  std::vector<FoamPatch> patches;
  std::size_t cells = 0;

  std::size_t faces() const { return owner.size(); }
  std::span<const std::int32_t> face(std::size_t f) const {
    return std::span(face_points)
        .subspan(static_cast<std::size_t>(face_starts[f]),
                 static_cast<std::size_t>(face_starts[f + 1] - face_starts[f]));
  }
};

/// Opens a file of polyMesh by its name ("owner"), at the block to be read; null where it is
/// absent.
using OpenMeshFile = std::function<std::unique_ptr<FoamBlocks>(std::string_view name)>;

/// Reads points, faces, owner, neighbour and (if there) boundary.
/// Throws FormatError naming the file, the face and the label that is wrong.
PolyMesh read_poly_mesh(const OpenMeshFile& open);

/// Cells that are boxes along the axes: cell c covers faces[a][low[c][a]] ... faces[a][high[c][a]]
/// along axis a.
struct BoxCells {
  std::array<std::vector<double>, 3> faces;  ///< ascending coordinates of the planes [m]
  std::vector<std::array<std::int32_t, 3>> low, high;
  /// A rectilinear grid: every cell lies between neighbouring planes, so that low is its (i, j, k).
  /// Holes are allowed; false for meshes that are refined in places.
  bool rectilinear = false;
};

/// The faces of cells that are not boxes: cell k of `poly` is cell `cells[k]` of the mesh.
struct MeshPart {
  std::shared_ptr<const PolyMesh> poly;
  std::vector<std::int32_t> cells;
};

/// What the analysis takes: cells in the order of the fields.
struct Mesh {
  std::vector<Point> centres;     ///< [m]
  std::vector<double> volumes;    ///< [m3]
  std::optional<BoxCells> boxes;  ///< where every cell is a box along the axes
  std::vector<Point> extents;     ///< of the box around each cell [m], where they are not boxes
  std::vector<MeshPart> parts;    ///< all cells, each once, where they are not boxes
  Point min{}, max{};             ///< of all points [m]
  double resolution = 0;          ///< coordinates on disk are rounded to this [m]; 0: to doubles
  /// Patches of all ranks together; those between ranks are left out, and `start` is of the rank
  /// that names the patch first.
  std::vector<FoamPatch> patches;

  std::size_t cells() const { return volumes.size(); }
  double volume() const;  ///< of all cells [m3]
};

/// Centres and volumes of the cells and the box around each.
struct CellGeometry {
  std::vector<Point> centres;
  std::vector<double> volumes;
  std::vector<Point> low, high;
};

/// Centres and volumes as OpenFOAM computes them (primitiveMesh: calcFaceCentresAndAreas,
/// calcCellCentresAndVols of v1912): a face is cut into triangles about the average of its points,
/// a cell into pyramids about the average of its face centres. Exact for plane faces.
CellGeometry cell_geometry(const PolyMesh& mesh);

/// The mesh of the cells, boxes recognised: a cell is one if it fills the box around it: its volume
/// is that of the box to 1e-6 and what coordinates that are rounded to `resolution` [m] can tell.
/// The parts are let go where all are boxes.
Mesh make_mesh(CellGeometry cells, std::vector<MeshPart> parts = {}, double resolution = 0);
/// The same of one part, all cells in its order.
Mesh make_mesh(PolyMesh poly);

}  // namespace bedscope::readers
