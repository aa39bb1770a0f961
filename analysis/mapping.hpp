// SPDX-License-Identifier: BSD-3-Clause
// Kernels that share a particle's volume among the cells of a grid. One long header, since all of
// it runs in the loop over particles and must be seen by the compiler there.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <variant>

#include "analysis/grid.hpp"
#include "analysis/overlap.hpp"

namespace bedscope::analysis {

/// One axis of a grid, with what the kernels' loops would otherwise divide by again and again. Its
/// faces are Grid::face to the bit; on a periodic axis they go on beyond the domain.
/// Throws InputError when the axis has no cells or no length.
class GridAxis {
 public:
  static constexpr int outside = -1;

  GridAxis(const Grid& grid, int axis);

  int cells() const { return cells_; }
  bool periodic() const { return periodic_; }
  double length() const { return max_ - min_; }
  double width() const { return width_; }
  double face(int i) const { return i == cells_ ? max_ : min_ + i * width_; }

  bool contains(double x) const { return x >= min_ && x <= max_; }
  /// Whether any of [x - reach, x + reach] is within the domain.
  bool meets(double x, double reach) const { return x >= min_ - reach && x <= max_ + reach; }
  /// x itself, or on a periodic axis its image inside the domain.
  double wrap(double x) const { return !periodic_ || contains(x) ? x : image(x); }
  /// The cell [face(i), face(i + 1)) that holds x, the last one closed; periodic: that of its
  /// image.
  int cell_of(double x) const;
  /// Cell i, or its image on a periodic axis, or `outside`.
  int cell(int i) const {
    if (i >= 0 && i < cells_) return i;
    return periodic_ ? (i % cells_ + cells_) % cells_ : outside;
  }

  /// The first and the last cell that [x - reach, x + reach] meets, not wrapped; on an axis with
  /// walls -1 stands for all before the first cell and cells() for all behind the last.
  struct Range {
    int first, last;
  };
  Range range(double x, double reach) const {
    return {bounded_floor((x - reach - min_) * per_width_),
            bounded_floor((x + reach - min_) * per_width_)};
  }

  /// The one plane that can cut a sphere no wider than a cell: its distance from the centre in
  /// radii, the cell on the centre's side and the one beyond; 1 and twice the centre's cell where
  /// it does not cut.
  struct Cut {
    double distance;
    int near, far;
  };
  Cut cut(double x, double per_radius) const {
    const double nearest = (x - min_) * per_width_ + 0.5;
    const int i = static_cast<int>(std::max(0.0, std::min(nearest, static_cast<double>(cells_))));
    const double t = (face(i) - x) * per_radius, height = 1.0 - std::abs(t);
    const int above = t < 0.0 ? 1 : 0;  // the centre is above the plane
    const int cuts = height > 0.0 ? 1 : 0;
    const int near = i - 1 + above, far = near + cuts * (1 - 2 * above);
    // 1 - max(height, 0), without the branch that compilers would make of it.
    return {1.0 - 0.5 * (height + std::abs(height)), cell(near), cell(far)};
  }

 private:
  double image(double x) const;
  // floor without libm's call; bounded so that no position, however far, overflows an int.
  int bounded_floor(double v) const {
    v = v > lowest_ ? std::min(v, highest_) : lowest_;
    const int i = static_cast<int>(v);
    return i - (v < i ? 1 : 0);
  }

  double min_, max_, width_, per_width_;
  int cells_;
  bool periodic_;
  double lowest_, highest_;  // bounds of bounded_floor
  double rounding_;          // how near to a face [cells] a product may err about its side
};

/// The three axes and the cells' order, shared by all kernels.
class GridAxes {
 public:
  explicit GridAxes(const Grid& grid)
      : axes_{GridAxis(grid, lateral), GridAxis(grid, depth), GridAxis(grid, up)},
        depth_averaged_(grid.depth_averaged()) {}

  const GridAxis& operator[](int axis) const { return axes_[static_cast<std::size_t>(axis)]; }
  bool depth_averaged() const { return depth_averaged_; }
  /// False where a depth-averaged grid takes no part of a particle centred at x.
  bool within_depth(double x) const {
    return !depth_averaged_ || axes_[depth].periodic() || axes_[depth].contains(x);
  }
  Vec3 wrap(const Vec3& x) const {
    return {axes_[0].wrap(x[0]), axes_[1].wrap(x[1]), axes_[2].wrap(x[2])};
  }
  static bool inside(int i, int j, int k) { return (i | j | k) >= 0; }
  std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(axes_[0].cells()) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(axes_[1].cells()) * static_cast<std::size_t>(k));
  }

 private:
  std::array<GridAxis, 3> axes_;
  bool depth_averaged_;
};

// A kernel is a value with
//   template <class Add> double share(const Vec3& centre, double radius, Add&& add) const;
// which calls add(std::size_t cell, double volume) for every cell that gets a part [m3] and returns
// the volume that was put inside: exactly sphere_volume(radius) for a particle wholly inside, so
// that the caller counts sphere_volume(radius) less the return value as outside. A cell may get
// several parts of one particle, some of them 0; a cell that the particle does not reach gets none.
// On periodic axes centre and parts wrap. Positions may be any number; a particle without a
// positive radius is put nowhere. Thread-safe; nothing is allocated.

/// The whole particle to the cell of its centre. Cells are half-open, the last one closed, as in
/// numpy.histogram with edges from numpy.linspace. A centre outside the domain: nothing inside.
class CentreKernel {
 public:
  explicit CentreKernel(const Grid& grid) : axes_(grid) {}
  template <class Add>
  double share(const Vec3& centre, double radius, Add&& add) const;

 private:
  GridAxes axes_;
};

/// The analytic overlap of sphere and cell (overlap.hpp). A depth-averaged grid is cut by lateral
/// and up planes only: a particle centred between front and back counts whole in depth, any other
/// not at all. What lies beyond a wall is outside. A sphere of a radius of more than a hundred
/// times the domain's shortest side is none of this bed: wholly outside.
/// Cost: some 15 ns where no more than four cells share the particle; O(cells met) otherwise.
class ExactKernel {
 public:
  explicit ExactKernel(const Grid& grid);
  template <class Add>
  double share(const Vec3& centre, double radius, Add&& add) const;

 private:
  template <class Add>
  class Deposit;
  template <class Add>
  double among_four(const Vec3& centre, double radius, Add& add) const;
  template <class Add>
  double among_eight(const Vec3& centre, double radius, Add& add) const;
  template <class Add>
  double among_many(const Vec3& centre, double radius, Add& add) const;

  GridAxes axes_;
  static constexpr double smallest_ = 1e-100;  // of less, the volume would be no normal number
  double narrow_;   // radius of the widest sphere that only one plane of a family can cut
  double largest_;  // radius of the largest sphere that is shared at all
};

/// Satellite points, each with an equal part of the volume for the cell of its point: the centre
/// and, at 0.623926 and 0.917902 radii, six points along the axes and eight between them at polar
/// angles of 45 and 135 degrees to `up` and azimuths of 45, 135, 225, 315 degrees.
/// A point outside the domain is outside (CFDEM gives its part to the centre's cell). On a
/// depth-averaged grid depth counts as in ExactKernel, by the particle's centre: a point in front
/// of the front still belongs to the cell of its lateral and up position.
/// Source: CFDEMcoupling-PUBLIC, voidFractionModel `divided`, dividedVoidFraction.C (29 points;
/// polar axis z).
class DividedKernel {
 public:
  explicit DividedKernel(const Grid& grid) : axes_(grid) {}
  template <class Add>
  double share(const Vec3& centre, double radius, Add&& add) const;

  /// A point, as places along the three axes in `places`.
  struct Satellite {
    int lateral, depth, up;
  };
  static constexpr int points = 29;
  static const std::array<Satellite, points> satellites;
  /// The nine coordinates, in radii, that the points have: along lateral and depth, and along up.
  static const std::array<double, 9> places, places_up;

 private:
  GridAxes axes_;
};

/// The whole particle, spread by the weight exp(-d^2 / 2w^2) integrated over each cell (erf
/// differences, an axis at a time), cut off at 4 w along each axis and normalised within the walls,
/// so that the whole volume stays inside. The particle's own size plays no part. On a
/// depth-averaged grid nothing is spread in depth. A centre outside the domain: nothing inside.
/// Throws InputError when w is negative, not finite, or the cut-off meets more than 128 cells.
class GaussianKernel {
 public:
  static constexpr double cut_off = 4.0;  ///< in w: 6e-5 of the weight is beyond
  static constexpr int most_cells = 128;  ///< along an axis

  /// `width` is w [m]. 0 stands for the widest side of a cell: the narrowest Gaussian that the grid
  /// still resolves (2.4 cells across at half its height), so no more smoothing than must be.
  explicit GaussianKernel(const Grid& grid, double width = 0.0);
  template <class Add>
  double share(const Vec3& centre, double radius, Add&& add) const;
  double width() const { return width_; }

 private:
  struct Weights {
    int count = 0;
    std::array<int, most_cells> cell;      // only the first `count` are set
    std::array<double, most_cells> value;  // their sum is 1
  };
  void weigh(const GridAxis& axis, double x, Weights& weights) const;

  GridAxes axes_;
  double width_;
};

using Kernel = std::variant<CentreKernel, ExactKernel, DividedKernel, GaussianKernel>;

struct KernelOptions {
  double gaussian_width = 0.0;  ///< w of GaussianKernel [m]; 0: its default
};

/// The kernel of that name: centre, exact, divided or gaussian. Throws InputError for any other.
Kernel make_kernel(std::string_view name, const Grid& grid, const KernelOptions& options = {});

// ---- definitions of the templates ----

inline int GridAxis::cell_of(double x) const {
  x = wrap(x);
  if (!contains(x)) return outside;
  const double cells = (x - min_) * per_width_;
  const int i = std::min(static_cast<int>(cells), cells_ - 1);
  const double into = cells - i;
  if (into > rounding_ && into < 1.0 - rounding_) return i;
  // The product may have rounded across a face; the comparison decides, as it does for numpy.
  if (x < face(i)) return i - 1;
  return i + 1 < cells_ && x >= face(i + 1) ? i + 1 : i;
}

template <class Add>
double CentreKernel::share(const Vec3& centre, double radius, Add&& add) const {
  const int i = axes_[lateral].cell_of(centre[lateral]), k = axes_[up].cell_of(centre[up]);
  const int j = !axes_.depth_averaged()             ? axes_[depth].cell_of(centre[depth])
                : axes_.within_depth(centre[depth]) ? 0
                                                    : GridAxis::outside;
  if (!GridAxes::inside(i, j, k) || !(radius > 0.0)) return 0.0;
  const double volume = sphere_volume(radius);
  add(axes_.index(i, j, k), volume);
  return volume;
}

// Adds the parts of one particle that lie inside and knows how much that was.
template <class Add>
class ExactKernel::Deposit {
 public:
  Deposit(const GridAxes& axes, double volume, Add& add)
      : axes_(axes), volume_(volume), add_(add) {}

  void operator()(int i, int j, int k, double part) {
    if (!GridAxes::inside(i, j, k)) {
      whole_ = false;
      return;
    }
    add_(axes_.index(i, j, k), part);
    sum_ += part;
  }
  double inside() const { return whole_ ? volume_ : sum_; }

 private:
  const GridAxes& axes_;
  double volume_, sum_ = 0.0;
  bool whole_ = true;
  Add& add_;
};

template <class Add>
double ExactKernel::share(const Vec3& centre, double radius, Add&& add) const {
  if (!(radius >= smallest_ && radius <= largest_) || !axes_.within_depth(centre[depth]))
    return 0.0;
  const Vec3 x = axes_.wrap(centre);
  if (!axes_[lateral].meets(x[lateral], radius) || !axes_[up].meets(x[up], radius) ||
      (!axes_.depth_averaged() && !axes_[depth].meets(x[depth], radius)))
    return 0.0;
  if (radius > narrow_) return among_many(x, radius, add);
  return axes_.depth_averaged() ? among_four(x, radius, add) : among_eight(x, radius, add);
}

// Whether a plane cuts is a toss-up and a wrong guess costs the processor more than the rest of the
// work. Hence the caps are computed and deposited in any case: where a plane does not cut, its far
// cell is the near one and the cap is 0.
template <class Add>
double ExactKernel::among_four(const Vec3& centre, double radius, Add& add) const {
  const double cube = radius * radius * radius, volume = sphere_volume(radius);
  const auto x = axes_[lateral].cut(centre[lateral], 1.0 / radius);
  const auto z = axes_[up].cut(centre[up], 1.0 / radius);
  const double cap_x = cube * cap_volume(x.distance), cap_z = cube * cap_volume(z.distance);

  Deposit<Add> deposit(axes_, volume, add);
  double wedge = 0.0;
  if (x.distance * x.distance + z.distance * z.distance < 1.0) {
    wedge = cube * wedge_volume(x.distance, z.distance);
    deposit(x.far, 0, z.far, wedge);
  }
  deposit(x.near, 0, z.near, volume - cap_x - cap_z + wedge);
  deposit(x.far, 0, z.near, cap_x - wedge);
  deposit(x.near, 0, z.far, cap_z - wedge);
  return deposit.inside();
}

template <class Add>
double ExactKernel::among_eight(const Vec3& centre, double radius, Add& add) const {
  const double cube = radius * radius * radius, volume = sphere_volume(radius);
  const auto x = axes_[0].cut(centre[0], 1.0 / radius);
  const auto y = axes_[1].cut(centre[1], 1.0 / radius);
  const auto z = axes_[2].cut(centre[2], 1.0 / radius);
  const double a = x.distance, b = y.distance, c = z.distance;
  const double aa = a * a, bb = b * b, cc = c * c;
  const double cap_x = cube * cap_volume(a), cap_y = cube * cap_volume(b),
               cap_z = cube * cap_volume(c);
  const double xy = aa + bb < 1.0 ? cube * wedge_volume(a, b) : 0.0;
  const double yz = bb + cc < 1.0 ? cube * wedge_volume(b, c) : 0.0;
  const double zx = cc + aa < 1.0 ? cube * wedge_volume(c, a) : 0.0;
  double octant = 0.0;
  if (aa + bb + cc < 1.0)
    octant = std::min({cube * octant_volume(a, b, c, (xy + yz + zx) / cube), xy, yz, zx});

  // A cap less its wedges is at least a quarter of it; less than 0 only where it is all rounding.
  const auto rest = [](double part) { return std::max(part, 0.0); };
  Deposit<Add> deposit(axes_, volume, add);
  deposit(x.near, y.near, z.near, volume - cap_x - cap_y - cap_z + xy + yz + zx - octant);
  deposit(x.far, y.near, z.near, rest(cap_x - xy - zx + octant));
  deposit(x.near, y.far, z.near, rest(cap_y - xy - yz + octant));
  deposit(x.near, y.near, z.far, rest(cap_z - yz - zx + octant));
  if (xy > 0.0) deposit(x.far, y.far, z.near, xy - octant);
  if (yz > 0.0) deposit(x.near, y.far, z.far, yz - octant);
  if (zx > 0.0) deposit(x.far, y.near, z.far, zx - octant);
  if (octant > 0.0) deposit(x.far, y.far, z.far, octant);
  return deposit.inside();
}

// In blocks of up to eight cells along each axis: the stack holds what a block needs.
template <class Add>
double ExactKernel::among_many(const Vec3& centre, double radius, Add& add) const {
  std::array<GridAxis::Range, 3> range{};
  for (int axis = 0; axis < 3; ++axis) range[axis] = axes_[axis].range(centre[axis], radius);
  if (axes_.depth_averaged()) range[depth] = {0, 0};

  // The slabs of a block from cell `first` on; the sphere ends where its range of cells does.
  const auto slabs = [&](int axis, int first) {
    Slabs s;
    s.count = std::min(Slabs::size, range[axis].last - first + 1);
    for (int i = 0; i <= s.count; ++i) {
      const int face = first + i;
      s.at[i] = face <= range[axis].first ? -1.0
                : face > range[axis].last
                    ? 1.0
                    : std::clamp((axes_[axis].face(face) - centre[axis]) / radius, -1.0, 1.0);
    }
    return s;
  };

  const double cube = radius * radius * radius;
  Deposit<Add> deposit(axes_, sphere_volume(radius), add);
  BoxVolumes volumes;
  for (int k0 = range[2].first; k0 <= range[2].last; k0 += Slabs::size)
    for (int j0 = range[1].first; j0 <= range[1].last; j0 += Slabs::size)
      for (int i0 = range[0].first; i0 <= range[0].last; i0 += Slabs::size) {
        const Slabs x = slabs(0, i0), y = slabs(1, j0), z = slabs(2, k0);
        box_volumes(x, y, z, volumes);
        for (int k = 0; k < z.count; ++k)
          for (int j = 0; j < y.count; ++j)
            for (int i = 0; i < x.count; ++i)
              if (const double part = volumes[Slabs::box(i, j, k)]; part > 0.0)
                deposit(axes_[0].cell(i0 + i), axes_[1].cell(j0 + j), axes_[2].cell(k0 + k),
                        cube * part);
      }
  return deposit.inside();
}

template <class Add>
double DividedKernel::share(const Vec3& centre, double radius, Add&& add) const {
  if (!(radius > 0.0) || !axes_.within_depth(centre[depth])) return 0.0;
  std::array<std::array<int, 9>, 3> cells{};  // of the places along each axis
  for (std::size_t p = 0; p < places.size(); ++p) {
    cells[0][p] = axes_[0].cell_of(centre[0] + radius * places[p]);
    cells[1][p] = axes_.depth_averaged() ? 0 : axes_[1].cell_of(centre[1] + radius * places[p]);
    cells[2][p] = axes_[2].cell_of(centre[2] + radius * places_up[p]);
  }

  // The points are ordered so that neighbours in the list often share a cell: one add for a run.
  const double volume = sphere_volume(radius);
  int found = 0, run = 0;
  std::size_t cell = 0;
  const auto flush = [&] {
    if (run > 0) add(cell, run == points ? volume : volume * run / points);
    found += run;
    run = 0;
  };
  for (const Satellite& s : satellites) {
    const int i = cells[0][s.lateral], j = cells[1][s.depth], k = cells[2][s.up];
    if (!GridAxes::inside(i, j, k)) continue;
    const std::size_t here = axes_.index(i, j, k);
    if (here != cell) flush();
    cell = here;
    ++run;
  }
  flush();
  if (found == 0) return 0.0;
  return found == points ? volume : volume * found / points;
}

template <class Add>
double GaussianKernel::share(const Vec3& centre, double radius, Add&& add) const {
  if (!(radius > 0.0) || !axes_.within_depth(centre[depth])) return 0.0;
  for (int axis = 0; axis < 3; ++axis)
    if (axes_[axis].cell_of(centre[axis]) == GridAxis::outside) return 0.0;
  const Vec3 position = axes_.wrap(centre);
  std::array<Weights, 3> w;
  weigh(axes_[0], position[0], w[0]);
  weigh(axes_[2], position[2], w[2]);
  if (axes_.depth_averaged()) {
    w[1].count = 1;
    w[1].cell[0] = 0;
    w[1].value[0] = 1.0;
  } else {
    weigh(axes_[1], position[1], w[1]);
  }

  const double volume = sphere_volume(radius);
  for (int k = 0; k < w[2].count; ++k)
    for (int j = 0; j < w[1].count; ++j) {
      const double row = volume * w[2].value[k] * w[1].value[j];
      const std::size_t first = axes_.index(0, w[1].cell[j], w[2].cell[k]);
      for (int i = 0; i < w[0].count; ++i)
        if (const double part = row * w[0].value[i]; part > 0.0)
          add(first + static_cast<std::size_t>(w[0].cell[i]), part);
    }
  return volume;
}

}  // namespace bedscope::analysis
