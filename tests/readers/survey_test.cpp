// SPDX-License-Identifier: BSD-3-Clause
// What a look at a series says of it.
#include "readers/survey.hpp"

#include <cmath>
#include <numbers>

#include "tests/readers/test_files.hpp"

namespace bedscope::readers {
namespace {

TEST(Survey, RangesAreThoseOfTheRows) {
  const TemporaryFolder folder;
  folder.write("dump1", dump_header(1, 3, "id type x y z radius") +
                            "1 1 -1 2 3 .5 \n2 3 4 -5 6 .25 \n5 3 0 0 0 1 \n");
  folder.write("dump2", dump_header(2, 1, "id type x y z radius") + "1 2 9 0 0 .125 \n");
  const auto found = survey(Series::open(folder.path()), true);
  EXPECT_EQ(found.particles, (std::array<std::int64_t, 2>{1, 3}));
  std::map<std::int64_t, std::int64_t> particles;
  for (const auto& [type, species] : found.types) particles[type] = species.particles;
  EXPECT_EQ(particles, (std::map<std::int64_t, std::int64_t>{{1, 1}, {2, 1}, {3, 2}}));
  EXPECT_TRUE(found.has_radius);
  EXPECT_EQ(found.radius, (std::array{.125, 1.}));
  EXPECT_EQ(found.min, (std::array{-1., -5., 0.}));
  EXPECT_EQ(found.max, (std::array{9., 2., 6.}));
  EXPECT_EQ(found.snapshots_read, 2U);
  EXPECT_TRUE(found.problems.empty());
}

TEST(Survey, TheRowsOfTenSnapshotsAreReadTheFirstAndTheLastAmongThemUnlessAllAreAskedFor) {
  const TemporaryFolder folder;
  for (int step = 0; step < 37; ++step)
    folder.write(fmt::format("dump{}", step), small_dump(step, step == 0 || step == 36 ? 9 : 5));
  const auto series = Series::open(folder.path());
  const auto some = survey(series, false);
  EXPECT_EQ(some.snapshots_read, 10U);
  EXPECT_EQ(some.particles, (std::array<std::int64_t, 2>{5, 9}));
  EXPECT_EQ(some.types.at(1).particles, 9 + 8 * 5 + 9);
  EXPECT_EQ(survey(series, true).snapshots_read, 37U);
}

TEST(Survey, ParticlesThatAreNotFiniteOrHaveNoSizeAreNamedAndKeptOutOfTheRanges) {
  const TemporaryFolder folder;
  const auto path = folder.write(
      "dump1",
      dump_header(1, 5, "id x y z radius vx") +
          "1 .5 0 0 1 0 \n2 nan 0 99 1 0 \n3 .25 0 0 0 0 \n4 77 0 0 1 inf \n1 .75 0 0 1 0 \n");
  const auto found = survey(Series::open(path), true);
  EXPECT_EQ(found.max, (std::array{.75, 0., 0.}));
  ASSERT_EQ(found.problems.size(), 3U);
  EXPECT_NE(found.problems[0].find("2 particles in 1 snapshots are not finite"), std::string::npos);
  EXPECT_NE(found.problems[0].find("line 11 (id 2), line 13 (id 4)"), std::string::npos)
      << found.problems[0];
  EXPECT_NE(found.problems[1].find("1 particles in 1 snapshots have a radius of zero"),
            std::string::npos);
  EXPECT_NE(found.problems[1].find("line 12 (id 3)"), std::string::npos) << found.problems[1];
  EXPECT_NE(found.problems[2].find("line 14 (id 1)"), std::string::npos) << found.problems[2];
}

TEST(Survey, TypesThatAreNoWholeNumberAreTypeZeroAndNamed) {
  const TemporaryFolder folder;
  const auto path = folder.write(
      "dump1",
      dump_header(1, 5, "id type x y z radius") +
          "1 2 0 0 0 1 \n2 nan 0 0 0 1 \n3 1.5 0 0 0 1 \n4 1e12 0 0 0 1 \n5 -1 0 0 0 1 \n");
  const auto found = survey(Series::open(path), true);
  std::map<std::int64_t, std::int64_t> particles;
  for (const auto& [type, species] : found.types) particles[type] = species.particles;
  EXPECT_EQ(particles, (std::map<std::int64_t, std::int64_t>{{-1, 1}, {0, 3}, {2, 1}}));
  ASSERT_EQ(found.problems.size(), 1U);
  EXPECT_NE(found.problems[0].find("3 particles in 1 snapshots have a type that is no whole "
                                   "number, counted as type 0; first: "),
            std::string::npos);
  EXPECT_NE(found.problems[0].find("line 11 (id 2), line 12 (id 3), line 13 (id 4)"),
            std::string::npos)
      << found.problems[0];
}

TEST(Survey, EveryColumnHasItsRangeMeanZerosAndFlaws) {
  const TemporaryFolder folder;
  const auto path =
      folder.write("dump1", dump_header(1, 4, "id type type xs ys zs diameter q c_ke element") +
                                "1 1 1 .5 .5 .5 .2 0 nan Fe \n2 1 1 .25 .5 .5 .2 -3 2 Fe \n"
                                "3 2 2 0 .5 .5 .2 1 inf C \n4 2 2 1 .5 .5 .4 0 4 C \n");
  const auto found = survey(Series::open(path), true);
  std::vector<std::string> names;
  for (const auto& column : found.columns) names.push_back(column.name);
  EXPECT_EQ(names, (std::vector<std::string>{"id", "type", "xs", "ys", "zs", "diameter", "q",
                                             "c_ke"}));  // once each, and no text
  const auto& q = *found.column("q");
  EXPECT_EQ(q.range.min, -3);
  EXPECT_EQ(q.range.max, 1);
  EXPECT_EQ(q.mean(), -0.5);
  EXPECT_EQ(q.zeros, 2);
  EXPECT_FALSE(q.constant());
  EXPECT_TRUE(found.column("ys")->constant());
  const auto& ke = *found.column("c_ke");
  EXPECT_EQ(ke.not_finite, 2);
  EXPECT_EQ(ke.mean(), 3);
  EXPECT_NE(ke.first_not_finite.find("line 10"), std::string::npos) << ke.first_not_finite;
  EXPECT_EQ(found.column("x"), nullptr);  // not on disk under this name
  EXPECT_EQ(found.column("diameter")->range.max, .4);
  EXPECT_EQ(found.radius, (std::array{.1, .2}));
  EXPECT_TRUE(found.problems.empty());  // no flaw in what makes a particle
}

TEST(Survey, MassesVolumesAndSpeedsAreThoseOfTheRows) {
  const TemporaryFolder folder;
  const double ball = 4 * std::numbers::pi / 3;
  folder.write("dump1", dump_header(1, 2, "x y z vx vy vz radius type density",
                                    "ff ff ff\n0 10\n0 10\n0 10\n") +
                            "1 1 1 3 4 0 1 1 10 \n5 5 5 0 0 1 2 2 20 \n");
  folder.write("dump2", dump_header(2, 1, "x y z vx vy vz radius type density",
                                    "ff ff ff\n0 10\n0 10\n0 10\n") +
                            "1 1 11 0 0 0 1 1 10 \n");
  const auto found = survey(Series::open(folder.path()), true);
  ASSERT_EQ(found.read.size(), 2U);
  EXPECT_NEAR(found.read[0].volume, 9 * ball, 1e-12);
  EXPECT_NEAR(found.read[0].mass, (10 + 8 * 20) * ball, 1e-11);
  EXPECT_NEAR(found.read[0].holdup, 9 * ball / 1000, 1e-15);
  EXPECT_NEAR(found.read[1].volume, ball, 1e-12);
  EXPECT_EQ(found.fastest, 5);
  EXPECT_NE(found.fastest_place.find("dump1: line 10"), std::string::npos) << found.fastest_place;
  EXPECT_EQ(found.types.at(2).density.max, 20);
  EXPECT_EQ(found.types.at(1).particles, 2);
  EXPECT_EQ(found.outside_box, 1);
  EXPECT_EQ(found.counts, (std::vector<std::int64_t>{2, 1}));
}

TEST(Survey, HoldupIsThatOfATiltedBoxNotOfTheOneAroundIt) {
  const TemporaryFolder folder;
  // Sides 2, 3 and 4, tilted by xy = -0.5, xz = 1, yz = 0.5: 24 m3 in a box of 3.5 x 3.5 x 4.
  const auto path =
      folder.write("dump1",
                   "ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n1\n"
                   "ITEM: BOX BOUNDS xy xz yz pp pp ff\n-0.5 3 -0.5\n0 3.5 1\n0 4 0.5\n"
                   "ITEM: ATOMS id x y z radius \n1 1 1 1 0.5 \n");
  const auto found = survey(Series::open(path), true);
  EXPECT_NEAR(found.read.at(0).holdup, std::numbers::pi / 6 / 24, 1e-15);
}

TEST(Survey, OfBodiesTheMassIsNotSummed) {
  const TemporaryFolder folder;
  const auto path = folder.write(
      "dump1", dump_header(1, 2, "x y z radius mass mol") + "0 0 0 .5 7 1 \n0 0 .5 .5 7 1 \n");
  const auto found = survey(Series::open(path), true);
  EXPECT_TRUE(found.has_bodies);
  EXPECT_TRUE(std::isnan(found.read[0].mass));
  EXPECT_TRUE(found.overlap.tested);
  EXPECT_EQ(found.overlap.found.deepest, 0);  // within one body
}

TEST(Survey, ASeriesWithoutParticlesHasNoRanges) {
  const TemporaryFolder folder;
  const auto found = survey(Series::open(folder.write("dump1", small_dump(1, 0))), true);
  EXPECT_FALSE(found.has_particles);
  EXPECT_FALSE(found.has_radius);
  EXPECT_EQ(found.particles, (std::array<std::int64_t, 2>{0, 0}));
}

TEST(Survey, WithoutARadiusOrTypesThereAreNone) {
  const TemporaryFolder folder;
  const auto found =
      survey(Series::open(folder.write("dump1", dump_header(1, 1, "x y z") + "1 2 3 \n")), true);
  EXPECT_TRUE(found.has_particles);
  EXPECT_FALSE(found.has_radius);
  EXPECT_TRUE(found.types.empty());
}

}  // namespace
}  // namespace bedscope::readers
