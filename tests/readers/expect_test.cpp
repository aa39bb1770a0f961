// SPDX-License-Identifier: BSD-3-Clause
// The whole corpus of the developers, where it is at hand: counts, steps and ranges of every good
// file against tables made by other readers (python, VTK), and the verdict on every bad one.
#include <sys/stat.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "readers/columns.hpp"
#include "readers/series.hpp"
#include "readers/survey.hpp"
#include "tests/readers/test_files.hpp"

namespace bedscope::readers {
namespace {

const fs::path shared = BEDSCOPE_SHARED;
const fs::path corpus = shared / "corpus";

/// One row of a CSV file: title to value.
using Row = std::map<std::string, std::string>;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      cells.back() += line[++i];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == ',' && !quoted)
      cells.emplace_back();
    else if (line[i] != '\r')
      cells.back() += line[i];
  }
  return cells;
}

std::vector<Row> rows_of(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const auto titles = cells_of(line);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    const auto cells = cells_of(line);
    EXPECT_EQ(cells.size(), titles.size()) << line;
    Row row;
    for (std::size_t k = 0; k < std::min(cells.size(), titles.size()); ++k)
      row[titles[k]] = cells[k];
    rows.push_back(std::move(row));
  }
  return rows;
}

bool is_form(const Row& row, std::initializer_list<const char*> forms) {
  return std::find(forms.begin(), forms.end(), row.at("form")) != forms.end();
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != text.npos;
}

/// Is the file one of particles, to judge from what VTK and python saw in it?
bool is_particles(const Row& row) {
  const auto& path = row.at("path");
  if (contains(row.at("note"), "entries, not particles")) return false;
  if (row.at("form").starts_with("dump") || row.at("form") == "liggghts-bin") return true;
  if (path.ends_with("ug_polyvertex.vtu")) return true;  // one cell for all points
  const bool points_only = row.at("n_cells") == "0" && !contains(row.at("form"), "vtk-vtk");
  return (row.at("n") == row.at("n_cells") || points_only) && !contains(path, "/euler_");
}

/// Forms whose files hold particles by themselves or name the files that do.
bool is_ours(const Row& row) {
  return is_form(row, {"dump-text", "dump-text-gz", "liggghts-bin", "vtk-vtk", "vtk-vtk-gz",
                       "vtk-vtp", "vtk-vtu", "vtk-pvtp", "vtk-pvtu"}) ||
         (row.at("form") == "vtk-vtm" && is_particles(row));
}

/// Of a .vtm the table numbers the blocks; to us it is one snapshot.
std::size_t snapshot_of(const Row& row) {
  return row.at("path").ends_with(".vtm") ? 0 : std::stoul(row.at("snapshot"));
}

/// Names for files that store none: those of the other readers of the corpus, col1 col2 ...; or
/// what the dump commands of the corpus say, without a radius, as in the table.
SeriesOptions names_for(const Row& row, bool positions) {
  SeriesOptions options;
  std::size_t count = 0;
  if (row.at("form") == "liggghts-bin")
    count = Series::open((corpus / row.at("path")).string()).columns().size();
  else if (row.at("arrays").starts_with("col1 "))
    count = cells_of(std::regex_replace(row.at("arrays"), std::regex(" "), ",")).size();
  for (std::size_t k = 1; k <= count; ++k) options.columns.push_back(fmt::format("col{}", k));
  if (positions && count >= 6)
    for (std::size_t axis = 0; axis < 3; ++axis)
      options.columns[2 + axis] = std::string(1, "xyz"[axis]);
  return options;
}

/// Rows under a bare "ITEM: ATOMS", as LAMMPS wrote them before 2010; one of those files is cut.
bool is_unnamed(const Row& row) {
  return row.at("arrays").starts_with("col1 ") || row.at("n").starts_with("TRUNCATED");
}

void expect_number(const std::string& expected, double value, const char* what) {
  if (expected.empty()) return;
  const double number = std::stod(expected);
  if (std::isnan(number) && std::isnan(value)) return;
  // The table prints all digits; the rest is the rounding of its own arithmetic.
  EXPECT_NEAR(value, number, 1e-12 * std::abs(number)) << what;
}

struct Range {
  double min = std::numeric_limits<double>::infinity(), max = -min, sum = 0;
};

Range range_of(const std::vector<double>& values) {
  Range range;
  for (const double value : values) {
    range.min = std::min(range.min, value);
    range.max = std::max(range.max, value);
    range.sum += value;
  }
  return range;
}

void expect_row(const Row& row, const Series& series) {
  const auto i = snapshot_of(row);
  ASSERT_LT(i, series.size());
  Snapshot snapshot;
  Scratch scratch;
  series.read(i, {{"x"}, {"y"}, {"z"}, {"radius", false}}, snapshot, scratch);
  EXPECT_EQ(std::to_string(snapshot.particles), row.at("n"));
  if (const auto& step = row.at("step"); !step.empty() && !contains(step, "file name")) {
    EXPECT_EQ(snapshot.step, std::stoll(step));
  }
  expect_number(row.at("time"), snapshot.time, "time");
  if (snapshot.particles == 0) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto range = range_of(snapshot.columns[axis]);
    const std::string name(1, "xyz"[axis]);
    expect_number(row.at(name + "min"), range.min, "position");
    expect_number(row.at(name + "max"), range.max, "position");
  }
  EXPECT_EQ(row.at("radius_array").empty(), snapshot.columns[3].empty());
  if (snapshot.columns[3].empty()) return;
  const auto radius = range_of(snapshot.columns[3]);
  const double factor = row.at("radius_array") == "diameter" ? .5 : 1;  // "d/2" is halved there
  expect_number(row.at("radius_min"), radius.min / factor, "radius");
  expect_number(row.at("radius_max"), radius.max / factor, "radius");
}

TEST(Corpus, CountsStepsAndRangesAreThoseOfTheTable) {
  if (!fs::exists(corpus)) GTEST_SKIP() << "no corpus";
  std::size_t snapshots = 0, companions = 0, unnamed = 0;
  std::string opened;
  Series series;
  for (const auto& row : rows_of(corpus / "expected.csv")) {
    if (!is_ours(row)) continue;
    const auto path = (corpus / row.at("path")).string();
    SCOPED_TRACE(path + " " + row.at("snapshot"));
    if (!is_particles(row)) {
      const auto error = error_of([&] { Series::open(path); });
      EXPECT_NE(error, "");
      ++companions;
      continue;
    }
    if (is_unnamed(row)) {
      const bool text = row.at("form") == "dump-text";
      EXPECT_EQ(contains(error_of([&] { Series::open(path); }),
                         "line 9: \"ITEM: ATOMS\" without column names"),
                text);
      ++unnamed;
      if (text) continue;  // of one kind each, without positions in the table
    }
    if (opened != path) {
      ASSERT_EQ(error_of([&] { series = Series::open(path, names_for(row, true)); }), "");
      opened = path;
    }
    if (row.at("snapshot") == "ALL") {
      std::int64_t sum = 0;
      for (std::size_t i = 0; i < series.size(); ++i) sum += series.particles(i);
      EXPECT_EQ(fmt::format("sum {}", sum), row.at("n"));
      EXPECT_TRUE(row.at("note").starts_with(fmt::format("{} snapshots", series.size())));
      continue;
    }
    ASSERT_NO_FATAL_FAILURE(expect_row(row, series));
    ++snapshots;
  }
  std::printf("%zu snapshots, %zu companions, %zu of unnamed columns\n", snapshots, companions,
              unnamed);
  EXPECT_GT(snapshots, 100U);
  EXPECT_GT(companions, 50U);
}

TEST(Corpus, MinimumMaximumAndSumOfEveryColumnAreThoseOfTheTable) {
  if (!fs::exists(corpus)) GTEST_SKIP() << "no corpus";
  std::map<std::string, SeriesOptions> files;  // those of our forms that hold particles
  const auto key = [](const Row& row) {
    return row.at("path") + (row.at("path").ends_with(".vtm") ? row.at("snapshot") : "");
  };
  for (const auto& row : rows_of(corpus / "expected.csv"))
    if (is_ours(row) && is_particles(row) && row.at("snapshot") != "ALL")
      files.try_emplace(key(row), names_for(row, false));
  std::size_t columns = 0;
  std::string opened;
  Series series;
  Snapshot snapshot;
  Scratch scratch;
  for (const auto& row : rows_of(corpus / "expected_arrays.csv")) {
    const auto file = files.find(key(row));
    if (file == files.end() || row.at("ntuples") == "0") continue;
    if (row.at("where") == "cell" || row.at("where") == "field") continue;
    const auto path = (corpus / row.at("path")).string();
    SCOPED_TRACE(path + " " + row.at("snapshot") + " " + row.at("array"));
    if (opened != path) {
      ASSERT_EQ(error_of([&] { series = Series::open(path, file->second); }), "");
      opened = path;
    }
    const auto component = static_cast<std::size_t>(std::stoul(row.at("component")));
    const auto name = component_names(row.at("array"), std::stoi(row.at("ncomp"))).at(component);
    if (name == "x" || name == "y" || name == "z") continue;  // in the other table
    if (name.ends_with("#2")) continue;                       // the second of `type type`
    series.read(snapshot_of(row), request_of({name}), snapshot, scratch);
    const auto range = range_of(snapshot.columns[0]);
    ASSERT_EQ(std::to_string(snapshot.particles), row.at("ntuples"));
    expect_number(row.at("min"), range.min, "minimum");
    expect_number(row.at("max"), range.max, "maximum");
    // Sums of signed values lose digits by cancellation: against the largest term, not the sum.
    const double largest = std::max(std::abs(range.min), std::abs(range.max));
    EXPECT_NEAR(range.sum, std::stod(row.at("sum")),
                1e-13 * largest * static_cast<double>(snapshot.particles));
    ++columns;
  }
  std::printf("%zu columns\n", columns);
  EXPECT_GT(columns, 800U);
}

// --- bad input

/// Whose rows of EXPECT.csv hold now. To extend: a beginning of the column `input`.
constexpr std::array served{"dump/", "bin/", "vtk/", "xml/", "of/", "series", "../corpus/found/"};

bool begins_with_one_of(const std::string& text, const auto& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](const char* b) { return text.starts_with(b); });
}

struct Outcome {
  int exit_code = -1;
  std::string out, error;
};

/// `bedscope info --json` as a user runs it.
Outcome info(const std::string& path) {
  const TemporaryFolder folder;
  const auto command = fmt::format("'{}' info --json '{}' > '{}' 2> '{}'", BEDSCOPE_PROGRAM, path,
                                   folder.path("out"), folder.path("error"));
  Outcome outcome;
  const int status = std::system(command.c_str());
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.out = bytes_of(folder.path("out"));
  outcome.error = bytes_of(folder.path("error"));
  return outcome;
}

/// The places and numbers of the wanted text: "line 16", "offset 402", "array radius", "id 282".
std::vector<std::string> essentials(const std::string& must) {
  static const std::regex place(
      "(line|offset|array|id|step|snapshot|point|column|cell|compressor|piece|face|parcel|record|"
      "block) "
      "([0-9]+|\"[^\" ]+\"|radius|id|vtkFooCompressor)\\b"
      "|[0-9]+ declared, [0-9]+ present|[0-9]+ values expected|[0-9]+ tuples, [0-9]+ points|is not "
      "a number");
  std::vector<std::string> found;
  for (std::sregex_iterator at(must.begin(), must.end(), place), end; at != end; ++at) {
    const auto text = at->str();
    const bool good = text.starts_with("snapshot") && must.find(text + ":") == must.npos;
    if (!good) found.push_back(text);  // "snapshot 9500 good" is no complaint
  }
  return found;
}

TEST(BadInput, EveryRowOfTheTableGetsItsVerdictAndItsPlace) {
  const auto bad = shared / "bad";
  if (!fs::exists(bad)) GTEST_SKIP() << "no corpus";
  std::size_t judged = 0, places = 0;
  for (const auto& row : rows_of(bad / "EXPECT.csv")) {
    const auto name = row.at("input").substr(0, row.at("input").find(' '));
    if (!begins_with_one_of(name, served)) continue;
    const auto path = bad / name;
    const bool pattern = contains(name, "*");
    if (!pattern && !fs::exists(path)) continue;  // an empty folder is lost on the way
    SCOPED_TRACE(name + ": " + row.at("must"));
    const auto outcome = info(path.string());
    ++judged;
    std::string told = outcome.error;
    if (row.at("verdict") == "ERROR") {
      EXPECT_EQ(outcome.exit_code, 2) << told;
      EXPECT_EQ(outcome.out, "");
      EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
      EXPECT_TRUE(contains(told, path.string())) << told;
    } else {
      ASSERT_EQ(outcome.exit_code, 0) << told;
      const auto json = nlohmann::json::parse(outcome.out);
      EXPECT_EQ(json.at("problems").empty(), row.at("verdict") == "OK") << json.at("problems");
      told = json.at("problems").dump();
      std::smatch count;
      static const std::regex particles("^([0-9]+) particles"),
          snapshots("^([0-9]+) snapshots of ([0-9]+)");
      if (std::regex_search(row.at("must"), count, particles)) {
        EXPECT_EQ(json.at("particles").at("max"), std::stoi(count[1]));
      } else if (std::regex_search(row.at("must"), count, snapshots)) {
        EXPECT_EQ(json.at("snapshots"), std::stoi(count[1]));
        EXPECT_EQ(json.at("particles").at("min"), std::stoi(count[2]));
      }
      if (row.at("verdict") == "OK") continue;
    }
    for (const auto& place : essentials(row.at("must"))) {
      EXPECT_TRUE(contains(told, place)) << place << " is not in: " << told;
      ++places;
    }
  }
  std::printf("%zu inputs, %zu places\n", judged, places);
  EXPECT_GE(judged, 110U);
  EXPECT_GE(places, 80U);
}

TEST(BadInput, ThingsThatAreNoFilesAreErrorsAtOnce) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo(folder.path("fifo").c_str(), 0600), 0);
  fs::create_symlink("loop_b", folder.path("loop_a"));
  fs::create_symlink("loop_a", folder.path("loop_b"));
  fs::create_symlink("/dev/zero", folder.path("zero"));
  fs::create_symlink("nowhere", folder.path("dangling"));
  fs::create_directory(folder.path("empty"));
  for (const auto& [name, reason] : {std::pair{"fifo", "not a regular file"},
                                     {"loop_a", "too many levels of symbolic links"},
                                     {"zero", "not a regular file"},
                                     {"dangling", "no such file"},
                                     {"missing", "no such file"},
                                     {"empty", "no files in this folder"},
                                     {"*", ""}}) {
    const auto outcome = info(folder.path(name));
    EXPECT_EQ(outcome.exit_code, 2) << name;
    EXPECT_TRUE(contains(outcome.error, reason)) << outcome.error;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
  }
}

TEST(BadInput, OfAPartialFileTheCompleteSnapshotsAreGiven) {
  const auto bad = shared / "bad" / "dump";
  if (!fs::exists(bad)) GTEST_SKIP() << "no corpus";
  const auto counts = [&](const char* name) {
    const auto series = Series::open((bad / name).string());
    EXPECT_TRUE(series.cut());
    std::map<std::int64_t, std::int64_t> found;
    for (std::size_t i = 0; i < series.size(); ++i)
      found[series.step(i)] = series.located(i).particles;
    EXPECT_EQ(survey(series, true).snapshots_read, series.size());
    return found;
  };
  using Counts = std::map<std::int64_t, std::int64_t>;
  EXPECT_EQ(counts("last_snapshot_partial.liggghts"), (Counts{{9500, 380}, {10000, 374}}));
  EXPECT_EQ(counts("last_snapshot_header_only.liggghts"), (Counts{{9500, 380}}));
  EXPECT_EQ(counts("nul_tail.liggghts"), (Counts{{9500, 20}}));
}

}  // namespace
}  // namespace bedscope::readers
