// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/coupled/cell_finder.hpp"

#include <algorithm>
#include <cmath>

namespace bedscope::coupled {
namespace {

// Lengths below this share of a cell are rounding of the mesh's points (written with 6 to 12
// digits).
constexpr double tolerance = 1e-4;
constexpr double largest_grid = 2e7;  // bins

double median(std::vector<double> values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool is_box(const MeshGeometry& mesh, int cell) {
  double volume = 1;
  for (int a = 0; a < 3; ++a) volume *= mesh.high[cell][a] - mesh.low[cell][a];
  return std::abs(mesh.volume[cell] / volume - 1) < tolerance;
}

}  // namespace

CellFinder::CellFinder(MeshGeometry mesh) : mesh_(std::move(mesh)) {
  const int cells = mesh_.cells();
  if (cells == 0) return;
  low_ = mesh_.low[0];
  high_ = mesh_.high[0];
  for (int c = 0; c < cells; ++c)
    for (int a = 0; a < 3; ++a) {
      low_[a] = std::min(low_[a], mesh_.low[c][a]);
      high_[a] = std::max(high_[a], mesh_.high[c][a]);
    }
  Vec3 size;
  std::vector<double> edge(cells);
  for (int a = 0; a < 3; ++a) {
    for (int c = 0; c < cells; ++c) edge[c] = mesh_.high[c][a] - mesh_.low[c][a];
    size[a] = median(edge);
    // As many bins as fit, so that on a grid of equal cells their faces meet.
    bins_[a] = std::max(1, int(std::lround((high_[a] - low_[a]) / size[a])));
  }
  while (double(bins_[0]) * bins_[1] * bins_[2] > largest_grid)
    for (int& n : bins_) n = std::max(1, n / 2);
  for (int a = 0; a < 3; ++a) {
    size[a] = (high_[a] - low_[a]) / bins_[a];
    inverse_[a] = 1 / size[a];
  }

  const int count = bins_[0] * bins_[1] * bins_[2];
  std::vector<std::vector<int>> reach(count);
  sole_.assign(count, -1);
  for (int c = 0; c < cells; ++c) {
    int from[3], to[3];
    for (int a = 0; a < 3; ++a) {
      from[a] =
          std::clamp(int((mesh_.low[c][a] - low_[a]) * inverse_[a] + tolerance), 0, bins_[a] - 1);
      to[a] =
          std::clamp(int((mesh_.high[c][a] - low_[a]) * inverse_[a] - tolerance), 0, bins_[a] - 1);
    }
    for (int k = from[2]; k <= to[2]; ++k)
      for (int j = from[1]; j <= to[1]; ++j)
        for (int i = from[0]; i <= to[0]; ++i) {
          const int bin = (k * bins_[1] + j) * bins_[0] + i;
          reach[bin].push_back(c);
          const int at[3] = {i, j, k};
          bool fills = is_box(mesh_, c);
          for (int a = 0; a < 3; ++a)
            fills = fills && mesh_.low[c][a] <= low_[a] + (at[a] + tolerance) * size[a] &&
                    mesh_.high[c][a] >= low_[a] + (at[a] + 1 - tolerance) * size[a];
          sole_[bin] = fills ? c : -2;
        }
  }
  first_.push_back(0);
  for (int bin = 0; bin < count; ++bin) {
    if (reach[bin].size() > 1) sole_[bin] = -2;
    candidates_.insert(candidates_.end(), reach[bin].begin(), reach[bin].end());
    first_.push_back(int(candidates_.size()));
  }
}

int CellFinder::decide(int bin, const Vec3& point) const {
  int best = -1;
  double least = 0;
  for (int n = first_[bin]; n < first_[bin + 1]; ++n) {
    const int cell = candidates_[n];
    double beyond = -1e300;  // distance outside of the worst face
    for (int p = mesh_.first_plane[cell]; p < mesh_.first_plane[cell + 1]; ++p) {
      const MeshGeometry::Plane& plane = mesh_.planes[p];
      beyond = std::max(beyond, plane.normal[0] * point[0] + plane.normal[1] * point[1] +
                                    plane.normal[2] * point[2] - plane.offset);
    }
    if (beyond <= 0) return cell;
    if (best < 0 || beyond < least) best = cell, least = beyond;
  }
  return best >= 0 && least < tolerance * std::cbrt(mesh_.volume[best]) ? best : -1;
}

int CellFinder::holds(const Vec3& centre, double half) const {
  Vec3 low = centre, high = centre;
  for (int a = 0; a < 3; ++a) low[a] -= half, high[a] += half;
  const int bin = bin_of(low);
  return bin >= 0 && sole_[bin] >= 0 && bin == bin_of(high) ? sole_[bin] : -1;
}

}  // namespace bedscope::coupled
