// SPDX-License-Identifier: BSD-3-Clause
// Figures of bed height, bubbles and spectra: there where the study asked for them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "report/figures.hpp"
#include "tests/report/synthetic_run.hpp"

namespace bedscope::tests {
namespace {

using analysis::RunResult;

RunResult bed_run(const std::string& label, double size) {
  SyntheticOptions options;
  options.label = label;
  RunResult run = synthetic_run(options);
  run.bed.asked = true;
  run.bed.at_rest = 0.2;
  run.bed.by_centre = {0.3, 0.01};
  run.bed.expansion = {1.5, 0.05};
  for (const auto& sample : run.occurrence)
    run.bed.samples.push_back({sample.time, 0.3 + 0.01 * std::sin(sample.time), 0.28, 0.31, 1.5});
  run.bubbles.emplace();
  run.bubbles->thresholds = {0.8, 0.9, 25e-6};
  for (int b = 0; b < 10; ++b) {
    const double z = 0.05 + 0.1 * b;
    analysis::BubbleBand band{z, 0.1, {b < 5 ? 2. : 0., 0.1}, {}, {}, {}, {}};
    if (b < 5) {
      band.diameter = {size + 0.02 * z, 0.001};
      band.velocity = {0.3 + z, 0.02};
      band.frequency = {3 - z, 0.4};
      band.area_fraction = {0.1, 0.02};
    }
    run.bubbles->bands.push_back(band);
  }
  analysis::Cluster bubble;
  bubble.snapshot = run.frames.front().snapshot;
  bubble.contours = {{{0.02, 0.1}, {0.04, 0.1}, {0.04, 0.2}, {0.02, 0.1}}};
  run.bubbles->bubbles = {bubble, bubble};
  run.bubbles->bubbles[1].at_wall = true;
  for (const std::string signal : {"mean height", "p at (0 0 0.05) m"}) {
    analysis::Fluctuation one;
    one.signal = signal;
    one.unit = signal == "mean height" ? "m" : "Pa";
    one.dominant = {2.5, 0.5};
    for (int k = 0; k < 50; ++k) {
      const double f = 0.5 * k, p = 1e-3 / (1 + std::pow(f - 2.5, 2));
      one.spectrum.frequency.push_back(f);
      one.spectrum.density.push_back(p);
      one.spectrum.low.push_back(0.6 * p);
      one.spectrum.high.push_back(2 * p);
    }
    run.fluctuations.push_back(one);
  }
  return run;
}

const report::Figure* find(const std::vector<report::Figure>& figures, const std::string& name) {
  const auto found = std::find_if(figures.begin(), figures.end(),
                                  [&](const auto& figure) { return figure.name == name; });
  return found == figures.end() ? nullptr : &*found;
}

TEST(BedFigures, AreNotOnThePageOfARunThatDidNotAsk) {
  RunResult run = synthetic_run();
  run.bed = bed_run("a", 0.02).bed;
  run.bed.asked = false;
  const auto figures = report::make_figures(std::vector{run});
  for (const char* name : {"bed_height", "bubbles", "bubble_profile", "spectra"})
    EXPECT_EQ(find(figures, name), nullptr) << name;
}

TEST(BedFigures, AreDrawnForOneRunAndForSeveral) {
  for (const auto& runs : {std::vector{bed_run("a", 0.02)},
                           std::vector{bed_run("a", 0.02), bed_run("b 'quoted' _x", 0.03)}}) {
    const auto all = report::make_figures(runs);
    std::vector<report::Figure> figures;
    for (const auto& figure : all)
      if (figure.name.starts_with("b") || figure.name == "spectra") figures.push_back(figure);
    ASSERT_EQ(figures.size(), runs.size() == 1 ? 4U : 5U);
    const auto folder = std::filesystem::path(testing::TempDir()) /
                        ("bedscope_bed_figures_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    report::draw_figures(figures, folder, true);
    for (const auto& figure : figures) {
      EXPECT_TRUE(figure.missing.empty()) << figure.name << ": " << figure.missing;
      EXPECT_LE(figure.width, 170.0) << figure.name;
      EXPECT_LE(figure.height, 230.0) << figure.name;
      EXPECT_GT(std::filesystem::file_size(folder / (figure.name + ".png")), 5000U);
    }
    if (std::getenv("BEDSCOPE_KEEP_FIGURES") == nullptr) std::filesystem::remove_all(folder);
  }
}

TEST(BedFigures, OfTenRunsFitOnAPage) {
  std::vector<RunResult> runs;
  for (int r = 0; r < 10; ++r) runs.push_back(bed_run("run " + std::to_string(r), 0.02));
  const auto figures = report::make_figures(runs);
  for (const char* name : {"bed_height", "bubbles_10", "bubble_profile", "spectra"}) {
    ASSERT_NE(find(figures, name), nullptr) << name;
    EXPECT_LE(find(figures, name)->height, 230.0) << name;
  }
}

TEST(BedFigures, ShowWhatWasFound) {
  const auto figures = report::make_figures(std::vector{bed_run("a", 0.02)});
  EXPECT_NE(find(figures, "bubble_profile")->data.find("21 0.05 1\n"), std::string::npos)
      << "0.02 + 0.02 x 0.05 m in mm, height in m, interval in mm";
  EXPECT_EQ(find(figures, "bubble_profile")->data.find("nan 0.05"), std::string::npos);
  EXPECT_NE(find(figures, "bubbles")->caption.find("voidage > 0.8 everywhere, > 0.9 somewhere"),
            std::string::npos);
  EXPECT_NE(find(figures, "bubbles")->data.find("outlines of bubbles at walls"), std::string::npos);
  EXPECT_NE(find(figures, "spectra")->script.find("set logscale y"), std::string::npos);
  EXPECT_NE(find(figures, "spectra")->data.find("\n2.5 0.001 0.0006 0.002\n"), std::string::npos);
  EXPECT_NE(find(figures, "bed_height")->script.find("expansion 1.50 ± 0.05"), std::string::npos);
}

}  // namespace
}  // namespace bedscope::tests
