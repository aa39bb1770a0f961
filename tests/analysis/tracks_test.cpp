// SPDX-License-Identifier: BSD-3-Clause
// Clusters that move, merge, split, come and go on command.
#include "analysis/tracks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace bedscope::analysis {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double width = 1e-3;

Grid grid_of(int columns, int rows) {
  Grid grid;
  grid.cells = {columns, 1, rows};
  grid.max = {columns * width, 0.006, rows * width};
  return grid;
}

/// A rectangle of cells [i, i + columns) x [k, k + rows), or a disc; velocity in m/s.
struct Shape {
  double i, k, columns, rows;
  double vx = 0, vz = 0;
  bool disc = false;
};

ClusterImage snapshot(const Grid& grid, const std::vector<Shape>& shapes) {
  const auto columns = static_cast<std::size_t>(grid.cells[lateral]);
  const std::size_t n = columns * static_cast<std::size_t>(grid.cells[up]);
  std::vector<double> holdup(n, 0.0), vx(n, 0.0), vz(n, 0.0);
  for (std::size_t cell = 0; cell < n; ++cell) {
    const std::size_t column = cell % columns, row = cell / columns;
    const double i = static_cast<double>(column) + 0.5, k = static_cast<double>(row) + 0.5;
    for (const Shape& shape : shapes) {
      const double a = (i - shape.i) / shape.columns, b = (k - shape.k) / shape.rows;
      const bool inside =
          shape.disc ? std::hypot(a - 0.5, b - 0.5) < 0.5 : a >= 0 && a < 1 && b >= 0 && b < 1;
      if (!inside) continue;
      holdup[cell] = 0.5;
      vx[cell] = 0.5 * shape.vx;
      vz[cell] = 0.5 * shape.vz;
    }
  }
  return find_clusters(grid, holdup, holdup, vx, vz, {0.2, 0.4, 0});
}

/// Feeds drawn snapshots to one tracker.
struct Film {
  Grid grid;
  Tracker tracker;
  explicit Film(const Grid& g) : grid(g), tracker(g) {}
  std::vector<Cluster> show(double time, const std::vector<Shape>& shapes) {
    auto image = snapshot(grid, shapes);
    tracker.link(image, time);
    return image.clusters;
  }
};

std::vector<int> tracks(const std::vector<Cluster>& clusters) {
  std::vector<int> numbers;
  numbers.reserve(clusters.size());
  for (const Cluster& cluster : clusters) numbers.push_back(cluster.track);
  return numbers;
}

using Numbers = std::vector<int>;

TEST(Tracks, a_disc_that_moves_more_than_its_diameter_a_snapshot_stays_one_track) {
  Film film(grid_of(80, 1100));
  const double dt = 0.01, vx = 0.03, vz = 2.037;  // 0.3 and 20.37 cells a snapshot
  for (int n = 0; n < 50; ++n) {
    const auto clusters = film.show(
        n * dt, {{5 + n * vx * dt / width, 7 + n * vz * dt / width, 16, 16, vx, vz, true}});
    ASSERT_EQ(clusters.size(), 1u);
    EXPECT_EQ(clusters[0].track, 1);
    EXPECT_TRUE(clusters[0].parents.empty());
    if (n == 0) {
      EXPECT_TRUE(std::isnan(clusters[0].track_velocity_z));
      continue;
    }
    EXPECT_NEAR(clusters[0].track_velocity_z, vz, 0.02 * vz);  // centroid of pixels: 0.2 cells
    EXPECT_NEAR(clusters[0].track_velocity_x, vx, 0.02 * vz);  // the same length
  }
}

TEST(Tracks, velocity_of_a_track_over_whole_cells_is_exact) {
  Film film(grid_of(30, 60));
  film.show(1.0, {{10, 10, 4, 6, -0.2, 0.7}});
  const auto clusters = film.show(1.01, {{8, 17, 4, 6, 0, 0}});
  ASSERT_EQ(tracks(clusters), Numbers{1});
  EXPECT_NEAR(clusters[0].track_velocity_x, -0.2, 1e-12);  // rounding
  EXPECT_NEAR(clusters[0].track_velocity_z, 0.7, 1e-12);   // rounding
}

TEST(Tracks, two_that_merge_keep_the_larger_ones_track_and_name_the_other) {
  Film film(grid_of(30, 60));
  EXPECT_EQ(tracks(film.show(0.00, {{5, 10, 6, 6}, {5, 30, 6, 12}})), (Numbers{1, 2}));
  const auto merged = film.show(0.01, {{5, 10, 6, 32}});
  ASSERT_EQ(tracks(merged), Numbers{2});
  EXPECT_EQ(merged[0].parents, Numbers{1});
  EXPECT_TRUE(std::isnan(merged[0].track_velocity_z));  // the centroid jumped with the new area
  const auto after = film.show(0.02, {{5, 12, 6, 32}});
  ASSERT_EQ(tracks(after), Numbers{2});
  EXPECT_TRUE(after[0].parents.empty());
  EXPECT_NEAR(after[0].track_velocity_z, 0.2, 1e-12);  // rounding
}

TEST(Tracks, a_small_cluster_that_is_swallowed_is_a_parent) {
  Film film(grid_of(60, 60));
  film.show(0, {{5, 5, 2, 2}, {10, 5, 40, 40}});
  const auto clusters = film.show(0.01, {{5, 5, 45, 40}});
  ASSERT_EQ(tracks(clusters), Numbers{2});
  EXPECT_EQ(clusters[0].parents, Numbers{1});
}

TEST(Tracks, of_a_split_the_larger_piece_keeps_the_track_and_the_other_names_its_parent) {
  Film film(grid_of(30, 60));
  film.show(0.00, {{5, 10, 6, 30}});
  const auto split = film.show(0.01, {{5, 10, 6, 10}, {5, 22, 6, 18}});
  ASSERT_EQ(tracks(split), (Numbers{2, 1}));
  EXPECT_EQ(split[0].parents, Numbers{1});
  EXPECT_TRUE(split[1].parents.empty());
  EXPECT_TRUE(std::isnan(split[0].track_velocity_z));
  EXPECT_TRUE(std::isnan(split[1].track_velocity_z));  // the centroid jumped with the lost area
  const auto after = film.show(0.02, {{5, 9, 6, 10}, {5, 23, 6, 18}});
  ASSERT_EQ(tracks(after), (Numbers{2, 1}));
  EXPECT_NEAR(after[0].track_velocity_z, -0.1, 1e-12);  // rounding
  EXPECT_NEAR(after[1].track_velocity_z, 0.1, 1e-12);   // rounding
}

TEST(Tracks, of_equal_pieces_the_lower_number_keeps_the_track) {
  Film film(grid_of(30, 60));
  film.show(0.00, {{5, 10, 6, 31}});
  EXPECT_EQ(tracks(film.show(0.01, {{5, 10, 6, 15}, {5, 26, 6, 15}})), (Numbers{1, 2}));
}

TEST(Tracks, three_that_merge_have_parents_in_ascending_order) {
  Film film(grid_of(40, 60));
  film.show(0, {{5, 5, 5, 5}, {5, 20, 5, 5}, {5, 40, 5, 9}});
  const auto clusters = film.show(0.01, {{5, 5, 5, 44}});
  ASSERT_EQ(tracks(clusters), Numbers{3});
  EXPECT_EQ(clusters[0].parents, (Numbers{1, 2}));
}

TEST(Tracks, a_piece_that_changes_over_names_the_track_it_left) {
  // The upper third of the lower bar joins the upper one: both go on, one has a parent.
  Film film(grid_of(30, 60));
  film.show(0, {{5, 5, 6, 18}, {5, 25, 6, 25}});
  const auto clusters = film.show(0.01, {{5, 5, 6, 9}, {5, 15, 6, 35}});
  ASSERT_EQ(tracks(clusters), (Numbers{1, 2}));
  EXPECT_TRUE(clusters[0].parents.empty());
  EXPECT_EQ(clusters[1].parents, Numbers{1});
  EXPECT_TRUE(std::isnan(clusters[0].track_velocity_z));
}

TEST(Tracks, a_piece_whose_largest_contributor_went_on_elsewhere_is_new) {
  Film film(grid_of(60, 30));
  // The bar 1 (x 5..35) breaks at 25; its smaller piece takes in cluster 2 (x 37..42).
  film.show(0, {{5, 5, 30, 4}, {37, 5, 5, 4}});
  const auto clusters = film.show(0.01, {{5, 5, 19, 4}, {25, 5, 17, 4}});
  ASSERT_EQ(tracks(clusters), (Numbers{1, 3}));
  EXPECT_EQ(clusters[1].parents, (Numbers{1, 2}));
}

TEST(Tracks, births_have_no_parents_and_a_track_that_died_does_not_return) {
  Film film(grid_of(30, 60));
  film.show(0.00, {{5, 5, 5, 5}});
  EXPECT_EQ(tracks(film.show(0.01, {{5, 5, 5, 5}, {20, 40, 5, 5}})), (Numbers{1, 2}));
  EXPECT_EQ(tracks(film.show(0.02, {{20, 40, 5, 5}})), Numbers{2});
  const auto clusters = film.show(0.03, {{5, 5, 5, 5}, {20, 40, 5, 5}});
  EXPECT_EQ(tracks(clusters), (Numbers{3, 2}));
  EXPECT_TRUE(clusters[0].parents.empty());
  EXPECT_TRUE(film.show(0.04, {}).empty());
  EXPECT_EQ(tracks(film.show(0.05, {{20, 40, 5, 5}})), Numbers{4});
}

TEST(Tracks, a_quarter_of_the_smaller_one_links_and_less_does_not) {
  for (const bool enough : {true, false}) {
    Film film(grid_of(60, 60));
    film.show(0, {{5, 5, 20, 8}});
    const auto clusters =
        film.show(0.01, {{5.0, enough ? 11.0 : 12.0, 20, 8}});  // 2 or 1 of 8 rows
    EXPECT_EQ(tracks(clusters), Numbers{enough ? 1 : 2});
  }
}

TEST(Tracks, a_moved_cell_is_cut_at_the_faces) {
  // Moved by half a cell each way, a single cell lies on four: a quarter on each just links.
  Film film(grid_of(10, 10));
  film.show(0, {{4, 4, 1, 1, 0.05, 0.05}});
  EXPECT_EQ(tracks(film.show(0.01, {{5, 5, 1, 1}})), Numbers{1});
  Film off(grid_of(10, 10));
  off.show(0, {{4, 4, 1, 1, 0.05, 0.049}});
  EXPECT_EQ(tracks(off.show(0.01, {{5, 5, 1, 1}})), Numbers{2});
  Film back(grid_of(10, 10));
  back.show(0, {{4, 4, 1, 1, -0.05, -0.05}});
  EXPECT_EQ(tracks(back.show(0.01, {{3, 3, 1, 1}})), Numbers{1});
}

TEST(Tracks, what_leaves_the_grid_links_to_nothing) {
  for (const double speed : {1.0, -1.0, 1e9, -1e9, 1e300}) {
    Film film(grid_of(30, 60));
    film.show(0, {{5, 5, 6, 6, speed, 0}, {20, 40, 6, 6, 0, speed}});
    EXPECT_EQ(tracks(film.show(0.05, {{5, 5, 6, 6}, {20, 40, 6, 6}})), (Numbers{3, 4})) << speed;
  }
}

TEST(Tracks, without_times_links_are_by_plain_overlap_and_velocity_is_unknown) {
  for (const double later : {nan, 1.0, 0.5}) {  // unknown, equal, backwards
    Film film(grid_of(30, 60));
    film.show(1.0, {{5, 5, 6, 6, 0, 5}});
    const auto clusters = film.show(later, {{5, 7, 6, 6}});
    ASSERT_EQ(tracks(clusters), Numbers{1});
    EXPECT_TRUE(std::isnan(clusters[0].track_velocity_x));
    EXPECT_TRUE(std::isnan(clusters[0].track_velocity_z));
  }
}

TEST(Tracks, a_gap_in_time_ends_all_tracks_and_two_lost_snapshots_do_not) {
  const std::vector<Shape> still{{5, 5, 6, 6}};
  Film film(grid_of(30, 60));
  EXPECT_EQ(tracks(film.show(0.00, still)), Numbers{1});
  EXPECT_EQ(tracks(film.show(0.01, still)), Numbers{1});
  EXPECT_EQ(tracks(film.show(0.04, still)), Numbers{1});   // three times the step
  EXPECT_EQ(tracks(film.show(0.041, still)), Numbers{1});  // an extra snapshot
  EXPECT_EQ(tracks(film.show(0.051, still)), Numbers{1});  // does not make the next one a gap
  const auto after = film.show(0.20, still);
  EXPECT_EQ(tracks(after), Numbers{2});
  EXPECT_TRUE(after[0].parents.empty());
  EXPECT_EQ(tracks(film.show(0.35, still)),
            Numbers{2});  // the longer step has become the usual one
}

TEST(Tracks, linking_again_from_the_start_gives_the_same) {
  const auto run = [] {
    Film film(grid_of(40, 120));
    Numbers all;
    for (int n = 0; n < 20; ++n)
      for (const Cluster& cluster : film.show(0.01 * n, {{5, 5. + n, 9, 9, 0, 0.1, true},
                                                         {20, 80. - 2 * n, 9, 9, 0, -0.2, true},
                                                         {8, 60. - n, 18, 9, 0, -0.1, true}})) {
        all.push_back(cluster.track);
        all.insert(all.end(), cluster.parents.begin(), cluster.parents.end());
      }
    return all;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace bedscope::analysis
