// SPDX-License-Identifier: BSD-3-Clause
// A folder of dumps, the parts of one input, as `bedscope info` looks at it.
#include "readers/series.hpp"
#include "readers/survey.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {

using namespace readers;

void use(std::string_view input) {
  const MemoryFolder folder(parts_of(input));
  const auto series = Series::open(folder.path());
  require(series.size() > 0, "a series has snapshots");
  for (std::size_t i = 1; i < series.size(); ++i)
    require(series.step(i - 1) < series.step(i), "steps ascend");
  for (const auto& what : series.left_out()) require_line(what);
  for (const auto& problem : survey(series, true).problems) require_line(problem);
}

}  // namespace bedscope::fuzz
