// SPDX-License-Identifier: BSD-3-Clause
// Reference curves: CSV files and their sidecars, the parts of one input, as `bedscope curves` and
// a check use them.
#include "validation/curves.hpp"

#include <array>
#include <cmath>

#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {
namespace {

using namespace validation;

/// The first value of each parameter.
std::string selection_of(const CurveSet& set) {
  std::string text = set.name;
  for (const auto& parameter : set.parameters)
    text += (text.size() == set.name.size() ? "?" : "&") + parameter.title.name + "=" +
            parameter.values.front();
  return text;
}

void use_curve(const Curves& curves, const std::string& selection) {
  try {
    const auto curve = curves.curve(selection, {"lateral holdup", {{"height", 0.8}}});
    require(!curve.points.empty(), "a curve has points");
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const auto& point = curve.points[i];
      require(std::isfinite(point.x) && std::isfinite(point.y), "points are numbers");
      require(i == 0 || curve.points[i - 1].x <= point.x, "points ascend");
    }
    for (const auto& assumption : curve.assumptions) require_line(assumption);
  } catch (const Error& error) {
    require_line(error.what());
  }
}

}  // namespace

void use(std::string_view input) {
  const MemoryFolder folder(parts_of(input));
  const auto curves = Curves::open(std::array{folder.path()});
  for (const auto& set : curves.sets()) {
    for (const auto& parameter : set.parameters)
      require(!parameter.values.empty(), "a parameter has values");
    use_curve(curves, set.name);
    use_curve(curves, selection_of(set));
  }
}

}  // namespace bedscope::fuzz
