// SPDX-License-Identifier: BSD-3-Clause
#include "cases/scene_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <vector>

#include "readers/error.hpp"

namespace bedscope::cases {
namespace {

namespace fs = std::filesystem;

const std::string folder = BEDSCOPE_SOURCE "/cases/";

/// All scene files that ship: those that stand alone, not the parts that others lie over.
std::vector<std::string> shipped() {
  std::vector<std::string> files;
  for (const auto* scene :
       {"riser", "bubbling_bed", "fixed_bed", "binary_riser", "mueller_bed", "impact"})
    for (const auto& item : fs::directory_iterator(folder + scene))
      if (item.path().extension() == ".toml") files.push_back(item.path().string());
  return files;
}

class SceneFile : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& content) {
    std::ofstream(dir_ / name) << content;
    return (dir_ / name).string();
  }
  std::string error(const std::string& path) {
    try {
      read_scene(path);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  void TearDown() override { fs::remove_all(dir_); }

  fs::path dir_ = [] {
    auto name = (fs::temp_directory_path() / "scene_XXXXXX").string();
    return fs::path(mkdtemp(name.data()));
  }();
  const std::string base_ = write("base.toml", R"([geometry]
width = 0.05
depth = 0.01
height = 0.2
[gas]
density = 1.2
viscosity = 1.8e-5
velocity = 0.6
[[species]]
diameter = 1e-3
density = 1000
[particles]
number = 1000
[contact]
normal_stiffness = 1000
[numerics]
grid = [10, 4, 40]
dem_step = 1e-5
gas_step = 1e-4
output = 0.01
end = 1
)");
};

TEST_F(SceneFile, ThatShipsIsRead) {
  const auto files = shipped();
  EXPECT_GT(files.size(), 70U);
  for (const auto& file : files) EXPECT_NO_THROW(read_scene(file)) << file;
}

TEST_F(SceneFile, WrittenAndReadAgainIsTheSame) {
  for (const auto& file : shipped()) {
    const auto text = scene_text(read_scene(file));
    EXPECT_EQ(scene_text(read_scene(write("again.toml", text))), text) << file;
  }
}

TEST_F(SceneFile, HoldsTheRiserOfTheThesis) {
  const auto scene = read_scene(folder + "riser/scene.toml");
  EXPECT_EQ(scene.particles.number, 50000);
  EXPECT_NEAR(mean_holdup(scene), 0.0255, 5e-5);  // Table 4.1
  EXPECT_NEAR(solids_mass(scene), 0.0402, 5e-5);  // 50,000 pi/6 d^3 rho
  EXPECT_EQ(scene.contacts.wall.restitution, 0.86);
  EXPECT_EQ(scene.contacts.wall.friction, 0.15);  // as between particles
  EXPECT_EQ(head_layers(scene), 28);              // 70 mm of 2.5 mm
  EXPECT_NEAR(total_height(scene), 1.57, 1e-12);
}

TEST_F(SceneFile, SharesVolumesAmongSpecies) {
  const auto scene = read_scene(folder + "binary_riser/scene.toml");
  const auto numbers = species_numbers(scene);
  ASSERT_EQ(numbers.size(), 2U);
  EXPECT_EQ(numbers[0] + numbers[1], 614465);
  const double ratio = std::pow(185.0 / 125, 3);  // equal volumes
  EXPECT_NEAR(static_cast<double>(numbers[0]) / static_cast<double>(numbers[1]), ratio, 1e-4);
  EXPECT_EQ(scene.species[1].density, 2400);  // not said again
}

TEST_F(SceneFile, OverAnotherTakesItsKeys) {
  const auto path =
      write("upper.toml", "base = \"base.toml\"\ngas.velocity = 0.9\nparticles.mass = 1e-3\n");
  const auto scene = read_scene(path);
  EXPECT_EQ(scene.gas->velocity, 0.9);
  EXPECT_EQ(scene.gas->density, 1.2);
  EXPECT_EQ(scene.particles.number, 1910);  // 1e-3 kg / (1000 pi/6 1e-9), instead of `number`
  write("part.toml", "gas.density = 2\n");
  EXPECT_EQ(read_scene(write("two.toml", "base = [\"base.toml\", \"part.toml\"]\n")).gas->density,
            2);
}

TEST_F(SceneFile, NamesTheFileInWhichAWrongKeyStands) {
  write("lower.toml", "base = \"base.toml\"\ngas.velosity = 0.9\n");
  const auto upper = write("upper.toml", "title = \"x\"\nbase = \"lower.toml\"\n");
  const auto text = error(upper);
  EXPECT_NE(text.find("lower.toml: line 2: unknown key gas.velosity"), text.npos) << text;
  EXPECT_NE(text.find("gas.velocity"), text.npos) << text;
}

TEST_F(SceneFile, ThatLiesOverItselfIsAnError) {
  EXPECT_NE(error(write("self.toml", "base = \"self.toml\"\n")).find("at most 8 files"),
            std::string::npos);
}

TEST_F(SceneFile, WithBadValuesSaysWhatWasExpected) {
  const std::pair<const char*, const char*> cases[] = {
      {"gas.density = -1", "expected a number above 0"},
      {"particles.number = 10.5", "expected a whole number"},
      {"particles.holdup = 0.1\nparticles.mass = 1", "expected one of"},
      {"contact.restitution = 0", "above 0 and up to 1"},
      {"models.drag = \"beetsra\"", "nearest known one is \"beetstra\""},
      {"numerics.grid = [10, 4]", "expected three numbers"},
      {"numerics.grid = [10, 4, 0]", "whole numbers"},
      {"numerics.gas_step = 1.5e-5", "expected a whole number of numerics.dem_step"},
      {"numerics.end = 1.005", "expected a whole number of numerics.output"},
      {"outlet.place = \"left\"", "outlet.height is missing"},
      {"outlet.place = \"up\"", "expected one of \"top\", \"left\", \"right\""},
      {"outlet = { place = \"left\", height = 0.04, head = \"bend\" }", "expected the width"},
      {"inlet.particles = \"feed\"", "inlet.flux is missing"},
      {"inlet.place = \"left\"", "expected a slit"},
      {"models.energy = true", "gas.heat_capacity is missing"},
      {"contact.model = \"hertz\"", "contact.young is missing"},
      {"scale = { factor = 2, condition = \"e\" }", "expected \"a\", \"b\", \"c\" or \"d\""},
      {"scale = { factor = 100, condition = \"b\" }", "leaves no particle"},
      {"scale = { factor = 1e-9, condition = \"b\" }", "from 0.01 to 100"},
      {"[[species]]\n[[species]]\nfraction = 0.5", "fraction is missing"},
      {"[[species]]\nfraction = 0.3\n[[species]]\nfraction = 0.5", "expected a sum of 1"},
      {"particles = { arrangement = \"single\", number = 2, position = [0, 0, 0] }", "only"},
      {"title = 3", "expected a text"}};
  for (const auto& [line, expected] : cases) {
    const auto text = error(write("bad.toml", std::string("base = \"base.toml\"\n") + line + "\n"));
    EXPECT_NE(text.find(expected), text.npos) << line << ": " << text;
    EXPECT_NE(text.find(".toml: "), text.npos) << text;  // its own, or that of the table
  }
}

TEST_F(SceneFile, ScalesLast) {
  const auto scene = read_scene(write("big.toml",
                                      "base = \"base.toml\"\nparticles.number = 8000\n"
                                      "scale = { factor = 2, condition = \"b\" }\n"));
  EXPECT_EQ(scene.particles.number, 1000);
  EXPECT_EQ(scene.species[0].diameter, 2e-3);
  EXPECT_EQ(scene.numerics.grid, (std::array{5, 2, 20}));
}

TEST_F(SceneFile, FeedNeedsThePrintedHoldups) {
  // 32 / (2500 0.01) and 32 / (2500 0.00717): the slit is as large as the cross-section
  EXPECT_NEAR(inlet_holdup(read_scene(folder + "riser/feed_bottom_printed.toml")), 1.28, 1e-9);
  EXPECT_NEAR(inlet_holdup(read_scene(folder + "riser/feed_side_printed.toml")), 1.785, 5e-4);
  EXPECT_NEAR(inlet_holdup(read_scene(folder + "riser/feed_side.toml")), 0.128, 1e-9);
}

}  // namespace
}  // namespace bedscope::cases
