// SPDX-License-Identifier: BSD-3-Clause
// A field of cells, one or collated.
#include "readers/openfoam_field.hpp"

#include "readers/error.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {
namespace {

using namespace readers;

void read_file(const std::string& path, std::optional<FoamCount> cells) {
  FoamBlocks file(path);
  FieldValues field;
  while (file.next()) {
    read_field(file, cells, field);
    require(field.components > 0 && field.values.size() % field.components == 0, "whole values");
    require(!cells || field.values.size() == cells->count * field.components,
            "a value for each cell");
    file.close();
  }
}

}  // namespace

void use(std::string_view input) {
  static MemoryFile file;
  const auto& path = file.write(input);
  try {
    read_file(path, FoamCount{5});
  } catch (const Error& error) {
    require_line(error.what());
  }
  read_file(path, std::nullopt);
}

}  // namespace bedscope::fuzz
