// SPDX-License-Identifier: BSD-3-Clause
// Particles in VTK's XML files: .vtp (PolyData) and .vtu (UnstructuredGrid), as LIGGGHTS, OpenFOAM
// and MFiX write them and ParaView saves them again. One snapshot a file.
#include "readers/vtk_xml.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "readers/columns.hpp"
#include "readers/forms.hpp"
#include "readers/source.hpp"
#include "readers/vtk_common.hpp"

namespace bedscope::readers {
namespace {

using namespace vtk_xml_file;

// An array with more components is no vector of the field; it gives no columns.
constexpr std::size_t max_components = 64;

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
  const DataArray* points =
      piece == nullptr || piece->coordinates.empty() ? nullptr : &piece->coordinates.front();
  for (std::size_t c = 0; c < 3; ++c) {
    flat.names.emplace_back(1, "xyz"[c]);
    flat.places.push_back({points, c});
  }
  if (piece == nullptr) return flat;
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

// Decodes everything: where one array is damaged the snapshot is not to be trusted.
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
    check_cells(document, piece, piece.verts, decoder, problems);
    check_cells(document, piece, piece.cells, decoder, problems);
  }
}

// ---- The form

bool matches(std::string_view head) {
  constexpr std::string_view grids[] = {"PolyData",       "UnstructuredGrid", "RectilinearGrid",
                                        "StructuredGrid", "ImageData",        "?"};
  const std::string type = xml_root_type(head);
  return std::find(std::begin(grids), std::end(grids), type) != std::end(grids);
}

FileScan found_in(const Document& document, Decoder& decoder) {
  FileScan found;
  const std::string_view rest = trimmed(document.bytes.substr(document.end));
  if (!rest.empty()) {
    found.problems.push_back(fmt::format("{} bytes after </VTKFile>", rest.size()));
  }
  Located snapshot;
  snapshot.time = document.time;
  const auto ghosts = ghost_points(document, decoder);
  snapshot.particles = static_cast<std::int64_t>(document.points());
  snapshot.ghosts = std::count(ghosts.begin(), ghosts.end(), true);
  std::vector<std::string> names;
  if (const Piece* piece = first_with_points(document)) {
    for (const DataArray& array : piece->point_data) names.push_back(array.name);
  }
  snapshot.columns = std::make_shared<const std::vector<std::string>>(std::move(names));
  snapshot.parts = std::make_shared<const std::vector<std::string>>(flat_columns(document).names);
  found.snapshots.push_back(std::move(snapshot));
  return found;
}

// Of a large file, what its tags tell; nothing where they do not tell of particles.
std::optional<FileScan> glance(const std::string& path) {
  const auto text = condensed(path);
  if (!text) return std::nullopt;
  try {
    const Document document = parse_document(*text, path, {.condensed = true});
    Decoder decoder(document);
    if (!what_instead_of_particles(document, decoder).empty()) return std::nullopt;
    return found_in(document, decoder);
  } catch (const FormatError&) {  // told better with the file at hand
    return std::nullopt;
  }
}

FileScan scan(const std::string& path, bool thorough) {
  if (!thorough) {
    if (auto found = glance(path)) return *std::move(found);
  }
  std::vector<char> buffer;
  Source source(path);
  const Document document = parse_document(read_all(source, buffer), path);
  Decoder decoder(document);
  FileScan found;
  found.not_particles = what_instead_of_particles(document, decoder);
  if (!found.not_particles.empty()) return found;
  std::vector<std::string> problems;
  if (thorough) check_arrays(document, decoder, problems);
  found = found_in(document, decoder);
  found.problems.insert(found.problems.begin(), problems.begin(), problems.end());
  if (!source.trailing().empty()) found.problems.push_back(source.trailing());
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

// Leaves the rows of ghost points out; returns how many stay.
std::size_t drop_ghosts(const Document& document, std::vector<std::vector<double>>& raw) {
  Decoder decoder(document);
  const auto ghosts = ghost_points(document, decoder);
  if (ghosts.empty()) return document.points();
  for (auto& column : raw) readers::drop_ghosts(ghosts, column);
  return static_cast<std::size_t>(std::count(ghosts.begin(), ghosts.end(), false));
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

void read(const std::string& path, const Located& where, const Request& request, Snapshot& out,
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
  if (where.without_ghosts) out.particles = drop_ghosts(document, scratch.raw);
  compare_twins(path, flat, plan, scratch.raw);
  finish_columns(plan, scratch.raw, out, path);
}

std::string place(const std::string& path, const Located& where, std::size_t row) {
  if (!where.without_ghosts) return fmt::format("point {}", row);
  std::vector<char> buffer;
  Source source(path);
  const Document document = parse_document(read_all(source, buffer), path);
  Decoder decoder(document);
  const auto ghosts = ghost_points(document, decoder);
  for (std::size_t point = 0; point < ghosts.size() && point <= row; ++point) row += ghosts[point];
  return fmt::format("point {}", row);
}

}  // namespace

extern const Form vtk_xml;
const Form vtk_xml{
    .name = "vtk-xml",
    .description = "VTK XML particles, .vtp and .vtu (LIGGGHTS, OpenFOAM, ParaView)",
    .reference = "https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html",
    .matches = matches,
    .scan = scan,
    .glance_tells = true,
    .read = read,
    .place = place,
};

}  // namespace bedscope::readers
