// SPDX-License-Identifier: BSD-3-Clause
// Centres and volumes of cells, and which of them are boxes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "readers/openfoam_mesh.hpp"

namespace bedscope::readers {
namespace {

Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct Face {
  Point centre{}, area{};
};

// OpenFOAM's ROOTVSMALL and VSMALL for double.
constexpr double smallest_area = 1e-150;
constexpr double smallest_volume = 1e-300;

Face face_geometry(const PolyMesh& mesh, std::size_t f) {
  const auto labels = mesh.face(f);
  const auto point = [&](std::size_t k) -> const Point& {
    return mesh.points[static_cast<std::size_t>(labels[k])];
  };
  const auto n = labels.size();
  if (n == 3)
    return {(1.0 / 3) * (point(0) + point(1) + point(2)),
            0.5 * cross(point(1) - point(0), point(2) - point(0))};
  Point middle = point(0);
  for (std::size_t k = 1; k < n; ++k) middle = middle + point(k);
  middle = (1.0 / static_cast<double>(n)) * middle;
  Point sum_normal{}, sum_centre{};
  double sum_area = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Point& here = point(k);
    const Point& next = point((k + 1) % n);
    const Point normal = cross(next - here, middle - here);
    const double area = std::sqrt(dot(normal, normal));
    sum_normal = sum_normal + normal;
    sum_area += area;
    sum_centre = sum_centre + area * (here + next + middle);
  }
  if (sum_area < smallest_area) return {middle, {}};
  return {(1.0 / 3 / sum_area) * sum_centre, 0.5 * sum_normal};
}

// Planes closer than `tolerance` to one another become one, at the first of them.
std::vector<double> planes(std::vector<double> at, double tolerance) {
  std::sort(at.begin(), at.end());
  std::vector<double> kept;
  for (const double x : at)
    if (kept.empty() || x - kept.back() > tolerance) kept.push_back(x);
  return kept;
}

std::int32_t plane_at(const std::vector<double>& faces, double x, double tolerance) {
  const auto found = std::lower_bound(faces.begin(), faces.end(), x - tolerance);
  return static_cast<std::int32_t>(found - faces.begin());
}

std::optional<BoxCells> recognise_boxes(const CellGeometry& cells, double resolution) {
  Point thinnest{};
  thinnest.fill(std::numeric_limits<double>::infinity());
  for (std::size_t c = 0; c < cells.volumes.size(); ++c) {
    const Point size = cells.high[c] - cells.low[c];
    const double box = size[0] * size[1] * size[2];
    if (!(box > 0)) return std::nullopt;
    const double filled =
        1e-6 + resolution * (1 / size[0] + 1 / size[1] + 1 / size[2]);  // see make_mesh
    if (filled > 0.1 || std::abs(cells.volumes[c] - box) > filled * box) return std::nullopt;
    for (std::size_t a = 0; a < 3; ++a) thinnest[a] = std::min(thinnest[a], size[a]);
  }
  BoxCells boxes;
  boxes.low.resize(cells.volumes.size());
  boxes.high.resize(cells.volumes.size());
  boxes.rectilinear = true;
  for (std::size_t a = 0; a < 3; ++a) {
    // Points of one plane differ in the last digit that is printed: far less than a cell.
    const double tolerance = std::max(1e-3 * thinnest[a], 2 * resolution);
    std::vector<double> at;
    at.reserve(2 * cells.volumes.size());
    for (const auto& low : cells.low) at.push_back(low[a]);
    for (const auto& high : cells.high) at.push_back(high[a]);
    boxes.faces[a] = planes(std::move(at), tolerance);
    for (std::size_t c = 0; c < cells.volumes.size(); ++c) {
      boxes.low[c][a] = plane_at(boxes.faces[a], cells.low[c][a], tolerance);
      boxes.high[c][a] = plane_at(boxes.faces[a], cells.high[c][a], tolerance);
      if (boxes.high[c][a] != boxes.low[c][a] + 1) boxes.rectilinear = false;
    }
  }
  return boxes;
}

}  // namespace

CellGeometry cell_geometry(const PolyMesh& mesh) {
  std::vector<Face> faces(mesh.faces());
  for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = face_geometry(mesh, f);

  CellGeometry cells;
  constexpr double far = std::numeric_limits<double>::infinity();
  cells.low.assign(mesh.cells, {far, far, far});
  cells.high.assign(mesh.cells, {-far, -far, -far});
  std::vector<Point> middle(mesh.cells);
  std::vector<std::int32_t> bounding(mesh.cells);
  const auto for_each_side = [&](auto&& side) {  // first all owners, then all neighbours
    for (std::size_t f = 0; f < faces.size(); ++f)
      side(f, static_cast<std::size_t>(mesh.owner[f]), 1.0);
    for (std::size_t f = 0; f < mesh.neighbour.size(); ++f)
      side(f, static_cast<std::size_t>(mesh.neighbour[f]), -1.0);
  };
  for_each_side([&](std::size_t f, std::size_t cell, double) {
    middle[cell] = middle[cell] + faces[f].centre;
    ++bounding[cell];
    for (const auto label : mesh.face(f))
      for (std::size_t a = 0; a < 3; ++a) {
        const double x = mesh.points[static_cast<std::size_t>(label)][a];
        cells.low[cell][a] = std::min(cells.low[cell][a], x);
        cells.high[cell][a] = std::max(cells.high[cell][a], x);
      }
  });
  for (std::size_t c = 0; c < mesh.cells; ++c) middle[c] = (1.0 / bounding[c]) * middle[c];

  cells.centres.assign(mesh.cells, {});
  cells.volumes.assign(mesh.cells, 0);
  for_each_side([&](std::size_t f, std::size_t cell, double sign) {
    const double pyramid = sign * dot(faces[f].area, faces[f].centre - middle[cell]);  // 3 volumes
    cells.centres[cell] =
        cells.centres[cell] + pyramid * (0.75 * faces[f].centre + 0.25 * middle[cell]);
    cells.volumes[cell] += pyramid;
  });
  for (std::size_t c = 0; c < mesh.cells; ++c) {
    cells.centres[c] = std::abs(cells.volumes[c]) > smallest_volume
                           ? (1.0 / cells.volumes[c]) * cells.centres[c]
                           : middle[c];
    cells.volumes[c] *= 1.0 / 3;
  }
  return cells;
}

Mesh make_mesh(CellGeometry cells, std::vector<MeshPart> parts, double resolution) {
  Mesh mesh;
  mesh.resolution = resolution;
  mesh.boxes = recognise_boxes(cells, resolution);
  constexpr double far = std::numeric_limits<double>::infinity();
  mesh.min.fill(far);
  mesh.max.fill(-far);
  for (std::size_t c = 0; c < cells.volumes.size(); ++c)
    for (std::size_t a = 0; a < 3; ++a) {
      mesh.min[a] = std::min(mesh.min[a], cells.low[c][a]);
      mesh.max[a] = std::max(mesh.max[a], cells.high[c][a]);
    }
  if (!mesh.boxes) {
    for (std::size_t c = 0; c < cells.volumes.size(); ++c)
      mesh.extents.push_back(cells.high[c] - cells.low[c]);
    mesh.parts = std::move(parts);
  }
  mesh.centres = std::move(cells.centres);
  mesh.volumes = std::move(cells.volumes);
  return mesh;
}

Mesh make_mesh(PolyMesh poly) {
  auto cells = cell_geometry(poly);
  std::vector<std::int32_t> order(poly.cells);
  std::iota(order.begin(), order.end(), 0);
  std::vector<MeshPart> parts;
  parts.push_back({std::make_shared<const PolyMesh>(std::move(poly)), std::move(order)});
  return make_mesh(std::move(cells), std::move(parts));
}

}  // namespace bedscope::readers
