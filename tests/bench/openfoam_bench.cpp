// SPDX-License-Identifier: BSD-3-Clause
// How fast one thread reads OpenFOAM fields, as ratios taken in one run: a binary field of vectors
// against `cat` of the same warm file, ascii in MB/s, decomposed and collated cases against the
// whole one. Makes its input in a temporary folder (400 MB), CPU times, best of the rounds.
//
//   openfoam_bench [rounds]
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "readers/openfoam_case.hpp"

namespace {

namespace fs = std::filesystem;
using namespace bedscope::readers;

constexpr std::array<std::int32_t, 3> grid{100, 100, 50};  // 500,000 cells
constexpr std::size_t ranks = 4;                           // 2 x 2 x 1, as `simple` cuts it

std::string header(std::string_view class_name, bool binary, std::string_view note = "") {
  return fmt::format(
      "FoamFile {{ version 2.0; format {}; arch \"LSB;label=32;scalar=64\"; class {}; note \"{}\"; "
      "object x; }}\n",
      binary ? "binary" : "ascii", class_name, note);
}

template <class T>
std::string binary_list(const std::vector<T>& values, std::size_t components) {
  std::string text = fmt::format("{}\n(", values.size() / components);
  text.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  return text + ")\n";
}

void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

// The files of a box grid of cells from `low` to `high`, by name: headers apart from data.
struct File {
  std::string name, class_name, note, data;
};

std::vector<File> mesh_files(const std::array<std::int32_t, 3>& low,
                             const std::array<std::int32_t, 3>& high) {
  std::array<std::int32_t, 3> n{};
  for (std::size_t a = 0; a < 3; ++a) n[a] = high[a] - low[a];
  const auto point = [&](std::int32_t i, std::int32_t j, std::int32_t k) {
    return i + (n[0] + 1) * (j + (n[1] + 1) * k);
  };
  const auto cell = [&](std::int32_t i, std::int32_t j, std::int32_t k) {
    return i + n[0] * (j + n[1] * k);
  };
  std::vector<double> points;
  for (std::int32_t k = 0; k <= n[2]; ++k)
    for (std::int32_t j = 0; j <= n[1]; ++j)
      for (std::int32_t i = 0; i <= n[0]; ++i)
        for (const auto x : {low[0] + i, low[1] + j, low[2] + k}) points.push_back(1e-3 * x);
  std::vector<std::int32_t> corners, owner, neighbour;
  for (const bool inner : {true, false})
    for (std::int32_t k = 0; k <= n[2]; ++k)
      for (std::int32_t j = 0; j <= n[1]; ++j)
        for (std::int32_t i = 0; i <= n[0]; ++i) {
          const std::array<std::int32_t, 3> at{i, j, k};
          const std::array<std::array<std::int32_t, 4>, 3> square{
              {{point(i, j, k), point(i, j + 1, k), point(i, j + 1, k + 1), point(i, j, k + 1)},
               {point(i, j, k), point(i, j, k + 1), point(i + 1, j, k + 1), point(i + 1, j, k)},
               {point(i, j, k), point(i + 1, j, k), point(i + 1, j + 1, k), point(i, j + 1, k)}}};
          for (std::size_t a = 0; a < 3; ++a) {  // the face below the cell along a
            const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
            if (at[b] == n[b] || at[c] == n[c]) continue;
            auto below = at;
            --below[a];
            const bool first = at[a] == 0, last = at[a] == n[a];
            if ((first || last) == inner) continue;
            auto face = square[a];
            if (first) std::reverse(face.begin(), face.end());  // out of its owner
            corners.insert(corners.end(), face.begin(), face.end());
            owner.push_back(first ? cell(i, j, k) : cell(below[0], below[1], below[2]));
            if (inner) neighbour.push_back(cell(i, j, k));
          }
        }
  std::vector<std::int32_t> starts(owner.size() + 1);
  for (std::size_t f = 0; f < starts.size(); ++f) starts[f] = static_cast<std::int32_t>(4 * f);
  const auto note = fmt::format("nCells:{}", n[0] * n[1] * n[2]);
  return {{"points", "vectorField", "", binary_list(points, 3)},
          {"faces", "faceCompactList", "", binary_list(starts, 1) + binary_list(corners, 1)},
          {"owner", "labelList", note, binary_list(owner, 1)},
          {"neighbour", "labelList", note, binary_list(neighbour, 1)}};
}

std::vector<double> velocities(const std::vector<std::int32_t>& cells) {
  std::vector<double> values;
  for (const auto cell : cells)
    for (int k = 1; k <= 3; ++k) values.push_back(std::sin(k * 0.37 * cell));
  return values;
}

File field_file(const std::vector<std::int32_t>& cells, bool binary) {
  const auto values = velocities(cells);
  std::string list;
  if (binary) {
    list = binary_list(values, 3);
  } else {
    list = fmt::format("{}\n(\n", cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c)
      list += fmt::format("({:.6g} {:.6g} {:.6g})\n", values[3 * c], values[3 * c + 1],
                          values[3 * c + 2]);
    list += ")\n";
  }
  return {"U", "volVectorField", "",
          "dimensions [0 1 -1 0 0 0 0];\ninternalField nonuniform List<vector> " + list +
              ";\nboundaryField { }\n"};
}

void write_plain(const fs::path& folder, const File& file, bool binary) {
  write(folder / file.name, header(file.class_name, binary, file.note) + file.data);
}

// One file of the blocks of all ranks; the first has the header of the data.
void write_collated(const fs::path& folder, const std::vector<File>& files) {
  std::string text = header("decomposedBlockData", true);
  for (std::size_t rank = 0; rank < files.size(); ++rank) {
    const auto& file = files[rank];
    const auto block = (rank == 0 ? header(file.class_name, true, file.note) : "") + file.data;
    text += fmt::format("\n// Processor{}\n\n{}\n({})\n", rank, block.size(), block);
  }
  write(folder / files.front().name, text);
}

void write_cases(const fs::path& folder) {
  std::vector<std::int32_t> all(static_cast<std::size_t>(grid[0] * grid[1] * grid[2]));
  for (std::size_t c = 0; c < all.size(); ++c) all[c] = static_cast<std::int32_t>(c);
  for (const auto& file : mesh_files({0, 0, 0}, grid))
    for (const auto* name : {"binary", "ascii"})
      write_plain(folder / name / "constant/polyMesh", file, true);
  write_plain(folder / "binary/1", field_file(all, true), true);
  write_plain(folder / "ascii/1", field_file(all, false), false);

  std::vector<std::vector<File>> of_rank;
  for (std::int32_t y = 0; y < 2; ++y)
    for (std::int32_t x = 0; x < 2; ++x) {
      const std::array<std::int32_t, 3> low{x * grid[0] / 2, y * grid[1] / 2, 0},
          high{(x + 1) * grid[0] / 2, (y + 1) * grid[1] / 2, grid[2]};
      std::vector<std::int32_t> cells;
      for (auto k = low[2]; k < high[2]; ++k)
        for (auto j = low[1]; j < high[1]; ++j)
          for (auto i = low[0]; i < high[0]; ++i) cells.push_back(i + grid[0] * (j + grid[1] * k));
      auto files = mesh_files(low, high);
      files.push_back({"cellProcAddressing", "labelList", "", binary_list(cells, 1)});
      const auto rank = folder / "separate" / fmt::format("processor{}", of_rank.size());
      for (const auto& file : files) write_plain(rank / "constant/polyMesh", file, true);
      files.push_back(field_file(cells, true));
      write_plain(rank / "1", files.back(), true);
      of_rank.push_back(std::move(files));
    }
  const auto collated = folder / "collated" / fmt::format("processors{}", ranks);
  for (std::size_t f = 0; f < of_rank.front().size(); ++f) {
    std::vector<File> blocks;
    for (const auto& files : of_rank) blocks.push_back(files[f]);
    write_collated(collated / (blocks.front().name == "U" ? "1" : "constant/polyMesh"), blocks);
  }
}

double cpu_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What `cat` does: read() in pieces of 128 kB into one buffer.
void read_like_cat(const std::string& path) {
  static std::vector<char> buffer(1U << 17);
  const int file = ::open(path.c_str(), O_RDONLY);
  while (::read(file, buffer.data(), buffer.size()) > 0) {
  }
  ::close(file);
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 15;
  const auto folder = fs::temp_directory_path() / fmt::format("bedscope_bench_{}", ::getpid());
  write_cases(folder);
  struct Contestant {
    std::string name;
    std::function<void()> run;
    double best = std::numeric_limits<double>::infinity();
  };
  std::vector<Contestant> all;
  const auto file = (folder / "binary/1/U").string();
  all.push_back({"cat", [&] { read_like_cat(file); }});
  std::vector<std::vector<double>> values;
  for (const auto* name : {"binary", "separate", "collated", "ascii"}) {
    const auto foam = OpenFoamCase::open((folder / name).string());
    auto out = std::make_shared<FieldValues>();
    all.push_back({name, [foam, out] { foam.read(0, "U", *out); }});
    foam.read(0, "U", *out);
    values.push_back(out->values);
  }
  const bool same = values[1] == values[0] && values[2] == values[0];
  for (int round = 0; round < rounds; ++round)
    for (auto& one : all) {
      const double start = cpu_seconds();
      one.run();
      one.best = std::min(one.best, cpu_seconds() - start);
    }
  const auto best = [&](std::size_t k) { return all[k].best; };
  for (const auto& one : all) fmt::print("{:<10} {:8.2f} ms\n", one.name, 1e3 * one.best);
  fmt::print("binary / cat        {:.2f}\n", best(1) / best(0));
  fmt::print("separate / binary   {:.2f}\n", best(2) / best(1));
  fmt::print("collated / binary   {:.2f}\n", best(3) / best(1));
  fmt::print("ascii               {:.0f} MB/s\n",
             1e-6 * static_cast<double>(fs::file_size(folder / "ascii/1/U")) / best(4));
  fmt::print("ranks hold the values of the whole: {}\n", same ? "yes" : "no");
  fs::remove_all(folder);
  return same ? 0 : 1;
}
