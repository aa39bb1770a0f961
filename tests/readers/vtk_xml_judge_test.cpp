// SPDX-License-Identifier: BSD-3-Clause
// VTK's own XML reader as judge: the same numbers, bit for bit, for every file that both read.
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <filesystem>

#include "readers/source.hpp"
#include "readers/vtk_xml.hpp"
#include "tests/readers/vtk_judge.hpp"

namespace bedscope::readers {

extern const Form vtk_xml;

namespace {

namespace fs = std::filesystem;

template <class Reader>
vtkSmartPointer<vtkPointSet> judge_as(const std::string& path) {
  const auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

struct Tally {
  std::size_t files = 0, numbers = 0, refused_by_vtk = 0;
};

void judge_folder(const fs::path& folder, Tally& tally) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string path = entry.path().string();
    if (!entry.is_regular_file() || (!path.ends_with(".vtp") && !path.ends_with(".vtu"))) continue;
    const std::string type = xml_root_type(read_head(path));
    if (type != "PolyData" && type != "UnstructuredGrid") continue;
    SCOPED_TRACE(path);
    const FileScan scan = vtk_xml.scan(path, true);
    if (!scan.not_particles.empty()) continue;
    const auto judge = type == "PolyData" ? judge_as<vtkXMLPolyDataReader>(path)
                                          : judge_as<vtkXMLUnstructuredGridReader>(path);
    if (judge->GetNumberOfPoints() == 0 && scan.snapshots.at(0).particles > 0) {
      // VTK 9.1 refuses Name="" (LIGGGHTS' xu yu zu).
      const auto& names = *scan.snapshots[0].columns;
      EXPECT_NE(std::find(names.begin(), names.end(), "(unnamed)"), names.end());
      ++tally.refused_by_vtk;
      continue;
    }
    tally.numbers += compare(vtk_xml, path, *judge);
    ++tally.files;
  }
}

TEST(VtkXmlJudge, VtkReadsTheSameBitsFromTheFixtures) {
  Tally tally;
  judge_folder(fs::path(BEDSCOPE_TEST_DATA) / "vtk_xml", tally);
  EXPECT_EQ(tally.files, 20U);
  EXPECT_GT(tally.numbers, 15000U);
}

TEST(VtkXmlJudge, VtkReadsTheSameBitsFromTheCorpus) {
  const fs::path corpus = fs::path(BEDSCOPE_SHARED) / "corpus";
  if (!fs::exists(corpus)) GTEST_SKIP() << "no corpus";
  Tally tally;
  judge_folder(corpus, tally);
  std::printf("%zu files, %zu numbers, %zu files that VTK refuses\n", tally.files, tally.numbers,
              tally.refused_by_vtk);
  EXPECT_GT(tally.files, 60U);
}

}  // namespace
}  // namespace bedscope::readers
