// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/gas_mapping.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "analysis/cell_shapes.hpp"

namespace bedscope::analysis {
namespace {

constexpr double same_plane = 1e-6;  // of a grid cell: what coordinates of six digits can tell

}  // namespace

double GasMapping::snapped(const Grid& grid, int axis, double x) const {
  const double width = grid.width(axis);
  const double place = std::round((x - grid.min[axis]) / width);
  if (!(place >= 0 && place <= grid.cells[axis])) return x;
  const double face = grid.face(axis, static_cast<int>(place));
  return std::abs(x - face) <= std::max(same_plane * width, std::min(resolution_, 1e-3 * width))
             ? face
             : x;
}

GasMapping::GasMapping(const readers::Mesh& mesh, const Grid& grid, const std::array<int, 3>& axes)
    : boxes_(mesh.boxes.has_value()),
      resolution_(mesh.resolution),
      row_(static_cast<std::size_t>(grid.cells[lateral])),
      depth_cells_(static_cast<std::size_t>(grid.cells[depth])),
      volumes_(mesh.volumes),
      grid_cells_(grid.size()) {
  if (boxes_)
    add_boxes(mesh, grid, axes);
  else
    add_cuts(mesh, grid, axes);
  find_layers(mesh, grid, axes[up]);
}

void GasMapping::add_span(const Grid& grid, std::size_t axis, double low, double high) {
  const int a = static_cast<int>(axis);
  Span span{.low = snapped(grid, a, low), .high = snapped(grid, a, high)};
  span.begin = parts_[axis].size();
  const double from = std::max(span.low, grid.min[axis]), to = std::min(span.high, grid.max[axis]);
  if (from < to) {
    const auto cell_of = [&](double x) {
      return std::clamp(static_cast<int>((x - grid.min[axis]) / grid.width(a)), 0,
                        grid.cells[axis] - 1);
    };
    // One cell more at both ends: a division may round across a face, the faces themselves decide.
    const int first = std::max(cell_of(from) - 1, 0);
    const int last = std::min(cell_of(to) + 1, grid.cells[axis] - 1);
    for (int i = first; i <= last; ++i) {
      const double part = std::min(to, grid.face(a, i + 1)) - std::max(from, grid.face(a, i));
      if (part <= 0) continue;
      if (span.parts == 0) span.first = static_cast<std::size_t>(i);
      ++span.parts;
      parts_[axis].push_back(part / (span.high - span.low));
      span.inside += parts_[axis].back();
    }
  }
  spans_[axis].push_back(span);
}

void GasMapping::add_boxes(const readers::Mesh& mesh, const Grid& grid,
                           const std::array<int, 3>& axes) {
  const auto& boxes = *mesh.boxes;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(axes[k]);
    const auto& faces = boxes.faces[axis];
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> known;
    span_of_[k].reserve(boxes.low.size());
    for (std::size_t c = 0; c < boxes.low.size(); ++c) {
      const auto planes = std::pair(boxes.low[c][axis], boxes.high[c][axis]);
      const auto [place, is_new] =
          known.try_emplace(planes, static_cast<std::int32_t>(spans_[k].size()));
      if (is_new)
        add_span(grid, k, faces[static_cast<std::size_t>(planes.first)],
                 faces[static_cast<std::size_t>(planes.second)]);
      span_of_[k].push_back(place->second);
    }
  }
}

void GasMapping::add_cuts(const readers::Mesh& mesh, const Grid& grid,
                          const std::array<int, 3>& axes) {
  const auto up_axis = static_cast<std::size_t>(axes[up]);
  std::vector<CellShapes> parts;
  std::vector<std::pair<const CellShapes*, std::size_t>> shapes(mesh.cells());
  parts.reserve(mesh.parts.size());
  for (const auto& part : mesh.parts) {
    parts.emplace_back(*part.poly, axes,
                       [&](int axis, double x) { return snapped(grid, axis, x); });
    for (std::size_t k = 0; k < part.cells.size(); ++k)
      shapes[static_cast<std::size_t>(part.cells[k])] = {&parts.back(), k};
  }
  CellCutter cutter(grid);
  cut_starts_.push_back(0);
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    const auto& [part, cell] = shapes[c];
    part->cut(cell, volumes_[c], cutter);
    const auto& shares = cutter.finish();
    cuts_.insert(cuts_.end(), shares.begin(), shares.end());
    cut_starts_.push_back(cuts_.size());
    inside_.push_back(cutter.inside());
    const auto& extent = mesh.extents[c];
    const double around = extent[0] * extent[1] * extent[2];
    const double half = extent[up_axis] * std::cbrt(std::abs(volumes_[c]) / around) / 2;
    rises_.push_back({mesh.centres[c][up_axis] - half, mesh.centres[c][up_axis] + half});
  }
}

std::vector<double> GasMapping::covered() const {
  std::vector<double> volume(grid_cells_, 0);
  for (std::size_t c = 0; c < cells(); ++c)
    share(c, [&](std::size_t cell, double part) { volume[cell] += part; });
  return volume;
}

double GasMapping::mesh_volume() const {
  return std::accumulate(volumes_.begin(), volumes_.end(), 0.);
}

double GasMapping::outside_volume() const {
  double volume = 0;
  for (std::size_t c = 0; c < cells(); ++c) volume += volumes_[c] * (1 - inside(c));
  return volume;
}

/// The cells in the domain that this height runs through.
GasMapping::Layer GasMapping::layer_at(double height, const std::vector<double>& centres) const {
  Layer layer;
  for (std::size_t c = 0; c < cells(); ++c) {
    const auto [low, high] = rise(c);
    if (inside(c) < 0.5 || !(low <= height && height < high)) continue;
    layer.cells.push_back(c);
    layer.volume += volumes_[c];
    layer.height += volumes_[c] * centres[c];
  }
  layer.height /= layer.volume;
  return layer;
}

void GasMapping::add_pressure(const Layer& near, const Layer& next, double end, double sign) {
  // p(end) = p_near + a (p_near - p_next): the line through both layers.
  const double a = (near.height - end) / (next.height - near.height);
  for (const auto c : near.cells)
    pressure_drop_.emplace_back(c, sign * (1 + a) * volumes_[c] / near.volume);
  for (const auto c : next.cells)
    pressure_drop_.emplace_back(c, -sign * a * volumes_[c] / next.volume);
}

void GasMapping::find_layers(const readers::Mesh& mesh, const Grid& grid, int axis) {
  std::vector<double> centres(cells()), inside_centres;
  for (std::size_t c = 0; c < cells(); ++c) {
    centres[c] = mesh.centres[c][static_cast<std::size_t>(axis)];
    if (inside(c) >= 0.5) inside_centres.push_back(centres[c]);
  }
  if (inside_centres.empty()) return;
  const auto lowest = layer_at(std::ranges::min(inside_centres), centres);
  const auto highest = layer_at(std::ranges::max(inside_centres), centres);
  double above = -INFINITY, below = INFINITY;  // where the layers next to these begin
  for (const auto c : lowest.cells) above = std::max(above, rise(c)[1]);
  for (const auto c : highest.cells) below = std::min(below, rise(c)[0]);
  double second = INFINITY, last_but_one = -INFINITY;
  for (const double z : inside_centres) {
    if (z > above) second = std::min(second, z);
    if (z < below) last_but_one = std::max(last_but_one, z);
  }
  if (std::isinf(second) || std::isinf(last_but_one)) return;
  const auto up_axis = static_cast<std::size_t>(axis);
  add_pressure(lowest, layer_at(second, centres), std::max(grid.min[up], mesh.min[up_axis]), 1);
  add_pressure(highest, layer_at(last_but_one, centres), std::min(grid.max[up], mesh.max[up_axis]),
               -1);
}

}  // namespace bedscope::analysis
