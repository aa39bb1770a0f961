// SPDX-License-Identifier: GPL-3.0-or-later
// Reading the settings needs OpenFOAM's dictionaries: for OpenFOAM's side only.
#pragma once

#include <IOdictionary.H>
#include <Time.H>
#include "cases/coupled/bad_input.hpp"
#include "cases/coupled/settings.hpp"

namespace bedscope::coupled {

/// Throws BadInput, or Foam::error for what OpenFOAM's own parser minds.
Settings read_settings(const Foam::Time& time);

}  // namespace bedscope::coupled
