// SPDX-License-Identifier: BSD-3-Clause
// The gas mesh of a scene, as blocks in the plane of x and z that span the depth.
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cases/scene.hpp"

namespace bedscope::cases {

struct BlockMesh {
  using Point = std::array<double, 2>;
  using Edge = std::pair<std::size_t, std::size_t>;  ///< of two points
  struct Block {
    std::array<std::size_t, 4> corners;  ///< counter-clockwise seen from the front, from lower left
    int across, up;                      ///< cells
  };
  struct Arc {
    Edge edge;
    Point through;
  };
  std::vector<Point> points;
  std::vector<Block> blocks;
  std::map<std::string, std::vector<Edge>> patches;  ///< besides front and back
  std::vector<Arc> arcs;
  int deep = 1;  ///< cells
  double depth = 0;

  std::int64_t cells() const;
};

/// One block; two under a box head; under a bend the quarter disc is three blocks around a square
/// in the corner, so that no cell is degenerate, and the straight part is two. Throws InputError
/// where a bend has fewer than 3 cells across.
BlockMesh block_mesh(const Scene& scene);

}  // namespace bedscope::cases
