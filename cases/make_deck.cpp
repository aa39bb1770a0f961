// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iterator>

#include "cases/deck.hpp"

namespace bedscope::cases {

DeckFile run_script(const Scene& scene) {
  std::string text = R"sh(#!/bin/sh
# Runs this case from its start: with bedscope-coupled where it is there, else the particles alone.
set -eu
cd "$(dirname "$0")"
)sh";
  if (scene.gas)
    text += R"sh(export WM_PROJECT_DIR="${WM_PROJECT_DIR:-/usr/share/openfoam}"  # Debian's
if command -v blockMesh >/dev/null; then
  blockMesh -case CFD >CFD/log.blockMesh
  checkMesh -case CFD >CFD/log.checkMesh
else
  echo "run.sh: no blockMesh: install Debian's package openfoam" >&2
fi
if command -v bedscope-coupled >/dev/null; then
  exec bedscope-coupled "$@"
fi
echo "run.sh: no bedscope-coupled: the particles are run alone, without gas" >&2
)sh";
  text += R"sh(command -v liggghts >/dev/null || {
  echo "run.sh: no liggghts: install Debian's package liggghts" >&2
  exit 2
}
exec liggghts -in DEM/in.liggghts -log DEM/log.liggghts "$@"
)sh";
  return {"run.sh", text, true};
}

std::vector<DeckFile> make_deck(const Scene& scene) {
  auto files = liggghts_deck(scene);
  const auto add = [&](std::vector<DeckFile> more) {
    std::move(more.begin(), more.end(), std::back_inserter(files));
  };
  if (scene.gas) {
    add(openfoam_case(scene));
    add({coupled_properties(scene)});
    add(cfdem_files(scene));
  }
  files.push_back(run_script(scene));
  return files;
}

}  // namespace bedscope::cases
