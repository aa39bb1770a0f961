// SPDX-License-Identifier: BSD-3-Clause
// Which files of a folder make a series, in which order, and what is said of the others.
#include "readers/series.hpp"

#include <sys/stat.h>

#include <random>
#include <thread>

#include "tests/readers/test_files.hpp"

namespace bedscope::readers {
namespace {

const fs::path data = BEDSCOPE_TEST_DATA;

std::vector<std::int64_t> steps_of(const Series& series) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 0; i < series.size(); ++i) steps.push_back(series.step(i));
  return steps;
}

std::vector<std::int64_t> steps_in(const std::string& where) {
  return steps_of(Series::open(where));
}

std::string all(const std::vector<std::string>& lines) {
  return fmt::format("{}", fmt::join(lines, "\n"));
}

Snapshot read(const Series& series, std::size_t i, const std::vector<std::string>& names) {
  Snapshot snapshot;
  Scratch scratch;
  series.read(i, request_of(names), snapshot, scratch);
  return snapshot;
}

using Steps = std::vector<std::int64_t>;

TEST(Series, IsOrderedByTheStepsInsideNotByTheNames) {
  const TemporaryFolder folder;
  for (const std::int64_t step : {500, 10000, 9500, 10500, 0})
    folder.write(fmt::format("dump{}.liggghts", step), small_dump(step, 5));
  const auto series = Series::open(folder.path());
  EXPECT_EQ(steps_of(series), (Steps{0, 500, 9500, 10000, 10500}));
  EXPECT_TRUE(series.problems().empty()) << all(series.problems());
  EXPECT_TRUE(series.left_out().empty());
  EXPECT_FALSE(series.cut());
  EXPECT_EQ(series.form().name, "dump-text");
  EXPECT_EQ(series.columns(), (std::vector<std::string>{"id", "type", "x", "y", "z", "radius"}));
  for (std::size_t i = 0; i < series.size(); ++i) {
    EXPECT_EQ(series.path(i), folder.path(fmt::format("dump{}.liggghts", series.step(i))));
    const auto snapshot = read(series, i, {"x"});
    EXPECT_EQ(snapshot.step, series.step(i));
    EXPECT_EQ(snapshot.columns[0][0], 1 + static_cast<double>(series.step(i)) / 1000);
  }
}

TEST(Series, AFileAFolderAndAPatternGiveTheSameSnapshots) {
  const TemporaryFolder folder;
  for (const int step : {1, 2, 3})
    folder.write(fmt::format("dump{}.txt", step), small_dump(step, 5));
  folder.write("other7.dump", small_dump(7, 5));
  EXPECT_EQ(steps_in(folder.path("dump*.txt")), (Steps{1, 2, 3}));
  EXPECT_EQ(steps_in(folder.path("dump[12].txt")), (Steps{1, 2}));
  EXPECT_EQ(steps_in(folder.path("dump2.txt")), (Steps{2}));
  EXPECT_EQ(steps_in(folder.path()), (Steps{1, 2, 3, 7}));
  EXPECT_EQ(error_of([&] { Series::open(folder.path("dumb*.txt")); }),
            folder.path("dumb*.txt") + ": no such file, and nothing matches it as a pattern");
  EXPECT_EQ(error_of([&] { Series::open(folder.path("dump9.txt")); }),
            folder.path("dump9.txt") + ": no such file");
}

TEST(Series, AFileWhoseNameLooksLikeAPatternIsThatFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(steps_in(folder.write("dump[1].txt", small_dump(4, 5))), (Steps{4}));
}

TEST(Series, StepsOfVtkFilesAreTheNumbersOfTheirNamesThatDiffer) {
  const TemporaryFolder folder;
  for (const int step : {900, 1000, 1100}) {
    folder.write(fmt::format("run2_{}_part3.vtk", step),
                 small_vtk(static_cast<std::size_t>(step / 100)));
  }
  const auto series = Series::open(folder.path());
  EXPECT_EQ(steps_of(series), (Steps{900, 1000, 1100}));
  EXPECT_EQ(read(series, 2, {"x"}).particles, 11U);
  EXPECT_EQ(read(series, 2, {"x"}).step, 1100);
  EXPECT_EQ(steps_in(folder.path("run2_900_part3.vtk")), (Steps{3}));  // alone: the last number
}

TEST(Series, AVtkFileWithoutANumberIsStepZero) {
  const TemporaryFolder folder;
  EXPECT_EQ(steps_in(folder.write("bed.vtk", small_vtk(3))), (Steps{0}));
}

TEST(Series, CompanionsOfADumpAreLeftOut) {
  const TemporaryFolder folder;
  for (const int step : {100, 200}) {
    folder.write(fmt::format("dump_{}.vtk", step), small_vtk(4));
    for (const char* name : {"mesh_10500", "contact_10500", "decomp_10500", "euler_10500",
                             "triclinic_boundingBox_2000", "mesh_interp_200"}) {
      const auto other =
          replaced(replaced(replaced(name, "10500", "{}"), "2000", "{}"), "_200", "_{}");
      folder.write(fmt::format(fmt::runtime(other), step) + ".vtk",
                   bytes_of(data / "vtk_legacy" / (std::string(name) + ".vtk")));
    }
  }
  folder.write("log.liggghts", "LIGGGHTS (Version 3.8)\n");
  folder.write("wall.stl", "solid wall\nendsolid wall\n");
  folder.write(".hidden", small_dump(1, 3));
  fs::create_directory(folder.path("restart"));
  const auto series = Series::open(folder.path());
  EXPECT_EQ(steps_of(series), (Steps{100, 200}));
  EXPECT_EQ(series.left_out().size(), 14U) << all(series.left_out());
  EXPECT_TRUE(series.problems().empty()) << all(series.problems());
  for (const auto& file :
       {"mesh_100", "contact_200", "decomp_100", "euler_200", "triclinic_boundingBox_100"}) {
    EXPECT_NE(all(series.left_out()).find(folder.path(file)), std::string::npos) << file;
    EXPECT_NE(error_of([&] {
                Series::open(folder.path(file + std::string(".vtk")));
              }).find("not particles"),
              std::string::npos);
  }
}

TEST(Series, ContactDumpsBesideTheParticlesAreLeftOut) {
  const TemporaryFolder folder;
  const auto local = bytes_of(data / "liggghts_text" / "local_10500.liggghts");
  folder.write("dump10500.liggghts", small_dump(10500, 5));
  folder.write("dump9500.liggghts", small_dump(9500, 5));
  folder.write("contacts10500.liggghts", local);
  folder.write("contacts9500.liggghts", replaced(local, "10500", "9500"));
  const auto series = Series::open(folder.path());
  EXPECT_EQ(steps_of(series), (Steps{9500, 10500}));
  EXPECT_EQ(series.left_out().size(), 2U) << all(series.left_out());
  EXPECT_NE(error_of([&] {
              Series::open(folder.path("contacts9500.liggghts"));
            }).find("line 3: a dump local"),
            std::string::npos);
}

TEST(Series, TwoFormsInOneFolderAreRefused) {
  const TemporaryFolder folder;
  folder.write("dump1.txt", small_dump(1, 3));
  folder.write("dump1.vtk", small_vtk(3));
  const auto error = error_of([&] { Series::open(folder.path()); });
  EXPECT_NE(error.find("dumps of two forms"), std::string::npos) << error;
  EXPECT_NE(error.find("dump-text"), std::string::npos) << error;
  EXPECT_NE(error.find("vtk-legacy"), std::string::npos) << error;
  EXPECT_THROW(Series::open(folder.path()), InputError);
  EXPECT_EQ(steps_in(folder.path("*.vtk")), (Steps{1}));
}

TEST(Series, ARepeatedStepIsRefusedUnlessOneOfThemIsAskedFor) {
  const TemporaryFolder folder;
  const auto first = folder.write("dump09500.txt", small_dump(9500, 3));
  const auto second = folder.write("dump9500.txt", small_dump(9500, 4));
  folder.write("dump9600.txt", small_dump(9600, 5));
  const auto error = error_of([&] { Series::open(folder.path()); });
  EXPECT_NE(error.find("step 9500"), std::string::npos) << error;
  EXPECT_NE(error.find(first), std::string::npos) << error;
  EXPECT_NE(error.find(second), std::string::npos) << error;
  const auto earlier = Series::open(folder.path(), {Repeated::first});
  const auto later = Series::open(folder.path(), {Repeated::last});
  EXPECT_EQ(steps_of(earlier), (Steps{9500, 9600}));
  EXPECT_EQ(earlier.located(0).particles, 3);
  EXPECT_EQ(later.located(0).particles, 4);
  EXPECT_EQ(all(later.problems()), "1 repeated steps: the last of each was taken");
}

TEST(Series, ARestartInsideOneFileRepeatsStepsAndTheErrorNamesBothLines) {
  const TemporaryFolder folder;
  const auto path = folder.write(
      "dump.txt", small_dump(1, 2) + small_dump(2, 2) + small_dump(2, 3) + small_dump(3, 1));
  const auto error = error_of([&] { Series::open(path); });
  EXPECT_NE(error.find("(line 23): step 2 occurs twice, also in " + path + " (line 12)"),
            std::string::npos)
      << error;
  EXPECT_EQ(Series::open(path, {Repeated::first}).located(1).particles, 2);
  EXPECT_EQ(Series::open(path, {Repeated::last}).located(1).particles, 3);
}

TEST(Series, FilesOfOneAndOfManySnapshotsMixInAnyOrder) {
  const TemporaryFolder folder;
  folder.write("dump.txt", small_dump(5, 2) + small_dump(3, 2) + small_dump(9, 2));
  folder.write("dump4.txt", small_dump(4, 300));
  folder.write("dump7.txt", gzip(small_dump(7, 300)));
  folder.write("late10.txt", small_dump(10, 2) + small_dump(11, 2));
  const auto series = Series::open(folder.path());
  EXPECT_EQ(steps_of(series), (Steps{3, 4, 5, 7, 9, 10, 11}));
  for (std::size_t i = 0; i < series.size(); ++i)
    EXPECT_EQ(read(series, i, {"x"}).columns[0].at(1),
              2 + static_cast<double>(series.step(i)) / 1000);
  EXPECT_EQ(all(series.problems()),
            folder.path("dump.txt") + ": steps are not in order: 5 then 3; sorted by step");
}

TEST(Series, ACutLastFileIsLeftOutAndSaid) {
  for (const std::size_t lost : {3U, 2000U, 5960U}) {
    const TemporaryFolder folder;
    for (const int step : {900, 1000, 1100}) {
      auto text = small_dump(step, 300);
      if (step == 1100) text.resize(text.size() - std::min<std::size_t>(lost, text.size() - 20));
      folder.write(fmt::format("dump{}.txt", step), text);
    }
    const auto series = Series::open(folder.path());
    EXPECT_EQ(steps_of(series), (Steps{900, 1000}));
    EXPECT_TRUE(series.cut());
    ASSERT_EQ(series.problems().size(), 1U);
    EXPECT_NE(series.problems()[0].find(folder.path("dump1100.txt")), std::string::npos);
    EXPECT_NE(series.problems()[0].find("left out"), std::string::npos);
  }
}

TEST(Series, ACutLastVtkFileIsLeftOutAndSaid) {
  const TemporaryFolder folder;
  for (const int step : {900, 1000, 1100})
    folder.write(fmt::format("dump{}.vtk", step),
                 small_vtk(50).substr(0, step == 1100 ? 400 : 10'000));
  const auto series = Series::open(folder.path());
  EXPECT_EQ(steps_of(series), (Steps{900, 1000}));
  EXPECT_TRUE(series.cut());
}

TEST(Series, ALastVtkFileThatIsCutInALineOrEndsInNulBytesIsLeftOutToo) {
  const auto whole = small_vtk(50);
  const auto word = whole.find("radius float");
  ASSERT_NE(word, std::string::npos);
  for (const auto& last : {whole.substr(0, word + 10), whole + std::string(400, '\0')}) {
    const TemporaryFolder folder;
    folder.write("dump900.vtk", whole);
    folder.write("dump1000.vtk", last);
    const auto series = Series::open(folder.path());
    EXPECT_EQ(steps_of(series), (Steps{900}));
    EXPECT_TRUE(series.cut());
  }
}

TEST(Series, ParcelsOfAnyFormAreSpheresOfTheVolumeOfTheirParticlesAndAreTold) {
  const TemporaryFolder folder;
  const auto path = folder.write(
      "dump1", dump_header(1, 2, "id x y z d nParticle") + "1 0 0 0 .2 8 \n2 0 0 1 .2 1 \n");
  const auto series = Series::open(path);
  EXPECT_EQ(read(series, 0, {"nParticle", "radius", "d"}).columns,
            (std::vector<std::vector<double>>{{8, 1}, {.2, .1}, {.2, .2}}));
  ASSERT_EQ(series.problems().size(), 1U);
  EXPECT_NE(series.problems()[0].find("one parcel stands for 1 to 8 particles (nParticle)"),
            std::string::npos);
}

TEST(Series, ACutFileBeforeTheLastIsAnError) {
  // By a look at the headers alone, or when it is read: never passed over.
  for (const std::size_t particles : {5U, 300U})
    for (const std::size_t lost : {3U, 60U}) {
      const TemporaryFolder folder;
      for (const int step : {900, 1000, 1100}) {
        auto text = small_dump(step, particles);
        if (step == 1000) text.resize(text.size() - lost);
        folder.write(fmt::format("dump{}.txt", step), text);
      }
      const auto error = error_of([&] {
        const auto series = Series::open(folder.path());
        for (std::size_t i = 0; i < series.size(); ++i) read(series, i, {"x"});
      });
      EXPECT_NE(error.find(folder.path("dump1000.txt")), std::string::npos) << error;
    }
}

TEST(Series, ACutFileOfManySnapshotsBeforeTheLastIsAnErrorToo) {
  const TemporaryFolder folder;
  const auto cut = small_dump(10, 5) + small_dump(20, 5).substr(0, 150);
  const auto path = folder.write("part1.txt", cut);
  folder.write("part2.txt", small_dump(30, 5) + small_dump(40, 5));
  EXPECT_EQ(error_of([&] { Series::open(folder.path()); }).find(path + ": snapshot 20: "), 0U);
  folder.write("part2.txt", cut);  // the last one: its complete snapshot is taken
  folder.write("part1.txt", small_dump(1, 5));
  const auto series = Series::open(folder.path());
  EXPECT_EQ(steps_of(series), (Steps{1, 10}));
  EXPECT_TRUE(series.cut());
  EXPECT_NE(all(series.problems()).find("part2.txt: snapshot 20: "), std::string::npos);
}

TEST(Series, AnEmptyLastFileIsLeftOutAndSaid) {
  const TemporaryFolder folder;
  folder.write("dump1.txt", small_dump(1, 5));
  folder.write("dump2.txt", "");
  const auto series = Series::open(folder.path());
  EXPECT_EQ(steps_of(series), (Steps{1}));
  EXPECT_TRUE(series.cut());
  EXPECT_EQ(all(series.problems()), folder.path("dump2.txt") + ": file is empty: left out");
  EXPECT_EQ(error_of([&] { Series::open(folder.path("dump2.txt")); }),
            folder.path("dump2.txt") + ": file is empty");
}

TEST(Series, AFileOfADumpThatCannotBeReadAsOneIsNeverPassedOverInSilence) {
  // A git-lfs pointer, zeros after a crash or damaged gzip in place of one dump of many.
  auto damaged = gzip(small_dump(1000, 300));
  for (std::size_t k = 20; k < 60; ++k) damaged[k] ^= 0x5a;
  for (const auto& content : {std::string("version https://git-lfs.github.com/spec/v1\n"),
                              std::string(5000, '\0'), damaged})
    for (const int broken : {1000, 1100}) {
      const TemporaryFolder folder;
      for (const int step : {900, 1000, 1100})
        folder.write(fmt::format("dump{}.txt", step),
                     step == broken ? content : small_dump(step, 300));
      const auto path = folder.path(fmt::format("dump{}.txt", broken));
      if (broken == 1000) {
        EXPECT_EQ(error_of([&] { Series::open(folder.path()); }).find(path + ": "), 0U);
        continue;
      }
      const auto series = Series::open(folder.path());
      EXPECT_EQ(steps_of(series), (Steps{900, 1000}));
      EXPECT_TRUE(series.cut());
      EXPECT_EQ(all(series.problems()).find(path + ": "), 0U) << all(series.problems());
    }
}

TEST(Series, ANameThatTellsAnotherStepThanTheFileIsSaid) {
  const TemporaryFolder folder;
  folder.write("dump10000.txt", small_dump(10000, 5));
  folder.write("dump20000.txt", small_dump(9500, 5));
  const auto series = Series::open(folder.path());
  EXPECT_EQ(steps_of(series), (Steps{9500, 10000}));
  EXPECT_EQ(all(series.problems()),
            folder.path("dump20000.txt") + " holds step 9500: the step inside wins");
}

TEST(Series, PiecesOfAParallelDumpAreSaid) {
  const TemporaryFolder folder;
  folder.write("dump1000.txt_0", small_dump(1000, 5));
  const auto series = Series::open(folder.path());
  EXPECT_NE(all(series.problems()).find("one file per processor"), std::string::npos)
      << all(series.problems());
  folder.write("dump1000.txt_1", small_dump(1000, 4));
  EXPECT_NE(error_of([&] { Series::open(folder.path()); }).find("step 1000 occurs twice"),
            std::string::npos);
}

TEST(Series, TwoRunsInOneFolderShowByTheirBoxOrColumns) {
  const TemporaryFolder folder;
  const auto rows = [](const std::string& text) { return text.substr(0, text.size()); };
  folder.write("dump1.txt", small_dump(1, 5));
  folder.write("dump2.txt", rows(replaced(small_dump(2, 5), "0 2\n", "0 3\n")));
  EXPECT_NE(all(Series::open(folder.path()).problems())
                .find("box changes in z (0..2 to 0..3): two runs in one folder?"),
            std::string::npos)
      << all(Series::open(folder.path()).problems());
  folder.write("dump2.txt", replaced(small_dump(2, 5), "radius", "diameter"));
  EXPECT_NE(all(Series::open(folder.path()).problems())
                .find("columns change, gone: radius, new: diameter"),
            std::string::npos)
      << all(Series::open(folder.path()).problems());
}

TEST(Series, ABoxThatFollowsTheParticlesIsNoSecondRun) {
  const TemporaryFolder folder;
  folder.write("dump1.txt", replaced(small_dump(1, 5), "ff ff ff", "ff ff mm"));
  folder.write("dump2.txt",
               replaced(replaced(small_dump(2, 5), "ff ff ff", "ff ff mm"), "0 2\n", "0 3\n"));
  EXPECT_TRUE(Series::open(folder.path()).problems().empty());
}

TEST(Series, FoldersWithoutDumpsAreErrorsThatSayWhatIsThere) {
  const TemporaryFolder folder;
  EXPECT_EQ(error_of([&] { Series::open(folder.path()); }),
            folder.path() + ": no files in this folder");
  folder.write("notes.txt", "hello\n");
  const auto error = error_of([&] { Series::open(folder.path()); });
  EXPECT_NE(error.find("no particle dumps among 1 files"), std::string::npos) << error;
  EXPECT_NE(error.find("notes.txt"), std::string::npos) << error;
  EXPECT_EQ(error_of([&] { Series::open(folder.path("nowhere")); }),
            folder.path("nowhere") + ": no such file");
}

TEST(Series, ThingsThatAreNoFilesNeitherHangNorHide) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo(folder.path("fifo.txt").c_str(), 0600), 0);
  fs::create_symlink("loop_b.txt", folder.path("loop_a.txt"));
  fs::create_symlink("loop_a.txt", folder.path("loop_b.txt"));
  fs::create_symlink("/dev/zero", folder.path("zero.txt"));
  fs::create_symlink("nowhere", folder.path("dangling.txt"));
  for (const char* name : {"fifo.txt", "loop_a.txt", "zero.txt", "dangling.txt"})
    EXPECT_EQ(error_of([&] { Series::open(folder.path(name)); }).find(folder.path(name) + ": "), 0U)
        << name;
  // A folder holds its files; a pattern names what it names.
  EXPECT_NE(error_of([&] { Series::open(folder.path()); }), "");
  EXPECT_NE(error_of([&] { Series::open(folder.path("*.txt")); }), "");
  folder.write("dump1.txt", small_dump(1, 5));
  EXPECT_EQ(steps_in(folder.path()), (Steps{1}));
  EXPECT_NE(error_of([&] { Series::open(folder.path("*.txt")); }), "");
}

TEST(Series, ALinkToADumpIsADump) {
  const TemporaryFolder folder, other;
  fs::create_symlink(other.write("dump1.txt", small_dump(1, 5)), folder.path("dump1.txt"));
  EXPECT_EQ(steps_in(folder.path()), (Steps{1}));
}

TEST(Series, PlacesNameFileAndLine) {
  const TemporaryFolder folder;
  const auto text = folder.write("dump1.txt", small_dump(1, 5));
  const auto vtk = folder.write("dump1.vtk", small_vtk(5));
  EXPECT_EQ(Series::open(text).place(0, 2), text + ": line 12");
  EXPECT_EQ(Series::open(vtk).place(0, 2), vtk + ": point 2");
}

TEST(Series, ManyThreadsReadWhatOneReads) {
  const TemporaryFolder folder;
  std::string text;
  for (std::int64_t step = 0; step < 30; ++step) text += small_dump(step, 2000);
  const auto path = folder.write("dump.gz", gzip(text));
  const auto series = Series::open(path);
  std::vector<std::thread> threads;
  std::vector<int> good(4, 0);
  for (std::size_t t = 0; t < good.size(); ++t)
    threads.emplace_back([&, t] {
      Snapshot snapshot;
      Scratch scratch;
      const auto request = request_of({"x", "id"});
      for (std::size_t k = 0; k < 30; ++k) {
        const auto i = (7 * k + 11 * t) % 30;
        series.read(i, request, snapshot, scratch);
        good[t] += snapshot.particles == 2000 &&
                   snapshot.columns[0][1999] == 2000 + static_cast<double>(i) / 1000;
      }
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(good, (std::vector<int>{30, 30, 30, 30}));
}

}  // namespace
}  // namespace bedscope::readers
