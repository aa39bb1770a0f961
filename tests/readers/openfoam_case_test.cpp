// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <thread>

#include "openfoam_samples.hpp"
#include "readers/openfoam_field.hpp"

namespace bedscope::readers {
namespace {

using namespace samples;

const fs::path made = shared / "corpus/made";

std::vector<std::string> time_names(const OpenFoamCase& foam) {
  std::vector<std::string> names;
  for (const auto& time : foam.times()) names.push_back(time.name);
  return names;
}

FieldValues read(const OpenFoamCase& foam, std::string_view field, std::size_t time) {
  FieldValues values;
  foam.read(time, field, values);
  return values;
}

// All fields of all times of two cases, equal up to a share of the largest value.
void expect_same(const OpenFoamCase& a, const OpenFoamCase& b, double tolerance) {
  ASSERT_EQ(a.times().size(), b.times().size());
  ASSERT_EQ(a.mesh().cells(), b.mesh().cells());
  // Faces may be turned, or points have six digits (24 bits), of cells of a tenth of the bed.
  const double of_mesh = tolerance == 0 ? 1e-13 : 1e-5;
  for (std::size_t c = 0; c < a.mesh().cells(); ++c) {
    EXPECT_NEAR(a.mesh().volumes[c], b.mesh().volumes[c], of_mesh * a.mesh().volumes[c]);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(a.mesh().centres[c][k], b.mesh().centres[c][k], of_mesh);
  }
  for (std::size_t t = 0; t < a.times().size(); ++t) {
    EXPECT_DOUBLE_EQ(a.times()[t].time, b.times()[t].time);
    for (const auto& name : a.fields_at(t)) {
      const auto& others = b.fields_at(t);
      if (!std::binary_search(others.begin(), others.end(), name)) continue;
      const auto x = read(a, name, t), y = read(b, name, t);
      ASSERT_EQ(x.values.size(), y.values.size()) << name;
      EXPECT_EQ(x.dimensions, y.dimensions) << name;
      double largest = 0;
      for (const double value : x.values) largest = std::max(largest, std::abs(value));
      for (std::size_t i = 0; i < x.values.size(); ++i)
        ASSERT_NEAR(x.values[i], y.values[i], tolerance * largest) << name << " " << i;
    }
  }
}

TEST(OpenFoamCase, RanksInAnyFormAreTheWholeCase) {
  const auto whole = OpenFoamCase::open((data / "whole").string());
  const auto separate = OpenFoamCase::open((data / "separate").string());
  const auto collated = OpenFoamCase::open((data / "collated").string());
  EXPECT_EQ(whole.ranks(), 1U);
  EXPECT_EQ(separate.ranks(), 2U);
  EXPECT_EQ(collated.ranks(), 2U);
  EXPECT_EQ(separate.fields_at(0), (std::vector<std::string>{"U.air", "p"}));
  EXPECT_TRUE(separate.mesh().boxes.has_value() && separate.mesh().boxes->rectilinear);
  expect_same(whole, separate, 0);
  expect_same(whole, collated, 0);
  for (const auto* foam : {&whole, &separate, &collated}) EXPECT_TRUE(foam->problems().empty());
}

TEST(OpenFoamCase, CollatedRangesAreReadByRank) {
  // The two blocks of processors2 as processors2_0-0 and processors2_1-1.
  const Folder folder;
  for (std::size_t keep = 0; keep < 2; ++keep)
    for (const auto& entry : fs::recursive_directory_iterator(data / "collated/processors2")) {
      if (!entry.is_regular_file()) continue;
      auto text = bytes_of(entry.path());
      const auto relative = fs::relative(entry.path(), data / "collated/processors2").string();
      const auto first = text.find("// Processor0"), second = text.find("// Processor1");
      if (first != std::string::npos)
        text = text.substr(0, first) +
               (keep == 0 ? text.substr(first, second - first) : text.substr(second));
      // Only the first block tells the format of its data.
      if (keep == 1 && second != std::string::npos) {
        FoamBlocks file(entry.path().string());
        ASSERT_TRUE(file.next());
        auto begin = text.find("(", text.find("// Processor1"));
        const auto own = header(file.header().class_name, "binary");
        const auto count = std::stoul(text.substr(text.find("// Processor1") + 13));
        text = text.substr(0, text.find("// Processor1")) +
               fmt::format("{}\n(", count + own.size()) + own + text.substr(begin + 1);
      }
      folder.write(fmt::format("processors2_{}-{}/{}", keep, keep, relative), text);
    }
  const auto ranges = OpenFoamCase::open(folder.path());
  EXPECT_EQ(ranges.ranks(), 2U);
  expect_same(OpenFoamCase::open((data / "whole").string()), ranges, 0);
  fs::remove_all(folder.path("processors2_0-0"));
  EXPECT_NE(error_of([&] {
              OpenFoamCase::open(folder.path());
            }).find("expected processor 0, found processors2_1-1"),
            std::string::npos);
}

TEST(OpenFoamCase, FolderCalledProcessorsCountsItsBlocks) {
  const Folder folder;
  folder.copy(data / "collated/processors2", "processors");
  const auto foam = OpenFoamCase::open(folder.path());
  EXPECT_EQ(foam.ranks(), 2U);
  expect_same(OpenFoamCase::open((data / "whole").string()), foam, 0);
}

TEST(OpenFoamCase, TwoDecompositionsAreAChoiceOfTheUser) {
  const Folder folder;
  folder.copy(data / "separate");
  folder.copy(data / "collated");
  EXPECT_NE(error_of([&] {
              OpenFoamCase::open(folder.path());
            }).find("both processors2 and processor0..1 present: decomposition ="),
            std::string::npos);
  EXPECT_EQ(OpenFoamCase::open(folder.path(), {Decomposition::collated, ""}).ranks(), 2U);
  EXPECT_EQ(OpenFoamCase::open(folder.path(), {Decomposition::separate, ""}).ranks(), 2U);
  folder.copy(data / "whole");  // every time is there reconstructed: nothing to choose
  EXPECT_EQ(OpenFoamCase::open(folder.path()).ranks(), 1U);
}

TEST(OpenFoamCase, TimesThatARankLacksAreLeftOutAndTold) {
  const Folder folder;
  folder.copy(data / "separate");
  folder.copy(data / "separate/processor0/0.003", "processor0/0.004");
  const auto foam = OpenFoamCase::open(folder.path());
  EXPECT_EQ(time_names(foam), (std::vector<std::string>{"0.003"}));
  ASSERT_EQ(foam.problems().size(), 1U);
  EXPECT_NE(foam.problems()[0].find("time 0.004 is in processor0 but not in processor1"),
            std::string::npos);
}

TEST(OpenFoamCase, LastRanksThatAreMissingAreToldByThePatchesOfTheOthers) {
  const Folder folder;
  folder.copy(data / "separate/processor0", "processor0");
  EXPECT_NE(error_of([&] {
              OpenFoamCase::open(folder.path());
            }).find("processor0: borders on processor 1 (patch procBoundary0to1)"),
            std::string::npos);
  // By itself it may be looked at.
  EXPECT_EQ(OpenFoamCase::open(folder.path("processor0")).ranks(), 1U);
}

TEST(OpenFoamCase, ATimeWithoutFieldsIsLeftOutAndTold) {
  const Folder folder;
  folder.copy(data / "ascii");
  fs::create_directories(folder.path("0.002/uniform"));
  const auto foam = OpenFoamCase::open(folder.path());
  EXPECT_EQ(time_names(foam), (std::vector<std::string>{"0.003"}));
  ASSERT_EQ(foam.problems().size(), 1U);
  EXPECT_NE(foam.problems()[0].find("0.002: no fields: left out"), std::string::npos);
}

TEST(OpenFoamCase, TimesAreSortedByValueInAnySpelling) {
  const Folder folder;
  folder.copy(data / "ascii");
  fs::remove_all(folder.path("0.003/uniform"));
  for (const auto* name :
       {"10", "2.000e-03", "1e-05", "0.10", "0.orig", "backup-5", "VTK", "processorX", "1x"})
    folder.copy(data / "ascii/0.003", name);
  EXPECT_EQ(time_names(OpenFoamCase::open(folder.path())),
            (std::vector<std::string>{"1e-05", "2.000e-03", "0.003", "0.10", "10"}));
  folder.copy(data / "ascii/0.003", "0.1");
  EXPECT_NE(error_of([&] { OpenFoamCase::open(folder.path()); }).find("are the same time"),
            std::string::npos);
}

TEST(OpenFoamCase, TrueTimeIsInTheFileWhereTheNameIsRounded) {
  const Folder folder;
  folder.copy(data / "ascii");
  const auto time = [&](double value) {
    folder.write("0.003/uniform/time", header("dictionary") + fmt::format("value {};\n", value));
    return OpenFoamCase::open(folder.path());
  };
  EXPECT_EQ(time(0.0032).times()[0].time, 0.0032);
  const auto copied = time(0.5);
  EXPECT_EQ(copied.times()[0].time, 0.003);
  ASSERT_EQ(copied.problems().size(), 1U);
  EXPECT_NE(copied.problems()[0].find("says 0.5 s"), std::string::npos);
}

TEST(OpenFoamCase, LastTimeThatIsCutIsLeftOutAndTold) {
  const Folder folder;
  folder.copy(data / "ascii");
  folder.copy(data / "ascii/0.003", "0.004");
  const auto whole = bytes_of(data / "ascii/0.003/U.air");
  folder.write("0.004/U.air", whole.substr(0, whole.size() / 2));
  const auto foam = OpenFoamCase::open(folder.path());
  EXPECT_EQ(time_names(foam), (std::vector<std::string>{"0.003"}));
  ASSERT_EQ(foam.problems().size(), 1U);
  EXPECT_TRUE(foam.problems()[0].starts_with("time 0.004 is left out: ")) << foam.problems()[0];
  fs::remove_all(folder.path("0.003"));
  EXPECT_NE(error_of([&] { OpenFoamCase::open(folder.path()); }).find("0.004/U.air: line"),
            std::string::npos);
}

TEST(OpenFoamCase, LastTimeThatEndsInNulBytesIsLeftOutAndTold) {
  const Folder folder;
  folder.copy(data / "ascii");
  folder.copy(data / "ascii/0.003", "0.004");
  folder.write("0.004/U.air", bytes_of(data / "ascii/0.003/U.air") + std::string(300, '\0'));
  const auto foam = OpenFoamCase::open(folder.path());
  EXPECT_EQ(time_names(foam), (std::vector<std::string>{"0.003"}));
  ASSERT_EQ(foam.problems().size(), 1U);
  EXPECT_NE(foam.problems()[0].find("time 0.004 is left out: "), std::string::npos);
  EXPECT_NE(foam.problems()[0].find("U.air: ends in NUL bytes"), std::string::npos);
}

TEST(OpenFoamCase, CellsWithoutVolumeAreTold) {
  const Folder folder;
  folder.copy(data / "ascii");
  std::string points = header("vectorField") + "462\n(\n";
  for (int p = 0; p < 462; ++p) points += "(1 2 3)\n";
  folder.write("constant/polyMesh/points", points + ")\n");
  const auto foam = OpenFoamCase::open(folder.path());
  ASSERT_EQ(foam.problems().size(), 1U);
  EXPECT_NE(foam.problems()[0].find("constant/polyMesh: 200 of 200 cells have no volume, or one "
                                    "below zero; first: cell 0, 0 m3"),
            std::string::npos)
      << foam.problems()[0];
}

TEST(OpenFoamCase, FieldThatComesAndGoesIsTold) {
  const Folder folder;
  folder.copy(data / "ascii");
  for (const auto* name : {"0", "0.004", "0.005"}) folder.copy(data / "ascii/0.003", name);
  fs::remove(folder.path("0.004/p"));
  fs::remove(folder.path("0/U.airPrime2Mean"));  // means come later: not a problem
  const auto foam = OpenFoamCase::open(folder.path());
  ASSERT_EQ(foam.problems().size(), 1U);
  EXPECT_NE(foam.problems()[0].find("field p is missing at 1 of 4 times, first at 0.004"),
            std::string::npos);
  EXPECT_NE(error_of([&] { read(foam, "p", 2); }).find("no field p at time 0.004, found U.air"),
            std::string::npos);
}

TEST(OpenFoamCase, PlainFileWinsOverGzAndItIsTold) {
  const Folder folder;
  folder.copy(data / "ascii");
  folder.write("0.003/p.gz", "not even gzip");
  const auto foam = OpenFoamCase::open(folder.path());
  ASSERT_EQ(foam.problems().size(), 1U);
  EXPECT_NE(foam.problems()[0].find("0.003/p and p.gz both present: the plain one is read"),
            std::string::npos);
  EXPECT_EQ(read(foam, "p", 0).values.size(), 200U);
}

TEST(OpenFoamCase, RegionsHaveTheirOwnMeshAndFields) {
  const Folder folder;
  folder.copy(data / "ascii/constant/polyMesh", "constant/gas/polyMesh");
  folder.copy(data / "ascii/0.003", "0.003/gas");
  EXPECT_NE(error_of([&] { OpenFoamCase::open(folder.path()); }).find("name one of gas"),
            std::string::npos);
  const auto foam = OpenFoamCase::open(folder.path(), {Decomposition::automatic, "gas"});
  EXPECT_EQ(foam.regions(), std::vector<std::string>{"gas"});
  EXPECT_EQ(read(foam, "U.air", 0).values.size(), 600U);
  EXPECT_NE(error_of([&] {
              OpenFoamCase::open(folder.path(), {Decomposition::automatic, "air"});
            }).find("expected a region of the case (gas), found air"),
            std::string::npos);
}

TEST(OpenFoamCase, RegionsOfRanksAreThoseThatTheRanksHave) {
  const Folder folder;
  folder.copy(data / "ascii/constant/polyMesh", "constant/polyMesh");  // before splitMeshRegions
  for (const auto* rank : {"processor0", "processor1"})
    for (const auto* region : {"gas", "wall"}) {
      folder.copy(data / "separate" / rank / "constant/polyMesh",
                  fmt::format("{}/constant/{}/polyMesh", rank, region));
      folder.copy(data / "separate" / rank / "0.003", fmt::format("{}/0.003/{}", rank, region));
    }
  EXPECT_EQ(openfoam_regions(folder.path()), (std::vector<std::string>{"gas", "wall"}));
  folder.copy(data / "ascii/0.003", "0.003");  // reconstructed: there the default one is read
  EXPECT_EQ(openfoam_regions(folder.path()), std::vector<std::string>{""});
}

TEST(OpenFoamCase, AddressesMustNameEveryCellOnce) {
  const Folder folder;
  folder.copy(data / "separate");
  const auto zero = bytes_of(data / "separate/processor0/constant/polyMesh/cellProcAddressing");
  folder.write("processor1/constant/polyMesh/cellProcAddressing", zero);
  EXPECT_NE(error_of([&] { OpenFoamCase::open(folder.path()); }).find("a second time"),
            std::string::npos);
  fs::remove(folder.path("processor1/constant/polyMesh/cellProcAddressing"));
  EXPECT_NE(error_of([&] {
              OpenFoamCase::open(folder.path());
            }).find("expected cellProcAddressing of 2 processors, found 1"),
            std::string::npos);
  fs::remove(folder.path("processor0/constant/polyMesh/cellProcAddressing"));
  EXPECT_EQ(OpenFoamCase::open(folder.path()).mesh().cells(), 200U);  // rank after rank
}

TEST(OpenFoamCase, MeshMovesWhereTimesHavePoints) {
  const Folder folder;
  folder.copy(data / "ascii");
  folder.copy(data / "ascii/0.003", "0.004");
  auto points = bytes_of(data / "ascii/constant/polyMesh/points");
  for (std::size_t at = 0; (at = points.find("-0.0075", at)) != std::string::npos;)
    points.replace(at, 7, "-0.0175");  // the bed grows in depth, 15 mm to 25 mm
  folder.write("0.004/polyMesh/points", points);
  const auto foam = OpenFoamCase::open(folder.path());
  EXPECT_TRUE(foam.moving());
  EXPECT_EQ(foam.mesh_at(0)->volume(), foam.mesh().volume());
  EXPECT_NEAR(foam.mesh_at(1)->volume(), foam.mesh().volume() * 25 / 15, 1e-15);  // rounding
  EXPECT_EQ(read(foam, "p", 1).values.size(), 200U);
}

// A mesh that was refined at 0.004, by 100 cells and in one rank only. No cellProcAddressing is
// written then, and that of constant/ is of the mesh before.
class RefinedInRanks : public ::testing::Test {
 protected:
  RefinedInRanks() {
    for (const auto* rank : {"processor0", "processor1"}) {
      folder.copy(data / "separate" / rank, fmt::format("separate/{}", rank));
      const auto from =
          rank == std::string_view("processor0") ? data / "whole" : data / "separate" / rank;
      folder.copy(from / "0.003", fmt::format("separate/{}/0.004", rank));
      for (const auto* name : {"points", "faces", "owner", "neighbour", "boundary"})
        folder.write(fmt::format("separate/{}/0.004/polyMesh/{}", rank, name),
                     bytes_of(from / "constant/polyMesh" / name));
    }
  }
  static void expect_refined(const OpenFoamCase& foam) {
    EXPECT_EQ(foam.mesh_at(0)->cells(), 200U);
    EXPECT_EQ(foam.mesh_at(1)->cells(), 300U);
    const auto whole = OpenFoamCase::open((data / "whole").string());
    auto expected = read(whole, "p", 0).values;
    EXPECT_EQ(read(foam, "p", 0).values, expected);
    const auto* const path = "processor1/0.003/p";
    FoamBlocks file((data / "separate" / path).string());
    FieldValues of_rank;
    ASSERT_TRUE(file.next());
    read_field(file, FoamCount{100}, of_rank);
    expected.insert(expected.end(), of_rank.values.begin(), of_rank.values.end());
    EXPECT_EQ(read(foam, "p", 1).values, expected);  // rank after rank
  }
  Folder folder;
};

TEST_F(RefinedInRanks, HasNoAddressesAnyMore) {
  expect_refined(OpenFoamCase::open(folder.path("separate")));
}

TEST_F(RefinedInRanks, CollatedBlocksHaveEachTheirNumberOfCells) {
  // The header, with the number of cells of rank 0 in its note, stands in the first block only.
  const auto body = [](const std::string& file) {
    const auto begin = file.find("FoamFile");
    return begin == std::string::npos ? file : file.substr(file.find('}', begin) + 1);
  };
  const fs::path root = folder.path("separate/processor0");
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file()) continue;
    const auto name = fs::relative(entry.path(), root).string();
    const auto first = bytes_of(entry.path());
    const auto second = body(bytes_of(folder.path("separate/processor1/" + name)));
    folder.write("collated/processors2/" + name,
                 header("decomposedBlockData", "binary") +
                     fmt::format("\n// Processor0\n\n{}\n({})\n\n// Processor1\n\n{}\n({})\n",
                                 first.size(), first, second.size(), second));
  }
  for (const auto* time : {"0.003", "0.004"})
    fs::remove_all(folder.path(fmt::format("collated/processors2/{}/uniform", time)));
  expect_refined(OpenFoamCase::open(folder.path("collated")));
}

TEST(OpenFoamCase, ThreadsMayReadAtTheSameTime) {
  const auto foam = OpenFoamCase::open((data / "separate").string());
  const auto expected = read(foam, "U.air", 0).values;
  std::vector<std::vector<double>> values(4);
  std::vector<std::thread> threads;
  for (auto& into : values) threads.emplace_back([&] { into = read(foam, "U.air", 0).values; });
  for (auto& thread : threads) thread.join();
  for (const auto& one : values) EXPECT_EQ(one, expected);
}

TEST(OpenFoamCase, DamagedMeshGivesAnErrorOrAMesh) {
  const Folder folder;
  folder.copy(data / "collated");
  std::mt19937 random(3);
  for (const auto* name :
       {"points", "faces", "owner", "neighbour", "boundary", "cellProcAddressing"}) {
    const auto file = fmt::format("processors2/constant/polyMesh/{}", name);
    const auto whole = bytes_of(data / "collated" / file);
    for (std::size_t size = 0; size < whole.size(); size += 53 * 5) {  // 5: each opens all files
      folder.write(file, whole.substr(0, size));
      error_of([&] { OpenFoamCase::open(folder.path()); });
    }
    for (int k = 0; k < 60; ++k) {
      auto damaged = whole;
      for (int flips = 0; flips < 3; ++flips)
        damaged[random() % damaged.size()] = static_cast<char>(random());
      folder.write(file, damaged);
      error_of([&] { OpenFoamCase::open(folder.path()); });
    }
    folder.write(file, whole);
  }
}

class OpenFoamCorpus : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!corpus_there()) GTEST_SKIP() << "no corpus beside the project";
  }
  static OpenFoamCase open(const std::string& name) {
    return OpenFoamCase::open((made / name).string());
  }
};

TEST_F(OpenFoamCorpus, ContainersOfOneRunHoldTheSameNumbers) {
  const auto ascii = open("openfoam/of_ascii"), binary = open("openfoam/of_binary");
  EXPECT_EQ(time_names(ascii), (std::vector<std::string>{"0", "0.001", "0.002", "0.003"}));
  expect_same(ascii, open("openfoam/of_gz"), 0);
  expect_same(binary, open("openfoam/of_bingz"), 0);
  // Six digits, and the means of nearly equal numbers lose more; velocities are 0 to 2 m/s.
  expect_same(binary, ascii, 2e-5);
}

TEST_F(OpenFoamCorpus, DecomposedRunsHoldTheNumbersOfTheReconstructedOne) {
  const auto separate = open("openfoam/of_dec_binary");
  expect_same(open("openfoam/of_reconstructed"), separate, 0);
  expect_same(separate, open("openfoam/of_coll_binary"), 0);
  expect_same(open("openfoam/of_dec_ascii"), open("openfoam/of_coll_ascii"), 0);
  expect_same(separate, open("openfoam/of_dec_ascii"), 2e-5);  // six digits
}

TEST_F(OpenFoamCorpus, EveryArchitectureHoldsTheSameNumbers) {
  const auto usual = open("openfoam_synth/nobanner_noarch");
  for (const auto* name :
       {"l64_s64", "msb_l32_s64", "esi_v2312_header", "foundation_v8", "v2x_positions40"})
    expect_same(usual, open(fmt::format("openfoam_synth/{}", name)), 0);
  for (const auto* name : {"l32_s32", "l64_s32"})  // 24 bits
    expect_same(usual, open(fmt::format("openfoam_synth/{}", name)), 1e-6);
}

TEST_F(OpenFoamCorpus, CfdemCasePrefersTheReconstructedTimes) {
  const auto whole = open("cfdem/CFD");
  EXPECT_EQ(whole.ranks(), 1U);
  EXPECT_EQ(time_names(whole), (std::vector<std::string>{"0", "0.05", "0.1", "0.15"}));
  const auto ranks =
      OpenFoamCase::open((made / "cfdem/CFD").string(), {Decomposition::processors, ""});
  EXPECT_GT(ranks.ranks(), 1U);
  const auto last = whole.times().size() - 1;
  EXPECT_EQ(read(whole, "voidfraction", last).values,
            read(ranks, "voidfraction", ranks.times().size() - 1).values);
}

TEST_F(OpenFoamCorpus, CentresAreThoseThatOpenFoamWrote) {
  const auto found = shared / "corpus/found/fluiddyn__fluidfoam/output_samples";
  for (const auto& [name, time] : {std::pair{"bin/par1", 0U}, {"bin/par2", 0U}, {"box", 3U}}) {
    const auto foam = OpenFoamCase::open((found / name).string());
    const auto centres = read(foam, "C", time);
    const auto mesh = foam.mesh_at(time);
    const double tolerance = std::string_view(name) == "box" ? 1e-5 : 1e-15;  // ascii, binary
    for (std::size_t c = 0; c < mesh->cells(); ++c)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(mesh->centres[c][k], centres.values[3 * c + k], tolerance) << name;
  }
}

// The rows of EXPECT.csv that concern mesh, fields and cases: what must be said, and where.
TEST_F(OpenFoamCorpus, BrokenCasesGetThePrescribedAnswer) {
  const std::map<std::string, std::string> errors{
      {"field_truncated", "0.003/alpha.air: line 23: 200 values"},
      {"field_count_vs_mesh", "alpha.air: line 23: list declares 199 values, mesh has 200 cells"},
      {"field_count_huge", "list declares 1099511627776 values"},
      {"field_count_negative", "negative list length"},
      {"field_unbalanced", "expected \"{\" after boundaryField"},
      {"wrong_type", "class volScalarField but List<vector>"},
      {"include_self", "0.003/p: line 18: #include of itself"},
      {"owner_out_of_range", "owner: face 2 names cell 99999; note says nCells:200"},
      {"owner_negative", "owner: face 2: negative cell"},
      {"faces_bad_point", "faces: face 0 names point 250000 of 462"},
      {"faces_count_mismatch", "owner has 829 entries, faces 830"},
      {"points_missing", "constant/polyMesh/points: is empty"},
      {"bin_truncated", "U.air: line 24: 4800 bytes of List<vector> declared"},
      {"bin_format_says_ascii", "not a number at offset"},
      {"collated_block_size", "alpha.air: block 0: expected \")\" after 1900 bytes"},
      {"collated_and_processor", "both processors2 and processor0..1 present"}};
  const std::map<std::string, std::string> warnings{
      {"field_no_header", "no FoamFile header"},
      {"plain_and_gz", "both present: the plain one is read"},
      {"last_time_partial", "time 0.003 is left out"},
      {"decomposed_time_differs", "time 0.003 is in processor0 but not in processor1"}};
  const auto all_fields = [](const std::string& name) {
    const auto foam = OpenFoamCase::open((shared / "bad/of" / name).string());
    FieldValues field;
    for (std::size_t t = 0; t < foam.times().size(); ++t)
      for (const auto& one : foam.fields_at(t)) foam.read(t, one, field);
    return foam;
  };
  for (const auto& [name, text] : errors) {
    const auto error = error_of([&, &name = name] { all_fields(name); });
    EXPECT_NE(error.find(text), std::string::npos) << name << ": " << error;
  }
  for (const auto& [name, text] : warnings) {
    const auto foam = all_fields(name);
    ASSERT_EQ(foam.problems().size(), 1U) << name;
    EXPECT_NE(foam.problems()[0].find(text), std::string::npos) << foam.problems()[0];
  }
  EXPECT_TRUE(all_fields("bin_paren_inside_ok").problems().empty());
  const auto with_nan = OpenFoamCase::open((shared / "bad/of/field_nan").string());
  EXPECT_EQ(read(with_nan, "alpha.air", 0).non_finite.values, 1U);
  EXPECT_EQ(read(with_nan, "alpha.air", 0).non_finite.first, 0U);
}

}  // namespace
}  // namespace bedscope::readers
