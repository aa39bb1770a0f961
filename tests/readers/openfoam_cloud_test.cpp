// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_cloud.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "openfoam_samples.hpp"
#include "readers/openfoam_case.hpp"
#include "readers/openfoam_list.hpp"
#include "readers/openfoam_tets.hpp"

namespace bedscope::readers {
namespace {

using namespace samples;

const Request all{{"x", true}, {"y", true}, {"z", true}, {"radius", true}, {"vz", true}};

// The unit cube and the tetrahedron of its centre, face 4 (x = 0: points 0 4 7 3) and corner 1.
CloudMesh cube() {
  CloudMesh mesh;
  mesh.poly.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                      {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  mesh.poly.face_points = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 2, 3, 7, 6, 0, 4, 7, 3, 1, 2, 6, 5};
  mesh.poly.face_starts = {0, 4, 8, 12, 16, 20, 24};
  mesh.poly.owner.assign(6, 0);
  mesh.poly.cells = 1;
  mesh.centres = {{0.5, 0.5, 0.5}};
  return mesh;
}

CloudPoints points_of(const std::string& text, std::string_view format = "ascii",
                      std::string_view arch = "") {
  const Folder folder;
  FoamBlocks file(folder.write("positions", header("Cloud<parcel>", format, arch) + text));
  EXPECT_TRUE(file.next());
  CloudPoints points;
  const auto mesh = cube();
  read_cloud_points(
      file, [&]() -> const CloudMesh& { return mesh; }, points);
  return points;
}

TEST(OpenFoamCloud, BarycentricCoordinatesAreWeightsOfTheTetrahedron) {
  // 0.4 (.5 .5 .5) + 0.3 (0 0 0) + 0.2 (0 0 1) + 0.1 (0 1 1)
  const auto points = points_of("1\n(\n(0.4 0.3 0.2 0.1) 0 4 1\n)\n");
  ASSERT_EQ(points.at.size(), 1U);
  EXPECT_DOUBLE_EQ(points.at[0][0], 0.2);
  EXPECT_DOUBLE_EQ(points.at[0][1], 0.3);
  EXPECT_DOUBLE_EQ(points.at[0][2], 0.5);
  EXPECT_EQ(points.off_sum, 0U);
}

TEST(OpenFoamCloud, SumOtherThanOneIsCounted) {
  const auto points = points_of("2((0.4 0.3 0.2 0.1) 0 4 1 (1 0.5 0.2 0.1) 0 4 1)");
  EXPECT_EQ(points.off_sum, 1U);
  EXPECT_EQ(points.first_off, 1U);
  EXPECT_DOUBLE_EQ(points.first_sum, 1.8);
}

TEST(OpenFoamCloud, CartesianPositionsAreTakenAsTheyAre) {
  const auto points = points_of("2\n(\n( 1 2 3 ) 0 \n(4 5 6) 0\n)\n");
  ASSERT_EQ(points.at.size(), 2U);
  EXPECT_EQ(points.at[1], (Point{4, 5, 6}));
  EXPECT_TRUE(points_of("0\n(\n)\n").at.empty());
}

TEST(OpenFoamCloud, LengthOfABinaryRecordTellsItsForm) {
  const auto record = [](std::initializer_list<double> numbers, std::size_t labels, bool fraction) {
    std::string bytes = "(";
    for (const double x : numbers) bytes.append(reinterpret_cast<const char*>(&x), 8);
    bytes.append(labels * 4, '\0');
    if (labels == 3) bytes[bytes.size() - 4] = 1;  // tetPt
    if (fraction) bytes.append(8, '\0');
    return bytes + ")\n";
  };
  for (const auto& one : {record({1, 2, 3}, 1, false), record({1, 2, 3}, 2, true)}) {
    const auto points = points_of("2\n(\n" + one + one + ")\n", "binary");
    ASSERT_EQ(points.at.size(), 2U);
    EXPECT_EQ(points.at[1], (Point{1, 2, 3}));
  }
  const auto inside = points_of("1\n(\n" + record({1, 0, 0, 0}, 3, false) + ")\n", "binary");
  EXPECT_EQ(inside.at.at(0), (Point{0.5, 0.5, 0.5}));
  EXPECT_NE(error_of([&] {
              points_of("1\n(\n" + record({1, 0, 0, 0}, 3, false) + ")\n", "binary",
                        "arch \"LSB;label=64;scalar=64\";");
            }),
            "");
}

TEST(OpenFoamCloud, LabelsOutsideTheMeshAreErrors) {
  for (const auto* labels : {"1 4 1", "-1 4 1", "0 6 1", "0 -4 1"})
    EXPECT_NE(error_of([&] {
                points_of(fmt::format("1((1 0 0 0) {})", labels));
              }).find("expected a cell"),
              std::string::npos)
        << labels;
  for (const auto* labels : {"0 4 -1", "0 4 0", "0 4 3", "0 4 99"})
    EXPECT_NE(error_of([&] {
                points_of(fmt::format("1((1 0 0 0) {})", labels));
              }).find("face 4 of 4 points has no triangle "),
              std::string::npos)
        << labels;
  for (const auto* text : {"1099511627776((1 2 3) 0)", "-1()", "2((1 2 3) 0)", "1((1 2) 0)",
                           "1((1 2 3 4 5) 0)", "1((1 2 3) )"})
    EXPECT_NE(error_of([&] { points_of(text); }), "") << text;
}

TEST(OpenFoamCloud, CellMustBeBoundedByTheFace) {
  auto mesh = cube();
  mesh.poly.cells = 2;
  mesh.centres.push_back({1.5, 0.5, 0.5});
  const Folder folder;
  FoamBlocks file(folder.write("positions", header("Cloud<parcel>") + "1((1 0 0 0) 1 4 1)"));
  ASSERT_TRUE(file.next());
  CloudPoints points;
  const auto error = error_of([&] {
    read_cloud_points(
        file, [&]() -> const CloudMesh& { return mesh; }, points);
  });
  EXPECT_NE(error.find("parcel 0: cell 1 is not bounded by face 4"), std::string::npos) << error;
}

TEST(OpenFoamCloud, TrianglesOfAFaceBeginAtItsBase) {
  // 0.4 (.5 .5 .5) + 0.3 (0 0 1) + 0.2 (0 1 1) + 0.1 (0 1 0): face 4 from its point 1 on
  const Folder folder;
  FoamBlocks file(folder.write("positions", header("Cloud<parcel>") + "1((.4 .3 .2 .1) 0 4 1)"));
  ASSERT_TRUE(file.next());
  auto mesh = cube();
  mesh.base = {0, 0, 0, 0, 1, 0};
  CloudPoints points;
  read_cloud_points(
      file, [&]() -> const CloudMesh& { return mesh; }, points);
  EXPECT_NEAR(points.at.at(0)[0], 0.2, 1e-15);
  EXPECT_NEAR(points.at.at(0)[1], 0.5, 1e-15);
  EXPECT_NEAR(points.at.at(0)[2], 0.7, 1e-15);
}

TEST(OpenFoamTets, BaseOfAFaceThatIsNotConvexIsTheFirstPointThatSeesAllOfIt) {
  auto mesh = cube();
  EXPECT_EQ(tet_base_points(mesh.poly, mesh.centres, nullptr), std::vector<std::int32_t>(6));
  // The top (z = 1) as the points (1 0), (1 1), (0 1), (.8 .8): from the first of them the triangle
  // to the last lies outside. The sides at the point that moved stay good.
  mesh.poly.points[4] = {0.8, 0.8, 1};
  const std::vector<std::int32_t> top{5, 6, 7, 4};
  std::copy(top.begin(), top.end(), mesh.poly.face_points.begin() + 4);
  EXPECT_EQ(tet_base_points(mesh.poly, mesh.centres, nullptr)[1], 1);
  // Turned over and seen from a neighbour above it, the same.
  mesh.poly.cells = 2;
  mesh.centres.push_back({0.5, 0.5, 1.5});
  mesh.poly.neighbour = {1, 1};
  EXPECT_EQ(tet_base_points(mesh.poly, mesh.centres, nullptr)[1], 1);
}

TEST(OpenFoamTets, FileOfTheMeshWins) {
  const Folder folder;
  const auto mesh = cube();
  const auto read = [&](const char* list) {
    FoamBlocks file(folder.write("tetBasePtIs", header("labelList") + list));
    EXPECT_TRUE(file.next());
    return tet_base_points(mesh.poly, mesh.centres, &file);
  };
  EXPECT_EQ(read("6(0 1 -1 2 0 3)"), (std::vector<std::int32_t>{0, 1, 0, 2, 0, 3}));
  EXPECT_NE(error_of([&] { read("6(0 1 -1 2 4 3)"); }).find("face 4 has 4 points, found 4"),
            std::string::npos);
  EXPECT_NE(error_of([&] { read("5(0 1 -1 2 3)"); }).find("list declares 5 values"),
            std::string::npos);
}

// OpenFOAM wrote both; its cell centres are in the one and not in the other, so that this judges
// our centres of warped and polyhedral cells too.
TEST(OpenFoamCloud, CoordinatesGiveThePositionsThatOpenFoamWrote) {
  if (!corpus_there()) GTEST_SKIP() << "no corpus beside the project";
  for (const auto* name : {"of_ascii", "of_binary", "of_warped", "of_poly"}) {
    const auto root = shared / "corpus/made/openfoam" / name;
    const auto foam = OpenFoamCase::open(root.string());
    for (std::size_t t = 0; t < foam.times().size(); ++t)
      for (const auto& cloud : foam.clouds_at(t)) {
        Snapshot snapshot;
        EXPECT_TRUE(foam.read_cloud(t, cloud, all, snapshot).empty());
        FoamBlocks file(
            (root / foam.times()[t].name / "lagrangian" / cloud / "positions").string());
        ASSERT_TRUE(file.next());
        CloudPoints points;
        read_cloud_points(
            file, [&]() -> const CloudMesh& { throw InputError("cartesian"); }, points);
        ASSERT_EQ(points.at.size(), snapshot.particles);
        // 12 digits where the run wrote 12, else 6, of 0.15 m.
        const double tolerance =
            std::string_view(name) == "of_binary"                                          ? 1e-15
            : std::string_view(name) == "of_warped" || std::string_view(name) == "of_poly" ? 1e-12
                                                                                           : 2e-7;
        for (std::size_t p = 0; p < points.at.size(); ++p)
          for (std::size_t a = 0; a < 3; ++a)
            ASSERT_NEAR(snapshot.columns[a][p], points.at[p][a], tolerance) << name << " " << p;
      }
  }
}

TEST(OpenFoamCloud, RanksTogetherHoldTheParcelsOfTheWholeCase) {
  if (!corpus_there()) GTEST_SKIP() << "no corpus beside the project";
  const auto made = shared / "corpus/made/openfoam";
  // In another order: sorted by height, the same to the rounding of the cell centres.
  const auto sorted_heights = [&](const std::string& name) {
    const auto foam = OpenFoamCase::open((made / name).string());
    Snapshot snapshot;
    foam.read_cloud(foam.times().size() - 1, "kinematicCloud", all, snapshot);
    std::sort(snapshot.columns[2].begin(), snapshot.columns[2].end());
    return snapshot.columns[2];
  };
  const auto whole = sorted_heights("of_reconstructed");
  EXPECT_EQ(whole.size(), 300U);
  for (const auto* name : {"of_dec_binary", "of_coll_binary"}) {
    const auto ranks = sorted_heights(name);
    ASSERT_EQ(ranks.size(), whole.size());
    for (std::size_t p = 0; p < whole.size(); ++p) EXPECT_NEAR(ranks[p], whole[p], 1e-15);
  }
}

TEST(OpenFoamCloud, AFieldOfOtherComponentsOnAnotherRankIsAnError) {
  if (!corpus_there()) GTEST_SKIP() << "no corpus beside the project";
  const Folder folder;
  fs::copy(shared / "corpus/made/openfoam/of_dec_binary", folder.path(),
           fs::copy_options::recursive);
  const auto foam = OpenFoamCase::open(folder.path());
  const auto last = foam.times().size() - 1;
  const auto cloud = "/" + foam.times()[last].name + "/lagrangian/kinematicCloud/d";
  const auto path = folder.path("processor0" + cloud);
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line) &&
         (line.empty() || line.find_first_not_of("0123456789") != line.npos))
    ;
  ASSERT_FALSE(line.empty());
  std::ofstream(path) << header("vectorField") << line << "{(0 0 1)}\n";
  const auto error = error_of([&] {
    Snapshot snapshot;
    foam.read_cloud(last, "kinematicCloud", {{"d[3]", true}}, snapshot);
  });
  EXPECT_NE(error.find("expected a vector a parcel, as other processors have"), std::string::npos)
      << error;
}

TEST(OpenFoamCloud, CfdemRadiusIsARadiusAndDiameterIsHalved) {
  if (!corpus_there()) GTEST_SKIP() << "no corpus beside the project";
  const auto cfdem = OpenFoamCase::open((shared / "corpus/made/cfdem/CFD").string());
  Snapshot snapshot;
  cfdem.read_cloud(3, "particleCloud", all, snapshot);
  EXPECT_EQ(snapshot.particles, 647U);
  EXPECT_EQ(snapshot.columns[3][0], 0.0014);
  const auto foam = OpenFoamCase::open((shared / "corpus/made/openfoam/of_ascii").string());
  foam.read_cloud(1, "kinematicCloud", {{"radius", true}, {"d", true}, {"diameter", true}},
                  snapshot);
  EXPECT_EQ(snapshot.columns[0][7] * 2, snapshot.columns[1][7]);
  EXPECT_EQ(snapshot.columns[1], snapshot.columns[2]);
}

TEST(OpenFoamCloud, BrokenCloudsGetThePrescribedAnswer) {
  if (!corpus_there()) GTEST_SKIP() << "no corpus beside the project";
  const auto read = [&](const std::string& name) {
    Snapshot snapshot;
    return OpenFoamCase::open((shared / "bad/of" / name).string())
        .read_cloud(0, "kinematicCloud", all, snapshot);
  };
  for (const auto& [name, text] :
       {std::pair{"cloud_d_count",
                  "d: line 20: list declares 299 values, positions has 300 entries"},
        {"cloud_d_negative", "d: parcel 0 has diameter -0.0025499"},
        {"cloud_uniform_unclosed", "expected \"}\""},
        {"cloud_uniform_huge", "list declares 1099511627776 values, positions has 300 entries"},
        {"bin_arch_lies",
         "record 0: expected \")\" after 56 bytes (arch says LSB;label=64;scalar=64)"}}) {
    const auto error = error_of([&, &name = name] { read(name); });
    EXPECT_NE(error.find(text), std::string::npos) << name << ": " << error;
  }
  const auto problems = read("cloud_bary_sum");
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(problems[0].find("parcel 0: 1.77"), std::string::npos) << problems[0];
}

TEST(OpenFoamCloud, DamagedBytesGiveAnErrorOrPoints) {
  std::string text =
      "3\n(\n(0.4 0.3 0.2 0.1) 0 4 1\n(0.4 0.3 0.2 0.1) 0 4 1\n(0.4 0.3 0.2 0.1) 0 4 1\n)\n";
  std::mt19937 random(5);
  for (int k = 0; k < 500; ++k) {
    auto damaged = text;
    for (int flips = 0; flips < 2; ++flips)
      damaged[random() % damaged.size()] = static_cast<char>(random());
    error_of([&] { points_of(damaged, k % 2 == 0 ? "ascii" : "binary"); });
  }
  for (std::size_t size = 0; size + 3 < text.size(); ++size)
    EXPECT_NE(error_of([&] { points_of(text.substr(0, size)); }), "") << size;
}

}  // namespace
}  // namespace bedscope::readers
