// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/mapping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "readers/error.hpp"

namespace bedscope::analysis {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::array<const char*, 4> names{"centre", "exact", "divided", "gaussian"};

struct Shared {
  std::vector<double> parts;  // of the cells
  double inside;
};

Shared share(const Kernel& kernel, const Grid& grid, const Vec3& centre, double radius) {
  Shared s{std::vector<double>(grid.size()), 0.0};
  s.inside = std::visit(
      [&](const auto& k) {
        return k.share(centre, radius, [&](std::size_t cell, double part) {
          EXPECT_GE(part, 0.0);
          s.parts.at(cell) += part;
        });
      },
      kernel);
  return s;
}

double sum(const std::vector<double>& parts) {
  double total = 0.0;
  for (const double part : parts) total += part;
  return total;
}

int only_cell(const Kernel& kernel, const Grid& grid, const Vec3& centre, double radius) {
  const Shared s = share(kernel, grid, centre, radius);
  const auto found = std::find_if(s.parts.begin(), s.parts.end(), [](double p) { return p > 0; });
  return found == s.parts.end() ? -1 : static_cast<int>(found - s.parts.begin());
}

const Grid averaged{{-0.4, 0.0, 0.3}, {0.6, 0.2, 1.2}, {5, 1, 4}, {}};
const Grid cubes{{-0.4, 0.1, 0.3}, {0.6, 0.7, 1.2}, {5, 3, 4}, {}};

Grid periodic(Grid grid, std::array<bool, 3> axes) {
  grid.periodic = axes;
  return grid;
}

std::vector<Grid> grids() {
  std::vector<Grid> all;
  for (const Grid& grid : {averaged, cubes, Grid{{0, 0, 0}, {1, 1, 1}, {1, 1, 1}, {}},
                           Grid{{1, 2, 3}, {2, 3, 4}, {1, 2, 3}, {}}})
    for (int bits = 0; bits < 8; ++bits)
      all.push_back(periodic(grid, {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0}));
  return all;
}

// ---- all kernels ----

TEST(Kernels, PutNoVolumeTwiceAndLoseNone) {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const Grid& grid : grids())
    for (const char* name : names) {
      const Kernel kernel = make_kernel(name, grid);
      for (int trial = 0; trial < 60; ++trial) {
        // A hundredth of a cell to ten cells; every third centre on a face, a wall or a corner.
        const double radius = grid.width(lateral) * 0.01 * std::pow(1000.0, unit(random));
        Vec3 centre;
        bool whole = true;  // wholly inside, by the walls that count
        for (int axis = 0; axis < 3; ++axis) {
          centre[axis] = grid.min[axis] + grid.length(axis) * (1.2 * unit(random) - 0.1);
          if (trial % 3 == 0)
            centre[axis] = grid.face(axis, static_cast<int>(unit(random) * (grid.cells[axis] + 1)));
          const bool cuts = axis != depth || !grid.depth_averaged();
          const double reach = cuts ? radius : 0.0;
          if (!grid.periodic[axis])
            whole &=
                centre[axis] - reach >= grid.min[axis] && centre[axis] + reach <= grid.max[axis];
        }
        const double volume = sphere_volume(radius);
        const Shared s = share(kernel, grid, centre, radius);
        // 1e-12: rounding of sums over at most some thousand cells
        EXPECT_NEAR(sum(s.parts), s.inside, 1e-12 * volume) << name;
        EXPECT_LE(s.inside, volume * (1 + 1e-12)) << name;
        EXPECT_GE(s.inside, 0.0) << name;
        if (whole) {
          EXPECT_NEAR(s.inside, volume, 1e-12 * volume) << name << ' ' << radius;
        }
        // The same, but for the periodic axes, whose centre is anywhere.
        Vec3 image = centre;
        for (int axis = 0; axis < 3; ++axis)
          if (grid.periodic[axis]) image[axis] += 3 * grid.length(axis);
        const Shared shifted = share(kernel, grid, image, radius);
        // A point within rounding of a face may change sides: compare only away from faces.
        if (trial % 3 != 0) {
          EXPECT_NEAR(shifted.inside, s.inside, 1e-11 * volume) << name;
        }
      }
    }
}

TEST(Kernels, LeaveNothingOutsideForAParticleWhollyInside) {
  std::mt19937_64 random(22);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const Grid& grid : {averaged, cubes, periodic(cubes, {true, true, true})})
    for (const char* name : names) {
      const Kernel kernel = make_kernel(name, grid);
      for (int trial = 0; trial < 300; ++trial) {
        const double radius = 0.29 * unit(random);
        Vec3 centre;
        for (int axis = 0; axis < 3; ++axis) {
          const double reach =
              std::min(radius + 1e-9, 0.5 * grid.length(axis) - 1e-9);  // depth of `averaged`
          centre[axis] = grid.min[axis] + reach + (grid.length(axis) - 2 * reach) * unit(random);
        }
        // To the bit: what the caller counts as outside is 0, not rounding.
        EXPECT_EQ(share(kernel, grid, centre, radius).inside, sphere_volume(radius)) << name;
      }
    }
}

TEST(Kernels, FollowAShiftByOneCellOnPeriodicAxes) {
  const Grid grid = periodic(cubes, {true, true, true});
  for (const char* name : names) {
    const Kernel kernel = make_kernel(name, grid);
    const Vec3 centre{0.57, 0.11, 1.13};
    for (const double radius : {0.03, 0.09, 0.17, 0.4, 1.9}) {
      const Shared s = share(kernel, grid, centre, radius);
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 moved = centre;
        moved[axis] += grid.width(axis);
        const Shared t = share(kernel, grid, moved, radius);
        for (int k = 0; k < 4; ++k)
          for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 5; ++i)
              EXPECT_NEAR(t.parts[grid.index((i + (axis == 0)) % 5, (j + (axis == 1)) % 3,
                                             (k + (axis == 2)) % 4)],
                          s.parts[grid.index(i, j, k)], 1e-11 * sphere_volume(radius))
                  << name << " radius " << radius << " axis " << axis;
      }
    }
  }
}

TEST(Kernels, PutParticlesInFrontOfTheFrontNowhere) {
  for (const char* name : names) {
    for (const double y : {-1e-9, 0.2 + 1e-9}) {
      EXPECT_EQ(share(make_kernel(name, averaged), averaged, {0.1, y, 0.7}, 0.05).inside, 0.0);
      const Grid open = periodic(averaged, {false, true, false});
      EXPECT_EQ(share(make_kernel(name, open), open, {0.1, y, 0.7}, 0.05).inside,
                sphere_volume(0.05))
          << name;
    }
    // Front and back do not cut.
    EXPECT_EQ(share(make_kernel(name, averaged), averaged, {0.1, 0.001, 0.7}, 0.05).inside,
              sphere_volume(0.05))
        << name;
  }
}

TEST(Kernels, StayWithinTheGridWhateverComes) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> wild{0.0,
                                 1e300,
                                 -1e300,
                                 1e18,
                                 -1e10,
                                 5e-324,
                                 0.6,
                                 -0.4,
                                 infinity,
                                 -infinity,
                                 std::nextafter(0.6, 1.0),
                                 2147483648.0};
  for (const Grid& grid : {averaged, cubes, periodic(cubes, {true, true, true}),
                           periodic(averaged, {true, false, true})})
    for (const char* name : names) {
      const Kernel kernel = make_kernel(name, grid);
      for (const double x : wild)
        for (const double z : wild)
          for (const double radius : {1e-320, 1e-30, 0.05, 0.3, 2.5, -1.0, 0.0})
            share(kernel, grid, {x, 0.15, z}, radius);  // .at() throws if it does not
      EXPECT_EQ(share(kernel, grid, {0.1, 0.15, 0.7}, -1.0).inside, 0.0);
      EXPECT_EQ(share(kernel, grid, {0.1, 0.15, 0.7}, std::nan("")).inside, 0.0);
      EXPECT_EQ(share(kernel, grid, {infinity, 0.15, 0.7}, 0.05).inside, 0.0) << name;
      EXPECT_EQ(share(kernel, grid, {std::nan(""), 0.15, 0.7}, 0.05).inside, 0.0) << name;
    }
  EXPECT_EQ(share(make_kernel("exact", cubes), cubes, {0.1, 0.15, 0.7}, 1e300).inside, 0.0);
}

TEST(Kernels, AreKnownByFourNames) {
  EXPECT_TRUE(std::holds_alternative<CentreKernel>(make_kernel("centre", averaged)));
  EXPECT_TRUE(std::holds_alternative<ExactKernel>(make_kernel("exact", averaged)));
  EXPECT_TRUE(std::holds_alternative<DividedKernel>(make_kernel("divided", averaged)));
  EXPECT_TRUE(std::holds_alternative<GaussianKernel>(make_kernel("gaussian", averaged)));
  try {
    make_kernel("exakt", averaged);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "mapping: expected centre, exact, divided or gaussian, found 'exakt'");
  }
}

TEST(Kernels, NeedCellsOfASize) {
  for (const char* name : names) {
    EXPECT_THROW(make_kernel(name, {{0, 0, 0}, {1, 1, 1}, {4, 1, 0}, {}}), InputError);
    EXPECT_THROW(make_kernel(name, {{0, 0, 0}, {1, 1, 0}, {4, 1, 4}, {}}), InputError);
    EXPECT_THROW(make_kernel(name, {{0, 0, 0}, {-1, 1, 1}, {4, 1, 4}, {}}), InputError);
    EXPECT_THROW(make_kernel(name, {{0, 0, 0}, {1, std::nan(""), 1}, {4, 1, 4}, {}}), InputError);
  }
}

// ---- centre ----

TEST(Centre, FindsTheCellThatASearchAmongTheFacesFinds) {
  const Grid riser{{-0.035, 0, 0.0025}, {0.035, 0.006, 1.5025}, {28, 1, 600}, {}};
  const CentreKernel kernel(riser);
  std::array<std::vector<double>, 3> faces;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i <= riser.cells[axis]; ++i) faces[axis].push_back(riser.face(axis, i));
  const auto searched = [&](int axis, double x) {  // numpy.histogram's rule
    if (x == riser.max[axis]) return riser.cells[axis] - 1;
    const auto& f = faces[axis];
    const int i = static_cast<int>(std::upper_bound(f.begin(), f.end(), x) - f.begin()) - 1;
    return i < riser.cells[axis] ? i : -1;
  };
  const auto expect_found = [&](double x, double z) {
    const int i = searched(lateral, x), k = searched(up, z);
    std::size_t cell = riser.size();
    kernel.share({x, 0.003, z}, 1e-3, [&](std::size_t c, double) { cell = c; });
    EXPECT_EQ(cell, i < 0 || k < 0 ? riser.size() : riser.index(i, 0, k)) << x << ' ' << z;
  };
  // Every face, as computed, as printed with 6 digits, and the two numbers next to each.
  for (int k = 0; k <= 600; ++k) {
    const double x = faces[0][static_cast<std::size_t>(k % 29)], z = faces[2][k];
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", z);
    const double printed_z = std::atof(text);
    std::snprintf(text, sizeof text, "%.6g", x);
    const double printed_x = std::atof(text);
    for (const double direction : {-10.0, 10.0}) {
      expect_found(std::nextafter(x, direction), 0.7);
      expect_found(0.01, std::nextafter(z, direction));
    }
    expect_found(x, z);
    expect_found(printed_x, printed_z);
  }
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> unit(-0.02, 1.02);
  for (int trial = 0; trial < 20000; ++trial)
    expect_found(riser.min[0] + riser.length(0) * unit(random),
                 riser.min[2] + riser.length(2) * unit(random));
}

TEST(Centre, PutsAFaceIntoTheUpperCellAndTheLastFaceIntoTheLast) {
  const Grid grid{{0, 0, 0}, {1, 1, 1}, {4, 1, 4}, {}};
  const Kernel kernel = CentreKernel(grid);
  EXPECT_EQ(only_cell(kernel, grid, {0.25, 0.5, 0.1}, 0.1), 1);
  EXPECT_EQ(only_cell(kernel, grid, {0.75, 0.5, 0.5}, 0.1), 3 + 4 * 2);
  EXPECT_EQ(only_cell(kernel, grid, {1.0, 0.5, 1.0}, 0.1), 15);
  EXPECT_EQ(only_cell(kernel, grid, {0.0, 0.0, 0.0}, 0.1), 0);
  EXPECT_EQ(only_cell(kernel, grid, {-1e-300, 0.5, 0.1}, 0.1), -1);
  EXPECT_EQ(only_cell(kernel, grid, {std::nextafter(1.0, 2.0), 0.5, 0.1}, 0.1), -1);
  const Grid ring = periodic(grid, {true, false, false});
  EXPECT_EQ(only_cell(CentreKernel(ring), ring, {-0.1, 0.5, 0.1}, 0.1), 3);
  EXPECT_EQ(only_cell(CentreKernel(ring), ring, {7.3, 0.5, 0.1}, 0.1), 1);
}

// ---- exact, besides overlap_test.cpp ----

TEST(Exact, CutsASphereOnAWallInHalfAndOnACornerInQuarters) {
  const double volume = sphere_volume(0.05);
  const Kernel flat = ExactKernel(averaged), solid = ExactKernel(cubes);
  // 1e-15: a few roundings
  EXPECT_NEAR(share(flat, averaged, {-0.4, 0.1, 0.7}, 0.05).inside, volume / 2, 1e-15 * volume);
  EXPECT_NEAR(share(flat, averaged, {0.6, 0.1, 1.2}, 0.05).inside, volume / 4, 1e-15 * volume);
  EXPECT_NEAR(share(solid, cubes, {0.6, 0.1, 1.2}, 0.05).inside, volume / 8, 1e-15 * volume);
  EXPECT_EQ(share(solid, cubes, {0.66, 0.3, 0.7}, 0.05).inside, 0.0);
}

TEST(Exact, OnAPeriodicAxisEqualsAWiderDomainFolded) {
  // Three periods side by side with walls so far away that they do not cut.
  std::mt19937_64 random(24);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const Grid ring = periodic(cubes, {true, false, false});
  Grid wide = cubes;
  wide.min[0] -= 4 * cubes.length(0);
  wide.max[0] += 4 * cubes.length(0);
  wide.cells[0] *= 9;
  for (int trial = 0; trial < 100; ++trial) {
    const double radius = 0.02 * std::pow(150.0, unit(random));
    const Vec3 centre{-0.4 + unit(random), 0.1 + 0.6 * unit(random), 0.3 + 0.9 * unit(random)};
    const Shared s = share(ExactKernel(ring), ring, centre, radius);
    const Shared w = share(ExactKernel(wide), wide, centre, radius);
    std::vector<double> folded(ring.size());
    for (int k = 0; k < 4; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 45; ++i)
          folded[ring.index(i % 5, j, k)] += w.parts[wide.index(i, j, k)];
    for (std::size_t cell = 0; cell < folded.size(); ++cell)
      // 1e-13: faces of the two grids differ by rounding
      EXPECT_NEAR(s.parts[cell], folded[cell], 1e-13 * sphere_volume(radius)) << radius;
  }
}

TEST(Exact, FillsADomainThatLiesInsideTheSphereUpToAHundredSides) {
  // 1e-9: rounding of the sphere's volume, which is 1.6 million times the domain's
  EXPECT_NEAR(share(ExactKernel(cubes), cubes, {0.1, 0.4, 0.7}, 59.9).inside, cubes.volume(),
              1e-9 * cubes.volume());
  EXPECT_EQ(share(ExactKernel(cubes), cubes, {0.1, 0.4, 0.7}, 60.1).inside, 0.0);
}

// ---- divided ----

TEST(Divided, HasThePointsOfTheTwoSphericalShells) {
  // Drawn from the spherical coordinates of the source: 8 + 6 points on each shell, and the centre.
  std::vector<Vec3> expected{{0, 0, 0}};
  for (const double r : {0.623926, 0.623926 + 0.293976}) {
    for (int polar = 0; polar < 2; ++polar)
      for (int azimuth = 0; azimuth < 4; ++azimuth) {
        const double theta = pi / 4 + polar * pi / 2, zeta = pi / 4 + azimuth * pi / 2;
        expected.push_back({r * std::sin(theta) * std::cos(zeta),
                            r * std::sin(theta) * std::sin(zeta), r * std::cos(theta)});
      }
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-r, r}) {
        Vec3 point{};
        point[axis] = side;
        expected.push_back(point);
      }
  }
  ASSERT_EQ(expected.size(), static_cast<std::size_t>(DividedKernel::points));
  for (const Vec3& point : expected) {
    const auto near = [&](const DividedKernel::Satellite& s) {
      return std::abs(DividedKernel::places[s.lateral] - point[0]) < 1e-15 &&
             std::abs(DividedKernel::places[s.depth] - point[1]) < 1e-15 &&
             std::abs(DividedKernel::places_up[s.up] - point[2]) < 1e-15;
    };
    EXPECT_EQ(
        std::count_if(DividedKernel::satellites.begin(), DividedKernel::satellites.end(), near), 1)
        << point[0] << ' ' << point[1] << ' ' << point[2];
  }
}

TEST(Divided, GivesEachPointsShareToItsCell) {
  // A face just above the centre, seen from 0.1 radii: 2 x (4 + 1) of the points lie beyond it.
  const Grid grid{{0, 0, 0}, {2, 1, 2}, {2, 1, 2}, {}};
  const Shared s = share(DividedKernel(grid), grid, {0.99, 0.5, 0.5}, 0.1);
  const double point = sphere_volume(0.1) / 29;
  EXPECT_NEAR(s.parts[0], 19 * point, 1e-15);
  EXPECT_NEAR(s.parts[1], 10 * point, 1e-15);
}

TEST(Divided, LeavesPointsBeyondAWallOutside) {
  const Grid grid{{0, 0, 0}, {2, 1, 2}, {2, 2, 2}, {}};
  const double volume = sphere_volume(0.1);
  const Kernel kernel = DividedKernel(grid);
  EXPECT_NEAR(share(kernel, grid, {0.01, 0.5, 0.5}, 0.1).inside, volume * 19 / 29, 1e-15);
  EXPECT_NEAR(share(kernel, grid, {-0.01, 0.5, 0.5}, 0.1).inside, volume * 10 / 29, 1e-15);
  EXPECT_NEAR(share(kernel, grid, {0.5, 0.01, 0.5}, 0.1).inside, volume * 19 / 29, 1e-15);
  // Depth-averaged: by the particle's centre.
  const Grid flat{{0, 0, 0}, {2, 1, 2}, {2, 1, 2}, {}};
  EXPECT_EQ(share(DividedKernel(flat), flat, {0.5, 0.01, 0.5}, 0.1).inside, volume);
}

// ---- gaussian ----

TEST(Gaussian, SharesAreTheIntegralOfTheWeight) {
  const Grid grid{{0, 0, 0}, {20, 1, 30}, {20, 1, 30}, {}};
  const double w = 1.3, x = 9.7, z = 14.2;
  const Shared s = share(GaussianKernel(grid, w), grid, {x, 0.5, z}, 0.1);
  // Midpoint rule with 20,000 points a cell, cut off at 4 w and normalised.
  const auto weight = [&](double from, double about) {
    double integral = 0.0;
    constexpr int points = 20000;
    for (int p = 0; p < points; ++p) {
      const double d = from + (p + 0.5) / points - about;
      if (std::abs(d) < 4 * w) integral += std::exp(-d * d / (2 * w * w)) / points;
    }
    return integral / (w * std::sqrt(2 * pi) * std::erf(4 / std::numbers::sqrt2));
  };
  std::array<double, 20> across{};
  for (int i = 0; i < 20; ++i) across[i] = weight(i, x);
  for (int k = 0; k < 30; ++k) {
    const double along = weight(k, z);
    for (int i = 0; i < 20; ++i)
      // 1e-8: one point more or less within the cut-off, 3e-4 / 20,000
      EXPECT_NEAR(s.parts[grid.index(i, 0, k)] / sphere_volume(0.1), across[i] * along, 1e-8);
  }
}

TEST(Gaussian, StaysWithinTheWalls) {
  for (const Grid& grid : {averaged, cubes}) {
    const Kernel kernel = GaussianKernel(grid, 0.3);
    for (const Vec3& corner : {Vec3{-0.4, 0.1, 0.3}, Vec3{0.6, 0.15, 1.2}, Vec3{0.6, 0.12, 0.3}}) {
      const Shared s = share(kernel, grid, corner, 0.01);
      EXPECT_EQ(s.inside, sphere_volume(0.01));
      EXPECT_NEAR(sum(s.parts), s.inside, 1e-14 * s.inside);
    }
    EXPECT_EQ(share(kernel, grid, {-0.4001, 0.15, 0.5}, 0.01).inside, 0.0);
  }
}

TEST(Gaussian, OfNoWidthToSpeakOfIsTheCentreKernel) {
  EXPECT_EQ(only_cell(GaussianKernel(averaged, 1e-6), averaged, {0.1, 0.1, 0.4}, 0.01),
            only_cell(CentreKernel(averaged), averaged, {0.1, 0.1, 0.4}, 0.01));
  // Nor is a cell missed where the cut-off is less than the rounding of a position at a face.
  const Grid fine{{0, 0, 0.0025}, {0.07, 0.006, 1.5025}, {28, 1, 600}, {}};
  for (const double w : {1e-300, 1e-17}) {
    const GaussianKernel kernel(fine, w);
    for (int face = 1; face < 600; ++face)
      for (const double towards : {-1.0, 0.0, 1.0}) {
        const double z = fine.face(up, face);
        double total = 0.0;
        kernel.share({0.01, 0.003, towards == 0.0 ? z : std::nextafter(z, 9.0 * towards)}, 1e-3,
                     [&](std::size_t, double part) { total += part; });
        EXPECT_NEAR(total, sphere_volume(1e-3), 1e-14 * sphere_volume(1e-3)) << face;
      }
  }
}

TEST(Gaussian, IsByDefaultAsWideAsTheWidestSideOfACell) {
  EXPECT_DOUBLE_EQ(GaussianKernel(averaged).width(), averaged.width(up));
  EXPECT_DOUBLE_EQ(GaussianKernel(averaged, 0.07).width(), 0.07);
  EXPECT_DOUBLE_EQ(
      std::get<GaussianKernel>(make_kernel("gaussian", averaged, {.gaussian_width = 0.03})).width(),
      0.03);
}

TEST(Gaussian, RefusesAWidthThatIsNone) {
  for (const double width : {-1.0, std::nan(""), 1.0 / 0.0})
    EXPECT_THROW(GaussianKernel(averaged, width), InputError);
  const Grid fine{{0, 0, 0}, {1, 1, 1}, {1000, 1, 1000}, {}};
  EXPECT_THROW(GaussianKernel(fine, 0.02), InputError);
  EXPECT_NO_THROW(GaussianKernel(fine, 0.015));
  EXPECT_NO_THROW(GaussianKernel(averaged, 100.0));
  EXPECT_THROW(GaussianKernel(periodic(averaged, {true, false, false}), 100.0), InputError);
}

}  // namespace
}  // namespace bedscope::analysis
