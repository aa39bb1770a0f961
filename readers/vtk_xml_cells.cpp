// SPDX-License-Identifier: BSD-3-Clause
// What the cells of a VTK XML file say: particles, or a mesh, contacts, the box of a dump.
#include <algorithm>
#include <map>

#include "readers/vtk_xml.hpp"

namespace bedscope::readers::vtk_xml_file {
namespace {

// Cell types of vtkCellType.h that matter here.
constexpr int vertex = 1, poly_vertex = 2, line = 3, hexahedron = 12;

struct CellKinds {
  std::map<int, std::uint64_t> types;  // of an UnstructuredGrid
  std::uint64_t points = 0, vertices = 0, lines = 0, strips = 0, polys = 0, cells = 0;
  std::size_t point_arrays = 0;
  bool triangles = true;  // all polys
  bool pairs = true;      // all lines have two points
};

const DataArray& cell_array(const Document& document, const Piece& piece, const CellGroup& group,
                            std::string_view name) {
  const DataArray* array = find(group.arrays, name);
  if (array == nullptr) {
    throw FormatError("{}: line {}: <Piece> of {} cells has no array {}", document.path,
                      line_of(document.bytes, piece.position), group.count, name);
  }
  return *array;
}

// Whether each cell has that many points, by its end in the connectivity.
bool each_has(const Document& document, const Piece& piece, const CellGroup& group, int points,
              Decoder& decoder) {
  std::vector<double> ends;
  decoder.decode(cell_array(document, piece, group, "offsets"), group.count, ends);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i] != static_cast<double>(i + 1) * points) return false;
  }
  return true;
}

CellKinds count_cells(const Document& document, Decoder& decoder) {
  CellKinds kinds;
  std::vector<double> types;
  for (const Piece& piece : document.pieces) {
    kinds.points += piece.points;
    kinds.vertices += piece.verts.count;
    kinds.lines += piece.lines.count;
    kinds.strips += piece.strips.count;
    kinds.polys += piece.polys.count;
    kinds.cells += piece.cells.count;
    kinds.point_arrays = std::max(kinds.point_arrays, piece.point_data.size());
    if (piece.polys.count > 0) {
      kinds.triangles &= each_has(document, piece, piece.polys, 3, decoder);
    }
    if (piece.lines.count > 0) kinds.pairs &= each_has(document, piece, piece.lines, 2, decoder);
    if (piece.cells.count == 0) continue;
    decoder.decode(cell_array(document, piece, piece.cells, "types"), piece.cells.count, types);
    for (const double type : types) {
      if (!(type >= 0 && type <= 255)) {
        decoder.fail(cell_array(document, piece, piece.cells, "types"),
                     "expected cell types from 0 to 255, found {}", type);
      }
      ++kinds.types[static_cast<int>(type)];
    }
  }
  return kinds;
}

std::string describe_grid(const CellKinds& kinds) {
  const std::uint64_t vertices = kinds.types.count(vertex) ? kinds.types.at(vertex) : 0;
  const std::uint64_t clouds = kinds.types.count(poly_vertex) ? kinds.types.at(poly_vertex) : 0;
  // Bonds between particles are lines beside one vertex for each point.
  if (vertices + clouds == kinds.cells || vertices == kinds.points) return {};
  if (kinds.types.count(line) && kinds.types.at(line) == kinds.cells) {
    return fmt::format("contacts (lines of two points: {})", kinds.cells);
  }
  if (kinds.cells == 1 && kinds.points == 8 && kinds.types.count(hexahedron) &&
      kinds.point_arrays == 0) {
    return "the bounding box of a dump (one hexahedron)";
  }
  std::string types;
  for (const auto& [type, count] : kinds.types) {
    types += fmt::format("{}{} of VTK type {}", types.empty() ? "" : ", ", count, type);
    if (types.size() > 60) break;
  }
  return fmt::format("a mesh of {} cells ({})", kinds.cells, types);
}

}  // namespace

std::string what_instead_of_particles(const Document& document, Decoder& decoder) {
  if (!document.is_particle_grid()) {
    if (document.type == "RectilinearGrid" && document.extent == "0 1 0 1 0 1") {
      return "the bounding box of a dump (RectilinearGrid of 8 points)";
    }
    return fmt::format("a grid ({})", document.type);
  }
  const CellKinds kinds = count_cells(document, decoder);
  if (document.type == "UnstructuredGrid") return describe_grid(kinds);
  if (kinds.vertices == kinds.points && kinds.points > 0) return {};
  if (kinds.polys > 0) {
    return kinds.triangles ? fmt::format("a triangle mesh ({} triangles)", kinds.polys)
                           : fmt::format("a surface mesh ({} polygons)", kinds.polys);
  }
  if (kinds.strips > 0) return fmt::format("a surface mesh ({} triangle strips)", kinds.strips);
  if (kinds.lines > 0) {
    return kinds.pairs ? fmt::format("contacts (lines of two points: {})", kinds.lines)
                       : fmt::format("lines ({})", kinds.lines);
  }
  return {};
}

void check_cells(const Document& document, const Piece& piece, const CellGroup& group,
                 Decoder& decoder, std::vector<std::string>& problems) {
  if (group.count == 0) return;
  std::vector<double> values;
  decoder.decode(cell_array(document, piece, group, "offsets"), group.count, values);
  double last = 0;
  const DataArray& connectivity = cell_array(document, piece, group, "connectivity");
  for (const double end : values) {
    if (!(end >= last)) decoder.fail(connectivity, "offset {} follows {}", end, last);
    last = end;
  }
  const DataArray& offsets = cell_array(document, piece, group, "offsets");
  if (last > static_cast<double>(document.bytes.size()) * 8192) {
    decoder.fail(offsets, "{} points claimed, more than the file can hold", last);
  }
  const auto named = static_cast<std::uint64_t>(last);
  decoder.decode(connectivity, named, values);
  for (const double point : values) {
    if (!(point >= 0 && point < static_cast<double>(piece.points))) {
      decoder.fail(connectivity, "point {} of {}", point, piece.points);
    }
  }
  if (named != piece.points) {
    problems.push_back(fmt::format("line {}: {} points, the cells name {}; all points are read",
                                   line_of(document.bytes, piece.position), piece.points, named));
  }
}

}  // namespace bedscope::readers::vtk_xml_file
