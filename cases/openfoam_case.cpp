// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "cases/block_mesh.hpp"
#include "cases/deck.hpp"
#include "cases/foam_text.hpp"

namespace bedscope::cases {
namespace {

std::string block_mesh_dict(const BlockMesh& mesh) {
  std::string text = "scale 1;\n\nvertices\n(\n";
  for (const double y : {0.0, mesh.depth})
    for (const auto& [x, z] : mesh.points)
      text += fmt::format("    ({:.12g} {:.12g} {:.12g})\n", x, y, z);
  const auto back = mesh.points.size();
  text += ");\n\nblocks\n(\n";
  for (const auto& [c, across, up] : mesh.blocks)
    text += fmt::format("    hex ({} {} {} {} {} {} {} {}) ({} {} {}) simpleGrading (1 1 1)\n",
                        c[0], c[1], c[1] + back, c[0] + back, c[3], c[2], c[2] + back, c[3] + back,
                        across, mesh.deep, up);
  text += ");\n\nedges\n(\n";
  for (const auto& arc : mesh.arcs)
    for (const bool behind : {false, true})
      text +=
          fmt::format("    arc {} {} ({:.12g} {:.12g} {:.12g})\n",
                      arc.edge.first + (behind ? back : 0), arc.edge.second + (behind ? back : 0),
                      arc.through[0], behind ? mesh.depth : 0, arc.through[1]);
  text += ");\n\nboundary\n(\n";
  const auto patch = [&](const std::string& name, const std::string& faces) {
    const char* type = name == "inlet" || name == "outlet" ? "patch" : "wall";
    text += fmt::format("    {}\n    {{\n        type {};\n        faces ({} );\n    }}\n", name,
                        type, faces);
  };
  for (const auto& [name, edges] : mesh.patches) {
    std::string faces;
    for (const auto& [a, b] : edges)
      faces += fmt::format(" ({} {} {} {})", a, b, b + back, a + back);
    patch(name, faces);
  }
  for (const bool behind : {false, true}) {
    std::string faces;
    for (const auto& block : mesh.blocks) {
      faces += " (";
      for (const auto corner : block.corners)
        faces += fmt::format("{} ", corner + (behind ? back : 0));
      faces.back() = ')';
    }
    patch(behind ? "back" : "front", faces);
  }
  return foam_file("dictionary", "blockMeshDict", text + ");\n");
}

std::string control_dict(const Scene& scene) {
  const auto& n = scene.numerics;
  return foam_file("dictionary", "controlDict",
                   fmt::format(R"(application       bedscope-coupled;
startFrom         latestTime;
startTime         0;
stopAt            endTime;
endTime           {:.12g};
deltaT            {:.12g};
writeControl      runTime;
writeInterval     {:.12g};
purgeWrite        0;
writeFormat       binary;
writePrecision    10;
writeCompression  off;
timeFormat        general;
timePrecision     10;
runTimeModifiable false;
adjustTimeStep    no;
)",
                               n.end, n.gas_step, n.output));
}

// Only a bend's cells have oblique faces; elsewhere the correction is nothing and costs a gradient
// of each component that is diffused.
std::string schemes(const Scene& scene) {
  const char* faces = scene.outlet.head == Head::box ? "orthogonal" : "corrected";
  return fmt::format(R"(ddtSchemes      {{ default Euler; }}
gradSchemes     {{ default Gauss linear; }}
divSchemes
{{
    default         Gauss linear;
    div(alphaPhi,U) Gauss limitedLinearV 1;
    div(alphaPhi,T) Gauss limitedLinear 1;
    div(phi,U)      Gauss limitedLinearV 1;
    div(phi,T)      Gauss limitedLinear 1;
    div((voidfraction*nu*dev2(T(grad(U))))) Gauss linear;
}}
laplacianSchemes     {{ default Gauss linear {0}; }}
interpolationSchemes {{ default linear; }}
snGradSchemes        {{ default {0}; }}
)",
                     faces);
}

// Tall columns: GAMG needs a few sweeps where PCG needs hundreds. A smoother never gets a velocity
// component that is all but zero (the lateral ones of a fixed bed) to 1e-9 of itself and makes its
// 1000 sweeps each step. The second corrector takes the non-orthogonal part from the first; a
// bend's 25 degrees need no more. An iterative solution of the coarsest level costs a quarter of
// the pressure's time; the limiter and the stress share the velocity's gradient.
constexpr const char* solution = R"(solvers
{
    p
    {
        solver          GAMG;
        smoother        GaussSeidel;
        nFinestSweeps   1;
        nCellsInCoarsestLevel 50;
        directSolveCoarsest true;
        tolerance       1e-8;
        relTol          0.01;
    }
    pFinal
    {
        $p;
        relTol          0;
    }
    "(U|T|k|epsilon)(Final)?"
    {
        solver          PBiCGStab;
        preconditioner  DILU;
        tolerance       1e-9;
        relTol          0;
    }
}

cache
{
    grad(U);
}

PISO
{
    nCorrectors              2;
    nNonOrthogonalCorrectors 0;
}
)";

constexpr const char* decomposition = R"(numberOfSubdomains 2;
method             simple;
simpleCoeffs
{
    n     (1 1 2);
    delta 0.001;
}
)";

}  // namespace

std::string foam_file(std::string_view type, std::string_view object, std::string_view content) {
  return fmt::format(
      "FoamFile\n{{\n    version     2.0;\n    format      ascii;\n    class       {};\n    object "
      "  "
      "   {};\n}}\n\n{}",
      type, object, content);
}

std::vector<DeckFile> openfoam_case(const Scene& scene) {
  const auto dictionary = [](const std::string& object, std::string_view content) {
    return foam_file("dictionary", object, content);
  };
  std::vector<DeckFile> files{
      {"CFD/system/blockMeshDict", block_mesh_dict(block_mesh(scene))},
      {"CFD/system/controlDict", control_dict(scene)},
      {"CFD/system/fvSchemes", dictionary("fvSchemes", schemes(scene))},
      {"CFD/system/fvSolution", dictionary("fvSolution", solution)},
      {"CFD/system/decomposeParDict", dictionary("decomposeParDict", decomposition)},
      {"CFD/constant/transportProperties",
       dictionary("transportProperties",
                  fmt::format("transportModel Newtonian;\nnu  nu  [0 2 -1 0 0 0 0] {0:.12g};\nrho "
                              "rho [1 -3 0 0 0 0 0] {1:.12g};\n",
                              scene.gas->viscosity / scene.gas->density, scene.gas->density))},
      {"CFD/constant/turbulenceProperties",
       dictionary("turbulenceProperties", "simulationType laminar;\n")},
      {"CFD/constant/g",
       foam_file(
           "uniformDimensionedVectorField", "g",
           fmt::format("dimensions [0 1 -2 0 0 0 0];\nvalue (0 0 {:.12g});\n", -scene.gravity))}};
  auto fields = foam_fields(scene);
  std::move(fields.begin(), fields.end(), std::back_inserter(files));
  return files;
}

}  // namespace bedscope::cases
