// SPDX-License-Identifier: BSD-3-Clause
// Two small runs with every kind of result in them, and a folder for a test's files.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

#include "analysis/result.hpp"

namespace bedscope::analysis {

inline constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

/// A folder for the files of the running test, gone with it.
class TestFolder {
 public:
  TestFolder() : path_(testing::TempDir() + "bedscope_XXXXXX") {
    if (::mkdtemp(path_.data()) == nullptr) throw std::runtime_error("no folder " + path_);
  }
  ~TestFolder() { std::filesystem::remove_all(path_); }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  operator std::filesystem::path() const { return path_; }
  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

 private:
  std::string path_;
};

inline std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline void put(const std::filesystem::path& path, std::string_view text) {
  std::filesystem::remove(path);  // writing over a file waits for the disk
  std::ofstream(path, std::ios::binary) << text;
}

/// Values that need all their digits, different for every `seed`.
inline Profile example_profile(const Grid& grid, Axis axis, double seed) {
  Profile profile;
  for (int i = 0; i < grid.cells[axis]; ++i) {
    profile.coordinate.push_back(grid.centre(axis, i));
    profile.holdup.push_back({seed / (3 + i), 1e-3 / seed});
    profile.velocity_z.push_back({i == 0 ? undefined : -seed / 7, undefined});
    profile.mass_flux_z.push_back({2500 * seed / (7 + i), 1e300 * seed});
  }
  return profile;
}

inline RunResult example_run(const std::string& label) {
  RunResult run;
  run.label = label;
  run.grid.min = {0, 0, 0.1};
  run.grid.max = {0.07, 0.006, 0.5};
  run.grid.cells = {3, 1, 4};
  run.window = {0.1, 0.3, 1, 3, false, true};
  run.types = {"all", "type 1, \"heavy\""};
  run.heights = {0.2, 0.45};
  run.band = 0.01;
  for (const std::string& type : run.types) {
    const double seed = type == "all" ? 0.31 : 0.17;
    SpeciesResult species;
    species.type = type;
    species.axial = example_profile(run.grid, up, seed);
    for (std::size_t h = 0; h < run.heights.size(); ++h)
      species.lateral.push_back(example_profile(run.grid, lateral, seed + static_cast<double>(h)));
    for (std::size_t i = 0; i < run.grid.size(); ++i) {
      const double value = seed + static_cast<double>(i);
      species.fields.holdup.push_back(value);
      species.fields.velocity_x.push_back(i == 5 ? undefined : -value);
      species.fields.velocity_z.push_back(i == 5 ? undefined : 10 * value);
      species.fields.mass_flux_x.push_back(100 * value);
      species.fields.mass_flux_z.push_back(1000 * value);
    }
    species.temperature_pdf = {0, 0.5, 1.5, 2};
    run.species.push_back(species);
    for (int i = 0; i < 4; ++i) {
      run.inventory.push_back({0.1 * i, type, 50'000 + i, seed, 0.01 * seed, 0.25 + seed});
      run.temperature.push_back({0.1 * i, type, 350 + seed, 1.0 / 3, 331, 379.5});
    }
  }
  run.temperature_from = 330;
  run.temperature_to = 380;
  for (int i = 0; i < 4; ++i) run.occurrence.push_back({0.1 * i, i == 1 ? 2 : 1, 0.02 * i});
  for (int i = 0; i < 4; ++i) {  // two in snapshot 1, one in each of 2 and 3
    Cluster c;
    c.snapshot = static_cast<std::size_t>(i < 2 ? 1 : i);
    c.time = run.occurrence[c.snapshot].time;
    c.cluster = i == 1 ? 2 : 1;
    c.track = i + 1;
    c.centre = {0.03 + 0.001 * i, 1.0 / 3};
    c.area = 61e-6;
    c.holdup = 0.25;
    c.holdup_max = 0.41;
    c.velocity_x = -0.1 * i;
    c.velocity_z = 1.5;
    c.track_velocity_x = c.track_velocity_z = i < 2 ? undefined : 0.75;
    c.major = 0.02;
    c.minor = 0.01;
    c.angle = -0.5;
    if (i == 2) c.parents = {1, 2};
    c.contours = {{{0, 0.1}, {0.01, 0.1}, {0.01, 0.2 + i}, {0, 0.1}}};
    if (i == 3) c.contours.push_back({{0.002, 0.12}, {0.004, 0.12}, {0.002, 0.12}});
    run.clusters.push_back(c);
  }
  run.frames = {{1, 0.1, std::vector<double>(12, 0.5)}, {3, 0.3, std::vector<double>(12, 0.25)}};
  run.mean_holdup = {0.0123, 0.0004};
  run.inventory_mass = {0.31, 0.001};
  run.mean_occurrence = {4.0 / 3, 0.2};
  run.bed_voidage = {0.6, undefined};
  run.independent_samples = 2.5;
  run.outside_fraction = 1e-6;
  run.bytes_read = 123'456'789'012;
  run.seconds = 1.25;
  run.problems = {"dump.3: cut after 17 of 20 particles"};
  return run;
}

}  // namespace bedscope::analysis
