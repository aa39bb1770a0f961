// SPDX-License-Identifier: BSD-3-Clause
// The gas of a run beside its particles: one clock, one window, and each checked by the other.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/gas_sums.hpp"

namespace bedscope::analysis {

/// Used in this order, as often as the run grows: set_series; make_check and
/// add_check for the snapshots of unchecked() as far as they are read anyway, and for those that
/// are left; when the particles' window is known begin_window, then make_product and add_product
/// for the times of todo(); finish. make_... are const and safe in several threads; add_... take
/// what they made in ascending order.
///
/// Time: a gas time and a snapshot coincide where they are within half a time step of the particles
/// or 1e-6 of the gap between gas times, whichever is more. The window of the gas is that of the
/// study, where that leaves an end open the first or last snapshot of the particles' window; gas
/// times in it weigh by their own gaps.
class GasRun {
 public:
  explicit GasRun(const RunSetup& run) : run_(&run) {}

  /// The gas as it is now. What was summed stays if `series` only has times added to the last one.
  /// Also to be called when the particles have grown. Throws what set_up_gas does.
  void set_series(readers::GasSeries series);

  void make_check(const SnapshotProduct& product, JudgedCheck& check, GasScratch& scratch) const;
  void add_check(const JudgedCheck& check) { checks_[check.snapshot] = check; }
  /// Matched snapshots whose check is not there yet, ascending.
  std::vector<std::size_t> unchecked() const;

  /// Takes the window of the particles from a finished result.
  void begin_window(const Window& window);
  std::vector<std::size_t> todo() const;  ///< times to make products of, ascending
  void make_product(std::size_t n, GasProduct& product, GasScratch& scratch) const;
  void add_product(const GasProduct& product);

  /// Everything into result.gas, result.problems and result.inputs. Where the fields do not fit
  /// `particles` reads a few snapshots again, to try whether they fit at a shifted time.
  void finish(const readers::Series& particles, RunResult& result) const;

 private:
  static constexpr std::size_t none = ~std::size_t{0};

  bool continues(const GasSource& old) const;
  void match();
  bool in_window(std::size_t n) const { return n >= first_ && n < last_; }
  bool to_average(std::size_t n) const { return in_window(n) && n >= start_; }
  void checks_of(RunResult& result) const;
  void pressures_of(RunResult& result) const;
  void tell_cover(RunResult& result) const;
  void tell_clock(RunResult& result) const;
  bool tell_ratio(RunResult& result) const;
  void tell_shift(const readers::Series& particles, RunResult& result) const;

  const RunSetup* run_;
  std::unique_ptr<GasSource> source_;
  std::vector<std::size_t> places_;  // in the series: the times that have a voidage
  std::vector<double> times_;        // of these [s]
  double tolerance_ = 0;             // [s]
  std::vector<std::size_t> gas_of_;  // of each snapshot, or none
  std::map<std::size_t, JudgedCheck> checks_;
  std::map<std::size_t, double> drops_;  // of pressure, at every time

  std::size_t first_ = 0, last_ = 0;  // of the window
  std::vector<double> weights_;       // of its times
  std::size_t start_ = 0;             // from here on times were not in sums_ when it began
  std::size_t next_ = 0;              // the first time that is not in sums_
  GasSums sums_;                      // of times whose weights are final: all but the last
  GasSums complete_;
};

}  // namespace bedscope::analysis
