// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>

#include "openfoam_samples.hpp"

namespace bedscope::readers {
namespace {

using namespace samples;

TEST(OpenFoamFile, IsToldByItsHeaderBehindComments) {
  const Folder folder;
  EXPECT_TRUE(is_openfoam_file(folder.write("a", "/* x */ // y\n" + header("dictionary"))));
  EXPECT_FALSE(is_openfoam_file(folder.write("b", "ITEM: TIMESTEP\n0\nFoamFile {}\n")));
  EXPECT_FALSE(is_openfoam_file(folder.write("c", "/* not closed FoamFile")));
  EXPECT_FALSE(is_openfoam_file(folder.write("d", "")));
}

TEST(OpenFoamFile, RangesOfAFieldLeaveOutWhatIsNotFinite) {
  const Folder folder;
  const auto path = folder.write(
      "U", header("volVectorField") +
               "dimensions [0 1 -1 0 0 0 0]; internalField nonuniform List<vector> 3((1 2 3)(nan 0 "
               "1)(-3 4 2)); boundaryField {}");
  const auto file = summarise_openfoam_file(path);
  EXPECT_EQ(file.count, 3U);
  EXPECT_EQ(file.what, "cells");
  ASSERT_EQ(file.ranges.size(), 3U);
  EXPECT_EQ(file.ranges[0].min, -3);
  EXPECT_EQ(file.ranges[0].max, 1);
  EXPECT_EQ(file.ranges[0].mean(), -1);
  EXPECT_EQ(file.ranges[2].mean(), 2);
  EXPECT_EQ(file.non_finite, 1U);
  ASSERT_EQ(file.problems.size(), 1U);
  EXPECT_NE(file.problems[0].find("1 cells are nan or inf, the first is 1"), std::string::npos)
      << file.problems[0];
}

TEST(OpenFoamFile, UniformListOfACloudIsBoundedByItsPositions) {
  const Folder folder;
  const auto d = folder.write("d", header("scalarField") + "1099511627776{0.002}\n");
  EXPECT_EQ(summarise_openfoam_file(d).count, 1099511627776U);  // claimed, and not repeated
  folder.write("positions", header("Cloud<parcel>") + "2((0 0 0) 0 (1 1 1) 0)\n");
  EXPECT_NE(error_of([&] { summarise_openfoam_file(d); }).find("positions has 2 entries"),
            std::string::npos);
  folder.write("d", header("scalarField") + "2{0.002}\n");
  EXPECT_EQ(summarise_openfoam_file(d).count, 2U);
}

TEST(OpenFoamFile, CutFilesGiveAnErrorOrFewerEntries) {
  const Folder folder;
  const auto text = header("labelList") + "4(1 2 3 4)\n";
  for (std::size_t size = header("labelList").size(); size + 2 < text.size(); ++size) {
    const auto path = folder.write("owner", text.substr(0, size));
    EXPECT_NE(error_of([&] { summarise_openfoam_file(path); }), "") << size;
  }
}

// Every OpenFOAM file of the corpus against a table made by another reader (python, struct).
TEST(OpenFoamFile, CorpusFilesAreWhatTheTableSays) {
  if (!corpus_there()) GTEST_SKIP() << "no corpus beside the project";
  const auto rows = csv(shared / "corpus/expected.csv");
  std::map<std::string, std::size_t> at;
  for (std::size_t k = 0; k < rows[0].size(); ++k) at[rows[0][k]] = k;
  std::size_t files = 0, counts = 0, bounds = 0;
  for (const auto& row : rows) {
    const auto cell = [&](const char* name) { return row.at(at.at(name)); };
    if (row.size() < rows[0].size() || !cell("form").starts_with("of-")) continue;
    const auto path = (shared / "corpus" / cell("path")).string();
    if (!fs::exists(path)) continue;
    SCOPED_TRACE(path);
    FoamFileSummary file;
    ASSERT_EQ(error_of([&] { file = summarise_openfoam_file(path); }), "");
    ++files;
    auto form = cell("form").substr(3);
    const auto note = cell("note");
    const bool collated = note.starts_with("collated");
    EXPECT_EQ(file.collated, collated);
    if (form.starts_with("collated ")) form = form.substr(9);
    if (form.starts_with("cloud-"))
      EXPECT_TRUE(file.class_name.starts_with("Cloud<")) << file.class_name;
    else
      EXPECT_EQ(file.class_name, form.substr(0, form.find(' ')));
    const bool binary = note.starts_with("binary") || note.find("inner format binary") != note.npos;
    EXPECT_EQ(file.binary, binary) << note;
    EXPECT_EQ(file.compressed, note.find(" gz") != note.npos);
    if (path.ends_with("ascii/0/T")) {  // the table saw a uniform value behind the code
      EXPECT_NE(file.problems.at(0).find("#codeStream"), std::string::npos);
    } else if (cell("n") == "uniform" || note.find("'uniform', 'uniform'") != note.npos) {
      EXPECT_TRUE(file.uniform);
    } else if (!cell("n").empty()) {
      ASSERT_TRUE(file.count.has_value());
      EXPECT_EQ(std::to_string(*file.count), cell("n"));
      ++counts;
    }
    std::smatch found;
    if (std::regex_search(note, found, std::regex("min/max vertices ([0-9]+)/([0-9]+)"))) {
      EXPECT_EQ(file.ranges.at(0).min, std::stod(found[1]));
      EXPECT_EQ(file.ranges.at(0).max, std::stod(found[2]));
    }
    if (!cell("radius_min").empty()) {
      const double factor = cell("radius_array") == "d/2" ? 0.5 : 1;
      EXPECT_EQ(file.ranges.at(0).min * factor, std::stod(cell("radius_min")));
      EXPECT_EQ(file.ranges.at(0).max * factor, std::stod(cell("radius_max")));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string axis(1, "xyz"[k]);
      if (cell((axis + "min").c_str()).empty()) continue;
      ASSERT_EQ(file.ranges.size(), 3U);
      EXPECT_EQ(file.ranges[k].min, std::stod(cell((axis + "min").c_str())));
      EXPECT_EQ(file.ranges[k].max, std::stod(cell((axis + "max").c_str())));
      ++bounds;
    }
  }
  std::printf("%zu files, %zu counts, %zu bounds\n", files, counts, bounds);
  EXPECT_GT(files, 2000U);
  EXPECT_GT(counts, 1300U);
  EXPECT_GT(bounds, 250U);
}

}  // namespace
}  // namespace bedscope::readers
