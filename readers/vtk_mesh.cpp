// SPDX-License-Identifier: BSD-3-Clause
// Faces of VTK's cells. Order of points: vtkCellType.h and the classes named there (VTK 9.1).
#include "readers/vtk_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "readers/error.hpp"

namespace bedscope::readers {
namespace {

using Face = std::vector<std::int32_t>;

constexpr int voxel = 11, convex_point_set = 41, polyhedron = 42;

// A prism (bottom, top, sides) or a pyramid over a polygon; 0: the type is neither.
struct Shape {
  std::size_t prism = 0, pyramid = 0;
};

Shape shape_of(int type) {
  switch (type) {
    case 10:
      return {.pyramid = 3};  // tetrahedron
    case 14:
      return {.pyramid = 4};
    case 13:
      return {.prism = 3};  // wedge
    case voxel:
    case 12:
      return {.prism = 4};  // hexahedron
    case 15:
    case 16:
      return {.prism = type == 15 ? 5U : 6U};
    default:
      return {};
  }
}

class MeshMaker {
 public:
  explicit MeshMaker(const std::string& path) : path_(path) {}

  void add(const VtkCells& piece) {
    piece_ = &piece;
    first_point_ = mesh_.points.size();
    mesh_.points.insert(mesh_.points.end(), piece.points.begin(), piece.points.end());
    if (mesh_.points.size() > most) throw FormatError("{}: more than 2^31 points", path_);
    resolution_ = std::max(resolution_, piece.resolution);
    double begin = 0, faces_begin = 0;
    for (cell_ = 0; cell_ < piece.types.size(); ++cell_) {
      const double end = piece.ends[cell_];
      if (!(end >= begin) || end > static_cast<double>(piece.connectivity.size()))
        fail("ends at point {} of {}, begins at {}", end, piece.connectivity.size(), begin);
      const double face_end = cell_ < piece.face_ends.size() ? piece.face_ends[cell_] : -1;
      const bool ghost = !piece.ghosts.empty() && piece.ghosts[cell_];
      const auto labels =
          std::span(piece.connectivity)
              .subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
      if (!ghost && piece.types[cell_] == polyhedron)
        add_polyhedron(faces_begin, face_end);
      else if (!ghost && piece.types[cell_] == convex_point_set)
        add_convex(labels);
      else if (!ghost)
        add_shape(labels);
      begin = end;
      if (face_end >= 0) faces_begin = face_end;
    }
  }

  Mesh finish() {
    mesh_.face_starts.push_back(static_cast<std::int32_t>(mesh_.face_points.size()));
    auto cells = cell_geometry(mesh_);
    for (std::size_t c = 0; c < mesh_.cells; ++c) {
      cells.volumes[c] = std::abs(cells.volumes[c]);  // the order of the points may be another
      if (!(cells.volumes[c] > 0) || std::isinf(cells.volumes[c]))
        throw FormatError("{}: cell {} has no volume", path_, c);
    }
    std::vector<std::int32_t> order(mesh_.cells);
    std::iota(order.begin(), order.end(), 0);
    std::vector<MeshPart> parts;
    parts.push_back({std::make_shared<const PolyMesh>(std::move(mesh_)), std::move(order)});
    return make_mesh(std::move(cells), std::move(parts), resolution_);
  }

 private:
  static constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  // A box cut by a plane has 10 points at most; the search for faces goes with the fourth power,
  // and a file of nothing else must not take an hour.
  static constexpr std::size_t most_convex = 16;

  template <class... T>
  [[noreturn]] void fail(fmt::format_string<T...> text, T&&... values) const {
    throw FormatError("{}: cell {}: {}", path_, cell_,
                      fmt::format(text, std::forward<T>(values)...));
  }

  std::int32_t point(double label) const {
    if (!(label >= 0 && label < static_cast<double>(piece_->points.size())) ||
        label != std::floor(label))
      fail("point {} of {}", label, piece_->points.size());
    return static_cast<std::int32_t>(first_point_ + static_cast<std::size_t>(label));
  }

  // A face without points that are there twice (wedges of OpenFOAM are hexahedra with such); none
  // where fewer than three are left.
  void add_face(std::span<const std::int32_t> face) {
    const auto start = mesh_.face_points.size();
    if (start + face.size() > most) throw FormatError("{}: more than 2^31 points of faces", path_);
    for (std::size_t k = 0; k < face.size(); ++k)
      if (face[k] != face[k == 0 ? face.size() - 1 : k - 1]) mesh_.face_points.push_back(face[k]);
    if (mesh_.face_points.size() < start + 3) return mesh_.face_points.resize(start);
    mesh_.face_starts.push_back(static_cast<std::int32_t>(start));
    mesh_.owner.push_back(static_cast<std::int32_t>(mesh_.cells));
  }

  void add_shape(std::span<const double> labels) {
    const auto type = piece_->types[cell_];
    const auto [prism, pyramid] = is_volume(type) ? shape_of(static_cast<int>(type)) : Shape{};
    if (prism + pyramid == 0) fail("expected a cell with a volume, found VTK type {}", type);
    const auto expected = prism > 0 ? 2 * prism : pyramid + 1;
    if (labels.size() != expected)
      fail("VTK type {}: expected {} points, found {}", type, expected, labels.size());
    std::array<std::int32_t, 12> points{};
    std::transform(labels.begin(), labels.end(), points.begin(),
                   [this](double label) { return point(label); });
    if (type == voxel) {
      std::swap(points[2], points[3]);
      std::swap(points[6], points[7]);
    }
    const auto n = std::max(prism, pyramid);
    std::array<std::int32_t, 6> bottom{};
    std::reverse_copy(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(n),
                      bottom.begin());
    add_face(std::span(bottom).first(n));
    if (prism > 0) add_face(std::span(points).subspan(n, n));
    for (std::size_t k = 0; k < n; ++k) {
      const auto next = (k + 1) % n;
      if (prism > 0)
        add_face(std::array{points[k], points[next], points[n + next], points[n + k]});
      else
        add_face(std::array{points[k], points[next], points[n]});
    }
    ++mesh_.cells;
  }

  void add_polyhedron(double begin, double end) {
    const auto& stream = piece_->faces;
    if (!(end > begin) || end > static_cast<double>(stream.size()))
      fail("a polyhedron without faces (they end at {} of {})", end, stream.size());
    auto at = static_cast<std::size_t>(begin);
    const auto stop = static_cast<std::size_t>(end);
    const auto number = [&](std::string_view what, double least) {
      if (at == stop) fail("its list of faces ends early, expected a number of {}", what);
      const double value = stream[at++];
      if (!(value >= least && value <= static_cast<double>(stop - at)) ||
          value != std::floor(value))
        fail("expected a number of {} from {} to {}, found {}", what, least, stop - at, value);
      return static_cast<std::size_t>(value);
    };
    std::vector<Face> faces(number("faces", 4));
    for (auto& face : faces) {
      face.resize(number("points", 3));
      for (auto& label : face) label = point(stream[at++]);
    }
    if (at != stop) fail("its list of faces goes on behind the last face");
    turn_outward(faces);
    for (const auto& face : faces) add_face(face);
    ++mesh_.cells;
  }

  // The hull of points without an order (MFiX writes its cells so): each plane through three of
  // them that has all others on one side bears a face.
  void add_convex(std::span<const double> labels) {
    if (labels.size() < 4 || labels.size() > most_convex)
      fail("a convex set of {} points, expected 4 to {}", labels.size(), most_convex);
    Face points;
    for (const double label : labels) points.push_back(point(label));
    std::vector<Face> faces;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = i + 1; j < points.size(); ++j)
        for (std::size_t k = j + 1; k < points.size(); ++k) {
          auto face = face_through({points[i], points[j], points[k]}, points);
          if (face.size() > 2 && std::find(faces.begin(), faces.end(), face) == faces.end())
            faces.push_back(std::move(face));
        }
    for (auto& face : faces) go_round(face);
    if (faces.size() < 4) fail("a convex set of points in one plane");
    turn_outward(faces);
    for (const auto& face : faces) add_face(face);
    ++mesh_.cells;
  }

  // The points in the plane of `three`, in their order; none where it has points on both sides.
  Face face_through(const Face& three, const Face& points) const {
    const auto normal = area_of(three);
    const double size = std::hypot(normal[0], normal[1], normal[2]);
    if (!(size > 0)) return {};
    Face face;
    bool above = false, below = false;
    for (const auto label : points) {
      double height = 0, length = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        const double from = at(label)[a] - at(three[0])[a];
        height += normal[a] / size * from;
        length = std::max(length, std::abs(from));
      }
      constexpr double rounding = 1e-9;
      if (std::abs(height) <= 4 * piece_->resolution + rounding * length)
        face.push_back(label);
      else
        (height > 0 ? above : below) = true;
    }
    return above && below ? Face{} : face;
  }

  // Brings the points of a convex face into the order of its edge.
  void go_round(Face& face) const {
    Point middle{}, normal{};
    for (const auto label : face)
      for (std::size_t a = 0; a < 3; ++a)
        middle[a] += at(label)[a] / static_cast<double>(face.size());
    for (std::size_t k = 2; k < face.size(); ++k) {  // the widest triangle: others may have no area
      const auto area = area_of({face[0], face[k - 1], face[k]});
      if (std::hypot(area[0], area[1], area[2]) > std::hypot(normal[0], normal[1], normal[2]))
        normal = area;
    }
    // Seen along the axis that the face is most square to.
    std::size_t axis = 0;
    for (std::size_t a = 1; a < 3; ++a)
      if (std::abs(normal[a]) > std::abs(normal[axis])) axis = a;
    const auto b = (axis + 1) % 3, c = (axis + 2) % 3;
    const auto angle = [&](std::int32_t label) {
      return std::atan2(at(label)[c] - middle[c], at(label)[b] - middle[b]);
    };
    std::sort(face.begin(), face.end(),
              [&](std::int32_t one, std::int32_t other) { return angle(one) < angle(other); });
  }

  // Faces of a closed surface that are all turned alike have areas that add up to nothing.
  void turn_outward(std::vector<Face>& faces) const {
    if (closed(faces)) return;
    Point middle{};
    double count = 0;
    for (const auto& face : faces)
      for (const auto label : face) {
        ++count;
        for (std::size_t a = 0; a < 3; ++a) middle[a] += at(label)[a];
      }
    for (auto& x : middle) x /= count;
    for (auto& face : faces) {
      const auto area = area_of(face);
      double outward = 0;
      for (std::size_t a = 0; a < 3; ++a) outward += area[a] * (at(face[0])[a] - middle[a]);
      if (outward < 0) std::reverse(face.begin(), face.end());
    }
    if (!closed(faces)) fail("its faces do not close a volume");
  }

  const Point& at(std::int32_t label) const {
    return mesh_.points[static_cast<std::size_t>(label)];
  }

  Point area_of(const Face& face) const {
    Point area{};
    for (std::size_t k = 1; k + 1 < face.size(); ++k)
      for (std::size_t a = 0; a < 3; ++a) {
        const auto b = (a + 1) % 3, c = (a + 2) % 3;
        const auto &o = at(face[0]), &p = at(face[k]), &q = at(face[k + 1]);
        area[a] += 0.5 * ((p[b] - o[b]) * (q[c] - o[c]) - (p[c] - o[c]) * (q[b] - o[b]));
      }
    return area;
  }

  bool closed(const std::vector<Face>& faces) const {
    constexpr double rounding = 1e-6;  // OpenFOAM's closedThreshold, of the sum of their sizes
    Point sum{};
    double size = 0;
    for (const auto& face : faces) {
      const auto area = area_of(face);
      for (std::size_t a = 0; a < 3; ++a) sum[a] += area[a];
      size += std::hypot(area[0], area[1], area[2]);
    }
    return std::hypot(sum[0], sum[1], sum[2]) <= rounding * size;
  }

  const std::string& path_;
  PolyMesh mesh_;
  const VtkCells* piece_ = nullptr;
  std::size_t first_point_ = 0, cell_ = 0;
  double resolution_ = 0;
};

}  // namespace

std::vector<Point> points_of(const std::array<std::vector<double>, 3>& axes,
                             const std::string& path) {
  std::vector<Point> points(axes[0].size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    points[p] = {axes[0][p], axes[1][p], axes[2][p]};
    if (!std::isfinite(points[p][0] + points[p][1] + points[p][2]))
      throw FormatError("{}: point {} is not finite", path, p);
  }
  return points;
}

double resolution_of(std::span<const Point> points, bool text, bool single) {
  double largest = 0;
  for (const auto& point : points)
    for (const double x : point) largest = std::max(largest, std::abs(x));
  return largest * (text ? 1e-6 : single ? std::numeric_limits<float>::epsilon() : 0);
}

bool is_volume(double vtk_type) {
  if (!(vtk_type >= 0 && vtk_type <= 255) || vtk_type != std::floor(vtk_type)) return false;
  const auto [prism, pyramid] = shape_of(static_cast<int>(vtk_type));
  return vtk_type == polyhedron || vtk_type == convex_point_set || prism + pyramid > 0;
}

Mesh mesh_of(std::span<const VtkCells> pieces, const std::string& path) {
  MeshMaker maker(path);
  for (const auto& piece : pieces) maker.add(piece);
  return maker.finish();
}

}  // namespace bedscope::readers
