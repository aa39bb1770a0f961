// SPDX-License-Identifier: BSD-3-Clause
// What a disk does that no content of a file shows: files that change while they are read, odd
// names, long paths, folders with very many files.
#include <sys/stat.h>
#include <unistd.h>

#include "readers/openfoam_case.hpp"
#include "readers/series.hpp"
#include "readers/survey.hpp"
#include "tests/readers/test_files.hpp"

namespace bedscope::readers {
namespace {

const fs::path data = BEDSCOPE_TEST_DATA;
const Request all{{"x"}, {"y"}, {"z"}, {"radius", false}, {"id", false}};

struct Dump {
  const char* name;
  std::string content;
};

std::vector<Dump> dumps() {
  const auto xml = data / "vtk_xml";
  return {{"text", small_dump(100, 40)},
          {"text_several", small_dump(100, 5) + small_dump(200, 5) + small_dump(300, 5)},
          {"text_gzip", gzip(small_dump(100, 40))},
          {"vtk", small_vtk(20)},
          {"vtk_binary", bytes_of(data / "vtk_legacy" / "triclinic_2000.vtk")},
          {"xml_ascii", bytes_of(xml / "hand_minimal.vtp")},
          {"xml_appended", bytes_of(xml / "appended_raw.vtp")},
          {"xml_zlib", bytes_of(xml / "inline_zlib.vtp")}};
}

/// One snapshot after the other; the text of the error that ended it, or empty.
std::string read_all(const Series& series, std::vector<Snapshot>& into) {
  Scratch scratch;
  into.assign(series.size(), {});
  return error_of([&] {
    for (std::size_t i = 0; i < series.size(); ++i) series.read(i, all, into[i], scratch);
  });
}

class ChangingFile : public testing::TestWithParam<Dump> {
 protected:
  TemporaryFolder folder;
  std::string path = folder.write("dump100", GetParam().content);
  Series series = Series::open(path);
  std::vector<Snapshot> before, after;

  void SetUp() override { ASSERT_EQ(read_all(series, before), ""); }
  void expect_error_or_the_same(const std::string& what) {
    SCOPED_TRACE(what);
    const auto error = read_all(series, after);
    if (!error.empty()) {
      EXPECT_TRUE(error.starts_with(path + ": ")) << error;
      return;
    }
    for (std::size_t i = 0; i < before.size(); ++i)
      EXPECT_EQ(after[i].columns, before[i].columns) << i;
  }
};

TEST_P(ChangingFile, CutBetweenTheLookAndTheReadingIsAnErrorOrDoesNotMatter) {
  const auto& content = GetParam().content;
  std::size_t errors = 0;
  for (std::size_t size = 0; size < content.size(); size += content.size() / 97 + 1) {
    ASSERT_EQ(::truncate(folder.write("dump100", content).c_str(), static_cast<off_t>(size)), 0);
    expect_error_or_the_same(fmt::format("{} bytes of {}", size, content.size()));
    errors += !read_all(series, after).empty();
  }
  EXPECT_GT(errors, 50U);
}

TEST_P(ChangingFile, GrownBetweenTheLookAndTheReadingIsAnErrorOrDoesNotMatter) {
  for (const std::string& more :
       {std::string("x"), small_dump(400, 3), std::string(100'000, '\0')}) {
    folder.write("dump100", GetParam().content + more);
    expect_error_or_the_same(more.substr(0, 20));
  }
}

TEST_P(ChangingFile, ReplacedByAnotherDumpItIsAnError) {
  for (const auto& other : {small_dump(100, 7), small_dump(500, 40), small_vtk(7)}) {
    folder.write("dump100", other);
    const auto error = read_all(series, after);
    EXPECT_TRUE(error.starts_with(path + ": ")) << error;
  }
}

TEST_P(ChangingFile, GoneOrNoFileAnyMoreItIsAnError) {
  fs::remove(path);
  EXPECT_EQ(read_all(series, after), path + ": no such file");
  fs::create_directory(path);
  EXPECT_EQ(read_all(series, after), path + ": is a directory, expected a file");
  fs::remove(path);
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  EXPECT_EQ(read_all(series, after), path + ": not a regular file");
}

INSTANTIATE_TEST_SUITE_P(Readers, ChangingFile, testing::ValuesIn(dumps()),
                         [](const auto& dump) { return std::string(dump.param.name); });

TEST(Errors, AreOnePrintableLineWhateverTheyQuote) {
  EXPECT_STREQ(FormatError("{}: a\nb\x1b[31m", "dump").what(), "dump: a\\nb\\x1b[31m");
  EXPECT_STREQ(FileError("größe").what(), "größe");
  const std::string text = FileError("a{}z", std::string(300'000, 'x')).what();
  EXPECT_EQ(text.size(), 1805U);
  EXPECT_TRUE(text.starts_with("axx") && text.ends_with("xxz"));
  EXPECT_NE(text.find(" ... "), text.npos);
}

TEST(Errors, OfASeriesAreOneLineEachInProblemsToo) {
  TemporaryFolder folder;
  folder.write("dump100", replaced(small_dump(100, 1), "radius", "ra\x7f"));
  folder.write("dump200", small_dump(200, 1));
  const auto series = Series::open(folder.path());
  ASSERT_EQ(series.problems().size(), 1U);
  EXPECT_NE(series.problems()[0].find("ra\\x7f"), std::string::npos) << series.problems()[0];
}

TEST(Names, OfAnyKindAreRead) {
  for (const std::string name :
       {"dump 100", "dump%s%d100", "dump\n100", "größe_日本100", "\xff\xfe 100", "-100", "*100",
        "[a]100", "~100", "a;b|c&d$e`f100", "a'b\"c100", "{0}{}100", "dump100.liggghts.bak~"}) {
    TemporaryFolder folder;
    const auto path = folder.write(name, small_dump(100, 3));
    for (const auto& where : {path, folder.path()}) {
      const auto series = Series::open(where);
      EXPECT_EQ(series.size(), 1U) << where;
      EXPECT_EQ(survey(series, true).particles[0], 3);
    }
    folder.write(name, "not a dump");
    const auto error = error_of([&] { Series::open(path); });
    EXPECT_NE(error.find("not a particle dump"), error.npos) << error;
    EXPECT_EQ(error.find('\n'), error.npos) << error;
  }
}

TEST(Names, AStarInANameIsNotTakenForTheNumbersOfOthers) {
  TemporaryFolder folder;
  folder.write("dump*", small_dump(300, 3));
  folder.write("dump100", small_dump(100, 3));
  folder.write("dump200", small_dump(200, 3));
  EXPECT_EQ(Series::open(folder.path()).size(), 3U);
  EXPECT_NE(split_name("a*").stem, split_name("a1").stem);
  EXPECT_NE(split_name("a\\*").stem, split_name("a*").stem);
}

TEST(Names, OfManyDigitsAreNoSteps) {
  TemporaryFolder folder;
  folder.write("dump99999999999999999999999.vtk", small_vtk(2));
  EXPECT_EQ(Series::open(folder.path()).step(0), 0);
}

TEST(Paths, OfFourThousandCharactersAreRead) {
  TemporaryFolder folder;
  // The system takes 4095 characters at once; deeper ones are made step by step.
  const auto start = fs::current_path();
  fs::current_path(folder.path());
  std::string where = fs::current_path().string();
  while (where.size() < 3800) {
    const std::string name(200, 'd');
    fs::create_directory(name);
    fs::current_path(name);
    where += "/" + name;
  }
  fs::current_path(start);
  std::ofstream(where + "/dump100") << small_dump(100, 3);
  EXPECT_EQ(Series::open(where).size(), 1U);
  EXPECT_EQ(Series::open(where + "/dump*").size(), 1U);
  const auto error = error_of([&] { Series::open(where + "/none"); });
  EXPECT_TRUE(error.ends_with("no such file")) << error;
  EXPECT_LT(error.size(), 2000U);  // its middle is left out
  for (const std::size_t size : {300U, 5000U}) {
    const std::string none(size, 'x');
    EXPECT_NE(error_of([&] { Series::open(none); }).find("File name too long"), error.npos);
    EXPECT_NE(error_of([&] { OpenFoamCase::open(none); }), "");
  }
}

TEST(Folders, LoopsOfLinksAndPipesAreLeftAlone) {
  TemporaryFolder folder;
  folder.write("dump100", small_dump(100, 3));
  fs::create_symlink("b", folder.path("a"));
  fs::create_symlink("a", folder.path("b"));
  fs::create_directory_symlink(".", folder.path("here"));
  fs::create_symlink("/dev/zero", folder.path("dump300"));
  ASSERT_EQ(::mkfifo(folder.path("dump200").c_str(), 0600), 0);
  EXPECT_EQ(Series::open(folder.path()).size(), 1U);
  EXPECT_EQ(Series::open(folder.path("here/here/here")).size(), 1U);
  EXPECT_NE(error_of([&] { Series::open(folder.path("a")); }).find("symbolic links"),
            std::string::npos);
}

TEST(Folders, WithoutPermissionAreErrors) {
  if (::geteuid() == 0) GTEST_SKIP() << "root reads everything";
  TemporaryFolder folder;
  const auto path = folder.write("dump100", small_dump(100, 3));
  fs::permissions(path, fs::perms::none);
  EXPECT_EQ(error_of([&] { Series::open(path); }), path + ": permission denied");
  EXPECT_NE(error_of([&] { Series::open(folder.path()); }), "");
  fs::permissions(folder.path(), fs::perms::none);
  EXPECT_NE(error_of([&] { Series::open(folder.path()); }), "");
  EXPECT_NE(error_of([&] { OpenFoamCase::open(folder.path()); }), "");
  fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST(Folders, OfVeryManyFilesAreOpened) {
  TemporaryFolder folder;
  constexpr int files = 20'000;
  for (int i = 0; i < files; ++i)
    std::ofstream(folder.path(fmt::format("dump{}", i))) << small_dump(i, 1);
  const auto series = Series::open(folder.path());
  EXPECT_EQ(series.size(), static_cast<std::size_t>(files));
  EXPECT_EQ(survey(series, false).snapshots_read, 10U);
}

}  // namespace
}  // namespace bedscope::readers
