// SPDX-License-Identifier: BSD-3-Clause
// Which columns on disk serve a request, and what is done to them.
#include "readers/columns.hpp"

#include <gtest/gtest.h>

#include "tests/readers/test_files.hpp"

namespace bedscope::readers {
namespace {

using Names = std::vector<std::string>;

/// The snapshot of one particle whose column k on disk holds `values[k]`.
Snapshot one_particle(const Names& names, const std::vector<double>& values, const Request& request,
                      const Box& box = {}) {
  const auto plan = plan_columns(names, request, "dump: line 9");
  std::vector<std::vector<double>> raw;
  for (const int column : plan.parse) raw.push_back({values[static_cast<std::size_t>(column)]});
  Snapshot out;
  out.box = box;
  out.particles = 1;
  finish_columns(plan, raw, out, "dump");
  return out;
}

double one_value(const Names& names, const std::vector<double>& values, const std::string& wanted) {
  return one_particle(names, values, {{wanted}}).columns.at(0).at(0);
}

TEST(Columns, OnlyWhatIsAskedForIsParsed) {
  const Names names{"id", "type", "x", "y", "z", "vx", "radius"};
  EXPECT_EQ(plan_columns(names, request_of({"radius", "x"}), "").parse, (std::vector<int>{2, 6}));
  EXPECT_EQ(plan_columns(names, {}, "").parse, (std::vector<int>{}));
}

TEST(Columns, ARadiusComesFromRadiusRadiiOrHalfADiameter) {
  EXPECT_EQ(one_value({"x", "radius"}, {1, 2}, "radius"), 2);
  EXPECT_EQ(one_value({"x", "radii"}, {1, 2}, "radius"), 2);
  EXPECT_EQ(one_value({"x", "diameter"}, {1, 2}, "radius"), 1);
  EXPECT_EQ(one_value({"x", "Diameter"}, {1, 2}, "radius"), 1);
  EXPECT_EQ(one_value({"diameter", "radius"}, {1, 2}, "radius"), 2);  // the radius itself is best
  EXPECT_EQ(one_value({"diameter", "radius"}, {1, 2}, "diameter"), 1);
}

TEST(Columns, ADensityAndVelocitiesHaveOtherSpellingsToo) {
  EXPECT_EQ(one_value({"rho"}, {2500}, "density"), 2500);
  EXPECT_EQ(one_value({"rho", "density"}, {1, 2}, "density"), 2);
  for (const char* stem : {"velocity_lin", "velocity", "Velocity"}) {
    const auto names = component_names(stem, 3);
    EXPECT_EQ(one_value(names, {1, 2, 3}, "vx"), 1) << stem;
    EXPECT_EQ(one_value(names, {1, 2, 3}, "vy"), 2) << stem;
    EXPECT_EQ(one_value(names, {1, 2, 3}, "vz"), 3) << stem;
  }
}

TEST(Columns, OfMfixIdTypeDensityAndMassAreFound) {
  const std::vector<std::string> names{"Diameter", "Particle_ID", "Particle_Phase_ID", "Density",
                                       "Mass"};
  EXPECT_EQ(one_value(names, {2, 7, 1, 2500, 3}, "radius"), 1);
  EXPECT_EQ(one_value(names, {2, 7, 1, 2500, 3}, "id"), 7);
  EXPECT_EQ(one_value(names, {2, 7, 1, 2500, 3}, "type"), 1);
  EXPECT_EQ(one_value(names, {2, 7, 1, 2500, 3}, "density"), 2500);
  EXPECT_EQ(one_value(names, {2, 7, 1, 2500, 3}, "mass"), 3);
  EXPECT_EQ(one_value({"Particle_ID", "id"}, {7, 8}, "id"), 8);
}

TEST(Columns, ATemperatureIsFoundUnderItsMostUsualNames) {
  for (const char* name :
       {"f_Temp[0]", "f_Temp", "Temp", "T", "c_T", "v_temperature", "Tp", "temp"})
    EXPECT_EQ(one_value({"id", name}, {1, 300}, "temperature"), 300) << name;
  EXPECT_NE(error_of([] { one_value({"f_heatFlux[0]", "type"}, {1, 2}, "temperature"); }), "");
}

TEST(Columns, AScalarWithIndexZeroAndWithoutAreTheSame) {
  EXPECT_EQ(one_value({"f_Temp[0]"}, {5}, "f_Temp"), 5);
  EXPECT_EQ(one_value({"f_Temp"}, {5}, "f_Temp[0]"), 5);
}

TEST(Columns, WrappedCoordinatesArePreferredThenScaledThenUnwrapped) {
  Box box;
  box.known = true;
  box.min = {-1, -1, -1};
  box.max = {1, 1, 3};
  const Request x{{"x"}};
  const auto first = [&](const Names& names, const std::vector<double>& values) {
    return one_particle(names, values, x, box).columns[0][0];
  };
  EXPECT_EQ(first({"xsu", "xu", "xs", "x"}, {.1, .2, .3, .4}), .4);
  EXPECT_EQ(first({"xsu", "xu", "xs"}, {.1, .2, .75}), .5);
  EXPECT_EQ(first({"xsu", "xu"}, {.1, .2}), .2);
  EXPECT_EQ(first({"xsu"}, {1.25}), 1.5);
}

TEST(Columns, ScaledCoordinatesNeedABoxAndOfATriclinicOneAllThree) {
  EXPECT_EQ(error_of([] { one_particle({"xs"}, {.1}, {{"x"}}); }),
            "dump: scaled coordinates need the box, found none");
  Box box;
  box.known = true;
  box.min = {0, 0, 0};
  box.max = {1, 1, 1};
  box.tilt = {.1, 0, 0};
  EXPECT_EQ(error_of([&] { one_particle({"xs"}, {.1}, {{"x"}}, box); }),
            "dump: a triclinic box needs all of xs, ys and zs");
}

TEST(Columns, ATiltedBoxIsTakenOutOfItsBoundingBox) {
  // Corners of a box with edges (4,0,0), (xy,3,0), (xz,yz,2) from the origin (1,2,3).
  for (const auto& [xy, xz, yz] : {std::array{-1., .5, -.25}, {.5, .25, .5}, {-.5, -1., .75}}) {
    Box box;
    box.known = true;
    box.tilt = {xy, xz, yz};
    box.min.fill(99);
    box.max.fill(-99);
    const auto corner = [&, &xy = xy, &xz = xz, &yz = yz](double a, double b, double c) {
      return std::array{1 + 4 * a + xy * b + xz * c, 2 + 3 * b + yz * c, 3 + 2 * c};
    };
    for (int k = 0; k < 8; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double at = corner(k & 1, k >> 1 & 1, k >> 2)[axis];
        box.min[axis] = std::min(box.min[axis], at);
        box.max[axis] = std::max(box.max[axis], at);
      }
    for (const double a : {0., .25, 1.})
      for (const double b : {0., .5, 1.})
        for (const double c : {0., .75, 1.}) {
          const auto out =
              one_particle({"xs", "ys", "zs"}, {a, b, c}, request_of({"x", "y", "z"}), box);
          for (std::size_t axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(out.columns[axis][0], corner(a, b, c)[axis], 1e-14);  // rounding
        }
  }
}

TEST(Columns, ADoubledNameIsParsedTwiceToBeComparedAndTheLastIsTaken) {
  const Names names{"id", "type", "type", "x"};
  const auto plan = plan_columns(names, request_of({"type"}), "");
  EXPECT_EQ(plan.parse, (std::vector<int>{1, 2}));
  ASSERT_EQ(plan.twins.size(), 1U);
  EXPECT_EQ(plan.twins[0], (std::array<int, 2>{0, 1}));
  EXPECT_EQ(one_value(names, {1, 2, 3, 4}, "type"), 3);
}

TEST(Columns, ARequestMayNameTheSameColumnTwice) {
  const auto out = one_particle({"diameter"}, {4}, request_of({"radius", "diameter", "radius"}));
  EXPECT_EQ(out.columns, (std::vector<std::vector<double>>{{2}, {4}, {2}}));
}

TEST(Columns, AnAbsentColumnIsEmptyWhereOptionalAndAnErrorThatListsWhatIsThereOtherwise) {
  const Names names{"id", "x"};
  EXPECT_TRUE(one_particle(names, {1, 2}, {{"radius", false}}).columns[0].empty());
  EXPECT_EQ(error_of([&] { plan_columns(names, request_of({"radius"}), "dump: line 9"); }),
            "dump: line 9: expected a column \"radius\", found only: id x");
  EXPECT_EQ(error_of([&] { plan_columns(names, request_of({"z"}), "dump: line 9"); }),
            "dump: line 9: no position column \"z\" (x y z, xs ys zs, xu yu zu or xsu ysu zsu)");
}

TEST(Columns, VectorsOfVtkFilesGetTheNamesThatTheirComponentsHaveInTextDumps) {
  EXPECT_EQ(component_names("radius", 1), (Names{"radius"}));
  EXPECT_EQ(component_names("v", 3), (Names{"vx", "vy", "vz"}));
  EXPECT_EQ(component_names("omega", 3), (Names{"omegax", "omegay", "omegaz"}));
  EXPECT_EQ(component_names("i", 3), (Names{"ix", "iy", "iz"}));
  EXPECT_EQ(component_names("c_st1[1-3]", 3), (Names{"c_st1[1]", "c_st1[2]", "c_st1[3]"}));
  EXPECT_EQ(component_names("c_st1[4-6]", 3), (Names{"c_st1[4]", "c_st1[5]", "c_st1[6]"}));
  EXPECT_EQ(component_names("dragforce", 3),
            (Names{"dragforce[1]", "dragforce[2]", "dragforce[3]"}));
  EXPECT_EQ(component_names("v", 2), (Names{"v[1]", "v[2]"}));
  EXPECT_EQ(component_names("quat", 9).size(), 9U);
  EXPECT_TRUE(component_names("none", 0).empty());
}

}  // namespace
}  // namespace bedscope::readers
