// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/tables.hpp"

#include <cmath>
#include <random>
#include <sstream>
#include <vector>

#include "readers/error.hpp"
#include "tests/analysis/example_result.hpp"

namespace bedscope::analysis {
namespace {

std::vector<std::string> lines(const std::filesystem::path& path) {
  std::istringstream text(content(path));
  std::vector<std::string> result;
  for (std::string line; std::getline(text, line);) result.push_back(line);
  return result;
}

void expect_same(double a, double b) {  // to the bit: the digits written are those that read back
  EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << a << " and " << b;
}

void expect_same(const Profile& a, const Profile& b) {
  ASSERT_EQ(a.coordinate, b.coordinate);
  const auto curve = [](const std::vector<Estimate>& c, const std::vector<Estimate>& d) {
    ASSERT_EQ(c.size(), d.size());
    for (std::size_t i = 0; i < c.size(); ++i) {
      expect_same(c[i].value, d[i].value);
      expect_same(c[i].ci95, d[i].ci95);
    }
  };
  curve(a.holdup, b.holdup);
  curve(a.velocity_z, b.velocity_z);
  curve(a.mass_flux_z, b.mass_flux_z);
}

void expect_same(const Cluster& a, const Cluster& b) {
  EXPECT_EQ(a.snapshot, b.snapshot);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.cluster, b.cluster);
  EXPECT_EQ(a.track, b.track);
  EXPECT_EQ(a.parents, b.parents);
  const auto values = [](const Cluster& c) {
    return std::vector{c.centre.x,         c.centre.z,   c.area,       c.holdup,
                       c.holdup_max,       c.velocity_x, c.velocity_z, c.track_velocity_x,
                       c.track_velocity_z, c.major,      c.minor,      c.angle};
  };
  for (std::size_t i = 0; i < values(a).size(); ++i) expect_same(values(a)[i], values(b)[i]);
}

// What a message must hold, of the error that reading this folder gives.
template <class Error>
void expect_error(const std::filesystem::path& folder, const std::string& part,
                  const std::string& label = "run") {
  try {
    read_tables(folder, label);
    ADD_FAILURE() << "no error; expected " << part;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(Tables, HeadersAreThoseOfTheContract) {
  const TestFolder folder;
  write_tables(std::vector{example_run("run")}, folder);
  const auto header = [&](const char* name) { return lines(folder / name).at(0); };
  EXPECT_EQ(header("axial_profile.csv"),
            "run,type,z [m],holdup [-],holdup_ci95 [-],velocity_z [m/s],velocity_z_ci95 [m/s],"
            "mass_flux_z [kg/m2/s],mass_flux_z_ci95 [kg/m2/s]");
  EXPECT_EQ(header("lateral_profile.csv"),
            "run,type,height [m],x [m],holdup [-],holdup_ci95 [-],velocity_z [m/s],"
            "velocity_z_ci95 [m/s],mass_flux_z [kg/m2/s],mass_flux_z_ci95 [kg/m2/s]");
  EXPECT_EQ(header("inventory.csv"),
            "run,time [s],type,particles,solids_mass [kg],holdup [-],mean_height [m]");
  EXPECT_EQ(header("clusters.csv"),
            "run,time [s],cluster,track,x [m],z [m],area [m2],holdup [-],holdup_max [-],"
            "velocity_x [m/s],velocity_z [m/s],track_velocity_x [m/s],track_velocity_z [m/s],"
            "major [m],minor [m],angle [rad],parents");
  EXPECT_EQ(header("cluster_occurrence.csv"), "run,time [s],clusters,area_fraction [-]");
  EXPECT_EQ(header("temperature.csv"), "run,time [s],type,mean [K],std [K],min [K],max [K]");
  EXPECT_EQ(header("temperature_pdf.csv"), "run,type,bin_centre [-],probability_density [-]");
}

TEST(Tables, RowsHoldTheNumbersAsShortAsTheyGo) {
  const TestFolder folder;
  write_tables(std::vector{example_run("K = 1")}, folder);
  EXPECT_EQ(lines(folder / "axial_profile.csv").size(), 1 + 2 * 4);
  EXPECT_EQ(lines(folder / "lateral_profile.csv").size(), 1 + 2 * 2 * 3);
  EXPECT_EQ(lines(folder / "inventory.csv").at(2), "K = 1,0.1,all,50001,0.31,0.0031,0.56");
  EXPECT_EQ(
      lines(folder / "clusters.csv").at(1),
      "K = 1,0.1,1,1,0.03,0.3333333333333333,6.1e-05,0.25,0.41,-0,1.5,nan,nan,0.02,0.01,-0.5,");
  EXPECT_TRUE(lines(folder / "clusters.csv").at(3).ends_with(",1;2"));
  EXPECT_EQ(lines(folder / "cluster_occurrence.csv").at(2), "K = 1,0.1,2,0.02");
  EXPECT_EQ(lines(folder / "temperature_pdf.csv").at(2), "K = 1,all,0.375,0.5");
}

TEST(Tables, ComeBackAsTheyWere) {
  const TestFolder folder;
  const RunResult run = example_run("K = 1, \"new\"\nsecond line");
  write_tables(std::vector{example_run("other"), run}, folder);
  const RunResult back = read_tables(folder, run.label);

  EXPECT_EQ(back.label, run.label);
  EXPECT_EQ(back.types, run.types);
  EXPECT_EQ(back.heights, run.heights);
  ASSERT_EQ(back.species.size(), run.species.size());
  for (std::size_t s = 0; s < run.species.size(); ++s) {
    EXPECT_EQ(back.species[s].type, run.species[s].type);
    expect_same(back.species[s].axial, run.species[s].axial);
    ASSERT_EQ(back.species[s].lateral.size(), 2u);
    expect_same(back.species[s].lateral[0], run.species[s].lateral[0]);
    expect_same(back.species[s].lateral[1], run.species[s].lateral[1]);
    EXPECT_EQ(back.species[s].temperature_pdf, run.species[s].temperature_pdf);
  }
  EXPECT_EQ(back.grid.cells, run.grid.cells);
  for (const Axis axis : {lateral, up}) {  // (max - min) of coordinates rounds in the last digits
    EXPECT_NEAR(back.grid.min[axis], run.grid.min[axis], 1e-15);
    EXPECT_NEAR(back.grid.max[axis], run.grid.max[axis], 1e-15);
  }
  ASSERT_EQ(back.inventory.size(), run.inventory.size());
  for (std::size_t i = 0; i < run.inventory.size(); ++i) {
    EXPECT_EQ(back.inventory[i].time, run.inventory[i].time);
    EXPECT_EQ(back.inventory[i].type, run.inventory[i].type);
    EXPECT_EQ(back.inventory[i].particles, run.inventory[i].particles);
    EXPECT_EQ(back.inventory[i].solids_mass, run.inventory[i].solids_mass);
    EXPECT_EQ(back.inventory[i].holdup, run.inventory[i].holdup);
    EXPECT_EQ(back.inventory[i].mean_height, run.inventory[i].mean_height);
    EXPECT_EQ(back.temperature[i].mean, run.temperature[i].mean);
    EXPECT_EQ(back.temperature[i].std, run.temperature[i].std);
    EXPECT_EQ(back.temperature[i].min, run.temperature[i].min);
    EXPECT_EQ(back.temperature[i].max, run.temperature[i].max);
  }
  ASSERT_EQ(back.occurrence.size(), run.occurrence.size());
  for (std::size_t i = 0; i < run.occurrence.size(); ++i) {
    EXPECT_EQ(back.occurrence[i].time, run.occurrence[i].time);
    EXPECT_EQ(back.occurrence[i].clusters, run.occurrence[i].clusters);
    EXPECT_EQ(back.occurrence[i].area_fraction, run.occurrence[i].area_fraction);
  }
  ASSERT_EQ(back.clusters.size(), run.clusters.size());
  for (std::size_t i = 0; i < run.clusters.size(); ++i)
    expect_same(back.clusters[i], run.clusters[i]);
  EXPECT_TRUE(back.time_known && back.density_known);
  EXPECT_EQ(back.problems, std::vector<std::string>());
  EXPECT_TRUE(std::isnan(back.mean_holdup.value)) << "the tables do not tell the window";

  write_tables(std::vector{back}, folder / "again");  // and the same text, of this run alone
  write_tables(std::vector{run}, folder / "once");
  for (const char* name :
       {"axial_profile.csv", "lateral_profile.csv", "inventory.csv", "clusters.csv",
        "cluster_occurrence.csv", "temperature.csv", "temperature_pdf.csv"})
    EXPECT_EQ(content(folder / "again" / name), content(folder / "once" / name));
}

TEST(Tables, WithoutRowsHaveTheirHeaderAndTemperatureIsLeftOut) {
  const TestFolder folder;
  write_tables(std::vector{example_run("earlier")}, folder);
  RunResult run;
  run.label = "empty";
  write_tables(std::vector{run}, folder);
  for (const char* name : {"axial_profile.csv", "lateral_profile.csv", "inventory.csv",
                           "clusters.csv", "cluster_occurrence.csv"})
    EXPECT_EQ(lines(folder / name).size(), 1u) << name;
  EXPECT_FALSE(exists(folder / "temperature.csv")) << "of the earlier analysis";
  EXPECT_FALSE(exists(folder / "temperature_pdf.csv"));
}

TEST(Tables, SayNanWhereTimeOrDensityIsUnknown) {
  const TestFolder folder;
  RunResult run = example_run("steps");
  run.time_known = run.density_known = false;
  write_tables(std::vector{run}, folder);
  EXPECT_EQ(lines(folder / "inventory.csv").at(1), "steps,nan,all,50000,nan,0.0031,0.56");
  EXPECT_EQ(lines(folder / "cluster_occurrence.csv").at(2), "steps,nan,2,0.02");
  EXPECT_TRUE(lines(folder / "clusters.csv").at(1).starts_with("steps,nan,1,1,"));
  EXPECT_TRUE(lines(folder / "temperature.csv").at(1).starts_with("steps,nan,all,"));
  const RunResult back = read_tables(folder, "steps");
  EXPECT_FALSE(back.time_known);
  std::vector<std::size_t> snapshots;  // told apart by the cluster's number starting again
  for (const Cluster& c : back.clusters) snapshots.push_back(c.snapshot);
  EXPECT_EQ(snapshots, (std::vector<std::size_t>{0, 0, 1, 2}));
}

TEST(Tables, ANanIsWrittenWithoutItsSign) {
  const TestFolder folder;
  RunResult run;
  run.occurrence = {{0, 0, -undefined}};
  write_tables(std::vector{run}, folder);
  EXPECT_EQ(lines(folder / "cluster_occurrence.csv").at(1), ",0,0,nan");
}

TEST(Tables, AFullDiskIsAnErrorAndLeavesNothing) {
  const TestFolder folder;
  put(folder / "file", "");
  EXPECT_THROW(write_tables(std::vector{example_run("run")}, folder / "file" / "tables"),
               FileError);
  const auto disk = folder / "disk";  // every write to it fails, as on a full one
  std::filesystem::create_directory(disk);
  std::filesystem::create_symlink("/dev/full", disk / "axial_profile.csv.part");
  try {
    write_tables(std::vector{example_run("run")}, disk);
    ADD_FAILURE() << "written to a full disk";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("axial_profile.csv: No space left on device"),
              std::string::npos)
        << error.what();
  }
  EXPECT_TRUE(std::filesystem::is_empty(disk));
}

TEST(ReadTables, TakeColumnsInAnyOrderOfAnotherProgram) {
  const TestFolder folder;
  std::filesystem::create_directory(folder / "tables");
  put(folder / "tables" / "axial_profile.csv",
      "\xEF\xBB\xBFholdup [-], note ,z [m]\r\n"
      "0.2,\"a \"\"b\"\", c\",0.3\r\n"
      "\r\n"
      " +0.1 ,,0.1\r\n"
      ",x,0.2");
  const RunResult run = read_tables(folder, "experiment");
  EXPECT_EQ(run.label, "experiment");
  EXPECT_EQ(run.types, std::vector<std::string>{"all"});
  const Profile& axial = run.species.at(0).axial;
  EXPECT_EQ(axial.coordinate, (std::vector{0.1, 0.2, 0.3})) << "sorted";
  EXPECT_EQ(axial.holdup[0].value, 0.1);
  EXPECT_TRUE(std::isnan(axial.holdup[1].value)) << "an empty field";
  EXPECT_EQ(axial.holdup[2].value, 0.2);
  EXPECT_TRUE(std::isnan(axial.holdup[0].ci95) && std::isnan(axial.velocity_z[0].value));
  EXPECT_EQ(run.grid.cells[up], 3);
  EXPECT_NEAR(run.grid.min[up], 0.05, 1e-15);  // of 0.1 - (0.2 - 0.1) / 2, rounded
  EXPECT_FALSE(run.density_known);
}

TEST(ReadTables, TakeSeriesOfAnyNameAndWriteThemAgain) {
  const TestFolder folder;
  put(folder / "series.csv",
      "run,series,unit,time [s],value\na,drag,N,0,1\na,leak,-,0.5,nan\na,drag,N,1,2\n");
  auto run = read_tables(folder, "a");
  choose_window(run, std::array{0.5, 2.0});
  EXPECT_EQ(run.window.snapshots, 1u);
  write_tables(std::vector{run}, folder);
  const auto again = read_tables(folder, "a");
  ASSERT_EQ(again.series.size(), 2u);
  EXPECT_EQ(again.series[0].name, "drag");
  EXPECT_EQ(again.series[0].unit, "N");
  EXPECT_EQ(again.series[0].times, (std::vector{0.0, 1.0}));
  EXPECT_EQ(again.series[0].values, (std::vector{1.0, 2.0}));
  EXPECT_TRUE(std::isnan(again.series[1].values.at(0)));
  write_tables(std::vector{example_run("run")}, folder);
  EXPECT_FALSE(std::filesystem::exists(folder / "series.csv"));

  const TestFolder bad;
  put(bad / "series.csv", "run,series,unit,time [s],value\na,drag,N,1,1\na,drag,N,1,2\n");
  expect_error<FormatError>(bad, "series.csv: line 3: expected a time after 1 s, found 1 s");
  put(bad / "series.csv", "run,series,unit,time [s],value\na,drag,N,1,1\na,drag,kg,2,2\n");
  expect_error<FormatError>(bad, "line 3: expected the unit N of its first row, found kg");
}

TEST(ReadTables, TakeTheOnlyRunWhateverItsName) {
  const TestFolder folder;
  put(folder / "cluster_occurrence.csv", "run,time [s],clusters\nold name,1,3\n");
  EXPECT_EQ(read_tables(folder, "new name").occurrence.at(0).clusters, 3);
  put(folder / "inventory.csv", "run,time [s],particles\nanother,1,3\n");
  expect_error<InputError>(folder, "expected a run 'new name' in the tables, found 'another', 'old",
                           "new name");
  EXPECT_EQ(read_tables(folder, "another").inventory.size(), 1u);
  EXPECT_EQ(read_tables(folder, "another").occurrence.size(), 0u);
}

TEST(ReadTables, SayWhatIsWrongAndWhere) {
  const TestFolder folder;
  expect_error<InputError>(folder, "expected tables such as axial_profile.csv, found none");
  const auto expect = [&](const char* name, std::string_view text, const std::string& part) {
    put(folder / name, text);
    expect_error<FormatError>(folder, std::string(name) + ": " + part);
    std::filesystem::remove(folder / name);
  };
  expect("axial_profile.csv", "z [mm],holdup [-]\n1,2\n",
         "line 1: expected a column 'z [m]', found 'z [mm],holdup [-]'");
  expect("axial_profile.csv", "z [m],holdup [%]\n1,2\n",
         "line 1: expected a column 'holdup [-]', found holdup [%]");
  expect("pressure_drop.csv", "time [s],pressure_drop\n1,2\n",
         "line 1: expected a column 'pressure_drop [Pa]', found pressure_drop");
  expect("axial_profile.csv", "z [m],holdup [-],holdup_ci95 [-]\n1,2,-0.1\n",
         "line 2: expected a half-width of at least 0 for 'holdup_ci95 [-]', or nan, found -0.1");
  expect("axial_profile.csv", "z [m],holdup [-],holdup_ci95 [-]\n1,2,inf\n",
         "line 2: expected a number for 'holdup_ci95 [-]', found 'inf'");
  expect("axial_profile.csv", "", "line 1: expected a line of column names, found none");
  expect("axial_profile.csv", "note,z [m],holdup [-]\n\"two\nlines\",1,2\nx,2,0.1m\n",
         "line 4: expected a number for 'holdup [-]', found '0.1m'");
  expect("axial_profile.csv", "z [m],holdup [-]\n1\n", "line 2: expected 2 fields, found 1");
  expect("axial_profile.csv", "z [m],holdup [-]\n1,2,3\n", "line 2: expected 2 fields, found 3");
  expect("axial_profile.csv", "z [m]\nnan\n", "line 2: expected a finite coordinate, found nan");
  expect("axial_profile.csv", "z [m]\n1\n2\n1\n", "line 4: expected one row for each place");
  expect("axial_profile.csv", "z [m]\n\"1\n", "line 2: expected a closing quote");
  expect("axial_profile.csv", "z [m]\n\"1\"2\n", "line 2: expected a comma or the line's end");
  expect("inventory.csv", "time [s],particles\n1,2.5\n",
         "line 2: expected a whole number for 'particles', found '2.5'");
  expect("inventory.csv", "time [s],particles\n1,-2\n", "line 2: expected a whole number");
  expect("clusters.csv", "time [s],x [m],z [m],cluster\n1,2,3,5000000000\n",
         "line 2: expected a smaller number, found 5000000000");
  expect("clusters.csv", "time [s],x [m],z [m],parents\n1,2,3,4;x\n",
         "line 2: expected track numbers joined by ';' for 'parents', found '4;x'");
  expect("temperature_pdf.csv", "bin_centre [-],probability_density [-]\n0.25,1\n0.5,1\n",
         "line 3: expected 0.75, the centre of one of 2 equal bins from 0 to 1, found 0.5");
  put(folder / "cluster_occurrence.csv", "time [s],clusters\n1,1\n");
  expect("clusters.csv", "time [s],x [m],z [m]\n1,0,0\n2,0,0\n",
         "line 3: expected a time of cluster_occurrence.csv, found 2 s");
}

TEST(ReadTables, SayWhereTheGridIsNotThatOfTheProfiles) {
  const TestFolder folder;
  put(folder / "axial_profile.csv", "z [m]\n0.1\n0.2\n0.4\n");
  EXPECT_EQ(read_tables(folder, "").problems.size(), 1u);
  put(folder / "axial_profile.csv", "z [m]\n0.1\n0.2\n0.3\n");
  EXPECT_EQ(read_tables(folder, "").problems.size(), 0u);
}

TEST(ReadTables, SurviveAnyBytes) {
  const TestFolder folder;
  write_tables(std::vector{example_run("a"), example_run("b, \"c\"")}, folder);
  std::mt19937 random(7);
  int read = 0;
  for (const char* name : {"axial_profile.csv", "lateral_profile.csv", "inventory.csv",
                           "clusters.csv", "cluster_occurrence.csv", "temperature_pdf.csv"}) {
    const std::string whole = content(folder / name);
    const std::string_view bytes("\0\n\r\",;x-9e\xff [", 13);
    for (int trial = 0; trial < 150; ++trial) {
      std::string text = whole;
      for (unsigned change = random() % 4; change < 4; ++change)
        text[random() % text.size()] = bytes[random() % bytes.size()];
      if (trial % 3 == 0) text.resize(random() % text.size());
      put(folder / name, text);
      try {
        read_tables(folder, "a");
        ++read;
      } catch (const Error&) {
      }
    }
    put(folder / name, whole);
  }
  EXPECT_GT(read, 0) << "no change was harmless: the rest of the file is not looked at";
  EXPECT_LT(read, 900) << "no change was found";
}

}  // namespace
}  // namespace bedscope::analysis
