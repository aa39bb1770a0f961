// SPDX-License-Identifier: BSD-3-Clause
// Figures of the gas: drawn where there is gas, and only there.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "report/figures.hpp"
#include "tests/report/synthetic_run.hpp"

namespace bedscope::tests {
namespace {

namespace fs = std::filesystem;
using analysis::RunResult;

analysis::GasProfile gas_beside(const analysis::Profile& solids, bool pressure) {
  analysis::GasProfile gas;
  gas.coordinate = solids.coordinate;
  for (std::size_t i = 0; i < solids.coordinate.size(); ++i) {
    gas.voidage.push_back({1 - solids.holdup[i].value, 0.01});
    gas.velocity_z.push_back({5 / gas.voidage.back().value, 0.2});
    gas.temperature.push_back({});
    gas.pressure.push_back(pressure ? analysis::Estimate{1e5 - 400 * solids.coordinate[i], 3}
                                    : analysis::Estimate{});
    gas.slip_z.push_back({});
  }
  return gas;
}

RunResult run_with_gas(const std::string& label, bool pressure) {
  SyntheticOptions options;
  options.label = label;
  auto run = synthetic_run(options);
  run.gas.present = run.gas.has_velocity = true;
  run.gas.has_pressure = pressure;
  run.gas.axial = gas_beside(run.species.front().axial, pressure);
  for (const auto& profile : run.species.front().lateral)
    run.gas.lateral.push_back(gas_beside(profile, pressure));
  return run;
}

const report::Figure* find(const std::vector<report::Figure>& figures, const std::string& name) {
  for (const auto& figure : figures)
    if (figure.name == name) return &figure;
  return nullptr;
}

TEST(GasFigures, AreThereOnlyWhereARunHasGas) {
  EXPECT_EQ(find(report::make_figures(std::vector{synthetic_run()}), "gas_axial"), nullptr);
  const auto figures =
      report::make_figures(std::vector{synthetic_run(), run_with_gas("with gas", true)});
  ASSERT_NE(find(figures, "gas_axial"), nullptr);
  ASSERT_NE(find(figures, "gas_lateral"), nullptr);
  const auto& data = find(figures, "gas_axial")->data;
  EXPECT_NE(data.find("with gas: gas, voidage"), std::string::npos);
  EXPECT_NE(data.find("with gas: solids, v_z"), std::string::npos);
  EXPECT_EQ(data.find("K = 1: gas"), std::string::npos);
}

TEST(GasFigures, ShowPressureLessThatOfTheTop) {
  const auto with = report::make_figures(std::vector{run_with_gas("a", true)});
  const auto without = report::make_figures(std::vector{run_with_gas("a", false)});
  EXPECT_NE(find(with, "gas_axial")->script.find("top"), std::string::npos);
  EXPECT_NE(find(with, "gas_axial")->caption.find("pressure"), std::string::npos);
  EXPECT_EQ(find(without, "gas_axial")->caption.find("pressure"), std::string::npos);
  EXPECT_GT(find(with, "gas_axial")->width, find(without, "gas_axial")->width);
}

TEST(GasFigures, AreDrawnAlsoFullOfNan) {
  auto empty = run_with_gas("empty", true);
  for (auto* profile : {&empty.gas.axial, &empty.gas.lateral[0]})
    for (auto* values : {&profile->voidage, &profile->velocity_z, &profile->pressure})
      values->assign(values->size(), {});
  auto figures = report::make_figures(std::vector{run_with_gas("a", true), empty});
  std::erase_if(figures, [](const auto& figure) { return !figure.name.starts_with("gas_"); });
  ASSERT_EQ(figures.size(), 2u);
  const fs::path folder =
      fs::path(testing::TempDir()) / ("bedscope_gas_figures_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  report::draw_figures(figures, folder, false);
  for (const char* name : {"gas_axial.svg", "gas_lateral.svg"})
    EXPECT_GT(fs::file_size(folder / name), 5000u) << name;
  fs::remove_all(folder);
}

}  // namespace
}  // namespace bedscope::tests
