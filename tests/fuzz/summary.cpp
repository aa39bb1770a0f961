// SPDX-License-Identifier: BSD-3-Clause
// The summary.json of an earlier validation, shown beside the new verdicts.
#include "report/validation_summary.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {

void use(std::string_view input) {
  static MemoryFile file;
  report::read_earlier(file.write(input));
}

}  // namespace bedscope::fuzz
