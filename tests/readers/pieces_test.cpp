// SPDX-License-Identifier: BSD-3-Clause
// Snapshots in several files: the pieces of processors, and what indices name.
// data/liggghts_parallel is one step of one run of two processes in every form that LIGGGHTS 3.8.0
// writes.
#include <map>

#include "readers/series.hpp"
#include "tests/readers/test_files.hpp"

namespace bedscope::readers {
namespace {

const fs::path data = fs::path(BEDSCOPE_TEST_DATA) / "liggghts_parallel";
const SeriesOptions bin_names{.columns = {"id", "type", "x", "y", "z", "radius"}};

Snapshot read(const Series& series, std::size_t i, const std::vector<std::string>& names) {
  Snapshot snapshot;
  Scratch scratch;
  series.read(i, request_of(names), snapshot, scratch);
  return snapshot;
}

std::vector<std::int64_t> steps_of(const Series& series) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 0; i < series.size(); ++i) steps.push_back(series.step(i));
  return steps;
}
using Steps = std::vector<std::int64_t>;

std::string all(const std::vector<std::string>& lines) {
  return fmt::format("{}", fmt::join(lines, "\n"));
}

/// Every particle of the first snapshot by its id: type, radius, position.
std::map<double, std::array<double, 5>> particles_of(const Series& series) {
  const auto s = read(series, 0, {"id", "type", "radius", "x", "y", "z"});
  std::map<double, std::array<double, 5>> particles;
  for (std::size_t i = 0; i < s.particles; ++i) {
    auto& particle = particles[s.columns[0][i]];
    for (std::size_t k = 0; k < 5; ++k) particle[k] = s.columns[k + 1][i];
  }
  return particles;
}

TEST(Pieces, OneSnapshotIsTheSameInEveryForm) {
  const auto whole = particles_of(Series::open((data / "gather1000.bin").string(), bin_names));
  ASSERT_EQ(whole.size(), 304U);
  for (const char* form : {"dump*", "split*", "sorted*", "par_1000*", "par_1000.pvtp",
                           "paru_1000.pvtu", "case_1000.vtm", "case*"}) {
    SCOPED_TRACE(form);
    const auto pattern = (data / form).string();
    const auto series =
        Series::open(pattern, std::string(form) == "split*" ? bin_names : SeriesOptions{});
    EXPECT_EQ(steps_of(series), Steps{1000});
    EXPECT_EQ(series.particles(0), 304);
    EXPECT_TRUE(series.problems().empty()) << all(series.problems());
    const auto found = particles_of(series);
    ASSERT_EQ(found.size(), whole.size());
    for (const auto& [id, particle] : whole)
      for (std::size_t k = 0; k < 5; ++k)  // text has six digits, VTK files have float
        EXPECT_NEAR(found.at(id)[k], particle[k], 5e-6 * std::abs(particle[k])) << id;
  }
}

TEST(Pieces, PlacesNameThePiece) {
  const auto series = Series::open((data / "dump*").string());
  EXPECT_EQ(series.place(0, 0), (data / "dump1000.liggghts_0: line 10").string());
  EXPECT_EQ(series.place(0, 153), (data / "dump1000.liggghts_1: line 10").string());
  const auto row = read(series, 0, {"x"}).columns[0].at(153);
  const auto text = bytes_of(data / "dump1000.liggghts_1");
  const auto first = text.find('\n', text.find("ITEM: ATOMS")) + 1;
  EXPECT_NE(text.substr(first, 30).find(fmt::format(" {} ", row)), std::string::npos);
}

TEST(Pieces, BytesOfAllPiecesAreCounted) {
  const auto series = Series::open((data / "dump*").string());
  EXPECT_EQ(read(series, 0, {"x"}).bytes_read, fs::file_size(data / "dump1000.liggghts_0") +
                                                   fs::file_size(data / "dump1000.liggghts_1"));
}

/// A dump of particles first .. last at (id, 0, step).
std::string piece(std::int64_t step, int first, int last) {
  auto text = dump_header(step, static_cast<std::size_t>(last - first + 1), "id x y z");
  for (int id = first; id <= last; ++id) text += fmt::format("{} {} 0 {} \n", id, id, step);
  return text;
}

TEST(Pieces, AreJoinedStepByStepInTheOrderOfTheirNumbers) {
  for (const char* name : {"dump{}.txt_{}", "dump{:08d}_{}.txt", "dump.{}.{}"}) {
    SCOPED_TRACE(name);
    const TemporaryFolder folder;
    for (const int step : {500, 1000, 10000})
      for (int k = 0; k < 12; ++k)
        folder.write(fmt::format(fmt::runtime(name), step, k), piece(step, 10 * k, 10 * k + 9));
    const auto series = Series::open(folder.path());
    EXPECT_EQ(steps_of(series), (Steps{500, 1000, 10000}));
    EXPECT_TRUE(series.problems().empty()) << all(series.problems());
    for (std::size_t i = 0; i < 3; ++i) {
      const auto snapshot = read(series, i, {"id", "z"});
      ASSERT_EQ(snapshot.particles, 120U);
      for (std::size_t row = 0; row < 120; ++row) {
        EXPECT_EQ(snapshot.columns[0][row], static_cast<double>(row));
        EXPECT_EQ(snapshot.columns[1][row], static_cast<double>(series.step(i)));
      }
    }
  }
}

TEST(Pieces, MayHaveTheirNumberBeforeTheStep) {  // LAMMPS: dump p%.*.txt
  const TemporaryFolder folder;
  for (const int step : {0, 500, 1000})
    for (const int k : {0, 1, 2})
      folder.write(fmt::format("run2_p{}.{}.txt", k, step), piece(step, 10 * k, 10 * k + 9));
  const auto series = Series::open(folder.path());
  EXPECT_EQ(steps_of(series), (Steps{0, 500, 1000}));
  EXPECT_EQ(series.particles(2), 30);
  EXPECT_TRUE(series.problems().empty()) << all(series.problems());
}

TEST(Pieces, OfManySnapshotsEachAreJoinedStepByStep) {
  const TemporaryFolder folder;
  folder.write("dump.txt_0", piece(1, 0, 4) + piece(2, 0, 3) + piece(3, 0, 3));
  folder.write("dump.txt_1", piece(1, 5, 9) + piece(2, 4, 9));
  const auto series = Series::open(folder.path());  // killed before piece 1 had the last step
  EXPECT_EQ(steps_of(series), (Steps{1, 2}));
  EXPECT_TRUE(series.cut());
  EXPECT_NE(all(series.problems()).find("step 3 is in 1 of 2 pieces: left out"), std::string::npos);
  EXPECT_EQ(read(series, 1, {"id"}).columns[0],
            (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(Pieces, ThatHoldNoParticlesCount) {
  const TemporaryFolder folder;
  folder.write("dump10_0", piece(10, 1, 0));
  folder.write("dump10_1", piece(10, 1, 5));
  folder.write("dump10_2", piece(10, 6, 5));
  const auto series = Series::open(folder.path());
  EXPECT_EQ(series.size(), 1U);
  EXPECT_EQ(read(series, 0, {"id"}).columns[0], (std::vector<double>{1, 2, 3, 4, 5}));
}

TEST(Pieces, ThatAreMissingAreNamedWithTheirStep) {
  const TemporaryFolder folder;
  for (const int step : {1, 2, 3})
    for (const int k : {0, 1, 2})
      if (step != 2 || k != 1)
        folder.write(fmt::format("dump{}.txt_{}", step, k), piece(step, 10 * k, 10 * k + 9));
  const auto series = Series::open(folder.path());
  EXPECT_EQ(steps_of(series), (Steps{1, 2, 3}));
  EXPECT_EQ(series.particles(1), 20);
  EXPECT_EQ(all(series.problems()),
            "dump*.txt_*: one file per processor (dump %): step 2 has no piece 1 (1 of 3 snapshots "
            "lack pieces; only the particles of those that are there count)");
}

TEST(Pieces, OfALastSnapshotThatAreNotAllThereAreLeftOut) {
  const TemporaryFolder folder;
  for (const int step : {9, 10})
    for (const int k : {0, 1, 2})
      if (step != 10 || k != 2)
        folder.write(fmt::format("dump{}.txt_{}", step, k), piece(step, 10 * k, 10 * k + 9));
  auto series = Series::open(folder.path());
  EXPECT_EQ(steps_of(series), Steps{9});
  EXPECT_TRUE(series.cut());
  EXPECT_NE(all(series.problems()).find("step 10 has no piece 2: left out"), std::string::npos);
  folder.write("dump10.txt_2", piece(10, 20, 29).substr(0, 100));  // half written
  series = Series::open(folder.path());
  EXPECT_EQ(steps_of(series), Steps{9});
  EXPECT_NE(all(series.problems()).find(folder.path("dump10.txt_2")), std::string::npos);
}

TEST(Pieces, DumpsOfTwoRunsOfOneStepAreNotJoined) {
  // Repeated steps after a restart hold the same particles, however their files are called.
  const TemporaryFolder folder;
  for (const int run : {0, 1}) folder.write(fmt::format("dump500_{}", run), piece(500, 1, 20));
  EXPECT_NE(error_of([&] { Series::open(folder.path()); }).find("step 500 occurs twice"),
            std::string::npos);
  EXPECT_EQ(Series::open(folder.path(), {.repeated = Repeated::last}).particles(0), 20);
  const TemporaryFolder from_one;  // processors count from 0
  for (const int run : {1, 2})
    from_one.write(fmt::format("dump500_{}", run), piece(500, 20 * run, 20 * run + 19));
  EXPECT_NE(error_of([&] { Series::open(from_one.path()); }).find("step 500 occurs twice"),
            std::string::npos);
}

TEST(Pieces, ASeriesWhoseNamesEndInItsStepIsNoSetOfPieces) {
  const TemporaryFolder folder;
  for (const int step : {0, 1, 2}) folder.write(fmt::format("run_{}", step), piece(step, 1, 5));
  EXPECT_EQ(steps_of(Series::open(folder.path())), (Steps{0, 1, 2}));
}

TEST(Pieces, WithOtherColumnsAreRefused) {
  const TemporaryFolder folder;
  folder.write("dump7_0", piece(7, 1, 5));
  folder.write("dump7_1", replaced(piece(7, 6, 9), "x y z", "y x z"));
  EXPECT_EQ(read(Series::open(folder.path()), 0, {"x"}).columns[0],
            (std::vector<double>{1, 2, 3, 4, 5, 0, 0, 0, 0}));  // by name, not by place
  folder.write("dump7_1", replaced(piece(7, 6, 9), "id x y z", "id x y zu"));
  EXPECT_EQ(error_of([&] { Series::open(folder.path()); }),
            folder.path("dump7_1") + " has no array z, " + folder.path("dump7_0") + " has it");
}

}  // namespace
}  // namespace bedscope::readers
