// SPDX-License-Identifier: BSD-3-Clause
// What `bedscope case` prints.
#pragma once

#include <string>
#include <vector>

#include "cases/check.hpp"
#include "cases/scale_scene.hpp"

namespace bedscope::app {

std::string scale_json(const cases::Scene& scaled, const cases::ScalingReport& report);
std::string scale_text(const cases::Scene& scaled, const cases::ScalingReport& report);
std::string check_json(const cases::Scene& scene, const cases::CheckReport& report,
                       const std::vector<std::string>& remarks);
std::string check_text(const cases::Scene& scene, const cases::CheckReport& report,
                       const std::vector<std::string>& remarks);

}  // namespace bedscope::app
