// SPDX-License-Identifier: BSD-3-Clause
// LIGGGHTS text dumps: every spelling and oddity that runs leave on disk, and what is said of the
// broken ones. The files of tests/data/liggghts_text were written by LIGGGHTS 3.8.0.
#include <cmath>
#include <numeric>
#include <random>

#include "readers/byte_window.hpp"
#include "readers/forms.hpp"
#include "tests/readers/test_files.hpp"

namespace bedscope::readers {

extern const Form liggghts_text;

namespace {

const fs::path data = fs::path(BEDSCOPE_TEST_DATA) / "liggghts_text";
const std::vector<std::string> all_of_small{"id", "type", "x", "y", "z", "radius"};

Snapshot read_at(const std::string& path, const Located& where,
                 const std::vector<std::string>& names) {
  Snapshot snapshot;
  Scratch scratch;
  liggghts_text.read(path, where, request_of(names), snapshot, scratch);
  return snapshot;
}

Snapshot read_first(const std::string& path, const std::vector<std::string>& names) {
  return read_at(path, liggghts_text.scan(path, true).snapshots.at(0), names);
}

Snapshot read_text(const std::string& text, const std::vector<std::string>& names) {
  const TemporaryFolder folder;
  return read_first(folder.write("dump", text), names);
}

/// The error of a dump without the path in front; the scan must pass where `in_read` is set.
std::string error_of_text(const std::string& text, const std::vector<std::string>& names = {"x"}) {
  const TemporaryFolder folder;
  const auto path = folder.write("dump", text);
  const auto error = error_of([&] { read_first(path, names); });
  return error.size() > path.size() + 2 ? error.substr(path.size() + 2) : error;
}

FileScan scan_text(const std::string& text, bool thorough = true) {
  const TemporaryFolder folder;
  return liggghts_text.scan(folder.write("dump", text), thorough);
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// What small_dump(step, particles) says.
void expect_small(const Snapshot& snapshot, std::int64_t step, std::size_t particles) {
  ASSERT_EQ(snapshot.step, step);
  ASSERT_EQ(snapshot.particles, particles);
  for (const auto& column : snapshot.columns) ASSERT_EQ(column.size(), particles);
  for (std::size_t i = 0; i < particles; ++i) {
    const auto id = static_cast<double>(i + 1);
    ASSERT_EQ(snapshot.columns[0][i], id);
    ASSERT_EQ(snapshot.columns[1][i], 1);
    ASSERT_EQ(snapshot.columns[2][i], id + static_cast<double>(step) / 1000);
    ASSERT_EQ(snapshot.columns[3][i], .25);
    ASSERT_EQ(snapshot.columns[4][i], .75);
    ASSERT_EQ(snapshot.columns[5][i], .5);
  }
}

// --- what LIGGGHTS writes

TEST(LiggghtsText, TheThreeSpellingsOfATriclinicPositionAreThePositionsThemselves) {
  // x, xs and xu stand side by side in this dump. A fraction just above 1 has five decimals, so it
  // is good to 5e-6; edge and tilts together are 0.051 m: 2.6e-7 m.
  const auto text = bytes_of(data / "triclinic_2000.liggghts");
  const auto plain = read_text(text, {"x", "y", "z"});
  const auto scaled = read_text(replaced(text, " x y z xs ", " a b c xs "), {"x", "y", "z"});
  const auto unwrapped =
      read_text(replaced(text, " x y z xs ys zs ", " a b c d e f "), {"x", "y", "z"});
  ASSERT_EQ(plain.particles, 64U);
  EXPECT_EQ(plain.box.tilt, (std::array{0.008, 0.003, -0.004}));
  EXPECT_EQ(plain.box.periodic, (std::array{true, true, true}));
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < 64; ++i) {
      ASSERT_NEAR(scaled.columns[axis][i], plain.columns[axis][i], 2.6e-7);
      ASSERT_EQ(unwrapped.columns[axis][i], plain.columns[axis][i]);  // nothing crossed the box
    }
}

TEST(LiggghtsText, ScaledCoordinatesOfAnOrthogonalBoxAreSpreadOverIt) {
  const auto text =
      dump_header(7, 2, "xs ys zs", "pp ff mm\n-1 3\n0 2\n10 20\n") + "0 0.5 1 \n0.25 1 0.5 \n";
  const auto snapshot = read_text(text, {"x", "y", "z"});
  EXPECT_EQ(snapshot.columns, (std::vector<std::vector<double>>{{-1, 0}, {1, 2}, {20, 15}}));
  EXPECT_TRUE(snapshot.box.shrink_wrapped);
  EXPECT_EQ(snapshot.box.periodic, (std::array{true, false, false}));
  const auto unwrapped = read_text(replaced(text, "xs ys zs", "xsu ysu zsu"), {"x", "y", "z"});
  EXPECT_EQ(unwrapped.columns, snapshot.columns);
}

TEST(LiggghtsText, ALabelIsPassedOver) {
  const auto path = (data / "label_10500.liggghts").string();
  const auto snapshot = read_first(path, {"z", "radius"});
  EXPECT_EQ(snapshot.step, 10500);
  EXPECT_EQ(snapshot.particles, 369U);
  const auto [low, high] =
      std::minmax_element(snapshot.columns[1].begin(), snapshot.columns[1].end());
  EXPECT_EQ(*low, 0.003);
  EXPECT_EQ(*high, 0.0045);
}

TEST(LiggghtsText, UnitsAndTimeMayStandBeforeTheStep) {
  for (const std::string front :
       {"ITEM: UNITS\nsi\nITEM: TIME\n0.125\n", "ITEM: TIME\n1.25e-1 \n"}) {
    const auto snapshot = read_text(front + small_dump(40, 3), all_of_small);
    EXPECT_EQ(snapshot.time, 0.125);
    expect_small(snapshot, 40, 3);
  }
  EXPECT_TRUE(std::isnan(read_text(small_dump(40, 3), {"x"}).time));
}

TEST(LiggghtsText, ADumpWithoutParticlesIsASnapshotOfNone) {
  const auto path = (data / "empty_10500.liggghts").string();
  const auto snapshot = read_first(path, all_of_small);
  EXPECT_EQ(snapshot.step, 10500);
  EXPECT_EQ(snapshot.particles, 0U);
  for (const auto& column : snapshot.columns) EXPECT_TRUE(column.empty());
}

TEST(LiggghtsText, ManySnapshotsWithNoneAmongThemAreAllFound) {
  const auto found =
      scan_text(small_dump(1, 0) + small_dump(2, 3) + small_dump(3, 0) + small_dump(4, 0));
  ASSERT_EQ(found.snapshots.size(), 4U);
  EXPECT_EQ(found.snapshots[1].particles, 3);
  EXPECT_EQ(found.snapshots[3].step, 4);
  EXPECT_EQ(found.cut, "");
}

TEST(LiggghtsText, TypeTwiceIsUsualAndAnErrorOnlyWhereTheTwoDiffer) {
  const auto header = dump_header(5, 3, "id type type x");
  EXPECT_EQ(read_text(header + "1 2 2 .5 \n2 1 1 .5 \n3 nan nan 1 \n", {"id"}).particles, 3U);
  const auto types = read_text(header + "1 2 2 .5 \n2 1 1 .5 \n3 3 3 1 \n", {"type"}).columns[0];
  EXPECT_EQ(types, (std::vector<double>{2, 1, 3}));
  EXPECT_EQ(error_of_text(header + "1 2 2 .5 \n2 1 9 .5 \n3 3 3 1 \n", {"type"}),
            "line 9: column \"type\" twice with different values (line 11: 1 and 9)");
}

TEST(LiggghtsText, FormatsOfManyDigitsAndLeadingBlanksKeepEveryBit) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::string text = dump_header(1, 500, "id x radius");
  std::vector<double> expected;
  for (int i = 0; i < 500; ++i) {
    expected.push_back(unit(random) * std::pow(10, i % 40 - 20));
    text += fmt::format("{:8d} {:>24.16e} {:20.15e} \n", i, expected.back(), .003);
  }
  EXPECT_EQ(read_text(text, {"x"}).columns[0], expected);
}

TEST(LiggghtsText, IdsPrintedAsFloatsAreIds) {
  const auto text = dump_header(1, 2, "id x") + "12.0 .5 \n1.3e1 .5 \n";
  EXPECT_EQ(read_text(text, {"id"}).columns[0], (std::vector<double>{12, 13}));
}

TEST(LiggghtsText, NanAndInfinityAreReadAsSuch) {
  const auto x =
      read_text(dump_header(1, 3, "id x") + "1 nan \n2 -nan \n3 -inf \n", {"x"}).columns[0];
  EXPECT_TRUE(std::isnan(x[0]) && std::isnan(x[1]));
  EXPECT_EQ(x[2], -std::numeric_limits<double>::infinity());
}

TEST(LiggghtsText, WordsAreNoObstacleInAColumnThatNobodyAsksFor) {
  const auto text = dump_header(1, 2, "id element x") + "1 Cu 0.5 \n2 Fe 0.25 \n";
  EXPECT_EQ(read_text(text, {"x"}).columns[0], (std::vector<double>{.5, .25}));
  EXPECT_EQ(error_of_text(text, {"element"}), "line 10, column element: \"Cu\" is not a number");
}

TEST(LiggghtsText, LineEndsBlanksAndMarksOfOtherSystemsAreAccepted) {
  const auto text = small_dump(30, 40);
  const std::string bom = "\xEF\xBB\xBF";
  for (const auto& odd : {replaced(text, "\n", "\r\n"), bom + text,
                          bom + replaced(text, "\n", "\r\n"), replaced(text, " ", "\t"),
                          "\n\r\n \n" + text, text + "\n\n \t\r\n", replaced(text, " \n", "\n"),
                          replaced(text, " 0.", " \t  0."), text.substr(0, text.size() - 1)}) {
    // ITEM lines keep their blanks: tabs there are nobody's habit.
    const auto fixed =
        replaced(replaced(odd, "ITEM:\t", "ITEM: "), "NUMBER\tOF\tATOMS", "NUMBER OF ATOMS");
    const auto path_text = replaced(fixed, "BOX\tBOUNDS", "BOX BOUNDS");
    ASSERT_NO_FATAL_FAILURE(expect_small(read_text(path_text, all_of_small), 30, 40));
    EXPECT_EQ(scan_text(path_text).cut, "");
  }
}

TEST(LiggghtsText, BlankLinesBetweenSnapshotsAreAccepted) {
  const TemporaryFolder folder;
  const auto path = folder.write(
      "dump", small_dump(1, 5) + "\n\r\n" + small_dump(2, 6) + "\n \n" + small_dump(3, 7) + "\n");
  const auto found = liggghts_text.scan(path, true);
  ASSERT_EQ(found.snapshots.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k)
    expect_small(read_at(path, found.snapshots[k], all_of_small), static_cast<std::int64_t>(k + 1),
                 k + 5);
}

TEST(LiggghtsText, ALastRowWithoutLineEndIsWholeOnlyWithTheBlankThatLiggghtsWrites) {
  const auto text = small_dump(9, 4);
  expect_small(read_text(text.substr(0, text.size() - 1), all_of_small), 9, 4);
  EXPECT_EQ(error_of_text(text.substr(0, text.size() - 2)),
            "line 13: the last value has no blank or line end behind it: file is cut");
}

TEST(LiggghtsText, AHeaderThatBeginsTwiceIsADumpThatWasKilledAndWentOn) {
  EXPECT_EQ(error_of_text("ITEM: TIMESTEP\n8\n" + small_dump(9, 4)),
            "line 3: \"ITEM: TIMESTEP\" twice, of step 8 without its particles");
}

TEST(LiggghtsText, ABoxWithoutBoundaryFlagsIsOldLammps) {
  const auto snapshot = read_text(dump_header(1, 1, "x", "\n0 1\n0 1\n0 2\n") + "1 \n", {"x"});
  EXPECT_TRUE(snapshot.box.known);
  EXPECT_EQ(snapshot.box.max[2], 2);
  EXPECT_EQ(snapshot.box.periodic, (std::array{false, false, false}));
}

TEST(LiggghtsText, AFileWithoutABoxHasNone) {
  const auto text = "ITEM: TIMESTEP\n3\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS x\n1 \n";
  EXPECT_FALSE(read_text(text, {"x"}).box.known);
  EXPECT_NE(error_of_text(replaced(text, "ATOMS x", "ATOMS xs")).find("need the box"),
            std::string::npos);
}

// --- large files

/// Snapshots with rows of every length; x of particle i is i, the name of the rest is padding.
std::string padded_dump(std::int64_t step, std::size_t particles, std::mt19937_64& random,
                        std::size_t longest) {
  std::string text = dump_header(step, particles, "id pad x vx");
  for (std::size_t i = 0; i < particles; ++i)
    text += fmt::format("{} {} {} {}.5 \n", i, std::string(1 + random() % longest, 'p'), i, step);
  return text;
}

void expect_padded(const Snapshot& snapshot, std::int64_t step, std::size_t particles) {
  ASSERT_EQ(snapshot.step, step);
  ASSERT_EQ(snapshot.particles, particles);
  for (std::size_t i = 0; i < particles; ++i) {
    ASSERT_EQ(snapshot.columns[0][i], static_cast<double>(i));
    ASSERT_EQ(snapshot.columns[1][i], static_cast<double>(step) + .5);
  }
}

TEST(LiggghtsText, RowsMayEndAnywhereAroundTheEndOfAPieceThatIsRead) {
  // Shifted byte by byte, so that each place of the last rows comes to lie on the piece's edge:
  // within a number, at a blank, before and behind the line end.
  const TemporaryFolder folder;
  std::mt19937_64 random(2);
  const auto tail = padded_dump(8, 3000, random, 50);
  ASSERT_GT(tail.size(), 40'000U);
  const std::size_t rows = 2600;
  // Words that are no headers, as they do not begin a line; the one after the edge begins a piece.
  std::string pad = "p";
  while (pad.size() < 92) pad += "ITEM:";
  std::string first = dump_header(7, rows, "id pad x vx");
  for (std::size_t i = 0; i < rows; ++i)
    first += fmt::format("{} {} {} 7.5 \n", i, pad.substr(i % 3), i);
  ASSERT_LT(first.size(), ByteWindow::piece + 30'000);
  ASSERT_GT(first.size(), ByteWindow::piece);
  for (std::size_t shift = 0; shift < 130; ++shift) {
    const auto path = folder.write("dump", fmt::format("{:\n>{}}{}{}", "", shift, first, tail));
    const auto found = liggghts_text.scan(path, true);
    ASSERT_EQ(found.snapshots.size(), 2U);
    ASSERT_EQ(found.cut, "");
    ASSERT_NO_FATAL_FAILURE(expect_padded(read_at(path, found.snapshots[0], {"x", "vx"}), 7, rows))
        << shift;
    ASSERT_NO_FATAL_FAILURE(expect_padded(read_at(path, found.snapshots[1], {"x", "vx"}), 8, 3000))
        << shift;
  }
}

TEST(LiggghtsText, AHeaderMayLieAcrossTheEndOfAPieceThatIsRead) {
  const TemporaryFolder folder;
  std::mt19937_64 random(3);
  auto first = padded_dump(7, 3300, random, 120);
  first.pop_back();
  ASSERT_EQ(first.back(), ' ');
  const auto second = small_dump(8, 30);
  // Blanks behind the last row move the second header over the edge.
  const auto edge = (first.size() / ByteWindow::piece + 1) * ByteWindow::piece;
  for (std::size_t k = 0; k < 150; ++k) {
    const auto blanks = edge - first.size() - 1 - k;
    const auto path = folder.write("dump", fmt::format("{}{:>{}}\n{}", first, "", blanks, second));
    const auto found = liggghts_text.scan(path, true);
    ASSERT_EQ(found.snapshots.size(), 2U) << k;
    ASSERT_EQ(found.snapshots[1].step, 8) << k;
    const auto read = read_at(path, found.snapshots[1], all_of_small);
    ASSERT_NO_FATAL_FAILURE(expect_small(read, 8, 30)) << k;
    if (k % 30 != 0) continue;
    const auto before = read_at(path, found.snapshots[0], {"x", "vx"});
    ASSERT_NO_FATAL_FAILURE(expect_padded(before, 7, 3300)) << k;
  }
}

TEST(LiggghtsText, RowsLongerThanThePieceThatIsReadAreRead) {
  const std::string pad(3 * ByteWindow::piece, 'p');
  const auto text = dump_header(7, 3, "id pad x vx") +
                    fmt::format("0 {0} 0 7.5 \n1 p 1 7.5 \n2 {0} 2 7.5 \n", pad);
  expect_padded(read_text(text, {"x", "vx"}), 7, 3);
  EXPECT_EQ(scan_text(text + small_dump(9, 2)).snapshots.size(), 2U);
}

TEST(LiggghtsText, ManyColumnsAreRead) {
  std::string names, row;
  for (int k = 0; k < 5000; ++k) {
    names += fmt::format("c_{} ", k);
    row += fmt::format("{} ", k);
  }
  const auto snapshot =
      read_text(dump_header(1, 2, names) + row + "\n" + row + "\n", {"c_0", "c_4999", "c_63"});
  EXPECT_EQ(snapshot.columns, (std::vector<std::vector<double>>{{0, 0}, {4999, 4999}, {63, 63}}));
}

TEST(LiggghtsText, SnapshotsOfOneFileCanBeReadInAnyOrderPlainAndGzip) {
  const TemporaryFolder folder;
  std::mt19937_64 random(4);
  std::string text;
  std::vector<std::size_t> particles;
  for (std::int64_t step = 0; step < 40; ++step) {
    particles.push_back(random() % 4000);
    text += padded_dump(step, particles.back(), random, 60);
  }
  ASSERT_GT(text.size(), 12 * ByteWindow::piece);  // several checkpoints
  const auto half = text.size() / 2;
  for (const auto& path :
       {folder.write("plain", text), folder.write("one", gzip(text)),
        folder.write("two", gzip(text.substr(0, half)) + gzip(text.substr(half)))}) {
    const auto found = liggghts_text.scan(path, true);
    ASSERT_EQ(found.snapshots.size(), 40U);
    EXPECT_TRUE(found.problems.empty());
    EXPECT_EQ(found.snapshots.back().checkpoint != nullptr, path != folder.path("plain"));
    Scratch scratch;
    Snapshot snapshot;
    const auto request = request_of({"x", "vx"});
    for (int i = 0; i < 80; ++i) {
      const auto k = random() % 40;
      liggghts_text.read(path, found.snapshots[k], request, snapshot, scratch);
      ASSERT_NO_FATAL_FAILURE(expect_padded(snapshot, static_cast<std::int64_t>(k), particles[k]));
      if (k >= 30) {  // entered at a checkpoint, not at the start
        ASSERT_LT(static_cast<double>(snapshot.bytes_read),
                  .6 * static_cast<double>(fs::file_size(path)));
      }
    }
  }
}

TEST(LiggghtsText, BuffersMayBeSharedBetweenDumpsOfDifferentColumnsAndSizes) {
  const TemporaryFolder folder;
  const auto a = folder.write("a", small_dump(1, 900));
  const auto b = folder.write("b", dump_header(2, 2, "radius x id") + ".5 3 1 \n.25 4 2 \n");
  Scratch scratch;
  Snapshot snapshot;
  const auto located_a = liggghts_text.scan(a, true).snapshots[0];
  const auto located_b = liggghts_text.scan(b, true).snapshots[0];
  for (int i = 0; i < 3; ++i) {
    liggghts_text.read(a, located_a, request_of(all_of_small), snapshot, scratch);
    ASSERT_NO_FATAL_FAILURE(expect_small(snapshot, 1, 900));
    liggghts_text.read(b, located_b, {{"x"}, {"y", false}, {"radius"}, {"x"}}, snapshot, scratch);
    ASSERT_EQ(snapshot.columns, (std::vector<std::vector<double>>{{3, 4}, {}, {.5, .25}, {3, 4}}));
  }
}

// --- a glance instead of a scan

TEST(LiggghtsText, AGlanceNeverDropsASecondSnapshotWhateverItsSize) {
  const TemporaryFolder folder;
  int single = 0, indexed = 0;
  for (const std::size_t first : {0U, 1U, 20U, 99U, 100U, 101U, 500U, 3000U})
    for (const std::size_t second : {0U, 1U, 7U, 30U, 100U, 130U, 700U, 8000U})
      for (const bool packed : {false, true})
        for (const std::string gap : {"", "\n"}) {
          const auto text = small_dump(5000, first) + gap + small_dump(5001, second);
          const auto path = folder.write("dump5000.liggghts", packed ? gzip(text) : text);
          SCOPED_TRACE(fmt::format("{} {} {}", first, second, packed));
          const auto found = liggghts_text.scan(path, false);
          if (found.snapshots.size() == 2) {
            ++indexed;
            ASSERT_NO_FATAL_FAILURE(
                expect_small(read_at(path, found.snapshots[1], all_of_small), 5001, second));
            ASSERT_NO_FATAL_FAILURE(
                expect_small(read_at(path, found.snapshots[0], all_of_small), 5000, first));
          } else {
            ++single;
            ASSERT_EQ(found.snapshots.size(), 1U);
            const auto error = error_of([&] { read_at(path, found.snapshots[0], {"x"}); });
            ASSERT_NE(error.find("further snapshots"), std::string::npos) << error;
          }
        }
  EXPECT_GT(single, 5);  // the guess is really made
  EXPECT_GT(indexed, 100);
}

TEST(LiggghtsText, AGlanceNeverDropsTheSecondMemberOfAGzipFile) {
  // The trailer of a gzip file tells the size of its last member only.
  const TemporaryFolder folder;
  for (const std::size_t second : {0U, 3U, 200U, 300U, 5000U}) {
    const auto path =
        folder.write("dump5000.gz", gzip(small_dump(5000, 300)) + gzip(small_dump(5001, second)));
    const auto found = liggghts_text.scan(path, false);
    if (found.snapshots.size() == 2) continue;
    EXPECT_NE(
        error_of([&] { read_at(path, found.snapshots.at(0), {"x"}); }).find("further snapshots"),
        std::string::npos)
        << second;
  }
}

TEST(LiggghtsText, AGlanceAtOneSnapshotGivesWhatAScanGives) {
  const TemporaryFolder folder;
  for (const std::size_t particles : {0U, 50U, 100U, 4000U})
    for (const bool packed : {false, true}) {
      const auto text = small_dump(5000, particles);
      const auto path = folder.write("dump5000", packed ? gzip(text) : text);
      const auto quick = liggghts_text.scan(path, false);
      const auto full = liggghts_text.scan(path, true);
      ASSERT_EQ(quick.snapshots.size(), 1U);
      ASSERT_EQ(full.snapshots.size(), 1U);
      EXPECT_EQ(quick.snapshots[0].step, full.snapshots[0].step);
      EXPECT_EQ(quick.snapshots[0].particles, full.snapshots[0].particles);
      EXPECT_EQ(*quick.snapshots[0].columns, *full.snapshots[0].columns);
      EXPECT_TRUE(quick.snapshots[0].box == full.snapshots[0].box);
      expect_small(read_at(path, quick.snapshots[0], all_of_small), 5000, particles);
    }
}

TEST(LiggghtsText, ACutFileThatAGlanceTookForWholeIsAnErrorWhenItIsRead) {
  const TemporaryFolder folder;
  const auto text = small_dump(5000, 1000);
  for (const auto size : {text.size() - 3, text.size() - 400, text.size() / 2}) {
    const auto path = folder.write("dump5000", text.substr(0, size));
    const auto found = liggghts_text.scan(path, false);
    EXPECT_NE(error_of([&] { read_at(path, found.snapshots.at(0), {"x"}); }), "") << size;
  }
}

// --- broken files

TEST(LiggghtsText, TheSnapshotsBeforeACutOneAreGivenAndTheCutOneIsNamed) {
  const auto whole = small_dump(1, 5) + small_dump(2, 5);
  const auto third = small_dump(3, 5);
  for (std::size_t size = 1; size + 1 < third.size(); ++size) {
    const auto found = scan_text(whole + third.substr(0, size));
    ASSERT_EQ(found.snapshots.size(), 2U) << third.substr(0, size);
    ASSERT_NE(found.cut, "") << third.substr(0, size);
    // The one before the cut one can still be read.
    const TemporaryFolder folder;
    const auto path = folder.write("dump", whole + third.substr(0, size));
    ASSERT_NO_FATAL_FAILURE(expect_small(
        read_at(path, liggghts_text.scan(path, true).snapshots[1], all_of_small), 2, 5));
  }
  EXPECT_EQ(scan_text(whole + third).cut, "");
  const auto found = scan_text(whole + third.substr(0, third.size() - 30));
  EXPECT_EQ(found.cut, "snapshot 3: after line 40: 5 declared, 3 present");
  EXPECT_EQ(scan_text(gzip(whole + third)).snapshots.size(), 3U);
}

TEST(LiggghtsText, ACutGzipFileGivesItsCompleteSnapshots) {
  const TemporaryFolder folder;
  std::mt19937_64 random(5);
  std::string text;
  for (std::int64_t step = 0; step < 12; ++step) text += padded_dump(step, 500, random, 60);
  const auto packed = gzip(text);
  const auto size = packed.size() / 2;
  const auto path = folder.write("dump.gz", packed.substr(0, size));
  const auto found = liggghts_text.scan(path, true);
  EXPECT_GT(found.snapshots.size(), 2U);
  EXPECT_LT(found.snapshots.size(), 10U);
  EXPECT_NE(found.cut.find(fmt::format("gzip stream ends early at offset {}", size)),
            std::string::npos);
  for (const auto& located : found.snapshots)
    expect_padded(read_at(path, located, {"x", "vx"}), located.step, 500);
  const auto short_path = folder.write("short.gz", packed.substr(0, 300));
  EXPECT_EQ(error_of([&] {
              liggghts_text.scan(short_path, true);
            }).find(short_path + ": gzip stream ends early at offset 300: 500 declared, "),
            0U);
}

TEST(LiggghtsText, BytesBehindAGzipStreamAreWorthAWarning) {
  const auto found = scan_text(gzip(small_dump(1, 5)) + "garbage");
  ASSERT_EQ(found.problems.size(), 1U);
  EXPECT_NE(found.problems[0].find("bytes after the gzip stream ignored"), std::string::npos);
}

TEST(LiggghtsText, StepsThatGoBackAreWorthAWarning) {
  const auto found = scan_text(small_dump(20, 2) + small_dump(10, 2));
  ASSERT_EQ(found.problems.size(), 1U);
  EXPECT_EQ(found.problems[0], "steps are not in order: 20 then 10; sorted by step");
}

TEST(LiggghtsText, ATailOfZeroBytesLeavesTheSnapshotsBefore) {
  const auto found = scan_text(small_dump(1, 5) + std::string(1000, '\0'));
  ASSERT_EQ(found.snapshots.size(), 1U);
  EXPECT_NE(found.cut.find("line 15"), std::string::npos) << found.cut;
  EXPECT_NE(found.cut.find("NUL bytes"), std::string::npos) << found.cut;
}

TEST(LiggghtsText, EachErrorNamesLineExpectedAndFound) {
  const auto good = small_dump(1, 4);
  struct Case {
    std::string from, to, error;
  };
  const std::vector<Case> cases{
      {"ITEM: NUMBER OF ATOMS\n4", "ITEM: NUMBER OF ATOMS\n-4", "line 4: count is negative: -4"},
      {"ITEM: NUMBER OF ATOMS\n4", "ITEM: NUMBER OF ATOMS\n4e0",
       "line 4: expected an integer (the number of atoms), found \"4e0\""},
      {"ITEM: NUMBER OF ATOMS\n4", "ITEM: NUMBER OF ATOMS\n99999999999999999999",
       "line 4: the number of atoms does not fit in 64 bits: \"99999999999999999999\""},
      {"ITEM: NUMBER OF ATOMS\n4", "ITEM: NUMBER OF ATOMS\n9223372036854775807",
       "after line 13: 9223372036854775807 declared, 4 present"},
      {"ITEM: NUMBER OF ATOMS\n4", "ITEM: NUMBER OF BONDS\n4",
       "line 3: unknown section \"ITEM: NUMBER OF BONDS\""},
      {"ITEM: TIMESTEP\n1\n", "ITEM: TIMESTEP\n-9223372036854775808\n",
       "line 2: the step does not fit in 64 bits: \"-9223372036854775808\""},
      {"ITEM: TIMESTEP\n1\n", "ITEM: TIMESTEP\n",
       "line 2: expected the step, found \"ITEM: NUMBER OF ATOMS\""},
      {"ITEM: TIMESTEP\n1\n", "ITEM: UNITS\nsi\n",
       "line 9: \"ITEM: ATOMS\" before \"ITEM: TIMESTEP\""},
      {"0 1\n0 1\n0 2\n", "0 1\n0 1\n",
       "line 8: expected 2 box numbers, found \"ITEM: ATOMS id type x y z radius \""},
      {"0 1\n0 1\n0 2\n", "0 1\n1 0\n0 2\n", "line 7: box has no width in y: 1 0"},
      {"0 1\n0 1\n0 2\n", "0 1\nnan 0\n0 2\n", "line 7: box has no width in y: nan 0"},
      {"BOX BOUNDS ff ff ff", "BOX BOUNDS abc origin",
       "line 5: a general triclinic box (\"abc origin\") is not supported"},
      {"ATOMS id type x y z radius", "ATOMS id type y z radius",
       "line 9: no position column \"x\""},
      {"ATOMS id type x y z radius", "ATOMS id type x y z radius c_1",
       "line 10: 7 values expected (line 9), 6 found"},
      {"ATOMS id type x y z radius", "ATOMS id type x y z",
       "line 10: 5 values expected (line 9), 6 found"},
      {"2 1 2.001", "2 1 2,001", "line 11, column x: \"2,001\" is not a number"},
      {"2 1 2.001", "2 1 2.001D0", "line 11, column x: \"2.001D0\" is not a number (D exponent)"},
      {"2 1 2.001", "2 1", "line 11: 6 values expected (line 9), 5 found"},
      {"2 1 2.001", "2 1 2.001 2", "line 11: 6 values expected (line 9), 7 found"},
      {"2 1 2.001", std::string("2 1 2\0 1", 8), "line 11: NUL byte"},
      {"ITEM: NUMBER OF ATOMS\n4", "ITEM: NUMBER OF ATOMS\n3",
       "line 13: 3 particles declared, more rows found"},
      {"ITEM: NUMBER OF ATOMS\n4", "ITEM: NUMBER OF ATOMS\n5",
       "after line 13: 5 declared, 4 present"}};
  for (const auto& [from, to, error] : cases) {
    const auto text = replaced(good, from, to);
    ASSERT_NE(text, good) << from;
    EXPECT_EQ(error_of_text(text).substr(0, error.size()), error);
    // The same snapshot behind another one: the file's own line numbers.
    if (error.find("after line") == error.npos) {
      const TemporaryFolder folder;
      const auto path = folder.write("dump", small_dump(0, 3) + text);
      const auto later = error_of([&] {
        const auto found = liggghts_text.scan(path, true);
        if (found.snapshots.size() == 1) throw FormatError("{}: {}", path, found.cut);
        read_at(path, found.snapshots.at(1), {"x"});
      });
      const auto number = std::stoi(error.substr(5)) + 12;
      EXPECT_NE(later.find(fmt::format(": line {}", number)), later.npos) << later;
    }
  }
}

TEST(LiggghtsText, DumpLocalIsNotParticles) {
  for (const auto& text : {bytes_of(data / "local_10500.liggghts"),
                           std::string("ITEM: TIMESTEP\n0\nITEM: NUMBER OF CONTACTS\n1\nITEM: BOX "
                                       "BOUNDS ff ff ff\n0 1\n0 1\n0 1\n"
                                       "ITEM: CONTACTS c_1 \n1 \n")}) {
    const auto what = scan_text(text).not_particles;
    EXPECT_NE(what.find("dump local"), what.npos) << what;
  }
}

TEST(LiggghtsText, AFileThatChangedSinceItWasOpenedIsNotReadAsTheOldOne) {
  const TemporaryFolder folder;
  const auto path = folder.write("dump", small_dump(1, 5));
  const auto located = liggghts_text.scan(path, true).snapshots[0];
  folder.write("dump", small_dump(2, 5));
  EXPECT_EQ(error_of([&] { read_at(path, located, {"x"}); }),
            path + ": offset 0: the file has changed since it was opened");
}

TEST(LiggghtsText, ACountThatLiesReservesNoMemory) {
  // 2^40 rows would be 8 TB a column; the gzip file could hold a thousand times its size at most.
  const auto text = replaced(small_dump(1, 4), "ATOMS\n4", "ATOMS\n1099511627776");
  EXPECT_EQ(error_of_text(text), "after line 13: 1099511627776 declared, 4 present");
  const TemporaryFolder folder;
  for (const auto& content : {text, gzip(text)}) {
    const auto path = folder.write("dump", content);
    Located located;
    located.step = 1;
    located.particles = 1099511627776;
    EXPECT_EQ(error_of([&] { read_at(path, located, {"x"}); }),
              path + ": after line 13: 1099511627776 declared, 4 present");
  }
}

TEST(LiggghtsText, TheLineOfAParticleIsKnown) {
  const TemporaryFolder folder;
  const auto path = folder.write("dump", fmt::format("\n{}{}", small_dump(1, 5), small_dump(2, 5)));
  const auto found = liggghts_text.scan(path, true);
  EXPECT_EQ(liggghts_text.place(path, found.snapshots[0], 0), "line 11");
  EXPECT_EQ(liggghts_text.place(path, found.snapshots[1], 4), "line 29");
}

TEST(LiggghtsText, AppendedStepsAreFound) {
  const auto path = (data / "append.liggghts").string();
  const auto found = liggghts_text.scan(path, true);
  ASSERT_EQ(found.snapshots.size(), 3U);
  for (const auto& located : found.snapshots) {
    EXPECT_EQ(located.particles, 51);
    EXPECT_EQ(sum(read_at(path, located, {"type"}).columns[0]),
              sum(read_first(path, {"type"}).columns[0]));
  }
}

}  // namespace
}  // namespace bedscope::readers
