// SPDX-License-Identifier: BSD-3-Clause
// Drawn clusters with known answers; random fields against a flood fill.
#include "analysis/clusters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <thread>

namespace bedscope::analysis {
namespace {

constexpr double pi = std::numbers::pi;

Grid grid_of(int columns, int rows, double width_x, double width_z) {
  Grid grid;
  grid.min = {-0.01, 0, 0.3};
  grid.cells = {columns, 1, rows};
  grid.max = {-0.01 + columns * width_x, 0.006, 0.3 + rows * width_z};
  return grid;
}

std::size_t position(int columns, int i, int k) {
  return static_cast<std::size_t>(i) +
         static_cast<std::size_t>(columns) * static_cast<std::size_t>(k);
}

/// A snapshot that is drawn; the solids move at (0.3, -1.2) m/s unless told otherwise.
struct Field {
  Grid grid;
  std::vector<double> holdup, vx, vz;
  ClusterThresholds thresholds;

  explicit Field(const Grid& g) : grid(g) {
    const std::size_t n = position(g.cells[lateral], 0, g.cells[up]);
    holdup.assign(n, 0.05);
    vx.assign(n, 0.3);
    vz.assign(n, -1.2);
    thresholds.min_area = 0;
  }
  std::size_t cell(int i, int k) const { return position(grid.cells[lateral], i, k); }
  double& at(int i, int k) { return holdup[cell(i, k)]; }
  /// `shape(x, z)`: whether the point is inside; a cell is if its centre is.
  void draw(const std::function<bool(double, double)>& shape, double phi = 0.5) {
    for (int k = 0; k < grid.cells[up]; ++k)
      for (int i = 0; i < grid.cells[lateral]; ++i)
        if (shape(grid.centre(lateral, i), grid.centre(up, k))) at(i, k) = phi;
  }
  /// Rows of text from the top down; '#' is 0.5, 'o' is 0.3.
  static Field of(const std::vector<std::string>& rows, double width_x = 1e-3,
                  double width_z = 2e-3) {
    const int n = static_cast<int>(rows.size());
    Field field(grid_of(static_cast<int>(rows[0].size()), n, width_x, width_z));
    for (int k = 0; k < n; ++k)
      for (std::size_t i = 0; i < rows[0].size(); ++i) {
        const char c = rows[static_cast<std::size_t>(n - 1 - k)][i];
        if (c != '.') field.at(static_cast<int>(i), k) = c == '#' ? 0.5 : 0.3;
      }
    return field;
  }
  ClusterImage find() const {
    std::vector<double> flux_x(holdup.size()), flux_z(holdup.size());
    for (std::size_t n = 0; n < holdup.size(); ++n) {
      flux_x[n] = holdup[n] * vx[n];
      flux_z[n] = holdup[n] * vz[n];
    }
    return find_clusters(grid, holdup, holdup, flux_x, flux_z, thresholds);
  }
};

/// Signed area inside a closed polyline (Gauss): positive for anticlockwise.
double area_inside(const std::vector<Point>& line) {
  double twice = 0;
  for (std::size_t n = 1; n < line.size(); ++n)
    twice += (line[n - 1].x - line[0].x) * (line[n].z - line[0].z) -
             (line[n].x - line[0].x) * (line[n - 1].z - line[0].z);
  return twice / 2;
}

double area_inside(const Cluster& cluster) {
  double sum = 0;
  for (const auto& line : cluster.contours) sum += area_inside(line);
  return sum;
}

TEST(Clusters, a_disc_has_the_area_of_its_pixels_and_its_own_centre) {
  Field field(grid_of(60, 60, 1e-3, 1.5e-3));
  const double x = field.grid.face(lateral, 30), z = field.grid.face(up, 30), r = 18e-3;
  int pixels = 0;
  field.draw([&](double a, double b) {
    const bool inside = std::hypot(a - x, b - z) < r;
    pixels += inside;
    return inside;
  });
  const auto image = field.find();
  ASSERT_EQ(image.clusters.size(), 1u);
  const Cluster& disc = image.clusters[0];
  EXPECT_EQ(std::count(image.labels.begin(), image.labels.end(), 1), pixels);
  EXPECT_NEAR(disc.area, pixels * 1.5e-6, 1e-12 * disc.area);  // rounding
  EXPECT_NEAR(disc.area, pi * r * r, 0.02 * disc.area);        // 600 pixels: edge noise below 2 %
  EXPECT_NEAR(disc.centre.x, x, 1e-12);                        // symmetric: rounding
  EXPECT_NEAR(disc.centre.z, z, 1e-12);                        // symmetric: rounding
  EXPECT_NEAR(disc.major, 2 * r, 0.01 * r);                    // edge noise
  EXPECT_NEAR(disc.minor, 2 * r, 0.01 * r);                    // edge noise
  EXPECT_DOUBLE_EQ(disc.holdup, 0.5);
  EXPECT_NEAR(disc.velocity_x, 0.3, 1e-12);   // rounding
  EXPECT_NEAR(disc.velocity_z, -1.2, 1e-12);  // rounding
  EXPECT_EQ(disc.cluster, 1);
  EXPECT_EQ(disc.track, 0);
  EXPECT_TRUE(std::isnan(disc.track_velocity_x) && std::isnan(disc.track_velocity_z));
}

TEST(Clusters, velocity_is_weighted_by_mass_and_holdup_by_area) {
  Field field = Field::of({"....", ".#o.", "...."});
  field.vx[field.cell(1, 1)] = 1;
  field.vx[field.cell(2, 1)] = 9;
  field.vz[field.cell(1, 1)] = -2;
  field.vz[field.cell(2, 1)] = 2;
  const auto image = field.find();
  ASSERT_EQ(image.clusters.size(), 1u);
  EXPECT_DOUBLE_EQ(image.clusters[0].velocity_x, (0.5 * 1 + 0.3 * 9) / 0.8);
  EXPECT_DOUBLE_EQ(image.clusters[0].velocity_z, (0.5 * -2 + 0.3 * 2) / 0.8);
  EXPECT_DOUBLE_EQ(image.clusters[0].holdup, 0.4);
  EXPECT_DOUBLE_EQ(image.clusters[0].holdup_max, 0.5);
}

TEST(Clusters, the_threshold_itself_is_not_above_it) {
  Field field = Field::of({".....", ".###.", "....."});
  field.at(3, 1) = 0.2;
  EXPECT_EQ(field.find().labels[field.cell(3, 1)], 0);
  field.at(3, 1) = std::nextafter(0.2, 1.0);
  EXPECT_EQ(field.find().labels[field.cell(3, 1)], 1);
}

TEST(Clusters, the_core_itself_is_not_above_it) {
  Field field = Field::of({".....", ".ooo.", ".....", "..#..", "....."});
  field.at(2, 3) = 0.4;
  EXPECT_EQ(field.find().clusters.size(), 1u);
  field.at(2, 3) = std::nextafter(0.4, 1.0);
  EXPECT_EQ(field.find().clusters.size(), 2u);
  field.at(2, 3) = field.at(2, 1) = 0.4;  // no core anywhere
  EXPECT_TRUE(field.find().clusters.empty());
}

TEST(Clusters, an_area_of_exactly_the_smallest_counts_and_a_cell_less_does_not) {
  for (int n = 1; n <= 25; ++n) {
    // A domain away from 0 has cells that are 2.5 mm wide only to rounding.
    Grid grid = grid_of(28, 628, 2.5e-3, 2.5e-3);
    grid.min = {0.1 * n, 0, 0.3 * n};
    grid.max = {0.1 * n + 0.07, 0.006, 0.3 * n + 1.57};
    Field field(grid);
    for (int i = 0; i < n; ++i) field.at(i, 300) = 0.5;
    field.thresholds.min_area = n * 6.25e-6;
    EXPECT_EQ(field.find().clusters.size(), 1u) << n;
    field.at(n - 1, 300) = 0.05;
    const auto image = field.find();
    EXPECT_TRUE(image.clusters.empty()) << n;
    EXPECT_EQ(image.labels, std::vector<int>(field.holdup.size(), 0)) << n;
  }
}

TEST(Clusters, sixty_square_millimetres_are_ten_cells_of_the_thesis_grid) {
  Field field(grid_of(28, 628, 0.07 / 28, 1.57 / 628));
  field.thresholds = {};
  for (int i = 0; i < 9; ++i) field.at(i, 5) = field.at(i, 8) = 0.5;
  field.at(9, 8) = 0.5;
  EXPECT_EQ(field.find().clusters.size(), 1u);
}

TEST(Clusters, cells_that_touch_by_a_corner_are_one_cluster_with_one_outline) {
  const auto image = Field::of({"....", ".#..", "..#.", "...."}).find();
  ASSERT_EQ(image.clusters.size(), 1u);
  ASSERT_EQ(image.clusters[0].contours.size(), 1u);
  EXPECT_EQ(image.clusters[0].contours[0].size(), 9u);       // twice four corners, and closed
  EXPECT_NEAR(area_inside(image.clusters[0]), 4e-6, 1e-18);  // rounding
}

TEST(Clusters, a_gap_of_one_cell_parts_two_clusters_numbered_from_the_bottom) {
  const auto field = Field::of({".##.", "....", "#...", "..#.", "..#."});
  const auto image = field.find();
  ASSERT_EQ(image.clusters.size(), 3u);
  EXPECT_EQ(image.labels[field.cell(2, 0)], 1);
  EXPECT_EQ(image.labels[field.cell(0, 2)], 2);
  EXPECT_EQ(image.labels[field.cell(1, 4)], 3);
  for (std::size_t n = 0; n < 3; ++n) EXPECT_EQ(image.clusters[n].cluster, static_cast<int>(n) + 1);
}

TEST(Clusters, of_equal_height_the_one_further_left_comes_first_and_a_ring_before_its_middle) {
  const auto pair = Field::of({"..#.#", "..#..", "#.#..", "..#..", "..#.."});
  const auto two = pair.find();  // columns 0, 2: centres in row 2; column 4: above
  ASSERT_EQ(two.clusters.size(), 3u);
  EXPECT_EQ(two.labels[pair.cell(0, 2)], 1);
  EXPECT_EQ(two.labels[pair.cell(2, 2)], 2);
  const auto ring = Field::of({"#####", "#...#", "#.#.#", "#...#", "#####"});
  const auto image = ring.find();  // one centre: the first cell decides
  ASSERT_EQ(image.clusters.size(), 2u);
  EXPECT_EQ(image.labels[ring.cell(0, 0)], 1);
  EXPECT_EQ(image.clusters[0].centre.z, image.clusters[1].centre.z);
}

TEST(Clusters, at_the_walls_the_outline_is_the_wall) {
  const auto field = Field::of({"##", "##", "##"});
  const auto image = field.find();
  ASSERT_EQ(image.clusters.size(), 1u);
  ASSERT_EQ(image.clusters[0].contours.size(), 1u);
  const auto& line = image.clusters[0].contours[0];
  const Vec3 min = field.grid.min, max = field.grid.max;
  const std::vector<Point> wall{
      {min[0], min[2]}, {max[0], min[2]}, {max[0], max[2]}, {min[0], max[2]}, {min[0], min[2]}};
  ASSERT_EQ(line.size(), wall.size());
  for (std::size_t n = 0; n < wall.size(); ++n) {
    EXPECT_EQ(line[n].x, wall[n].x);
    EXPECT_EQ(line[n].z, wall[n].z);
  }
}

TEST(Clusters, the_outline_of_an_l_has_its_six_corners) {
  const auto field = Field::of({".....", ".#...", ".#...", ".###.", "....."});
  const auto image = field.find();
  ASSERT_EQ(image.clusters.size(), 1u);
  ASSERT_EQ(image.clusters[0].contours.size(), 1u);
  const auto& line = image.clusters[0].contours[0];
  const std::vector<std::pair<int, int>> corners{{1, 1}, {4, 1}, {4, 2}, {2, 2},
                                                 {2, 4}, {1, 4}, {1, 1}};
  ASSERT_EQ(line.size(), corners.size());
  for (std::size_t n = 0; n < corners.size(); ++n) {
    EXPECT_EQ(line[n].x, field.grid.face(lateral, corners[n].first)) << n;
    EXPECT_EQ(line[n].z, field.grid.face(up, corners[n].second)) << n;
  }
}

TEST(Clusters, a_hole_is_a_clockwise_contour_and_not_part_of_the_area) {
  const auto image = Field::of({"######", "#.##.#", "##.###", "######"}).find();
  ASSERT_EQ(image.clusters.size(), 1u);
  const Cluster& cluster = image.clusters[0];
  ASSERT_EQ(cluster.contours.size(), 4u);  // holes that touch by a corner are two
  EXPECT_NEAR(area_inside(cluster.contours[0]), 24 * 2e-6, 1e-17);  // rounding
  for (std::size_t n = 1; n < 4; ++n)
    EXPECT_NEAR(area_inside(cluster.contours[n]), -2e-6, 1e-17);  // rounding
  EXPECT_NEAR(cluster.area, 21 * 2e-6, 1e-17);                    // rounding
}

TEST(Clusters, the_ellipse_of_a_row_of_cells_is_that_of_its_rectangle) {
  for (const int n : {1, 2, 3, 10, 599}) {
    Field row(grid_of(600, 3, 1e-3, 2e-3)), column(grid_of(3, 600, 1e-3, 2e-3));
    for (int i = 0; i < n; ++i) row.at(i, 1) = column.at(1, i) = 0.5;
    const auto lying = row.find(), standing = column.find();
    ASSERT_EQ(lying.clusters.size(), 1u);
    ASSERT_EQ(standing.clusters.size(), 1u);
    // A rectangle a x b has second moments a^2/12 and b^2/12; tolerances are rounding.
    const double length = n * 1e-3, axis = 4 / std::sqrt(12.);
    const Cluster &a = lying.clusters[0], &b = standing.clusters[0];
    EXPECT_NEAR(a.major, axis * std::max(length, 2e-3), 1e-12 * a.major) << n;
    EXPECT_NEAR(a.minor, axis * std::min(length, 2e-3), 1e-12 * a.minor) << n;
    EXPECT_NEAR(b.major, axis * 2 * length, 1e-12 * b.major) << n;
    EXPECT_NEAR(b.minor, axis * 1e-3, 1e-12 * b.minor) << n;
    EXPECT_EQ(a.angle, n == 1 ? pi / 2 : 0) << n;  // n == 2 is a square: no direction, so 0
    EXPECT_EQ(b.angle, pi / 2) << n;
  }
}

TEST(Clusters, squares_and_discs_have_no_direction) {
  Field square(grid_of(40, 628, 0.07 / 28, 1.57 / 628)), disc = square;
  for (int i = 3; i < 10; ++i)
    for (int k = 400; k < 407; ++k) square.at(i, k) = 0.5;
  const double x = disc.grid.centre(lateral, 20), z = disc.grid.centre(up, 600);
  disc.draw([&](double a, double b) { return std::hypot(a - x, b - z) < 0.0201; });
  for (const Field& field : {square, disc}) {
    const auto image = field.find();
    ASSERT_EQ(image.clusters.size(), 1u);
    EXPECT_EQ(image.clusters[0].angle, 0);
    EXPECT_NEAR(image.clusters[0].major, image.clusters[0].minor, 1e-8);  // sqrt of rounding
  }
}

TEST(Clusters, a_diagonal_points_up_to_the_right_or_down) {
  Field rising(grid_of(12, 12, 1e-3, 1e-3)), falling = rising;
  for (int i = 1; i < 11; ++i) rising.at(i, i) = falling.at(i, 11 - i) = 0.5;
  EXPECT_NEAR(rising.find().clusters[0].angle, pi / 4, 1e-12);    // rounding
  EXPECT_NEAR(falling.find().clusters[0].angle, -pi / 4, 1e-12);  // rounding
}

TEST(Clusters, a_drawn_ellipse_is_found_again_and_better_on_a_finer_grid) {
  const double a = 12e-3, b = 5e-3;  // semi-axes
  for (const double angle : {-1.5, -1.0, -0.4, 0.0, 0.3, 0.8, 1.2, pi / 2}) {
    std::vector<double> errors;
    for (const int n : {30, 120, 480}) {
      Field field(grid_of(n, 2 * n, 30e-3 / n, 30e-3 / n / 2));
      // Off the lattice, so that nothing cancels by symmetry.
      const double x = field.grid.min[0] + 15.0371e-3, z = field.grid.min[2] + 14.9713e-3;
      field.draw([&](double u, double w) {
        const double along = (u - x) * std::cos(angle) + (w - z) * std::sin(angle);
        const double across = (w - z) * std::cos(angle) - (u - x) * std::sin(angle);
        return std::hypot(along / a, across / b) < 1;
      });
      const auto image = field.find();
      ASSERT_EQ(image.clusters.size(), 1u);
      const Cluster& ellipse = image.clusters[0];
      const double turn = std::remainder(ellipse.angle - angle, pi);
      errors.push_back(std::max({std::abs(ellipse.major / (2 * a) - 1),
                                 std::abs(ellipse.minor / (2 * b) - 1), std::abs(turn)}));
      EXPECT_GT(ellipse.angle, -pi / 2);
      EXPECT_LE(ellipse.angle, pi / 2);
    }
    EXPECT_LT(errors[0], 0.05) << angle;  // 10 cells across the minor axis
    EXPECT_LT(errors[2], 1e-3) << angle;  // 16 times finer; edge noise falls as width^1.5
  }
}

TEST(Clusters, moments_do_not_cancel_high_up_the_bed) {
  Field low(grid_of(28, 20000, 1e-3, 1e-3)), high = low;
  for (int i = 0; i < 5; ++i)
    for (int k = 0; k <= i; ++k) low.at(2 + i, k) = high.at(2 + i, 19990 + k) = 0.5;
  const Cluster a = low.find().clusters[0], b = high.find().clusters[0];
  EXPECT_EQ(a.major, b.major);
  EXPECT_EQ(a.minor, b.minor);
  EXPECT_EQ(a.angle, b.angle);
}

TEST(Clusters, the_depth_of_a_3d_grid_does_not_matter) {
  Field field = Field::of({"..##", ".##.", "#..."});
  const auto flat = field.find();
  field.grid.cells[depth] = 4;
  const auto deep = field.find();
  EXPECT_EQ(flat.labels, deep.labels);
  ASSERT_EQ(deep.clusters.size(), 1u);
  EXPECT_EQ(flat.clusters[0].area, deep.clusters[0].area);
}

TEST(Clusters, nothing_dense_gives_no_clusters) {
  const auto image = Field(grid_of(28, 600, 1e-3, 1e-3)).find();
  EXPECT_TRUE(image.clusters.empty());
  EXPECT_EQ(image.labels, std::vector<int>(std::size_t{28} * 600, 0));
}

TEST(Clusters, a_core_below_the_threshold_asks_for_nothing_more) {
  Field field = Field::of({".o."});
  field.thresholds.core = 0.1;
  EXPECT_EQ(field.find().clusters.size(), 1u);
}

/// An independent labelling: a flood from each cell in turn; `diagonal` makes it 8-connected.
struct Flood {
  int columns, rows;
  std::vector<int> labels;
  std::vector<std::vector<int>> regions;

  Flood(int c, int r, const std::vector<bool>& member, bool diagonal)
      : columns(c), rows(r), labels(member.size(), 0) {
    for (std::size_t seed = 0; seed < member.size(); ++seed) {
      if (!member[seed] || labels[seed]) continue;
      regions.emplace_back();
      const int number = static_cast<int>(regions.size());
      std::vector<int> stack{static_cast<int>(seed)};
      labels[seed] = number;
      while (!stack.empty()) {
        const int cell = stack.back();
        stack.pop_back();
        regions.back().push_back(cell);
        for (int dk = -1; dk <= 1; ++dk)
          for (int di = -1; di <= 1; ++di) {
            const int i = cell % columns + di, k = cell / columns + dk;
            if (i < 0 || i >= columns || k < 0 || k >= rows) continue;
            if (!diagonal && di != 0 && dk != 0) continue;
            const auto next = position(columns, i, k);
            if (!member[next] || labels[next]) continue;
            labels[next] = number;
            stack.push_back(static_cast<int>(next));
          }
      }
    }
  }
};

/// Holes of a region: 4-connected parts of the rest that do not reach the border of a wider grid.
std::size_t holes(const std::vector<int>& region, int columns, int rows) {
  std::vector<bool> rest(position(columns + 2, 0, rows + 2), true);
  for (const int cell : region)
    rest[position(columns + 2, cell % columns + 1, cell / columns + 1)] = false;
  return Flood(columns + 2, rows + 2, rest, false).regions.size() - 1;
}

void compare_with_flood(const Field& field) {
  const int columns = field.grid.cells[lateral], rows = field.grid.cells[up];
  std::vector<bool> member(field.holdup.size());
  for (std::size_t n = 0; n < member.size(); ++n)
    member[n] = field.holdup[n] > field.thresholds.threshold;
  Flood flood(columns, rows, member, true);
  const double cell_area = field.grid.width(0) * field.grid.width(2);
  std::erase_if(flood.regions, [&](const std::vector<int>& region) {
    return static_cast<double>(region.size()) * cell_area < field.thresholds.min_area ||
           std::none_of(region.begin(), region.end(), [&](int cell) {
             return field.holdup[static_cast<std::size_t>(cell)] > field.thresholds.core;
           });
  });

  const auto image = field.find();
  ASSERT_EQ(image.clusters.size(), flood.regions.size());
  std::vector<int> expected(member.size(), 0);
  for (const auto& region : flood.regions) {
    // Whatever number the region has, all its cells and no others must have it.
    const int number = image.labels[static_cast<std::size_t>(region[0])];
    ASSERT_GE(number, 1);
    const Cluster& cluster = image.clusters[static_cast<std::size_t>(number - 1)];
    double sum = 0, x = 0, z = 0, xx = 0, zz = 0, xz = 0;
    for (const int cell : region) {
      expected[static_cast<std::size_t>(cell)] = number;
      sum += field.holdup[static_cast<std::size_t>(cell)];
      x += field.grid.centre(lateral, cell % columns) / static_cast<double>(region.size());
      z += field.grid.centre(up, cell / columns) / static_cast<double>(region.size());
    }
    for (const int cell : region) {
      const double a = field.grid.centre(lateral, cell % columns) - x;
      const double b = field.grid.centre(up, cell / columns) - z;
      xx += a * a + std::pow(field.grid.width(0), 2) / 12;
      zz += b * b + std::pow(field.grid.width(2), 2) / 12;
      xz += a * b;
    }
    const auto n = static_cast<double>(region.size());
    EXPECT_NEAR(cluster.area, n * cell_area, 1e-12 * cluster.area);  // rounding
    EXPECT_NEAR(cluster.holdup, sum / n, 1e-12);                     // rounding
    EXPECT_NEAR(cluster.centre.x, x, 1e-12);                         // rounding
    EXPECT_NEAR(cluster.centre.z, z, 1e-12);                         // rounding
    EXPECT_EQ(cluster.cluster, number);
    // Trace, determinant and direction give the tensor back, whatever solved for its axes.
    const double p = std::pow(cluster.major / 4, 2), q = std::pow(cluster.minor / 4, 2);
    const double c = std::cos(cluster.angle), s = std::sin(cluster.angle);
    EXPECT_NEAR(p * c * c + q * s * s, xx / n, 1e-11 * p);  // rounding of uncentred coordinates
    EXPECT_NEAR(p * s * s + q * c * c, zz / n, 1e-11 * p);  // the same
    EXPECT_NEAR((p - q) * c * s, xz / n, 1e-11 * p);        // the same
    EXPECT_NEAR(area_inside(cluster), cluster.area, 1e-10 * cluster.area);  // rounding of corners
    EXPECT_EQ(cluster.contours.size(), 1 + holes(region, columns, rows));
    EXPECT_GT(area_inside(cluster.contours[0]), 0);
  }
  EXPECT_EQ(image.labels, expected);
  for (std::size_t n = 1; n < image.clusters.size(); ++n)
    EXPECT_LE(image.clusters[n - 1].centre.z, image.clusters[n].centre.z);
}

TEST(Clusters, random_fields_are_labelled_as_by_a_flood_fill) {
  std::mt19937 random(20160);
  std::uniform_real_distribution<double> uniform(0, 1);
  const std::vector<std::pair<int, int>> shapes{{28, 60}, {1, 40}, {40, 1}, {1, 1}, {17, 23}};
  for (int n = 0; n < 200; ++n) {
    SCOPED_TRACE(n);
    const auto [columns, rows] = shapes[n % 5 < 2 ? 0 : static_cast<std::size_t>(n / 5 % 5)];
    Field field(grid_of(columns, rows, 2.5e-3, 2.3e-3));
    const double share = 0.05 + 0.09 * (n % 11);  // of cells above the threshold
    for (double& phi : field.holdup) phi = 0.2 - share + uniform(random) * 1.0;
    field.thresholds.core = n % 3 == 0 ? 0.2 : 0.4;
    field.thresholds.min_area = (n % 4) * 2 * 2.5e-3 * 2.299e-3;
    compare_with_flood(field);
  }
}

TEST(Clusters, threads_that_search_at_once_find_the_same) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 0.6);
  Field field(grid_of(28, 600, 2.5e-3, 2.5e-3));
  for (double& phi : field.holdup) phi = uniform(random);
  const auto alone = field.find();
  std::vector<ClusterImage> images(4);
  {
    std::vector<std::jthread> threads;
    threads.reserve(images.size());
    for (auto& image : images) threads.emplace_back([&] { image = field.find(); });
  }
  for (const auto& image : images) {
    EXPECT_EQ(image.labels, alone.labels);
    ASSERT_EQ(image.clusters.size(), alone.clusters.size());
    for (std::size_t n = 0; n < alone.clusters.size(); ++n)
      EXPECT_EQ(image.clusters[n].major, alone.clusters[n].major);
  }
}

}  // namespace
}  // namespace bedscope::analysis
