// SPDX-License-Identifier: BSD-3-Clause
// The tidy CSV tables under tables/, which other programs rely on: docs/results.md.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "analysis/result.hpp"

namespace bedscope::analysis {

/// Writes axial_profile, lateral_profile, inventory, clusters and cluster_occurrence (.csv) into
/// `folder`, with their header alone where there are no rows; temperature and temperature_pdf only
/// where a run has a temperature (or a PDF), else one left there earlier is removed; and the tables
/// of bed_tables.hpp and of the gas (gas_tables.hpp); series where a run has some. Times are nan
/// where a run's are not known, masses and mass fluxes where its density is not. Throws FileError.
void write_tables(std::span<const RunResult> runs, const std::filesystem::path& folder);

/// The reverse: what the tables in `folder` (or in its subfolder tables/) tell of the run `label`.
/// Where they hold one run only it is taken, whatever its name; the result is named `label`.
///
/// Columns are found by name, in any order; others are ignored. Needed are a table's coordinates
/// (`z [m]`; `height [m]` and `x [m]`; `time [s]`; `bin_centre [-]`) and `particles`, `clusters`,
/// `mean [K]` and `probability_density [-]` of their tables; all of series.csv but the run; of
/// clusters.csv `time [s]`, `x [m]` and `z [m]`. What is left out is NaN, `type` is "all",
/// `cluster` and `track` are 0. The rows of a profile may come in any order. The grid is that of
/// the profiles' coordinates, one cell deep, depth from 0 to 0 (unknown); where coordinates are not
/// evenly spaced `problems` says so. What the tables do not tell stays unknown: window (no
/// snapshots, times NaN), estimates (NaN), fields, frames and contours (empty). Cluster::snapshot
/// is the place of its time in cluster_occurrence.csv, or the number of earlier snapshots in
/// clusters.csv where that table is missing or times are not known. Throws InputError where there
/// is no table or no such run, FormatError ("path: line N: expected ..., found ...") and FileError.
RunResult read_tables(const std::filesystem::path& folder, const std::string& label);

/// The averaging window of a result that was read from tables, whose series go on outside it: the
/// rows with from <= t <= to, or for nothing the steady part of the inventory ("auto": from a block
/// of 16 rows on; fewer than 20 rows are taken whole). Gives also the bed's means and the pressure
/// drop's over it. Where no row has a time the window's ends are from and to alone.
/// Throws InputError where the tables have times and none is in the window.
void choose_window(RunResult& run, const std::optional<std::array<double, 2>>& average);

}  // namespace bedscope::analysis
