// SPDX-License-Identifier: BSD-3-Clause
// The gas in tables, results.h5 and summary.json.
#include "analysis/gas_tables.hpp"

#include <hdf5.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

#include "analysis/results_file.hpp"
#include "analysis/summary.hpp"
#include "analysis/tables.hpp"
#include "readers/error.hpp"
#include "tests/analysis/example_result.hpp"

namespace bedscope::analysis {
namespace {

GasProfile example_gas_profile(const Grid& grid, Axis axis) {
  GasProfile profile;
  for (int i = 0; i < grid.cells[axis]; ++i) {
    profile.coordinate.push_back(grid.centre(axis, i));
    profile.voidage.push_back({0.9 + 0.01 * i, 0.001});
    profile.velocity_z.push_back({5.5 + i, 0.1});
    profile.temperature.push_back({});
    profile.pressure.push_back({101325. - i, 2});
    profile.slip_z.push_back({5. + i, 0.3});
  }
  return profile;
}

RunResult run_with_gas() {
  auto run = example_run("K = 1");
  auto& gas = run.gas;
  gas.present = gas.has_velocity = gas.has_pressure = true;
  gas.times = 3;
  gas.from = 0.1;
  gas.to = 0.3;
  gas.axial = example_gas_profile(run.grid, up);
  for (std::size_t h = 0; h < run.heights.size(); ++h)
    gas.lateral.push_back(example_gas_profile(run.grid, lateral));
  gas.fields.voidage.resize(run.grid.size());
  std::iota(gas.fields.voidage.begin(), gas.fields.voidage.end(), 0.25);
  gas.fields.velocity_x = gas.fields.velocity_z = gas.fields.pressure = gas.fields.voidage;
  gas.checks = {{1, 0.1, 2e-5, 4e-5, 0.01, 0.02, 0.5, 0.03, 12, 0.05}};
  gas.pressure = {{0.1, 640, 469}, {0.2, 650, undefined}};
  gas.voidage_ratio = {0.5, 0.01};
  gas.pressure_drop = {645, 5};
  gas.bed_weight_by_area = 469;
  return run;
}

std::vector<std::string> lines(const std::filesystem::path& path) {
  std::vector<std::string> found;
  std::istringstream text(content(path));
  for (std::string line; std::getline(text, line);) {
    if (line.ends_with('\r')) line.pop_back();
    found.push_back(line);
  }
  return found;
}

constexpr std::string_view quantities =
    "voidage [-],velocity_z [m/s],temperature [K],pressure [Pa],slip_z [m/s],voidage_ci95 [-],"
    "velocity_z_ci95 [m/s],temperature_ci95 [K],pressure_ci95 [Pa],slip_z_ci95 [m/s]";

TEST(GasTables, HaveTheColumnsOfTheContract) {
  const TestFolder folder;
  write_tables(std::vector{run_with_gas(), example_run("no gas")}, folder);
  const auto axial = lines(folder / "gas_axial.csv");
  ASSERT_EQ(axial.size(), 1 + 4u);
  EXPECT_EQ(axial[0], "run,z [m]," + std::string(quantities));
  EXPECT_EQ(axial[2].substr(0, 6), "K = 1,");
  EXPECT_TRUE(axial[1].ends_with(",0.9,5.5,nan,101325,5,0.001,0.1,nan,2,0.3")) << axial[1];
  const auto across = lines(folder / "gas_lateral.csv");
  ASSERT_EQ(across.size(), 1 + 2 * 3u);
  EXPECT_EQ(across[0], "run,height [m],x [m]," + std::string(quantities));
  EXPECT_EQ(across[4].substr(0, 11), "K = 1,0.45,");
  EXPECT_EQ(lines(folder / "voidage_check.csv").at(1),
            "K = 1,0.1,2e-05,4e-05,0.5,0.01,0.02,0.5,12");
  EXPECT_EQ(lines(folder / "pressure_drop.csv"),
            (std::vector<std::string>{"run,time [s],pressure_drop [Pa],bed_weight_over_area [Pa]",
                                      "K = 1,0.1,640,469", "K = 1,0.2,650,nan"}));
}

TEST(GasTables, AreRemovedWhereNoRunHasGas) {
  const TestFolder folder;
  write_tables(std::vector{run_with_gas()}, folder);
  write_tables(std::vector{example_run("no gas")}, folder);
  for (const char* name :
       {"gas_axial.csv", "gas_lateral.csv", "voidage_check.csv", "pressure_drop.csv"})
    EXPECT_FALSE(std::filesystem::exists(folder / name)) << name;
}

TEST(GasTables, ReadBackAsTheyWere) {
  const TestFolder folder;
  const auto written = run_with_gas();
  write_tables(std::vector{written}, folder);
  const auto run = read_tables(folder, "K = 1");
  EXPECT_EQ(run.species.front().axial.coordinate.size(), 4u);
  EXPECT_TRUE(run.gas.present && run.gas.has_velocity && run.gas.has_pressure);
  EXPECT_FALSE(run.gas.has_temperature);
  const auto same = [](const GasProfile& a, const GasProfile& b) {
    ASSERT_EQ(a.coordinate, b.coordinate);
    for (std::size_t i = 0; i < a.coordinate.size(); ++i) {
      EXPECT_EQ(a.voidage[i].value, b.voidage[i].value);
      EXPECT_EQ(a.velocity_z[i].ci95, b.velocity_z[i].ci95);
      EXPECT_TRUE(std::isnan(a.temperature[i].value));
      EXPECT_EQ(a.pressure[i].value, b.pressure[i].value);
      EXPECT_EQ(a.slip_z[i].ci95, b.slip_z[i].ci95);
    }
  };
  same(run.gas.axial, written.gas.axial);
  ASSERT_EQ(run.gas.lateral.size(), written.gas.lateral.size());
  for (std::size_t h = 0; h < run.gas.lateral.size(); ++h)
    same(run.gas.lateral[h], written.gas.lateral[h]);
  ASSERT_EQ(run.gas.pressure.size(), 2u);
  EXPECT_EQ(run.gas.pressure[0].drop, 640);
  EXPECT_EQ(run.gas.pressure[0].weight_by_area, 469);
}

TEST(GasTables, OfAnotherProgramMayHoldTheGasAlone) {
  const TestFolder folder;
  put(folder / "gas_axial.csv", "z [m],pressure [Pa]\n0.3,10\n0.1,30\n0.2,20\n");
  const auto run = read_tables(folder, "any");
  EXPECT_EQ(run.gas.axial.coordinate, (std::vector{0.1, 0.2, 0.3}));
  EXPECT_EQ(run.gas.axial.pressure[0].value, 30);
  put(folder / "gas_axial.csv", "z [m],pressure [Pa]\n0.3,10\n0.3,30\n");
  EXPECT_THROW(read_tables(folder, "any"), FormatError);
}

std::vector<double> dataset(hid_t file, const char* name) {
  const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
  EXPECT_GE(set, 0) << name;
  if (set < 0) return {};
  const hid_t space = H5Dget_space(set);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  H5Sclose(space);
  H5Dclose(set);
  return values;
}

TEST(GasTables, FieldsStandInResultsFileAndImage) {
  const TestFolder folder;
  const auto run = run_with_gas();
  write_results_file(std::vector{run}, folder / "results.h5");
  const hid_t file = H5Fopen((folder / "results.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  EXPECT_EQ(dataset(file, "runs/1/gas/fields/voidage"), run.gas.fields.voidage);
  EXPECT_EQ(dataset(file, "runs/1/gas/axial/slip_z"), (std::vector<double>{5, 6, 7, 8}));
  EXPECT_EQ(dataset(file, "runs/1/gas/voidage_check/ratio"), std::vector<double>{0.5});
  EXPECT_EQ(dataset(file, "runs/1/gas/mean_pressure_drop"), (std::vector<double>{645, 5}));
  // The image gives a bed one cell deep two points: front and back.
  EXPECT_EQ(dataset(file, "VTKHDF/PointData/voidage").size(), 2 * run.grid.size());
  EXPECT_EQ(H5Lexists(file, "VTKHDF/PointData/gas_temperature", H5P_DEFAULT), 0);  // it has none
  H5Fclose(file);
}

TEST(GasTables, SummaryHasItsNumbersForRunsWithGasOnly) {
  const auto json =
      nlohmann::json::parse(summary_text(std::vector{run_with_gas(), example_run("no gas")}));
  const auto& run = json["runs"][0];
  EXPECT_EQ(run["gas_times"], 3);
  EXPECT_EQ(run["gas_matched"], 1);
  EXPECT_EQ(run["voidage_ratio"], 0.5);
  EXPECT_EQ(run["pressure_drop"], 645);
  EXPECT_EQ(run["pressure_drop_ci95"], 5);
  EXPECT_EQ(run["bed_weight_over_area"], 469);
  EXPECT_FALSE(json["runs"][1].contains("gas_times"));
}

}  // namespace
}  // namespace bedscope::analysis
