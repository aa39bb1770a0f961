// SPDX-License-Identifier: BSD-3-Clause
// Which VTK files hold the cells of a gas, time after time. Internal to this room.
#pragma once

#include <string>
#include <vector>

#include "readers/snapshot.hpp"

namespace bedscope::readers {

struct VtkGasTime {
  double time = unknown;           ///< [s], where an index tells it
  std::vector<std::string> files;  ///< one, or the pieces of several processors
};

/// The files of a folder or of one file; what is worth a warning goes to `problems`.
/// Throws FileError, InputError, FormatError as open_vtk_gas says.
std::vector<VtkGasTime> vtk_gas_files(const std::string& path, std::vector<std::string>& problems);

/// A file that may hold cells, found by looking at the heads of a few, or a damaged index that may
/// lead to one; empty where there is none.
std::string first_vtk_grid(const std::string& path);

}  // namespace bedscope::readers
