// SPDX-License-Identifier: BSD-3-Clause
// Files for CFDEMcoupling-PUBLIC 3.8 (cfdemSolverPiso), by the keys of its own tutorials. Untested:
// it is no Debian package. It knows no constant inventory, so what leaves stays away; its feed is
// LIGGGHTS' own.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "cases/deck.hpp"
#include "cases/foam_text.hpp"

namespace bedscope::cases {
namespace {

std::string drag_model(const std::string& law) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> models{
      {{"beetstra", "BeetstraDrag"},
       {"di_felice", "DiFeliceDrag"},
       {"gidaspow", "GidaspowDrag"},
       {"wen_yu", "GidaspowDrag"},
       {"ergun", "GidaspowDrag"}}};
  for (const auto& [name, model] : models)
    if (name == law) return std::string(model);
  return "GidaspowDrag";
}

std::string coupling_properties(const Scene& scene) {
  const auto drag = drag_model(scene.models.drag);
  const bool centre = scene.models.void_fraction == VoidFraction::centre;
  auto text = std::string("// Untested: written by the keys of CFDEMcoupling's tutorials.\n");
  if (scene.models.drag == "wen_yu" || scene.models.drag == "ergun")
    text += fmt::format("// GidaspowDrag joins Ergun and Wen-Yu; the scene asks for {} alone.\n",
                        scene.models.drag);
  return text + fmt::format(
                    R"(syncMode           false;
modelType          "A";
couplingInterval   {};
voidFractionModel  {};
locateModel        engine;
meshMotionModel    noMeshMotion;
regionModel        allRegion;
IOModel            basicIO;
probeModel         off;
dataExchangeModel  twoWayMPI;
averagingModel     dense;
clockModel         off;
smoothingModel     off;
forceModels        ( {} gradPForce viscForce{} );
momCoupleModels    ( {} );
turbulenceModelType "turbulenceProperties";

{}Props
{{
    velFieldName          "U";
    granVelFieldName      "Us";
    voidfractionFieldName "voidfraction";
    gravityFieldName      "g";
    rhoParticle           {:.9g};
    interpolation         true;
    phi                   1;
}}
gradPForceProps     {{ pFieldName "p"; voidfractionFieldName "voidfraction"; velocityFieldName "U"; interpolation true; }}
viscForceProps      {{ velocityFieldName "U"; interpolation true; }}
LaEuScalarTempProps {{ velFieldName "U"; tempFieldName "T"; voidfractionFieldName "voidfraction"; partTempName "Temp"; partHeatFluxName "convectiveHeatFlux"; lambda {:.9g}; Cp {:.9g}; interpolation true; }}
{}CoupleProps {{ velFieldName "U"; granVelFieldName "Us"; voidfractionFieldName "voidfraction"; }}
engineProps         {{ treeSearch true; }}
centreProps         {{ alphaMin 0.25; }}
dividedProps        {{ alphaMin 0.25; scaleUpVol 1.0; }}
twoWayMPIProps      {{ liggghtsPath "../DEM/in.liggghts_cfdem"; }}
)",
                    std::llround(scene.numerics.gas_step / scene.numerics.dem_step),
                    centre ? "centre" : "divided", drag,
                    scene.models.energy ? " LaEuScalarTemp" : "",
                    scene.models.implicit_drag ? "implicitCouple" : "explicitCouple", drag,
                    mean_density(scene), scene.gas->conductivity, scene.gas->heat_capacity,
                    scene.models.implicit_drag ? "implicit" : "explicit");
}

}  // namespace

std::vector<DeckFile> cfdem_files(const Scene& scene) {
  const std::string zero = "type zeroGradient;";
  const auto field = [&](const char* name, const char* type, const char* dimensions,
                         const std::string& inside) {
    return foam_field(scene, {name, type, dimensions, inside, zero, zero, zero});
  };
  return {{"CFD/constant/couplingProperties",
           foam_file("dictionary", "couplingProperties", coupling_properties(scene))},
          {"CFD/constant/liggghtsCommands",
           foam_file("dictionary", "liggghtsCommands",
                     "// Untested.\nliggghtsCommandModels ( runLiggghts );\n")},
          {"DEM/in.liggghts_cfdem",
           "# For CFDEMcoupling, untested: the deck as seen from CFD/, coupled, without a run.\n"
           "variable folder  index ../DEM\nvariable coupled index 1\nvariable steps   index 0\n"
           "include ../DEM/in.liggghts\n"},
          field("Us", "volVectorField", "[0 1 -1 0 0 0 0]", "(0 0 0)"),
          field("Ksl", "volScalarField", "[1 -3 -1 0 0 0 0]", "0"),
          field("rho", "volScalarField", "[1 -3 0 0 0 0 0]",
                fmt::format("{:.9g}", scene.gas->density))};
}

}  // namespace bedscope::cases
