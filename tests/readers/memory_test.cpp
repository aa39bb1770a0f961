// SPDX-License-Identifier: BSD-3-Clause
// A count in a file is a claim. Files of a few hundred bytes that claim 2^40 of something are
// refused (or read without it) with the buffers that any file needs, and no more.
#include <malloc.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "readers/openfoam_blocks.hpp"
#include "readers/openfoam_case.hpp"
#include "readers/openfoam_cloud.hpp"
#include "readers/openfoam_field.hpp"
#include "readers/openfoam_list.hpp"
#include "readers/series.hpp"
#include "readers/survey.hpp"
#include "tests/readers/bin_dump.hpp"
#include "tests/readers/test_files.hpp"

namespace {

std::size_t held = 0, most_held = 0;

void* counted(std::size_t size) {
  void* const memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  held += malloc_usable_size(memory);
  most_held = std::max(most_held, held);
  return memory;
}

void uncounted(void* memory) {
  held -= std::min(held, malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return counted(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return counted(size); }
void operator delete(void* memory) noexcept { uncounted(memory); }
void operator delete[](void* memory) noexcept { uncounted(memory); }
void operator delete(void* memory, std::size_t) noexcept { uncounted(memory); }
void operator delete[](void* memory, std::size_t) noexcept { uncounted(memory); }

namespace bedscope::readers {
namespace {

/// Two windows of 256 kB, a checkpoint, what a message needs; 0.7 MB measured where most is held.
constexpr std::size_t buffers = 2U << 20;

const std::string huge = "1099511627776";  // 2^40

struct Claim {
  const char* name;
  std::string content;
};

/// All that `bedscope info` does with a file, or with a file as one of a folder.
void inform(const std::string& where) { survey(Series::open(where), true); }

template <class Action>
std::size_t memory_of(Action&& action) {
  const auto before = held;
  most_held = held;
  action();
  return most_held - before;
}

std::string vtk(const std::string& rest, const char* coding = "ASCII") {
  return std::string("# vtk DataFile Version 3.0\nt\n") + coding + "\nDATASET POLYDATA\n" + rest;
}

std::string xml(const std::string& points, const std::string& array, const std::string& more = "",
                const std::string& tail = "") {
  return "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\" header_type=\"UInt64\" " + more +
         "><PolyData><Piece NumberOfPoints=\"" + points + "\"><Points>" + array +
         "</Points></Piece></PolyData>" + tail + "</VTKFile>\n";
}

std::vector<Claim> dumps() {
  const auto text = replaced(small_dump(100, 2), "ATOMS\n2\n", "ATOMS\n" + huge + "\n");
  const auto rows = replaced(small_dump(100, 30), "ATOMS\n30\n", "ATOMS\n" + huge + "\n");
  const std::string good = vtk("POINTS 1 float\n0 0 0\n");
  const std::string zeros(3, '\0');
  const auto bin = bin_dump({.chunks = {1}});
  const auto bin_with = [&](std::size_t at, auto claim) {
    auto bytes = bin;
    std::memcpy(bytes.data() + at, &claim, sizeof claim);
    return bytes;
  };
  const std::string points = "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=";
  return {
      {"text", text},
      {"text_rows", rows},  // enough of them for a glance to believe the header
      {"text_rows_gzip", gzip(rows)},
      {"text_several", small_dump(1, 2) + text},
      {"text_gzip", gzip(text)},
      {"bin_particles", bin_with(8, std::int64_t{1} << 40)},
      {"bin_columns", bin_with(92, std::int32_t{1000})},
      {"bin_chunks", bin_with(96, std::int32_t{2'000'000'000})},
      {"bin_chunk", bin_with(100, std::int32_t{2'000'000'000})},
      {"bin_gzip", gzip(bin_with(8, std::int64_t{1} << 40))},
      {"vtk_points", vtk("POINTS " + huge + " float\n0 0 0\n")},
      {"vtk_points_binary", vtk("POINTS " + huge + " float\n" + zeros, "BINARY")},
      {"vtk_points_gzip", gzip(vtk("POINTS " + huge + " double\n" + zeros, "BINARY"))},
      {"vtk_vertices", good + "VERTICES " + huge + " 2\n1 0\n"},
      {"vtk_vertex_size", good + "VERTICES 1 " + huge + "\n1 0\n"},
      {"vtk_cells", replaced(good, "POLYDATA", "UNSTRUCTURED_GRID") +
                        "CELLS 1 2\n1 0\nCELL_TYPES " + huge + "\n1\n"},
      {"vtk_scalars", good + "POINT_DATA 1\nSCALARS a float " + huge + "\nLOOKUP_TABLE d\n0\n"},
      {"vtk_point_data", good + "POINT_DATA " + huge + "\nSCALARS a float 1\nLOOKUP_TABLE d\n0\n"},
      {"vtk_lookup", good + "POINT_DATA 1\nLOOKUP_TABLE t " + huge + "\n0 0 0 0\n"},
      {"vtk_field", good + "POINT_DATA 1\nFIELD F " + huge + "\na 1 1 int\n0\n"},
      {"vtk_field_components", good + "POINT_DATA 1\nFIELD F 1\na " + huge + " 1 int\n0\n"},
      {"vtk_field_tuples", good + "FIELD F 1\na 1 " + huge + " int\n0\n"},
      {"vtk_strings", good + "FIELD F 1\na 1 " + huge + " string\nx\n"},
      {"vtk_information", good + "METADATA\nINFORMATION " + huge + "\n\n"},
      {"vtk_dimensions", replaced(vtk(""), "POLYDATA", "STRUCTURED_POINTS") + "DIMENSIONS " + huge +
                             " " + huge + " 1\n"},
      {"xml_points", xml(huge, points + "\"ascii\">0 0 0</DataArray>")},
      {"xml_base64", xml(huge, points + "\"binary\">AAAAAAAYAAA=AAAA</DataArray>")},
      {"xml_components", xml("1", "<DataArray type=\"Float64\" NumberOfComponents=\"" + huge +
                                      "\" format=\"ascii\">0 0 0</DataArray>")},
      {"xml_appended",
       xml(huge, points + "\"appended\" offset=\"0\"/>", "",
           "<AppendedData encoding=\"raw\">_" + std::string(64, '\1') + "</AppendedData>")},
      {"xml_blocks",
       xml(huge, points + "\"appended\" offset=\"0\"/>", "compressor=\"vtkLZMADataCompressor\"",
           "<AppendedData encoding=\"raw\">_" + std::string(64, '\1') + "</AppendedData>")},
      {"xml_verts", replaced(xml("1", points + "\"ascii\">0 0 0</DataArray>"), "<Piece ",
                             "<Piece NumberOfVerts=\"" + huge + "\" ")},
  };
}

/// A file that belongs to the same series.
std::string good_beside(const Claim& claim, std::int64_t step) {
  const std::string name = claim.name;
  if (name.starts_with("text")) return small_dump(step, 2);
  if (name.starts_with("bin")) return bin_dump({.step = step});
  if (name.starts_with("vtk")) return small_vtk(2);
  return xml("1", "<DataArray type=\"Float64\" NumberOfComponents=\"3\">0 0 0</DataArray>");
}

class Memory : public testing::TestWithParam<Claim> {
 protected:
  TemporaryFolder folder;
};

class DumpMemory : public Memory {};

TEST_P(DumpMemory, HugeClaimsCostNothing) {
  const auto path = folder.write("dump_100", GetParam().content);
  std::string error;
  const auto used = memory_of([&] { error = error_of([&] { inform(path); }); });
  RecordProperty("bytes", std::to_string(used));
  EXPECT_LT(used, buffers) << error;
  // In the middle of a series only the header is looked at before the rows are read.
  for (const int step : {50, 200})
    folder.write(fmt::format("dump_{}", step), good_beside(GetParam(), step));
  EXPECT_LT(memory_of([&] { error = error_of([&] { inform(folder.path()); }); }), buffers);
  EXPECT_TRUE(error.empty() || error.find("dump_100") != error.npos) << error;
}

INSTANTIATE_TEST_SUITE_P(Readers, DumpMemory, testing::ValuesIn(dumps()),
                         [](const auto& claim) { return std::string(claim.param.name); });

TEST(Memory, OfSnapshotsWithoutParticlesIsAFewTimesTheirBytesHoweverManyColumnsTheyClaim) {
  TemporaryFolder folder;
  std::string bytes;
  for (std::int32_t step = 0; step < 1000; ++step) {
    auto one = bin_dump({.step = step, .chunks = {}});
    const std::int32_t columns = 999 + step % 2;
    std::memcpy(one.data() + 92, &columns, sizeof columns);
    bytes += one;
  }
  const auto path = folder.write("dump.bin", bytes);
  EXPECT_LT(memory_of([&] { error_of([&] { Series::open(path); }); }), buffers + 64 * bytes.size());
}

std::string foam(const std::string& class_name, const std::string& rest,
                 const std::string& format = "ascii") {
  return "FoamFile { format " + format + "; class " + class_name +
         "; arch \"LSB;label=32;scalar=64\"; }\n" + rest;
}

std::vector<Claim> foam_files() {
  std::vector<Claim> claims;
  for (const char* format : {"ascii", "binary"}) {
    const bool ascii = *format == 'a';
    const auto add = [&](const char* name, const std::string& class_name, const std::string& rest) {
      static std::vector<std::string> names;
      names.reserve(100);  // Claim keeps pointers
      claims.push_back({names.emplace_back(std::string(name) + "_" + format).c_str(),
                        foam(class_name, rest, format)});
    };
    const std::string numbers = ascii ? "0 0 0 0" : std::string(32, '\0');
    add("scalars", "scalarField", huge + "(" + numbers + ")");
    add("tensors", "tensorField", huge + "(" + numbers + ")");
    add("labels", "labelList", huge + "(" + numbers + ")");
    add("uniform", "scalarField", huge + "{0}");
    add("uniform_labels", "labelList", huge + "{0}");
    add("faces", ascii ? "faceList" : "faceCompactList", huge + "(" + numbers + ")");
    add("face", ascii ? "faceList" : "faceCompactList",
        ascii ? "1(" + huge + "(0 1))"
              : "2(" + std::string("\0\0\0\0\xff\xff\xff\x7f", 8) + ")\n4(0)");
    add("parcels", "Cloud<x>", huge + "(" + numbers + ")");
    add("field", "volScalarField",
        "dimensions [0 0 0 0 0 0 0]; internalField nonuniform List<scalar> " + huge + "(" +
            numbers + ");");
    add("uniform_field", "volScalarField",
        "internalField nonuniform List<scalar> " + huge + "{0};");
    add("boundary", "volScalarField",
        "internalField uniform 0; boundaryField { a { value nonuniform List<scalar> " + huge + "(" +
            numbers + "); } }");
    add("collated", "decomposedBlockData", huge + "(" + numbers + ")");
  }
  return claims;
}

class FoamMemory : public Memory {};

/// Every way in which a file of OpenFOAM is read.
void read_as_everything(const std::string& path) {
  const auto with = [&](auto&& read) {
    error_of([&] {
      FoamBlocks file(path);
      file.next();
      read(file);
    });
  };
  std::vector<double> values;
  std::vector<std::int32_t> labels, starts;
  FieldValues field;
  CloudPoints points;
  const CloudMesh mesh;
  for (const auto& type : foam_types)
    with([&](FoamBlocks& file) {
      read_values(file.stream(), layout_of(file.header(), path), type, {}, values);
    });
  with([&](FoamBlocks& file) {
    read_labels(file.stream(), layout_of(file.header(), path), labels);
  });
  for (const bool compact : {false, true})
    with([&](FoamBlocks& file) {
      read_faces(file.stream(), layout_of(file.header(), path), compact, starts, labels);
    });
  with([&](FoamBlocks& file) { read_field(file, {}, field); });
  with([&](FoamBlocks& file) { read_field(file, FoamCount{5}, field); });
  with([&](FoamBlocks& file) {
    read_cloud_points(
        file, [&]() -> const CloudMesh& { return mesh; }, points);
  });
  error_of([&] { read_dictionary(path); });
}

TEST_P(FoamMemory, HugeClaimsCostNothing) {
  for (const bool compressed : {false, true}) {
    const auto& content = GetParam().content;
    const auto path = folder.write("file", compressed ? gzip(content) : content);
    EXPECT_LT(memory_of([&] { read_as_everything(path); }), buffers) << compressed;
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, FoamMemory, testing::ValuesIn(foam_files()),
                         [](const auto& claim) { return std::string(claim.param.name); });

// ---- The developers' malformed files, each much smaller than the bound

TEST(BadFiles, NoneCostsMoreThanAFewTimesItsBytes) {
  const auto bad = fs::path(BEDSCOPE_SHARED) / "bad";
  if (!fs::exists(bad)) GTEST_SKIP() << "no folder of malformed files";
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(bad)) {
    if (!entry.is_regular_file()) continue;
    const auto path = entry.path().string();
    const bool foam_file = path.find("/of/") != path.npos;
    const auto used = memory_of(
        [&] { foam_file ? read_as_everything(path) : (void)error_of([&] { inform(path); }); });
    EXPECT_LT(used, buffers + 64 * entry.file_size()) << path;
    ++files;
  }
  for (const auto& entry : fs::directory_iterator(bad / "of")) {
    const auto used = memory_of([&] {
      error_of([&] {
        const auto flow = OpenFoamCase::open(entry.path().string());
        const auto last = flow.times().size() - 1;
        FieldValues values;
        for (const auto& field : flow.fields_at(last)) flow.read(last, field, values);
        Snapshot parcels;
        for (const auto& cloud : flow.clouds_at(last))
          flow.read_cloud(last, cloud, {{"x"}, {"d", false}}, parcels);
      });
    });
    EXPECT_LT(used, 2 * buffers) << entry.path();  // a mesh of 200 cells, its files open
  }
  EXPECT_GT(files, 100U);
}

}  // namespace
}  // namespace bedscope::readers
