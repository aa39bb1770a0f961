// SPDX-License-Identifier: BSD-3-Clause
// The study file: its TOML is toml++'s, what the keys hold is ours.
#include "app/study.hpp"

#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {

void use(std::string_view input) {
  static MemoryFile file;
  const auto study = app::read_study(file.write(input));
  require(!study.runs.empty(), "a study has a run");
  for (const auto& run : study.runs) {
    require(run.settings.particles.empty() != run.tables.empty(), "a run is dumps or tables");
    require(run.settings.up != run.settings.lateral, "two axes");
  }
}

}  // namespace bedscope::fuzz
