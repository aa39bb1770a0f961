// SPDX-License-Identifier: BSD-3-Clause
// What an OpenFOAM case holds: ranges of its fields and clouds over some or all of its times.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "readers/openfoam_case.hpp"

namespace bedscope::readers {

/// Smallest, largest and sum of numbers; those that are not finite are left out.
struct FoamRange {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  double sum = 0;
  std::size_t count = 0;

  void add(double value);
  bool empty() const { return count == 0; }
  double mean() const { return sum / static_cast<double>(count); }
};

/// Adds `values`, `ranges.size()` components together, to the ranges of the components.
void add_to_ranges(const std::vector<double>& values, std::vector<FoamRange>& ranges);

/// A field over the times that were read; the mean is over cells and times, not weighted.
struct FoamFieldSurvey {
  std::string name, class_name;
  std::array<double, 7> dimensions{};
  bool dimensions_known = false;
  std::size_t times = 0;          ///< that have it, of all
  std::size_t times_read = 0;     ///< of these, looked at
  std::size_t times_uniform = 0;  ///< of those, with one value for all cells
  std::vector<FoamRange> ranges;  ///< a component each
  std::size_t non_finite = 0;     ///< cells and times

  /// Has it the dimensions of a pressure over a density, m2/s2?
  bool kinematic_pressure() const;
};

struct FoamCloudSurvey {
  std::string name;
  std::size_t times = 0;                 ///< that have it
  std::array<std::size_t, 2> parcels{};  ///< fewest and most
  std::vector<std::string> columns;      ///< names that a request can use
  std::array<FoamRange, 3> centres;      ///< x, y, z [m] of the times read
  FoamRange radius, particles;           ///< [m]; particles that one parcel stands for
};

struct FoamSurvey {
  std::string format;  ///< of the fields: "ascii", "binary", "ascii gz" ...
  std::size_t times_read = 0;
  std::vector<FoamFieldSurvey> fields;  ///< in alphabetic order
  std::vector<FoamCloudSurvey> clouds;
  std::vector<std::string> problems;  ///< those of the case included
};

/// Reads all fields and clouds of the first time, the last and eight between, or of all (`full`).
/// Throws FormatError for what is wrong in them.
FoamSurvey survey(const OpenFoamCase& foam, bool full);
/// The same of another form of gas: fields only.
FoamSurvey survey(const GasForm& gas, bool full);

}  // namespace bedscope::readers
