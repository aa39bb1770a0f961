// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/cell_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace bedscope::analysis {

CellShapes::CellShapes(const readers::PolyMesh& mesh, const std::array<int, 3>& axes,
                       const Snap& snap)
    : mesh_(mesh), starts_(mesh.cells + 1, 0) {
  points_.reserve(mesh.points.size());
  for (const auto& point : mesh.points) {
    auto& mine = points_.emplace_back();
    for (std::size_t a = 0; a < 3; ++a)
      mine[a] = snap(static_cast<int>(a), point[static_cast<std::size_t>(axes[a])]);
  }
  const auto for_each_side = [&](auto&& take) {
    for (std::size_t f = 0; f < mesh.faces(); ++f) take(f, mesh.owner[f], true);
    for (std::size_t f = 0; f < mesh.neighbour.size(); ++f) take(f, mesh.neighbour[f], false);
  };
  for_each_side(
      [&](std::size_t, std::int32_t cell, bool) { ++starts_[static_cast<std::size_t>(cell) + 1]; });
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  sides_.resize(starts_.back());
  auto next = starts_;
  for_each_side([&](std::size_t f, std::int32_t cell, bool outward) {
    sides_[next[static_cast<std::size_t>(cell)]++] = {static_cast<std::int32_t>(f), outward};
  });
}

void CellShapes::cut(std::size_t cell, double volume, CellCutter& cutter) const {
  Vec3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  const auto sides = std::span(sides_).subspan(starts_[cell], starts_[cell + 1] - starts_[cell]);
  for (const auto& side : sides)
    for (const auto label : mesh_.face(static_cast<std::size_t>(side.face)))
      for (std::size_t a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], point(label)[a]);
        high[a] = std::max(high[a], point(label)[a]);
      }
  constexpr double negligible = 1e-14;  // faces through the apex, but for rounding
  cutter.begin(low, high, negligible * std::abs(volume));
  if (sides.empty()) return;
  const Vec3 apex = point(mesh_.face(static_cast<std::size_t>(sides.front().face)).front());
  for (const auto& side : sides) {
    const auto face = mesh_.face(static_cast<std::size_t>(side.face));
    const auto triangle = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      cutter.add(side.outward ? std::array{apex, a, b, c} : std::array{apex, a, c, b});
    };
    if (face.size() == 3) {
      triangle(point(face[0]), point(face[1]), point(face[2]));
      continue;
    }
    Vec3 middle{};
    for (const auto label : face)
      for (std::size_t a = 0; a < 3; ++a)
        middle[a] += point(label)[a] / static_cast<double>(face.size());
    for (std::size_t k = 0; k < face.size(); ++k)
      triangle(middle, point(face[k]), point(face[(k + 1) % face.size()]));
  }
}

}  // namespace bedscope::analysis
