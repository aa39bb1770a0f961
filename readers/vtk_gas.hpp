// SPDX-License-Identifier: BSD-3-Clause
// Gas that was converted to VTK: what foamToVTK and the function object vtkWrite make of a case
// (XML or -legacy), and files of the same kind by others. Values are those of cells; what VTK files
// hold for points is interpolated, and not read.
#pragma once

#include <memory>
#include <string>

#include "readers/gas_form.hpp"
#include "readers/openfoam_case.hpp"

namespace bedscope::readers {

/// Is it a folder or a file (.vtm.series, .pvd, .vtm, .pvtu, .vtu, .vtk) with cells of a gas? A
/// look at the first files only.
bool is_vtk_gas(const std::string& path);

/// Opening looks into every file. Times are those of a .series or .pvd, else TimeValue of the
/// files. In a folder: the one .series or .pvd that names cells, else the .vtm and .pvtu, else the
/// .vtu, else the .vtk files. A last time that is cut is left out, and said.
/// Symmetric tensors are brought from VTK's order to OpenFOAM's; units are not known.
/// Throws InputError where there is a choice (several lists, several meshes in a .vtm) or no times;
/// FormatError, CutError.
std::shared_ptr<const GasForm> open_vtk_gas(const std::string& path,
                                            const OpenFoamOptions& options = {});

}  // namespace bedscope::readers
