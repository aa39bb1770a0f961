#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""bedscope-coupled against OpenFOAM's DPMFoam: processor time of a gas step of the same riser.

    coupled_bench.py FOLDER [ROUNDS]

The scene is cases/riser/K2_b.toml: 8,720 gas cells, 6,250 particles, 10 particle steps in a gas step of
1e-4 s. Both programs start from the same positions and solve the same mesh to the same tolerances with
two pressure corrections. DPMFoam has no Beetstra law, no constant inventory and no linear dashpot: it
runs ErgunWenYuDrag and its own spring with the stiffness of the scene. What starting costs is taken off
by the difference of a long and a short run; rounds alternate between the programs.
"""
import json
import os
import pathlib
import re
import resource
import shutil
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build/release"
ENV = dict(os.environ, WM_PROJECT_DIR=os.environ.get("WM_PROJECT_DIR", "/usr/share/openfoam"))
STEP, SHORT, LONG = 1e-4, 10, 60
HEADER = "FoamFile {{ version 2.0; format ascii; class {}; object {}; }}\n"


def run(folder, *words):
    """Processor seconds and output."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([str(w) for w in words], cwd=folder, env=ENV, text=True, capture_output=True)
    if done.returncode:
        sys.exit(f"{folder}: {words[0]} ended with {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout


def put(path, kind, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(HEADER.format(kind, path.name) + text)


def end_after(control, steps):
    text = re.sub(r"endTime\s+[^;]+;", f"endTime {steps * STEP:g};", control.read_text())
    text = re.sub(r"writeInterval\s+[^;]+;", "writeInterval 1;", text)
    control.write_text(re.sub(r"startFrom\s+\w+;", "startFrom startTime;", text))


def dpm_case(ours, folder):
    """The same mesh, gas and positions for DPMFoam."""
    shutil.copytree(ours / "CFD", folder)
    for name in ("0", "constant"):
        for file in (folder / name).iterdir():
            if file.is_file():
                file.unlink()
    control = folder / "system/controlDict"
    control.write_text(control.read_text().replace("bedscope-coupled", "DPMFoam"))
    velocity = (ours / "CFD/0/U").read_text().split("internalField")[1].split("(0 0 ")[1].split(")")[0]
    properties = (ours / "CFD/constant/coupledProperties").read_text()
    nu = float(re.search(r"viscosity ([^;]+);", properties)[1]) / 1.2
    gravity = re.search(r"gravity\s+([^;]+);", properties)[1]
    solution = folder / "system/fvSolution"
    solution.write_text(solution.read_text().replace('"(U|', '"(U.air|').replace("PISO", "PIMPLE\n{\n    nOuterCorrectors 1;", 1)
                        .replace("nOuterCorrectors 1;\n{", "nOuterCorrectors 1;"))
    put(folder / "system/fvSchemes", "dictionary", """
ddtSchemes { default Euler; } gradSchemes { default Gauss linear; }
divSchemes { default Gauss linear; div(alphaPhi.air,U.air) Gauss linearUpwind grad(U); }
laplacianSchemes { default Gauss linear orthogonal; } interpolationSchemes { default linear; } snGradSchemes { default orthogonal; }""")
    put(folder / "constant/g", "uniformDimensionedVectorField", f"dimensions [0 1 -2 0 0 0 0]; value {gravity};")
    put(folder / "constant/transportProperties", "dictionary",
        f"continuousPhase air; rho.air 1.2; transportModel Newtonian; nu {nu};")
    put(folder / "constant/turbulenceProperties.air", "dictionary", "simulationType laminar;")
    walls = "".join(f"{w} {{ type noSlip; }} " for w in ("left", "right", "top", "front", "back"))
    put(folder / "0/U.air", "volVectorField", f"""dimensions [0 1 -1 0 0 0 0]; internalField uniform (0 0 {velocity});
boundaryField {{ inlet {{ type fixedValue; value $internalField; }} outlet {{ type zeroGradient; }} {walls} }}""")
    flux = "".join(f"{w} {{ type fixedFluxPressure; }} " for w in ("inlet", "left", "right", "top", "front", "back"))
    put(folder / "0/p", "volScalarField", f"""dimensions [0 2 -2 0 0 0 0]; internalField uniform 0;
boundaryField {{ outlet {{ type fixedValue; value uniform 0; }} {flux} }}""")
    rows = (ours / "DEM/particles.data").read_text().split("Atoms")[1].split("\n\n")[1].strip().splitlines()
    spheres = [row.split() for row in rows]
    diameter, density = float(spheres[0][2]), float(spheres[0][3])
    put(folder / "constant/kinematicCloudPositions", "vectorField",
        "(\n" + "\n".join("({} {} {})".format(*s[4:7]) for s in spheres) + "\n)\n")
    deck = (ours / "DEM/in.liggghts").read_text()
    stiffness = float(re.search(r"property/global kn peratomtypepair \d+[\s&]+(\S+)", deck)[1])
    # k = 4/3 sqrt(R) E / (2 (1 - nu^2)) with the reduced radius R = d/4 and b = 1: a linear spring
    young = stiffness * 0.75 / (diameter / 4) ** 0.5 * 2 * (1 - 0.25**2)
    put(folder / "constant/kinematicCloudProperties", "dictionary", f"""
solution {{ active true; coupled true; transient yes; cellValueSourceCorrection off; maxCo 0.3;
  interpolationSchemes {{ rho.air cell; U.air cellPoint; mu.air cell; }}
  integrationSchemes {{ U Euler; }} sourceTerms {{ schemes {{ U semiImplicit 1; }} }} }}
constantProperties {{ parcelTypeId 1; rhoMin 1e-15; minParticleMass 1e-15; rho0 {density}; youngsModulus {young:.6g};
  poissonsRatio 0.25; constantVolume false; alphaMax 0.75; }}
subModels {{
  particleForces {{ ErgunWenYuDrag {{ alphac alpha.air; }} gravity; }}
  injectionModels {{ start {{ type manualInjection; massTotal 0; parcelBasisType fixed; nParticle 1; SOI 0;
    positionsFile "kinematicCloudPositions"; U0 (0 0 0);
    sizeDistribution {{ type fixedValue; fixedValueDistribution {{ value {diameter}; }} }} }} }}
  dispersionModel none; patchInteractionModel standardWallInteraction; standardWallInteractionCoeffs {{ type rebound; e 0.86; mu 0.15; }}
  heatTransferModel none; surfaceFilmModel none; stochasticCollisionModel none; radiation off;
  collisionModel pairCollision;
  pairCollisionCoeffs {{ maxInteractionDistance {diameter}; writeReferredParticleCloud no;
    pairModel pairSpringSliderDashpot;
    pairSpringSliderDashpotCoeffs {{ useEquivalentSize no; alpha 0.02; b 1; mu 0.15; cohesionEnergyDensity 0; collisionResolutionSteps RESOLUTION; }}
    wallModel wallSpringSliderDashpot;
    wallSpringSliderDashpotCoeffs {{ useEquivalentSize no; collisionResolutionSteps RESOLUTION; youngsModulus {young:.6g}; poissonsRatio 0.25;
      alpha 0.02; b 1; mu 0.15; cohesionEnergyDensity 0; }} U U.air; }} }}
cloudFunctions {{ }}""")


def main(folder, rounds):
    folder = pathlib.Path(folder).resolve()
    ours, dpm = folder / "bedscope", folder / "DPMFoam"
    run(ROOT, BUILD / "app/bedscope", "case", "make", ROOT / "cases/riser/K2_b.toml", "-o", ours)
    dpm_case(ours, dpm)
    run(ours, "blockMesh", "-case", "CFD")
    run(dpm, "blockMesh")
    cloud = dpm / "constant/kinematicCloudProperties"
    text = cloud.read_text()
    resolution, cycles = 60, 0
    for _ in range(4):  # DPMFoam chooses its particle steps by a formula for Hertz' contact: 10 of them are wanted
        cloud.write_text(text.replace("RESOLUTION", str(resolution)))
        end_after(dpm / "system/controlDict", 3)
        cycles = int(re.findall(r"(\d+) move-collide subCycles", run(dpm, "DPMFoam")[1])[-1])
        if cycles == 10:
            break
        resolution = round(resolution * 10 / cycles)
    times = {"bedscope-coupled": [], "DPMFoam": []}
    for _ in range(rounds):
        for name, place, words, control in (("bedscope-coupled", ours, [BUILD / "cases/coupled/bedscope-coupled", "--again"], ours / "CFD/system/controlDict"),
                                            ("DPMFoam", dpm, ["DPMFoam"], dpm / "system/controlDict")):
            used = []
            for steps in (SHORT, LONG):
                end_after(control, steps)
                used.append(run(place, *words)[0])
            times[name].append((used[1] - used[0]) / (LONG - SHORT) * 1e3)
            print(f"{name}: {times[name][-1]:.1f} ms of processor time a gas step", flush=True)
    ratio = [d / o for o, d in zip(times["bedscope-coupled"], times["DPMFoam"])]
    print(f"DPMFoam with {cycles} particle steps in a gas step; ratio {statistics.median(ratio):.1f} "
          f"({min(ratio):.1f} to {max(ratio):.1f} in {rounds} rounds)")
    cost = json.loads((ours / "run.json").read_text())["costs"]
    print(f"{cost['particle_steps_per_second']:.3g} particle-steps/s, {cost['cell_steps_per_second']:.3g} cell-steps/s (wall clock)")


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 3)
