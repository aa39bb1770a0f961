// SPDX-License-Identifier: BSD-3-Clause
// VTK XML particles. The fixtures of make_fixtures.py are one cloud in 16 containers, whose numbers
// are known here by formula; liggghts_* were written by LIGGGHTS 3.8.0.
#include "readers/vtk_xml.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include "readers/base64.hpp"
#include "readers/forms.hpp"
#include "readers/xml_text.hpp"
#include "tests/readers/test_files.hpp"

namespace bedscope::readers {

extern const Form vtk_xml;

namespace {

const fs::path data = fs::path(BEDSCOPE_TEST_DATA) / "vtk_xml";
const fs::path shared = BEDSCOPE_SHARED;

// A file of this process, gone with the object.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content, const std::string& name = "dump.vtp")
      : path_(fs::temp_directory_path() / fmt::format("bedscope_{}_{}", ::getpid(), name)) {
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~TemporaryFile() { fs::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  std::string path() const { return path_.string(); }

 private:
  fs::path path_;
};

Snapshot read(const std::string& path, const std::vector<std::string>& names) {
  Snapshot snapshot;
  Scratch scratch;
  vtk_xml.read(path, {}, request_of(names), snapshot, scratch);
  return snapshot;
}

Snapshot read_text(const std::string& text, const std::vector<std::string>& names) {
  const TemporaryFile file(text);
  return read(file.path(), names);
}

FileScan scan_text(const std::string& text) {
  const TemporaryFile file(text);
  return vtk_xml.scan(file.path(), true);
}

// The text of the error that a thorough scan ends in; empty where it does not.
std::string scan_error(const std::string& text) {
  try {
    scan_text(text);
  } catch (const FormatError& error) {
    return error.what();
  }
  return {};
}

// One particle for each number, radius as given.
std::string small_file(const std::string& radius, const std::string& points = "1 2 3  4 5 6",
                       const std::string& count = "2") {
  return "<VTKFile type=\"PolyData\">\n<PolyData>\n<Piece NumberOfPoints=\"" + count +
         "\">\n<PointData>\n<DataArray type=\"Float64\" Name=\"radius\">" + radius +
         "</DataArray>\n</PointData>\n<Points>\n<DataArray type=\"Float64\" "
         "NumberOfComponents=\"3\">" +
         points + "</DataArray>\n</Points>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

// In base64, the slow way, bit by bit.
std::string encoded(const std::string& bytes) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  const std::size_t bits = 8 * bytes.size();
  for (std::size_t at = 0; at < bits; at += 6) {
    unsigned value = 0;
    for (std::size_t bit = at; bit < at + 6; ++bit) {
      const unsigned byte = bit < bits ? static_cast<unsigned char>(bytes[bit / 8]) : 0;
      value = 2 * value + (byte >> (7 - bit % 8) & 1);
    }
    text += alphabet[value];
  }
  while (text.size() % 4 != 0) text += '=';
  return text;
}

// GCC 12.2 at -O2 drops the rounding of neighbouring static_cast<float>; volatile keeps it.
double as_float32(double value) {
  volatile auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

std::vector<fs::path> containers() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(data)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("ascii") || name.starts_with("inline") || name.starts_with("appended")) {
      found.push_back(entry.path());
    }
  }
  return found;
}

TEST(VtkXml, EveryContainerGivesTheNumbersThatWereWrittenBitForBit) {
  const std::vector<fs::path> files = containers();
  ASSERT_EQ(files.size(), 16U);
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.filename());
    const FileScan scan = vtk_xml.scan(file.string(), true);
    ASSERT_EQ(scan.snapshots.size(), 1U);
    EXPECT_TRUE(scan.problems.empty() && scan.cut.empty() && scan.not_particles.empty());
    EXPECT_EQ(scan.snapshots[0].particles, 40);
    EXPECT_EQ(scan.snapshots[0].step, no_step);
    EXPECT_EQ(scan.snapshots[0].time, 0.125);
    const Snapshot cloud =
        read(file.string(),
             {"x", "y", "z", "vx", "vy", "vz", "radius", "f_Temp[0]", "stress[1]", "stress[9]",
              "id", "type", "int8", "uint8", "int16", "uint16", "uint32", "int64", "uint64"});
    ASSERT_EQ(cloud.particles, 40U);
    EXPECT_EQ(cloud.time, 0.125);
    EXPECT_GT(cloud.bytes_read, 9000U);
    for (int i = 0; i < 40; ++i) {
      const double expected[] = {
          as_float32(0.01 * i),
          as_float32(-0.02 * i),
          as_float32(1.0 / (i + 1)),
          0.1 * i,
          -0.3 * i,
          std::sqrt(i),
          0.001 + 1e-5 * i,
          as_float32(300 + i / 3.0),
          9.0 * i / 7,
          (9.0 * i + 8) / 7,
          7.0 * i + 1,
          1.0 + i % 2,
          i - 100.0,
          i + 200.0,
          -600.0 * i,
          1300.0 * i,
          8e7 * i,
          static_cast<double>(-(std::int64_t{1} << 53) - i),
          static_cast<double>((std::uint64_t{1} << 63) + 4096 * static_cast<std::uint64_t>(i))};
      ASSERT_EQ(cloud.columns.size(), std::size(expected));
      for (std::size_t k = 0; k < std::size(expected); ++k) {
        EXPECT_EQ(cloud.columns[k][static_cast<std::size_t>(i)], expected[k]) << k << " " << i;
      }
    }
  }
}

TEST(VtkXml, AnAsciiFloat32IsRoundedOnceAsVtkDoes) {
  // 1 + 2^-24 + 2^-60: as a float the next one above 1; by way of a double (which drops 2^-60, a
  // tie) it would become 1.
  std::string text = small_file("1.000000059604644775390625867 1");
  text = replaced(text, "Float64", "Float32");
  EXPECT_EQ(read_text(text, {"radius"}).columns[0][0], 1 + std::ldexp(1.0, -23));
}

TEST(VtkXml, LiggghtsFilesAreRead) {
  const Snapshot base64 = read((data / "liggghts_base64.vtu").string(), {"radius", "id", "vz"});
  ASSERT_EQ(base64.particles, 153U);
  EXPECT_EQ(*std::max_element(base64.columns[0].begin(), base64.columns[0].end()), 0.0045);
  EXPECT_EQ(*std::max_element(base64.columns[1].begin(), base64.columns[1].end()), 226);
  // Minimum by VTK 9.1, all digits of the double.
  EXPECT_EQ(*std::min_element(base64.columns[2].begin(), base64.columns[2].end()),
            -1.103467550345143);
  EXPECT_EQ(read((data / "liggghts_write_dump.vtp").string(), {"radius"}).particles, 51U);
  EXPECT_EQ(read((data / "liggghts_triclinic.vtu").string(), {"radius"}).particles, 64U);
}

TEST(VtkXml, QuotesCommentsBlanksAndMissingCountsAreAccepted) {
  const Snapshot minimal = read((data / "hand_minimal.vtp").string(), {"radius", "x", "y"});
  EXPECT_EQ(minimal.columns[0], (std::vector<double>{0.1, 0.2, 0.3}));
  EXPECT_EQ(minimal.columns[1], (std::vector<double>{0, 1, 0}));
  EXPECT_EQ(minimal.columns[2], (std::vector<double>{0, 0, 1}));

  std::string text = small_file(" \t7e-3\r\n +8E-3 ", "1 2 3 4 5 6", "        2 ");
  text =
      "\xEF\xBB\xBF<?xml version='1.0'?>\r\n<!-- <VTKFile type='PPolyData'> -->\n" + text + "\n\n";
  EXPECT_TRUE(vtk_xml.matches(text));
  EXPECT_EQ(read_text(text, {"radius"}).columns[0], (std::vector<double>{7e-3, 8e-3}));
  EXPECT_TRUE(scan_text(text).problems.empty());
}

TEST(VtkXml, OnlyTheArraysAskedForAreDecoded) {
  const std::string text = small_file("0.1 oops");
  EXPECT_EQ(read_text(text, {"x", "z"}).columns[1], (std::vector<double>{3, 6}));
  EXPECT_THROW(read_text(text, {"radius"}), FormatError);
  EXPECT_THROW(scan_text(text), FormatError);
}

TEST(VtkXml, AbsentColumnsAreEmptyOrAnErrorThatListsWhatIsThere) {
  const TemporaryFile file(small_file("0.1 0.2"));
  Snapshot snapshot;
  Scratch scratch;
  vtk_xml.read(file.path(), {}, {{"vx", false}, {"radius", true}}, snapshot, scratch);
  EXPECT_TRUE(snapshot.columns[0].empty());
  EXPECT_EQ(snapshot.columns[1].size(), 2U);
  EXPECT_THROW(read(file.path(), {"vx"}), FormatError);
}

TEST(VtkXml, PiecesAreJoinedInTheirOrder) {
  const auto piece = [](const std::string& name, const std::string& radius, const char* count) {
    const std::string file = small_file(radius, "1 2 3 4 5 6", count);
    const std::size_t begin = file.find("<Piece"), end = file.find("</PolyData>");
    return replaced(file.substr(begin, end - begin), "radius", name);
  };
  const std::string empty = "<Piece NumberOfPoints='0'></Piece>\n";
  const auto file = [&](const std::string& pieces) {
    return "<VTKFile type='PolyData'>\n<PolyData>\n" + pieces + "</PolyData></VTKFile>";
  };
  const Snapshot joined =
      read_text(file(empty + piece("radius", "1 2", "2") + empty + piece("radius", "3 4", "2")),
                {"radius", "x"});
  EXPECT_EQ(joined.columns[0], (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(joined.columns[1], (std::vector<double>{1, 4, 1, 4}));

  const std::string mixed = file(piece("radius", "1 2", "2") + piece("r", "3 4", "2"));
  EXPECT_NE(scan_error(mixed).find("line 11: <Piece>: no array radius"), std::string::npos)
      << scan_error(mixed);
  EXPECT_THROW(read_text(mixed, {"radius"}), FormatError);
  EXPECT_EQ(read_text(mixed, {"x"}).particles, 4U);
}

TEST(VtkXml, AnUnnamedArrayIsKeptAndAnArrayNamedLikeACoordinateDoesNotHideThePoints) {
  // LIGGGHTS 3.8 gives xu yu zu an empty name.
  const std::string unnamed = replaced(small_file("0.1 0.2"), "Name=\"radius\"", "Name=\"\"");
  EXPECT_EQ(scan_text(unnamed).snapshots[0].columns->front(), "(unnamed)");
  EXPECT_EQ(read_text(unnamed, {"x"}).columns[0], (std::vector<double>{1, 4}));
  const std::string named_x = replaced(small_file("0.1 0.2"), "Name=\"radius\"", "Name=\"x\"");
  EXPECT_EQ(read_text(named_x, {"x"}).columns[0], (std::vector<double>{1, 4}));
}

TEST(VtkXml, NamesWithEscapedCharactersAreUnescaped) {
  const std::string text =
      replaced(small_file("1 2"), "\"radius\"", "'a&lt;b&gt;&amp;&quot;&apos;&#65;&#xe9;'");
  EXPECT_EQ(scan_text(text).snapshots[0].columns->front(), "a<b>&\"'A\xC3\xA9");
}

TEST(VtkXml, ASnapshotWithoutParticlesIsAnEmptySnapshot) {
  const std::string text = small_file("", "", "0");
  EXPECT_EQ(scan_text(text).snapshots[0].particles, 0);
  const Snapshot snapshot = read_text(text, {"x", "radius"});
  EXPECT_EQ(snapshot.particles, 0U);
  EXPECT_TRUE(snapshot.columns[1].empty());
}

TEST(VtkXml, NumbersForNoPointsAreWorthAWarning) {
  // foamToVTK writes such a file for a cloud whose positions it cannot read.
  const FileScan scan = scan_text(small_file("0.1 0.2", "", "0"));
  ASSERT_EQ(scan.problems.size(), 1U);
  EXPECT_NE(scan.problems[0].find("line 5: array radius holds numbers, but NumberOfPoints is 0"),
            std::string::npos);
}

TEST(VtkXml, NanAndInfinityAreReadAsSuch) {
  const auto values = read_text(small_file("nan -inf"), {"radius"}).columns[0];
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_EQ(values[1], -std::numeric_limits<double>::infinity());
}

TEST(VtkXml, WhatWindowsPrintsForNanIsReadAndNothingElseThatGoesOn) {
  EXPECT_TRUE(std::isnan(read_text(small_file("1.#QNAN 2"), {"radius"}).columns[0][0]));
  EXPECT_TRUE(std::isinf(read_text(small_file("1 -1.#INF00"), {"radius"}).columns[0][1]));
  for (const auto* text : {"1.5x 2", "1.#ABC 2", "1d0 2"})
    EXPECT_THROW(read_text(small_file(text), {"radius"}), FormatError) << text;
}

TEST(VtkXml, TheTimeOfMercuryDpmStandsInAComment) {
  const auto with = [](const char* comment) {
    return read_text(
               "<?xml version=\"1.0\"?>\n\n" + std::string(comment) + "\n" + small_file("1 2"),
               {"radius"})
        .time;
  };
  EXPECT_EQ(with("<!-- time 0.5-->"), 0.5);
  EXPECT_EQ(with("<!-- time 2.5e-05 -->"), 2.5e-05);
  EXPECT_TRUE(std::isnan(with("<!-- time of the run: 0.5 -->")));
}

TEST(VtkXml, AGzipFileIsReadWithoutBeingAskedFor) {
  const std::string text = bytes_of(data / "inline_zlib.vtp");
  const TemporaryFile file("", "dump.vtp.gz");
  gzFile gz = gzopen(file.path().c_str(), "wb");
  gzwrite(gz, text.data(), static_cast<unsigned>(text.size()));
  gzclose(gz);
  EXPECT_EQ(read(file.path(), {"radius"}).columns[0],
            read((data / "inline_zlib.vtp").string(), {"radius"}).columns[0]);

  const std::string packed = bytes_of(file.path());
  const TemporaryFile half(packed.substr(0, packed.size() / 2), "half.vtp.gz");
  try {
    vtk_xml.scan(half.path(), true);
    ADD_FAILURE() << "half a gzip file was read";
  } catch (const CutError& error) {
    EXPECT_NE(std::string(error.what()).find("gzip stream ends early"), std::string::npos);
  }
}

TEST(VtkXml, WhatIsNotParticlesIsNamed) {
  const auto what = [](const char* file) {
    return vtk_xml.scan((data / file).string(), true).not_particles;
  };
  EXPECT_EQ(what("liggghts_box.pvtr"), "the bounding box of a dump (RectilinearGrid of 8 points)");
  EXPECT_EQ(what("liggghts_triclinic_box.vtu"), "the bounding box of a dump (one hexahedron)");
  EXPECT_EQ(what("liggghts_contacts.vtp"), "contacts (lines of two points: 1)");
  EXPECT_EQ(what("liggghts_mesh.vtp"), "a triangle mesh (32 triangles)");
  EXPECT_EQ(scan_text("<VTKFile type='ImageData'><ImageData WholeExtent='0 9 0 9 0 9'/></VTKFile>")
                .not_particles,
            "a grid (ImageData)");
  const auto grid_text = [](const std::string& types) {
    const std::string cells =
        "<Cells><DataArray type='Int32' Name='connectivity'>0 1</DataArray>"
        "<DataArray type='Int32' Name='offsets'>1 2</DataArray>"
        "<DataArray type='UInt8' Name='types'>" +
        types + "</DataArray></Cells></Piece>";
    std::string text = replaced(small_file("1 2"), "</Piece>", cells);
    text = replaced(text, "Points=\"2\"", "Points=\"2\" NumberOfCells=\"2\"");
    for (int i = 0; i < 3; ++i) text = replaced(text, "PolyData", "UnstructuredGrid");
    return text;
  };
  const auto grid = [&](const std::string& types) {
    return scan_text(grid_text(types)).not_particles;
  };
  EXPECT_NE(
      scan_error(replaced(grid_text("1 300"), "UInt8", "Int32")).find("from 0 to 255, found 300"),
      std::string::npos);
  EXPECT_EQ(grid("1 1"), "");
  EXPECT_EQ(grid("1 2"), "");
  EXPECT_EQ(grid("3 3"), "contacts (lines of two points: 2)");
  EXPECT_EQ(grid("10 12"), "a mesh of 2 cells (1 of VTK type 10, 1 of VTK type 12)");
}

TEST(VtkXml, OnlySerialFilesAreClaimedAndTheTypeOfTheOthersIsKnown) {
  const auto type = [](const std::string& text) {
    EXPECT_EQ(vtk_xml.matches(text), text.find("claimed") != std::string::npos) << text;
    return xml_root_type(text);
  };
  EXPECT_EQ(type("<?xml version='1.0'?>\n<!-- claimed --><VTKFile a='1' type='PolyData'>"),
            "PolyData");
  EXPECT_EQ(type(" <VTKFile type=\" UnstructuredGrid \" x='claimed'>"), "UnstructuredGrid");
  EXPECT_EQ(type("<VTKFile type='RectilinearGrid' x='claimed'>"), "RectilinearGrid");
  EXPECT_EQ(type("<!DOCTYPE a [<!ENTITY b 'claimed'>]><VTKFile type='PolyData'>"), "PolyData");
  EXPECT_EQ(type("<VTKFile version='claimed'>"), "?");
  EXPECT_EQ(type("<VTKFile type='PPolyData'>"), "PPolyData");
  EXPECT_EQ(type("<VTKFile type='Collection'>"), "Collection");
  EXPECT_EQ(type("<VTKFile type='vtkMultiBlockDataSet'>"), "vtkMultiBlockDataSet");
  EXPECT_EQ(type("<html><VTKFile type='PolyData'>"), "");
  EXPECT_EQ(type("ITEM: TIMESTEP\n0\n"), "");
  EXPECT_EQ(type("<!-- never closed <VTKFile type='PolyData'>"), "");
  EXPECT_EQ(type(""), "");
}

TEST(VtkXml, EachErrorNamesThePlaceWhatWasExpectedAndWhatWasFound) {
  const std::string good = small_file("0.1 0.2");
  const std::string lzma = bytes_of(data / "inline_lzma.vtp");
  const std::string raw = bytes_of(data / "appended_raw.vtp");
  ASSERT_EQ(scan_error(good), "");
  const std::pair<std::string, std::string> cases[] = {
      {small_file("0.1"), "line 5: array radius: 2 numbers expected, 1 found"},
      {small_file("0.1 0.2 0.3"), "line 5: array radius: 2 numbers expected, more found"},
      {small_file("0.1 0x1p-8"),
       "line 5: array radius: number 2: expected Float64, found '0x1p-8'"},
      {small_file("3.0D-03 1"), "array radius: number 1: expected Float64, found '3.0D-03'"},
      {small_file("0,003 1"), "array radius: number 1: expected Float64, found '0,003'"},
      {small_file("1 2", "1 2 3", "-2"), "line 3: NumberOfPoints is negative: -2"},
      {small_file("1 2", "1 2 3", "two"), "line 3: NumberOfPoints: expected a whole number"},
      {small_file("1 2", "1 2 3", "4000000000000"), "array radius: 4000000000000 numbers expected"},
      {small_file("1 2", "1 2 3", "9000000000000000000"), "are more than any file holds"},
      {replaced(good, "NumberOfPoints", "Points"), "line 3: <Piece> without NumberOfPoints"},
      {replaced(good, "Components=\"3\"", "Components=\"2\""), "expected 3 components, found 2"},
      {replaced(good, "Float64\" NumberOf", "Float16\" NumberOf"),
       "line 8: array (unnamed): type 'Float16' is not a type of numbers"},
      {replaced(good, "</Points>", "</Point>"), "line 9: expected </Points>, found </Point>"},
      {replaced(good, "<Points>", "<Points a=b>"),
       "line 7: attribute a: expected a quotation mark"},
      {replaced(good, "<Points>", "<Points a='b>"),
       "line 7: attribute a: quotation mark not closed"},
      {replaced(good, "<Points>", "<Points a='1' a='2'>"), "line 7: attribute a twice in <Points>"},
      {replaced(good, "radius", "&radius;"), "line 5: entity '&radius' is not accepted"},
      {replaced(good, "0.1 0.2", "0.1 <!-- --> 0.2"), "data in several parts are not accepted"},
      {replaced(good, "0.1 0.2", "<![CDATA[0.1 0.2]]>"), "line 5: '<![CDATA[' is not accepted"},
      {replaced(good, "<PolyData>", "<PolyData TimeValues='0 1'>"),
       "line 2: several time steps in one file are not supported"},
      {"<!DOCTYPE a>" + good, "line 1: DOCTYPE is not accepted"},
      {"<VTKFile type='PolyData'></VTKFile>", "expected <PolyData> inside of"},
      {good.substr(0, good.find("0.2")), "XML ends inside <DataArray Name=\"radius\"> of line 5"},
      {good.substr(0, good.find("</Piece>")), "line 10: XML ends inside <Piece> of line 3"},
      {replaced(lzma, "LZMAData", "FooData"), "line 2: compressor vtkFooDataCompressor not known"},
      {replaced(lzma, "UInt32", "UInt64"), "header size not plausible"},
      {replaced(raw, "UInt32", "UInt16"), "header_type: expected UInt32 or UInt64, found 'UInt16'"},
      {replaced(raw, "Little", "Middle"),
       "expected LittleEndian or BigEndian, found 'MiddleEndian'"},
      {replaced(raw, "Little", "Big"), "header size not plausible"},
      {replaced(raw, "raw", "hex"),
       "<AppendedData>: encoding: expected raw or base64, found 'hex'"},
      {replaced(raw, "   _", "   #"),
       "<AppendedData>: expected \"_\" before the data, found byte 0x23"},
      {raw.substr(0, raw.size() - 60), "XML ends inside <AppendedData> of line"},
      {raw.substr(0, raw.find("<AppendedData")) + "</VTKFile>", "the file has no <AppendedData>"},
  };
  for (const auto& [text, words] : cases) {
    const std::string error = scan_error(text);
    EXPECT_NE(error.find(words), std::string::npos) << "found: " << error << "\nnot: " << words;
    EXPECT_NE(error.find("dump.vtp: "), std::string::npos) << error;
  }
}

TEST(VtkXml, AnArrayOfAnUnknownTypeIsNoColumnAndWorthAWarning) {
  const std::string text = replaced(small_file("1 2"), "Float64\" Name", "Float16\" Name");
  EXPECT_THROW(read_text(text, {"radius"}), FormatError);
  EXPECT_EQ(read_text(text, {"x"}).particles, 2U);
  const FileScan scan = scan_text(text);
  ASSERT_EQ(scan.problems.size(), 1U);
  EXPECT_NE(scan.problems[0].find("line 5: array radius: type 'Float16' is not a type of numbers"),
            std::string::npos);
  EXPECT_TRUE(scan_text(replaced(text, "Float16", "String")).problems.empty());
}

TEST(VtkXml, CountsInHeadersAreBoundedBeforeMemoryIsReserved) {
  // Each of these would take far more memory than any machine has, were it believed.
  const auto with_blocks = [](std::vector<std::uint32_t> header, std::uint64_t points) {
    std::string bytes(reinterpret_cast<const char*>(header.data()), 4 * header.size());
    return fmt::format(
        "<VTKFile type='PolyData' compressor='vtkZLibDataCompressor'><PolyData>"
        "<Piece NumberOfPoints='{}'><Points><DataArray type='Float32' NumberOfComponents='3' "
        "format='appended' offset='0'/></Points></Piece></PolyData><AppendedData encoding='raw'>"
        "_{}</AppendedData></VTKFile>",
        points, bytes);
  };
  EXPECT_NE(scan_error(with_blocks({0xFFFFFFFF, 0xFFFFFFFF, 0, 5}, 1u << 30)).find("plausible"),
            std::string::npos);
  EXPECT_NE(scan_error(with_blocks({1, 12u << 24, 0, 5, 0, 0}, 1 << 24)).find("bytes expected"),
            std::string::npos);
  EXPECT_NE(scan_error(with_blocks({1, 12, 0, 0xFFFFFFFF, 0}, 1)).find("fewer decoded"),
            std::string::npos);
  // Two blocks that are there each, but not both.
  EXPECT_NE(
      scan_error(with_blocks({2, 6, 6, 7, 7, 0, 0}, 1)).find("14 in compressed blocks, 8 there"),
      std::string::npos);
  EXPECT_NE(scan_error(with_blocks({1}, 1)).find("header of 4 bytes expected"), std::string::npos);
  EXPECT_NE(scan_error(with_blocks({}, 1)).find("offset 0 beyond"), std::string::npos);
}

// 24 bytes a tuple, so that blocks of 8, 40 and 1000 end within one, and blocks of 4 within a
// number; without a compressor, base64 is read in pieces, which no block ends.
TEST(VtkXml, TuplesThatBlocksCutAreWhole) {
  constexpr std::size_t points = 3000;
  std::vector<double> values(3 * points);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(static_cast<double>(i));
  const std::string bytes(reinterpret_cast<const char*>(values.data()), 8 * values.size());
  for (const std::size_t size : {0U, 4U, 8U, 40U, 1000U, 71999U}) {
    std::vector<std::uint32_t> header;
    std::string packed;
    const std::size_t last = size == 0 ? 0 : bytes.size() % size;
    if (size == 0) {
      header.push_back(static_cast<std::uint32_t>(bytes.size()));
      packed = bytes;
    } else {
      for (const std::size_t word : {bytes.size() / size + (last > 0), size, last})
        header.push_back(static_cast<std::uint32_t>(word));
    }
    for (std::size_t at = 0; size > 0 && at < bytes.size(); at += size) {
      const std::string block = bytes.substr(at, size);
      uLongf length = compressBound(block.size());
      std::string room(length, '\0');
      ASSERT_EQ(compress(reinterpret_cast<Bytef*>(room.data()), &length,
                         reinterpret_cast<const Bytef*>(block.data()), block.size()),
                Z_OK);
      header.push_back(static_cast<std::uint32_t>(length));
      packed += room.substr(0, length);
    }
    const std::string head(reinterpret_cast<const char*>(header.data()), 4 * header.size());
    for (const bool raw : {true, false}) {
      SCOPED_TRACE(fmt::format("blocks of {} bytes, {}", size, raw ? "raw" : "base64"));
      const auto text = fmt::format(
          "<VTKFile type='PolyData'{}><PolyData><Piece NumberOfPoints='{}'><Points>"
          "<DataArray type='Float64' NumberOfComponents='3' format='{}' offset='0'>{}</DataArray>"
          "</Points></Piece></PolyData>{}</VTKFile>",
          size > 0 ? " compressor='vtkZLibDataCompressor'" : "", points,
          raw ? "appended" : "binary", raw ? "" : encoded(head) + encoded(packed),
          raw ? "<AppendedData encoding='raw'>_" + head + packed + "</AppendedData>" : "");
      const Snapshot snapshot = read_text(text, {"x", "y", "z"});
      ASSERT_EQ(snapshot.particles, points);
      for (std::size_t i = 0; i < values.size(); ++i)
        ASSERT_EQ(snapshot.columns[i % 3][i / 3], values[i]) << i;
    }
  }
}

TEST(VtkXml, ConnectivityIsCheckedAgainstThePoints) {
  const auto with_verts = [](const std::string& connectivity) {
    return replaced(replaced(small_file("1 2"), "Points=\"2\"", "Points=\"2\" NumberOfVerts=\"2\""),
                    "</Piece>",
                    "<Verts><DataArray type='Int32' Name='connectivity'>" + connectivity +
                        "</DataArray>\n<DataArray type='Int32' Name='offsets'>1 2</DataArray>"
                        "</Verts></Piece>");
  };
  EXPECT_EQ(scan_error(with_verts("0 1")), "");
  EXPECT_NE(scan_error(with_verts("0 2")).find("array connectivity: point 2 of 2"),
            std::string::npos);
  EXPECT_NE(scan_error(with_verts("0 -1")).find("array connectivity: point -1 of 2"),
            std::string::npos);
}

TEST(VtkXml, WhatFollowsTheFileIsWorthAWarning) {
  const std::string good = small_file("1 2");
  const FileScan scan = scan_text(good + good);
  ASSERT_EQ(scan.problems.size(), 1U);
  EXPECT_NE(scan.problems[0].find("bytes after </VTKFile>"), std::string::npos);
}

TEST(VtkXml, NestingIsBounded) {
  std::string deep = "<VTKFile type='PolyData'>";
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_NE(scan_error(deep).find("nested deeper than 32"), std::string::npos);
}

// Whatever is done to a file, the reader gives a result or a FormatError.
void survives(const std::string& bytes) {
  const TemporaryFile file(bytes);
  Snapshot snapshot;
  Scratch scratch;
  const Request request = {{"x", false}, {"vz", false}, {"radius", false}, {"stress[9]", false}};
  try {
    vtk_xml.scan(file.path(), true);
  } catch (const FormatError&) {  // told, and that is all
  }
  try {
    vtk_xml.read(file.path(), {}, request, snapshot, scratch);
    for (const auto& column : snapshot.columns) {
      EXPECT_TRUE(column.empty() || column.size() == snapshot.particles);
    }
  } catch (const FormatError&) {
  }
}

// A cut file is told from a damaged one: the last dump of a killed run is left out of its series.
void expect_cut(const std::string& bytes, std::size_t length) {
  const TemporaryFile file(bytes.substr(0, length));
  EXPECT_THROW(vtk_xml.scan(file.path(), true), CutError) << length;
  EXPECT_THROW(vtk_xml.scan(file.path(), false), CutError) << length;
  EXPECT_THROW(read(file.path(), {"x"}), CutError) << length;
}

TEST(VtkXml, ACutFileIsNeverTakenForAWholeOne) {
  for (const fs::path& path : containers()) {
    const std::string bytes = bytes_of(path);
    const std::size_t whole = bytes.rfind("</VTKFile>") + 10;
    for (std::size_t length = 1; length < whole; length += std::size_t{37} * 16) {
      const std::size_t cut = length + 37 * (length / 37 % 16);  // other places in each file
      if (cut >= whole) continue;
      SCOPED_TRACE(path);
      expect_cut(bytes, cut);
    }
  }
  for (const char* name : {"inline_zlib.vtp", "appended_raw_lz4.vtp", "liggghts_write_dump.vtp"}) {
    const std::string bytes = bytes_of(data / name);
    SCOPED_TRACE(name);
    for (std::size_t cut = 0; cut < bytes.rfind("</VTKFile>") + 10; cut += 37) {
      expect_cut(bytes, cut);
    }
  }
}

TEST(VtkXml, DamagedBytesNeverCrashTheReader) {
  std::mt19937 random(20240607);
  for (const fs::path& path : containers()) {
    const std::string bytes = bytes_of(path);
    for (int i = 0; i < 60; ++i) {
      std::string damaged = bytes;
      // The first 3000 bytes hold the tags of appended files: damage there half of the time.
      const std::size_t range = i % 2 == 0 ? bytes.size() : 3000;
      damaged[random() % range] = static_cast<char>(random());
      survives(damaged);
    }
  }
}

// ---- Base64

TEST(Base64, EveryLengthInEveryPieceComesBack) {
  std::string bytes;
  for (int length = 0; length < 60; ++length) {
    // Two streams, one behind the other, and blanks between the characters.
    std::string text;
    for (const char c : encoded(bytes) + encoded(bytes)) text += {c, length % 3 == 0 ? '\n' : c};
    if (length % 3 != 0) text = encoded(bytes) + encoded(bytes);
    for (std::size_t piece = 1; piece < 9; ++piece) {
      Base64Reader reader(text);
      std::string decoded;
      char buffer[8];
      for (std::size_t got = 1; got > 0;) {
        got = reader.read(buffer, piece);
        decoded.append(buffer, got);
      }
      EXPECT_EQ(decoded, bytes + bytes);
      EXPECT_FALSE(reader.damaged());
      EXPECT_LT(reader.left(), 3U);
    }
    bytes += static_cast<char>(37 * length * length + 11);
  }
}

TEST(Base64, AnythingElseIsDamageAndItsPlaceIsKnown) {
  for (const std::string text : {"AAAA!AAA", "AAAAA=AA", "AAAA=AAA", "AAAAAA=A", "AAAA\303AAA"}) {
    Base64Reader reader(text);
    char buffer[16];
    EXPECT_EQ(reader.read(buffer, 16), 3U) << text;
    EXPECT_TRUE(reader.damaged()) << text;
    EXPECT_GE(reader.position(), 4U) << text;
    EXPECT_LT(reader.position(), text.size()) << text;
  }
}

// ---- The developers' corpus, where it is at hand

TEST(VtkXmlCorpus, CountsAndRangesAreThoseOfTheTable) {
  if (!fs::exists(shared / "corpus")) GTEST_SKIP() << "no corpus";
  int particles = 0, others = 0;
  std::map<std::string, Snapshot> read_already;
  for (const auto& row : csv(shared / "corpus" / "expected.csv")) {
    const bool claimed = row[2] == "vtk-vtp" || row[2] == "vtk-vtu" || row[2] == "vtk-vtp-gz" ||
                         row[2] == "vtk-vtr" || row[2] == "vtr misnamed .pvtr";
    const fs::path path = shared / "corpus" / row[0];
    if (!claimed || !fs::exists(path)) continue;
    SCOPED_TRACE(row[0]);
    const FileScan scan = vtk_xml.scan(path.string(), true);
    if (!scan.not_particles.empty()) {
      EXPECT_EQ(row[7], "") << "has radii: " << scan.not_particles;
      ++others;
      continue;
    }
    ++particles;
    EXPECT_EQ(scan.snapshots.at(0).particles, std::stol(row[5]));
    if (!row[4].empty()) {
      EXPECT_EQ(scan.snapshots[0].time, std::stod(row[4]));
    }
    const Snapshot snapshot = read(path.string(), {"x", "y", "z"});
    for (std::size_t axis = 0; axis < 3 && !row[10].empty(); ++axis) {
      const auto [low, high] =
          std::minmax_element(snapshot.columns[axis].begin(), snapshot.columns[axis].end());
      EXPECT_EQ(*low, std::stod(row[10 + 2 * axis]));
      EXPECT_EQ(*high, std::stod(row[11 + 2 * axis]));
    }
  }
  EXPECT_GT(particles, 60);
  EXPECT_GT(others, 150);
}

TEST(VtkXmlCorpus, MalformedFilesGetTheVerdictOfTheTable) {
  if (!fs::exists(shared / "bad")) GTEST_SKIP() << "no malformed files";
  int seen = 0;
  for (const auto& row : csv(shared / "bad" / "EXPECT.csv")) {
    const bool single = row[0].starts_with("xml/") && !row[0].starts_with("xml/pieces/") &&
                        !row[0].starts_with("xml/series_");
    const fs::path path = shared / "bad" / row[0];
    if ((!single && row[0] != "vtk/xml_named_vtk_ok.vtk") || !fs::exists(path)) continue;
    SCOPED_TRACE(row[0]);
    ++seen;
    std::string verdict = "OK", error;
    try {
      const FileScan scan = vtk_xml.scan(path.string(), true);
      if (!scan.problems.empty()) verdict = "WARN";
      read(path.string(), {"x", "radius"});
    } catch (const FormatError& failure) {
      verdict = "ERROR";
      error = failure.what();
    }
    EXPECT_EQ(verdict, row[2]) << error;
    EXPECT_TRUE(error.empty() || error.starts_with(path.string() + ": line ")) << error;
  }
  EXPECT_GE(seen, 15);
}

}  // namespace
}  // namespace bedscope::readers
