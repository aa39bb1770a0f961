// SPDX-License-Identifier: BSD-3-Clause
// The closed forms and the exact kernel against an independent reference: the areas in which discs
// and rectangles overlap, integrated over the sphere's slices by adaptive quadrature.
#include "analysis/overlap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "analysis/mapping.hpp"

namespace bedscope::analysis {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double beyond = 100.0;  // a plane that is not there

struct Box {
  Vec3 lo, hi;
};

// ---- the reference ----

/// Signed area of the part of triangle (centre, p, q) that lies in a disc about the centre.
double disc_triangle_area(double radius, std::array<double, 2> p, std::array<double, 2> q) {
  const double dx = q[0] - p[0], dy = q[1] - p[1];
  const auto sector = [&](std::array<double, 2> u, std::array<double, 2> v) {
    const double angle = std::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]);
    return 0.5 * radius * radius * angle;
  };
  const double a = dx * dx + dy * dy;
  if (a == 0.0) return 0.0;
  const double b = p[0] * dx + p[1] * dy;
  const double c = p[0] * p[0] + p[1] * p[1] - radius * radius;
  const double root2 = b * b - a * c;
  if (root2 <= 0.0) return sector(p, q);
  const double t0 = std::clamp((-b - std::sqrt(root2)) / a, 0.0, 1.0);
  const double t1 = std::clamp((-b + std::sqrt(root2)) / a, 0.0, 1.0);
  if (t0 >= t1) return sector(p, q);
  const std::array<double, 2> u{p[0] + t0 * dx, p[1] + t0 * dy}, v{p[0] + t1 * dx, p[1] + t1 * dy};
  double area = 0.5 * (u[0] * v[1] - u[1] * v[0]);
  if (t0 > 0.0) area += sector(p, u);
  if (t1 < 1.0) area += sector(v, q);
  return area;
}

double disc_rectangle_area(double radius, double x0, double x1, double y0, double y1) {
  const std::array<std::array<double, 2>, 4> corner{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
  double area = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
    area += disc_triangle_area(radius, corner[i], corner[(i + 1) % 4]);
  return area;
}

/// Nodes and weights of Gauss-Legendre on [-1, 1], by Newton's method.
struct Gauss {
  static constexpr unsigned order = 16;
  std::array<double, order> node, weight;
  Gauss() {
    for (unsigned i = 0; i < order; ++i) {
      double x = std::cos(pi * (i + 0.75) / (order + 0.5)), slope = 1.0;
      for (int step = 0; step < 50; ++step) {
        slope = order * (x * std::legendre(order, x) - std::legendre(order - 1, x)) / (x * x - 1.0);
        x -= std::legendre(order, x) / slope;
      }
      node[i] = x;
      weight[i] = 2.0 / ((1.0 - x * x) * slope * slope);
    }
  }
  double integral(const std::function<double(double)>& f, double a, double b) const {
    double sum = 0.0;
    for (unsigned i = 0; i < order; ++i)
      sum += weight[i] * f(0.5 * (a + b) + 0.5 * (b - a) * node[i]);
    return 0.5 * (b - a) * sum;
  }
  double adaptive(const std::function<double(double)>& f, double a, double b, double whole,
                  int depth_left) const {
    const double middle = 0.5 * (a + b);
    const double left = integral(f, a, middle), right = integral(f, middle, b);
    if (depth_left == 0 || std::abs(left + right - whole) < 1e-13) return left + right;
    return adaptive(f, a, middle, left, depth_left - 1) +
           adaptive(f, middle, b, right, depth_left - 1);
  }
};

/// Volume of the unit sphere in a box, by slices across axis 1. The slices' area has kinks where
/// the slice's circle passes an edge or a corner of the rectangle: the integral is split there, and
/// within a part y runs as a cosine, which smooths the square roots at its ends.
double reference_volume(const Box& box) {
  static const Gauss gauss;
  const double y0 = std::clamp(box.lo[1], -1.0, 1.0), y1 = std::clamp(box.hi[1], -1.0, 1.0);
  std::vector<double> split{y0, y1};
  const auto split_at = [&](double distance2) {
    if (distance2 >= 1.0) return;
    for (const double y : {-std::sqrt(1.0 - distance2), std::sqrt(1.0 - distance2)})
      if (y > y0 && y < y1) split.push_back(y);
  };
  for (const double x : {box.lo[0], box.hi[0]}) {
    split_at(x * x);
    for (const double z : {box.lo[2], box.hi[2]}) {
      split_at(z * z);
      split_at(x * x + z * z);
    }
  }
  std::sort(split.begin(), split.end());
  double volume = 0.0;
  for (std::size_t i = 0; i + 1 < split.size(); ++i) {
    const double middle = 0.5 * (split[i] + split[i + 1]), half = 0.5 * (split[i + 1] - split[i]);
    if (half <= 0.0) continue;
    const auto slice = [&](double angle) {
      const double y = middle - half * std::cos(angle);
      return disc_rectangle_area(std::sqrt(std::max(1.0 - y * y, 0.0)), box.lo[0], box.hi[0],
                                 box.lo[2], box.hi[2]) *
             half * std::sin(angle);
    };
    volume += gauss.adaptive(slice, 0.0, pi, gauss.integral(slice, 0.0, pi), 12);
  }
  return volume;
}

/// Parts of a sphere in all cells, and the largest difference from the reference in sphere volumes.
double largest_difference(const Grid& grid, const Vec3& centre, double radius) {
  std::vector<double> parts(grid.size());
  ExactKernel(grid).share(centre, radius,
                          [&](std::size_t cell, double part) { parts.at(cell) += part; });
  double largest = 0.0;
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i) {
        const std::array<int, 3> cell{i, j, k};
        Box box{};
        double reach2 = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
          const bool cut = axis != depth || !grid.depth_averaged();
          box.lo[axis] = cut ? (grid.face(axis, cell[axis]) - centre[axis]) / radius : -beyond;
          box.hi[axis] = cut ? (grid.face(axis, cell[axis] + 1) - centre[axis]) / radius : beyond;
          const double reach = std::max({box.lo[axis], -box.hi[axis], 0.0});
          reach2 += reach * reach;
        }
        const double part = parts[grid.index(i, j, k)] / sphere_volume(radius);
        const double expected = reach2 < 1.0 ? reference_volume(box) / sphere_volume(1.0) : 0.0;
        largest = std::max(largest, std::abs(part - expected));
      }
  return largest;
}

constexpr double tolerance = 1e-10;  // what the kernel promises, of the sphere's volume
const Grid averaged{{-0.4, 0.0, 0.3}, {0.6, 0.2, 1.2}, {5, 1, 4}, {}};
const Grid cubes{{-0.4, 0.1, 0.3}, {0.6, 0.7, 1.2}, {5, 3, 4}, {}};

// ---- the reference itself ----

TEST(Reference, DiscInSquareHasKnownAreas) {
  EXPECT_NEAR(disc_rectangle_area(1, -2, 2, -2, 2), pi, 1e-14);
  EXPECT_NEAR(disc_rectangle_area(1, 0, 2, 0, 2), pi / 4, 1e-14);
  EXPECT_NEAR(disc_rectangle_area(2, -1, 1, -1, 1), 4, 1e-14);
  // A segment of half-angle 60 degrees.
  EXPECT_NEAR(disc_rectangle_area(1, 0.5, 9, -9, 9), pi / 3 - std::sqrt(3.0) / 4, 1e-14);
}

TEST(Reference, SphereInHalfSpaceIsACap) {
  for (const double a : {-0.9, -0.2, 0.0, 0.5, 0.999})
    for (int axis = 0; axis < 3; ++axis) {
      Box box{{-beyond, -beyond, -beyond}, {beyond, beyond, beyond}};
      box.lo[axis] = a;
      EXPECT_NEAR(reference_volume(box), cap_volume(a), 1e-12) << a << " along " << axis;
    }
}

// ---- closed forms ----

TEST(Wedge, OfTwoPlanesThroughTheCentreIsAQuarterOfTheSphere) {
  EXPECT_NEAR(wedge_volume(0, 0), sphere_volume(1) / 4, 1e-15);
}

TEST(Wedge, OfAPlaneThroughTheCentreIsHalfACap) {
  for (const double a : {0.0, 1e-9, 0.1, 0.5, 0.7, 0.99, 1 - 1e-12}) {
    EXPECT_NEAR(wedge_volume(a, 0), cap_volume(a) / 2, 4e-16) << a;
    EXPECT_NEAR(wedge_volume(0, a), cap_volume(a) / 2, 4e-16) << a;
  }
}

TEST(Wedge, AgreesWithQuadrature) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 300; ++trial) {
    const double a = unit(random), b = unit(random);
    const Box box{{a, -beyond, b}, {beyond, beyond, beyond}};
    EXPECT_NEAR(wedge_volume(a, b), reference_volume(box), 1e-13) << a << ' ' << b;
  }
}

TEST(Wedge, VanishesSmoothlyWhereItsEdgeTouchesTheSphere) {
  for (const double angle : {1e-9, 1e-4, 0.3, pi / 4, 1.2, pi / 2 - 1e-6})
    for (const double gap : {0.0, 1e-16, 1e-15, 1e-12, 1e-8}) {
      const double a = (1 - gap) * std::cos(angle), b = (1 - gap) * std::sin(angle);
      const double volume = wedge_volume(a, b);
      EXPECT_GE(volume, 0.0);
      // It lies in the cap cut off at the edge's distance, pi gap^2 high; the rest is rounding.
      EXPECT_LE(volume, pi * gap * gap + 2e-16) << angle << ' ' << gap;
      EXPECT_LE(volume, std::min(cap_volume(a), cap_volume(b)));
    }
  EXPECT_EQ(wedge_volume(1, 0), 0.0);
  EXPECT_EQ(wedge_volume(0.8, 0.6000001), 0.0);
}

TEST(Octant, OfThreePlanesThroughTheCentreIsAnEighth) {
  EXPECT_NEAR(octant_volume(0, 0, 0, 3 * wedge_volume(0, 0)), sphere_volume(1) / 8, 1e-15);
}

TEST(Octant, AgreesWithQuadrature) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 300; ++trial) {
    const double a = unit(random), b = unit(random), c = unit(random);
    if (a * a + b * b + c * c >= 1.0) continue;
    const double wedges = wedge_volume(a, b) + wedge_volume(b, c) + wedge_volume(c, a);
    EXPECT_NEAR(octant_volume(a, b, c, wedges),
                reference_volume({{a, b, c}, {beyond, beyond, beyond}}), 1e-13)
        << a << ' ' << b << ' ' << c;
  }
}

TEST(Boxes, AgreeWithQuadratureAndFillTheSphere) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  for (int trial = 0; trial < 5; ++trial) {
    std::array<Slabs, 3> slabs;
    for (int axis = 0; axis < 3; ++axis) {
      Slabs& s = slabs[axis];
      s.count = 2 + axis;
      s.at[0] = -1.0;
      for (int i = 1; i < s.count; ++i) s.at[i] = place(random);
      s.at[s.count] = 1.0;
      std::sort(s.at.begin(), s.at.begin() + s.count + 1);
    }
    BoxVolumes volumes;
    box_volumes(slabs[0], slabs[1], slabs[2], volumes);
    double sum = 0.0;
    for (int k = 0; k < slabs[2].count; ++k)
      for (int j = 0; j < slabs[1].count; ++j)
        for (int i = 0; i < slabs[0].count; ++i) {
          const double volume = volumes[Slabs::box(i, j, k)];
          const Box box{{slabs[0].at[i], slabs[1].at[j], slabs[2].at[k]},
                        {slabs[0].at[i + 1], slabs[1].at[j + 1], slabs[2].at[k + 1]}};
          EXPECT_NEAR(volume, reference_volume(box), 1e-13);
          sum += volume;
        }
    EXPECT_NEAR(sum, sphere_volume(1), 1e-14);
  }
}

// ---- the kernel ----

TEST(Exact, AgreesWithQuadratureForRandomSpheres) {
  std::mt19937_64 random(14);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const Grid* grid : {&averaged, &cubes})
    for (int trial = 0; trial < 400; ++trial) {
      // From a tenth of a cell to two cells, evenly in the logarithm, at times centred outside.
      const double radius = grid->width(lateral) * 0.1 * std::pow(20.0, unit(random));
      Vec3 centre;
      for (int axis = 0; axis < 3; ++axis) {
        const double margin = axis == depth && grid->depth_averaged() ? 0.0 : 0.5 * radius;
        centre[axis] = grid->min[axis] - margin + (grid->length(axis) + 2 * margin) * unit(random);
      }
      EXPECT_LT(largest_difference(*grid, centre, radius), tolerance)
          << radius << " at " << centre[0] << ' ' << centre[1] << ' ' << centre[2];
    }
}

TEST(Exact, AgreesWithQuadratureAtFacesWallsAndCorners) {
  // Planes through the centre, tangent to it, and either within a few roundings.
  for (const Grid* grid : {&averaged, &cubes})
    for (const double cells : {0.3, 0.5, 1.0, 1.7}) {
      const double radius = cells * grid->width(lateral);
      for (const double shift : {0.0, 1.0, -1.0, 0.4})
        for (const double error : {0.0, 1e-15, -1e-15, 1e-9})
          for (const int face : {0, 2}) {
            Vec3 centre{grid->face(0, face) + radius * (shift + error), 0.15, 0.0};
            centre[2] = grid->face(2, face) + radius * (shift > 0 ? -shift - error : 0.3);
            if (!grid->depth_averaged()) centre[1] = grid->face(1, 1) + radius * (shift + error);
            EXPECT_LT(largest_difference(*grid, centre, radius), tolerance)
                << cells << " cells, shift " << shift << " + " << error << ", face " << face;
          }
    }
}

TEST(Exact, AgreesWithQuadratureForSpheresOverMoreThanABlockOfCells) {
  const Grid fine{{0, 0, 0}, {1.9, 1, 2.1}, {19, 1, 21}, {}};
  EXPECT_LT(largest_difference(fine, {0.93, 0.5, 1.01}, 0.91), tolerance);
  EXPECT_LT(largest_difference(fine, {0.2, 0.5, 2.1}, 0.85), tolerance);
  const Grid flat{{0, 0, 0}, {1.1, 0.2, 1.1}, {11, 2, 11}, {}};
  EXPECT_LT(largest_difference(flat, {0.53, 0.12, 0.61}, 0.5), tolerance);
}

TEST(Exact, GivesNothingToCellsThatTheSphereDoesNotReach) {
  std::mt19937_64 random(15);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const Grid* grid : {&averaged, &cubes})
    for (int trial = 0; trial < 2000; ++trial) {
      const double radius = grid->width(lateral) * (0.05 + 1.5 * unit(random));
      Vec3 centre;
      for (int axis = 0; axis < 3; ++axis)
        centre[axis] = grid->min[axis] + grid->length(axis) * unit(random);
      ExactKernel(*grid).share(centre, radius, [&](std::size_t cell, double part) {
        const int index = static_cast<int>(cell);
        const std::array<int, 3> at{index % grid->cells[0], index / grid->cells[0] % grid->cells[1],
                                    index / (grid->cells[0] * grid->cells[1])};
        double reach2 = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
          if (axis == depth && grid->depth_averaged()) continue;
          const double reach = std::max({grid->face(axis, at[axis]) - centre[axis],
                                         centre[axis] - grid->face(axis, at[axis] + 1), 0.0});
          reach2 += reach * reach;
        }
        // Rounding of the faces may show a cell as reached that is just touched.
        EXPECT_LT(reach2, radius * radius * (1 + 1e-12));
        EXPECT_GE(part, 0.0);
      });
    }
}

}  // namespace
}  // namespace bedscope::analysis
