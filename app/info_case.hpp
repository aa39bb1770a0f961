// SPDX-License-Identifier: BSD-3-Clause
// bedscope info of what OpenFOAM wrote: a case, one of its files, or what foamToVTK made of it.
#pragma once

#include <string>

namespace bedscope::app {

/// Prints what the path holds and returns true, where it is one of these.
/// `full`: the values of all times, not of ten of them.
bool info_openfoam(const std::string& path, bool full, bool json);

}  // namespace bedscope::app
