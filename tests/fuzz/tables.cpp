// SPDX-License-Identifier: BSD-3-Clause
// The CSV tables of an earlier analysis, the parts of one input.
#include "analysis/tables.hpp"

#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {

void use(std::string_view input) {
  const MemoryFolder folder(parts_of(input));
  const auto run = analysis::read_tables(folder.path(), "run");
  require(run.types.size() == run.species.size(), "results for each species");
  for (const auto& problem : run.problems) require_line(problem);
  for (const auto& species : run.species)
    require(species.axial.coordinate.size() == species.axial.holdup.size(), "profiles are whole");
}

}  // namespace bedscope::fuzz
