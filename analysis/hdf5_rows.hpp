// SPDX-License-Identifier: BSD-3-Clause
// Rows of a result as the arrays of an HDF5 group.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "analysis/hdf5_file.hpp"
#include "analysis/result.hpp"

namespace bedscope::analysis {

/// A member of each row, or what a function makes of it.
template <class Number = double, class Row, class Of>
std::vector<Number> numbers(const std::vector<Row>& rows, Of of) {
  std::vector<Number> values(rows.size());
  std::transform(rows.begin(), rows.end(), values.begin(),
                 [&](const Row& row) { return static_cast<Number>(std::invoke(of, row)); });
  return values;
}

/// Times [s]; NaN where the run's count steps.
template <class Row>
std::vector<double> times(const RunResult& run, const std::vector<Row>& rows) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  return numbers(rows, [&](const Row& row) { return run.time_known ? row.time : unknown; });
}

/// A mean and the half-width of its interval as a list of two.
inline void write_estimate(Hdf5Group& group, const std::string& name, const Estimate& estimate,
                           const std::string& unit) {
  group.write(name, std::array{estimate.value, estimate.ci95}, unit);
}

/// Means as `name`, the half-widths of their intervals as `name`_ci95.
inline void write_curve(Hdf5Group& group, const std::string& name,
                        const std::vector<Estimate>& curve, const std::string& unit) {
  group.write(name, numbers(curve, &Estimate::value), unit);
  group.write(name + "_ci95", numbers(curve, &Estimate::ci95), unit);
}

}  // namespace bedscope::analysis
