// SPDX-License-Identifier: BSD-3-Clause
#include "cases/block_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "readers/error.hpp"

namespace bedscope::cases {
namespace {

void add_straight(BlockMesh& mesh, const Scene& scene) {
  const auto& g = scene.geometry;
  const auto& n = scene.numerics.grid;
  mesh.points = {{0, 0}, {g.width, 0}, {g.width, g.height}, {0, g.height}};
  mesh.blocks = {{{0, 1, 2, 3}, n[0], n[2]}};
  mesh.patches = {
      {"inlet", {{0, 1}}}, {"outlet", {{3, 2}}}, {"left", {{0, 3}}}, {"right", {{1, 2}}}};
}

void add_box_head(BlockMesh& mesh, const Scene& scene) {
  const double width = scene.geometry.width, top = total_height(scene);
  mesh.points.push_back({width, top});
  mesh.points.push_back({0, top});
  mesh.blocks.push_back({{3, 2, 4, 5}, scene.numerics.grid[0], head_layers(scene)});
  mesh.patches["top"] = {{5, 4}};
  mesh.patches["outlet"] = {{3, 5}};
  mesh.patches["right"].push_back({2, 4});
}

/// For an outlet on the left; another one is mirrored.
BlockMesh with_bend(const Scene& scene) {
  const auto& n = scene.numerics.grid;
  if (n[0] < 3)
    throw InputError("numerics.grid: expected at least 3 cells along x under a bend, found {}",
                     n[0]);
  const double r = scene.geometry.width, h = scene.geometry.height;
  const int core = std::clamp(static_cast<int>(std::lround(0.55 * n[0])), 1, n[0] - 1);
  const double a = r * core / n[0];
  const double corner = 0.87 * a;  // pulled in, or the cells at the diagonal get flat
  const auto arc = [&](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return BlockMesh::Point{r * std::cos(angle), h + r * std::sin(angle)};
  };
  BlockMesh mesh;
  mesh.points = {{0, 0},     {a, 0},  {r, 0},    {0, h}, {a, h}, {r, h}, {corner, h + corner},
                 {0, h + a}, arc(45), {0, h + r}};
  mesh.blocks = {{{0, 1, 4, 3}, core, n[2]},
                 {{1, 2, 5, 4}, n[0] - core, n[2]},
                 {{3, 4, 6, 7}, core, core},
                 {{4, 5, 8, 6}, n[0] - core, core},
                 {{7, 6, 8, 9}, core, n[0] - core}};
  mesh.patches = {{"inlet", {{0, 1}, {1, 2}}},
                  {"left", {{0, 3}}},
                  {"right", {{2, 5}}},
                  {"outlet", {{3, 7}, {7, 9}}},
                  {"top", {{5, 8}, {8, 9}}}};
  mesh.arcs = {{{5, 8}, arc(22.5)}, {{8, 9}, arc(67.5)}};
  return mesh;
}

void mirror(BlockMesh& mesh, double width) {
  for (auto& point : mesh.points) point[0] = width - point[0];
  for (auto& arc : mesh.arcs) arc.through[0] = width - arc.through[0];
  for (auto& [corners, across, up] : mesh.blocks)  // counter-clockwise again
    corners = {corners[1], corners[0], corners[3], corners[2]};
  std::swap(mesh.patches["left"], mesh.patches["right"]);
}

}  // namespace

std::int64_t BlockMesh::cells() const {
  std::int64_t sum = 0;
  for (const auto& block : blocks) sum += std::int64_t{block.across} * block.up * deep;
  return sum;
}

BlockMesh block_mesh(const Scene& scene) {
  BlockMesh mesh;
  if (scene.outlet.head != Head::box) {
    mesh = with_bend(scene);
  } else {
    add_straight(mesh, scene);
    if (scene.outlet.lateral()) add_box_head(mesh, scene);
  }
  if (scene.outlet.place == Place::right) mirror(mesh, scene.geometry.width);
  mesh.deep = scene.numerics.grid[1];
  mesh.depth = scene.geometry.depth;
  return mesh;
}

}  // namespace bedscope::cases
