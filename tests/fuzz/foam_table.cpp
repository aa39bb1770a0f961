// SPDX-License-Identifier: BSD-3-Clause
// Tables of OpenFOAM's function objects, files under postProcessing/: each alone, then joined.
#include "readers/openfoam_tables.hpp"

#include "readers/error.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {
namespace {

using namespace readers;

void require_whole(const FoamTable& table) {
  const auto rows = table.times.size();
  for (const auto& column : table.columns) {
    require(std::max(column.values.size(), column.words.size()) == rows, "a value for each row");
    require(!column.point || *column.point < table.points.size(), "a probe has a place");
  }
  for (const auto& problem : table.problems) require_line(problem);
}

}  // namespace

void use(std::string_view input) {
  const auto parts = parts_of(input);
  const MemoryFolder folder(parts);
  for (const auto& [name, bytes] : parts) {
    const auto path = folder.path() + "/" + name;
    try {
      is_foam_table(path);
      require_whole(read_foam_table(path));
    } catch (const Error& error) {
      require_line(error.what());
    }
  }
  require_whole(open_foam_table(folder.path()));
}

}  // namespace bedscope::fuzz
