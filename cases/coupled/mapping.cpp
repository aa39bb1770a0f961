// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/coupled/mapping.hpp"

#include <cmath>

namespace bedscope::coupled {
namespace {

// Points that stand for equal volumes: the centre, then on each shell the directions of the faces
// and corners of a cube. Radii as in CFDEMcoupling.
std::vector<Vec3> satellites() {
  std::vector<Vec3> points{{0, 0, 0}};
  for (const double r : {0.62761, 0.92853}) {
    for (int a = 0; a < 3; ++a)
      for (const double s : {-r, r}) {
        points.push_back({0, 0, 0});
        points.back()[a] = s;
      }
    const double c = r / std::sqrt(3.0);
    for (const double x : {-c, c})
      for (const double y : {-c, c})
        for (const double z : {-c, c}) points.push_back({x, y, z});
  }
  return points;
}
const std::vector<Vec3> points = satellites();
constexpr double outermost = 0.92853;

}  // namespace

Mapping::Mapping(const CellFinder& finder, MPI_Comm comm, bool divided)
    : finder_(finder), exchange_(comm, finder.low(), finder.high()), divided_(divided) {}

void Mapping::add(int cell) {
  if (cell < 0) return;
  for (std::size_t n = first_.back(); n < cell_.size(); ++n)
    if (cell_[n] == cell) {
      ++weight_[n];
      return;
    }
  cell_.push_back(cell);
  weight_.push_back(1);
}

void Mapping::map(int particles, const double* positions, const double* radii) {
  exchange_.plan(particles, positions, radii);
  spheres_.resize(4 * std::size_t(particles));
  for (int i = 0; i < particles; ++i) {
    for (int a = 0; a < 3; ++a) spheres_[4 * i + a] = positions[3 * i + a];
    spheres_[4 * i + 3] = radii[i];
  }
  exchange_.forward(spheres_, copied_, 4);

  const int copies = exchange_.copies();
  first_.assign(1, 0);
  cell_.clear();
  weight_.clear();
  partial_.assign(copies, 0);
  for (int i = 0; i < copies; ++i) {
    const Vec3 centre{copied_[4 * i], copied_[4 * i + 1], copied_[4 * i + 2]};
    const double r = copied_[4 * i + 3];
    if (!divided_) {
      add(finder_.find(centre));
    } else if (const int cell = finder_.holds(centre, outermost * r); cell >= 0) {
      cell_.push_back(cell);
      weight_.push_back(double(points.size()));
    } else {
      for (const Vec3& p : points)
        add(finder_.find({centre[0] + r * p[0], centre[1] + r * p[1], centre[2] + r * p[2]}));
    }
    for (std::size_t n = first_.back(); n < cell_.size(); ++n) partial_[i] += weight_[n];
    first_.push_back(int(cell_.size()));
  }
  exchange_.sum_back(partial_, points_, 1);
  exchange_.forward(points_, partial_, 1);
  for (int i = 0; i < copies; ++i)
    for (int n = first_[i]; n < first_[i + 1]; ++n) weight_[n] /= partial_[i];
}

void Mapping::deposit(const std::vector<double>& owned, std::vector<double>& cells, int width) {
  exchange_.forward(owned, copied_, width);
  for (int i = 0; i < exchange_.copies(); ++i)
    for (int n = first_[i]; n < first_[i + 1]; ++n)
      for (int k = 0; k < width; ++k)
        cells[std::size_t(cell_[n]) * width + k] +=
            weight_[n] * copied_[std::size_t(i) * width + k];
}

void Mapping::gather(const std::vector<double>& cells, std::vector<double>& owned, int width) {
  partial_.assign(std::size_t(exchange_.copies()) * width, 0);
  for (int i = 0; i < exchange_.copies(); ++i)
    for (int n = first_[i]; n < first_[i + 1]; ++n)
      for (int k = 0; k < width; ++k)
        partial_[std::size_t(i) * width + k] +=
            weight_[n] * cells[std::size_t(cell_[n]) * width + k];
  exchange_.sum_back(partial_, owned, width);
}

}  // namespace bedscope::coupled
