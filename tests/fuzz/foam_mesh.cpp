// SPDX-License-Identifier: BSD-3-Clause
// polyMesh, its files the parts of one input, and its cells on a grid.
#include "analysis/gas_mapping.hpp"
#include "readers/openfoam_mesh.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {

using namespace readers;

void use(std::string_view input) {
  static std::map<std::string, MemoryFile, std::less<>> files;
  const auto parts = parts_of(input);
  const auto open = [&](std::string_view name) -> std::unique_ptr<FoamBlocks> {
    const auto part = parts.find(std::string(name));
    if (part == parts.end()) return nullptr;
    auto block = std::make_unique<FoamBlocks>(files[part->first].write(part->second));
    block->next();
    return block;
  };
  auto poly = read_poly_mesh(open);
  const auto count = poly.cells;
  require(poly.neighbour.size() <= poly.faces(), "internal faces are faces");
  const auto mesh = make_mesh(std::move(poly));
  require(mesh.volumes.size() == count && mesh.centres.size() == count,
          "a centre and a volume for each cell");
  analysis::Grid grid;
  grid.max = {0.07, 0.006, 0.1};
  grid.cells = {3, 2, 4};
  const analysis::GasMapping mapping(mesh, grid, {0, 1, 2});
  require(mapping.covered().size() == grid.size(), "a volume for each cell of the grid");
  if (!mesh.boxes) return;
  for (std::size_t c = 0; c < mesh.cells(); ++c)
    for (std::size_t a = 0; a < 3; ++a) {
      const auto low = mesh.boxes->low[c][a], high = mesh.boxes->high[c][a];
      require(
          0 <= low && low < high && static_cast<std::size_t>(high) < mesh.boxes->faces[a].size(),
          "a box lies between planes");
    }
}

}  // namespace bedscope::fuzz
