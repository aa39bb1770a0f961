// SPDX-License-Identifier: BSD-3-Clause
#include "cases/block_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "cases/scene_file.hpp"
#include "readers/error.hpp"

namespace bedscope::cases {
namespace {

Scene riser() { return read_scene(BEDSCOPE_SOURCE "/cases/riser/scene.toml"); }

/// By the shoelace; positive when the corners go counter-clockwise.
double area(const BlockMesh& mesh, const BlockMesh::Block& block) {
  double twice = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& a = mesh.points[block.corners[i]];
    const auto& b = mesh.points[block.corners[(i + 1) % 4]];
    twice += a[0] * b[1] - b[0] * a[1];
  }
  return twice / 2;
}

TEST(BlockMesh, OfABoxIsOneBlock) {
  const auto mesh = block_mesh(read_scene(BEDSCOPE_SOURCE "/cases/mueller_bed/scene.toml"));
  ASSERT_EQ(mesh.blocks.size(), 1U);
  EXPECT_EQ(mesh.cells(), 20 * 4 * 55);
  EXPECT_EQ(mesh.patches.count("top"), 0U);
}

TEST(BlockMesh, UnderABoxHeadHasTheHeadsLayers) {
  auto scene = riser();
  scene.outlet.head = Head::box;
  const auto mesh = block_mesh(scene);
  EXPECT_EQ(mesh.cells(), 28 * 4 * (600 + 28));
  EXPECT_NEAR(area(mesh, mesh.blocks[0]) + area(mesh, mesh.blocks[1]), 0.07 * 1.57, 1e-12);
}

TEST(BlockMesh, OfABendIsTheStraightPartAndAQuarterDisc) {
  for (const auto place : {Place::left, Place::right}) {
    auto scene = riser();
    scene.outlet.place = place;
    const auto mesh = block_mesh(scene);
    double sum = 0;
    for (const auto& block : mesh.blocks) {
      EXPECT_GT(area(mesh, block), 0);  // none is turned inside out
      sum += area(mesh, block);
    }
    // The blocks' corners on the arc are joined by chords of 45 degrees.
    const double disc = 0.07 * 0.07 * std::sin(std::numbers::pi / 4);
    EXPECT_NEAR(sum, 0.07 * 1.5 + disc, 1e-12);
    EXPECT_EQ(mesh.cells(), 4 * (28 * 600 + 15 * 15 + 2 * 13 * 15));
    for (const auto& arc : mesh.arcs) {
      const double x = place == Place::left ? arc.through[0] : 0.07 - arc.through[0];
      EXPECT_NEAR(std::hypot(x, arc.through[1] - 1.5), 0.07, 1e-12);
    }
    // The open side is where the outlet is.
    for (const auto& [a, b] : mesh.patches.at("outlet"))
      for (const auto p : {a, b})
        EXPECT_NEAR(mesh.points[p][0], place == Place::left ? 0 : 0.07, 1e-12);
  }
}

TEST(BlockMesh, HasEachOuterEdgeInOnePatch) {
  for (const auto* name : {"riser/scene.toml", "mueller_bed/scene.toml"}) {
    const auto mesh = block_mesh(read_scene(std::string(BEDSCOPE_SOURCE "/cases/") + name));
    std::multiset<std::pair<std::size_t, std::size_t>> edges;
    for (const auto& block : mesh.blocks)
      for (std::size_t i = 0; i < 4; ++i)
        edges.insert(std::minmax({block.corners[i], block.corners[(i + 1) % 4]}));
    std::set<std::pair<std::size_t, std::size_t>> outer;
    for (const auto& edge : edges)
      if (edges.count(edge) == 1) outer.insert(edge);
    for (const auto& [patch, list] : mesh.patches)
      for (const auto& [a, b] : list) EXPECT_EQ(outer.erase(std::minmax({a, b})), 1U) << patch;
    EXPECT_TRUE(outer.empty());
  }
}

TEST(BlockMesh, UnderABendNeedsCellsAcross) {
  auto scene = riser();
  scene.numerics.grid[0] = 2;
  EXPECT_THROW(block_mesh(scene), InputError);
}

}  // namespace
}  // namespace bedscope::cases
