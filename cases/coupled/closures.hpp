// SPDX-License-Identifier: GPL-3.0-or-later
// The drag and heat laws of physics/ for many particles, behind a C++17 door.
#pragma once

#include <string>
#include <vector>

#include "cases/coupled/settings.hpp"

namespace bedscope::coupled {

/// K_i = 3 pi mu d eps F(eps, Re) [kg/s] with Re = eps rho |slip| d / mu; slip 3 a particle [m/s].
void drag_coefficients(const Settings& settings, const std::vector<double>& radius,
                       const std::vector<double>& voidage, const std::vector<double>& slip,
                       std::vector<double>& k);

/// h A of each particle [W/K].
void heat_coefficients(const Settings& settings, const std::vector<double>& radius,
                       const std::vector<double>& voidage, const std::vector<double>& slip,
                       std::vector<double>& ha);

}  // namespace bedscope::coupled
