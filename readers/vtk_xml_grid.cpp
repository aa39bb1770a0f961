// SPDX-License-Identifier: BSD-3-Clause
// Cells and their values in a .vtu file.
#include <algorithm>
#include <cmath>
#include <functional>

#include "readers/source.hpp"
#include "readers/vtk_common.hpp"
#include "readers/vtk_grid.hpp"
#include "readers/vtk_xml.hpp"

namespace bedscope::readers {
namespace {

using namespace vtk_xml_file;

class XmlGrid : public VtkGrid {
 public:
  explicit XmlGrid(const std::string& path) {
    Source source(path);
    document_ = parse_document(read_all(source, bytes_), path, {.cell_data = true});
    time = document_.time;
    compressed = document_.compressor != Compressor::none || source.compressed();
    const auto first = std::find_if(document_.pieces.begin(), document_.pieces.end(),
                                    [](const Piece& piece) { return piece.cells.count > 0; });
    if (first == document_.pieces.end()) return;
    binary = first->coordinates.empty() || first->coordinates.front().storage != Storage::ascii;
    for (const DataArray& array : first->cell_data)
      if (array.type != Number::other && !is_ghost_array(array.name))
        fields.push_back({array.name, array.components});
  }

  bool has_volumes() const {
    Decoder decoder(document_);
    std::vector<double> types;
    for (const Piece& piece : document_.pieces) {
      if (piece.cells.count == 0) continue;
      decoder.decode(needed(piece, "types"), piece.cells.count, types);
      if (std::any_of(types.begin(), types.end(), is_volume)) return true;
    }
    return false;
  }

  std::uint64_t mesh_mark() const override {
    std::uint64_t mark = 0;
    const auto add = [&](std::string_view bytes) {
      mark = mark * 31 + std::hash<std::string_view>{}(bytes);
    };
    for (const Piece& piece : document_.pieces) {
      for (const Arrays* arrays : {&piece.coordinates, &piece.cells.arrays})
        for (const DataArray& array : *arrays)
          add(array.storage == Storage::appended ? stored(array) : array.text);
      if (const auto* ghosts = ghost_array(piece.cell_data))
        add(ghosts->storage == Storage::appended ? stored(*ghosts) : ghosts->text);
    }
    return mark;
  }

  std::vector<VtkCells> pieces() const override {
    std::vector<VtkCells> made;
    Decoder decoder(document_);
    for (const Piece& piece : document_.pieces)
      if (piece.cells.count > 0) made.push_back(cells_of(piece, decoder));
    return made;
  }

  std::vector<std::vector<double>> read(const Field& field) const override {
    std::vector<std::vector<double>> columns(field.components);
    Decoder decoder(document_);
    for (const Piece& piece : document_.pieces) {
      if (piece.cells.count == 0) continue;
      const DataArray* array = find(piece.cell_data, field.name);
      if (array == nullptr)
        throw FormatError("{}: line {}: <Piece>: no array {} of cells, the first one has it",
                          document_.path, line_of(document_.bytes, piece.position), field.name);
      if (array->components != field.components)
        decoder.fail(*array, "{} components, in the first piece {}", array->components,
                     field.components);
      decoder.bound(*array, piece.cells.count);
      std::vector<std::vector<double>> part(field.components,
                                            std::vector<double>(piece.cells.count));
      std::vector<double*> into;
      for (auto& column : part) into.push_back(column.data());
      decoder.decode(*array, piece.cells.count, into);
      const auto ghosts = ghosts_of(piece, decoder);
      for (std::size_t c = 0; c < part.size(); ++c) {
        if (!ghosts.empty()) drop_ghosts(ghosts, part[c]);
        if (columns[c].empty())
          columns[c] = std::move(part[c]);
        else
          columns[c].insert(columns[c].end(), part[c].begin(), part[c].end());
      }
    }
    return columns;
  }

 private:
  const DataArray& needed(const Piece& piece, std::string_view name) const {
    if (const DataArray* array = find(piece.cells.arrays, name)) return *array;
    throw FormatError("{}: line {}: <Piece> of {} cells has no array {}", document_.path,
                      line_of(document_.bytes, piece.position), piece.cells.count, name);
  }

  // Up to the next array of the appended data, whose offsets ascend.
  std::string_view stored(const DataArray& array) const {
    std::uint64_t end = document_.appended.size();
    const auto look = [&](const Arrays& arrays) {
      for (const DataArray& other : arrays)
        if (other.offset > array.offset) end = std::min(end, other.offset);
    };
    for (const Piece& piece : document_.pieces)
      for (const Arrays* arrays :
           {&piece.coordinates, &piece.cells.arrays, &piece.point_data, &piece.cell_data})
        look(*arrays);
    if (array.offset >= end) return {};
    return document_.appended.substr(array.offset, end - array.offset);
  }

  std::vector<bool> ghosts_of(const Piece& piece, Decoder& decoder) const {
    const auto* array = ghost_array(piece.cell_data);
    if (array == nullptr) return {};
    std::vector<double> values;
    decoder.decode(*array, piece.cells.count, values);
    std::vector<bool> ghosts(values.size());
    mark_ghosts(array->name, values, 0, ghosts);
    return ghosts;
  }

  // How many numbers an array holds is told by the last of its ends.
  void decode_to_end(const Piece& piece, std::string_view name, const std::vector<double>& ends,
                     Decoder& decoder, std::vector<double>& into) const {
    const auto& array = needed(piece, name);
    const double count = ends.empty() ? 0 : std::ranges::max(ends);
    if (!(count >= 0 && count <= 8192.0 * static_cast<double>(document_.bytes.size())))
      decoder.fail(array, "{} numbers claimed, more than the file can hold", count);
    decoder.decode(array, static_cast<std::uint64_t>(count), into);
  }

  VtkCells cells_of(const Piece& piece, Decoder& decoder) const {
    VtkCells cells;
    if (piece.points == 0)
      throw FormatError("{}: line {}: <Piece> of {} cells without points", document_.path,
                        line_of(document_.bytes, piece.position), piece.cells.count);
    decoder.decode(needed(piece, "types"), piece.cells.count, cells.types);
    decoder.decode(needed(piece, "offsets"), piece.cells.count, cells.ends);
    decode_to_end(piece, "connectivity", cells.ends, decoder, cells.connectivity);
    if (const DataArray* ends = find(piece.cells.arrays, "faceoffsets")) {
      decoder.decode(*ends, piece.cells.count, cells.face_ends);
      if (std::ranges::max(cells.face_ends) >= 0)
        decode_to_end(piece, "faces", cells.face_ends, decoder, cells.faces);
    }
    const DataArray& coordinates = piece.coordinates.front();
    std::array<std::vector<double>, 3> axes;
    std::array<double*, 3> into{};
    for (std::size_t a = 0; a < 3; ++a) {
      axes[a].resize(piece.points);
      into[a] = axes[a].data();
    }
    decoder.decode(coordinates, piece.points, into);
    cells.points = points_of(axes, document_.path);
    cells.resolution = resolution_of(cells.points, coordinates.storage == Storage::ascii,
                                     coordinates.type == Number::float32);
    cells.ghosts = ghosts_of(piece, decoder);
    return cells;
  }

  std::vector<char> bytes_;
  Document document_;
};

}  // namespace

std::shared_ptr<const VtkGrid> open_xml_grid(const std::string& path) {
  auto grid = std::make_shared<XmlGrid>(path);
  return grid->has_volumes() ? grid : nullptr;
}

}  // namespace bedscope::readers
