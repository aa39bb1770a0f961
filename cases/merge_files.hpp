// SPDX-License-Identifier: BSD-3-Clause
// Scene files that alter another one.
#pragma once

#include <toml++/toml.h>

#include <string>

namespace bedscope::cases {

/// The tables of a file and of those under it (`base`: one, or several of which the later ones lie
/// over the earlier), as one: a key of the upper file takes the place of the lower one's, tables
/// are merged key by key, [[species]] table by table, other arrays are replaced whole. Of the keys
/// that say the same thing in two ways (particles.number, .mass, .holdup, .lattice, .position) the
/// upper file's stays. Nodes keep the place in their own file for messages. Throws FileError,
/// InputError.
toml::table merged_file(const std::string& path);

}  // namespace bedscope::cases
