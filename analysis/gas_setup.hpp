// SPDX-License-Identifier: BSD-3-Clause
// Which field of a gas series is what, and in which unit.
#pragma once

#include <string>
#include <vector>

#include "analysis/gas_settings.hpp"

namespace bedscope::analysis {

struct GasSetup {
  GasFieldNames fields;        ///< as on disk, `solids` instead of `voidage` where eps = 1 - it
  double pressure_factor = 1;  ///< from what is on disk to [Pa]
  std::size_t times = 0;       ///< that are used: a last one that is being written is not
  std::vector<std::string> problems;
};

/// Finds the fields: those that the study names; else voidage `voidfraction`, `alpha.air`,
/// `alpha.gas`, the one `alpha.<phase>` beside a solid phase, or 1 - the one solid phase; velocity
/// and temperature of that phase, or of the only one (`U`, `T`); pressure `p` or `p_rgh`.
/// A pressure of dimensions [0 2 -2] is multiplied by the study's gas_density, without which there
/// is no pressure (said in problems). One whose dimensions are not on disk (VTK) is p/rho where the
/// study gives a gas_density, else in Pa; either is said.
/// Throws InputError for a field that the study names and that is nowhere, where no voidage is
/// found, and for a pressure of other dimensions.
GasSetup set_up_gas(const std::string& label, const GasSettings& settings,
                    const readers::GasSeries& series);

}  // namespace bedscope::analysis
