// SPDX-License-Identifier: BSD-3-Clause
// Particles in VTK's XML files: .vtp (PolyData) and .vtu (UnstructuredGrid), as LIGGGHTS, OpenFOAM
// and MFiX write them and ParaView saves them again. One snapshot a file.
#include "readers/vtk_xml.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "readers/columns.hpp"
#include "readers/forms.hpp"
#include "readers/source.hpp"

namespace bedscope::readers {
namespace {

using namespace vtk_xml_file;

// Cell types of vtkCellType.h that matter here.
constexpr int vertex = 1, poly_vertex = 2, line = 3, hexahedron = 12;

// An array with more components is no vector of the field; it gives no columns.
constexpr std::size_t max_components = 64;

// The whole file, in a buffer that only grows.
std::string_view read_all(Source& source, std::vector<char>& buffer) {
  constexpr std::size_t piece = std::size_t{1} << 20;
  std::size_t length = 0;
  const std::size_t first = source.compressed() ? piece : source.size_bound() + 1;
  if (buffer.size() < first) buffer.resize(first);
  while (true) {
    length += source.read(std::span(buffer).subspan(length));
    if (length < buffer.size()) break;
    buffer.resize(2 * buffer.size());
  }
  if (!source.cut().empty()) throw CutError("{}: {}", source.path(), source.cut());
  return {buffer.data(), length};
}

const Piece* first_with_points(const Document& document) {
  for (const Piece& piece : document.pieces) {
    if (piece.points > 0) return &piece;
  }
  return document.pieces.empty() ? nullptr : &document.pieces.front();
}

bool gives_columns(const DataArray& array) {
  return array.type != Number::other && array.components <= max_components;
}

// Where a column of the flat list comes from.
struct Place {
  const DataArray* array;  // of the first piece with points
  std::size_t component;
};

struct FlatColumns {
  std::vector<std::string> names;
  std::vector<Place> places;
};

// The columns that a file has: x y z, then those of each array. An array that calls itself x is not
// offered: the points are what VTK draws.
FlatColumns flat_columns(const Document& document) {
  FlatColumns flat;
  const Piece* piece = first_with_points(document);
  if (piece == nullptr) return flat;
  const DataArray* points = piece->coordinates.empty() ? nullptr : &piece->coordinates.front();
  for (std::size_t c = 0; c < 3; ++c) {
    flat.names.emplace_back(1, "xyz"[c]);
    flat.places.push_back({points, c});
  }
  for (const DataArray& array : piece->point_data) {
    if (!gives_columns(array)) continue;
    const auto names = component_names(array.name, static_cast<int>(array.components));
    for (std::size_t c = 0; c < names.size(); ++c) {
      if (names[c] == "x" || names[c] == "y" || names[c] == "z") continue;
      flat.names.push_back(names[c]);
      flat.places.push_back({&array, c});
    }
  }
  return flat;
}

// The array of `piece` that continues one of the first piece with points. Names may be doubled:
// then their order counts.
const DataArray& same_array(const Document& document, const Piece& piece, const DataArray& first) {
  const Piece& origin = *first_with_points(document);
  const bool coordinate = &first == origin.coordinates.data();
  const Arrays& arrays = coordinate ? piece.coordinates : piece.point_data;
  const Arrays& others = coordinate ? origin.coordinates : origin.point_data;
  const auto index = static_cast<std::size_t>(&first - others.data());
  const DataArray* found = index < arrays.size() && arrays[index].name == first.name
                               ? &arrays[index]
                               : find(arrays, first.name);
  if (coordinate) found = &arrays.front();
  const auto complain = [&](const std::string& text) {
    throw FormatError("{}: line {}: <Piece>: {}", document.path,
                      line_of(document.bytes, piece.position), text);
  };
  if (found == nullptr) complain(fmt::format("no array {}, the first one has it", first.name));
  if (found->components != first.components) {
    complain(fmt::format("array {} has {} components, in the first one {}", first.name,
                         found->components, first.components));
  }
  return *found;
}

// ---- What the cells say: particles, or something else

struct CellKinds {
  std::map<int, std::uint64_t> types;  // of an UnstructuredGrid
  std::uint64_t points = 0, vertices = 0, lines = 0, strips = 0, polys = 0, cells = 0;
  std::size_t cell_arrays = 0, point_arrays = 0;
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
    kinds.cell_arrays = std::max(kinds.cell_arrays, piece.cell_arrays);
    kinds.point_arrays = std::max(kinds.point_arrays, piece.point_data.size());
    if (piece.polys.count > 0) {
      kinds.triangles &= each_has(document, piece, piece.polys, 3, decoder);
    }
    if (piece.lines.count > 0) kinds.pairs &= each_has(document, piece, piece.lines, 2, decoder);
    if (piece.cells.count == 0) continue;
    decoder.decode(cell_array(document, piece, piece.cells, "types"), piece.cells.count, types);
    for (const double type : types) ++kinds.types[static_cast<int>(type)];
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

// What the file holds instead of particles; empty for particles.
std::string describe(const Document& document, Decoder& decoder) {
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

// ---- Thorough checks

// The cells may name only points that are there; those that no vertex names are worth a word.
void check_vertices(const Document& document, const Piece& piece, const CellGroup& group,
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
    if (point < 0 || point >= static_cast<double>(piece.points)) {
      decoder.fail(connectivity, "point {} of {}", point, piece.points);
    }
  }
  if (named != piece.points) {
    problems.push_back(fmt::format("line {}: {} points, the cells name {}; all points are read",
                                   line_of(document.bytes, piece.position), piece.points, named));
  }
}

void check_arrays(const Document& document, Decoder& decoder, std::vector<std::string>& problems) {
  const Piece* first = first_with_points(document);
  for (const Piece& piece : document.pieces) {
    if (piece.points == 0) {
      for (const DataArray& array : piece.point_data) {
        if (array.storage == Storage::ascii && !array.text.empty()) {
          problems.push_back(fmt::format("line {}: array {} holds numbers, but NumberOfPoints is 0",
                                         line_of(document.bytes, array.position), array.name));
        }
      }
      continue;
    }
    decoder.decode(piece.coordinates.front(), piece.points, std::span<double* const>());
    for (const DataArray& array : piece.point_data) {
      if (array.type != Number::other) {
        decoder.decode(array, piece.points, std::span<double* const>());
      } else if (array.type_name != "String") {
        problems.push_back(
            fmt::format("line {}: array {}: type '{}' is not a type of numbers, not read",
                        line_of(document.bytes, array.position), array.name, array.type_name));
      }
    }
    for (const DataArray& array : first->point_data) {
      if (gives_columns(array)) same_array(document, piece, array);
    }
    check_vertices(document, piece, piece.verts, decoder, problems);
    check_vertices(document, piece, piece.cells, decoder, problems);
  }
}

// ---- The form

bool matches(std::string_view head) {
  constexpr std::string_view grids[] = {"PolyData",       "UnstructuredGrid", "RectilinearGrid",
                                        "StructuredGrid", "ImageData",        "?"};
  const std::string type = xml_root_type(head);
  return std::find(std::begin(grids), std::end(grids), type) != std::end(grids);
}

FileScan scan(const std::string& path, bool thorough) {
  std::vector<char> buffer;
  Source source(path);
  const Document document = parse_document(read_all(source, buffer), path);
  Decoder decoder(document);
  FileScan found;
  found.not_particles = describe(document, decoder);
  if (!found.not_particles.empty()) return found;
  if (thorough) check_arrays(document, decoder, found.problems);
  const std::string_view rest = trimmed(document.bytes.substr(document.end));
  if (!rest.empty()) {
    found.problems.push_back(fmt::format("{} bytes after </VTKFile>", rest.size()));
  }
  if (!source.trailing().empty()) found.problems.push_back(source.trailing());

  Located snapshot;
  snapshot.time = document.time;
  snapshot.particles = static_cast<std::int64_t>(document.points());
  std::vector<std::string> names;
  if (const Piece* piece = first_with_points(document)) {
    for (const DataArray& array : piece->point_data) names.push_back(array.name);
  }
  snapshot.columns = std::make_shared<const std::vector<std::string>>(std::move(names));
  found.snapshots.push_back(std::move(snapshot));
  return found;
}

// Decodes each array that holds one of the columns to parse, once for each piece.
void fill_columns(const Document& document, const FlatColumns& flat, const ColumnPlan& plan,
                  Scratch& scratch) {
  Decoder decoder(document);
  std::array<double*, max_components> columns{};
  for (std::size_t k = 0; k < plan.parse.size();) {
    const Place& place = flat.places[static_cast<std::size_t>(plan.parse[k])];
    const std::size_t begin = k;
    for (++k; k < plan.parse.size(); ++k) {
      if (flat.places[static_cast<std::size_t>(plan.parse[k])].array != place.array) break;
    }
    std::size_t row = 0;
    for (const Piece& piece : document.pieces) {
      if (piece.points == 0) continue;
      columns.fill(nullptr);
      for (std::size_t i = begin; i < k; ++i) {
        columns[flat.places[static_cast<std::size_t>(plan.parse[i])].component] =
            scratch.raw[i].data() + row;
      }
      const DataArray& array = same_array(document, piece, *place.array);
      decoder.decode(array, piece.points, std::span(columns).first(array.components));
      row += piece.points;
    }
  }
}

void compare_twins(const std::string& path, const FlatColumns& flat, const ColumnPlan& plan,
                   const std::vector<std::vector<double>>& raw) {
  for (const auto& [first, second] : plan.twins) {
    const std::vector<double>& a = raw[static_cast<std::size_t>(first)];
    const std::vector<double>& b = raw[static_cast<std::size_t>(second)];
    const auto same = [](double left, double right) {
      return left == right || (std::isnan(left) && std::isnan(right));
    };
    const auto [at, other] = std::mismatch(a.begin(), a.end(), b.begin(), same);
    if (at == a.end()) continue;
    const auto column = static_cast<std::size_t>(plan.parse[static_cast<std::size_t>(first)]);
    throw FormatError("{}: column \"{}\" twice with different values (point {}: {} and {})", path,
                      flat.names[column], at - a.begin(), *at, *other);
  }
}

void read(const std::string& path, const Located& /*where*/, const Request& request, Snapshot& out,
          Scratch& scratch) {
  Source source(path);
  const Document document = parse_document(read_all(source, scratch.bytes), path);
  if (!document.is_particle_grid()) {
    throw FormatError("{}: expected particles, found a grid ({})", path, document.type);
  }
  const FlatColumns flat = flat_columns(document);
  const ColumnPlan plan = plan_columns(flat.names, request, path);
  out.step = no_step;
  out.time = document.time;
  out.particles = document.points();
  out.box = {};
  out.bytes_read = source.bytes_from_disk();
  scratch.raw.resize(plan.parse.size());
  for (auto& column : scratch.raw) column.resize(out.particles);
  fill_columns(document, flat, plan, scratch);
  compare_twins(path, flat, plan, scratch.raw);
  finish_columns(plan, scratch.raw, out, path);
}

}  // namespace

extern const Form vtk_xml;
const Form vtk_xml = {"vtk-xml",
                      "VTK XML particles, .vtp and .vtu (LIGGGHTS, OpenFOAM, ParaView)",
                      "https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html",
                      matches,
                      scan,
                      read};

}  // namespace bedscope::readers
