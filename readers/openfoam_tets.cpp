// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_tets.hpp"

#include <algorithm>

#include "readers/error.hpp"
#include "readers/openfoam_list.hpp"

namespace bedscope::readers {
namespace {

// More than faces of meshes have: n points take up to n^2 steps.
constexpr std::size_t most_points = 1000;

// Six times the volume of a tetrahedron; positive where b c d turn to the left seen from outside.
double six_volumes(const Point& a, const Point& b, const Point& c, const Point& d) {
  std::array<Point, 3> edge{b, c, d};
  for (auto& to : edge)
    for (std::size_t k = 0; k < 3; ++k) to[k] -= a[k];
  const auto& [u, v, w] = edge;
  return (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
         (u[0] * v[1] - u[1] * v[0]) * w[2];
}

// Do all triangles of a face make good tetrahedra with the point `base` in common?
bool is_base(const PolyMesh& mesh, const std::vector<Point>& centres, std::size_t f,
             std::size_t base) {
  const auto labels = mesh.face(f);
  const auto n = labels.size();
  const auto point = [&](std::size_t k) -> const Point& {
    return mesh.points[static_cast<std::size_t>(labels[k % n])];
  };
  const auto& inside = centres[static_cast<std::size_t>(mesh.owner[f])];
  for (std::size_t k = base + 1; k + 1 < base + n; ++k) {
    if (!(six_volumes(inside, point(base), point(k), point(k + 1)) > 0)) return false;
    if (f < mesh.neighbour.size() &&
        !(six_volumes(centres[static_cast<std::size_t>(mesh.neighbour[f])], point(base),
                      point(k + 1), point(k)) > 0))
      return false;
  }
  return true;
}

std::vector<std::int32_t> read_base_points(const PolyMesh& mesh, FoamBlocks& file) {
  const auto& path = file.stream().path();
  std::vector<std::int32_t> base;
  read_labels(file.stream(), layout_of(file.header(), path), base,
              FoamCount{mesh.faces(), "mesh", "faces"});
  for (std::size_t f = 0; f < base.size(); ++f) {
    base[f] = std::max(base[f], 0);
    if (static_cast<std::size_t>(base[f]) >= mesh.face(f).size())
      throw FormatError("{}: face {} has {} points, found {} as the first of its triangles", path,
                        f, mesh.face(f).size(), base[f]);
  }
  return base;
}

}  // namespace

std::vector<std::int32_t> tet_base_points(const PolyMesh& mesh, const std::vector<Point>& centres,
                                          FoamBlocks* file) {
  if (file != nullptr) return read_base_points(mesh, *file);
  std::vector<std::int32_t> found(mesh.faces());
  for (std::size_t f = 0; f < found.size(); ++f) {
    const auto tried = std::min(mesh.face(f).size(), most_points);
    std::size_t base = 0;
    while (base < tried && !is_base(mesh, centres, f, base)) ++base;
    if (base < tried) found[f] = static_cast<std::int32_t>(base);
  }
  return found;
}

}  // namespace bedscope::readers
