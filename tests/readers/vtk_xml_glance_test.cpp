// SPDX-License-Identifier: BSD-3-Clause
// A glance at a large VTK XML file: what its tags tell is what the whole file tells, and bodies are
// jumped over, not read.
#include <zlib.h>

#include <cctype>

#include "readers/base64.hpp"
#include "readers/series.hpp"
#include "readers/vtk_xml.hpp"
#include "tests/readers/openfoam_samples.hpp"

namespace bedscope::readers {
namespace {

using samples::Folder;
using vtk_xml_file::condensed;

std::string base64(std::string_view bytes) {
  constexpr std::string_view alphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : alphabet[group >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string words(std::initializer_list<std::size_t> values) {
  std::string bytes;
  for (const auto value : values)
    for (int k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (8 * k));
  return bytes;
}

std::string body(const std::string& data, bool packed) {
  if (!packed) return base64(words({data.size()}) + data);
  const std::size_t size = 32768;
  std::string sizes, blocks;
  std::size_t count = 0;
  for (std::size_t at = 0; at < data.size(); at += size, ++count) {
    const auto part = data.substr(at, size);
    uLongf length = compressBound(part.size());
    std::string out(length, '\0');
    compress(reinterpret_cast<Bytef*>(out.data()), &length,
             reinterpret_cast<const Bytef*>(part.data()), part.size());
    sizes += words({length});
    blocks += out.substr(0, length);
  }
  return base64(words({count, size, data.size() % size}) + sizes) + base64(blocks);
}

/// `n` vertices with a time, a radius and a ghost array, whose last point is a copy.
std::string vtu(std::size_t n, bool packed, const std::string& gap = "\n") {
  std::string positions(12 * n, '\0'), radius, labels, ends, types(n, '\1'), ghosts(n, '\0');
  std::uint32_t noise = 1;
  for (auto& byte : positions)
    byte = static_cast<char>((noise = noise * 1664525 + 1013904223) >> 28);
  for (std::size_t i = 0; i < n; ++i) {
    radius += std::string("\0\0\0\x3f", 4);
    labels += words({i});
    ends += words({i + 1});
  }
  ghosts.back() = '\1';
  const auto array = [&](const char* type, const char* more, const std::string& data) {
    return fmt::format("<DataArray type='{}' {} format='binary'>{}{}{}</DataArray>", type, more,
                       gap, body(data, packed), gap);
  };
  return fmt::format(
      "<?xml version='1.0'?><VTKFile type='UnstructuredGrid' byte_order='LittleEndian'{}>"
      "<UnstructuredGrid><FieldData><DataArray type='Float32' Name='TimeValue' "
      "NumberOfTuples='1'>0.1</DataArray></FieldData><Piece NumberOfPoints='{}' "
      "NumberOfCells='{}'><PointData>{}{}</PointData><Points>{}</Points><Cells>{}{}{}</Cells>"
      "</Piece></UnstructuredGrid></VTKFile>\n",
      packed ? " compressor='vtkZLibDataCompressor'" : "", n, n,
      array("Float32", "Name='radius'", radius), array("UInt8", "Name='vtkGhostType'", ghosts),
      array("Float32", "NumberOfComponents='3'", positions),
      array("UInt32", "Name='connectivity'", labels), array("UInt32", "Name='offsets'", ends),
      array("UInt8", "Name='types'", types));
}

TEST(Base64, BytesOfAnyLengthComeBack) {
  std::string bytes;
  std::uint32_t noise = 7;
  for (std::size_t size = 0; size < 300; ++size) {
    const auto text = base64(bytes);
    std::string got(size, '\0');
    Base64Reader reader(text);
    EXPECT_EQ(reader.read(got.data(), size), size);
    EXPECT_EQ(got, bytes) << size;
    EXPECT_FALSE(reader.damaged());
    bytes += static_cast<char>((noise = noise * 1664525 + 1013904223) >> 24);
  }
}

TEST(Base64, ACharacterOfNoAlphabetEndsItWhereverItStands) {
  const auto text = base64(std::string(192, '\x5a'));
  for (int c = 0; c < 256; ++c) {
    const bool good = std::isalnum(c) != 0 || c == '+' || c == '/' || c == ' ' || c == '\n' ||
                      c == '\r' || c == '\t';
    for (const std::size_t at : {5U, 31U, 32U, 100U, 254U}) {
      auto other = text;
      other[at] = static_cast<char>(c);
      std::string got(192, '\0');
      Base64Reader reader(other);
      const auto read = reader.read(got.data(), got.size());
      EXPECT_EQ(reader.damaged() || c == '=', !good) << c << " at " << at;
      EXPECT_EQ(got.substr(0, at / 4 * 3), std::string(at / 4 * 3, '\x5a'));
      if (!good) {
        EXPECT_LE(read, at / 4 * 3 + (c == '=' ? 189 : 0));
      }
    }
  }
}

constexpr std::size_t many = 60000;  // positions of 720 kB: every large body spans many windows

TEST(VtkXmlGlance, TagsTellWhatTheFileTells) {
  for (const bool packed : {false, true}) {
    const Folder folder;
    const auto whole = vtu(many, packed);
    for (const auto* name : {"a_1.vtu", "a_2.vtu"}) folder.write(name, whole);
    const auto text = condensed(folder.path("a_1.vtu"));
    ASSERT_TRUE(text.has_value());
    EXPECT_LT(text->size(), 250000U);  // types and ghosts stay: 80 kB each, base64
    const auto document = vtk_xml_file::parse_document(*text, "a", {.condensed = true});
    EXPECT_EQ(document.points(), many);
    const auto series = Series::open(folder.path());  // the last file is read as a whole
    EXPECT_EQ(series.particles(0), series.particles(1));
    EXPECT_EQ(series.located(0).time, static_cast<double>(0.1F));  // a float, as it is
    EXPECT_EQ(series.located(0).ghosts, 1);
    EXPECT_EQ(*series.located(0).parts, *series.located(1).parts);
  }
}

TEST(VtkXmlGlance, WhatIsNotAsExpectedIsReadAsAWhole) {
  const Folder folder;
  const auto whole = vtu(many, false);
  const auto of = [&](const std::string& text) { return condensed(folder.write("b.vtu", text)); };
  EXPECT_TRUE(of(whole).has_value());
  EXPECT_FALSE(of(vtu(100, false)).has_value());  // small
  EXPECT_FALSE(of(whole.substr(0, whole.size() / 2)).has_value());
  auto longer = whole;
  longer.insert(longer.find("radius") + 5000, 4, 'A');  // more than its header says
  EXPECT_FALSE(of(longer).has_value());
  auto broken = whole;
  broken.insert(broken.find("radius") + 5000, 1, '\n');  // a line break inside, as some write
  EXPECT_FALSE(of(broken).has_value());
  folder.write("c_1.vtu", broken);
  folder.write("c_2.vtu", broken);
  std::filesystem::remove(folder.path("b.vtu"));
  EXPECT_EQ(Series::open(folder.path()).particles(0), static_cast<std::int64_t>(many));
}

TEST(VtkXmlGlance, AppendedDataAreNotLookedAt) {
  const Folder folder;
  const std::string radius = words({many * 4}) + std::string(many * 4, '\0');
  const std::string points = words({many * 12}) + std::string(many * 12, '\1');
  const auto vtp = [&](const std::string& end) {
    return fmt::format(
               "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"{0}\" "
               "NumberOfVerts=\"{0}\"><PointData><DataArray type=\"Float32\" Name=\"radius\" "
               "format=\"appended\" offset=\"0\"/></PointData><Points><DataArray type=\"Float32\" "
               "NumberOfComponents=\"3\" format=\"appended\" offset=\"{1}\"/></Points></Piece>"
               "</PolyData><AppendedData encoding=\"raw\">_",
               many, radius.size()) +
           radius + points + end;
  };
  const auto path = folder.write("a.vtp", vtp("</AppendedData></VTKFile>"));
  const auto text = condensed(path);
  ASSERT_TRUE(text.has_value());
  EXPECT_LT(text->size(), 1000U);
  EXPECT_EQ(vtk_xml_file::parse_document(*text, path, {.condensed = true}).points(), many);
  EXPECT_FALSE(condensed(folder.write("a.vtp", vtp("</AppendedD"))).has_value());  // cut
}

}  // namespace
}  // namespace bedscope::readers
