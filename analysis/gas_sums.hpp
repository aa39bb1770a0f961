// SPDX-License-Identifier: BSD-3-Clause
// Sums of the gas over the window, taken in the order of its times, and the means they give.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/averages.hpp"
#include "analysis/gas_products.hpp"

namespace bedscope::analysis {

/// Copyable: a live analysis adds what is final, and finishes a copy.
class GasSums {
 public:
  /// Takes the next time of the window; `weight`: the time it stands for.
  void add(const GasProduct& product, double weight);

  /// Profiles, their intervals and fields into result.gas; slip against the solids' profiles that
  /// `result` holds already. What is to be said goes to result.problems.
  ///
  /// Means are ratios of sums over time: voidage sum eps V / sum V, velocity sum eps u V /
  /// sum eps V, and so on. Intervals as the solids': batch means of the voidage, the jackknife for
  /// ratios (statistics.hpp). The half-width of a slip velocity is the sum of those of both
  /// velocities: a bound whatever their correlation is, as both have times of their own.
  void finish(const RunSetup& run, RunResult& result) const;

 private:
  void fields_of(std::size_t cells, GasResult& gas) const;

  Leaves fields_{4, 0}, profiles_{0, 64};  // as those of the solids, see run_sums.cpp
  std::int64_t not_finite_ = 0, beyond_ = 0;
  std::size_t times_ = 0;
};

}  // namespace bedscope::analysis
