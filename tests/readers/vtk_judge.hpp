// SPDX-License-Identifier: BSD-3-Clause
// Our numbers of a file of VTK's against those that its own reader gives.
#pragma once

#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>

#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "readers/columns.hpp"
#include "readers/forms.hpp"

namespace bedscope::readers {

/// Expects the same bits in positions and in every component of every array of points; returns how
/// many numbers were compared.
inline std::size_t compare(const Form& form, const std::string& path, vtkPointSet& theirs) {
  Request request = {{"x"}, {"y"}, {"z"}};
  std::vector<std::pair<vtkDataArray*, int>> components;
  auto* const points = theirs.GetPoints();
  for (int c = 0; c < 3; ++c)
    components.emplace_back(points == nullptr ? nullptr : points->GetData(), c);
  for (int a = 0; a < theirs.GetPointData()->GetNumberOfArrays(); ++a) {
    vtkDataArray* array = theirs.GetPointData()->GetArray(a);
    if (array == nullptr) continue;  // of strings
    const auto names = component_names(array->GetName(), array->GetNumberOfComponents());
    for (int c = 0; c < array->GetNumberOfComponents(); ++c) {
      request.push_back({names[static_cast<std::size_t>(c)]});
      components.emplace_back(array, c);
    }
  }
  Snapshot snapshot;
  Scratch scratch;
  form.read(path, {}, request, snapshot, scratch);
  EXPECT_EQ(static_cast<vtkIdType>(snapshot.particles), theirs.GetNumberOfPoints());
  std::size_t compared = 0;
  for (std::size_t k = 0; k < components.size() && snapshot.particles > 0; ++k) {
    const auto [array, component] = components[k];
    std::size_t different = 0;
    for (std::size_t i = 0; i < snapshot.particles; ++i, ++compared) {
      const double expected = array->GetComponent(static_cast<vtkIdType>(i), component);
      different += std::bit_cast<std::uint64_t>(expected) !=
                   std::bit_cast<std::uint64_t>(snapshot.columns[k].at(i));
    }
    EXPECT_EQ(different, 0U) << request[k].name << " of " << path;
  }
  return compared;
}

}  // namespace bedscope::readers
