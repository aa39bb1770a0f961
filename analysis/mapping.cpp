// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/mapping.hpp"

#include <limits>
#include <numbers>

#include "readers/error.hpp"

namespace bedscope::analysis {
namespace {
constexpr std::array<const char*, 3> axis_names{"lateral", "depth", "up"};

// How many domain sides a sphere's radius may have. Beyond, its part in a cell is lost in rounding,
// and a periodic axis would be walked along for as long as a broken radius says.
constexpr double most_sides = 100.0;
}  // namespace

GridAxis::GridAxis(const Grid& grid, int axis)
    : min_(grid.min[axis]),
      max_(grid.max[axis]),
      width_(grid.width(axis)),
      per_width_(1.0 / width_),
      cells_(grid.cells[axis]),
      periodic_(grid.periodic[axis]) {
  if (cells_ < 1)
    throw InputError("grid: expected at least one cell along {}, found {}", axis_names[axis],
                     cells_);
  if (!(width_ > 0.0) || !std::isfinite(max_ - min_) || !std::isfinite(per_width_))
    throw InputError("grid: expected cells of a size along {}, found {} between {} and {} m",
                     axis_names[axis], cells_, min_, max_);
  // A periodic axis has images of its cells on either side, as far as the largest sphere reaches.
  const double images = periodic_ ? (most_sides + 1.0) * cells_ : 0.0;
  lowest_ = std::max(-1.0 - images, -1e9);
  highest_ = std::min(cells_ + images, 1e9);
  // A dozen roundings at most, of numbers no larger than these.
  rounding_ = 16.0 * std::numeric_limits<double>::epsilon() *
              (cells_ + (std::abs(min_) + std::abs(max_)) * per_width_);
}

double GridAxis::image(double x) const {
  double offset = std::fmod(x - min_, length());
  if (offset < 0.0) offset += length();
  return std::min(min_ + offset, max_);  // the sum may round beyond max; NaN stays outside
}

ExactKernel::ExactKernel(const Grid& grid) : axes_(grid) {
  narrow_ = 0.5 * std::min(axes_[lateral].width(), axes_[up].width());
  if (!axes_.depth_averaged()) narrow_ = std::min(narrow_, 0.5 * axes_[depth].width());
  largest_ = most_sides * std::min({axes_[0].length(), axes_[1].length(), axes_[2].length()});
}

namespace {
constexpr double inner = 0.623926, outer = 0.917902;  // radii of the two shells of satellites
}
const std::array<double, 9> DividedKernel::places{
    -outer, -inner, -0.5 * outer, -0.5 * inner, 0.0, 0.5 * inner, 0.5 * outer, inner, outer};
const std::array<double, 9> DividedKernel::places_up{-outer,
                                                     -inner,
                                                     -outer / std::numbers::sqrt2,
                                                     -inner / std::numbers::sqrt2,
                                                     0.0,
                                                     inner / std::numbers::sqrt2,
                                                     outer / std::numbers::sqrt2,
                                                     inner,
                                                     outer};

// Octant by octant (outer, inner), the axes' points between the octants they touch, the centre
// last: runs in one cell stay long.
const std::array<DividedKernel::Satellite, DividedKernel::points> DividedKernel::satellites{{
    {2, 2, 2}, {3, 3, 3}, {4, 4, 0}, {4, 4, 1}, {6, 2, 2}, {5, 3, 3}, {4, 0, 4}, {4, 1, 4},
    {2, 6, 2}, {3, 5, 3}, {4, 8, 4}, {4, 7, 4}, {6, 6, 2}, {5, 5, 3}, {8, 4, 4}, {7, 4, 4},
    {6, 6, 6}, {5, 5, 5}, {4, 4, 8}, {4, 4, 7}, {6, 2, 6}, {5, 3, 5}, {2, 6, 6}, {3, 5, 5},
    {2, 2, 6}, {3, 3, 5}, {0, 4, 4}, {1, 4, 4}, {4, 4, 4},
}};

GaussianKernel::GaussianKernel(const Grid& grid, double width) : axes_(grid), width_(width) {
  if (!(width >= 0.0) || !std::isfinite(width) || (width > 0.0 && !std::isfinite(1.0 / width)))
    throw InputError("mapping: expected a width of the gaussian of 0 or more, found {} m", width);
  if (width == 0.0) {
    width_ = std::max(axes_[lateral].width(), axes_[up].width());
    if (!axes_.depth_averaged()) width_ = std::max(width_, axes_[depth].width());
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == depth && axes_.depth_averaged()) continue;
    const double met = 2.0 * cut_off * width_ / axes_[axis].width() + 2.0;
    if (met > most_cells && (axes_[axis].periodic() || axes_[axis].cells() > most_cells))
      throw InputError(
          "mapping: expected a gaussian that meets at most {} cells along {}, found a width of {} "
          "m on cells of {} m",
          most_cells, axis_names[axis], width_, axes_[axis].width());
  }
}

void GaussianKernel::weigh(const GridAxis& axis, double x, Weights& weights) const {
  auto range = axis.range(x, cut_off * width_);
  // The centre's own cell in any case: w may be less than the rounding of x.
  range.first = std::min(range.first, axis.cell_of(x));
  range.last = std::max(range.last, axis.cell_of(x));
  if (!axis.periodic()) {
    range.first = std::clamp(range.first, 0, axis.cells() - 1);
    range.last = std::clamp(range.last, 0, axis.cells() - 1);
  }
  const double scale = 1.0 / (std::numbers::sqrt2 * width_);
  const double end = cut_off / std::numbers::sqrt2;
  const auto below = [&](int face) {  // the weight below a face, less a half, doubled
    return std::erf(std::clamp((axis.face(face) - x) * scale, -end, end));
  };

  double lower = below(range.first), sum = 0.0;
  weights.count = range.last - range.first + 1;
  for (int i = 0; i < weights.count; ++i) {
    const double upper = below(range.first + i + 1);
    weights.cell[i] = axis.cell(range.first + i);
    weights.value[i] = std::max(upper - lower, 0.0);
    sum += weights.value[i];
    lower = upper;
  }
  for (int i = 0; i < weights.count; ++i) weights.value[i] /= sum;
}

Kernel make_kernel(std::string_view name, const Grid& grid, const KernelOptions& options) {
  if (name == "centre") return CentreKernel(grid);
  if (name == "exact") return ExactKernel(grid);
  if (name == "divided") return DividedKernel(grid);
  if (name == "gaussian") return GaussianKernel(grid, options.gaussian_width);
  throw InputError("mapping: expected centre, exact, divided or gaussian, found '{}'", name);
}

}  // namespace bedscope::analysis
