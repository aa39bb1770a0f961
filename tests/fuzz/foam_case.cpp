// SPDX-License-Identifier: BSD-3-Clause
// An OpenFOAM case, its files the parts of one input: times, ranks, fields, clouds.
#include "readers/openfoam_case.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {
namespace {

using namespace readers;

void read_clouds(const OpenFoamCase& flow, std::size_t time) {
  for (const auto& cloud : flow.clouds_at(time)) {
    Request request;
    for (const auto& name : flow.cloud_columns(time, cloud)) request.push_back({name});
    Snapshot parcels;
    for (const auto& problem : flow.read_cloud(time, cloud, request, parcels))
      require_line(problem);
    for (const auto& column : parcels.columns)
      require(column.size() == parcels.particles, "columns as long as the cloud");
  }
}

}  // namespace

void use(std::string_view input) {
  const MemoryFolder folder(parts_of(input));
  const auto flow = OpenFoamCase::open(folder.path());
  for (const auto& problem : flow.problems()) require_line(problem);
  for (std::size_t time = 0; time < flow.times().size(); ++time) {
    const auto cells = flow.mesh_at(time)->cells();
    FieldValues values;
    for (const auto& field : flow.fields_at(time)) {
      flow.read(time, field, values);
      require(values.values.size() == cells * values.components, "a value for each cell");
    }
    read_clouds(flow, time);
  }
}

}  // namespace bedscope::fuzz
