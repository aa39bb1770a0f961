// SPDX-License-Identifier: BSD-3-Clause
// log.liggghts, for the time step and the densities.
#include "readers/liggghts_log.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {

void use(std::string_view input) {
  static MemoryFile file;
  const auto log = readers::read_log(file.write(input));
  for (const auto& [type, density] : log.density) require(type >= 1, "types begin at 1");
}

}  // namespace bedscope::fuzz
