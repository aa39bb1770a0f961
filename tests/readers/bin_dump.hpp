// SPDX-License-Identifier: BSD-3-Clause
// Binary dumps for tests, built after the layout that readers/liggghts_bin.cpp describes.
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace bedscope::readers {

struct BinDump {
  std::int64_t step = 0;
  std::int32_t triclinic = 0;
  std::array<std::int32_t, 6> boundary{1, 1, 1, 1, 1, 1};
  std::vector<std::int32_t> chunks{2, 1};  ///< particles in each
  std::int32_t revision = 0;               ///< 1, 2: as newer LAMMPS
  double time = 0;
};

/// The value of a column (id, x, y, z) of a row.
inline double bin_value(std::size_t row, std::size_t column) {
  return column == 0 ? static_cast<double>(row + 1)
                     : (static_cast<double>(row % 97) + 0.1) / static_cast<double>(column + 97);
}

inline std::string bin_dump(const BinDump& dump) {
  std::string bytes;
  const auto put = [&bytes](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const auto put_text = [&](const std::string& text) {
    put(static_cast<std::int32_t>(text.size()));
    bytes += text;
  };
  if (dump.revision > 0) {
    put(std::int64_t{-10});
    bytes += "DUMPCUSTOM";
    put(std::int32_t{1});
    put(dump.revision);
  }
  put(dump.step);
  put(std::accumulate(dump.chunks.begin(), dump.chunks.end(), std::int64_t{0}));
  put(dump.triclinic);
  for (const auto side : dump.boundary) put(side);
  for (const double side : {-1., 1., -2., 2., -3., 3.}) put(side);
  if (dump.triclinic != 0)
    for (const double tilt : {0.5, 0.25, 0.125}) put(tilt);
  put(std::int32_t{4});
  if (dump.revision > 1) {
    put_text("si");
    put(char{1});
    put(dump.time);
    put_text("id x y z");
  }
  put(static_cast<std::int32_t>(dump.chunks.size()));
  std::size_t row = 0;
  for (const auto particles : dump.chunks) {
    put(particles * 4);
    for (std::int32_t k = 0; k < particles; ++k, ++row)
      for (std::size_t column = 0; column < 4; ++column) put(bin_value(row, column));
  }
  return bytes;
}

}  // namespace bedscope::readers
