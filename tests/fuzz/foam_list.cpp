// SPDX-License-Identifier: BSD-3-Clause
// Lists of numbers, labels and faces, in each block of a file; the class of its header says of
// what.
#include "readers/error.hpp"
#include "readers/openfoam_blocks.hpp"
#include "readers/openfoam_list.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {
namespace {

using namespace readers;

constexpr FoamCount five{5, "mesh", "cells"};

void read_list(FoamBlocks& file, std::optional<FoamCount> expected) {
  auto& stream = file.stream();
  const auto layout = layout_of(file.header(), stream.path());
  const auto& name = file.header().class_name;
  std::vector<std::int32_t> labels, starts;
  if (name == "labelList") {
    read_labels(stream, layout, labels, expected);
    require(!expected || labels.size() == expected->count, "labels as many as expected");
  } else if (name == "faceList" || name == "faceCompactList") {
    read_faces(stream, layout, name == "faceCompactList", starts, labels);
    require(!starts.empty() && starts.front() == 0 &&
                static_cast<std::size_t>(starts.back()) == labels.size(),
            "faces cover their points");
    for (std::size_t f = 1; f < starts.size(); ++f)
      require(starts[f - 1] <= starts[f], "faces follow one another");
  } else {
    const auto* type = foam_type(name.substr(0, name.find("Field")));
    if (type == nullptr) return skip_list(stream, layout, "List<scalar>");
    std::vector<double> values;
    read_values(stream, layout, *type, expected, values);
    require(values.size() % type->components == 0, "whole values");
    require(!expected || values.size() == expected->count * type->components,
            "values as many as expected");
  }
}

void read_file(const std::string& path, std::optional<FoamCount> expected) {
  FoamBlocks file(path);
  while (file.next()) {
    read_list(file, expected);
    file.close();
  }
}

}  // namespace

void use(std::string_view input) {
  static MemoryFile file;
  const auto& path = file.write(input);
  try {
    read_file(path, five);
  } catch (const Error& error) {
    require_line(error.what());
  }
  read_file(path, std::nullopt);
}

}  // namespace bedscope::fuzz
