// SPDX-License-Identifier: BSD-3-Clause
// Binary dumps, of LIGGGHTS and of newer LAMMPS: what is stored is read to the bit, what is not is
// asked for.
#include <cstring>

#include "readers/series.hpp"
#include "readers/survey.hpp"
#include "tests/readers/bin_dump.hpp"
#include "tests/readers/test_files.hpp"

namespace bedscope::readers {
namespace {

const fs::path data = BEDSCOPE_TEST_DATA;
const SeriesOptions names{.columns = {"id", "x", "y", "z"}};

Snapshot read(const Series& series, std::size_t i, const std::vector<std::string>& wanted) {
  Snapshot snapshot;
  Scratch scratch;
  series.read(i, request_of(wanted), snapshot, scratch);
  return snapshot;
}

TEST(LiggghtsBin, NumbersAreReadToTheBitInTheOrderOfTheChunks) {
  const TemporaryFolder folder;
  const auto path = folder.write("d.bin", bin_dump({.step = 7, .chunks = {3, 0, 40'000, 1}}));
  const auto series = Series::open(path, names);
  EXPECT_EQ(series.step(0), 7);
  const auto snapshot = read(series, 0, {"id", "z", "x"});
  ASSERT_EQ(snapshot.particles, 40'004U);
  for (std::size_t row = 0; row < snapshot.particles; ++row) {
    EXPECT_EQ(snapshot.columns[0][row], bin_value(row, 0));
    EXPECT_EQ(snapshot.columns[1][row], bin_value(row, 3));
    EXPECT_EQ(snapshot.columns[2][row], bin_value(row, 1));
  }
  EXPECT_EQ(snapshot.bytes_read, fs::file_size(path) + 1);  // the byte that asks for the end
}

TEST(LiggghtsBin, ManySnapshotsInOneFileAndInGzip) {
  const TemporaryFolder folder;
  std::string content;
  for (const int step : {0, 10, 20}) content += bin_dump({.step = step, .chunks = {step, 2}});
  for (const auto& path : {folder.write("a.bin", content), folder.write("b.bin", gzip(content))}) {
    const auto series = Series::open(path, names);
    ASSERT_EQ(series.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(series.step(i), static_cast<std::int64_t>(10 * i));
      EXPECT_EQ(series.particles(i), static_cast<std::int64_t>(10 * i + 2));
      EXPECT_EQ(read(series, i, {"y"}).columns[0].back(), bin_value(10 * i + 1, 2));
    }
    EXPECT_TRUE(series.problems().empty());
  }
}

TEST(LiggghtsBin, BoxAndBoundariesAreThoseOfTheText) {
  const TemporaryFolder folder;
  const auto box =
      Series::open(folder.write("a", bin_dump({.boundary = {0, 0, 1, 1, 3, 3}}))).located(0).box;
  EXPECT_EQ(box.min, (std::array<double, 3>{-1, -2, -3}));
  EXPECT_EQ(box.max, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(box.periodic, (std::array<bool, 3>{true, false, false}));
  EXPECT_TRUE(box.shrink_wrapped);
  const auto tilted = Series::open(folder.write("b", bin_dump({.triclinic = 1}))).located(0).box;
  EXPECT_EQ(tilted.tilt, (std::array<double, 3>{0.5, 0.25, 0.125}));
}

TEST(LiggghtsBin, WithoutNamesOneCanLookButNotAnalyse) {
  const auto path = (data / "liggghts_parallel" / "gather1000.bin").string();
  const auto series = Series::open(path);
  EXPECT_FALSE(series.named());
  EXPECT_EQ(series.columns().size(), 6U);
  EXPECT_EQ(series.columns().back(), "column 6");
  const auto found = survey(series, true);
  EXPECT_EQ(found.particles[0], 304);
  EXPECT_EQ(found.snapshots_read, 0U);
  EXPECT_FALSE(found.has_particles);
  EXPECT_EQ(error_of([&] { Series::open(path, {.names_needed = true}); }),
            path +
                ": a binary dump names no columns: expected their names, columns = [...] in the "
                "[[run]]");
  EXPECT_EQ(error_of([&] { Series::open(path, names); }),
            path + ": 6 columns, but columns = [...] names 4");
}

TEST(LiggghtsBin, NewerLammpsNamesItsColumns) {
  const TemporaryFolder folder;
  const auto series =
      Series::open(folder.write("d", bin_dump({.step = 5, .revision = 2, .time = 0.125})));
  EXPECT_TRUE(series.named());
  EXPECT_EQ(series.columns(), (std::vector<std::string>{"id", "x", "y", "z"}));
  EXPECT_EQ(series.step(0), 5);
  EXPECT_EQ(series.time(0), 0.125);
  EXPECT_EQ(read(series, 0, {"z"}).columns[0].back(), bin_value(2, 3));
  EXPECT_FALSE(Series::open(folder.write("e", bin_dump({.revision = 1}))).named());
  auto other = bin_dump({.revision = 2});
  std::swap(other[18], other[21]);  // the mark of the byte order
  EXPECT_NE(error_of([&] { Series::open(folder.write("f", other)); }).find("other byte order"),
            std::string::npos);
}

TEST(LiggghtsBin, ACutLastSnapshotIsLeftOutAndSaid) {
  const TemporaryFolder folder;
  const auto one = bin_dump({.step = 1}), two = bin_dump({.step = 2});
  for (std::size_t size = 1; size < two.size(); ++size) {
    const auto series = Series::open(folder.write("d", one + two.substr(0, size)), names);
    EXPECT_EQ(series.size(), 1U);
    EXPECT_TRUE(series.cut()) << size;
    EXPECT_EQ(read(series, 0, {"x"}).particles, 3U);
  }
  const auto zeros = Series::open(folder.write("d", one + std::string(5000, '\0')), names);
  EXPECT_EQ(zeros.size(), 1U);
  EXPECT_TRUE(zeros.cut());
}

TEST(LiggghtsBin, AStepThatOccursTwiceIsToldWithBothOffsets) {
  const TemporaryFolder folder;
  const auto one = bin_dump({.step = 5});
  const auto path = folder.write("all.bin", one + one);
  EXPECT_EQ(error_of([&] { Series::open(path); }),
            fmt::format("{} (offset {}): step 5 occurs twice, also in {} (offset 0): say repeated "
                        "= \"first\" or \"last\", or name one dump with a pattern",
                        path, one.size(), path));
}

TEST(LiggghtsBin, ColumnsThatAreDoubledMustAgree) {
  const TemporaryFolder folder;
  const auto path = folder.write("d", bin_dump({}));
  const auto series = Series::open(path, {.columns = {"id", "x", "x", "z"}});
  EXPECT_NE(error_of([&] { read(series, 0, {"x"}); }).find("column \"x\" twice"),
            std::string::npos);
}

TEST(LiggghtsBin, ColumnsThatTheDumpNamesItselfWin) {
  const TemporaryFolder folder;
  const auto series = Series::open(folder.write("d", small_dump(1, 3)), names);
  EXPECT_EQ(series.columns().size(), 6U);
  ASSERT_EQ(series.problems().size(), 1U);
  EXPECT_NE(series.problems()[0].find("columns = [...] is not used"), std::string::npos);
}

TEST(LiggghtsBin, TextDumpsWithoutNamesTakeTheSameNames) {
  const TemporaryFolder folder;
  const auto text =
      replaced(dump_header(3, 2, "id x y z"), " id x y z ", "") + "1 0.5 2 3 \n2 0.25 2 3 \n";
  const auto path = folder.write("d", text + replaced(text, "\n3\n", "\n4\n"));
  EXPECT_EQ(error_of([&] { Series::open(path); }),
            path +
                ": line 9: \"ITEM: ATOMS\" without column names (LAMMPS before 2010): expected "
                "their names, columns = [...] in the [[run]]");
  const auto series = Series::open(path, names);
  ASSERT_EQ(series.size(), 2U);
  EXPECT_EQ(read(series, 1, {"x"}).columns[0], (std::vector<double>{0.5, 0.25}));
  folder.write("d", replaced(text, "2 0.25 2 3", "2 0.25 2"));
  EXPECT_NE(error_of([&] {
              read(Series::open(path, names), 0, {"x"});
            }).find("line 11: 4 values expected (line 9), 3 found"),
            std::string::npos);
}

}  // namespace
}  // namespace bedscope::readers
