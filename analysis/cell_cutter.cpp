// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/cell_cutter.hpp"

#include <algorithm>
#include <cmath>

namespace bedscope::analysis {
namespace {

using Tetrahedron = std::array<Vec3, 4>;

double signed_volume(const Tetrahedron& body) {
  std::array<Vec3, 3> edge{};
  for (std::size_t e = 0; e < 3; ++e)
    for (std::size_t a = 0; a < 3; ++a) edge[e][a] = body[e + 1][a] - body[0][a];
  return (edge[0][0] * (edge[1][1] * edge[2][2] - edge[1][2] * edge[2][1]) +
          edge[0][1] * (edge[1][2] * edge[2][0] - edge[1][0] * edge[2][2]) +
          edge[0][2] * (edge[1][0] * edge[2][1] - edge[1][1] * edge[2][0])) /
         6;
}

/// Where the edge crosses the plane; exactly on it.
Vec3 crossing(const Vec3& below, const Vec3& above, std::size_t axis, double plane) {
  const double t = (plane - below[axis]) / (above[axis] - below[axis]);
  Vec3 point{};
  for (std::size_t a = 0; a < 3; ++a) point[a] = below[a] + t * (above[a] - below[a]);
  point[axis] = plane;
  return point;
}

struct Pieces {
  std::array<Tetrahedron, 3> of{};
  std::size_t count = 0;
  void add(const Tetrahedron& piece) { of[count++] = piece; }
  /// Triangle abc opposite to def.
  void add_prism(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e,
                 const Vec3& f) {
    add({a, b, c, d});
    add({b, c, d, e});
    add({c, d, e, f});
  }
};

/// Both sides of a plane.
void split(const Tetrahedron& body, std::size_t axis, double plane, Pieces& below, Pieces& above) {
  std::array<const Vec3*, 4> corner{};  // those below first
  std::size_t low = 0, high = 4;
  for (const auto& point : body) corner[point[axis] < plane ? low++ : --high] = &point;
  const auto meet = [&](std::size_t i, std::size_t j) {
    return crossing(*corner[i], *corner[j], axis, plane);
  };
  if (low == 0) return above.add(body);
  if (low == 4) return below.add(body);
  if (low == 2) {
    const auto p02 = meet(0, 2), p03 = meet(0, 3), p12 = meet(1, 2), p13 = meet(1, 3);
    below.add_prism(*corner[0], p02, p03, *corner[1], p12, p13);
    return above.add_prism(*corner[2], p02, p12, *corner[3], p03, p13);
  }
  const std::size_t tip = low == 1 ? 0 : 3, a = low == 1 ? 1 : 0;
  const auto pa = low == 1 ? meet(tip, a) : meet(a, tip);
  const auto pb = low == 1 ? meet(tip, a + 1) : meet(a + 1, tip);
  const auto pc = low == 1 ? meet(tip, a + 2) : meet(a + 2, tip);
  (low == 1 ? below : above).add({*corner[tip], pa, pb, pc});
  (low == 1 ? above : below).add_prism(pa, pb, pc, *corner[a], *corner[a + 1], *corner[a + 2]);
}

}  // namespace

/// -1 below the grid, its number of cells above it.
int CellCutter::slab_of(int axis, double x) const {
  const int cells = grid_.cells[axis];
  if (!(x >= grid_.min[axis])) return -1;
  if (x >= grid_.max[axis]) return cells;
  // A division may round across a face, the faces themselves decide.
  int i = std::min(static_cast<int>((x - grid_.min[axis]) / grid_.width(axis)), cells - 1);
  if (i > 0 && x < grid_.face(axis, i)) --i;
  if (i + 1 < cells && x >= grid_.face(axis, i + 1)) ++i;
  return i;
}

void CellCutter::begin(const Vec3& low, const Vec3& high, double negligible) {
  negligible_ = negligible;
  std::size_t cells = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const int axis = static_cast<int>(a);
    first_[a] = std::max(slab_of(axis, low[a]), 0);
    const int last = std::min(slab_of(axis, high[a]), grid_.cells[a] - 1);
    size_[a] = std::max(last - first_[a] + 1, 0);
    cells *= static_cast<std::size_t>(size_[a]);
  }
  sums_.assign(cells, 0);
  volume_ = 0;
}

void CellCutter::add(const std::array<Vec3, 4>& tetrahedron) {
  const double volume = signed_volume(tetrahedron);
  if (!(std::abs(volume) > negligible_) || std::isinf(volume)) return;
  volume_ += volume;
  sign_ = volume < 0 ? -1 : 1;
  if (!sums_.empty()) cut(tetrahedron, 0);
}

void CellCutter::cut(const Tetrahedron& body, int axis) {
  if (axis == 3) return take(body);
  const auto a = static_cast<std::size_t>(axis);
  const auto [low, high] = std::minmax({body[0][a], body[1][a], body[2][a], body[3][a]});
  if (low == high) return;
  const int from = slab_of(axis, low), to = slab_of(axis, high);
  const bool touches =
      to > from && high == (to == grid_.cells[a] ? grid_.max[a] : grid_.face(axis, to));
  const int last = touches ? to - 1 : to;
  if (last < 0 || from == grid_.cells[a]) return;
  if (from == last) {
    at_[a] = from;
    return cut(body, axis + 1);
  }
  Pieces below, above;
  split(body, a, grid_.face(axis, from + 1), below, above);
  if (from >= 0)
    for (std::size_t k = 0; k < below.count; ++k) {
      at_[a] = from;
      cut(below.of[k], axis + 1);
    }
  for (std::size_t k = 0; k < above.count; ++k) cut(above.of[k], axis);
}

void CellCutter::take(const Tetrahedron& body) {
  std::size_t cell = 0;
  for (std::size_t a = 3; a-- > 0;)
    cell = cell * static_cast<std::size_t>(size_[a]) + static_cast<std::size_t>(at_[a] - first_[a]);
  sums_[cell] += sign_ * std::abs(signed_volume(body));
}

const std::vector<std::pair<std::size_t, double>>& CellCutter::finish() {
  constexpr double smallest = 1e-12;  // what cancels leaves rounding behind
  parts_.clear();
  inside_ = 0;
  std::size_t place = 0;
  for (int k = 0; k < size_[2]; ++k)
    for (int j = 0; j < size_[1]; ++j)
      for (int i = 0; i < size_[0]; ++i) {
        const double share = sums_[place++] / volume_;
        if (!(share > smallest)) continue;
        parts_.emplace_back(grid_.index(first_[0] + i, first_[1] + j, first_[2] + k), share);
        inside_ += share;
      }
  return parts_;
}

}  // namespace bedscope::analysis
