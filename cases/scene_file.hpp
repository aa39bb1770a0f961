// SPDX-License-Identifier: BSD-3-Clause
// A scene as a TOML file (docs/scenes.md lists the keys).
#pragma once

#include <string>

#include "cases/scene.hpp"

namespace bedscope::cases {

/// Reads a scene. `base` names the file that this one alters, relative to it; `[scale]` is applied
/// last, to what all files together say.
/// Throws FileError, or InputError with file, line, key, what was expected and what was found.
Scene read_scene(const std::string& path);

/// The scene as a file of its own: without base and scale, every key that differs from its default.
std::string scene_text(const Scene& scene);

}  // namespace bedscope::cases
