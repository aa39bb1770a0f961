// SPDX-License-Identifier: BSD-3-Clause
// What a series holds: counts from all headers, ranges from the rows of some or all snapshots.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "readers/flaws.hpp"
#include "readers/overlaps.hpp"
#include "readers/series.hpp"

namespace bedscope::readers {

/// Smallest and largest of some values; min > max where there was none.
struct Range {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  bool any() const { return min <= max; }
  void add(double value) {
    if (value < min) min = value;
    if (value > max) max = value;
  }
};

/// One column under its name on disk, over the snapshots read. Ranges leave out what is not finite.
struct ColumnSurvey {
  std::string name;
  Range range;
  double sum = 0;  ///< of the finite values
  std::int64_t values = 0, zeros = 0, not_finite = 0;
  std::string first_not_finite;  ///< where: "post/dump100: line 13"

  double mean() const {
    const auto finite = values - not_finite;
    return finite > 0 ? sum / static_cast<double>(finite) : unknown;
  }
  bool constant() const { return values > 1 && not_finite == 0 && range.min == range.max; }
};

/// The particles of one type, over the snapshots read.
struct SpeciesSurvey {
  std::int64_t particles = 0;
  Range radius;           ///< [m]
  Range density;          ///< of the dump's column [kg/m3]
  Range mass;             ///< of the dump's column [kg]
  Range implied_density;  ///< mass over the sphere's volume [kg/m3]
};

/// One snapshot whose rows were read. NaN where the dumps do not tell.
struct SnapshotSurvey {
  std::size_t index = 0;                    ///< in the series
  double volume = unknown, mass = unknown;  ///< of all particles [m3], [kg]
  double holdup = unknown;                  ///< of the box
};

/// The deepest overlap among the snapshots read.
struct DeepestOverlap {
  bool tested = false;
  std::size_t snapshot = 0;
  Overlaps found;
  std::string place;  ///< of one of the two particles
};

/// Columns that hold words by LAMMPS' naming: chemical symbols and labels of types.
inline bool holds_text(std::string_view column) {
  return column == "element" || column == "typelabel";
}

struct Survey {
  // From the headers of all snapshots.
  std::vector<std::int64_t> steps;
  std::vector<double> times;                ///< [s]; empty where the form stores none
  std::vector<std::int64_t> counts;         ///< particles of each snapshot
  std::array<std::int64_t, 2> particles{};  ///< fewest and most in a snapshot
  Box box;                                  ///< of the first snapshot
  std::string temperature_column;           ///< its name on disk; empty: there is none
  bool has_bodies = false;                  ///< multi-sphere: several rows make one particle
  bool has_shapes = false;                  ///< superquadrics: no spheres

  // From the rows.
  std::size_t snapshots_read = 0;
  std::vector<SnapshotSurvey> read;  ///< one each
  std::vector<ColumnSurvey> columns;
  std::map<std::int64_t, SpeciesSurvey> types;
  bool has_radius = false;
  std::array<double, 2> radius{};      ///< smallest and largest [m]
  std::array<double, 3> min{}, max{};  ///< of the centres [m]
  bool has_particles = false;          ///< false: bounds mean nothing
  double fastest = 0;                  ///< largest speed [m/s]
  std::string fastest_place;
  Range mass_ratio;              ///< mass over density times the sphere's volume, row by row
  std::int64_t outside_box = 0;  ///< centres beyond a fixed (f) side of the box
  DeepestOverlap overlap;
  std::vector<std::string> problems;  ///< of the series, and flawed particles

  const ColumnSurvey* column(const std::string& name) const;
};

/// The first of `count` snapshots, the last and eight between, or all (`full`), ascending.
std::vector<std::size_t> chosen_snapshots(std::size_t count, bool full);

/// Reads the rows of the first, the last and eight snapshots between, or of all (`full`); every
/// column once; of none where nobody named the columns. Overlaps are looked for in the first, the
/// middle and the last of those.
Survey survey(const Series& series, bool full);

}  // namespace bedscope::readers
