// SPDX-License-Identifier: BSD-3-Clause
#include "readers/gas_series.hpp"

#include <algorithm>

#include "readers/error.hpp"

namespace bedscope::readers {

bool GasSeries::has(std::size_t time, std::string_view field) const {
  const auto& fields = fields_at(time);
  return std::find(fields.begin(), fields.end(), field) != fields.end();
}

void GasSeries::read(std::size_t time, std::string_view field, unsigned components,
                     FieldValues& out) const {
  case_.read(time, field, out);
  if (out.components != components)
    throw FormatError("{}: field {} at time {}: expected {} components a cell, found {}", path_,
                      field, times()[time].name, components, out.components);
}

}  // namespace bedscope::readers
