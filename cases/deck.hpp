// SPDX-License-Identifier: BSD-3-Clause
// A scene as decks for LIGGGHTS 3.8.0, OpenFOAM 1912, bedscope-coupled and CFDEMcoupling.
#pragma once

#include <string>
#include <vector>

#include "cases/scene.hpp"

namespace bedscope::cases {

struct DeckFile {
  std::string path;  ///< relative to the case's folder
  std::string content;
  bool executable = false;
};

/// All files of a case. Throws InputError where the particles do not fit.
std::vector<DeckFile> make_deck(const Scene& scene);

// The parts.
std::vector<DeckFile> liggghts_deck(const Scene& scene);
std::vector<DeckFile> openfoam_case(const Scene& scene);
DeckFile coupled_properties(const Scene& scene);
std::vector<DeckFile> cfdem_files(const Scene& scene);
DeckFile run_script(const Scene& scene);

}  // namespace bedscope::cases
