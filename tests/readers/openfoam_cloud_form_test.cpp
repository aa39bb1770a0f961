// SPDX-License-Identifier: BSD-3-Clause
// Clouds of cases as series of particles.
#include <gtest/gtest.h>

#include <cmath>

#include "openfoam_samples.hpp"
#include "readers/openfoam_case.hpp"
#include "readers/openfoam_survey.hpp"
#include "readers/series.hpp"

namespace bedscope::readers {
namespace {

using namespace samples;

// A case without a mesh: `parcels` of diameter 2 mm on a line, at each time.
void write_cloud(const Folder& folder, const std::string& time, int parcels,
                 const std::string& cloud = "kinematicCloud") {
  std::string rows;
  for (int p = 0; p < parcels; ++p) rows += fmt::format("({} 0 {}) 0\n", p, time);
  const auto at = fmt::format("{}/lagrangian/{}/", time, cloud);
  folder.write(at + "positions",
               header("Cloud<parcel>") + fmt::format("{}(\n{})\n", parcels, rows));
  folder.write(at + "d", header("scalarField") + fmt::format("{}{{0.002}}\n", parcels));
  std::string ids;
  for (int p = 0; p < parcels; ++p) ids += fmt::format("{} ", p);
  folder.write(at + "origId", header("labelField") + fmt::format("{}({})\n", parcels, ids));
}

Snapshot read(const Series& series, std::size_t i, const Request& request) {
  Snapshot snapshot;
  Scratch scratch;
  series.read(i, request, snapshot, scratch);
  return snapshot;
}

TEST(CloudForm, TimesAreSnapshotsInTheOrderOfTime) {
  const Folder folder;
  for (const auto* time : {"10", "2", "1e-05"}) write_cloud(folder, time, 3);
  const auto series = Series::open(folder.path());
  EXPECT_EQ(series.form().name, "openfoam-cloud");
  ASSERT_EQ(series.size(), 3U);
  EXPECT_EQ(series.time(0), 1e-05);
  EXPECT_EQ(series.time(1), 2);
  EXPECT_EQ(series.time(2), 10);
  EXPECT_EQ(series.step(2), 2);
  EXPECT_EQ(series.columns(), (std::vector<std::string>{"x", "y", "z", "d", "origId"}));
  const auto last = read(series, 2, {{"x"}, {"z"}, {"radius"}, {"vx", false}});
  EXPECT_EQ(last.time, 10);
  EXPECT_EQ(last.columns[0], (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(last.columns[1], (std::vector<double>{10, 10, 10}));
  EXPECT_EQ(last.columns[2], (std::vector<double>{0.001, 0.001, 0.001}));
  EXPECT_TRUE(last.columns[3].empty());
  EXPECT_NE(series.place(2, 7).find("time 10: kinematicCloud: parcel 7"), std::string::npos);
}

TEST(CloudForm, OneOfSeveralCloudsIsNamedBehindTheCase) {
  const Folder folder;
  write_cloud(folder, "1", 2, "coal");
  write_cloud(folder, "1", 5, "limestone");
  write_cloud(folder, "1", 7, "referredParticleCloud");
  const auto error = error_of([&] { Series::open(folder.path()); });
  EXPECT_NE(error.find("several clouds (coal, limestone), name one: "), std::string::npos) << error;
  EXPECT_EQ(Series::open(folder.path("limestone")).located(0).particles, 5);
  EXPECT_EQ(Series::open(folder.path("coal/")).located(0).particles, 2);
  EXPECT_NE(error_of([&] { Series::open(folder.path("peat")); }).find("no such file"),
            std::string::npos);
}

TEST(CloudForm, CloudOfARegionIsNamedBehindIt) {
  const Folder folder;
  folder.copy(data / "ascii/constant/polyMesh", "constant/bed/polyMesh");
  write_cloud(folder, "1", 4);
  fs::create_directories(folder.path("1/bed"));
  fs::rename(folder.path("1/lagrangian"), folder.path("1/bed/lagrangian"));
  for (const auto* name : {"bed", "bed/kinematicCloud"}) {
    const auto series = Series::open(folder.path(name));
    EXPECT_EQ(series.located(0).particles, 4);
    EXPECT_TRUE(series.located(0).box.known);
  }
}

// No parcels, no folder: but the solver leaves the state of a cloud that it has.
TEST(CloudForm, TimeWithoutParcelsIsASnapshotOnlyIfTheSolverHadTheCloud) {
  const Folder folder;
  for (const auto* time : {"1", "3", "5"}) write_cloud(folder, time, 3);
  const auto state = [&](const char* time) {
    folder.write(fmt::format("{}/uniform/lagrangian/kinematicCloud/cloudProperties", time),
                 header("dictionary"));
    fs::create_directories(folder.path(fmt::format("{}/lagrangian", time)));
  };
  state("2");
  fs::create_directories(folder.path("0/lagrangian"));
  fs::create_directories(folder.path("4/lagrangian"));
  const auto series = Series::open(folder.path());
  ASSERT_EQ(series.size(), 4U);  // 1 2 3 5
  EXPECT_EQ(series.time(1), 2);
  EXPECT_EQ(series.located(1).particles, 0);
  const auto empty = read(series, 1, {{"x"}, {"radius"}});
  EXPECT_EQ(empty.particles, 0U);
  EXPECT_TRUE(empty.columns[0].empty());
  ASSERT_EQ(series.problems().size(), 1U);
  EXPECT_NE(
      series.problems()[0].find("cloud kinematicCloud is missing at 1 of 6 times, first at 4"),
      std::string::npos)
      << series.problems()[0];
}

// Whatever analysis does with a sphere of this radius holds for the particles' volume.
TEST(CloudForm, ParcelHasTheVolumeOfItsParticlesAndItIsTold) {
  const Folder folder;
  write_cloud(folder, "1", 3);
  folder.write("1/lagrangian/kinematicCloud/nParticle", header("scalarField") + "3(1 8 20.5)\n");
  const auto series = Series::open(folder.path());
  ASSERT_EQ(series.problems().size(), 1U);
  EXPECT_NE(series.problems()[0].find("one parcel stands for 1 to 20.5 particles (nParticle)"),
            std::string::npos);
  const auto rows = read(series, 0, {{"radius"}, {"nParticle"}, {"d"}});
  for (std::size_t p = 0; p < 3; ++p)
    EXPECT_NEAR(std::pow(rows.columns[0][p] / 0.001, 3), rows.columns[1][p], 1e-13);  // rounding
  EXPECT_EQ(rows.columns[2], (std::vector<double>(3, 0.002)));                        // as on disk
  folder.write("1/lagrangian/kinematicCloud/nParticle", header("scalarField") + "3{1}\n");
  EXPECT_TRUE(Series::open(folder.path()).problems().empty());
}

// origId counts anew on every rank.
TEST(CloudForm, IdentityIsTheIdAndTheRankThatGaveIt) {
  const Folder folder;
  write_cloud(folder, "1", 3);
  folder.write("1/lagrangian/kinematicCloud/origId", header("labelField") + "3(5 5 6)\n");
  folder.write("1/lagrangian/kinematicCloud/origProcId", header("labelField") + "3(0 1 0)\n");
  const auto rows = read(Series::open(folder.path()), 0, {{"id"}, {"origId"}});
  EXPECT_EQ(rows.columns[0], (std::vector<double>{5, 4294967301, 6}));
  EXPECT_EQ(rows.columns[1], (std::vector<double>{5, 5, 6}));
}

TEST(CloudForm, LastTimeThatIsCutOrLacksAFileIsLeftOutAndTold) {
  for (const bool missing : {false, true}) {
    const Folder folder;
    for (const auto* time : {"1", "2"}) write_cloud(folder, time, 3);
    if (missing)
      fs::remove(folder.path("2/lagrangian/kinematicCloud/d"));
    else
      folder.write("2/lagrangian/kinematicCloud/origId", header("labelField") + "3(0 1");
    const auto series = Series::open(folder.path());
    EXPECT_EQ(series.size(), 1U);
    ASSERT_EQ(series.problems().size(), 1U);
    EXPECT_NE(series.problems()[0].find("time 2 is left out: "), std::string::npos)
        << series.problems()[0];
    fs::remove_all(folder.path("1"));
    const auto alone = Series::open(folder.path());
    if (!missing) {
      EXPECT_NE(error_of([&] { read(alone, 0, {{"id"}}); }).find("origId"), std::string::npos);
    }
  }
}

// A header alone ends like a whole file, nearly: "// * * * //".
TEST(CloudForm, LastTimeThatIsCutBehindAHeaderOrEndsInNulBytesIsLeftOutToo) {
  const std::string footer = "\n// " + std::string(73, '*') + " //\n";
  for (const auto& tail : {std::string("// * * * * * //\n"), std::string(300, '\0')}) {
    const Folder folder;
    for (const auto* time : {"1", "2"}) {
      write_cloud(folder, time, 3);
      for (const auto* name : {"positions", "d", "origId"}) {
        const auto path = fmt::format("{}/lagrangian/kinematicCloud/{}", time, name);
        folder.write(path, bytes_of(folder.path(path)) + footer);
      }
    }
    EXPECT_EQ(Series::open(folder.path()).size(), 2U);
    folder.write("2/lagrangian/kinematicCloud/d", header("scalarField") + tail);
    const auto series = Series::open(folder.path());
    EXPECT_EQ(series.size(), 1U);
    ASSERT_EQ(series.problems().size(), 1U);
    EXPECT_NE(series.problems()[0].find("time 2 is left out: "), std::string::npos)
        << series.problems()[0];
  }
}

// Three parcels on each of two ranks, at two times.
void write_ranks(const Folder& folder) {
  folder.write("system/controlDict", header("dictionary"));
  for (const auto* rank : {"processor0", "processor1"})
    for (const auto* time : {"1", "2"}) {
      write_cloud(folder, time, 3);
      fs::create_directories(folder.path(fmt::format("{}/{}", rank, time)));
      fs::rename(folder.path(fmt::format("{}/lagrangian", time)),
                 folder.path(fmt::format("{}/{}/lagrangian", rank, time)));
      fs::remove_all(folder.path(time));
    }
}

TEST(CloudForm, RankWithoutParcelsMayHaveNoFields) {
  for (const bool positions : {false, true}) {
    const Folder folder;
    write_ranks(folder);
    for (const auto* time : {"1", "2"}) {
      const auto cloud = fmt::format("processor0/{}/lagrangian/kinematicCloud", time);
      fs::remove_all(folder.path(cloud));
      fs::create_directories(folder.path(cloud));
      if (positions) folder.write(cloud + "/positions", header("Cloud<parcel>") + "0()\n");
    }
    const auto series = Series::open(folder.path());
    ASSERT_EQ(series.size(), 2U);
    EXPECT_TRUE(series.problems().empty());
    const auto rows = read(series, 1, {{"radius"}});
    EXPECT_EQ(rows.columns[0], (std::vector<double>(3, 0.001)));
  }
}

TEST(CloudForm, FileThatOneRankLacksIsAnErrorAndOfTheLastTimeLeavesItOut) {
  for (const auto* name : {"positions", "d"}) {
    const Folder folder;
    write_ranks(folder);
    fs::remove(folder.path(fmt::format("processor1/2/lagrangian/kinematicCloud/{}", name)));
    const auto series = Series::open(folder.path());
    EXPECT_EQ(series.size(), 1U) << name;
    ASSERT_EQ(series.problems().size(), 1U) << name;
    EXPECT_NE(series.problems()[0].find("time 2 is left out: "), std::string::npos);
    EXPECT_NE(series.problems()[0].find("no such file"), std::string::npos) << series.problems()[0];
    fs::remove(folder.path(fmt::format("processor0/1/lagrangian/kinematicCloud/{}", name)));
    EXPECT_NE(
        error_of([&] { read(Series::open(folder.path()), 0, {{"radius"}}); }).find("no such file"),
        std::string::npos)
        << name;
  }
}

TEST(CloudForm, FieldsNamedLikeACoordinateDoNotHideThePositions) {
  const Folder folder;
  write_cloud(folder, "1", 3);
  folder.write("1/lagrangian/kinematicCloud/x", header("scalarField") + "3{7}\n");
  EXPECT_EQ(read(Series::open(folder.path()), 0, {{"x"}}).columns[0],
            (std::vector<double>{0, 1, 2}));
}

TEST(CloudForm, SurveyReadsEveryFileAndTellsOneThatIsMissing) {
  const Folder folder;
  for (const auto* time : {"1", "2", "3"}) write_cloud(folder, time, 3);
  const auto look = [&] {
    return survey(OpenFoamCase::open(folder.path(), {.mesh_optional = true}), true);
  };
  EXPECT_TRUE(look().problems.empty());
  fs::remove(folder.path("2/lagrangian/kinematicCloud/d"));
  const auto found = look();
  ASSERT_EQ(found.problems.size(), 1U);
  EXPECT_EQ(found.problems[0],
            "kinematicCloud: time 2: lacks d diameter, which earlier times have");
  folder.write("2/lagrangian/kinematicCloud/origId", header("labelField") + "3(0 1");
  EXPECT_NE(error_of(look).find("origId"), std::string::npos);
}

TEST(CaseSurvey, ValuesThatNoFlowHasAreDoubted) {
  const Folder folder;
  folder.copy(data / "ascii");
  const auto look = [&] { return survey(OpenFoamCase::open(folder.path()), true).problems; };
  EXPECT_TRUE(look().empty());
  folder.write("0.003/p", header("volScalarField") +
                              "dimensions [0 2 -2 0 0 0 0]; internalField uniform -3e150;\n"
                              "boundaryField {}\n");
  const auto problems = look();
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(problems[0].find("p: values up to 3e+150 are implausible"), std::string::npos);
}

TEST(CloudForm, CaseWithoutACloudSaysSo) {
  const auto error = error_of([] { Series::open((data / "ascii").string()); });
  EXPECT_NE(error.find("an OpenFOAM case without a Lagrangian cloud"), std::string::npos) << error;
}

// The same run whole, decomposed, collated: the same particles, whatever their order.
TEST(CloudForm, ContainersOfOneRunHoldTheSameParticles) {
  if (!corpus_there()) GTEST_SKIP() << "no corpus beside the project";
  const auto sums = [](const std::string& name) {
    const auto series = Series::open((shared / "corpus/made/openfoam" / name).string());
    EXPECT_EQ(series.size(), 3U) << name;
    EXPECT_TRUE(series.problems().empty()) << series.problems()[0];
    std::vector<double> found;
    for (std::size_t i = 0; i < series.size(); ++i) {
      const auto rows = read(series, i, {{"x"}, {"z"}, {"vz"}, {"radius"}, {"density"}, {"id"}});
      found.push_back(static_cast<double>(rows.particles));
      EXPECT_TRUE(rows.box.known);
      EXPECT_EQ(rows.box.max[2], 0.45);
      for (std::size_t k = 1; k < 5; ++k) {
        double sum = 0;
        for (const double x : rows.columns[k]) sum += x;
        found.push_back(sum);
      }
      auto ids = rows.columns[5];
      std::sort(ids.begin(), ids.end());
      EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end()) << name;
    }
    return found;
  };
  const auto whole = sums("of_reconstructed");
  for (const auto* name : {"of_dec_binary", "of_coll_binary"}) {
    const auto ranks = sums(name);
    ASSERT_EQ(ranks.size(), whole.size());
    // Another order of summation; 300 terms.
    for (std::size_t k = 0; k < whole.size(); ++k)
      EXPECT_NEAR(ranks[k], whole[k], 1e-12 * (1 + std::abs(whole[k]))) << name << " " << k;
  }
}

TEST(CloudForm, CfdemWritesItsCloudInTwoPlaces) {
  if (!corpus_there()) GTEST_SKIP() << "no corpus beside the project";
  const auto made = shared / "corpus/made/cfdem";
  const auto parallel = Series::open((made / "CFD").string());
  ASSERT_EQ(parallel.size(), 3U);  // time 0 knows no cloud
  EXPECT_EQ(parallel.time(0), 0.05);
  for (const auto* name : {"CFD_serialOutput", "CFD_serialOutput/lagrangian"}) {
    const auto serial = Series::open((made / name).string());
    ASSERT_EQ(serial.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(serial.time(i), parallel.time(i));
      const Request request{{"x"}, {"vz"}, {"radius"}};
      EXPECT_EQ(read(serial, i, request).columns, read(parallel, i, request).columns);
    }
  }
}

}  // namespace
}  // namespace bedscope::readers
