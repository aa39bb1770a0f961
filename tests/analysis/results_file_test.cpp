// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/results_file.hpp"

#include <hdf5.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>
#include <vector>

#include "readers/error.hpp"
#include "tests/analysis/example_result.hpp"

namespace bedscope::analysis {
namespace {

// Debian's Python, whose h5py and VTK are packages beside ours, or the one on the path.
void judge(const std::string& what, const std::filesystem::path& file) {
  const std::string debian = "/usr/bin/python3";
  const std::string python = std::filesystem::exists(debian) ? debian : "python3";
  const std::string command = python +
                              " " BEDSCOPE_SOURCE "/tests/analysis/results_file_judge.py " + what +
                              " '" + file.string() + "'";
  const int status = std::system(command.c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code == 77 || code == 127) GTEST_SKIP() << "needs Python with h5py and VTK";
  EXPECT_EQ(code, 0) << command;
}

std::vector<RunResult> two_runs() {
  std::vector<RunResult> runs{example_run("K = 1"), example_run("K/2 é")};
  runs[1].time_known = runs[1].density_known = false;
  return runs;
}

TEST(ResultsFile, IsReadByH5py) {
  const TestFolder folder;
  write_results_file(two_runs(), folder / "results.h5");
  judge("h5py", folder / "results.h5");
}

TEST(ResultsFile, IsAnImageToVtk) {
  const TestFolder folder;
  write_results_file(two_runs(), folder / "results.h5");
  judge("vtk", folder / "results.h5");
}

TEST(ResultsFile, IsReadByTheExamplesOfTheGuide) {
  const TestFolder folder;
  write_results_file(two_runs(), folder / "results.h5");
  judge("guide", folder / "results.h5");
}

TEST(ResultsFile, HasRunsOnAnotherGridInAFileBeside) {
  const TestFolder folder;
  std::vector<RunResult> runs{example_run("first"), example_run("other grid")};
  runs[1].grid.cells = {3, 2, 2};  // 12 cells too
  runs[1].frames.clear();
  write_results_file(runs, folder / "results.h5");
  judge("both-grids", folder / "results.h5");
  runs[1].grid = runs[0].grid;
  write_results_file(runs, folder / "results.h5");
  EXPECT_FALSE(exists(folder / "results_2.h5")) << "of the earlier analysis";
}

TEST(ResultsFile, OfTheSameResultsIsTheSameToTheBit) {
  const TestFolder folder;
  write_results_file(two_runs(), folder / "a.h5");
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5's dates are in seconds
  write_results_file(two_runs(), folder / "b.h5");
  EXPECT_EQ(content(folder / "a.h5"), content(folder / "b.h5"));
}

TEST(ResultsFile, OfNothingIsAFile) {
  const TestFolder folder;
  RunResult run;  // as read from tables: no fields, no rows
  write_results_file(std::vector{run}, folder / "results.h5");
  EXPECT_GT(file_size(folder / "results.h5"), 0u);
}

TEST(ResultsFile, StoresLargeArraysCompressed) {
  const TestFolder folder;
  RunResult run = example_run("run");
  run.clusters.resize(100'000, run.clusters[0]);
  write_results_file(std::vector{run}, folder / "results.h5");
  // 17 columns of 0.8 MB, three parts of contours: 23 MB as they are
  EXPECT_LT(file_size(folder / "results.h5"), 2'000'000u);
  const hid_t file = H5Fopen((folder / "results.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t area = H5Dopen2(file, "/runs/1/clusters/area", H5P_DEFAULT);
  std::vector<double> values(100'000);
  ASSERT_GE(H5Dread(area, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  EXPECT_EQ(values, std::vector(100'000, run.clusters[0].area));
  H5Dclose(area);
  H5Fclose(file);
}

TEST(ResultsFile, AFolderThatCannotBeWrittenIsAFileError) {
  const TestFolder folder;
  put(folder / "file", "");
  EXPECT_THROW(write_results_file(two_runs(), folder / "file" / "results.h5"), FileError);
}

TEST(ResultsFile, AFullDiskIsAnErrorAndLeavesNothing) {
  const TestFolder folder;
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small{20'000, limit.rlim_max};  // [bytes], less than the file needs
  setrlimit(RLIMIT_FSIZE, &small);
  testing::internal::CaptureStderr();
  std::string message;
  try {
    write_results_file(two_runs(), folder / "results.h5");
  } catch (const FileError& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &limit);
  EXPECT_EQ(message, (folder / "results.h5").string() + ": File too large");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace
}  // namespace bedscope::analysis
