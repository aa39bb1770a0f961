// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/clusters.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <tuple>

namespace bedscope::analysis {
namespace {

/// Sums over the cells of one region. Cells are counted from the region's first one: the integer
/// sums are exact and the central moments do not cancel, however far up the bed the region is.
struct Region {
  int first_i = 0, first_k = 0;
  int left = 0, right = 0, top = 0;  ///< outermost columns, highest row
  std::int64_t cells = 0, i = 0, k = 0, ii = 0, ik = 0, kk = 0;
  double holdup = 0, holdup_max = 0, mass = 0, mass_vx = 0, mass_vz = 0;

  void add(int column, int row) {
    if (cells++ == 0) {
      first_i = left = right = column;
      first_k = row;
    }
    left = std::min(left, column);
    right = std::max(right, column);
    top = std::max(top, row);
    const std::int64_t a = column - first_i, b = row - first_k;
    i += a;
    k += b;
    ii += a * a;
    ik += a * b;
    kk += b * b;
  }
  // Quotients of exact integers: equal centres are equal to the bit, so that ties are ties.
  double mean_i() const {
    return static_cast<double>(first_i * cells + i) / static_cast<double>(cells);
  }
  double mean_k() const {
    return static_cast<double>(first_k * cells + k) / static_cast<double>(cells);
  }
};

/// Labels the 8-connected cells above the threshold from 1; returns the number of labels with 0.
int label_regions(const Grid& grid, std::span<const double> holdup, double threshold,
                  std::vector<int>& labels) {
  // We run one snapshot a thread; threads of OpenCV's own would only get in the way.
  [[maybe_unused]] static const bool serial = (cv::setNumThreads(0), true);
  std::vector<std::uint8_t> above(holdup.size());
  std::transform(holdup.begin(), holdup.end(), above.begin(),
                 [threshold](double phi) { return phi > threshold ? 255 : 0; });
  const cv::Mat image(grid.cells[up], grid.cells[lateral], CV_8U, above.data());
  cv::Mat numbers(grid.cells[up], grid.cells[lateral], CV_32S, labels.data());
  const int count = cv::connectedComponents(image, numbers, 8, CV_32S);
  assert(numbers.data == reinterpret_cast<unsigned char*>(labels.data()));
  return count;
}

/// Full axes and angle of the ellipse that has the region's second moments.
void set_ellipse(const Region& region, double width_x, double width_z, Cluster& cluster) {
  const auto n = static_cast<double>(region.cells);
  const auto covariance = [n](std::int64_t ab, std::int64_t a, std::int64_t b) {
    return (n * static_cast<double>(ab) - static_cast<double>(a) * static_cast<double>(b)) /
           (n * n);
  };
  const double xx = (covariance(region.ii, region.i, region.i) + 1. / 12) * width_x * width_x;
  const double zz = (covariance(region.kk, region.k, region.k) + 1. / 12) * width_z * width_z;
  const double xz = covariance(region.ik, region.i, region.k) * width_x * width_z;
  const double larger = (xx + zz) / 2 + std::hypot((xx - zz) / 2, xz);
  const double smaller = (xx * zz - xz * xz) / larger;  // not mean - hypot: exact for rows of cells
  cluster.major = 4 * std::sqrt(larger);
  cluster.minor = 4 * std::sqrt(smaller);

  // Two axes of one length have no direction; without the tolerance rounding would give them one.
  const double rounding = 1e-12 * larger;
  const bool round = std::abs(xx - zz) <= rounding && std::abs(xz) <= rounding;
  const double angle = round ? 0 : std::atan2(2 * xz, xx - zz) / 2;
  cluster.angle = angle <= -std::numbers::pi / 2 ? std::numbers::pi / 2 : angle;
}

Cluster measure(const Grid& grid, const Region& region) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const double width_x = grid.width(lateral), width_z = grid.width(up);
  Cluster cluster;
  cluster.centre = {grid.min[lateral] + (region.mean_i() + 0.5) * width_x,
                    grid.min[up] + (region.mean_k() + 0.5) * width_z};
  cluster.area = static_cast<double>(region.cells) * (width_x * width_z);
  cluster.holdup = region.holdup / static_cast<double>(region.cells);
  cluster.holdup_max = region.holdup_max;
  cluster.velocity_x = region.mass_vx / region.mass;
  cluster.velocity_z = region.mass_vz / region.mass;
  cluster.track_velocity_x = cluster.track_velocity_z = nan;
  cluster.at_wall =
      region.left == 0 || region.right + 1 == grid.cells[lateral] || region.first_k == 0;
  set_ellipse(region, width_x, width_z, cluster);
  return cluster;
}

/// The closed outline that begins with the bottom face of cell (i, k), the cluster on its left.
/// Marks the bottom faces that it runs along. OpenCV's findContours goes through cell centres and
/// would lose half a cell all round.
std::vector<Point> trace(const Grid& grid, const std::vector<int>& labels, int i, int k,
                         std::vector<std::uint8_t>& traced) {
  const int columns = grid.cells[lateral], rows = grid.cells[up];
  const auto cell = [columns](int a, int b) {
    return static_cast<std::size_t>(a) +
           static_cast<std::size_t>(columns) * static_cast<std::size_t>(b);
  };
  const int number = labels[cell(i, k)];
  // Headings 0 to 3: right, up, left, down. The cell ahead on the left of node (i, k); the one
  // ahead on the right is ahead on the left of the heading before.
  constexpr std::array step_i{1, 0, -1, 0}, step_k{0, 1, 0, -1};
  constexpr std::array left_i{0, -1, -1, 0}, left_k{0, 0, -1, -1};
  const auto inside = [&](std::size_t heading) {
    const int a = i + left_i[heading], b = k + left_k[heading];
    return a >= 0 && a < columns && b >= 0 && b < rows && labels[cell(a, b)] == number;
  };

  const int first_i = i, first_k = k;
  std::size_t heading = 0;
  std::vector<Point> outline;
  do {
    outline.push_back({grid.face(lateral, i), grid.face(up, k)});
    bool left = false, right = false;
    do {
      if (heading == 0) traced[cell(i, k)] = 1;
      i += step_i[heading];
      k += step_k[heading];
      left = inside(heading);
      right = inside((heading + 3) % 4);
    } while (left && !right);
    // The right one first: cells that touch by a corner belong together.
    heading = (heading + (right ? 3 : 1)) % 4;
  } while (i != first_i || k != first_k || heading != 0);
  outline.push_back(outline.front());
  return outline;
}

/// The labels of the regions that are clusters, from the bottom upwards; wanted(region) has a say.
template <class Wanted>
std::vector<std::size_t> select_clusters(const Grid& grid, const std::vector<Region>& regions,
                                         const ClusterThresholds& thresholds, Wanted&& wanted) {
  const double cell_area = grid.width(lateral) * grid.width(up);
  std::vector<std::size_t> kept;
  for (std::size_t label = 1; label < regions.size(); ++label)
    if (regions[label].holdup_max > thresholds.core &&
        static_cast<double>(regions[label].cells) * cell_area >= thresholds.min_area * (1 - 1e-9) &&
        wanted(regions[label]))
      kept.push_back(label);
  std::sort(kept.begin(), kept.end(), [&regions](std::size_t a, std::size_t b) {
    const auto order = [](const Region& region) {
      return std::tuple(region.mean_k(), region.mean_i(), region.first_k, region.first_i);
    };
    return order(regions[a]) < order(regions[b]);
  });
  return kept;
}

/// Every outline has the bottom face of a cell, and the cluster's first cell has one of the outer.
void add_contours(const Grid& grid, const std::vector<std::size_t>& dense, ClusterImage& image) {
  const auto columns = static_cast<std::size_t>(grid.cells[lateral]);
  std::vector<std::uint8_t> traced(image.labels.size(), 0);
  for (const std::size_t cell : dense) {
    const int number = image.labels[cell];
    const bool face = cell < columns || image.labels[cell - columns] != number;
    if (number == 0 || !face || traced[cell]) continue;
    image.clusters[static_cast<std::size_t>(number - 1)].contours.push_back(
        trace(grid, image.labels, static_cast<int>(cell % columns),
              static_cast<int>(cell / columns), traced));
  }
}

/// Clusters of any field: add(region, cell) may sum up what else is wanted of their cells.
template <class Wanted, class Add>
ClusterImage find_regions(const Grid& grid, std::span<const double> field,
                          const ClusterThresholds& thresholds, Wanted&& wanted, Add&& add) {
  const auto columns = static_cast<std::size_t>(grid.cells[lateral]);
  assert(field.size() == columns * static_cast<std::size_t>(grid.cells[up]));
  ClusterImage image;
  image.labels.assign(field.size(), 0);
  const double peak = std::max(thresholds.core, thresholds.threshold);
  if (std::none_of(field.begin(), field.end(), [peak](double value) { return value > peak; }))
    return image;

  const int count = label_regions(grid, field, thresholds.threshold, image.labels);
  std::vector<Region> regions(static_cast<std::size_t>(count));
  std::vector<std::size_t> dense;  // the labelled cells: few, so that later passes are short
  for (std::size_t cell = 0; cell < field.size(); ++cell) {
    if (image.labels[cell] == 0) continue;
    dense.push_back(cell);
    Region& region = regions[static_cast<std::size_t>(image.labels[cell])];
    region.add(static_cast<int>(cell % columns), static_cast<int>(cell / columns));
    region.holdup += field[cell];
    region.holdup_max = std::max(region.holdup_max, field[cell]);
    add(region, cell);
  }

  const auto kept = select_clusters(grid, regions, thresholds, wanted);
  std::vector<int> numbers(regions.size(), 0);
  for (const std::size_t label : kept) {
    image.clusters.push_back(measure(grid, regions[label]));
    numbers[label] = image.clusters.back().cluster = static_cast<int>(image.clusters.size());
  }
  for (const std::size_t cell : dense)
    image.labels[cell] = numbers[static_cast<std::size_t>(image.labels[cell])];
  add_contours(grid, dense, image);
  return image;
}

}  // namespace

ClusterImage find_clusters(const Grid& grid, std::span<const double> holdup,
                           std::span<const double> mass, std::span<const double> mass_vx,
                           std::span<const double> mass_vz, const ClusterThresholds& thresholds) {
  assert(mass.size() == holdup.size() && mass_vx.size() == holdup.size() &&
         mass_vz.size() == holdup.size());
  return find_regions(
      grid, holdup, thresholds, [](const Region&) { return true; },
      [&](Region& region, std::size_t cell) {
        region.mass += mass[cell];
        region.mass_vx += mass_vx[cell];
        region.mass_vz += mass_vz[cell];
      });
}

ClusterImage find_bubbles(const Grid& grid, std::span<const double> voidage, double surface,
                          const ClusterThresholds& thresholds) {
  const auto below_surface = [&](const Region& region) {
    return region.top + 1 < grid.cells[up] && (region.mean_k() + 0.5) * grid.width(up) < surface;
  };
  return find_regions(grid, voidage, thresholds, below_surface, [](Region&, std::size_t) {});
}

}  // namespace bedscope::analysis
