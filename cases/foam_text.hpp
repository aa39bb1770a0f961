// SPDX-License-Identifier: BSD-3-Clause
// Pieces of an OpenFOAM case; of use inside this room only.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cases/deck.hpp"

namespace bedscope::cases {

/// A file of OpenFOAM with its header.
std::string foam_file(std::string_view type, std::string_view object, std::string_view content);

/// The fields at the start: U, p, voidfraction, and T with energy.
std::vector<DeckFile> foam_fields(const Scene& scene);

/// A field that is uniform, with the same condition on all patches but inlet and outlet.
struct FoamField {
  std::string name, type, dimensions, inside, inlet, outlet, walls;
  std::string sides = {}, front_back = {};  ///< instead of `walls`, where given
};
DeckFile foam_field(const Scene& scene, const FoamField& field);

}  // namespace bedscope::cases
