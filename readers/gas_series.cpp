// SPDX-License-Identifier: BSD-3-Clause
#include "readers/gas_series.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "readers/error.hpp"
#include "readers/vtk_gas.hpp"
#include "readers/vtk_gas_files.hpp"

namespace bedscope::readers {

std::vector<std::string> missing_fields(const std::string& path,
                                        const std::vector<GasTime>& times) {
  std::set<std::string> names;
  for (const auto& time : times) names.insert(time.fields.begin(), time.fields.end());
  std::vector<std::string> lines;
  for (const auto& name : names) {
    std::vector<std::string> lacking;
    std::size_t having = 0;
    bool first = false;
    for (std::size_t t = 0; t < times.size(); ++t) {
      const bool there = std::binary_search(times[t].fields.begin(), times[t].fields.end(), name);
      if (there && t == 0) first = true;
      if (there) ++having;
      if (!there && having > 0) lacking.push_back(times[t].name);
    }
    if (lacking.empty() || (first && having == 1)) continue;
    lines.push_back(fmt::format("{}: field {} is missing at {} of {} times, first at {}", path,
                                name, lacking.size(), times.size(), lacking.front()));
  }
  return lines;
}

GasSeries GasSeries::open(const std::string& path, const GasOptions& options) {
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error) ||
      (!is_openfoam_case(path) && !first_vtk_grid(path).empty()))  // a damaged one tells it
    return {path, open_vtk_gas(path, options)};
  return {path, std::make_shared<OpenFoamCase>(OpenFoamCase::open(path, options))};
}

bool GasSeries::has(std::size_t time, std::string_view field) const {
  const auto& fields = fields_at(time);
  return std::find(fields.begin(), fields.end(), field) != fields.end();
}

void GasSeries::read(std::size_t time, std::string_view field, unsigned components,
                     FieldValues& out) const {
  form_->read(time, field, out);
  if (out.components != components)
    throw FormatError("{}: field {} at time {}: expected {} components a cell, found {}", path_,
                      field, times()[time].name, components, out.components);
}

}  // namespace bedscope::readers
