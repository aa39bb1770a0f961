// SPDX-License-Identifier: BSD-3-Clause
// postProcessing tables: made ones with known answers, and all of the corpus.
#include "readers/openfoam_tables.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>

#include "tests/readers/test_files.hpp"

namespace bedscope::readers {
namespace {

constexpr const char* probes =
    "# Probe 0 (0 0 0.05)\n# Probe 1 (9 9 9)  # Not Found\n"
    "#       Probe             0             1\n#        Time\n";

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(FoamTable, probes_of_a_scalar_have_points_and_nan_where_not_found) {
  TemporaryFolder folder;
  const auto table = read_foam_table(
      folder.write("p", std::string(probes) + "  0.1  3.5  -1e+300\n  0.2  4.5  -1e+300\n"));
  ASSERT_EQ(table.points.size(), 2u);
  EXPECT_EQ(table.points[0].place, (std::array<double, 3>{0, 0, 0.05}));
  EXPECT_TRUE(table.points[0].found);
  EXPECT_FALSE(table.points[1].found);
  EXPECT_EQ(table.times, (std::vector<double>{0.1, 0.2}));
  ASSERT_EQ(table.columns.size(), 2u);
  EXPECT_EQ(table.columns[0].title, "probe 0");
  EXPECT_EQ(table.columns[0].values, (std::vector<double>{3.5, 4.5}));
  EXPECT_TRUE(std::isnan(table.columns[1].values[1]));
  ASSERT_EQ(table.problems.size(), 1u);
  EXPECT_NE(table.problems[0].find("probe 1 at (9 9 9) is outside the mesh"), std::string::npos);
}

TEST(FoamTable, probes_of_a_vector_are_taken_apart) {
  TemporaryFolder folder;
  const auto table = read_foam_table(
      folder.write("U", std::string(probes) + "  0.1  (1 -2 3e-5)  (-1e+300 -1e+300 -1e+300)\n"));
  ASSERT_EQ(table.columns.size(), 6u);
  EXPECT_EQ(table.columns[1].title, "probe 0 y");
  EXPECT_EQ(table.columns[2].values[0], 3e-5);
  EXPECT_EQ(table.columns[4].point, 1u);
  EXPECT_TRUE(std::isnan(table.columns[4].values[0]));
}

TEST(FoamTable, averages_have_the_titles_of_the_header) {
  TemporaryFolder folder;
  const auto table = read_foam_table(folder.write(
      "surfaceFieldValue.dat",
      "# Region type : patch bottom\n# Faces       : 10\n# Area        : 2.25e-03\n"
      "# Time        \tareaAverage(p)\tareaAverage(U.air)\n0.0005        \t1.8e+01\t(0 0 1.95)\n"));
  ASSERT_EQ(table.columns.size(), 4u);
  EXPECT_EQ(table.columns[0].title, "areaAverage(p)");
  ASSERT_NE(table.find("areaAverage(U.air) z"), nullptr);
  EXPECT_EQ(table.find("areaAverage(U.air) z")->values[0], 1.95);
  EXPECT_EQ(table.find("areaAverage(U.air)"), nullptr);
}

TEST(FoamTable, forces_have_two_levels_of_parentheses) {
  TemporaryFolder folder;
  const auto table = read_foam_table(
      folder.write("forces.dat",
                   "# Forces     \n# CofR       : (0 0 0)\n"
                   "# Time       forces(pressure viscous)\tmoments(pressure viscous)\n"
                   "1 \t((1 2 3) (4 5 6)) ((7 8 9) (10 11 12))\n"));
  ASSERT_EQ(table.columns.size(), 12u);
  EXPECT_EQ(table.columns[4].title, "forces viscous y");
  EXPECT_EQ(table.find("moments pressure z")->values[0], 9);
}

TEST(FoamTable, words_are_kept_as_text) {
  TemporaryFolder folder;
  const auto table = read_foam_table(
      folder.write("solverInfo.dat",
                   "# Solver information\n# Time\tp_solver\tp_initial\tp_converged\n"
                   "0.1\tGAMG\t1e-3\ttrue\n0.2\tGAMG\t2e-3\tfalse\n"));
  ASSERT_EQ(table.columns.size(), 3u);
  EXPECT_EQ(table.columns[0].words, (std::vector<std::string>{"GAMG", "GAMG"}));
  EXPECT_TRUE(table.columns[0].values.empty());
  EXPECT_EQ(table.columns[1].values, (std::vector<double>{1e-3, 2e-3}));
}

TEST(FoamTable, joins_restarts_and_the_later_start_wins) {
  TemporaryFolder folder;
  for (const auto* sub : {"0", "0.2", "0.4"}) fs::create_directories(folder.path(sub));
  const std::string header = "# Time\tsum(phi)\n";
  folder.write("0/flow.dat", header + "0.1\t1\n0.2\t2\n0.3\t3\n0.4\t4\n");
  folder.write("0.2/flow.dat", header + "0.3\t30\n0.4\t40\n0.5\t50\n0.6\t60\n");
  folder.write("0.2/flow_0.4.dat", header + "0.5\t500\n");
  folder.write("0.4/flow.dat", header);  // started, and wrote nothing
  folder.write("0/notes", "not a table\n");
  const auto table = open_foam_table(folder.path());
  EXPECT_EQ(table.times, (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5}));
  EXPECT_EQ(table.columns[0].values, (std::vector<double>{1, 2, 30, 40, 500}));
  EXPECT_EQ(table.files.size(), 4u);
}

TEST(FoamTable, probes_of_a_restart_are_the_same_or_an_error) {
  const TemporaryFolder folder;
  const std::string other = "# Probe 0 (0 0 1)\n# Probe 1 (1 0 0)\n# Probe 2 (2 0 0)\n";
  for (const auto* sub : {"0", "0.5"}) fs::create_directories(folder.path(sub));
  folder.write("0/p", probes);  // no rows: its probes are nobody's
  folder.write("0.5/p", other + "0.5 1 2 3\n");
  const auto table = open_foam_table(folder.path());
  ASSERT_EQ(table.points.size(), 3U);
  EXPECT_EQ(table.points[*table.columns.back().point].place[0], 2);
  folder.write("0/p", std::string(probes) + "0.1 1 2\n");
  EXPECT_EQ(
      message_of([&] { open_foam_table(folder.path()); }),
      folder.path("0.5/p") + ": expected the probes of " + folder.path("0/p") + ", found others");
}

TEST(FoamTable, a_folder_of_several_tables_wants_a_name) {
  TemporaryFolder folder;
  fs::create_directories(folder.path("0"));
  folder.write("0/p", std::string(probes) + "0.1 1 2\n");
  folder.write("0/p_rgh", std::string(probes) + "0.1 3 4\n");
  EXPECT_EQ(open_foam_table(folder.path(), "p_rgh").columns[0].values[0], 3);
  EXPECT_EQ(message_of([&] { open_foam_table(folder.path()); }),
            folder.path() + ": expected one table, found p, p_rgh");
  EXPECT_EQ(message_of([&] { open_foam_table(folder.path(), "U"); }),
            folder.path() + ": expected a table \"U\", found p, p_rgh");
}

TEST(FoamTable, time_that_goes_back_in_a_file_begins_anew) {
  TemporaryFolder folder;
  const auto table = read_foam_table(folder.write(
      "cloud.dat", "# Time\tn\n0.1\t1\n0.2\t2\n0.3\t3\n# Time\tn\n0.2\t20\n0.3\t30\n"));
  EXPECT_EQ(table.times, (std::vector<double>{0.1, 0.2, 0.3}));
  EXPECT_EQ(table.columns[0].values, (std::vector<double>{1, 20, 30}));
  EXPECT_EQ(table.problems.size(), 1u);
}

TEST(FoamTable, a_header_alone_has_no_rows) {
  TemporaryFolder folder;
  const auto table = read_foam_table(folder.write("p", probes));
  EXPECT_TRUE(table.times.empty());
  EXPECT_TRUE(table.columns.empty());
  EXPECT_EQ(table.points.size(), 2u);
}

TEST(FoamTable, a_cut_last_row_is_left_out_and_said) {
  TemporaryFolder folder;
  const std::string two = std::string(probes) + "0.1 (1 2 3) (4 5 6)\n0.2 (1 2 3) (4 5 6)\n";
  for (const auto* cut :
       {"0.3 (1 2 3) (4 5 6)", "0.3 (1 2 3) (4 5", "0.3 (1 2 3)\n", "0.", "0.3"}) {
    const auto table = read_foam_table(folder.write("U", two + cut));
    EXPECT_EQ(table.times.size(), 2u) << cut;
    ASSERT_EQ(table.problems.size(), 1u) << cut;
    EXPECT_NE(table.problems[0].find("line 7"), std::string::npos) << table.problems[0];
  }
}

TEST(FoamTable, what_is_said_of_a_damaged_last_row_is_one_printable_line) {
  TemporaryFolder folder;
  const auto table =
      read_foam_table(folder.write("p", std::string(probes) + "0.1 1 2\n0.2 1 \x1b[31m\x01.1e4\n"));
  EXPECT_EQ(table.times.size(), 1u);
  ASSERT_EQ(table.problems.size(), 1u);
  for (const char c : table.problems[0]) EXPECT_TRUE(c >= ' ' && c <= '~') << table.problems[0];
}

TEST(FoamTable, bad_rows_get_one_line) {
  TemporaryFolder folder;
  const auto error = [&](const std::string& rows) {
    const auto path = folder.write("p", "# Time\ta\tb\n" + rows);
    const auto text = message_of([&] { read_foam_table(path); });
    return text.starts_with(path + ": ") ? text.substr(path.size() + 2) : text;
  };
  EXPECT_EQ(error("0.1 1 2\n0.2 1\n0.3 1 2\n"), "line 3: expected 3 values, found 2");
  EXPECT_EQ(error("0.1 1 2\n0.2 1 x\n0.3 1 2\n"), "line 3: expected a number for 'b', found 'x'");
  EXPECT_EQ(error("0.1 1 2\n0.2 (1 2\n0.3 1 2\n"),
            "line 3: expected ')', found the end of the line");
  EXPECT_EQ(error("0.1 1 2)\n0.2 1 2\n"), "line 2: expected a value, found ')'");
  EXPECT_EQ(error("t 1 2\n"), "line 2: expected a time, found 't'");
  EXPECT_EQ(error("0.1 ((((1)))) 2\n"), "line 2: expected at most 3 levels of '('");
  EXPECT_EQ(message_of([&] {
              read_foam_table(folder.write("q", std::string(probes) + "0.1 1 2 3\n0.2 1 2 3\n"));
            }).substr(folder.path("q").size()),
            ": expected a value for each of 2 probes, found 3");
}

TEST(FoamTable, is_told_by_content) {
  TemporaryFolder folder;
  EXPECT_TRUE(is_foam_table(folder.write("a", probes)));
  EXPECT_TRUE(is_foam_table(folder.write("b", "# Region : all\n#\n# Time  \tx\n1 2\n")));
  EXPECT_TRUE(is_foam_table(folder.write("c", gzip("# Time\tx\n1 2\n"))));
  EXPECT_FALSE(is_foam_table(folder.write("d", "# a comment\n1 2\n# Time\n")));
  EXPECT_FALSE(is_foam_table(folder.write("e", "# Time-averaged data for fix ft\n")));
  EXPECT_FALSE(is_foam_table(folder.write("f", "")));
  EXPECT_FALSE(is_foam_table(folder.write("g", "ITEM: TIMESTEP\n0\n")));
}

/// The rows of the corpus that are tables: path, rows, numbers in a row (where the note says one).
struct Expected {
  std::string path;
  std::size_t rows = 0, numbers = 0;
};
std::vector<Expected> corpus_tables() {
  std::vector<Expected> found;
  std::ifstream file(BEDSCOPE_SHARED "/corpus/expected.csv");
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    std::string path, snapshot, form, step, time, n;
    for (auto* field : {&path, &snapshot, &form, &step, &time, &n})
      std::getline(fields, *field, ',');
    if (form != "table") continue;
    Expected one{path, std::stoul(n), 0};
    const auto note = line.find("numbers per row ");
    std::size_t most = 0;
    if (note != line.npos) {
      std::istringstream numbers(line.substr(note + 16));
      char dot = 0;
      numbers >> one.numbers >> dot >> dot >> most;
      if (most != one.numbers) one.numbers = 0;  // names with digits in them were counted too
    }
    found.push_back(one);
  }
  return found;
}

TEST(FoamTable, reads_every_table_of_the_corpus) {
  const auto tables = corpus_tables();
  if (tables.empty()) GTEST_SKIP() << "no corpus here";
  std::size_t read = 0, foam = 0;
  for (const auto& expected : tables) {
    const std::string path = BEDSCOPE_SHARED "/corpus/" + expected.path;
    // Of another program: Fortran exponents; a list of pairs.
    if (path.ends_with("particle_input.dat") || path.ends_with("alpha.xy")) continue;
    SCOPED_TRACE(path);
    const auto table = read_foam_table(path);
    ++read;
    foam += is_foam_table(path);
    EXPECT_EQ(table.times.size(), expected.rows);
    for (const auto& column : table.columns)
      EXPECT_EQ(column.values.size() + column.words.size(), expected.rows);
    if (expected.numbers > 0 && expected.rows > 0) {
      EXPECT_EQ(table.columns.size() + 1, expected.numbers);  // words counted too
    }
  }
  EXPECT_GT(read, 80u);
  EXPECT_GT(foam, 60u);
}

// Written by OpenFOAM v1912; values as printed in the files.
TEST(FoamTable, of_the_made_case_has_its_values) {
  const std::string folder = BEDSCOPE_SHARED "/corpus/made/openfoam/of_ascii/postProcessing/";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not here";
  const auto p = open_foam_table(folder + "probes1", "p");
  ASSERT_EQ(p.columns.size(), 4u);
  EXPECT_EQ(p.columns[1].values.back(), 3.43873);
  EXPECT_FALSE(p.points[3].found);
  const auto u = open_foam_table(folder + "probes1", "U.air");
  EXPECT_EQ(u.find("probe 2 z")->values.front(), 1.87502);
  const auto patch = open_foam_table(folder + "patch1");
  EXPECT_EQ(patch.find("areaAverage(U.air) z")->values.front(), 1.952988);
  const auto extremes = open_foam_table(folder + "minMax1");
  EXPECT_EQ(extremes.find("field")->words.at(1), "p");
  EXPECT_EQ(extremes.find("location(max) z")->values.at(0), 0.03375);
}

TEST(FoamTable, of_a_found_case_joins_three_starts) {
  const std::string folder = BEDSCOPE_SHARED
      "/corpus/found/fluiddyn__fluidfoam/output_samples/ascii/postProcessing/probes";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not here";
  const auto p = open_foam_table(folder, "p");
  EXPECT_EQ(p.files.size(), 3u);
  EXPECT_EQ(p.times.size(), 13u);                // 92.0002 to 92.0026 every 0.0002
  EXPECT_EQ(p.columns[0].values[7], 0.0346514);  // 92.0016, of the last start
}

}  // namespace
}  // namespace bedscope::readers
