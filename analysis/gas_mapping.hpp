// SPDX-License-Identifier: BSD-3-Clause
// Cells of a gas mesh onto the analysis grid: how much of each lies in which cell of the grid.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "analysis/grid.hpp"
#include "readers/openfoam_mesh.hpp"

namespace bedscope::analysis {

/// The overlap of the cells of the mesh with those of the grid is exact: in closed form where all
/// cells of the mesh are boxes along the axes, else by cutting them along the planes of the grid.
/// Faces that are not plane are taken as triangles about the average of their points, as OpenFOAM
/// takes them; its volume of such a cell, which is a little different, is shared out in proportion.
/// Fields are constant in a cell.
///
/// Every volume is shared out completely: the parts in the grid and the part outside of it add up
/// to the cell to rounding. Planes (points) of the mesh within 1e-6 of a grid cell of a plane of
/// the grid (or what the coordinates of the mesh are rounded to) are taken as on that plane, so
/// that no slivers of a cell lie beyond a wall. Periodic axes do not wrap.
class GasMapping {
 public:
  /// `axes`: which of x, y, z (0, 1, 2) is lateral, depth, up.
  GasMapping(const readers::Mesh& mesh, const Grid& grid, const std::array<int, 3>& axes);

  std::size_t cells() const { return volumes_.size(); }
  bool boxes() const { return boxes_; }  ///< whether all cells of the mesh are boxes along the axes
  double volume(std::size_t cell) const { return volumes_[cell]; }  ///< [m3]
  /// Share of a cell that lies in the domain.
  double inside(std::size_t cell) const {
    if (!boxes_) return inside_[cell];
    return span(0, cell).inside * span(1, cell).inside * span(2, cell).inside;
  }
  /// Calls take(cell of the grid, volume [m3]) for each that a cell of the mesh overlaps.
  template <class Take>
  void share(std::size_t cell, Take&& take) const {
    if (!boxes_) {
      for (auto k = cut_starts_[cell]; k < cut_starts_[cell + 1]; ++k)
        take(cuts_[k].first, volumes_[cell] * cuts_[k].second);
      return;
    }
    const Span &x = span(0, cell), &y = span(1, cell), &z = span(2, cell);
    for (std::size_t k = 0; k < z.parts; ++k)
      for (std::size_t j = 0; j < y.parts; ++j) {
        const double row = volumes_[cell] * parts_[2][z.begin + k] * parts_[1][y.begin + j];
        const auto first = x.first + row_ * (y.first + j + depth_cells_ * (z.first + k));
        for (std::size_t i = 0; i < x.parts; ++i) take(first + i, row * parts_[0][x.begin + i]);
      }
  }

  /// Volume of mesh in each cell of the grid [m3].
  std::vector<double> covered() const;
  double mesh_volume() const;     ///< [m3]
  double outside_volume() const;  ///< of the mesh, outside the domain [m3]

  /// The pressure at the bottom of the domain less that at its top is sum weight x pressure over
  /// these cells: volume means over the lowest and over the highest layer of cells whose centre is
  /// in the domain, each extrapolated by the layer next to it to the end of domain or mesh.
  /// Empty where there are fewer than two layers.
  std::span<const std::pair<std::size_t, double>> pressure_drop() const { return pressure_drop_; }

 private:
  /// What one cell of the mesh is along one axis: shares of it in consecutive cells of the grid.
  struct Span {
    double low = 0, high = 0;  // [m]
    std::size_t first = 0, begin = 0, parts = 0;
    double inside = 0;  // sum of the parts; 1 where none is cut off
  };
  struct Layer {
    std::vector<std::size_t> cells;
    double volume = 0, height = 0;  // the mean height of the centres
  };

  const Span& span(std::size_t axis, std::size_t cell) const {
    return spans_[axis][static_cast<std::size_t>(span_of_[axis][cell])];
  }
  /// From and to of a cell along up [m]; where cells are not boxes, about their centre, so that
  /// layers of slanting cells do not reach into one another.
  std::array<double, 2> rise(std::size_t cell) const {
    if (!boxes_) return rises_[cell];
    return {span(2, cell).low, span(2, cell).high};
  }
  double snapped(const Grid& grid, int axis, double x) const;
  void add_span(const Grid& grid, std::size_t axis, double low, double high);
  void add_boxes(const readers::Mesh& mesh, const Grid& grid, const std::array<int, 3>& axes);
  void add_cuts(const readers::Mesh& mesh, const Grid& grid, const std::array<int, 3>& axes);
  Layer layer_at(double height, const std::vector<double>& centres) const;
  void add_pressure(const Layer& near, const Layer& next, double end, double sign);
  void find_layers(const readers::Mesh& mesh, const Grid& grid, int axis);

  bool boxes_ = false;
  double resolution_ = 0;  // of the mesh [m]
  std::size_t row_ = 1, depth_cells_ = 1;
  std::vector<double> volumes_;
  std::array<std::vector<Span>, 3> spans_;
  std::array<std::vector<double>, 3> parts_;
  std::array<std::vector<std::int32_t>, 3> span_of_;  // of each cell
  // Where cells are not boxes: the cells of the grid with shares of cell c are
  // cuts_[cut_starts_[c]] ... cuts_[cut_starts_[c + 1]].
  std::vector<std::pair<std::size_t, double>> cuts_;
  std::vector<std::size_t> cut_starts_;
  std::vector<double> inside_;
  std::vector<std::array<double, 2>> rises_;
  std::size_t grid_cells_ = 0;
  std::vector<std::pair<std::size_t, double>> pressure_drop_;
};

}  // namespace bedscope::analysis
