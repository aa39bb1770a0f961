// SPDX-License-Identifier: BSD-3-Clause
// Uses the installed rooms as an outside program does: says what it finds, exits 0 if that is
// right.
#include <fmt/format.h>

#include <analysis/grid.hpp>
#include <analysis/output_file.hpp>
#include <filesystem>
#include <readers/error.hpp>

int main() {
  namespace analysis = bedscope::analysis;
  const analysis::Grid riser{.min = {0, 0, 0}, .max = {0.07, 0.006, 1.57}, .cells = {14, 1, 314}};
  fmt::print("{} cells of {:.4g} m3\n", riser.size(), riser.cell_volume());

  const std::filesystem::path table = "table.csv", inside_a_file = table / "below.csv";
  analysis::write_file(table, "x [m]\n0.035\n");
  bool refused = false;
  try {
    analysis::write_file(inside_a_file, "");
  } catch (const bedscope::FileError& error) {
    refused = true;
    fmt::print("{}\n", error.what());
  }
  return riser.size() == 4396 && std::filesystem::file_size(table) == 12 && refused ? 0 : 1;
}
