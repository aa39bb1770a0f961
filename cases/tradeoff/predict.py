#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a run of a scene will cost, by the law of cost of the runs that are kept.

    BEDSCOPE=build/release/app/bedscope cases/tradeoff/predict.py cases/riser/scene.toml --kept data/runs/tradeoff*

--seconds is the simulated time, the scene's numerics.end where it is not given. The runs were made on one machine; --like gives
the folder of a run (a short one of K_4.toml, say) made on the machine that is meant, which then counts as so much slower or
faster than the law. On several ranks core-seconds grow by what they wait for each other. --measure runs the scene itself for so
many seconds of simulated time, a few hundredths, and says how far off the law is: the cycles of the pressure's solver depend on the grid.
--each shows what the law says of each kept run that it is fitted without, --without leaves runs out altogether.
"""
import argparse
import pathlib
import sys
import tempfile

import runs
from law import Law


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--kept", type=pathlib.Path, nargs="+", required=True)
    parser.add_argument("--seconds", type=float)
    parser.add_argument("--like", type=pathlib.Path)
    parser.add_argument("--measure", type=float)
    parser.add_argument("--each", action="store_true")
    parser.add_argument("--without", nargs="+", default=[])
    asked = parser.parse_args()
    costs = [cost for kept in asked.kept for cost in runs.load(kept)[1]]
    if unknown := set(asked.without) - {cost.name for cost in costs}:
        raise runs.Failed(f"--without: expected names of kept runs, found {', '.join(sorted(unknown))}")
    costs = [cost for cost in costs if cost.name not in asked.without]
    law = Law(costs)
    print(f"{len(costs)} runs: {law} (95 %), scatter {100 * law.scatter:.2g} %")
    for left_out in costs if asked.each else []:
        ms, half = Law([c for c in costs if c is not left_out]).predict(left_out.particles, left_out.dem_steps, left_out.cells)
        within = "" if abs(left_out.ms_per_step - ms) <= half else ", outside"
        print(f"{left_out.name}: {ms:.3g} ± {half:.2g} ms without it, measured {left_out.ms_per_step:.3g}{within}")
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        scene = runs.scene_of(runs.made(asked.scene, work / "case"))
        measured = runs.step_cost(asked.scene, work, asked.measure) if asked.measure else None
    numerics = scene["numerics"]
    cells = numerics["grid"][0] * numerics["grid"][1] * numerics["grid"][2]
    dem_steps = round(numerics["gas_step"] / numerics["dem_step"])
    seconds = asked.seconds or numerics["end"]
    ms, half = law.predict(scene["particles"]["number"], dem_steps, cells)
    speed = 1.0
    if asked.like:
        cost = runs.Cost(asked.like)
        speed = cost.ms_per_step / law.predict(cost.particles, cost.dem_steps, cost.cells)[0]
        print(f"{asked.like}: {cost.ms_per_step:.3g} ms a gas step, {speed:.2f} times those of the law")
    steps = seconds / numerics["gas_step"]
    print(f"{scene['particles']['number']} particles, {cells} cells, {dem_steps} DEM steps a gas step: "
          f"{ms * speed:.3g} ± {half * speed:.2g} ms of CPU a gas step (95 %)")
    print(f"{seconds:g} s, {steps:.0f} gas steps: {ms * speed * steps / 3.6e6:.3g} ± {half * speed * steps / 3.6e6:.2g} core-hours")
    if measured:
        print(f"measured here over {asked.measure:g} s: {measured:.3g} ms a gas step, {measured / (ms * speed):.2f} times what the law says: "
              f"{measured * steps / 3.6e6:.3g} core-hours")


if __name__ == "__main__":
    try:
        main()
    except runs.Failed as error:
        print(f"predict.py: {error}", file=sys.stderr)
        sys.exit(2)
