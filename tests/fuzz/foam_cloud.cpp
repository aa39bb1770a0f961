// SPDX-License-Identifier: BSD-3-Clause
// Positions of a cloud, cartesian and barycentric, in a mesh of one cube.
#include "readers/openfoam_cloud.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {
namespace {

using namespace readers;

CloudMesh cube() {
  CloudMesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.poly.points.push_back({double(k & 1), double(k >> 1 & 1), double(k >> 2)});
  mesh.poly.face_points = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
  mesh.poly.face_starts = {0, 4, 8, 12, 16, 20, 24};
  mesh.poly.owner.assign(6, 0);
  mesh.poly.cells = 1;
  mesh.centres = {{0.5, 0.5, 0.5}};
  return mesh;
}

}  // namespace

void use(std::string_view input) {
  static MemoryFile file;
  static const auto mesh = cube();
  FoamBlocks blocks(file.write(input));
  CloudPoints points;
  while (blocks.next()) {
    read_cloud_points(
        blocks, [&]() -> const CloudMesh& { return mesh; }, points);
    require(points.off_sum <= points.at.size(), "parcels are counted once");
    blocks.close();
  }
}

}  // namespace bedscope::fuzz
