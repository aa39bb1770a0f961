// SPDX-License-Identifier: BSD-3-Clause
// An analysis that goes on where an earlier one ended gives what a fresh one gives, to the bit.
#include <cmath>
#include <random>

#include "analysis/analyse_run.hpp"
#include "analysis/kept_run.hpp"
#include "analysis/results_file.hpp"
#include "analysis/summary.hpp"
#include "analysis/tables.hpp"
#include "tests/readers/test_files.hpp"

namespace bedscope::analysis {
namespace {

using readers::bytes_of;
using readers::gzip;
namespace fs = std::filesystem;

/// A dump of two types with clusters, temperatures and a particle or two that are flawed.
std::string dump(std::int64_t step, std::size_t particles = 400) {
  std::mt19937 random(static_cast<unsigned>(step));
  std::uniform_real_distribution<double> even(0, 1);
  std::normal_distribution<double> normal;
  auto text = readers::dump_header(step, particles, "id type x y z vx vz radius temperature q",
                                   "ff ff ff\n0 0.1\n0 0.01\n0 0.2\n");
  const double drift = 0.02 + 0.0001 * static_cast<double>(step % 700);
  for (std::size_t i = 0; i < particles; ++i) {
    const bool in_cluster = i % 2 == 0;
    const double x = in_cluster ? 0.03 + 0.004 * normal(random) : 0.1 * even(random);
    const double z = in_cluster ? drift + 0.006 * normal(random) : 0.2 * even(random);
    text += fmt::format("{} {} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {} {:.6g} {:.6g} \n",
                        i % 97 == 96 ? 1 : i + 1, step > 900 && i % 3 == 0 ? 2 : 1, x,
                        0.01 * even(random), z, normal(random), 0.3 + normal(random),
                        i % 131 == 130 ? "0" : "0.001",
                        i % 151 == 150 ? NAN : 350 + 12 * normal(random), normal(random));
  }
  return text;
}

/// A packed bed of 4 mm spheres with a round hole that rises.
std::string bed_with_bubble(std::int64_t step) {
  const double centre = 0.02 + 1e-5 * static_cast<double>(step % 6000);
  std::string rows;
  std::size_t count = 0;
  for (int i = 0; i < 25; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 25; ++k) {
        const double x = 0.002 + 0.004 * i, z = 0.002 + 0.004 * k;
        if (std::hypot(x - 0.05, z - centre) < 0.016) continue;
        rows += fmt::format("{} 1 {:.6g} {:.6g} {:.6g} 0 0 0.002 350 1 \n", ++count, x,
                            0.002 + 0.004 * j, z);
      }
  return readers::dump_header(step, count, "id type x y z vx vz radius temperature q",
                              "ff ff ff\n0 0.1\n0 0.01\n0 0.2\n") +
         rows;
}

/// All that is written of a result, but for the work that it took.
std::string written(RunResult result, const std::string& folder) {
  fs::remove_all(folder);
  result.seconds = 0;
  result.snapshots_kept = 0;
  result.bytes_read = 0;
  const std::vector<RunResult> results{std::move(result)};
  write_tables(results, folder + "/tables");
  write_results_file(results, folder + "/results.h5");
  std::string all = summary_text(results);
  std::vector<fs::path> files;
  for (const auto& item : fs::recursive_directory_iterator(folder))
    if (item.is_regular_file()) files.push_back(item.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) all += file.filename().string() + "\n" + bytes_of(file);
  return all;
}

/// What this process has read so far.
std::uint64_t bytes_read() {
  std::ifstream file("/proc/self/io");
  std::string name;
  std::uint64_t count = 0;
  file >> name >> count;
  return count;
}

class Resume : public testing::Test {
 protected:
  Resume() {
    settings.label = "run";
    settings.particles = folder.path("post");
    settings.time_step = 1e-4;
    settings.domain = {{{0, 0, 0}, {0.1, 0.01, 0.2}}};
    settings.cell = {0.005, 0.005};
    settings.density.all = 2500;
    settings.average = {-INFINITY, INFINITY};
    settings.temperature = {330., 370.};
    settings.species = {{"hot", "temperature", SpeciesRule::Comparison::greater, 350}};
    settings.clusters = {0.1, 0.15, 60e-6};
    fs::create_directories(folder.path("post"));
  }

  void add(std::int64_t step) const { add(step, dump(step)); }
  void add(std::int64_t step, const std::string& text) const {
    folder.write(fmt::format("post/dump{}.liggghts", step), text);
  }
  void add(std::int64_t first, std::int64_t last, std::int64_t gap) const {
    for (auto step = first; step <= last; step += gap) add(step);
  }

  std::string fresh(int threads = 1) const {
    AnalysisOptions options;
    options.threads = threads;
    return written(analyse_run(settings, options), folder.path("fresh"));
  }
  AnalysisOptions keeping(int threads = 1) {
    AnalysisOptions options;
    options.threads = threads;
    options.keep = {folder.path("index"), folder.path("state"), folder.path("index"),
                    folder.path("state")};
    options.note = [this](const std::string& text) { notes += text + "\n"; };
    return options;
  }
  /// With what the analysis before kept; `kept` snapshots of it.
  std::string resumed(int threads = 1) {
    notes.clear();
    const auto result = analyse_run(settings, keeping(threads));
    kept = result.snapshots_kept;
    return written(result, folder.path("resumed"));
  }
  void expect_the_same(std::size_t expected_kept) {
    const auto a = resumed(), b = fresh();
    const auto at = static_cast<std::size_t>(
        std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
    EXPECT_TRUE(a == b) << a.substr(at - std::min<std::size_t>(at, 100), 300) << "\n---\n"
                        << b.substr(at - std::min<std::size_t>(at, 100), 300);
    EXPECT_EQ(kept, expected_kept);
  }

  readers::TemporaryFolder folder;
  RunSettings settings;
  std::string notes;
  std::size_t kept = 0;
};

TEST_F(Resume, NothingNew) {
  add(0, 2000, 100);
  expect_the_same(0);
  const auto state = bytes_of(folder.path("state"));
  const auto before = bytes_read();
  notes.clear();
  const auto result = analyse_run(settings, keeping());
  // The state, the first bytes of each dump that tell its form and header, and their hash.
  EXPECT_LT(bytes_read() - before, state.size() + 21 * 27'000 + 100'000);
  EXPECT_EQ(result.snapshots_kept, 21U);
  EXPECT_TRUE(written(result, folder.path("resumed")) == fresh());
  EXPECT_EQ(notes, "");
}

TEST_F(Resume, GrowingFolder) {
  add(0, 300, 100);
  expect_the_same(0);
  add(400);
  expect_the_same(3);  // the last one's ids are looked at, but only as the last one
  add(500, 1500, 100);
  expect_the_same(4);
  add(1600);
  expect_the_same(15);
  add(1700);
  expect_the_same(17);  // number 16 is looked at wholly wherever it stands
  AnalysisOptions options;
  options.threads = 1;
  EXPECT_EQ(analyse_run(settings, keeping()).bytes_read, analyse_run(settings, options).bytes_read);
  add(1800, 6000, 100);
  expect_the_same(17);
}

TEST_F(Resume, GrowingFolderWithAuto) {
  settings.average.reset();
  add(0, 4700, 100);
  expect_the_same(0);
  add(4800, 5000, 100);
  expect_the_same(47);
  expect_the_same(51);
  add(5100, 9000, 100);
  expect_the_same(50);
}

TEST_F(Resume, UnevenSpacingWithAuto) {
  settings.average.reset();
  add(0, 2000, 100);
  add(2050, 4000, 50);
  expect_the_same(0);
  expect_the_same(60 + 1);
  add(4050);
  EXPECT_TRUE(resumed() == fresh());
  EXPECT_GE(kept, 60U);
  add(4100, 9000, 50);  // the window moves
  EXPECT_TRUE(resumed() == fresh());
}

TEST_F(Resume, EvenSpacingThatBecomesUneven) {
  settings.average.reset();
  add(0, 3900, 100);
  expect_the_same(0);
  add(3950, 4500, 50);
  EXPECT_TRUE(resumed() == fresh());
  add(4600, 5000, 100);
  EXPECT_TRUE(resumed() == fresh());
}

TEST_F(Resume, AWindowThatEndsWithinTheRun) {
  settings.average = {0.03, 0.08};
  add(0, 700, 100);
  expect_the_same(0);
  add(800, 1200, 100);
  expect_the_same(7);
  add(1300, 1400, 100);
  expect_the_same(12);
}

TEST_F(Resume, AWindowThatIsStillToCome) {
  settings.average = {0.05, 0.08};
  add(0, 300, 100);
  EXPECT_THROW(resumed(), EmptyWindow);
  add(400, 600, 100);
  expect_the_same(0);
  add(700);
  expect_the_same(6);
}

TEST_F(Resume, ThreadsDoNotMatter) {
  add(0, 1500, 100);
  resumed(3);
  add(1600, 3500, 100);
  const auto three = resumed(3);
  EXPECT_EQ(kept, 15U);
  EXPECT_TRUE(three == fresh(2));
  add(3600, 4000, 100);
  EXPECT_TRUE(resumed(1) == fresh(3));
}

TEST_F(Resume, AllInOneDump) {
  settings.particles = folder.path("all.dump");
  std::string text;
  for (int step = 0; step < 1000; step += 100) text += dump(step);
  folder.write("all.dump", text);
  expect_the_same(0);
  const auto grow = [&](const std::string& more) {
    std::ofstream(folder.path("all.dump"), std::ios::app) << more;
  };
  grow(dump(1000).substr(0, 5000));  // cut
  expect_the_same(10);
  EXPECT_TRUE(fs::exists(folder.path("index")));
  grow(dump(1000).substr(5000) + dump(1100) + dump(1200));
  const auto before = bytes_read();
  resumed();
  EXPECT_EQ(kept, 9U);
  // Four snapshots, and eight for their pictures; five to find the new ones.
  EXPECT_LT(bytes_read() - before, 19 * text.size() / 10 + 3 * fs::file_size(folder.path("state")));
  expect_the_same(13);
  folder.write("all.dump", text + dump(1050) + dump(1100) + dump(1200) + dump(1300));
  expect_the_same(0);
  folder.write("all.dump", dump(50) + text);
  expect_the_same(0);
  EXPECT_NE(notes.find("all.dump: step 0 is not what it was"), std::string::npos) << notes;
}

TEST_F(Resume, GzipAndVtk) {
  for (int step = 0; step < 800; step += 100)
    folder.write(fmt::format("post/dump{}.gz", step), gzip(dump(step)));
  expect_the_same(0);
  folder.write("post/dump800.gz", gzip(dump(800)));
  expect_the_same(7);
  settings.particles = folder.path("vtk");
  settings.species.clear();
  settings.density = {};
  fs::create_directories(folder.path("vtk"));
  for (int step = 0; step < 800; step += 100)
    folder.write(fmt::format("vtk/p{}.vtk", step), readers::small_vtk(20));
  expect_the_same(0);
  EXPECT_NE(notes.find("other settings"), std::string::npos);
  folder.write("vtk/p800.vtk", readers::small_vtk(20));
  expect_the_same(7);
}

TEST_F(Resume, AThreeDimensionalGridAndOtherKernels) {
  for (const std::string mapping : {"centre", "divided", "gaussian"}) {
    settings.mapping = mapping;
    settings.cell = {0.01, 0.005, 0.01};
    add(0, 500, 100);
    expect_the_same(0);
    add(600);
    expect_the_same(5);
    fs::remove(folder.path("post/dump600.liggghts"));
  }
}

TEST_F(Resume, BubblesAndBedHeight) {
  settings.bed = true;
  settings.bubbles = {0.7, 0.9, 100e-6};
  for (int step = 0; step < 1000; step += 100) add(step, bed_with_bubble(step));
  expect_the_same(0);
  for (int step = 1000; step < 4000; step += 100) add(step, bed_with_bubble(step));
  expect_the_same(9);
  const auto result = analyse_run(settings, keeping());
  EXPECT_GE(result.bubbles->bubbles.size(), 20U);
  EXPECT_EQ(result.snapshots_kept, 40U);
  settings.bubbles->threshold = 0.75;
  expect_the_same(0);
}

TEST_F(Resume, OneFilePerProcessor) {
  const auto add_pieces = [&](std::int64_t step) {
    const auto text = dump(step, 96);
    const auto body = text.find("q \n") + 3;
    auto middle = body;
    for (int row = 0; row < 40; ++row) middle = text.find('\n', middle) + 1;
    const auto head = [&](const char* count) {
      return readers::replaced(text.substr(0, body), "ATOMS\n96", fmt::format("ATOMS\n{}", count));
    };
    folder.write(fmt::format("post/dump{}.liggghts_0", step),
                 head("40") + text.substr(body, middle - body));
    folder.write(fmt::format("post/dump{}.liggghts_1", step), head("56") + text.substr(middle));
  };
  for (int step = 0; step < 900; step += 100) add_pieces(step);
  expect_the_same(0);
  EXPECT_EQ(analyse_run(settings, keeping()).inventory.front().particles, 96);
  add_pieces(900);
  expect_the_same(8);
  add_pieces(300);  // written again, both of them; then one
  expect_the_same(0);
  const auto piece = folder.path("post/dump200.liggghts_1");
  folder.write("post/dump200.liggghts_1", bytes_of(piece));
  expect_the_same(0);
  EXPECT_NE(notes.find("step 200"), std::string::npos) << notes;
}

TEST_F(Resume, OtherSettingsBeginAnew) {
  add(0, 600, 100);
  resumed();
  const std::vector<std::function<void()>> changes{
      [&] {
        settings.cell = {0.004, 0.005};
      },
      [&] { settings.density.all = 2000; },
      [&] {
        settings.density = {2000, {{2, 1000}}};
      },
      [&] { settings.heights = {0.1}; },
      [&] { settings.band = 0.02; },
      [&] { settings.height_at_rest = 0.1; },
      [&] { settings.bed = true; },
      [&] { settings.clusters.core = 0.2; },
      [&] { settings.mapping = "centre"; },
      [&] { settings.species[0].value = 340; },
      [&] { settings.temperature_bins = 10; },
      [&] {
        settings.periodic = {true, false, false};
      },
      [&] { settings.time_step = 2e-4; },
      [&] { settings.step_zero = 100; },
      [&] {
        settings.average = {0.02, 1};
      },
      [&] { settings.average.reset(); },
      [&] { settings.radius.all = 0.002; },
      [&] {
        settings.lateral = 1, settings.cells = {4, 40}, settings.cell = {};
      }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    changes[i]();
    expect_the_same(0);
    EXPECT_NE(notes, "") << i;
    EXPECT_EQ(std::count(notes.begin(), notes.end(), '\n'), 1) << notes;
    expect_the_same(7);
    EXPECT_EQ(notes, "");
  }
  settings.label = "another name";
  expect_the_same(7);
}

TEST_F(Resume, DumpsThatAreNotWhatTheyWereBeginAnew) {
  add(0, 1000, 100);
  resumed();
  const auto began_anew = [&](const char* what) {
    expect_the_same(0);
    EXPECT_NE(notes, "") << what;
  };
  add(300, dump(12345));  // other particles under the step of its name
  folder.write("post/dump300.liggghts",
               readers::replaced(dump(12345), "TIMESTEP\n12345", "TIMESTEP\n300"));
  began_anew("replaced");
  add(350);
  began_anew("late");
  fs::remove(folder.path("post/dump0.liggghts"));
  began_anew("gone");
  const auto path = folder.path("post/dump500.liggghts");
  const auto time = fs::last_write_time(path);
  std::fstream(path, std::ios::in | std::ios::out).seekp(3000) << "9";
  fs::last_write_time(path, time);
  began_anew("changed, and its time set back");
}

TEST_F(Resume, ALateSnapshotJustBeforeTheLastChangesWeightsOnly) {
  add(0, 1000, 100);
  resumed();
  add(950);
  expect_the_same(0);
  fs::remove(folder.path("post/dump950.liggghts"));
  resumed();
  fs::remove(folder.path("post/dump1000.liggghts"));
  add(1100);
  expect_the_same(0);
}

TEST_F(Resume, ALastDumpThatWasCutAndIsWholeNow) {
  add(0, 900, 100);
  add(1000, dump(1000).substr(0, 9000));
  expect_the_same(0);
  add(1000);
  expect_the_same(9);
  add(1100, dump(1100).substr(0, 70));
  expect_the_same(11);
}

TEST_F(Resume, ADamagedOrForeignStateIsSaidAndIgnored) {
  add(0, 300, 100);
  const auto expected = fresh();
  resumed();
  const auto path = folder.path("state");
  const auto whole = bytes_of(path);
  const auto check = [&](const std::string& bytes) {
    fs::remove(path);
    std::ofstream(path, std::ios::binary) << bytes;
    EXPECT_TRUE(resumed() == expected);
    EXPECT_EQ(kept, 0U);
    EXPECT_NE(notes.find("begins anew"), std::string::npos);
  };
  for (std::size_t at = 0; at < whole.size(); at += whole.size() / 15) {
    auto damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x41);
    check(damaged);
    check(whole.substr(0, at));
  }
  check("bedscope state of a run, version 0\n");
  check(whole + "x");
}

TEST_F(Resume, AStateThatCannotBeWrittenIsSaidAndTheResultStands) {
  add(0, 300, 100);
  auto options = keeping();
  options.keep.state = folder.path("post/dump0.liggghts/state");
  EXPECT_TRUE(written(analyse_run(settings, options), folder.path("resumed")) == fresh());
  EXPECT_NE(notes.find("dump0.liggghts: Not a directory"), std::string::npos) << notes;
}

TEST_F(Resume, AStateThatIsReadAndNotKeptAgainServesToo) {
  add(0, 500, 100);
  resumed();
  auto options = keeping();
  options.keep.state.clear();
  for (const int more :
       {0, 600, 700}) {  // nothing new; one; two, of which the first moves a weight
    if (more > 0) add(more);
    EXPECT_TRUE(written(analyse_run(settings, options), folder.path("resumed")) == fresh()) << more;
  }
}

TEST_F(Resume, PicturesOrNone) {
  add(0, 300, 100);
  resumed();
  auto options = keeping();
  options.pictures = false;
  const auto without = analyse_run(settings, options);
  EXPECT_EQ(without.snapshots_kept, 0U);
  EXPECT_TRUE(without.frames.empty());
  expect_the_same(0);
}

TEST_F(Resume, ALiveAnalysisGoesOnWithAKeptOneAndIsKept) {
  add(0, 1000, 100);
  resumed();
  add(1100, 1300, 100);
  {
    LiveAnalysis live(settings, keeping());
    ASSERT_TRUE(live.update());
    EXPECT_EQ(live.result().snapshots_kept, 10U);
    EXPECT_FALSE(live.update());
    EXPECT_TRUE(written(live.result(), folder.path("live")) == fresh());
    add(1400, 1500, 100);
    ASSERT_TRUE(live.update());
    EXPECT_TRUE(written(live.result(), folder.path("live")) == fresh());
    add(1450);  // late, between the last two
    ASSERT_TRUE(live.update());
    EXPECT_TRUE(written(live.result(), folder.path("live")) == fresh());
    add(300, dump(777, 50));
    folder.write("post/dump300.liggghts",
                 readers::replaced(dump(777, 50), "TIMESTEP\n777", "TIMESTEP\n300"));
    add(1600);
    ASSERT_TRUE(live.update());
    EXPECT_TRUE(written(live.result(), folder.path("live")) == fresh());
  }
  expect_the_same(18);
}

}  // namespace
}  // namespace bedscope::analysis
