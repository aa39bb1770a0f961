// SPDX-License-Identifier: BSD-3-Clause
#include "cases/liggghts_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bedscope::cases {
namespace {

/// A wall of triangles that stands on a line in the plane of x and z and spans the depth.
class Curtain {
 public:
  Curtain(std::string name, double y_low, double y_high)
      : name_(std::move(name)), low_(y_low), high_(y_high) {}

  void panel(double x0, double z0, double x1, double z1) {
    triangle({x0, low_, z0}, {x1, low_, z1}, {x1, high_, z1});
    triangle({x0, low_, z0}, {x1, high_, z1}, {x0, high_, z0});
  }
  DeckFile file() const {
    return {"DEM/" + name_ + ".stl", fmt::format("solid {0}\n{1}endsolid {0}\n", name_, text_)};
  }

 private:
  void triangle(const Vector& a, const Vector& b, const Vector& c) {
    Vector u{}, v{};
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = b[k] - a[k];
      v[k] = c[k] - a[k];
    }
    const Vector n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double length = std::hypot(n[0], n[1], n[2]);
    text_ += fmt::format("facet normal {:.9g} {:.9g} {:.9g}\nouter loop\n", n[0] / length,
                         n[1] / length, n[2] / length);
    for (const auto& p : {a, b, c})
      text_ += fmt::format("vertex {:.9g} {:.9g} {:.9g}\n", p[0], p[1], p[2]);
    text_ += "endloop\nendfacet\n";
  }

  std::string name_, text_;
  double low_, high_;
};

/// x seen from the wall of the outlet.
double from_outlet(const Scene& scene, double x) {
  return scene.outlet.place == Place::left ? x : scene.geometry.width - x;
}

/// The wall under the opening, in panels about as tall as the depth: LIGGGHTS dislikes slivers.
DeckFile wall_below_outlet(const Scene& scene, const Curtain& empty) {
  auto wall = empty;
  const auto& g = scene.geometry;
  const double x = from_outlet(scene, 0), bottom = -margin(scene);
  const int panels = std::clamp(static_cast<int>(g.height / g.depth / 2), 1, 200);
  const double step = (g.height - bottom) / panels;
  for (int i = 0; i < panels; ++i) wall.panel(x, bottom + i * step, x, bottom + (i + 1) * step);
  return wall.file();
}

DeckFile bend(const Scene& scene, const Curtain& empty) {
  auto wall = empty;
  constexpr int panels = 48;  // a chord is 0.013 % of the radius inside the arc
  const double r = scene.outlet.height;
  const auto point = [&](int i) {
    const double angle = i * std::numbers::pi / 2 / panels;
    return std::pair{from_outlet(scene, r * std::cos(angle)),
                     scene.geometry.height + r * std::sin(angle)};
  };
  for (int i = 0; i < panels; ++i) {
    const auto [x0, z0] = point(i);
    const auto [x1, z1] = point(i + 1);
    wall.panel(x0, z0, x1, z1);
  }
  return wall.file();
}

}  // namespace

double margin(const Scene& scene) { return std::max(0.02, 20 * largest_diameter(scene)); }

ParticleWalls particle_walls(const Scene& scene) {
  const auto& g = scene.geometry;
  const auto& out = scene.outlet;
  const bool closed = scene.inlet.particles == Supply::closed;
  ParticleWalls walls;
  walls.planes = {{"bottom", "zplane", 0}, {"front", "yplane", 0}, {"back", "yplane", g.depth}};
  if (out.place != Place::left || closed) walls.planes.push_back({"left", "xplane", 0});
  if (out.place != Place::right || closed) walls.planes.push_back({"right", "xplane", g.width});
  if ((out.lateral() && out.head == Head::box) || (!out.lateral() && closed))
    walls.planes.push_back({"top", "zplane", total_height(scene)});
  const auto add = [&](const char* name, DeckFile (*make)(const Scene&, const Curtain&)) {
    walls.meshes.emplace_back(name);
    walls.files.push_back(make(scene, Curtain(name, -g.depth / 4, g.depth * 5 / 4)));
  };
  if (out.lateral() && !closed) add("wall_below_outlet", wall_below_outlet);
  if (out.head != Head::box) add("bend", bend);
  return walls;
}

std::vector<Vector> rough_wall(const Scene& scene) {
  std::vector<Vector> centres;
  if (scene.outlet.head != Head::rough_bend) return centres;
  const double d = scene.species[0].diameter, r = scene.outlet.height;
  const int across = std::max(1, static_cast<int>(scene.geometry.depth / d));
  const int along = static_cast<int>(std::numbers::pi / 2 * r / d);
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j) {
      const double angle = (i + 0.5) / along * std::numbers::pi / 2;
      centres.push_back({from_outlet(scene, r * std::cos(angle)),
                         (j + 0.5) * scene.geometry.depth / across,
                         scene.geometry.height + r * std::sin(angle)});
    }
  return centres;
}

}  // namespace bedscope::cases
