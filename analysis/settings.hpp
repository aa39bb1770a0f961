// SPDX-License-Identifier: BSD-3-Clause
// What a user asks of the analysis of one run: the study file's keys, resolved for that run.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/gas_settings.hpp"
#include "analysis/result.hpp"
#include "readers/series.hpp"

namespace bedscope::analysis {

/// A value for all types, or one for each.
struct ByType {
  std::optional<double> all;
  std::map<int, double> of_type;

  bool given() const { return all.has_value() || !of_type.empty(); }
  /// NaN where nothing was said for this type.
  double at(int type) const {
    const auto found = of_type.find(type);
    return found != of_type.end() ? found->second : all.value_or(readers::unknown);
  }
};

template <class Archive>
void archive(Archive& ar, ByType& values) {
  auto& [all, of_type] = values;
  ar(all, of_type);
}

/// A species by a rule on a column: `active = "q > 0"`.
struct SpeciesRule {
  enum class Comparison { less, less_equal, greater, greater_equal, equal, not_equal };
  std::string name;
  std::string column;
  Comparison comparison = Comparison::greater;
  double value = 0;

  bool holds(double x) const {
    switch (comparison) {
      case Comparison::less:
        return x < value;
      case Comparison::less_equal:
        return x <= value;
      case Comparison::greater:
        return x > value;
      case Comparison::greater_equal:
        return x >= value;
      case Comparison::equal:
        return x == value;
      default:
        return x != value;
    }
  }
};

template <class Archive>
void archive(Archive& ar, SpeciesRule& rule) {
  auto& [name, column, comparison, value] = rule;
  ar(name, column, comparison, value);
}

/// What is made of each snapshot besides its inventory, its bed height and the axial profile: what
/// is not wanted is neither read for nor computed.
struct WantedProducts {
  bool lateral = true;  ///< profiles
  bool fields = true;   ///< mean fields; needs the lateral velocity
  bool clusters = true;
  bool species = true;  ///< each type by itself; needs the type
  bool temperature = true;
  bool id_check = true;  ///< no id twice in a snapshot; needs the id of some snapshots
};

template <class Archive>
void archive(Archive& ar, WantedProducts& wanted) {
  auto& [lateral, fields, clusters, species, temperature, id_check] = wanted;
  ar(lateral, fields, clusters, species, temperature, id_check);
}

/// Axes are numbered 0 x, 1 y, 2 z here; vectors of the domain are in that order too.
struct RunSettings {
  std::string label;
  std::string particles;   ///< file, folder or pattern
  std::int64_t every = 1;  ///< only every n-th snapshot of the series is read
  readers::Repeated repeated = readers::Repeated::refuse;
  WantedProducts wanted;
  std::vector<std::string> columns;  ///< their names, for dumps that store none
  std::optional<double> time_step;   ///< [s]; else from log.liggghts beside the dumps
  bool time_required = true;         ///< false: without a time step go on, counting steps
  std::int64_t step_zero = 0;

  std::optional<std::array<std::array<double, 3>, 2>>
      domain;  ///< min, max [m]; else the dump's box
  int up = 2, lateral = 0;
  std::vector<double> cell;  ///< [m] lateral, up; or lateral, depth, up for a 3-D grid
  std::vector<int> cells;    ///< their number, in the same order
  std::optional<std::array<bool, 3>> periodic;
  ByType density;  ///< [kg/m3]
  ByType radius;   ///< [m]
  std::vector<SpeciesRule> species;
  std::optional<std::array<double, 2>> average;  ///< from, to [s]; else `auto`
  std::string mapping = "exact";
  double gaussian_width = 0;  ///< of that kernel [m]; 0: the widest side of a cell

  std::vector<double> heights;  ///< [m]; empty: quarters of the domain
  double band = 0;              ///< [m]; 0: two cells
  ClusterThresholds clusters;
  std::optional<ClusterThresholds> bubbles;  ///< of the voidage; min_area 0: four cells
  bool bed = false;                          ///< asked for: [bed] or [bubbles]
  bool spectra = false;
  std::optional<double> height_at_rest;  ///< [m] above the floor; else the first snapshot's
  std::optional<double> segment;         ///< of a spectrum [s]
  std::string probes;                    ///< pressure probes of OpenFOAM: a folder or a file
  std::string temperature_column = "temperature";
  std::optional<std::array<double, 2>> temperature;  ///< made 0 and 1 in the PDF [K]
  int temperature_bins = 25;
  GasSettings gas;
};

}  // namespace bedscope::analysis
