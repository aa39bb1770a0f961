// SPDX-License-Identifier: BSD-3-Clause
// results.h5: everything that an analysis found, documented in docs/results.md.
#pragma once

#include <filesystem>
#include <span>

#include "analysis/result.hpp"

namespace bedscope::analysis {

/// Writes all that `runs` hold to an HDF5 file: a group /runs/<n> for each (n from 1), and the mean
/// fields once more as VTKHDF image data, /VTKHDF, which ParaView and VTK 9.1 and later open.
///
/// A VTKHDF file holds one image. It is on the grid of the first run with fields, and has the
/// fields of every run on the same grid, `holdup of <type> [<label>]`; runs on another grid get
/// theirs in a file beside, results_<n>.h5 (n: the first of its runs), with nothing else in it.
/// Files of that name left by an earlier analysis of as many runs are removed.
/// Values stand at the cell centres (VTK 9.1 reads point data only); an axis with a single cell
/// has two points, on its two faces, of the same value (VTK 9.1 does not survive flat images).
/// Source: https://docs.vtk.org, "VTKHDF format specification", version 1.0, ImageData.
/// Throws FileError.
void write_results_file(std::span<const RunResult> runs, const std::filesystem::path& path);

}  // namespace bedscope::analysis
