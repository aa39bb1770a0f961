// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_mesh.hpp"

#include <algorithm>
#include <numeric>

#include "readers/numbers.hpp"
#include "readers/openfoam_list.hpp"

namespace bedscope::readers {
namespace {

std::unique_ptr<FoamBlocks> open_needed(const OpenMeshFile& open, std::string_view name) {
  auto file = open(name);
  if (file == nullptr) throw FileError("{}: no such file in the mesh", name);
  if (file->stream().peek() == '\0') {
    if (file->header().present) file->stream().fail_cut("expected a list, found end of file");
    throw FormatError("{}: is empty, expected the {} of a mesh", file->stream().path(), name);
  }
  return file;
}

std::vector<std::int32_t> read_label_file(const OpenMeshFile& open, std::string_view name,
                                          std::string& note, std::string& path) {
  const auto file = open_needed(open, name);
  std::vector<std::int32_t> labels;
  path = file->stream().path();
  read_labels(file->stream(), layout_of(file->header(), path), labels);
  if (!file->header().note.empty()) note = file->header().note;
  return labels;
}

// "nCells:200" or "nCells: 200" of a note.
std::optional<std::int64_t> noted_cells(const std::string& note) {
  constexpr std::string_view key = "nCells:";
  auto at = note.find(key);
  if (at == std::string::npos) return std::nullopt;
  at = note.find_first_not_of(' ', at + key.size());
  if (at == std::string::npos) return std::nullopt;
  const auto stop = note.find_first_not_of("0123456789", at);
  std::int64_t cells = 0;
  bool overflow = false;
  if (!parse_integer(std::string_view(note).substr(at, stop - at), cells, overflow))
    return std::nullopt;
  return cells;
}

// A label must be a cell; how many there are is known from the note, else bounded by the faces: a
// closed cell has four at least. Only then may a label size an array.
void check_cells(std::span<const std::int32_t> labels, const std::string& path,
                 std::optional<std::int64_t> noted, std::int64_t most) {
  for (std::size_t f = 0; f < labels.size(); ++f) {
    if (labels[f] < 0) throw FormatError("{}: face {}: negative cell {}", path, f, labels[f]);
    if (noted && labels[f] >= *noted)
      throw FormatError("{}: face {} names cell {}; note says nCells:{}", path, f, labels[f],
                        *noted);
    if (labels[f] >= most)
      throw FormatError("{}: face {} names cell {}; {} faces bound {} cells at most", path, f,
                        labels[f], labels.size(), most);
  }
}

void read_cells(const OpenMeshFile& open, PolyMesh& mesh) {
  const auto faces = mesh.face_starts.size() - 1;
  std::string note, owner_path, neighbour_path;
  mesh.owner = read_label_file(open, "owner", note, owner_path);
  if (mesh.owner.size() != faces)
    throw FormatError("{}: owner has {} entries, faces {}", owner_path, mesh.owner.size(), faces);
  mesh.neighbour = read_label_file(open, "neighbour", note, neighbour_path);
  // Very old meshes pad the list with -1 for the faces of the boundary.
  while (mesh.neighbour.size() == faces && !mesh.neighbour.empty() && mesh.neighbour.back() == -1) {
    const auto last = std::find_if(mesh.neighbour.rbegin(), mesh.neighbour.rend(),
                                   [](std::int32_t cell) { return cell != -1; });
    mesh.neighbour.erase(last.base(), mesh.neighbour.end());
  }
  if (mesh.neighbour.size() > faces)
    throw FormatError("{}: neighbour has {} entries, faces {}", neighbour_path,
                      mesh.neighbour.size(), faces);
  const auto noted = noted_cells(note);
  const auto most = static_cast<std::int64_t>((faces + mesh.neighbour.size()) / 4);
  check_cells(mesh.owner, owner_path, noted, most);
  check_cells(mesh.neighbour, neighbour_path, noted, most);
  std::int32_t last = -1;
  for (const auto cell : mesh.owner) last = std::max(last, cell);
  for (const auto cell : mesh.neighbour) last = std::max(last, cell);
  mesh.cells = static_cast<std::size_t>(last) + 1;  // -1 wraps to none
  if (noted && static_cast<std::size_t>(*noted) != mesh.cells)
    throw FormatError("{}: note says nCells:{}, the faces bound {}", owner_path, *noted,
                      mesh.cells);
  std::vector<std::int32_t> bounded(mesh.cells);
  for (const auto cell : mesh.owner) ++bounded[static_cast<std::size_t>(cell)];
  for (const auto cell : mesh.neighbour) ++bounded[static_cast<std::size_t>(cell)];
  const auto open_cell = std::find_if(bounded.begin(), bounded.end(), [](auto n) { return n < 4; });
  if (open_cell != bounded.end())
    throw FormatError("{}: cell {} has {} faces, expected 4 or more", owner_path,
                      open_cell - bounded.begin(), *open_cell);
}

std::int64_t number_of(const FoamDictionary& patch, std::string_view key, const std::string& path) {
  std::int64_t number = 0;
  bool overflow = false;
  const auto text = patch.value(key, path).value_or("");
  if (!parse_integer(text, number, overflow) || number < 0)
    throw FormatError("{}: expected a number for {}, found \"{}\"", path, key, text);
  return number;
}

void read_patches(FoamBlocks& file, PolyMesh& mesh) {
  const auto& path = file.stream().path();
  if (file.stream().peek() == '\0')
    file.stream().fail_cut("expected a list of patches, found end of file");
  auto next = static_cast<std::int64_t>(mesh.neighbour.size());  // face that no patch has yet
  for (const auto& entry : read_named_list(file.stream()).entries) {
    if (entry.nested.empty()) continue;
    const auto& patch = entry.nested.front();
    FoamPatch made{entry.keyword, patch.value("type", path).value_or(""),
                   number_of(patch, "startFace", path), number_of(patch, "nFaces", path)};
    const auto faces = static_cast<std::int64_t>(mesh.faces());
    if (made.start > faces || made.faces > faces - made.start)
      throw FormatError("{}: patch {} ends at face {} of {}", path, made.name,
                        static_cast<double>(made.start) + static_cast<double>(made.faces), faces);
    if (made.faces > 0 && made.start < next)
      throw FormatError(
          "{}: patch {} begins at face {}, expected {}: behind the faces inside and of "
          "the patches before",
          path, made.name, made.start, next);
    if (made.faces > 0) next = made.start + made.faces;
    mesh.patches.push_back(std::move(made));
  }
}

}  // namespace

PolyMesh read_poly_mesh(const OpenMeshFile& open) {
  PolyMesh mesh;
  {
    const auto file = open_needed(open, "points");
    std::vector<double> numbers;
    const auto& path = file->stream().path();
    const auto bad = read_values(file->stream(), layout_of(file->header(), path),
                                 *foam_type("vector"), std::nullopt, numbers);
    if (bad.values > 0) throw FormatError("{}: point {} is not finite", path, bad.first);
    mesh.points.resize(numbers.size() / 3);
    for (std::size_t p = 0; p < mesh.points.size(); ++p)
      mesh.points[p] = {numbers[3 * p], numbers[3 * p + 1], numbers[3 * p + 2]};
  }
  {
    const auto file = open_needed(open, "faces");
    const auto& path = file->stream().path();
    read_faces(file->stream(), layout_of(file->header(), path),
               file->header().class_name == "faceCompactList", mesh.face_starts, mesh.face_points);
    for (std::size_t f = 0; f + 1 < mesh.face_starts.size(); ++f) {
      if (mesh.face_starts[f + 1] - mesh.face_starts[f] < 3)
        throw FormatError("{}: face {} has {} points, expected 3 or more", path, f,
                          mesh.face_starts[f + 1] - mesh.face_starts[f]);
      for (auto k = mesh.face_starts[f]; k < mesh.face_starts[f + 1]; ++k) {
        const auto point = mesh.face_points[static_cast<std::size_t>(k)];
        if (point < 0 || static_cast<std::size_t>(point) >= mesh.points.size())
          throw FormatError("{}: face {} names point {} of {}", path, f, point, mesh.points.size());
      }
    }
  }
  read_cells(open, mesh);
  if (const auto file = open("boundary")) read_patches(*file, mesh);
  return mesh;
}

double Mesh::volume() const { return std::accumulate(volumes.begin(), volumes.end(), 0.0); }

}  // namespace bedscope::readers
