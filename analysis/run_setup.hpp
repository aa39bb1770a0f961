// SPDX-License-Identifier: BSD-3-Clause
// Settings and dumps brought together: the grid, the columns to read, the times, the densities.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/mapping.hpp"
#include "analysis/settings.hpp"
#include "readers/series.hpp"

namespace bedscope::analysis {

/// Positions of the columns in RunSetup::request; the columns of the rules follow.
enum Column : std::size_t {
  column_lateral,
  column_depth,
  column_up,
  column_v_lateral,
  column_v_up,
  column_radius,
  column_type,
  column_id,
  column_temperature,
  column_density,  ///< or the particle's mass: see RunSetup::density_from
  column_first_rule
};

/// A band of heights over the whole cross-section.
struct Band {
  double height = 0, width = 0;  ///< its middle and its full height [m]
  std::vector<double> weights;   ///< the share of each layer of cells, sum 1
};

/// All that is constant while the snapshots of a run are read.
struct RunSetup {
  RunSettings settings;
  Grid grid;
  std::optional<Kernel> kernel;  ///< set by set_up()
  readers::Request request, request_without_id;
  bool domain_assumed = false;
  bool has_velocity = true;
  bool radius_in_dumps = true;
  bool has_temperature = false;

  std::vector<double> times;  ///< [s]; where no time step is known the steps themselves
  bool time_known = true;
  std::optional<double> time_step;  ///< [s], from the study or the log
  double half_step = 0;             ///< [s] by which the window is widened

  /// Where densities come from: `density` holds them, or a column does, or nobody knows.
  enum class Density { by_type, density_column, mass_column, unknown };
  Density density_from = Density::unknown;
  ByType density;  ///< [kg/m3], of the study or the log
  std::vector<double> heights;
  double band = 0;
  std::vector<std::vector<double>>
      band_weights;                ///< a height: the share of each layer of cells, sum 1
  std::vector<Band> bubble_bands;  ///< where the study asks for bubbles
  std::vector<std::string> problems;
};

/// Throws InputError naming the key for whatever is neither in the study nor on disk.
RunSetup set_up(const RunSettings& settings, const readers::Series& series);

/// Sets the times anew for a series that has grown.
void update_times(RunSetup& setup, const readers::Series& series);

}  // namespace bedscope::analysis
