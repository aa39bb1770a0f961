// SPDX-License-Identifier: BSD-3-Clause
// Legacy VTK particles: every container, type and companion, and what is said of broken files.
// The files of tests/data/vtk_legacy were written by LIGGGHTS 3.8.0 and by LPP.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "readers/byte_window.hpp"
#include "readers/forms.hpp"
#include "tests/readers/test_files.hpp"

namespace bedscope::readers {

extern const Form vtk_legacy;

namespace {

const fs::path data = fs::path(BEDSCOPE_TEST_DATA) / "vtk_legacy";

Snapshot read_path(const std::string& path, const std::vector<std::string>& names) {
  Snapshot snapshot;
  Scratch scratch;
  vtk_legacy.read(path, {}, request_of(names), snapshot, scratch);
  return snapshot;
}

Snapshot read_text(const std::string& text, const std::vector<std::string>& names) {
  const TemporaryFolder folder;
  return read_path(folder.write("dump.vtk", text), names);
}

FileScan scan_text(const std::string& text) {
  const TemporaryFolder folder;
  return vtk_legacy.scan(folder.write("dump.vtk", text), true);
}

std::string error_of_text(const std::string& text,
                          const std::vector<std::string>& names = {"x", "radius"}) {
  const TemporaryFolder folder;
  const auto path = folder.write("dump.vtk", text);
  const auto error = error_of([&] { read_path(path, names); });
  return error.size() > path.size() + 2 ? error.substr(path.size() + 2) : error;
}

template <class T>
std::string big_endian(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if constexpr (std::endian::native == std::endian::little)
    std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// Values of one array as they stand in the file.
template <class T>
std::string block(bool binary, const std::vector<double>& values) {
  std::string text;
  for (const double value : values)
    text += binary ? big_endian(static_cast<T>(value)) : fmt::format("{} ", value);
  return text + "\n";
}

std::string block_of(const std::string& type, bool binary, const std::vector<double>& values) {
  if (type == "char") return block<std::int8_t>(binary, values);
  if (type == "unsigned_char") return block<std::uint8_t>(binary, values);
  if (type == "short") return block<std::int16_t>(binary, values);
  if (type == "unsigned_short") return block<std::uint16_t>(binary, values);
  if (type == "int" || type == "vtkIdType") return block<std::int32_t>(binary, values);
  if (type == "unsigned_int") return block<std::uint32_t>(binary, values);
  if (type == "long" || type == "vtktypeint64") return block<std::int64_t>(binary, values);
  if (type == "unsigned_long" || type == "vtktypeuint64")
    return block<std::uint64_t>(binary, values);
  if (type == "float") return block<float>(binary, values);
  return block<double>(binary, values);
}

std::vector<double> ramp(std::size_t count, double start, double step) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = start + step * static_cast<double>(i);
  return values;
}

struct Container {
  bool binary = false;
  std::string version = "3.0";
  bool grid = false;  ///< UNSTRUCTURED_GRID
  std::string metadata;
};

/// n particles at (i, i + .25, i + .5), with their cells.
std::string head_of(const Container& c, std::size_t n) {
  std::string text =
      fmt::format("# vtk DataFile Version {}\ntitle\n{}\nDATASET {}\n", c.version,
                  c.binary ? "BINARY" : "ASCII", c.grid ? "UNSTRUCTURED_GRID" : "POLYDATA");
  std::vector<double> points;
  for (std::size_t i = 0; i < n; ++i)
    for (const double shift : {0., .25, .5}) points.push_back(static_cast<double>(i) + shift);
  text += fmt::format("POINTS {} double\n", n) + block<double>(c.binary, points) + c.metadata;
  const std::string cells = c.grid ? "CELLS" : "VERTICES";
  if (c.version >= "5") {
    text += fmt::format("{} {} {}\nOFFSETS vtktypeint64\n", cells, n + 1, n) +
            block<std::int64_t>(c.binary, ramp(n + 1, 0, 1)) + "CONNECTIVITY vtktypeint64\n" +
            block<std::int64_t>(c.binary, ramp(n, 0, 1));
  } else {
    std::vector<double> old;
    for (std::size_t i = 0; i < n; ++i) old.insert(old.end(), {1, static_cast<double>(i)});
    text += fmt::format("{} {} {}\n", cells, n, 2 * n) + block<std::int32_t>(c.binary, old);
  }
  if (c.grid)
    text += fmt::format("CELL_TYPES {}\n", n) +
            block<std::int32_t>(c.binary, std::vector<double>(n, 1));
  return text;
}

void expect_positions(const Snapshot& snapshot, std::size_t n) {
  ASSERT_EQ(snapshot.particles, n);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ASSERT_EQ(snapshot.columns[axis], ramp(n, .25 * static_cast<double>(axis), 1));
  }
}

std::vector<Container> containers() {
  std::vector<Container> all;
  for (const bool binary : {false, true})
    for (const char* version : {"1.0", "2.0", "3.0", "4.2", "5.0", "5.1"})
      for (const bool grid : {false, true})
        for (const char* metadata :
             {"",
              "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 1 2\n\n"})
          all.push_back({binary, version, grid, metadata});
  return all;
}

std::string trace(const Container& c) {
  return fmt::format("{} {} {}", c.binary ? "binary" : "ascii", c.version,
                     c.grid ? "grid" : "polydata");
}

TEST(VtkLegacy, EveryContainerGivesTheNumbersThatWereWritten) {
  constexpr std::size_t n = 700;
  for (const auto& c : containers()) {
    SCOPED_TRACE(trace(c));
    const auto text =
        head_of(c, n) + fmt::format("POINT_DATA {}\n", n) +
        "SCALARS radius double\nLOOKUP_TABLE default\n" + block<double>(c.binary, ramp(n, 1, .5)) +
        c.metadata + "VECTORS v float\n" + block<float>(c.binary, ramp(3 * n, 0, .25)) +
        "TENSORS quat double\n" + block<double>(c.binary, ramp(9 * n, 0, 1)) +
        "FIELD FieldData 2\n" + fmt::format("id 1 {} int\n", n) +
        block<std::int32_t>(c.binary, ramp(n, 5, 2)) + c.metadata +
        fmt::format("c_st[1-3] 3 {} double\n", n) + block<double>(c.binary, ramp(3 * n, 0, 1)) +
        c.metadata +
        fmt::format("CELL_DATA {}\nSCALARS radius float 1\nLOOKUP_TABLE default\n", n) +
        block<float>(c.binary, ramp(n, -1, 0));
    for (const auto& content : {text, gzip(text)}) {
      const auto snapshot =
          read_text(content, {"x", "y", "z", "radius", "vx", "vz", "id", "c_st[2]", "quat[9]"});
      ASSERT_NO_FATAL_FAILURE(expect_positions(snapshot, n));
      ASSERT_EQ(snapshot.columns[3], ramp(n, 1, .5));
      ASSERT_EQ(snapshot.columns[4], ramp(n, 0, .75));
      ASSERT_EQ(snapshot.columns[5], ramp(n, .5, .75));
      ASSERT_EQ(snapshot.columns[6], ramp(n, 5, 2));
      ASSERT_EQ(snapshot.columns[7], ramp(n, 1, 3));
      ASSERT_EQ(snapshot.columns[8], ramp(n, 8, 9));
      EXPECT_FALSE(snapshot.box.known);
    }
    const auto found = scan_text(text);
    ASSERT_EQ(found.not_particles, "");
    EXPECT_EQ(found.snapshots.at(0).particles, static_cast<std::int64_t>(n));
    EXPECT_EQ(*found.snapshots[0].columns,
              (std::vector<std::string>{"radius", "v", "quat", "id", "c_st[1-3]"}));
  }
}

TEST(VtkLegacy, EveryTypeIsReadWithItsWidthAndSign) {
  constexpr std::size_t n = 100;
  struct Range {
    const char* type;
    double start, step;
  };
  for (const auto& [type, start, step] :
       {Range{"char", -50, 1}, Range{"unsigned_char", 120, 1}, Range{"short", -32000, 600},
        Range{"unsigned_short", 100, 650}, Range{"int", -2e9, 3e7}, Range{"unsigned_int", 1e9, 3e7},
        Range{"long", -9e15, 1e14}, Range{"unsigned_long", 0, 9e13},
        Range{"vtktypeint64", -9e15, 1e14}, Range{"vtktypeuint64", 0, 9e13},
        Range{"vtkIdType", -50, 1e6}, Range{"float", -5, .125}, Range{"double", -5, 1e-3}})
    for (const bool binary : {false, true}) {
      SCOPED_TRACE(type);
      const auto values = ramp(n, start, step);
      const auto text = head_of({binary, "2.0", false, ""}, n) +
                        fmt::format("POINT_DATA {}\nFIELD FieldData 2\na 1 {} {}\n", n, n, type) +
                        block_of(type, binary, values) + fmt::format("radius 1 {} float\n", n) +
                        block<float>(binary, ramp(n, 1, 0));
      EXPECT_EQ(read_text(text, {"a"}).columns[0], values);
      EXPECT_EQ(read_text(text, {"radius"}).columns[0], ramp(n, 1, 0));  // `a` passed over
    }
}

TEST(VtkLegacy, FloatsOfAsciiFilesAreRoundedToFloat) {
  const auto text = replaced(small_vtk(2), "1 0 0\n", "0.1 0.30000001 1e-3\n");
  const auto snapshot = read_text(text, {"x", "y", "z"});
  EXPECT_EQ(snapshot.columns[0][1], static_cast<double>(.1F));
  EXPECT_EQ(snapshot.columns[1][1], static_cast<double>(.3F));
  EXPECT_EQ(snapshot.columns[2][1], static_cast<double>(1e-3F));
}

TEST(VtkLegacy, StringArraysArePassedOverWhateverTheyHold) {
  // A decimal that looks like a keyword, an empty one, and a long one; VTK stores the length of a
  // binary string in the 6, 14, 30 or 62 bits behind two bits that tell which.
  const std::vector<std::string> strings{"POINT_DATA 7", "", std::string(200, 's'),
                                         std::string(20'000, 't')};
  std::string ascii = "element%201 1 4 string\n", binary = ascii;
  for (const auto& s : strings) {
    ascii += s + "\n";
    if (s.size() < 64)
      binary += big_endian(static_cast<std::uint8_t>(0xC0 | s.size()));
    else if (s.size() < 16384)
      binary += big_endian(static_cast<std::uint16_t>(0x8000 | s.size()));
    else
      binary += big_endian(static_cast<std::uint32_t>(0x40000000 | s.size()));
    binary += s;
  }
  for (const bool is_binary : {false, true}) {
    const auto text = head_of({is_binary, "4.2", false, ""}, 4) +
                      "POINT_DATA 4\nFIELD FieldData 2\n" + (is_binary ? binary + "\n" : ascii) +
                      "radius 1 4 double\n" + block<double>(is_binary, ramp(4, 1, 1));
    EXPECT_EQ(read_text(text, {"radius"}).columns[0], ramp(4, 1, 1));
    EXPECT_EQ(scan_text(text).snapshots.at(0).columns->front(), "element 1");
  }
}

TEST(VtkLegacy, TheEmptyElementArrayOfLiggghtsIsPassedOver) {
  for (const bool binary : {false, true}) {
    const auto text = head_of({binary, "5.1", false, ""}, 4) +
                      "POINT_DATA 4\nFIELD FieldData 2\nelement 1 0 string\n\nradius 1 4 double\n" +
                      block<double>(binary, ramp(4, 1, 1));
    EXPECT_EQ(read_text(text, {"radius"}).columns[0], ramp(4, 1, 1));
  }
}

TEST(VtkLegacy, NamesAreDecoded) {
  const auto text = replaced(small_vtk(2), "SCALARS radius", "SCALARS 50%25%20of%3A%zz");
  EXPECT_EQ(scan_text(replaced(text, "POINT_DATA", "POINT_DATA")).snapshots.at(0).columns->at(0),
            "50% of:%zz");
}

TEST(VtkLegacy, TheTimeOfTheFieldDataIsTheTime) {
  for (const bool binary : {false, true}) {
    auto text = head_of({binary, "4.2", false, ""}, 3);
    text.insert(text.find("POINTS"), "FIELD FieldData 2\nCYCLE 1 1 int\n" +
                                         block<std::int32_t>(binary, {7}) +
                                         "TimeValue 1 1 double\n" + block<double>(binary, {.125}));
    EXPECT_EQ(scan_text(text).snapshots.at(0).time, .125);
    EXPECT_EQ(read_text(text, {"x"}).time, .125);
  }
  EXPECT_TRUE(std::isnan(scan_text(small_vtk(3)).snapshots.at(0).time));
}

TEST(VtkLegacy, AnArrayNamedLikeACoordinateDoesNotHideThePoints) {
  const auto text = small_vtk(3) + "FIELD FieldData 1\nx 1 3 double\n9 9 9\n";
  EXPECT_EQ(read_text(text, {"x"}).columns[0], ramp(3, 0, 1));
}

TEST(VtkLegacy, PositionsThatLiggghtsForgotToNameDoNotDisturb) {
  const auto snapshot =
      read_path((data / "triclinic_2000.vtk").string(), {"x", "z", "radius", "iz", "type"});
  ASSERT_EQ(snapshot.particles, 64U);
  // The text dump of the same step: z in 0.004 .. 0.02, radii 0.002 and 0.0025.
  const auto [low, high] =
      std::minmax_element(snapshot.columns[1].begin(), snapshot.columns[1].end());
  EXPECT_EQ(*low, static_cast<double>(.004F));
  EXPECT_EQ(*high, static_cast<double>(.02F));
  EXPECT_EQ(*std::max_element(snapshot.columns[2].begin(), snapshot.columns[2].end()), .0025);
}

TEST(VtkLegacy, BinaryFilesOfLiggghtsInsideGzipAreRead) {
  const auto snapshot = read_path((data / "binary_10000.vtk.gz").string(), {"id", "x", "radius"});
  ASSERT_EQ(snapshot.particles, 374U);
  double sum = 0;
  for (const double id : snapshot.columns[0]) sum += id;
  EXPECT_EQ(sum, 75139);  // of the text dump of the same step
  const auto [low, high] =
      std::minmax_element(snapshot.columns[2].begin(), snapshot.columns[2].end());
  EXPECT_EQ(*low, .003);
  EXPECT_EQ(*high, .0045);
}

TEST(VtkLegacy, AFileOfNoParticlesIsASnapshotOfNone) {
  for (const auto& text : {bytes_of(data / "lpp_empty9500.vtk"), small_vtk(0), head_of({}, 0),
                           head_of({true, "5.1", true, ""}, 0)}) {
    const auto found = scan_text(text);
    EXPECT_EQ(found.not_particles, "");
    EXPECT_EQ(found.snapshots.at(0).particles, 0);
    const auto snapshot = read_text(text, {"x", "radius", "vx"});
    EXPECT_EQ(snapshot.particles, 0U);
    ASSERT_EQ(snapshot.columns.size(), 3U);
    for (const auto& column : snapshot.columns) EXPECT_TRUE(column.empty());
  }
}

TEST(VtkLegacy, BuffersMayBeSharedBetweenFilesOfDifferentArrays) {
  const TemporaryFolder folder;
  const auto a = folder.write("a.vtk", small_vtk(500));
  const auto none = folder.write("none.vtk", bytes_of(data / "lpp_empty9500.vtk"));
  const auto b =
      folder.write("b.vtk", head_of({true, "5.1", false, ""}, 3) +
                                "POINT_DATA 3\nFIELD FieldData 2\nid 1 3 int\n" +
                                block<std::int32_t>(true, ramp(3, 7, 1)) + "radius 1 3 double\n" +
                                block<double>(true, ramp(3, 1, 1)));
  Scratch scratch;
  Snapshot snapshot;
  const Request request{{"radius"}, {"x"}, {"id", false}};
  for (int i = 0; i < 3; ++i) {
    vtk_legacy.read(a, {}, request, snapshot, scratch);
    ASSERT_EQ(snapshot.columns,
              (std::vector<std::vector<double>>{ramp(500, .5, 0), ramp(500, 0, 1), {}}));
    vtk_legacy.read(none, {}, request, snapshot, scratch);
    ASSERT_EQ(snapshot.columns, (std::vector<std::vector<double>>{{}, {}, {}}));
    vtk_legacy.read(b, {}, request, snapshot, scratch);
    ASSERT_EQ(snapshot.columns,
              (std::vector<std::vector<double>>{ramp(3, 1, 1), ramp(3, 0, 1), ramp(3, 7, 1)}));
  }
}

TEST(VtkLegacy, NumbersMayLieAcrossTheEndOfAPieceThatIsRead) {
  const TemporaryFolder folder;
  for (const bool binary : {false, true}) {
    const std::size_t n = 15'000;
    const auto text = head_of({binary, "2.0", false, ""}, n) +
                      fmt::format("POINT_DATA {}\nVECTORS v double\n", n) +
                      block<double>(binary, ramp(3 * n, .125, .5)) +
                      "SCALARS radius float\nLOOKUP_TABLE default\n" +
                      block<float>(binary, ramp(n, 1, 0));
    ASSERT_GT(text.size(), 2 * ByteWindow::piece);
    for (std::size_t shift = 0; shift < 30; ++shift) {
      const auto shifted = replaced(text, "title", std::string(shift, 't'));
      const auto path = folder.write("dump.vtk", shifted);
      for (const auto& names :
           {std::vector<std::string>{"x", "y", "z", "vy"}, {"x", "y", "z", "radius"}}) {
        const auto snapshot = read_path(path, names);
        ASSERT_NO_FATAL_FAILURE(expect_positions(snapshot, n)) << shift;
        ASSERT_EQ(snapshot.columns[3], names[3] == "vy" ? ramp(n, .625, 1.5) : ramp(n, 1, 0))
            << shift;
      }
    }
  }
}

TEST(VtkLegacy, WindowsLineEndsOfAsciiFilesAreAccepted) {
  const auto text = replaced(small_vtk(40), "\n", "\r\n");
  EXPECT_EQ(read_text(text, {"x"}).columns[0], ramp(40, 0, 1));
}

TEST(VtkLegacy, KeywordsMayHaveAnyCase) {
  auto text = replaced(small_vtk(40), "DATASET POLYDATA", "Dataset PolyData");
  text = replaced(text, "POINTS", "Points");
  text = replaced(text, "VERTICES", "vertices");
  text = replaced(text, "POINT_DATA", "point_data");
  EXPECT_EQ(read_text(text, {"x"}).columns[0], ramp(40, 0, 1));
}

TEST(VtkLegacy, CompanionsAreNamedForWhatTheyAre) {
  struct Companion {
    const char *file, *what;
  };
  for (const auto& [file, what] :
       {Companion{"mesh_10500.vtk",
                  "a triangle mesh (64 polygons, no vertices, cell data), not particles"},
        Companion{"mesh_interp_200.vtk",
                  "a triangle mesh (128 polygons, no vertices), not particles"},
        Companion{"contact_10500.vtk", "47 lines (contacts?), not particles"},
        Companion{"euler_10500.vtk",
                  "averages on an Eulerian grid (dump euler/vtk), not particles"},
        Companion{"decomp_10500.vtk", "a RECTILINEAR_GRID bounding box companion, not particles"},
        Companion{"label_boundingBox_200.vtk",
                  "a RECTILINEAR_GRID bounding box companion, not particles"},
        Companion{"triclinic_boundingBox_2000.vtk", "a mesh of 1 cells, not particles"}}) {
    const auto path = (data / file).string();
    EXPECT_EQ(vtk_legacy.scan(path, true).not_particles, what);
    EXPECT_NE(error_of([&] { read_path(path, {"x"}); }), "") << file;
  }
  const auto points_only = small_vtk(3).substr(0, small_vtk(3).find("VERTICES"));
  EXPECT_EQ(scan_text(points_only).not_particles,
            "points without vertices and without a radius, not particles");
  const auto sized = replaced(small_vtk(3), "VERTICES 3 6\n1 0\n1 1\n1 2\n", "");
  EXPECT_EQ(scan_text(sized).not_particles, "");  // a radius makes them particles
  for (const char* name : {"Diameter", "diameter", "radii", "d"})
    EXPECT_EQ(scan_text(replaced(sized, "radius", name)).not_particles, "") << name;
}

TEST(VtkLegacy, AGlanceGivesTheCountOfParticles) {
  const TemporaryFolder folder;
  for (const auto& c : containers()) {
    const auto found = vtk_legacy.scan(folder.write("a.vtk", head_of(c, 70)), false);
    ASSERT_EQ(found.snapshots.size(), 1U);
    EXPECT_EQ(found.snapshots[0].particles, 70);
  }
}

TEST(VtkLegacy, ACutFileIsNeverTakenForAWholeOne) {
  const TemporaryFolder folder;
  for (const bool binary : {false, true}) {
    const auto text = head_of({binary, "2.0", true, ""}, 20) +
                      "POINT_DATA 20\nFIELD FieldData 1\nradius 1 20 double\n" +
                      block<double>(binary, ramp(20, 1.5, 0));
    // Behind the last digit only blanks are lost; a shorter last number of an ASCII file cannot be
    // told from a whole one.
    const auto whole = text.size() - (binary ? 1 : 4);
    for (std::size_t size = 1; size < whole; ++size) {
      // A file that ends before its POINT_DATA is a whole file without a radius.
      const auto path = folder.write("cut.vtk", text.substr(0, size));
      ASSERT_NE(error_of([&] { read_path(path, {"x", "radius"}); }), "") << text.substr(0, size);
    }
  }
}

TEST(VtkLegacy, EachErrorNamesPlaceExpectedAndFound) {
  const auto good = small_vtk(4);
  struct Case {
    std::string from, to, error;
  };
  const std::vector<Case> cases{
      {"Version 2.0", "Version 9.0", "line 1: legacy VTK version 9.0 not known (1.0 to 5.1 are)"},
      {"Version 2.0", "Version x", "line 1: legacy VTK version x not known (1.0 to 5.1 are)"},
      {"ASCII", "ASCIII", "line 3: expected ASCII or BINARY, found \"ASCIII\""},
      {"DATASET POLYDATA", "POLYDATA", "line 4: expected DATASET, found \"POLYDATA\""},
      {"DATASET POLYDATA", "DATASET MULTIBLOCK", "line 4: dataset \"MULTIBLOCK\" not known"},
      {"POINTS 4 float", "POINTS -4 float", "line 5: POINTS: negative count -4"},
      {"POINTS 4 float", "POINTS 4.0 float", "line 5: POINTS: expected a count, found \"4.0\""},
      {"POINTS 4 float", "POINTS 4 quad", "line 5: unknown data type \"quad\""},
      {"POINTS 4 float", "POINTS 1099511627776 float",
       "line 5: POINTS: 1099511627776 x 3 values declared, more than the file can hold"},
      {"POINTS 4 float", "POINTS 9223372036854775807 float",
       "line 5: POINTS: 9223372036854775807 x 3 values declared, more than the file can hold"},
      {"POINTS 4 float", "POINTS 5 float",
       "line 10: POINTS: 5 x 3 numbers declared; number expected, found \"VERTICES\""},
      {"POINTS 4 float", "POINTS 3 float", "line 9: keyword expected, found \"3 0 0\""},
      {"2 0 0", "O 0 0", "line 8: POINTS: 4 x 3 numbers declared; number expected, found \"O\""},
      {"POINT_DATA 4", "POINT_DATA 3", "line 15: POINT_DATA of 3 tuples, 4 points"},
      {"LOOKUP_TABLE default\n", "", "line 17: expected LOOKUP_TABLE after SCALARS radius"},
      {"SCALARS radius float 1\nLOOKUP_TABLE default", "FIELD FieldData 1\nradius 1 3 float",
       "line 17: array radius: 3 tuples, 4 points"},
      {"SCALARS radius float 1\nLOOKUP_TABLE default", "FIELD FieldData 2\nradius 1 4 float",
       "line 22: FIELD of 2 arrays: end of file after 1"},
      {"SCALARS radius float 1\nLOOKUP_TABLE default", "FIELD FieldData 1\nradius 1 4",
       "line 17: unknown data type \"\""},
      {"0.5\n0.5\n0.5\n0.5\n", "0.5 0.5\n",
       "line 19: end of file inside radius: 4 values declared, 2 present"},
      {"SCALARS radius", "SCALARS size", "expected a column \"radius\", found only: x y z size"}};
  for (const auto& [from, to, error] : cases) {
    const auto text = replaced(good, from, to);
    ASSERT_NE(text, good) << from;
    EXPECT_EQ(error_of_text(text), error);
  }
}

TEST(VtkLegacy, CountsWhoseProductOverflowsAreErrors) {
  // 2^62 tuples of 4 and of 2^61: as signed 64-bit products 0, undefined.
  for (const char* field :
       {"FIELD F 1\na 4 4611686018427387904 string\n", "FIELD F 1\na 4 4611686018427387904 float\n",
        "FIELD F 1\nTimeValue 4 4611686018427387905 double\n"})
    for (const bool binary : {false, true}) {
      auto text = head_of({binary, "4.2", false, ""}, 3);
      text.insert(text.find("POINTS"), field);
      EXPECT_NE(error_of_text(text, {"x"}), "") << field;
    }
}

TEST(VtkLegacy, PointsStandOnceInAFile) {
  // Otherwise arrays of the first lot would be shorter than the count of the second.
  EXPECT_EQ(error_of_text(small_vtk(3) + "POINTS 2 float\n0 0 0 0 0 0\n"), "line 19: POINTS twice");
}

}  // namespace
}  // namespace bedscope::readers
