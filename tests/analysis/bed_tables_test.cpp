// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/bed_tables.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>

#include "analysis/results_file.hpp"
#include "analysis/tables.hpp"
#include "readers/error.hpp"
#include "tests/analysis/example_result.hpp"

namespace bedscope::analysis {
namespace {

RunResult bed_run() {
  RunResult run = example_run("a, \"b\"");
  run.bed.at_rest = 0.2;
  run.bed.samples = {{0, 0.2, 0.19, 0.21, 1}, {0.1, undefined, undefined, undefined, undefined}};
  run.bubbles.emplace();
  run.bubbles->thresholds = {0.8, 0.9, 4e-6};
  Cluster bubble = run.clusters[2];
  bubble.at_wall = true;
  bubble.angle = 0;
  bubble.area = 1e-4;
  run.bubbles->bubbles = {bubble};
  run.bubbles->bands = {{0.05, 0.1, {2, 0.5}, {0.03, 0.001}, {0.4, undefined}, {3, 1}, {0.1, 0}}};
  Fluctuation one{"p", "Pa", 40, {100, 1}, {5, 0.5}, {2.5, 0.25}, {}};
  one.spectrum = {{0, 0.25}, {1, 2}, {0.5, 1}, {2, 4}, 3, 0.25, 5.5};
  run.fluctuations = {one, {"constant", "-", 40, {0.3, 0}, {0, 0}, {}, {}}};
  return run;
}

TEST(BedTables, are_as_documented) {
  const TestFolder folder;
  write_bed_tables(std::vector{bed_run()}, folder);
  EXPECT_EQ(content(folder / "bed_height.csv"),
            "run,time [s],height [m],height_solids [m],height_surface [m],expansion [-]\n"
            "\"a, \"\"b\"\"\",0,0.2,0.19,0.21,1\n\"a, \"\"b\"\"\",0.1,nan,nan,nan,nan\n");
  EXPECT_EQ(content(folder / "bubbles.csv"),
            "run,time [s],bubble,track,x [m],z [m],area [m2],diameter [m],aspect [-],voidage "
            "[-],velocity_x [m/s],velocity_z [m/s],at_wall,parents\n"
            "\"a, \"\"b\"\"\",0.2,1,3,0.032,0.3333333333333333,1e-04,0.011283791670955126,0.5,"
            "0.25,0.75,0.75,1,1;2\n");
  EXPECT_EQ(content(folder / "bubble_profile.csv"),
            "run,height [m],band [m],bubbles [-],bubbles_ci95 [-],diameter [m],diameter_ci95 [m],"
            "velocity_z [m/s],velocity_z_ci95 [m/s],frequency [1/s],frequency_ci95 [1/s],"
            "area_fraction [-],area_fraction_ci95 [-]\n"
            "\"a, \"\"b\"\"\",0.05,0.1,2,0.5,0.03,0.001,0.4,nan,3,1,0.1,0\n");
  EXPECT_EQ(content(folder / "spectrum.csv"),
            "run,signal,unit,frequency [Hz],psd [unit2/Hz],psd_lo [unit2/Hz],psd_hi [unit2/Hz]\n"
            "\"a, \"\"b\"\"\",p,Pa,0,1,0.5,2\n\"a, \"\"b\"\"\",p,Pa,0.25,2,1,4\n");
  EXPECT_EQ(content(folder / "fluctuation.csv"),
            "run,signal,unit,samples,mean [unit],mean_ci95 [unit],std [unit],std_ci95 [unit],"
            "dominant_frequency [Hz],dominant_frequency_half_width [Hz],resolution [Hz],segments,"
            "degrees_of_freedom\n"
            "\"a, \"\"b\"\"\",p,Pa,40,100,1,5,0.5,2.5,0.25,0.25,3,5.5\n"
            "\"a, \"\"b\"\"\",constant,-,40,0.3,0,0,0,nan,nan,nan,0,nan\n");
}

TEST(BedTables, read_back_as_they_were) {
  const TestFolder folder;
  const auto written = bed_run();
  write_tables(std::vector{written}, folder);
  const auto run = read_tables(folder, written.label);
  ASSERT_EQ(run.bed.samples.size(), 2u);
  EXPECT_EQ(run.bed.samples[0].surface, 0.21);
  ASSERT_TRUE(run.bubbles);
  ASSERT_EQ(run.bubbles->bubbles.size(), 1u);
  EXPECT_EQ(run.bubbles->bubbles[0].area, 1e-4);
  EXPECT_EQ(run.bubbles->bubbles[0].track_velocity_z, 0.75);
  ASSERT_EQ(run.bubbles->bands.size(), 1u);
  EXPECT_EQ(run.bubbles->bands[0].diameter.ci95, 0.001);
  EXPECT_EQ(run.bubbles->bands[0].frequency.value, 3);
  ASSERT_EQ(run.fluctuations.size(), 2u);
  EXPECT_EQ(run.fluctuations[0].signal, "p");
  EXPECT_EQ(run.fluctuations[0].deviation.value, 5);
  EXPECT_EQ(run.fluctuations[0].dominant.value, 2.5);
}

TEST(TableWindow, OfAStudyCutsTheSeriesOfTables) {
  const TestFolder folder;
  put(folder / "bed_height.csv", "time [s],height_surface [m]\n0,9\n1,0.2\n2,0.4\n3,9\n");
  auto run = read_tables(folder, "any");
  choose_window(run, std::array{1.0, 2.0});
  EXPECT_EQ(run.window.snapshots, 2u);
  EXPECT_EQ(run.window.first, 1u);
  EXPECT_NEAR(run.bed.surface.value, 0.3, 1e-15);
  EXPECT_THROW(choose_window(run, std::array{4.0, 5.0}), InputError);
}

TEST(TableWindow, IsChosenByTheInventoryWhereTheStudySaysAuto) {
  const TestFolder folder;
  std::string rows = "time [s],particles,holdup [-]\n";
  for (int i = 0; i < 400; ++i)  // empty for 40, then fluctuating a little
    rows += fmt::format("{},1,{}\n", i, i < 40 ? 0 : 0.1 + 0.001 * std::sin(i * i));
  put(folder / "inventory.csv", rows);
  auto run = read_tables(folder, "any");
  choose_window(run, std::nullopt);
  EXPECT_GE(run.window.from, 40);
  EXPECT_LE(run.window.from, 80);  // the minimum is flat: the latest start within 10 %
  EXPECT_EQ(run.window.to, 399);
  EXPECT_TRUE(run.window.automatic);
}

TEST(BedTables, without_results_are_removed) {
  const TestFolder folder;
  write_bed_tables(std::vector{bed_run()}, folder);
  write_bed_tables(std::vector{example_run("b")}, folder);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(BedTables, are_in_the_results_file_too) {
  const TestFolder folder;
  write_results_file(std::vector{bed_run()}, folder / "results.h5");
  const auto h5 = H5Fopen((folder / "results.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(h5, 0);
  const auto values = [&](const char* name, std::size_t count) {
    std::vector<double> found(count, undefined);
    const auto set = H5Dopen2(h5, name, H5P_DEFAULT);
    EXPECT_GE(set, 0) << name;
    EXPECT_GE(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, found.data()), 0);
    H5Dclose(set);
    return found;
  };
  EXPECT_EQ(values("/runs/1/bed_height/height_surface", 2)[0], 0.21);
  EXPECT_EQ(values("/runs/1/bubbles/area", 1)[0], 1e-4);
  EXPECT_EQ(values("/runs/1/bubble_contours/points", 8)[2], 0.01);
  EXPECT_EQ(values("/runs/1/bubble_profile/frequency_ci95", 1)[0], 1);
  EXPECT_EQ(values("/runs/1/fluctuations/1/psd_hi", 2)[1], 4);
  EXPECT_EQ(values("/runs/1/fluctuations/2/std", 2)[0], 0);
  H5Fclose(h5);
}

}  // namespace
}  // namespace bedscope::analysis
