// SPDX-License-Identifier: BSD-3-Clause
// Cells of a gas in one VTK file, legacy or XML.
#include "readers/vtk_gas.hpp"

#include <cmath>

#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {

void use(std::string_view input) {
  using namespace readers;
  static MemoryFile file;
  const auto& path = file.write(input);
  is_vtk_gas(path);
  const auto gas = open_vtk_gas(path);
  require(gas->times().size() == 1, "one file is one time");
  for (const auto& problem : gas->problems()) require_line(problem);
  const auto mesh = gas->mesh_at(0);
  require(mesh->centres.size() == mesh->cells(), "a centre for each cell");
  for (const double volume : mesh->volumes) require(volume > 0, "cells have volumes");
  FieldValues values;
  for (const auto& field : gas->times()[0].fields) {
    gas->read(0, field, values);
    require(values.values.size() == values.components * mesh->cells(), "a value for each cell");
  }
}

}  // namespace bedscope::fuzz
