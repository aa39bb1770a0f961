// SPDX-License-Identifier: BSD-3-Clause
// Overlaps by formula and volumes that add up, of boxes and of bodies.
#include "analysis/gas_mapping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <numeric>
#include <random>

#include "readers/gas_series.hpp"

namespace bedscope::analysis {
namespace {

using readers::Mesh;
using readers::Point;

constexpr std::array<int, 3> xyz{0, 1, 2};
constexpr double rounding = 1e-12;

/// A rectilinear mesh of the given planes.
Mesh box_mesh(const std::array<std::vector<double>, 3>& planes) {
  Mesh mesh;
  auto& boxes = mesh.boxes.emplace();
  boxes.faces = planes;
  boxes.rectilinear = true;
  std::array<std::int32_t, 3> n{};
  for (std::size_t a = 0; a < 3; ++a) {
    n[a] = static_cast<std::int32_t>(planes[a].size()) - 1;
    mesh.min[a] = planes[a].front();
    mesh.max[a] = planes[a].back();
  }
  for (std::int32_t k = 0; k < n[2]; ++k)
    for (std::int32_t j = 0; j < n[1]; ++j)
      for (std::int32_t i = 0; i < n[0]; ++i) {
        boxes.low.push_back({i, j, k});
        boxes.high.push_back({i + 1, j + 1, k + 1});
        Point centre{};
        double volume = 1;
        for (std::size_t a = 0; a < 3; ++a) {
          const auto at = static_cast<std::size_t>(boxes.low.back()[a]);
          centre[a] = (planes[a][at] + planes[a][at + 1]) / 2;
          volume *= planes[a][at + 1] - planes[a][at];
        }
        mesh.centres.push_back(centre);
        mesh.volumes.push_back(volume);
      }
  return mesh;
}

std::vector<double> even(double from, double to, int cells) {
  std::vector<double> planes;
  for (int i = 0; i <= cells; ++i) planes.push_back(from + (to - from) * i / cells);
  return planes;
}

std::vector<double> uneven(double from, double to, int cells, std::mt19937& random) {
  std::uniform_real_distribution<double> step(0.3, 1.7);
  std::vector<double> planes{0};
  for (int i = 0; i < cells; ++i) planes.push_back(planes.back() + step(random));
  for (auto& plane : planes) plane = from + (to - from) * plane / planes.back();
  return planes;
}

Grid grid_of(Vec3 min, Vec3 max, std::array<int, 3> cells) {
  Grid grid;
  grid.min = min;
  grid.max = max;
  grid.cells = cells;
  return grid;
}

/// Means of a field over the cells of the grid; NaN where no mesh is.
std::vector<double> mapped(const GasMapping& mapping, const Grid& grid,
                           const std::vector<double>& values) {
  std::vector<double> sum(grid.size(), 0);
  for (std::size_t c = 0; c < mapping.cells(); ++c)
    mapping.share(c, [&](std::size_t k, double volume) { sum[k] += volume * values[c]; });
  const auto covered = mapping.covered();
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] = covered[k] > 0 ? sum[k] / covered[k] : NAN;
  return sum;
}

void expect_conserved(const GasMapping& mapping, std::mt19937& random) {
  std::uniform_real_distribution<double> voidage(0.4, 1);
  double volume = 0, gas = 0, inside = 0, gas_inside = 0, outside = 0, gas_outside = 0;
  for (std::size_t c = 0; c < mapping.cells(); ++c) {
    const double eps = voidage(random);
    volume += mapping.volume(c);
    gas += eps * mapping.volume(c);
    mapping.share(c, [&](std::size_t, double part) {
      EXPECT_GT(part, 0);
      inside += part;
      gas_inside += eps * part;
    });
    outside += mapping.volume(c) * (1 - mapping.inside(c));
    gas_outside += eps * mapping.volume(c) * (1 - mapping.inside(c));
  }
  EXPECT_NEAR((inside + outside) / volume, 1, rounding);
  EXPECT_NEAR((gas_inside + gas_outside) / gas, 1, rounding);
  EXPECT_NEAR(mapping.mesh_volume(), volume, rounding * volume);
  EXPECT_NEAR(mapping.outside_volume(), outside, rounding * volume);
  const auto covered = mapping.covered();
  EXPECT_NEAR(std::accumulate(covered.begin(), covered.end(), 0.), inside, rounding * volume);
}

TEST(GasMapping, VolumesAddUpOnGridsFinerCoarserAndOfAnotherExtent) {
  std::mt19937 random(1);
  for (const auto& cells : {std::array{5, 1, 9}, std::array{31, 4, 77}, std::array{1, 1, 1}})
    for (const double offset : {0., -0.0137, 0.0211}) {
      const auto mesh = box_mesh(
          {uneven(0, 0.07, 14, random), uneven(0, 0.006, 2, random), uneven(0, 0.3, 23, random)});
      const auto grid = grid_of({offset, -0.001, 0.05 + offset}, {0.07, 0.005, 0.41}, cells);
      const GasMapping mapping(mesh, grid, xyz);
      expect_conserved(mapping, random);
    }
}

// The box that two boxes share, by its definition.
TEST(GasMapping, PartsAreThoseOfIntersectingBoxesInTurnedAxes) {
  std::mt19937 random(2);
  const std::array<int, 3> axes{1, 2, 0};  // lateral y, depth z, up x
  const auto mesh =
      box_mesh({uneven(-0.1, 0.2, 5, random), uneven(0, 0.1, 4, random), even(0, 0.05, 3)});
  const auto grid = grid_of({0.01, 0.003, -0.2}, {0.12, 0.041, 0.15}, {7, 3, 11});
  const GasMapping mapping(mesh, grid, axes);
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    std::vector<double> parts(grid.size(), 0);
    mapping.share(c, [&](std::size_t k, double volume) { parts[k] += volume; });
    for (int k = 0; k < grid.cells[2]; ++k)
      for (int j = 0; j < grid.cells[1]; ++j)
        for (int i = 0; i < grid.cells[0]; ++i) {
          const std::array<int, 3> cell{i, j, k};
          double volume = 1;
          for (int a = 0; a < 3; ++a) {
            const auto axis = static_cast<std::size_t>(axes[static_cast<std::size_t>(a)]);
            const auto& faces = mesh.boxes->faces[axis];
            const auto low = static_cast<std::size_t>(mesh.boxes->low[c][axis]);
            const int n = cell[static_cast<std::size_t>(a)];
            volume *= std::max(0., std::min(faces[low + 1], grid.face(a, n + 1)) -
                                       std::max(faces[low], grid.face(a, n)));
          }
          EXPECT_NEAR(parts[grid.index(i, j, k)], volume, 1e-12 * mesh.volumes[c]);
        }
  }
}

TEST(GasMapping, ALinearFieldStaysWhatItIsOnACoarserNestedGrid) {
  const auto mesh = box_mesh({even(0, 0.07, 14), even(0, 0.006, 2), even(0, 1.5, 300)});
  const auto grid = grid_of({0, 0, 0}, {0.07, 0.006, 1.5}, {7, 1, 100});
  const GasMapping mapping(mesh, grid, xyz);
  std::vector<double> field;
  for (const auto& centre : mesh.centres) field.push_back(3 - 2 * centre[2] + 5 * centre[0]);
  const auto found = mapped(mapping, grid, field);
  for (int k = 0; k < 100; ++k)
    for (int i = 0; i < 7; ++i)
      EXPECT_NEAR(found[grid.index(i, 0, k)], 3 - 2 * grid.centre(2, k) + 5 * grid.centre(0, i),
                  1e-12);
}

TEST(GasMapping, AFinerGridRepeatsTheCellsOfTheMesh) {
  const auto mesh = box_mesh({even(0, 1, 2), even(0, 1, 1), even(0, 1, 2)});
  const auto grid = grid_of({0, 0, 0}, {1, 1, 1}, {8, 1, 8});
  const auto found = mapped(GasMapping(mesh, grid, xyz), grid, {1, 2, 3, 4});
  for (int k = 0; k < 8; ++k)
    for (int i = 0; i < 8; ++i)
      EXPECT_NEAR(found[grid.index(i, 0, k)], 1 + i / 4 + 2 * (k / 4), 1e-13);
}

TEST(GasMapping, WhereNoMeshIsNothingCountsAndAWallOffByRoundingLeavesNoSliver) {
  const auto mesh = box_mesh({even(0, 0.5 + 1e-9, 4), even(0, 1, 1), even(0, 1, 4)});
  const auto grid = grid_of({0, 0, 0}, {1, 1, 1}, {3, 1, 2});  // the middle cell is half covered
  const GasMapping mapping(mesh, grid, xyz);
  const auto covered = mapping.covered();
  EXPECT_NEAR(covered[0], 1. / 6, 1e-8);
  EXPECT_NEAR(covered[1], 1. / 12, 1e-8);
  EXPECT_EQ(covered[2], 0);
  const auto halves = grid_of({0, 0, 0}, {1, 1, 1}, {2, 1, 2});
  EXPECT_EQ(GasMapping(mesh, halves, xyz).covered()[1], 0);
}

TEST(GasMapping, BoxesOfDifferentSizesOfAMeshRefinedInPlaces) {
  // Two cells below, one twice as wide above.
  Mesh mesh;
  mesh.boxes = readers::BoxCells{{{{0, 1, 2}, {0, 1}, {0, 1, 2}}},
                                 {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}},
                                 {{1, 1, 1}, {2, 1, 1}, {2, 1, 2}},
                                 false};
  mesh.volumes = {1, 1, 2};
  mesh.centres = {{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}, {1, 0.5, 1.5}};
  mesh.max = {2, 1, 2};
  const auto grid = grid_of({0, 0, 0}, {2, 1, 2}, {4, 1, 2});
  const auto found = mapped(GasMapping(mesh, grid, xyz), grid, {10, 20, 30});
  EXPECT_EQ(found, (std::vector<double>{10, 10, 20, 20, 30, 30, 30, 30}));
}

double drop_of(const GasMapping& mapping, const std::vector<double>& pressure) {
  double drop = 0;
  for (const auto& [cell, weight] : mapping.pressure_drop()) drop += weight * pressure[cell];
  return drop;
}

TEST(GasMapping, ThePressureDropOfALinearPressureIsExactFromEndToEnd) {
  std::mt19937 random(3);
  const auto mesh =
      box_mesh({uneven(0, 0.1, 3, random), even(0, 0.1, 1), uneven(0, 1, 12, random)});
  std::vector<double> pressure;
  for (const auto& centre : mesh.centres) pressure.push_back(1e5 - 700 * centre[2]);
  const auto grid = [](double low, double high) {
    return grid_of({0, 0, low}, {0.1, 0.1, high}, {2, 1, 10});
  };
  EXPECT_NEAR(drop_of({mesh, grid(0, 1), xyz}, pressure), 700, 1e-7);
  EXPECT_NEAR(drop_of({mesh, grid(0.2, 0.8), xyz}, pressure), 420, 1e-7);
  EXPECT_NEAR(drop_of({mesh, grid(-1, 3), xyz}, pressure), 700, 1e-7);  // the mesh ends before
  const auto flat = box_mesh({even(0, 0.1, 3), even(0, 0.1, 1), even(0, 1, 1)});
  EXPECT_TRUE(GasMapping(flat, grid(0, 1), xyz).pressure_drop().empty());
}

/// The same cells as bodies, each with faces of its own, sheared along x by z.
Mesh as_bodies(const Mesh& boxes, double shear) {
  readers::PolyMesh poly;
  poly.cells = boxes.cells();
  for (std::size_t c = 0; c < poly.cells; ++c) {
    const auto first = static_cast<std::int32_t>(poly.points.size());
    for (std::size_t corner = 0; corner < 8; ++corner) {
      Point point{};
      for (std::size_t a = 0; a < 3; ++a) {
        const auto plane =
            (corner >> a & 1U) != 0 ? boxes.boxes->high[c][a] : boxes.boxes->low[c][a];
        point[a] = boxes.boxes->faces[a][static_cast<std::size_t>(plane)];
      }
      point[0] += shear * point[2];
      poly.points.push_back(point);
    }
    for (const auto& face : {std::array{0, 2, 3, 1},
                             {4, 5, 7, 6},
                             {0, 1, 5, 4},
                             {2, 6, 7, 3},
                             {0, 4, 6, 2},
                             {1, 3, 7, 5}}) {
      poly.face_starts.push_back(static_cast<std::int32_t>(poly.face_points.size()));
      for (const int corner : face) poly.face_points.push_back(first + corner);
      poly.owner.push_back(static_cast<std::int32_t>(c));
    }
  }
  poly.face_starts.push_back(static_cast<std::int32_t>(poly.face_points.size()));
  const auto cells = readers::cell_geometry(poly);
  Mesh mesh;
  mesh.centres = cells.centres;
  mesh.volumes = cells.volumes;
  std::vector<std::int32_t> order(poly.cells);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t c = 0; c < poly.cells; ++c) {
    auto& extent = mesh.extents.emplace_back();
    for (std::size_t a = 0; a < 3; ++a) extent[a] = cells.high[c][a] - cells.low[c][a];
  }
  mesh.parts.push_back({std::make_shared<const readers::PolyMesh>(std::move(poly)), order});
  return mesh;
}

TEST(GasMapping, ABodyThatIsABoxIsCutAsABox) {
  std::mt19937 random(4);
  const auto mesh = box_mesh({uneven(0, 0.07, 7, random), even(0, 0.006, 2), even(0, 0.3, 19)});
  const auto grid = grid_of({-0.01, 0, 0.01}, {0.05, 0.006, 0.33}, {11, 1, 8});
  for (const auto& axes : {xyz, std::array{2, 1, 0}, {1, 2, 0}}) {
    const GasMapping boxes(mesh, grid, axes), bodies(as_bodies(mesh, 0), grid, axes);
    const auto a = boxes.covered(), b = bodies.covered();
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-12 * grid.cell_volume());
  }
}

// Cells sheared by half their width on a grid that cuts them: the grid is full everywhere, and a
// field that is constant along the shear keeps its first moment.
TEST(GasMapping, ShearedCellsFillTheGrid) {
  std::mt19937 random(5);
  const auto mesh =
      as_bodies(box_mesh({even(0, 0.2, 20), even(0, 0.01, 1), even(0, 0.1, 10)}), 0.5);
  const auto grid = grid_of({0.063, 0, 0.023}, {0.193, 0.01, 0.083}, {13, 1, 6});
  const GasMapping mapping(mesh, grid, xyz);
  expect_conserved(mapping, random);
  const auto covered = mapping.covered();
  for (const double volume : covered) EXPECT_NEAR(volume / grid.cell_volume(), 1, 1e-11);
}

TEST(GasMapping, PartsOfAShearedCellAreThoseOfParallelograms) {
  const auto mesh = as_bodies(box_mesh({even(0, 1, 1), even(0, 1, 1), even(0, 1, 1)}), 1);
  const auto grid = grid_of({0, 0, 0}, {2, 1, 1}, {4, 1, 1});
  const auto covered = GasMapping(mesh, grid, xyz).covered();
  // Between x = z and x = z + 1: the width at x, integrated over half a unit each.
  const std::array expected{0.125, 0.375, 0.375, 0.125};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(covered[k], expected[k], 1e-14);
}

// A hull that is a box, filled with warped or polyhedral cells: each cell of the grid is full.
TEST(GasMapping, WarpedAndPolyhedralCellsFillTheGrid) {
  for (const auto* name : {"of_warped", "of_poly"}) {
    const auto folder = std::filesystem::path(BEDSCOPE_SHARED) / "corpus/made/openfoam" / name;
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no corpus";
    const auto mesh = readers::GasSeries::open(folder.string()).mesh_at(0);
    ASSERT_FALSE(mesh->boxes.has_value());
    const auto grid = grid_of(mesh->min, mesh->max, {3, 7, 13});
    const GasMapping mapping(*mesh, grid, xyz);
    std::mt19937 random(6);
    expect_conserved(mapping, random);
    double squares = 0;
    for (const double volume : mapping.covered())
      squares += std::pow(volume / grid.cell_volume() - 1, 2);
    const double rms = std::sqrt(squares / static_cast<double>(grid.size()));
    RecordProperty(std::string("rms_") + name, std::to_string(rms));
    // Not to rounding: warped faces between cells are cut as OpenFOAM cuts them, while its volumes
    // of the cells beside them are a little different.
    EXPECT_LT(rms, 1e-3) << name;
  }
}

}  // namespace
}  // namespace bedscope::analysis
