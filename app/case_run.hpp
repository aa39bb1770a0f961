// SPDX-License-Identifier: BSD-3-Clause
// A run as a scene to be checked.
#pragma once

#include <string>
#include <vector>

#include "cases/scene.hpp"

namespace bedscope::app {

/// Whether `path` is something else than a scene: dumps, a folder, results.h5, a study.
bool is_run(const std::string& path);

/// The scene of a run: `scene_path`, or a scene.toml in its folder or up to three above it, with
/// what the run tells laid over. Throws FileError, FormatError, InputError.
cases::Scene scene_of_run(const std::string& path, const std::string& scene_path,
                          std::vector<std::string>& remarks);

}  // namespace bedscope::app
