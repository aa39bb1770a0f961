// SPDX-License-Identifier: BSD-3-Clause
// The tables that OpenFOAM's function objects write under postProcessing/: probes, averages over
// volumes and patches, flow rates, forces, solver information.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bedscope::readers {

/// A table whose rows are times. Vectors and nested parentheses are taken apart, a column each.
struct FoamTable {
  struct Column {
    /// "areaAverage(p)", "areaAverage(U) x", "forces pressure x", "probe 2", "probe 2 x"; "column
    /// 3", counted from 1 as on disk, where the file does not tell.
    std::string title;
    std::optional<std::size_t> point;  ///< of a probe: index into `points`
    std::vector<double> values;        ///< NaN where a probe was not found
    std::vector<std::string> words;    ///< in place of values: "smoothSolver", "true"
  };
  struct Point {
    std::array<double, 3> place{};  ///< [m]
    bool found = true;              ///< false: outside the mesh
  };
  std::vector<double> times;    ///< the first column; ascending, but rows may share a time
  std::vector<Column> columns;  ///< none where there are no rows
  std::vector<Point> points;    ///< of probes
  std::vector<std::string> files;
  std::vector<std::string> problems;  ///< a cut last row, probes that were not found

  const Column* find(std::string_view title) const;
};

/// Reads one file, plain or gzip. A last row that is cut (no line end, or values missing) is left
/// out and said. Where time goes back, as in a file that a restart went on with, the later rows
/// win. Throws FileError; FormatError with path and line for rows that differ in their values.
FoamTable read_foam_table(const std::string& path);

/// The table `name` ("p", "surfaceFieldValue") under postProcessing/<object>: the files <name>,
/// <name>.dat, <name>_<time>.dat in all its start-time directories joined; from the first row of a
/// later start on only that one counts. `name` may be empty where there is but one table. A file,
/// or one start-time directory, will do as well. Throws InputError where there is no such table, or
/// several and no name.
FoamTable open_foam_table(const std::string& path, const std::string& name = {});

/// Whether a file is such a table, by its head: comments that name a probe, or end in "# Time ...".
bool is_foam_table(const std::string& path);

}  // namespace bedscope::readers
