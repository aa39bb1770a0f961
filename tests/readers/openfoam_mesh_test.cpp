// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "openfoam_samples.hpp"

namespace bedscope::readers {
namespace {

using namespace samples;

// The box 0..a x 0..b x 0..c, points in OpenFOAM's order of a hexahedron, moved by `move`.
template <class Move>
PolyMesh hexahedron(double a, double b, double c, Move&& move) {
  PolyMesh mesh;
  for (const double z : {0.0, c})
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {a, 0.0}, {a, b}, {0.0, b}})
      mesh.points.push_back(move(Point{x, y, z}));
  mesh.face_points = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 2, 3, 7, 6, 0, 4, 7, 3, 1, 2, 6, 5};
  mesh.face_starts = {0, 4, 8, 12, 16, 20, 24};
  mesh.owner.assign(6, 0);
  mesh.cells = 1;
  return mesh;
}

void expect_near(const Point& a, const Point& b, double tolerance) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], tolerance);
}

TEST(OpenFoamMesh, BoxHasItsCentreAndVolume) {
  const auto cells = cell_geometry(hexahedron(2, 3, 4, [](const Point& p) { return p; }));
  EXPECT_NEAR(cells.volumes[0], 24, 24e-15);          // rounding
  expect_near(cells.centres[0], {1, 1.5, 2}, 1e-15);  // rounding
  EXPECT_TRUE(make_mesh(cells).boxes.has_value());
}

TEST(OpenFoamMesh, ShearKeepsTheVolumeAndMovesTheCentreWithTheMiddle) {
  const auto cells = cell_geometry(hexahedron(2, 3, 4, [](const Point& p) {
    return Point{p[0] + 0.5 * p[2], p[1] - 0.25 * p[2], p[2]};
  }));
  EXPECT_NEAR(cells.volumes[0], 24, 24e-14);        // rounding
  expect_near(cells.centres[0], {2, 1, 2}, 1e-14);  // rounding
  EXPECT_FALSE(make_mesh(cells).boxes.has_value());
}

TEST(OpenFoamMesh, PyramidHasAThirdOfTheBoxAndItsCentreAtAQuarter) {
  PolyMesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 3}};
  mesh.face_points = {0, 3, 2, 1, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
  mesh.face_starts = {0, 4, 7, 10, 13, 16};
  mesh.owner.assign(5, 0);
  mesh.cells = 1;
  const auto cells = cell_geometry(mesh);
  EXPECT_NEAR(cells.volumes[0], 4, 4e-15);             // rounding
  expect_near(cells.centres[0], {1, 1, 0.75}, 1e-15);  // rounding
}

// A frustum: area (1 - z/2)^2 from z = 0 to 1; V = 7/12, centre at (11/28) / (7/12) ... by
// integration of z (1 - z/2)^2: 1/2 - 1/3 + 1/16 = 11/48, over V gives 11/28.
TEST(OpenFoamMesh, FrustumIsCutIntoPyramidsExactly) {
  const auto cells = cell_geometry(hexahedron(1, 1, 1, [](const Point& p) {
    const double s = 1 - p[2] / 2;
    return Point{0.5 + (p[0] - 0.5) * s, 0.5 + (p[1] - 0.5) * s, p[2]};
  }));
  EXPECT_NEAR(cells.volumes[0], 7.0 / 12, 1e-15);               // rounding
  expect_near(cells.centres[0], {0.5, 0.5, 11.0 / 28}, 1e-15);  // rounding
}

OpenMeshFile from(const fs::path& folder) {
  return [folder](std::string_view name) -> std::unique_ptr<FoamBlocks> {
    const auto path = folder / name;
    if (!fs::exists(path)) return nullptr;
    auto file = std::make_unique<FoamBlocks>(path.string());
    EXPECT_TRUE(file->next());
    return file;
  };
}

TEST(OpenFoamMesh, GridOfBoxesIsRecognisedWithItsPlanes) {
  const auto poly = read_poly_mesh(from(data / "ascii/constant/polyMesh"));
  EXPECT_EQ(poly.cells, 200U);
  EXPECT_EQ(poly.faces(), 830U);
  ASSERT_EQ(poly.patches.size(), 4U);
  EXPECT_EQ(poly.patches[0].name, "top");
  const auto mesh = make_mesh(cell_geometry(poly));
  ASSERT_TRUE(mesh.boxes.has_value());
  EXPECT_TRUE(mesh.boxes->rectilinear);
  EXPECT_EQ(mesh.boxes->faces[0].size(), 2U);
  EXPECT_EQ(mesh.boxes->faces[1].size(), 11U);
  EXPECT_EQ(mesh.boxes->faces[2].size(), 21U);
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    double volume = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto& planes = mesh.boxes->faces[a];
      const double low = planes[static_cast<std::size_t>(mesh.boxes->low[c][a])];
      const double high = planes[static_cast<std::size_t>(mesh.boxes->high[c][a])];
      EXPECT_NEAR(mesh.centres[c][a], (low + high) / 2, 1e-9);  // the planes have six digits
      volume *= high - low;
    }
    EXPECT_NEAR(mesh.volumes[c], volume, 1e-5 * volume);  // likewise
  }
}

TEST(OpenFoamMesh, BoxesMayBeRefinedInPlaces) {
  // Two cells below, one of double width above: three boxes on shared planes.
  CellGeometry cells;
  cells.low = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  cells.high = {{1, 1, 1}, {2, 1, 1}, {2, 1, 3}};
  cells.volumes = {1, 1, 4};
  cells.centres.resize(3);
  const auto mesh = make_mesh(cells);
  ASSERT_TRUE(mesh.boxes.has_value());
  EXPECT_FALSE(mesh.boxes->rectilinear);
  EXPECT_EQ(mesh.boxes->faces[0], (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(mesh.boxes->low[2], (std::array<std::int32_t, 3>{0, 0, 1}));
  EXPECT_EQ(mesh.boxes->high[2], (std::array<std::int32_t, 3>{2, 1, 2}));
}

// The volumes of all cells are the volume inside the boundary, whatever the faces between: for a
// warped mesh and a polyhedral one with plane walls this is the box.
TEST(OpenFoamMesh, CellsOfWarpedAndPolyhedralMeshesFillTheBed) {
  if (!corpus_there()) GTEST_SKIP() << "no corpus beside the project";
  for (const auto* name : {"of_warped", "of_poly", "of_ascii", "of_binary"}) {
    const auto mesh = make_mesh(cell_geometry(
        read_poly_mesh(from(shared / "corpus/made/openfoam" / name / "constant/polyMesh"))));
    double box = 1;
    for (std::size_t a = 0; a < 3; ++a) box *= mesh.max[a] - mesh.min[a];
    EXPECT_NEAR(mesh.volume(), box, 1e-6 * box) << name;  // points have six digits
    for (const double volume : mesh.volumes) EXPECT_GT(volume, 0) << name;
  }
}

class BrokenMesh : public ::testing::Test {
 protected:
  void SetUp() override { folder_.copy(data / "ascii/constant/polyMesh"); }
  std::string error() const {
    return error_of([&] { read_poly_mesh(from(folder_.path())); });
  }
  void replace(const std::string& file, const std::string& what, const std::string& by) const {
    auto text = bytes_of(folder_.path(file));
    const auto at = text.find(what);
    ASSERT_NE(at, std::string::npos);
    folder_.write(file, text.replace(at, what.size(), by));
  }
  Folder folder_;
};

TEST_F(BrokenMesh, NamesTheFaceAndTheLabel) {
  replace("owner", "(\n0\n0\n1", "(\n0\n0\n-7");
  EXPECT_NE(error().find("owner: face 2: negative cell -7"), std::string::npos) << error();
  replace("owner", "-7", "99999");
  EXPECT_NE(error().find("owner: face 2 names cell 99999; note says nCells:200"),
            std::string::npos);
  replace("owner", "note ", "nota ");
  replace("neighbour", "note ", "nota ");
  EXPECT_NE(error().find("830 faces bound 300 cells at most"), std::string::npos) << error();
}

TEST(OpenFoamMesh, WithoutItsFilesIsAnErrorThatNamesOne) {
  EXPECT_EQ(error_of([] { read_poly_mesh([](std::string_view) { return nullptr; }); }),
            "points: no such file in the mesh");
}

TEST_F(BrokenMesh, NeedsEveryPointAndFace) {
  replace("faces", "4(2 24", "4(2 250000");
  EXPECT_NE(error().find("faces: face 0 names point 250000 of 462"), std::string::npos) << error();
  replace("faces", "4(2 250000 25 3)", "2(2 24)");
  EXPECT_NE(error().find("face 0 has 2 points, expected 3 or more"), std::string::npos) << error();
  folder_.write("points", "");
  EXPECT_NE(error().find("points: is empty"), std::string::npos) << error();
}

TEST_F(BrokenMesh, PatchesHaveFacesOfTheirOwn) {
  const auto poly = read_poly_mesh(from(folder_.path()));
  const auto& second = poly.patches.at(1);
  const auto start = fmt::format("{};", second.start);
  replace("boundary", start, fmt::format("{};", second.start - 1));
  EXPECT_NE(error().find(fmt::format("patch {} begins at face {}, expected {}", second.name,
                                     second.start - 1, second.start)),
            std::string::npos)
      << error();
  folder_.write("boundary", "");
  EXPECT_NE(error().find("expected a list of patches, found end of file"), std::string::npos);
}

TEST_F(BrokenMesh, OldMeshMayPadTheNeighboursWithMinusOne) {
  auto poly = read_poly_mesh(from(folder_.path()));
  std::string text = header("labelList") + "830\n(\n";
  for (const auto cell : poly.neighbour) text += fmt::format("{}\n", cell);
  for (std::size_t f = poly.neighbour.size(); f < poly.faces(); ++f) text += "-1\n";
  folder_.write("neighbour", text + ")\n");
  EXPECT_EQ(read_poly_mesh(from(folder_.path())).neighbour, poly.neighbour);
}

}  // namespace
}  // namespace bedscope::readers
