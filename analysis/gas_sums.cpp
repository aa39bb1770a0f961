// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/gas_sums.hpp"

#include <fmt/format.h>

#include <limits>

#include "analysis/statistics.hpp"

namespace bedscope::analysis {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

double ratio(double a, double b) { return b > 0 ? a / b : undefined; }

/// Samples of one quantity over leaves in which there is gas.
struct Samples {
  std::vector<double> numerator, denominator, weights;

  Estimate estimate() const {
    return weights.empty() ? Estimate{} : estimate_ratio(numerator, denominator, weights);
  }
};

Samples samples_of(const std::map<std::size_t, WeightedSum>& leaves, std::size_t at,
                   std::size_t numerator, std::size_t denominator) {
  Samples samples;
  for (const auto& [number, sum] : leaves) {
    const double* const q = sum.slots[0].data() + at;
    if (!(q[denominator] > 0)) continue;  // no gas mesh here, or the field is not there (yet)
    samples.numerator.push_back(q[numerator] / sum.weight);
    samples.denominator.push_back(q[denominator] / sum.weight);
    samples.weights.push_back(sum.weight);
  }
  return samples;
}

/// Appends the means at one point, where the solids' profile has its own; 1 where the window holds
/// too few independent samples.
int profile_point(const std::map<std::size_t, WeightedSum>& leaves, std::size_t at,
                  const Profile& solids, GasProfile& profile) {
  const auto of = [&](std::size_t sum, std::size_t with) {
    return samples_of(leaves, at, sum, with);
  };
  const auto eps = of(gas_volume, gas_covered);
  std::vector<double> voidage;
  for (std::size_t i = 0; i < eps.weights.size(); ++i)
    voidage.push_back(eps.numerator[i] / eps.denominator[i]);
  const auto mean = estimate_mean(voidage, eps.weights);
  profile.voidage.push_back(mean);
  profile.velocity_z.push_back(of(gas_flux_z, gas_with_u).estimate());
  profile.temperature.push_back(of(gas_heat, gas_with_t).estimate());
  profile.pressure.push_back(of(gas_pressure, gas_with_p).estimate());
  Estimate slip;
  if (const auto i = profile.voidage.size() - 1; i < solids.velocity_z.size()) {
    slip.value = profile.velocity_z[i].value - solids.velocity_z[i].value;
    slip.ci95 = profile.velocity_z[i].ci95 + solids.velocity_z[i].ci95;
  }
  profile.slip_z.push_back(slip);
  return mean.few_samples ? 1 : 0;
}

}  // namespace

void GasSums::add(const GasProduct& product, double weight) {
  for (auto* sums : {&fields_, &profiles_}) {
    auto& sum = sums->at(times_);
    sum.weight += weight;
    sum.add(weight, 0, sums == &fields_ ? product.fields : product.profiles);
  }
  not_finite_ += product.not_finite;
  beyond_ += product.beyond;
  ++times_;
}

void GasSums::fields_of(std::size_t cells, GasResult& gas) const {
  auto& fields = gas.fields;
  fields.voidage.assign(cells, undefined);
  if (gas.has_velocity) fields.velocity_x = fields.velocity_z = fields.voidage;
  if (gas.has_temperature) fields.temperature = fields.voidage;
  if (gas.has_pressure) fields.pressure = fields.voidage;
  const auto sum = fields_.total();
  if (sum.slots.empty()) return;
  const double* const q = sum.slots[0].data();
  const auto fill = [&](std::vector<double>& values, std::size_t numerator, std::size_t with) {
    for (std::size_t c = 0; c < values.size(); ++c)
      values[c] = ratio(q[gas_quantities * c + numerator], q[gas_quantities * c + with]);
  };
  fill(fields.voidage, gas_volume, gas_covered);
  fill(fields.velocity_x, gas_flux_x, gas_with_u);
  fill(fields.velocity_z, gas_flux_z, gas_with_u);
  fill(fields.temperature, gas_heat, gas_with_t);
  fill(fields.pressure, gas_pressure, gas_with_p);
}

void GasSums::finish(const RunSetup& run, RunResult& result) const {
  const auto& grid = run.grid;
  const auto nx = static_cast<std::size_t>(grid.cells[lateral]);
  const auto nz = static_cast<std::size_t>(grid.cells[up]);
  const auto& solids = result.species.front();
  const auto leaves = profiles_.leaves();
  int few = 0;
  for (std::size_t k = 0; k < nz; ++k) {
    result.gas.axial.coordinate.push_back(grid.centre(up, static_cast<int>(k)));
    few += profile_point(leaves, gas_quantities * k, solids.axial, result.gas.axial);
  }
  for (std::size_t h = 0; h < run.heights.size(); ++h) {
    GasProfile profile;
    for (std::size_t i = 0; i < nx; ++i) {
      profile.coordinate.push_back(grid.centre(lateral, static_cast<int>(i)));
      few += profile_point(leaves, gas_quantities * (nz + nx * h + i), solids.lateral[h], profile);
    }
    result.gas.lateral.push_back(std::move(profile));
  }
  fields_of(grid.size(), result.gas);
  const auto points = nz + nx * run.heights.size();
  if (few > 0)
    result.problems.push_back(
        fmt::format("gas profiles: at {} of {} points the window holds too few independent samples "
                    "for the interval of the voidage to be trusted",
                    few, points));
  if (not_finite_ > 0)
    result.problems.push_back(
        fmt::format("gas: {} values are nan or inf, left out of the averages", not_finite_));
  if (beyond_ > 0)
    result.problems.push_back(fmt::format("gas: {} voidages lie below 0 or above 1", beyond_));
}

}  // namespace bedscope::analysis
