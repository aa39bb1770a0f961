// SPDX-License-Identifier: BSD-3-Clause
// A .vtu of particles in base64 + zlib, as LIGGGHTS with `compressor zlib` and ParaView write it:
// our reader against VTK's, and against libdeflate alone on the same compressed blocks. CPU time of
// one thread; in a round each runs once, a ratio is taken within a round, medians are shown.
//
// Usage: vtu_bench [PARTICLES [ROUNDS]]
#include <libdeflate.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "readers/base64.hpp"
#include "readers/series.hpp"

namespace {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class What>
double seconds(What&& what) {
  const double begin = cpu_seconds();
  what();
  return cpu_seconds() - begin;
}

/// id, type, radius, v and f beside float positions: numbers with all their digits, as a run has.
void write_file(const std::string& path, int particles) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  vtkNew<vtkIntArray> id, type;
  vtkNew<vtkDoubleArray> v, f, radius;
  id->SetName("id");
  type->SetName("type");
  v->SetName("v");
  v->SetNumberOfComponents(3);
  f->SetName("f");
  f->SetNumberOfComponents(3);
  radius->SetName("radius");
  vtkNew<vtkCellArray> cells;
  for (vtkIdType i = 0; i < particles; ++i) {
    points->InsertNextPoint(0.07 * uniform(random), 0.006 * uniform(random),
                            1.57 * uniform(random));
    id->InsertNextValue(static_cast<int>(i) + 1);
    type->InsertNextValue(1 + static_cast<int>(i % 2));
    v->InsertNextTuple3(uniform(random), uniform(random), uniform(random));
    f->InsertNextTuple3(1e-6 * uniform(random), 1e-6 * uniform(random), 1e-6 * uniform(random));
    radius->InsertNextValue(i % 2 == 0 ? 0.0005 : 0.00085);
    cells->InsertNextCell(1, &i);
  }
  grid->SetPoints(points);
  grid->SetCells(VTK_VERTEX, cells);
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{id, type, v, f, radius})
    grid->GetPointData()->AddArray(array);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetFileName(path.c_str());
  writer->SetDataModeToBinary();
  writer->SetCompressorTypeToZLib();
  writer->Write();
}

struct Block {
  std::string packed;
  std::size_t size;
};

/// The compressed blocks of all arrays, out of base64; UInt32 headers.
std::vector<Block> blocks_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream all;
  all << file.rdbuf();
  const std::string text = all.str();
  std::vector<Block> found;
  for (std::size_t at = 0; (at = text.find("format=\"binary\"", at)) != text.npos;) {
    at = text.find('>', at) + 1;
    bedscope::readers::Base64Reader data(
        std::string_view(text).substr(at, text.find('<', at) - at));
    const auto word = [&] {
      std::uint32_t value = 0;
      data.read(reinterpret_cast<char*>(&value), 4);
      return value;
    };
    const auto count = word(), size = word(), last = word();
    const auto first = found.size();
    for (std::uint32_t k = 0; k < count; ++k)
      found.push_back({std::string(word(), '\0'), k + 1 == count && last > 0 ? last : size});
    for (auto k = first; k < found.size(); ++k)
      data.read(found[k].packed.data(), found[k].packed.size());
  }
  return found;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  using namespace bedscope::readers;
  const int particles = argc > 1 ? std::atoi(argv[1]) : 500000;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 15;
  const auto path = (std::filesystem::temp_directory_path() / "bedscope_bench.vtu").string();
  write_file(path, particles);
  const auto blocks = blocks_of(path);
  std::size_t packed = 0, unpacked = 0, largest = 0;
  for (const auto& block : blocks) {
    packed += block.packed.size();
    unpacked += block.size;
    largest = std::max(largest, block.size);
  }
  const auto series = Series::open(path);
  Request request{{"x"}, {"y"}, {"z"}, {"id"}, {"type"}, {"radius"}};
  for (const auto* name : {"vx", "vy", "vz", "fx", "fy", "fz"}) request.push_back({name});
  Snapshot snapshot;
  Scratch scratch;
  std::string out(largest, '\0');
  auto* const inflater = libdeflate_alloc_decompressor();
  std::vector<double> ours, vtks, deflate, zlib, by_vtk, by_deflate;
  bool good = true;
  for (int round = 0; round < rounds; ++round) {
    ours.push_back(seconds([&] { series.read(0, request, snapshot, scratch); }));
    vtks.push_back(seconds([&] {
      vtkNew<vtkXMLUnstructuredGridReader> reader;
      reader->SetFileName(path.c_str());
      reader->Update();
      good = good && reader->GetOutput()->GetNumberOfPoints() == particles;
    }));
    deflate.push_back(seconds([&] {
      for (const auto& block : blocks)
        good = good &&
               libdeflate_zlib_decompress(inflater, block.packed.data(), block.packed.size(),
                                          out.data(), block.size, nullptr) == LIBDEFLATE_SUCCESS;
    }));
    zlib.push_back(seconds([&] {
      for (const auto& block : blocks) {
        uLongf length = block.size;
        good = good && uncompress(reinterpret_cast<Bytef*>(out.data()), &length,
                                  reinterpret_cast<const Bytef*>(block.packed.data()),
                                  block.packed.size()) == Z_OK;
      }
    }));
    by_vtk.push_back(vtks.back() / ours.back());
    by_deflate.push_back(ours.back() / deflate.back());
  }
  libdeflate_free_decompressor(inflater);
  good = good && snapshot.particles == static_cast<std::size_t>(particles);
  std::printf("%d particles, %.1f MB on disk, %.1f MB compressed, %.1f MB in %zu blocks%s\n",
              particles, 1e-6 * static_cast<double>(std::filesystem::file_size(path)),
              1e-6 * static_cast<double>(packed), 1e-6 * static_cast<double>(unpacked),
              blocks.size(), good ? "" : ": NOT READ RIGHT");
  std::printf(
      "ms of CPU, median of %d rounds: ours %.1f, VTK %.1f, libdeflate alone %.1f, zlib alone "
      "%.1f\n",
      rounds, 1e3 * median(ours), 1e3 * median(vtks), 1e3 * median(deflate), 1e3 * median(zlib));
  std::printf("VTK / ours %.2f, ours / libdeflate %.2f\n", median(by_vtk), median(by_deflate));
  std::filesystem::remove(path);
  return good ? 0 : 1;
}
