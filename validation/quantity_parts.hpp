// SPDX-License-Identifier: BSD-3-Clause
// What the table of quantities is made of; for validation/quantity*.cpp alone.
#pragma once

#include <vector>

#include "validation/quantity.hpp"

namespace bedscope::validation {

/// Along z [m]: of the solids (`species`), or of the gas.
Sampled axial_holdup(const analysis::RunResult& run, const Place& place);
Sampled axial_velocity(const analysis::RunResult& run, const Place& place);
Sampled axial_mass_flux(const analysis::RunResult& run, const Place& place);
Sampled axial_temperature(const analysis::RunResult& run, const Place& place);
Sampled axial_voidage(const analysis::RunResult& run, const Place& place);
Sampled axial_gas_velocity(const analysis::RunResult& run, const Place& place);
Sampled axial_gas_temperature(const analysis::RunResult& run, const Place& place);
Sampled axial_pressure(const analysis::RunResult& run, const Place& place);
Sampled axial_slip_velocity(const analysis::RunResult& run, const Place& place);
Sampled axial_bubble_diameter(const analysis::RunResult& run, const Place& place);
Sampled axial_bubble_velocity(const analysis::RunResult& run, const Place& place);
Sampled axial_bubble_frequency(const analysis::RunResult& run, const Place& place);
Sampled axial_bubble_fraction(const analysis::RunResult& run, const Place& place);

/// Along x [m] around at.height.
Sampled lateral_holdup(const analysis::RunResult& run, const Place& place);
Sampled lateral_velocity(const analysis::RunResult& run, const Place& place);
Sampled lateral_mass_flux(const analysis::RunResult& run, const Place& place);
Sampled lateral_voidage(const analysis::RunResult& run, const Place& place);
Sampled lateral_gas_velocity(const analysis::RunResult& run, const Place& place);
Sampled lateral_gas_temperature(const analysis::RunResult& run, const Place& place);
Sampled lateral_pressure(const analysis::RunResult& run, const Place& place);
Sampled lateral_slip_velocity(const analysis::RunResult& run, const Place& place);

/// At at.height and at.x: one value of a lateral profile.
Sampled local_holdup(const analysis::RunResult& run, const Place& place);
Sampled local_voidage(const analysis::RunResult& run, const Place& place);

/// Of RunResult::series: over the window, or all of it against time.
Sampled series_mean(const analysis::RunResult& run, const analysis::Signal& signal);
Sampled series_history(const analysis::Signal& signal);

/// Means over the window.
Sampled occurrence(const analysis::RunResult& run, const Place& place);
Sampled cluster_holdup(const analysis::RunResult& run, const Place& place);
Sampled cluster_velocity(const analysis::RunResult& run, const Place& place);
Sampled mean_holdup(const analysis::RunResult& run, const Place& place);
Sampled inventory(const analysis::RunResult& run, const Place& place);
Sampled mean_temperature(const analysis::RunResult& run, const Place& place);
Sampled temperature_spread(const analysis::RunResult& run, const Place& place);
Sampled pressure_drop(const analysis::RunResult& run, const Place& place);
Sampled bed_voidage(const analysis::RunResult& run, const Place& place);
Sampled bed_height(const analysis::RunResult& run, const Place& place);
Sampled bubble_number(const analysis::RunResult& run, const Place& place);
Sampled bubble_diameter(const analysis::RunResult& run, const Place& place);
Sampled bubble_velocity(const analysis::RunResult& run, const Place& place);

/// Standard deviation and dominant frequency over the window.
Sampled bed_height_deviation(const analysis::RunResult& run, const Place& place);
Sampled bed_height_frequency(const analysis::RunResult& run, const Place& place);
Sampled pressure_drop_deviation(const analysis::RunResult& run, const Place& place);
Sampled pressure_drop_frequency(const analysis::RunResult& run, const Place& place);
Sampled probe_pressure_deviation(const analysis::RunResult& run, const Place& place);
Sampled probe_pressure_frequency(const analysis::RunResult& run, const Place& place);

/// Along time [s], every snapshot.
Sampled bed_height_history(const analysis::RunResult& run, const Place& place);
Sampled inventory_history(const analysis::RunResult& run, const Place& place);
Sampled pressure_drop_history(const analysis::RunResult& run, const Place& place);
Sampled temperature_history(const analysis::RunResult& run, const Place& place);

/// Densities.
Sampled cluster_position(const analysis::RunResult& run, const Place& place);
Sampled temperature_pdf(const analysis::RunResult& run, const Place& place);

/// Estimates along an axis; those without an interval have u = nan, or 0 and `error_known` false
/// where none has one.
Sampled along(const char* axis, const char* unit, const std::vector<double>& at,
              const std::vector<analysis::Estimate>& estimates);

/// The one of the place. Throws InputError listing what the run has.
const analysis::SpeciesResult& species_of(const analysis::RunResult& run, const Place& place);

constexpr double coverage_factor = 1.96;  ///< of a 95 % interval of a normal distribution

}  // namespace bedscope::validation
