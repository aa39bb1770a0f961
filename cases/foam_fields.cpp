// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "cases/foam_text.hpp"

namespace bedscope::cases {
namespace {

constexpr const char* zero_gradient = "type zeroGradient;";

std::string fixed(const std::string& value) {
  return fmt::format("type fixedValue; value uniform {};", value);
}

std::string wall(bool slip) { return slip ? "type slip;" : "type noSlip;"; }

}  // namespace

DeckFile foam_field(const Scene& scene, const FoamField& f) {
  auto text = fmt::format("dimensions    {};\ninternalField uniform {};\n\nboundaryField\n{{\n",
                          f.dimensions, f.inside);
  const auto patch = [&](const char* name, const std::string& condition) {
    text += fmt::format("    {:<6} {{ {} }}\n", name, condition);
  };
  const auto& sides = f.sides.empty() ? f.walls : f.sides;
  const auto& front_back = f.front_back.empty() ? f.walls : f.front_back;
  patch("inlet", f.inlet);
  patch("outlet", f.outlet);
  patch("left", sides);
  patch("right", sides);
  if (scene.outlet.lateral()) patch("top", sides);
  patch("front", front_back);
  patch("back", front_back);
  return {"CFD/0/" + f.name, foam_file(f.type, f.name, text + "}\n")};
}

std::vector<DeckFile> foam_fields(const Scene& scene) {
  const auto velocity = fmt::format("(0 0 {:.12g})", scene.gas->velocity);
  // Superficial at the inlet, whatever the voidage there. The pressure's gradient on inlet and
  // walls follows from the flux: zero instead would halve it in the first cells of a bed.
  const auto inlet = fmt::format(
      "type interstitialInletVelocity; inletVelocity uniform {0}; alpha voidfraction; value "
      "uniform "
      "{0};",
      velocity);
  const std::string by_flux = "type fixedFluxExtrapolatedPressure; value uniform 0;";
  std::vector<DeckFile> files{
      foam_field(scene,
                 {"U", "volVectorField", "[0 1 -1 0 0 0 0]", velocity, inlet, zero_gradient,
                  "type noSlip;", wall(scene.walls.sides_slip), wall(scene.walls.front_back_slip)}),
      foam_field(scene,
                 {"p", "volScalarField", "[0 2 -2 0 0 0 0]", "0", by_flux, fixed("0"), by_flux}),
      foam_field(scene, {"voidfraction", "volScalarField", "[0 0 0 0 0 0 0]", "1", zero_gradient,
                         zero_gradient, zero_gradient})};
  if (scene.models.energy)
    files.push_back(foam_field(scene, {"T", "volScalarField", "[0 0 0 1 0 0 0]",
                                       fmt::format("{:.12g}", scene.particles.temperature),
                                       fixed(fmt::format("{:.12g}", scene.gas->temperature)),
                                       zero_gradient, zero_gradient}));
  return files;
}

}  // namespace bedscope::cases
