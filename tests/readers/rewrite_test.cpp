// SPDX-License-Identifier: BSD-3-Clause
// A snapshot in another form is what that form can hold.
#include "readers/rewrite.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "readers/series.hpp"

namespace bedscope::readers {
namespace {

const Request request{{"x"},  {"y"},      {"z"},    {"vx"},         {"vy"},
                      {"vz"}, {"radius"}, {"type"}, {"none", false}};

Snapshot particles() {
  Snapshot snapshot;
  snapshot.step = 4000;
  snapshot.particles = 500;
  snapshot.columns.resize(request.size());
  for (std::size_t k = 0; k < 8; ++k)
    for (std::size_t i = 0; i < snapshot.particles; ++i)
      snapshot.columns[k].push_back(k == 7 ? 1. + static_cast<double>(i % 2)
                                           : std::exp(0.001 * static_cast<double>(i)) *
                                                 std::sin(static_cast<double>(i + 7 * k)));
  return snapshot;
}

class Rewrite : public ::testing::TestWithParam<DumpForm> {};

TEST_P(Rewrite, GivesBackWhatTheFormHolds) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("bedscope_rewrite_" + std::to_string(::getpid()) +
                                                "_" + std::to_string(static_cast<int>(GetParam())));
  std::filesystem::create_directories(folder);
  const auto path = folder / "dump4000.x";
  auto expected = particles();
  write_dump(path, GetParam(), expected, request);
  SeriesOptions options;
  if (GetParam() == DumpForm::binary)
    options.columns = {"x", "y", "z", "vx", "vy", "vz", "radius", "type"};
  const auto series = Series::open(path.string(), options);
  ASSERT_EQ(series.size(), 1U);
  EXPECT_EQ(series.step(0), 4000);
  Snapshot found;
  Scratch scratch;
  series.read(0, request, found, scratch);
  std::filesystem::remove_all(folder);
  round_as(GetParam(), expected);
  for (std::size_t k = 0; k < 8; ++k)
    for (std::size_t i = 0; i < found.particles; ++i)
      EXPECT_NEAR(found.columns[k][i], expected.columns[k][i],
                  GetParam() == DumpForm::text ? 1e-15 : 0)
          << request[k].name << " " << i;
  EXPECT_TRUE(found.columns[8].empty());
}

INSTANTIATE_TEST_SUITE_P(Forms, Rewrite,
                         ::testing::Values(DumpForm::text, DumpForm::binary, DumpForm::vtk));

TEST(Rewrite, RoundsToTheDigitsOfTheForm) {
  Snapshot snapshot;
  snapshot.columns = {{1.23456789, -0.000123456789, 0, 123456789}};
  auto text = snapshot, vtk = snapshot;
  round_as(DumpForm::text, text);
  EXPECT_DOUBLE_EQ(text.columns[0][0], 1.23457);
  EXPECT_DOUBLE_EQ(text.columns[0][1], -0.000123457);
  EXPECT_EQ(text.columns[0][2], 0);
  EXPECT_DOUBLE_EQ(text.columns[0][3], 123457000);
  round_as(DumpForm::vtk, vtk);
  EXPECT_EQ(vtk.columns[0][0], 1.23456789F);
}

}  // namespace
}  // namespace bedscope::readers
