// SPDX-License-Identifier: BSD-3-Clause
// Gas out of VTK files against the polyMesh it was made of, OpenFOAM's own volumes and centres, and
// closed forms; files that are damaged.
#include "readers/vtk_gas.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "readers/gas_series.hpp"
#include "tests/readers/openfoam_samples.hpp"

namespace bedscope::readers {
namespace {

using samples::Folder;

const fs::path vtk = fs::path(BEDSCOPE_TEST_DATA) / "vtk_gas";

GasSeries open(const fs::path& path) { return GasSeries::open(path.string()); }

// foamToVTK writes float, in text six digits.
void expect_same_fields(const GasSeries& a, std::size_t time_a, const GasSeries& b,
                        std::size_t time_b, double digits) {
  for (const auto& name : b.fields_at(time_b)) {
    ASSERT_TRUE(a.has(time_a, name)) << name;
    const unsigned components = name == "U.airPrime2Mean"                   ? 6
                                : name == "C"                               ? 3
                                : name[0] == 'U' || name.ends_with("Trans") ? 3
                                                                            : 1;
    FieldValues left, right;
    a.read(time_a, name, components, left);
    b.read(time_b, name, components, right);
    ASSERT_EQ(left.values.size(), right.values.size()) << name;
    for (std::size_t i = 0; i < left.values.size(); ++i)
      EXPECT_NEAR(left.values[i], right.values[i], digits * std::abs(left.values[i]) + 1e-38)
          << name << " " << i;
  }
}

TEST(VtkGas, EveryFormHoldsTheFieldsAndTheMeshOfTheCase) {
  const auto foam = open(samples::data / "ascii");
  for (const auto* form : {"xml", "legacy", "ascii", "legacy_ascii", "appended_zlib.vtu"}) {
    SCOPED_TRACE(form);
    const auto gas = open(vtk / form);
    EXPECT_EQ(gas.times()[0].time, 0.003);  // not 0.003 as a float
    EXPECT_EQ(gas.fields_at(0), foam.fields_at(0));
    const bool text = std::string(form).ends_with("ascii");
    expect_same_fields(foam, 0, gas, 0, text ? 1e-5 : 6e-8);
    const auto mesh = gas.mesh_at(0), whole = foam.mesh_at(0);
    ASSERT_TRUE(mesh->boxes.has_value());
    EXPECT_TRUE(mesh->boxes->rectilinear);
    EXPECT_EQ(mesh->boxes->low, whole->boxes->low);
    for (std::size_t c = 0; c < whole->cells(); ++c)
      EXPECT_NEAR(mesh->volumes[c], whole->volumes[c], 1e-5 * whole->volumes[c]);
  }
}

TEST(VtkGas, TimesAreThoseOfTheSeriesAndShareOneMesh) {
  for (const auto* form : {"xml", "legacy", "xml/boxes.vtm.series", "legacy/boxes.vtk.series"}) {
    const auto gas = open(vtk / form);
    ASSERT_EQ(gas.times().size(), 2U) << form;
    EXPECT_EQ(gas.times()[1].time, 0.004);
    EXPECT_EQ(gas.times()[1].name, "0.004");
    EXPECT_EQ(gas.mesh_at(0), gas.mesh_at(1)) << form;
    EXPECT_TRUE(gas.problems().empty());
  }
}

TEST(VtkGas, VolumesAndCentresAreThoseOfOpenFoam) {
  for (const auto* name : {"refined", "dual", "wedge"})
    for (const auto* form : {"case", "xml", "legacy"}) {
      SCOPED_TRACE(fmt::format("{}/{}", name, form));
      const auto gas = open(vtk / name / form);
      FieldValues volumes, centres;
      gas.read(0, "V", 1, volumes);
      gas.read(0, "C", 3, centres);
      const auto mesh = gas.mesh_at(0);
      ASSERT_EQ(mesh->cells(), volumes.values.size());
      const bool exact = std::string(form) == "case";
      for (std::size_t c = 0; c < mesh->cells(); ++c) {
        const double size = std::cbrt(volumes.values[c]);
        EXPECT_NEAR(mesh->volumes[c], volumes.values[c], (exact ? 1e-9 : 1e-5) * volumes.values[c]);
        for (std::size_t a = 0; a < 3; ++a)
          EXPECT_NEAR(mesh->centres[c][a], centres.values[3 * c + a], (exact ? 1e-9 : 1e-5) * size);
      }
    }
}

TEST(VtkGas, VtksOwnFilesAgreeWithOpenFoam) {
  for (const auto* form : {"dual_raw_lz4.vtu", "dual_5.1.vtk"}) {
    SCOPED_TRACE(form);
    const auto gas = open(vtk / form);
    expect_same_fields(open(vtk / "dual/xml"), 0, gas, 0, 0);
    EXPECT_EQ(gas.mesh_at(0)->volumes, open(vtk / "dual/xml").mesh_at(0)->volumes);
  }
}

TEST(VtkGas, RefinedBoxesStayBoxes) {
  for (const auto* form : {"xml", "legacy"}) {
    const auto mesh = open(vtk / "refined" / form).mesh_at(0);
    ASSERT_TRUE(mesh->boxes.has_value()) << form;
    EXPECT_FALSE(mesh->boxes->rectilinear);
    EXPECT_EQ(mesh->boxes->low, open(vtk / "refined/case").mesh_at(0)->boxes->low);
  }
}

TEST(VtkGas, DecomposedPolyhedraFillTheSameVolume) {
  for (const auto* name : {"refined", "dual"}) {
    const auto gas = open(fs::path(vtk) / name / "decomposed");
    const auto mesh = gas.mesh_at(0), whole = open(vtk / name / "case").mesh_at(0);
    EXPECT_GT(mesh->cells(), whole->cells());
    EXPECT_FALSE(mesh->boxes.has_value());
    // The parts of a cell with warped faces fill it to the sagitta of these.
    EXPECT_NEAR(mesh->volume(), whole->volume(), 5e-4 * whole->volume()) << name;
  }
}

// ---- Closed forms

std::string vtu(const std::string& points, std::size_t n_points, const std::string& connectivity,
                const std::string& offsets, const std::string& types, std::size_t n_cells,
                const std::string& more = "", const std::string& values = "") {
  return fmt::format(
      "<VTKFile type='UnstructuredGrid'><UnstructuredGrid>\n<FieldData><DataArray type='Float32' "
      "Name='TimeValue' NumberOfTuples='1'>0.25</DataArray></FieldData>\n<Piece "
      "NumberOfPoints='{}' NumberOfCells='{}'>\n<Points><DataArray type='Float64' "
      "NumberOfComponents='3'>{}</DataArray></Points>\n<Cells><DataArray type='Int64' "
      "Name='connectivity'>{}</DataArray><DataArray type='Int64' "
      "Name='offsets'>{}</DataArray><DataArray type='UInt8' "
      "Name='types'>{}</DataArray>{}</Cells>\n<CellData>{}</CellData></Piece>"
      "</UnstructuredGrid></VTKFile>\n",
      n_points, n_cells, points, connectivity, offsets, types, more, values);
}

std::string array(const std::string& name, const std::string& numbers,
                  const std::string& type = "Float64") {
  return fmt::format("<DataArray type='{}' Name='{}'>{}</DataArray>", type, name, numbers);
}

struct ShapeCase {
  int type;
  std::string points;
  std::size_t count;
  double volume;
  Point centre;
};

TEST(VtkGas, ShapesHaveTheVolumesOfTheirFormulas) {
  std::string pent, hexa;
  for (const int n : {5, 6})
    for (const double z : {0., 2.})
      for (int k = 0; k < n; ++k)
        (n == 5 ? pent : hexa) += fmt::format("{} {} {} ", std::cos(2 * std::numbers::pi * k / n),
                                              std::sin(2 * std::numbers::pi * k / n), z);
  const auto prism = [](int n) { return n * std::sin(2 * std::numbers::pi / n); };  // height 2
  const std::vector<ShapeCase> shapes{
      {10, "0 0 0 2 0 0 0 3 0 0 0 4", 4, 4, {0.5, 0.75, 1}},
      {11, "0 0 0 2 0 0 0 3 0 2 3 0 0 0 4 2 0 4 0 3 4 2 3 4", 8, 24, {1, 1.5, 2}},
      {12, "0 0 0 2 0 0 2 3 0 0 3 0 0 0 4 2 0 4 2 3 4 0 3 4", 8, 24, {1, 1.5, 2}},
      {13, "0 0 0 0 3 0 2 0 0 0 0 4 0 3 4 2 0 4", 6, 12, {2. / 3, 1, 2}},
      {13, "0 0 0 2 0 0 0 3 0 0 0 4 2 0 4 0 3 4", 6, 12, {2. / 3, 1, 2}},  // the other way round
      {14, "0 0 0 2 0 0 2 3 0 0 3 0 0 0 4", 5, 8, {0.75, 1.125, 1}},
      {15, pent, 10, prism(5), {0, 0, 1}},
      {16, hexa, 12, prism(6), {0, 0, 1}},
      // Convex sets in no order, as MFiX writes its cells: a box, and one without a corner.
      {41, "2 3 4 0 0 0 0 0 4 2 0 0 2 3 0 0 3 4 0 3 0 2 0 4", 8, 24, {1, 1.5, 2}},
      {41,
       "1 3 4 0 0 0 0 0 4 2 0 0 2 3 0 0 3 4 0 3 0 2 0 4 2 2 4 2 3 3",
       10,
       24 - 1. / 6,
       {(24 - 1.75 / 6) / (24 - 1. / 6), (36 - 2.75 / 6) / (24 - 1. / 6),
        (48 - 3.75 / 6) / (24 - 1. / 6)}},
      // A hexahedron with two points at one place, as OpenFOAM's wedge: a prism.
      {12, "0 0 0 2 0 0 0 3 0 0 0 0 0 0 4 2 0 4 0 3 4 0 0 4", 8, 12, {2. / 3, 1, 2}},
  };
  for (const auto& shape : shapes) {
    SCOPED_TRACE(shape.type);
    std::string labels;
    for (std::size_t k = 0; k < shape.count; ++k) labels += fmt::format("{} ", k);
    const Folder folder;
    const auto gas = open(
        folder.write("a.vtu", vtu(shape.points, shape.count, labels, std::to_string(shape.count),
                                  std::to_string(shape.type), 1)));
    EXPECT_EQ(gas.times()[0].time, 0.25);
    EXPECT_NEAR(gas.mesh_at(0)->volumes[0], shape.volume, 1e-5 * shape.volume);  // of text
    for (std::size_t a = 0; a < 3; ++a)
      EXPECT_NEAR(gas.mesh_at(0)->centres[0][a], shape.centre[a], 1e-5);
  }
}

const std::string cube = "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1 ";
const std::string cube_labels = "0 1 2 3 4 5 6 7 ";

std::string polyhedron(const std::string& faces, std::size_t end) {
  return vtu(cube, 8, cube_labels, "8", "42", 1,
             array("faces", faces, "Int64") + array("faceoffsets", std::to_string(end), "Int64"));
}

TEST(VtkGas, PolyhedraCloseWhicheverWayTheirFacesTurn) {
  const Folder folder;
  const auto volume = [&](const std::string& faces, std::size_t end) {
    return open(folder.write("a.vtu", polyhedron(faces, end))).mesh_at(0)->volume();
  };
  EXPECT_NEAR(volume("6 4 0 3 2 1 4 4 5 6 7 4 0 1 5 4 4 1 2 6 5 4 2 3 7 6 4 3 0 4 7", 31), 1,
              1e-12);
  EXPECT_NEAR(volume("6 4 0 1 2 3 4 4 5 6 7 4 0 1 5 4 4 1 5 6 2 4 2 3 7 6 4 3 0 4 7", 31), 1,
              1e-12);
}

TEST(VtkGas, GhostCellsOfPiecesAreLeftOut) {
  const Folder folder;
  const auto values = array("alpha.air", "0.5 0.75") + array("vtkGhostType", "0 1", "UInt8");
  const std::string two = cube + "2 0 0 2 1 0 2 0 1 2 1 1";
  folder.write("b_0.vtu",
               vtu(two, 12, cube_labels + "1 8 9 2 5 10 11 6", "8 16", "12 12", 2, "", values));
  folder.write("b_1.vtu", vtu("1 0 0 2 0 0 2 1 0 1 1 0 1 0 1 2 0 1 2 1 1 1 1 1", 8, cube_labels,
                              "8", "12", 1, "", array("alpha.air", "0.25")));
  const auto path = folder.write("b.pvtu",
                                 "<VTKFile type='PUnstructuredGrid'><PUnstructuredGrid>"
                                 "<Piece Source='b_0.vtu'/><Piece Source='b_1.vtu'/>"
                                 "</PUnstructuredGrid></VTKFile>");
  const auto gas = open(path);
  FieldValues eps;
  gas.read(0, "alpha.air", 1, eps);
  EXPECT_EQ(eps.values, (std::vector<double>{0.5, 0.25}));
  EXPECT_NEAR(gas.mesh_at(0)->volume(), 2, 1e-12);
}

TEST(VtkGas, MovedPointsMakeAnotherMesh) {
  const Folder folder;
  const auto write = [&](const std::string& name, const std::string& points) {
    folder.write(name, vtu(points, 8, cube_labels, "8", "12", 1, "", array("p", "1")));
  };
  write("a_0.vtu", cube);
  write("a_1.vtu", "0 0 0 1 0 0 1 1 0 0 1 0 0 0 2 1 0 2 1 1 2 0 1 2");
  folder.write("a.pvd",
               "<VTKFile type='Collection'><Collection><DataSet timestep='0.1' file='a_0.vtu'/>"
               "<DataSet timestep='0.3' file='a_1.vtu'/></Collection></VTKFile>");
  const auto gas = open(folder.path());
  ASSERT_EQ(gas.times().size(), 2U);
  EXPECT_EQ(gas.times()[1].time, 0.3);
  EXPECT_NEAR(gas.mesh_at(0)->volume(), 1, 1e-12);
  EXPECT_NEAR(gas.mesh_at(1)->volume(), 2, 1e-12);
}

TEST(VtkGas, FoldersWithoutListAreOrderedByTheTimeInside) {
  const Folder folder;
  for (const auto* name : {"boxes_0", "boxes_1"})
    folder.copy(vtk / "xml" / name / "internal.vtu",
                fmt::format("{}.vtu", name == std::string("boxes_0") ? "z" : "a"));
  const auto gas = open(folder.path());
  ASSERT_EQ(gas.times().size(), 2U);
  EXPECT_EQ(gas.times()[0].time, 0.003);
  EXPECT_TRUE(gas.files(0, "p")[0].ends_with("z.vtu"));
}

// ---- Damage

TEST(VtkGas, WhatIsWrongWithACellIsNamed) {
  const Folder folder;
  const auto error = [&](const std::string& text) {
    return error_of([&] {
      const auto gas = open(folder.write("a.vtu", text));
      FieldValues values;
      for (const auto& name : gas.fields_at(0)) gas.read(0, name, 1, values);
    });
  };
  const auto expect = [&](const std::string& text, const std::string& part) {
    EXPECT_NE(error(text).find(part), std::string::npos) << error(text);
  };
  expect(vtu(cube, 8, "0 1 2 3 4 5 6 8", "8", "12", 1), "cell 0: point 8 of 8");
  expect(vtu(cube, 8, "0 1 2 3 4 5 6 -1", "8", "12", 1), "cell 0: point -1 of 8");
  expect(vtu(cube, 8, "0 1 2 3 4 5 6", "7", "12", 1), "VTK type 12: expected 8 points, found 7");
  expect(vtu(cube, 8, cube_labels + "0 1 2", "8 11", "12 5", 2),
         "cell 1: expected a cell with a volume, found VTK type 5");
  expect(vtu(cube, 8, cube_labels + cube_labels, "16 8", "12 12", 2),
         "expected 8 points, found 16");
  expect(vtu("0 0 0 1 0 0 1 1 0 0 1 0 0 0 0 1 0 0 1 1 0 0 1 0", 8, cube_labels, "8", "12", 1),
         "cell 0 has no volume");
  expect(vtu("nan" + cube.substr(1), 8, cube_labels, "8", "12", 1), "point 0 is not finite");
  expect(vtu(cube, 8, cube_labels, "8", "12", 1, "", array("p", "1 2")), "1 numbers expected");
  expect(polyhedron("5 4 0 3 2 1 4 4 5 6 7 4 0 1 5 4 4 1 2 6 5 4 2 3 7 6", 26), "do not close");
  expect(polyhedron("6 4 0 3 2 1 4 4 5 6 7 4 0 1 5 4 4 1 2 6 5 4 2 3 7 6 4 3 0 4 9", 31),
         "cell 0: point 9 of 8");
  expect(polyhedron("6 9 0 3 2 1 4 4 5 6 7 4 0 1 5 4 4 1 2 6 5 4 2 3 7 6 4 3 0 4 7", 31), "cell 0");
  expect(polyhedron("600 4 0 3 2 1 4 4 5 6 7 4 0 1 5 4 4 1 2 6 5 4 2 3 7 6 4 3 0 4 7", 31),
         "expected a number of faces from 4 to 30, found 600");
  expect(vtu(cube, 8, cube_labels, "8", "42", 1), "a polyhedron without faces");
  expect(vtu(cube, 8, "0 1 2", "3", "41", 1), "a convex set of 3 points, expected 4 to 16");
  expect(vtu(cube, 8, "0 1 2 3", "4", "41", 1), "cell 0: a convex set of points in one plane");
  expect(vtu(cube, 8, "0 1 2 3 8", "5", "41", 1), "cell 0: point 8 of 8");
  expect(vtu(cube, 8, cube_labels, "9000000000000", "12", 1), "more than the file can hold");
}

TEST(VtkGas, LastTimeThatIsCutIsLeftOutAndSaid) {
  for (const auto* form : {"xml", "legacy"}) {
    const Folder folder;
    folder.copy(vtk / form, "VTK");
    const std::string file =
        form == std::string("xml") ? "VTK/boxes_1/internal.vtu" : "VTK/boxes_1.vtk";
    const auto whole = bytes_of(folder.path(file));
    for (const double part : {0.02, 0.3, 0.9}) {
      folder.write(
          file,
          whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
      const auto gas = open(folder.path("VTK"));
      EXPECT_EQ(gas.times().size(), 1U) << form << part;
      ASSERT_EQ(gas.problems().size(), 1U);
      EXPECT_TRUE(gas.problems()[0].ends_with("left out")) << gas.problems()[0];
    }
  }
}

TEST(VtkGas, CutsAndBytesChangedNeverCrash) {
  const Folder folder;
  for (const auto& [from, under] : {std::pair{"xml/boxes_0/internal.vtu", "a.vtu"},
                                    {"legacy/boxes_0.vtk", "a.vtk"},
                                    {"dual/legacy/dual_0.vtk", "b.vtk"},
                                    {"dual_5.1.vtk", "c.vtk"},
                                    {"dual_raw_lz4.vtu", "c.vtu"}}) {
    const std::string to = under;  // clang 14 has no captures of structured bindings
    const auto whole = bytes_of(vtk / from);
    std::size_t answered = 0, tried = 0;
    const auto attempt = [&](const std::string& bytes) {
      ++tried;
      const auto path = folder.write(to, bytes);
      const auto error = error_of([&] {
        const auto gas = open(path);
        FieldValues values;
        for (const auto& name : gas.fields_at(0)) try {
            gas.read(0, name, 1, values);
          } catch (const FormatError&) {  // of another number of components
          }
      });
      answered += !error.empty();
    };
    for (std::size_t k = 0; k < 40; ++k) attempt(whole.substr(0, k * whole.size() / 40));
    EXPECT_GT(answered, 35U) << from;  // what a cut leaves of the tail may be enough
    for (std::size_t k = 0; k < 200; ++k) {
      auto bytes = whole;
      bytes[(k * 7919 + k * k * 31) % bytes.size()] ^= static_cast<char>(1U << k % 8);
      attempt(bytes);
    }
    EXPECT_GT(answered, 40U) << from;
    EXPECT_EQ(tried, 240U);
  }
}

TEST(VtkGas, ChoicesAreTheUsers) {
  const Folder folder;
  folder.copy(vtk / "xml", "VTK");
  folder.write("VTK/other.pvd",
               "<VTKFile type='Collection'><Collection><DataSet timestep='1' "
               "file='boxes_0/internal.vtu'/></Collection></VTKFile>");
  EXPECT_NE(error_of([&] { open(folder.path("VTK")); }).find("several lists of times, name one of"),
            std::string::npos);
  EXPECT_EQ(open(folder.path("VTK/other.pvd")).times()[0].time, 1);
  EXPECT_NE(error_of([&] {
              open(folder.write("t.txt", "hello"));
            }).find("expected an OpenFOAM case or VTK"),
            std::string::npos);
  folder.write("none/a.txt", "");
  EXPECT_NE(error_of([&] { open(folder.path("none")); }), "");
  EXPECT_FALSE(is_vtk_gas(folder.path("none")));
  EXPECT_FALSE(is_vtk_gas((fs::path(BEDSCOPE_TEST_DATA) / "liggghts_parallel").string()));
}

// Cells cut by a wall among boxes, 1024 of them. Coordinates up to 2 m are floats: each face of a
// cell 0.0106 m thick may be off by 1e-5 of it.
TEST(VtkGas, CellsOfMfixHaveTheVolumesThatMfixSays) {
  const auto file =
      samples::shared / "corpus/found/Remmy195__MFiX-CFD-DEM/mfixgui/tests/vtk/test.vtu";
  if (!fs::exists(file)) GTEST_SKIP() << "no corpus beside the project";
  const auto gas = open(file);
  FieldValues said;
  gas.read(0, "Volume", 1, said);
  const auto mesh = gas.mesh_at(0);
  ASSERT_EQ(mesh->cells(), 1024U);
  const double largest = *std::max_element(said.values.begin(), said.values.end());
  for (std::size_t c = 0; c < mesh->cells(); ++c)
    EXPECT_NEAR(mesh->volumes[c], said.values[c], 6e-5 * largest) << c;
}

TEST(VtkGas, TheCorpusIsReadAsItsCase) {
  if (!samples::corpus_there()) GTEST_SKIP() << "no corpus beside the project";
  const auto corpus = samples::shared / "corpus/made/openfoam/of_ascii";
  const auto foam = open(corpus);
  for (const auto* form : {"VTK_xml_bin", "VTK_xml_ascii", "VTK_legacy_bin", "VTK_legacy_ascii"}) {
    SCOPED_TRACE(form);
    const auto gas = open(corpus / form);
    ASSERT_EQ(gas.times().size(), foam.times().size());
    for (std::size_t t = 0; t < gas.times().size(); ++t) {
      EXPECT_NEAR(gas.times()[t].time, foam.times()[t].time, 1e-12);
      expect_same_fields(foam, t, gas, t, 1e-5);
    }
  }
  for (const auto* name : {"of_ascii", "of_dec_ascii"}) {
    const auto gas =
        open(samples::shared / "corpus/made/openfoam" / name / "postProcessing/vtkWrite1");
    EXPECT_EQ(gas.times().size(), 3U);
    EXPECT_TRUE(gas.mesh_at(0)->boxes.has_value());
  }
}

}  // namespace
}  // namespace bedscope::readers
