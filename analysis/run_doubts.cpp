// SPDX-License-Identifier: BSD-3-Clause
// What a run's own sums tell of wrong input whose tables would look plausible, in words.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "analysis/run_sums.hpp"
#include "physics/packing.hpp"
#include "readers/checkup_series.hpp"

namespace bedscope::analysis {
namespace {

/// Over so many diameters of height a packing's own layers have averaged out: what the densest
/// one, cut between two of its layers, has beyond its mean (0.045 diameters of solids) is 1 % then.
constexpr double layers_even_out = 5;

}  // namespace

void RunSums::tell_missing(const readers::Series& series, const Window& window,
                           RunResult& result) const {
  if (!series.has_steps()) return;
  std::vector<std::int64_t> steps;
  for (std::size_t i = window.first; i < window.first + window.snapshots; ++i)
    steps.push_back(series.step(i));
  const auto gaps = readers::spacing_of(steps).gaps;
  if (gaps.empty()) return;
  std::uint64_t missing = 0;
  for (const auto& gap : gaps) missing += gap.missing();
  result.problems.push_back(fmt::format(
      "{} snapshot{} missing between steps {} and {}{}: the neighbours stand for that time",
      missing, missing == 1 ? " is" : "s are", gaps.front().before, gaps.back().after,
      gaps.size() == 1 ? "" : fmt::format(", in {} gaps", gaps.size())));
}

void RunSums::tell_losses(const Window& window, RunResult& result) const {
  std::vector<std::int64_t> counts;
  for (std::size_t i = window.first; i < window.first + window.snapshots; ++i) {
    std::int64_t count = 0;
    for (std::size_t s = 0; s < samples_[i].slots.size(); ++s)
      if (slots_[s].rule < 0) count += samples_[i].slots[s].solids.particles;
    counts.push_back(count);
  }
  const auto before = readers::sudden_change(counts, -1);
  if (!before) return;
  const auto when = [&](std::size_t i) {
    const double time = setup_->times[window.first + i];
    return setup_->time_known ? fmt::format("at {:.6g} s", time) : fmt::format("at step {}", time);
  };
  result.problems.push_back(fmt::format("particles are lost: {} {}, {} {}", counts[*before],
                                        when(*before), counts[*before + 1], when(*before + 1)));
}

void RunSums::tell_packing(const Window& window, RunResult& result) const {
  const auto& axial = result.species.front().axial;
  double volume = 0, particles = 0;
  for (std::size_t i = window.first; i < window.first + window.snapshots; ++i) {
    volume += samples_[i].volume;
    for (std::size_t s = 0; s < samples_[i].slots.size(); ++s)
      if (slots_[s].rule < 0)
        particles += static_cast<double>(samples_[i].slots[s].solids.particles);
  }
  if (axial.holdup.empty() || !(volume > 0)) return;
  const double diameter = std::cbrt(6 / std::numbers::pi * volume / particles);
  const double wanted = std::ceil(layers_even_out * diameter / setup_->grid.width(up));
  const std::size_t layers = axial.holdup.size();
  const auto count = static_cast<std::size_t>(std::min(wanted, static_cast<double>(layers)));
  double densest = 0, height = 0;
  for (std::size_t first = 0; first + count <= layers; ++first) {
    double sum = 0;
    for (std::size_t k = first; k < first + count; ++k) sum += axial.holdup[k].value;
    if (sum / static_cast<double>(count) <= densest) continue;
    densest = sum / static_cast<double>(count);
    height = std::midpoint(axial.coordinate[first], axial.coordinate[first + count - 1]);
  }
  if (densest > physics::densest_packing)
    result.problems.push_back(fmt::format(
        "around {:.4g} m {:.3g} of the volume is solids, more than the densest packing of equal "
        "spheres ({:.4g}): is the radius a diameter, the domain too narrow, or are particles there "
        "twice?",
        height, densest, physics::densest_packing));
}

}  // namespace bedscope::analysis
