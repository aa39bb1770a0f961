// SPDX-License-Identifier: BSD-3-Clause
// Volumes that planes parallel to the axes cut from a sphere, in closed form. All of them rest on
// one function of two planes, wedge_volume; a third plane costs no inverse trigonometry.
// Lengths are in radii from the sphere's centre, volumes in radii cubed, errors a few 1e-16 of it.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>

namespace bedscope::analysis {

/// Volume of a sphere [m3]. Callers that count what lies outside use this one, so that a particle
/// wholly inside leaves nothing behind.
constexpr double sphere_volume(double radius) {
  return (4.0 / 3.0 * std::numbers::pi) * (radius * radius * radius);
}

/// Volume of the cap {x > a} of the unit sphere, pi/3 (1 - a)^2 (2 + a), for -1 <= a <= 1.
constexpr double cap_volume(double a) {
  return (std::numbers::pi / 3.0) * ((1.0 - a) * (1.0 - a) * (2.0 + a));
}

/// Volume of the wedge {x > a, y > b} of the unit sphere for a, b >= 0; 0 where a^2 + b^2 >= 1.
///
///   Q = 2/3 (atan2(c, ab) + abc) - (a - a^3/3) atan2(c, b) - (b - b^3/3) atan2(c, a)
///
/// with c = sqrt(1 - a^2 - b^2). By the divergence theorem 3Q is the area of the piece of sphere
/// (Gauss-Bonnet: two corners of angle atan2(c, ab), two arcs) less a and b times the areas of the
/// two circular segments. dQ/dc at fixed a, b is O(c^2), hence no loss of digits near a tangent.
double wedge_volume(double a, double b);

/// Volume of the octant {x > a, y > b, z > c} of the unit sphere for a corner (a, b, c) inside it
/// with a, b, c >= 0, given the wedges of its three pairs of planes.
///
///   O = (Q_ab + Q_bc + Q_ca)/2 - abc - pi/3 + pi/4 ((a - a^3/3) + (b - b^3/3) + (c - c^3/3))
///
/// The integral of sgn(x-a) sgn(y-b) sgn(z-c) over the sphere is -8abc, since all but the box
/// [-a,a] x [-b,b] x [-c,c] cancels by symmetry; expanded, that is this sum.
double octant_volume(double a, double b, double c, double wedges);

/// Up to `size` neighbouring slabs along one axis: slab i lies between at[i] and at[i + 1], planes
/// ascending within [-1, 1].
struct Slabs {
  static constexpr int size = 8;
  int count = 0;
  std::array<double, size + 1> at{};

  /// Where box_volumes puts the box of slabs i, j, k.
  static constexpr std::size_t box(int i, int j, int k) {
    return static_cast<std::size_t>(i) +
           std::size_t{size} *
               (static_cast<std::size_t>(j) + std::size_t{size} * static_cast<std::size_t>(k));
  }
};

/// Volumes of the unit sphere in the boxes of three families of slabs, into `volumes`, box (i,j,k)
/// at i + Slabs::size * (j + Slabs::size * k). Exactly 0 where sphere and box do not meet, and
/// never negative.
using BoxVolumes = std::array<double, std::size_t{Slabs::size} * std::size_t{Slabs::size} *
                                          std::size_t{Slabs::size}>;
void box_volumes(const Slabs& x, const Slabs& y, const Slabs& z, BoxVolumes& volumes);

}  // namespace bedscope::analysis
