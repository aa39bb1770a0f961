// SPDX-License-Identifier: BSD-3-Clause
// The registry: what ships is whole and says where it comes from; what is wrong is one clear line.
#include "validation/curves.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/readers/test_files.hpp"

namespace bedscope::validation {
namespace {

using readers::error_of;
using readers::TemporaryFolder;

const std::string shipped = BEDSCOPE_SOURCE "/data/curves";

Curves open(const std::string& folder) { return Curves::open(std::vector{folder}); }

TEST(Shipped, EverySetSaysWhereItComesFromAndWhetherItMayBePassedOn) {
  const auto curves = open(shipped);
  EXPECT_GE(curves.sets().size(), 40U);
  for (const auto& set : curves.sets()) {
    SCOPED_TRACE(set.name);
    EXPECT_TRUE(set.available);
    EXPECT_FALSE(set.about.title.empty());
    EXPECT_FALSE(set.about.kind.empty());
    EXPECT_FALSE(set.about.citation.empty() && set.about.source.empty());
    EXPECT_FALSE(set.about.method.empty());
  }
}

TEST(Shipped, VarasExperimentHasItsFourVelocitiesAndItsInventory) {
  // The inventories of the thesis' reading of it: 94.7, 52.9, 41.9, 32.4 g in 0.07 x 0.006 m2.
  const auto curves = open(shipped);
  const std::map<std::string, double> grams{
      {"5.55", 94.7}, {"5.95", 52.9}, {"6.35", 41.9}, {"6.74", 32.4}};
  for (const auto& [velocity, mass] : grams) {
    const auto curve = curves.curve("varas_2017/axial_holdup?U=" + velocity);
    const auto& p = curve.points;
    double integral = 0;  // over the heights that were measured
    for (std::size_t i = 1; i < p.size(); ++i)
      integral += (p[i].y + p[i - 1].y) / 2 * (p[i].x - p[i - 1].x);
    EXPECT_NEAR(integral * 0.07 * 0.006 * 2500 * 1000, mass, 0.01 * mass) << velocity;
  }
}

TEST(Shipped, UncertaintiesThatNobodyStatedAreNamedAsAssumed) {
  const auto curve = open(shipped).curve("varas_2017/axial_holdup?U=5.55");
  ASSERT_EQ(curve.assumptions.size(), 2U);
  EXPECT_NE(curve.assumptions[1].find("holdup not stated"), std::string::npos);
  double low = INFINITY, high = -INFINITY;
  for (const auto& point : curve.points) {
    low = std::min(low, point.y);
    high = std::max(high, point.y);
  }
  EXPECT_DOUBLE_EQ(curve.points[0].u_y, assumed_u_y * (high - low));
}

TEST(Shipped, StatedIntervalsBecomeStandardUncertainties) {
  const auto curve = open(shipped).curve(
      "lamarche_2022/rise_time?U=1.83&bed_mass=0.17746&intruder_size=large&intruders=1");
  ASSERT_EQ(curve.points.size(), 1U);
  EXPECT_DOUBLE_EQ(curve.points[0].y, 7.503);
  EXPECT_DOUBLE_EQ(curve.points[0].u_y, 0.882 / 1.96);
  EXPECT_TRUE(curve.assumptions.empty());
}

TEST(Selection, ThePlaceOfACheckChoosesWhatTheNameDoesNot) {
  const auto curves = open(shipped);
  const auto named = curves.curve("varas_2017/lateral_holdup?U = 5.55 & height=0.8");
  const auto placed =
      curves.curve("varas_2017/lateral_holdup?U=5.55", {"lateral holdup", {{"height", 0.8}}});
  ASSERT_EQ(named.points.size(), 22U);
  ASSERT_EQ(placed.points.size(), named.points.size());
  EXPECT_EQ(placed.points[3].y, named.points[3].y);
  EXPECT_FALSE(named.about.orientation_known);
}

TEST(Selection, WhatLeavesAChoiceOrNothingIsOneLine) {
  const auto curves = open(shipped);
  const auto wrong = [&](const char* name) { return error_of([&] { curves.curve(name); }); };
  EXPECT_NE(wrong("varas_2017/axial_holdup").find("U among 5.55, 5.95, 6.35, 6.74"),
            std::string::npos);
  EXPECT_NE(wrong("varas_2017/axial_holdup?U=7").find("no point has U = 7"), std::string::npos);
  EXPECT_NE(wrong("varas_2017/axial_holdup?V=7").find("U"), std::string::npos);
  EXPECT_NE(
      wrong("varas_2017/axal_holdup?U=5.55").find("nearest known one is varas_2017/axial_holdup"),
      std::string::npos);
  EXPECT_NE(wrong("mu_2022/text_statements").find("a table of values, not a curve"),
            std::string::npos);
}

TEST(OwnCurves, AreReadByTheSameRules) {
  const TemporaryFolder folder;
  folder.write("mine.csv", "z [m],holdup [-],holdup_u [-]\n0.3,0.02,0.001\n0.1,0.05,0.002\n");
  const auto curve = open(folder.path("")).curve("mine");
  ASSERT_EQ(curve.points.size(), 2U);
  EXPECT_EQ(curve.points[0].x, 0.1);
  EXPECT_EQ(curve.points[0].u_y, 0.002);
  EXPECT_EQ(open(shipped).curve(folder.path("mine.csv")).points.size(), 2U);
  const auto based = Curves::open(std::vector<std::string>{}, folder.path(""));
  EXPECT_EQ(based.curve("mine.csv").name, "mine.csv");
}

TEST(OwnCurves, ASingleDigitisedValueIsNotTakenAsExact) {
  const TemporaryFolder folder;
  folder.write("one.csv", "z [m],holdup [-]\n0.2,0.05\n");
  const auto curve = open(folder.path("")).curve("one");
  EXPECT_DOUBLE_EQ(curve.points.at(0).u_y, 0.01 * 0.05);
  EXPECT_DOUBLE_EQ(curve.points.at(0).u_x, 0.005 * 0.2);
  ASSERT_EQ(curve.assumptions.size(), 2U);
  EXPECT_NE(curve.assumptions[1].find("1 % of its value"), std::string::npos);
}

TEST(OwnCurves, ErrorBarsAreIntervals) {
  const TemporaryFolder folder;
  folder.write("bars.csv", "z [m],holdup [-],holdup_lo [-],holdup_hi [-]\n0.1,0.05,0.04,0.06\n");
  const auto curve = open(folder.path("")).curve("bars");
  EXPECT_NEAR(curve.points[0].u_y, 0.01 / 1.96, 1e-15);
}

TEST(OwnCurves, ErrorBarsAndTheUncertaintyOfReadingThemAddUp) {
  const TemporaryFolder folder;  // as bedscope digitise writes both
  folder.write(
      "bars.csv",
      "z [m],holdup [-],holdup_u [-],holdup_lo [-],holdup_hi [-]\n0.1,0.05,0.003,0.04,0.07\n");
  const auto point = open(folder.path("")).curve("bars").points.at(0);
  EXPECT_DOUBLE_EQ(point.up(), std::hypot(0.003, 0.02 / 1.96));
  EXPECT_DOUBLE_EQ(point.down(), std::hypot(0.003, 0.01 / 1.96));
  folder.write("share.csv", "z [m],holdup [-],holdup_lo [-],holdup_hi [-]\n0.1,0.05,0.04,0.07\n");
  folder.write("share.toml", "ordinate_uncertainty = \"10 %\"\n");
  EXPECT_DOUBLE_EQ(open(folder.path("")).curve("share").points.at(0).up(),
                   std::hypot(0.005, 0.02 / 1.96));
}

TEST(OwnCurves, ErrorBarsKeepTheirUnequalArms) {
  const TemporaryFolder folder;
  folder.write("bars.csv", "z [m],holdup [-],holdup_lo [-],holdup_hi [-]\n0.1,0.05,0.04,0.08\n");
  const auto curve = open(folder.path("")).curve("bars");
  EXPECT_NEAR(curve.points[0].up(), 0.03 / 1.96, 1e-15);
  EXPECT_NEAR(curve.points[0].down(), 0.01 / 1.96, 1e-15);
}

TEST(OwnCurves, ASeriesInTimeAscends) {
  const TemporaryFolder folder;
  folder.write("t.csv", "time [s],p [Pa]\n0,1\n2,1\n1,1\n");
  EXPECT_NE(error_of([&] { open(folder.path("")).curve("t"); }).find("line 4: expected times that"),
            std::string::npos);
  folder.write("z.csv", "z [m],p [Pa]\n0,1\n2,1\n1,1\n");  // a profile may be in any order
  EXPECT_EQ(open(folder.path("")).curve("z").points[1].x, 1);
}

TEST(OwnCurves, SharesAndNumbersOfASidecarAreTaken) {
  const TemporaryFolder folder;
  folder.write("c.csv", "z [m],holdup [-]\n0.1,0.05\n0.2,0.03\n");
  folder.write("c.toml", "ordinate_uncertainty = \"4 %\"\nabscissa_uncertainty = 0.002\n");
  const auto curve = open(folder.path("")).curve("c");
  EXPECT_DOUBLE_EQ(curve.points[1].u_y, 0.0012);
  EXPECT_DOUBLE_EQ(curve.points[1].u_x, 0.002);
}

TEST(OwnCurves, AssumptionsAreOnePrintableLineEach) {
  const TemporaryFolder folder;
  folder.write("mine.csv", "U,x [m],v [-],v_lo [-],v_hi [-]\na\x1b,0,1,0,2\na\x1b,1,1,0,2\n");
  const auto curve = open(folder.path()).curve("mine?U=a\x1b");
  ASSERT_EQ(curve.assumptions.size(), 2U);
  for (const auto& text : curve.assumptions)
    EXPECT_NE(text.find("mine?U=a\\x1b"), std::string::npos) << text;
}

TEST(OwnCurves, FaultsNameFileAndLine) {
  const std::vector<std::array<std::string, 3>> cases{
      {"z,holdup [-]\n0,1\n", "", "column \"z\": expected its unit in brackets"},
      {"z [m],holdup [-]\n0,1\n1,abc\n", "", "line 3"},
      {"z [m],holdup [-]\n0,nan\n", "", "line 2"},
      {"z [m],holdup [-]\n", "", "no rows"},
      {"z [m]\n1\n", "", "expected an abscissa and an ordinate"},
      {"z [m],holdup [-]\n0,1\n", "abscisa = \"z\"\n", "nearest known one is abscissa"},
      {"z [m],holdup [-]\n0,1\n", "abscissa = \"x\"\n", "expected a column \"x\""},
      {"z [m],holdup [-]\n0,1\n", "ordinate_uncertainty = -1\n", "at least 0"},
      {"z [m],holdup [-],holdup_u [-]\n0,1,-0.1\n", "",
       "line 2: expected an uncertainty of at least 0"},
      {"z [m],h [-],h_lo [-],h_hi [-]\n0,1,1.2,0.8\n", "", "line 2: expected h_lo [-] <= h [-]"},
      {"z [m],holdup [-]\n0,1\n", "redistribute = \"maybe\"\n", "\"yes\" or \"no\""},
      {"z [m],h [-],h_u [%]\n0,1,1\n", "", "column \"h_u [%]\": expected the unit of \"h [-]\""},
      {"z [m],z_ci95 [mm],h [-]\n0,1,1\n", "", "expected the unit of \"z [m]\""},
      {"z [m],h [-],h_lo [-],h_hi [%]\n0,1,0,2\n", "", "expected the unit of \"h [-]\""},
      {"z [m],h [-]\n0,1\n", "ordinate_uncertainty = \"nan %\"\n", "expected a share"},
      {"z [m],h [-]\n0,1\n", "ordinate_uncertainty = \"inf %\"\n", "expected a share"},
      {"z [m],h [-]\n0,1\n", "orientation = \"unkown\"\n", "\"known\" or \"unknown\""},
  };
  for (const auto& [csv, sidecar, text] : cases) {
    const TemporaryFolder folder;
    folder.write("c.csv", csv);
    if (!sidecar.empty()) folder.write("c.toml", sidecar);
    const auto error = error_of([&] { open(folder.path("")); });
    EXPECT_NE(error.find(text), std::string::npos) << error;
    EXPECT_NE(error.find("/c."), std::string::npos) << error;
  }
}

TEST(OwnCurves, ASetThatMayNotBePassedOnIsMissingUntilItIsSupplied) {
  const TemporaryFolder folder;
  folder.write("closed.toml", "redistribute = \"no\"\ncitation = \"somebody 1999\"\n");
  const auto curves = open(folder.path(""));
  EXPECT_FALSE(curves.sets()[0].available);
  EXPECT_THROW(curves.curve("closed"), MissingCurve);
  folder.write("lost.toml", "title = \"lost\"\n");
  EXPECT_NE(error_of([&] { open(folder.path("")); }).find("lost.csv"), std::string::npos);
}

}  // namespace
}  // namespace bedscope::validation
