// SPDX-License-Identifier: BSD-3-Clause
// VTK's own legacy readers and writers as judge: the same numbers, bit for bit.
#include <vtkCellArray.h>
#include <vtkCharArray.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkLongArray.h>
#include <vtkLongLongArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkPolyDataWriter.h>
#include <vtkShortArray.h>
#include <vtkSignedCharArray.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedIntArray.h>
#include <vtkUnsignedLongArray.h>
#include <vtkUnsignedShortArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkUnstructuredGridWriter.h>

#include <cmath>
#include <random>

#include "readers/source.hpp"
#include "tests/readers/test_files.hpp"
#include "tests/readers/vtk_judge.hpp"

namespace bedscope::readers {

extern const Form vtk_legacy;

namespace {

template <class Reader>
vtkSmartPointer<vtkPointSet> judge_as(const std::string& path) {
  const auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(path.c_str());
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllFieldsOn();
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkPointSet> judge(const std::string& path) {
  return read_head(path).find("DATASET UNSTRUCTURED_GRID") == std::string::npos
             ? judge_as<vtkPolyDataReader>(path)
             : judge_as<vtkUnstructuredGridReader>(path);
}

struct Tally {
  std::size_t files = 0, numbers = 0;
};

Tally judge_folder(const fs::path& folder) {
  Tally tally;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string path = entry.path().string();
    if (!entry.is_regular_file() || !path.ends_with(".vtk")) continue;
    if (!vtk_legacy.matches(read_head(path))) continue;
    SCOPED_TRACE(path);
    const auto scan = vtk_legacy.scan(path, true);
    if (!scan.not_particles.empty() || scan.snapshots.at(0).particles == 0) continue;
    tally.numbers += compare(vtk_legacy, path, *judge(path));
    ++tally.files;
  }
  return tally;
}

TEST(VtkLegacyJudge, VtkReadsTheSameBitsFromTheFixtures) {
  const auto tally = judge_folder(fs::path(BEDSCOPE_TEST_DATA) / "vtk_legacy");
  EXPECT_EQ(tally.files, 2U);
  EXPECT_EQ(tally.numbers, 64U * (3 + 2 + 3 + 3 + 1) + 51U * 6);
}

TEST(VtkLegacyJudge, VtkReadsTheSameBitsFromTheCorpus) {
  const fs::path corpus = fs::path(BEDSCOPE_SHARED) / "corpus";
  if (!fs::exists(corpus)) GTEST_SKIP() << "no corpus";
  const auto tally = judge_folder(corpus);
  std::printf("%zu files, %zu numbers\n", tally.files, tally.numbers);
  EXPECT_GT(tally.files, 35U);
}

template <class Array>
void add_array(vtkPointData& data, const char* name, int components, vtkIdType tuples,
               std::mt19937_64& random) {
  const auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < tuples * components; ++i) {
    using Value = typename Array::ValueType;
    if constexpr (std::is_floating_point_v<Value>)
      array->SetValue(i, static_cast<Value>(std::ldexp(static_cast<double>(random()),
                                                       -64 - static_cast<int>(random() % 60))));
    else
      array->SetValue(i, static_cast<Value>(random() >> 11));  // 53 bits: a double can hold them
  }
  data.AddArray(array);
}

/// Arrays of every type and of every attribute that VTK writes.
void fill(vtkPointSet& set, vtkIdType n) {
  std::mt19937_64 random(1);
  const auto points = vtkSmartPointer<vtkPoints>::New();
  for (vtkIdType i = 0; i < n; ++i)
    points->InsertNextPoint(static_cast<double>(i) * .1, std::sin(static_cast<double>(i)), 1e-6);
  set.SetPoints(points);
  auto& data = *set.GetPointData();
  add_array<vtkDoubleArray>(data, "radius", 1, n, random);
  add_array<vtkDoubleArray>(data, "v", 3, n, random);
  add_array<vtkFloatArray>(data, "normals", 3, n, random);
  add_array<vtkDoubleArray>(data, "quat", 9, n, random);
  add_array<vtkDoubleArray>(data, "texture", 2, n, random);
  add_array<vtkIdTypeArray>(data, "global", 1, n, random);
  data.SetActiveScalars("radius");
  data.SetActiveVectors("v");
  data.SetActiveTensors("quat");
  data.SetActiveAttribute("texture", vtkDataSetAttributes::TCOORDS);
  add_array<vtkCharArray>(data, "char", 1, n, random);
  add_array<vtkSignedCharArray>(data, "schar", 1, n, random);
  add_array<vtkUnsignedCharArray>(data, "uchar", 3, n, random);
  add_array<vtkShortArray>(data, "short", 1, n, random);
  add_array<vtkUnsignedShortArray>(data, "ushort", 2, n, random);
  add_array<vtkIntArray>(data, "int", 4, n, random);
  add_array<vtkUnsignedIntArray>(data, "uint", 1, n, random);
  add_array<vtkLongArray>(data, "long", 1, n, random);
  add_array<vtkUnsignedLongArray>(data, "ulong", 1, n, random);
  add_array<vtkLongLongArray>(data, "longlong", 1, n, random);
  add_array<vtkFloatArray>(data, "a float, 50% \"wide\"\tand more", 5, n, random);
  const auto words = vtkSmartPointer<vtkStringArray>::New();
  words->SetName("element");
  for (vtkIdType i = 0; i < n; ++i)
    words->InsertNextValue(i % 5 == 0   ? ""
                           : i % 5 == 1 ? "two words\nPOINT_DATA 3"
                                        : std::string(static_cast<std::size_t>(i * 7), 'e'));
  data.AddArray(words);
  add_array<vtkDoubleArray>(data, "last", 1, n, random);
  data.GetArray("last")->SetComponentName(0, "a component");
  data.GetArray("last")->GetRange();  // leaves METADATA in the file
}

template <class Writer>
void write(vtkPointSet& set, const std::string& path, bool binary, int version) {
  const auto writer = vtkSmartPointer<Writer>::New();
  writer->SetFileName(path.c_str());
  writer->SetInputData(&set);
  if (binary)
    writer->SetFileTypeToBinary();
  else
    writer->SetFileTypeToASCII();
  writer->SetFileVersion(version);
  ASSERT_EQ(writer->Write(), 1);
}

TEST(VtkLegacyJudge, WhateverVtkWritesIsReadAsVtkReadsIt) {
  const TemporaryFolder folder;
  constexpr vtkIdType n = 300;
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (vtkIdType i = 0; i < n; ++i) cells->InsertNextCell(1, &i);
  const auto poly = vtkSmartPointer<vtkPolyData>::New();
  fill(*poly, n);
  poly->SetVerts(cells);
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  fill(*grid, n);
  grid->SetCells(VTK_VERTEX, cells);
  const auto path = folder.path("dump.vtk");
  for (const bool binary : {false, true})
    for (const int version : {vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2,
                              vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1}) {
      SCOPED_TRACE(fmt::format("{} {}", binary ? "binary" : "ascii", version));
      write<vtkPolyDataWriter>(*poly, path, binary, version);
      const auto from_poly = judge(path);
      ASSERT_GE(from_poly->GetPointData()->GetNumberOfArrays(), 18);
      EXPECT_EQ(compare(vtk_legacy, path, *from_poly), 300U * 44);
      write<vtkUnstructuredGridWriter>(*grid, path, binary, version);
      EXPECT_EQ(compare(vtk_legacy, path, *judge(path)), 300U * 44);
    }
}

}  // namespace
}  // namespace bedscope::readers
