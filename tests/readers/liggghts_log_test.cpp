// SPDX-License-Identifier: BSD-3-Clause
// What log.liggghts tells: time step and densities.
#include "readers/liggghts_log.hpp"

#include "tests/readers/test_files.hpp"

namespace bedscope::readers {
namespace {

// As LIGGGHTS echoes its script: commands with their tabs, and again with variables put in.
const std::string example =
    "LIGGGHTS (Version LIGGGHTS-PUBLIC 3.8.0)\n"
    "timestep\t${dt}\n"
    "timestep\t0.00001\n"
    "fix\t\tpts1 all particletemplate/sphere 15485863 atom_type 1 density constant 2500 radius "
    "constant 0.003\n"
    "fix\t\tpts2 all particletemplate/sphere 15485867 atom_type 2 density constant ${rho}  radius "
    "constant 0.0045\n"
    "fix\t\tpts2 all particletemplate/sphere 15485867 atom_type 2 density constant 7800  radius "
    "constant 0.0045\n"
    "fix m1 all property/global youngsModulus peratomtype 5.e6 5.e6\n"
    "    Step    Atoms         KinEng\n"
    "       1        0              0\n";

LiggghtsLog log_of(const std::string& text) {
  const TemporaryFolder folder;
  return read_log(folder.write("log.liggghts", text));
}

TEST(LiggghtsLog, TheTimeStepAndTheDensityOfEachTypeAreFound) {
  const auto log = log_of(example);
  EXPECT_EQ(log.time_step, 1e-5);
  EXPECT_FALSE(log.several_time_steps);
  EXPECT_EQ(log.density, (std::map<int, double>{{1, 2500}, {2, 7800}}));
  const auto windows = log_of(replaced(example, "\n", "\r\n"));
  EXPECT_EQ(windows.time_step, 1e-5);
  EXPECT_EQ(windows.density.size(), 2U);
}

TEST(LiggghtsLog, TheLastOfSeveralTimeStepsIsTakenAndSaid) {
  const auto log = log_of(example + "timestep 2e-6\n");
  EXPECT_EQ(log.time_step, 2e-6);
  EXPECT_TRUE(log.several_time_steps);
  EXPECT_FALSE(log_of(example + "timestep 1e-5\n").several_time_steps);
}

TEST(LiggghtsLog, DensitiesThatAreNotConstantAreNotKnown) {
  EXPECT_TRUE(log_of("fix p all particletemplate/sphere 1 atom_type 1 density uniform 2000 3000 "
                     "radius constant 1\n")
                  .density.empty());
  EXPECT_TRUE(
      log_of("fix p all particletemplate/sphere 1 atom_type 1 density constant\n").density.empty());
  EXPECT_TRUE(log_of("fix p all particletemplate/sphere 1 atom_type 1e99 density constant 2500\n")
                  .density.empty());
  EXPECT_TRUE(log_of("fix p all particletemplate/sphere 1 atom_type 0 density constant 2500\n")
                  .density.empty());
  EXPECT_TRUE(log_of("fix p all particletemplate/sphere 1 atom_type nan density constant 2500\n")
                  .density.empty());
}

TEST(LiggghtsLog, VersionUnitsGravityMaterialAndRadiiAreFound) {
  const auto log = log_of(
      example +
      "units ${units}\nunits cgs\nfix g all gravity 9.81 vector 0.0 -2.0 0.0\n"
      "fix p all particletemplate/sphere 7 atom_type 1 density constant 2500 radius constant .004\n"
      "fix m2 all property/global kn peratomtypepair 2 1e3 2e3 2e3 4e3\n");
  EXPECT_EQ(log.version, "LIGGGHTS-PUBLIC 3.8.0");
  EXPECT_EQ(log.units, "cgs");
  ASSERT_TRUE(log.gravity);
  EXPECT_EQ(*log.gravity, (std::array{0., -9.81, 0.}));
  EXPECT_EQ(log.properties.at("youngsModulus"), (std::vector{5e6, 5e6}));
  EXPECT_EQ(log.properties.at("kn"), (std::vector{1e3, 2e3, 2e3, 4e3}));
  EXPECT_EQ(log.radius.at(1), (std::array{.003, .004}));  // two templates of one type
  EXPECT_EQ(log.radius.at(2), (std::array{.0045, .0045}));
  EXPECT_FALSE(log_of("fix g all gravity 9.81 vector 0 0 0\n").gravity);
}

TEST(LiggghtsLog, TheLastStepIsThatOfTheLastTableAndLoopTimeEndsIt) {
  const std::string first = example + "    1000    0    0\nLoop time of 2 on 4 procs\n";
  EXPECT_FALSE(log_of(example).ended);
  EXPECT_EQ(log_of(example).last_step, 1);
  EXPECT_TRUE(log_of(first).ended);
  EXPECT_EQ(log_of(first).last_step, 1000);
  // Thermo output may begin with any column, and words such as Step occur elsewhere.
  const auto second = first + "Histogram: 1 0 0\n# Step 2: settle\n  Atoms  Step  CPU\n";
  EXPECT_TRUE(log_of(second).ended);
  EXPECT_EQ(log_of(second).last_step, 1000);
  EXPECT_FALSE(log_of(second + "  57  2500  0.1\n").ended);
  EXPECT_EQ(log_of(second + "  57  2500  0.1\nWARNING: x\n  57  2600  0.2\n").last_step, 2600);
  EXPECT_FALSE(log_of("").last_step);
}

TEST(LiggghtsLog, WarningsAndErrorsAreCountedAndTheFirstIsQuoted) {
  const auto log = log_of(
      "INFO: no WARNING here\nWARNING: \n\n\tThe model is slow.\nWARNING: two\n"
      "ERROR: Lost atoms: original 10 current 9 (thermo.cpp:400)\n");
  EXPECT_EQ(log.warnings.count, 2);
  EXPECT_EQ(log.warnings.line, 2);
  EXPECT_EQ(log.warnings.first, "The model is slow.");
  EXPECT_EQ(log.errors.count, 1);
  EXPECT_EQ(log.errors.line, 6);
  EXPECT_TRUE(log.errors.first.starts_with("Lost atoms"));
}

TEST(LiggghtsLog, ALogWithoutCommandsOrOfBytesTellsNothing) {
  for (const auto& text : {std::string(), std::string("timestep\n"), std::string(100'000, '\0'),
                           std::string(300'000, 'x')}) {
    const auto log = log_of(text);
    EXPECT_FALSE(log.time_step.has_value());
    EXPECT_TRUE(log.density.empty());
  }
}

TEST(LiggghtsLog, IsLookedForBesideTheDumpAndOneFolderUp) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path("case/post"));
  const auto dump = folder.write("case/post/dump1", small_dump(1, 1));
  EXPECT_TRUE(find_log(dump).path.empty());
  folder.write("log.liggghts", example);
  EXPECT_TRUE(find_log(dump).path.empty());  // two folders up is another case
  folder.write("case/log.liggghts", "timestep 1\n");
  EXPECT_EQ(find_log(dump).time_step, 1);
  folder.write("case/post/log.liggghts", "timestep 2\n");
  EXPECT_EQ(find_log(dump).time_step, 2);
}

}  // namespace
}  // namespace bedscope::readers
