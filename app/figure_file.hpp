// SPDX-License-Identifier: BSD-3-Clause
// The digitiser's file (TOML). docs/digitiser.md lists every key.
#pragma once

#include <string>
#include <vector>

#include "validation/digitise/figure.hpp"

namespace bedscope::app {

struct FigureFile {
  std::vector<std::string> images;  ///< pictures of one layout, relative to the file's folder
  digitise::Figure figure;
};

/// Throws FileError, or InputError with file, line, key, what was expected and what was found.
FigureFile read_figure(const std::string& path);

}  // namespace bedscope::app
