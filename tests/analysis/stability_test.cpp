// SPDX-License-Identifier: BSD-3-Clause
// Where the methods of the analysis fail, and whether the tool says so before: each map has a
// stable side, an unstable side and the warning, which must be on where the method fails and silent
// at twice the margin. The lines "map ..." are the figures of docs/stability.md
// (cases/stability/analysis/maps.py).
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

#include "analysis/cluster_sensitivity.hpp"
#include "analysis/run_setup.hpp"
#include "analysis/statistics.hpp"
#include "readers/rewrite.hpp"
#include "tests/analysis/random_series.hpp"

namespace bedscope::analysis {
namespace {

// --- thresholds of clusters near their edges

constexpr int side = 60, patches = 10;  // patches x patches clusters of 4 x 4 cells

Grid square() {
  Grid grid;
  grid.max = {0.06, 0.01, 0.06};
  grid.cells = {side, 1, side};
  return grid;
}

/// A hundred patches whose holdup lies by `margin` above `level`, spread by +-0.3 %.
std::vector<double> patches_at(double level, double margin) {
  std::vector<double> holdup(side * side, 0.05);
  for (int p = 0; p < patches * patches; ++p) {
    const double spread = 0.003 * (2 * ((p * 37) % 100) / 99. - 1);
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < 4; ++i)
        holdup[static_cast<std::size_t>((p / patches * 6 + k + 1) * side + p % patches * 6 + i +
                                        1)] = level * (1 + margin + spread);
  }
  return holdup;
}

double number_of(const std::vector<double>& holdup, const ClusterThresholds& thresholds) {
  return static_cast<double>(
      find_clusters(square(), holdup, holdup, holdup, holdup, thresholds).clusters.size());
}

TEST(StabilityOfClusters,
     AThresholdAtAnEdgeOfWhatThereIsIsWarnedOfBeforeHalfAPercentMovesTheNumber) {
  const ClusterThresholds thresholds{.threshold = 0.2, .core = 0.4, .min_area = 10e-6};
  for (int k = -24; k <= 24; ++k) {
    const double margin = 0.0025 * k;
    const auto holdup = patches_at(thresholds.core, margin);
    ClusterSensitivity sensitivity;
    sensitivity.add(square(), holdup, thresholds,
                    find_clusters(square(), holdup, holdup, holdup, holdup, thresholds));
    const bool warned = !sensitivity.describe(thresholds).empty();
    auto lower = thresholds, higher = thresholds;
    lower.core *= 0.995;
    higher.core *= 1.005;
    const double spread = number_of(holdup, lower) - number_of(holdup, higher);
    const double moves = spread / (patches * patches);
    std::printf("map clusters %g %g %g %d\n", margin, moves, sensitivity.number_moves(), warned);
    if (moves > 0.05) {
      EXPECT_TRUE(warned) << margin;
    }  // it fails here
    if (std::abs(margin) >= 0.02 - 1e-9) {
      EXPECT_FALSE(warned) << margin;
    }  // twice 1 %
    if (std::abs(margin) < 0.0101) {
      EXPECT_TRUE(warned) << margin;
    }  // and before
  }
}

TEST(StabilityOfClusters, AnAreaThatIsAWholeNumberOfCellsIsWarnedOf) {
  // 16 cells of 1 mm2 in each patch: 16 mm2 is an edge, 15.5 mm2 is none.
  const auto holdup = patches_at(0.4, 0.1);
  for (const auto& [area, edge] : {std::pair(16e-6, true), {15.5e-6, false}, {16.5e-6, false}}) {
    const ClusterThresholds thresholds{.threshold = 0.2, .core = 0.4, .min_area = area};
    ClusterSensitivity sensitivity;
    sensitivity.add(square(), holdup, thresholds,
                    find_clusters(square(), holdup, holdup, holdup, holdup, thresholds));
    EXPECT_EQ(sensitivity.describe(thresholds).find("min_area") != std::string::npos, edge) << area;
  }
}

// --- windows too short for their own error bar

TEST(StabilityOfWindows, AWindowTooShortForItsErrorBarIsWarnedOf) {
  constexpr int repetitions = 1000;
  for (const double rho : {0.0, 0.8, 0.95}) {
    const double time = (1 + rho) / (1 - rho);  // integrated autocorrelation time, in samples
    for (const double independent : {1., 2., 4., 8., 16., 32., 64., 128., 256.}) {
      const auto n = static_cast<std::size_t>(std::max(2., independent * time));
      tests::Random random(5);
      int held = 0, warned = 0;
      for (int i = 0; i < repetitions; ++i) {
        const auto series = tests::ar1(random, rho, n);
        const auto mean = estimate_mean(series, std::vector<double>(n, 1.));
        held += std::abs(mean.value) <= mean.ci95;
        warned += mean.few_samples || mean.disagree;
      }
      const double coverage = held / 1000., share = warned / 1000.;
      std::printf("map windows %g %g %g %g\n", rho, independent, coverage, share);
      if (coverage < 0.90) {
        EXPECT_GE(share, 0.95) << rho << " " << independent;
      }
      // The autocorrelation time is itself estimated from the window: it takes four times the ten
      // independent samples at which the warning means to end until it is silent.
      if (independent >= 64) {
        EXPECT_LE(share, 0.05) << rho << " " << independent;
      }
    }
  }
}

// --- the start of the steady part of a drifting series

TEST(StabilityOfTheSteadyStart, ADriftThatBiasesTheMeanIsWarnedOf) {
  constexpr int repetitions = 500;
  constexpr std::size_t n = 400;
  for (const double rho : {0.0, 0.5, 0.9}) {
    const double error = std::sqrt((1 + rho) / (1 - rho) / n);  // of the mean of the whole series
    for (const double drift : {0., 0.5, 1., 2., 4., 8., 16., 32., 64.}) {  // in such errors
      tests::Random random(9);
      int wrong = 0, far_off = 0, warned = 0;
      for (int i = 0; i < repetitions; ++i) {
        auto series = tests::ar1(random, rho, n);
        for (std::size_t k = 0; k < n; ++k)
          series[k] += drift * error * (static_cast<double>(k) / n - 1);  // ends at 0
        const auto found = steady_start(series);
        const std::vector<double> kept(series.begin() + static_cast<std::ptrdiff_t>(found.start),
                                       series.end());
        const auto mean = estimate_mean(kept, std::vector<double>(kept.size(), 1.));
        wrong += std::abs(mean.value) > mean.ci95;  // the state at the end is missed
        far_off += std::abs(mean.value) > 2 * mean.ci95;
        warned += !found.steady || mean.few_samples || mean.disagree ||
                  drift_of(kept).significance > significant_drift;
      }
      const double missed = 1. * wrong / repetitions, share = 1. * warned / repetitions;
      const double far = 1. * far_off / repetitions;
      std::printf("map drift %g %g %g %g %g\n", rho, drift, missed, share, far);
      // No rule sees a drift of two standard errors; one that puts the mean off by twice its
      // interval is told in most cases, and a steady series seldom.
      EXPECT_GE(share, far - 0.05) << rho << " " << drift;
      if (drift == 0 && rho < 0.9) {
        EXPECT_LE(share, 0.05) << rho;
      }
    }
  }
}

// --- the gaussian kernel narrower than a cell

RunSettings settings_of(const std::string& path) {
  RunSettings settings;
  settings.label = "a";
  settings.particles = path;
  settings.time_required = false;
  settings.domain = {{{0, 0, 0}, {0.08, 0.01, 0.16}}};
  settings.density.all = 2500;
  return settings;
}

/// A dump of one particle, for the warnings that come with the set-up.
class OneDump : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("bedscope_stability_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    readers::Snapshot one;
    one.step = 1;
    one.particles = 1;
    one.columns = {{0.04}, {0.005}, {0.08}, {0}, {0}, {1}, {0.001}};
    readers::write_dump(path(), readers::DumpForm::text, one,
                        {{"x"}, {"y"}, {"z"}, {"vx"}, {"vy"}, {"vz"}, {"radius"}});
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path() const { return (folder_ / "dump1.liggghts").string(); }

  bool warned(const RunSettings& settings, const std::string& words) const {
    const auto series = readers::Series::open(path());
    const auto setup = set_up(settings, series);
    return std::any_of(
        setup.problems.begin(), setup.problems.end(),
        [&](const std::string& problem) { return problem.find(words) != std::string::npos; });
  }

 private:
  std::filesystem::path folder_;
};

using StabilityOfMapping = OneDump;

TEST_F(StabilityOfMapping, AGaussianNarrowerThanACellIsWarnedOfBeforeItJumps) {
  auto settings = settings_of(path());
  settings.cell = {0.01, 0.01};
  settings.mapping = "gaussian";
  Grid grid;
  grid.max = {0.08, 0.01, 0.16};
  grid.cells = {8, 1, 16};
  for (const double width : {0.02, 0.05, 0.075, 0.1, 0.2, 0.5, 0.9, 1., 2., 4.}) {  // in cells
    settings.gaussian_width = 0.01 * width;
    const GaussianKernel kernel(grid, settings.gaussian_width);
    // The share of a cell while a particle crosses its face by a tenth of a cell.
    const auto share = [&](double x) {
      double in_cell = 0;
      kernel.share({x, 0.005, 0.085}, 0.001, [&](std::size_t cell, double volume) {
        if (cell % 8 == 4) in_cell += volume;
      });
      return in_cell / sphere_volume(0.001);
    };
    const double jump = share(0.0405) - share(0.0395);
    const bool says = warned(settings, "narrower than a cell");
    std::printf("map gaussian %g %g %d\n", width, jump, says);
    if (jump > 0.5) {
      EXPECT_TRUE(says) << width;
    }  // as good as no smoothing
    if (width >= 1) {
      EXPECT_FALSE(says) << width;
    }  // the default is one cell
    if (width < 1) {
      EXPECT_TRUE(says) << width;
    }
  }
}

// --- domains of a few cells

TEST_F(StabilityOfMapping, ALateralProfileOfTooFewCellsIsWarnedOf) {
  // The riser's lateral holdup, 1 + 0.45 xi^2 over half its width, as cells of n give it.
  const auto integral = [](double xi) { return xi + 0.15 * xi * xi * xi; };
  for (const int n : {1, 2, 3, 4, 5, 6, 8, 10, 14, 20, 28}) {
    std::vector<double> cell(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i)
      cell[static_cast<std::size_t>(i)] =
          (integral(-1 + 2. * (i + 1) / n) - integral(-1 + 2. * i / n)) * n / 2;
    // The excess at the walls over the core, of which outer and middle cells tell.
    const double excess = cell.front() - cell[static_cast<std::size_t>(n / 2)];
    const double lost = 1 - excess / 0.45;
    auto settings = settings_of(path());
    settings.cells = {n, 16};
    const bool says = warned(settings, "cells across");
    std::printf("map across %d %g %d\n", n, lost, says);
    if (lost > 0.5) {
      EXPECT_TRUE(says) << n;
    }
    if (n >= 10) {
      EXPECT_FALSE(says) << n;
    }
    if (n == 3) {
      EXPECT_TRUE(says);
    }
  }
}

}  // namespace
}  // namespace bedscope::analysis
