// SPDX-License-Identifier: BSD-3-Clause
// What the comparison of particles and gas tells of a wrong radius, clock or domain, in words.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/gas_run.hpp"

namespace bedscope::analysis {
namespace {

/// A solver's own mapping of the particles keeps their volume to this [-].
constexpr double fair_ratio = 0.01;
/// Fields that differ by more than this share of the holdup's own spread do not show the same bed;
/// from the smaller one on it is worth a look whether a shift makes them fit.
constexpr double fair_difference = 0.5, suspicious_difference = 0.2;
/// One run ends at one time on both sides, to this share of the longer one [-].
constexpr double fair_end = 0.2;
/// A shift is believed where it leaves less than this share of the squared difference.
constexpr double better = 0.6;
constexpr std::ptrdiff_t most_shift = 10;  // times of the gas
constexpr std::size_t most_tried = 8;      // snapshots

}  // namespace

void GasRun::tell_cover(RunResult& result) const {
  const auto& mapping = source_->mapping();
  const double outside = mapping.outside_volume(), whole = mapping.mesh_volume();
  if (outside > 1e-3 * whole)
    result.problems.push_back(
        fmt::format("gas: {:.3g} % of the mesh lies outside the domain", 100 * outside / whole));
  const double covers = (whole - outside) / run_->grid.volume();
  if (covers < 1 - 1e-3)
    result.problems.push_back(
        fmt::format("gas: the mesh covers {:.3g} % of the domain; the rest "
                    "does not count in averages",
                    100 * covers));
}

/// True where the sides disagree by a constant factor, which explains all other differences.
bool GasRun::tell_ratio(RunResult& result) const {
  const auto& gas = result.gas;
  const double ratio = gas.voidage_ratio.value;
  const double noise = std::isfinite(gas.voidage_ratio.ci95) ? gas.voidage_ratio.ci95 : 0;
  if (!std::isfinite(ratio) || std::abs(ratio - 1) <= std::max(fair_ratio, noise)) return false;
  double sum = 0, squares = 0;
  for (const auto& check : gas.checks) {
    sum += check.ratio();
    squares += check.ratio() * check.ratio();
  }
  const auto n = static_cast<double>(gas.checks.size());
  const double spread = std::sqrt(std::max(0., squares / n - (sum / n) * (sum / n)));
  const bool changes = gas.checks.size() > 1 && spread > fair_ratio * ratio;
  const auto why =
      changes ? std::string(
                    "it changes in time: another clock or run, or solids that one side does not "
                    "see")
              : fmt::format(
                    "it is constant: the radius is off by a factor of {:.3g}, the sides have "
                    "different scales or domains, or the solver limits its voidage",
                    std::cbrt(ratio));
  result.problems.push_back(fmt::format(
      "gas: the particles' volume is {:.3f} of what the voidage leaves for them ({})", ratio, why));
  return !changes;
}

void GasRun::tell_clock(RunResult& result) const {
  const auto& snapshots = run_->times;
  if (checks_.empty() || times_.size() < 2 || snapshots.size() < 2) return;
  const double longer =
      std::max(times_.back() - times_.front(), snapshots.back() - snapshots.front());
  if (std::abs(times_.back() - snapshots.back()) > fair_end * longer)
    result.problems.push_back(
        fmt::format("gas: its times run from {:.6g} to {:.6g} s, the snapshots from {:.6g} to "
                    "{:.6g} s: time_step or step_zero?",
                    times_.front(), times_.back(), snapshots.front(), snapshots.back()));
}

void GasRun::tell_shift(const readers::Series& particles, RunResult& result) const {
  // A bed of the same holdup everywhere has no spread. No doubt comes of what the counting of its
  // particles leaves open, nor of volumes that differ by what is fair.
  double rms = 0, spread = 0, noise = 0, least = 0;
  for (const auto& [snapshot, check] : checks_) {
    rms += check.rms_difference;
    spread += check.spread;
    noise += check.noise;
    least += std::hypot(check.noise, fair_ratio * check.holdup);
  }
  if (rms <= std::max(suspicious_difference * spread, least)) return;
  // Snapshots around which all shifted times are there, so that all shifts see the same ones.
  const auto furthest = std::clamp<std::ptrdiff_t>(std::ssize(times_) / 3, 1, most_shift);
  std::vector<std::size_t> snapshots;
  for (const auto& [snapshot, check] : checks_) {
    const auto n = static_cast<std::ptrdiff_t>(gas_of_[snapshot]);
    if (n >= furthest && n + furthest < std::ssize(times_)) snapshots.push_back(snapshot);
  }
  const auto middle = static_cast<std::size_t>(furthest);
  std::vector<double> squares(2 * middle + 1), shifts(2 * middle + 1);
  const auto tried = readers::evenly_spread(snapshots.size(), most_tried);
  const auto count = static_cast<double>(tried.size());
  SnapshotProduct product;
  ProductScratch scratch;
  GasScratch gas_scratch;
  for (const auto place : tried) {
    const auto i = snapshots[place];
    analysis::make_product(*run_, particles, i, product, scratch);
    for (std::ptrdiff_t s = -furthest; s <= furthest; ++s) {
      const auto n = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(gas_of_[i]) + s);
      JudgedCheck check;
      source_->make_check(product, places_[n], check, gas_scratch);
      squares[static_cast<std::size_t>(s + furthest)] +=
          check.rms_difference * check.rms_difference;
      shifts[static_cast<std::size_t>(s + furthest)] += (times_[n] - times_[gas_of_[i]]) / count;
    }
  }
  const auto best =
      static_cast<std::size_t>(std::min_element(squares.begin(), squares.end()) - squares.begin());
  if (count > 0 && squares[best] < better * squares[middle])
    result.problems.push_back(fmt::format(
        "gas: the fields fit the particles best {:.3g} s {} (rms difference {:.2g} instead of "
        "{:.2g}): step_zero or time_step?",
        std::abs(shifts[best]), shifts[best] > 0 ? "later" : "earlier",
        std::sqrt(squares[best] / count), std::sqrt(squares[middle] / count)));
  else if (const auto n = static_cast<double>(checks_.size()); rms > fair_difference * spread)
    result.problems.push_back(
        fmt::format("gas: voidage and particles differ by {:.2g} (rms), where the holdup's own "
                    "spread is {:.2g} and the noise of its counting {:.2g}: do they show the same "
                    "run, scale and axes?",
                    rms / n, spread / n, noise / n));
}

}  // namespace bedscope::analysis
