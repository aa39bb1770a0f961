#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reduces a run of a scene to what data/runs/ keeps of it: tables with error bars, the scene, costs.

    cases/reduce_run.py CASE data/runs/NAME [--at SECONDS,... | --blocks N] [--heights METRES,...]
        [--cell LATERAL,UP] [--bedscope PROGRAM]

CASE is a folder that `bedscope case make` wrote and the coupled solver has run. Averages are over the scene's
numerics.average_from to the end of the run; with --at there is a run of the tables for each of these instants
instead (transients), with --blocks one for each of N parts of the averaging window. --heights are those of the lateral
profiles. Cells are those of the gas, or of the size [m] that is given. Of a riser, series.csv has the solids' flux that
the solver counted. What was read is named in study.toml by its place in CASE.
"""
import argparse
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tomllib

# Of each snapshot or cluster: too large to keep for what it tells.
LEFT_OUT = {"clusters.csv", "voidage_check.csv", "bed_height.csv"}


def windows_of(numerics, name, instants, blocks):
    begin, end, output = numerics.get("average_from", 0), numerics["end"], numerics["output"]
    if instants:
        return [(f"{name}, {t:g} s", t, t) for t in instants]
    if blocks == 1:
        return [(name, begin, end)]
    edge = [begin + (end - begin) * n / blocks for n in range(blocks + 1)]
    return [(f"{name}, block {n + 1}", edge[n] + output / 2, edge[n + 1] + output / 2) for n in range(blocks)]


def study_of(scene, windows, heights, cell):
    box, numerics, outlet = scene["geometry"], scene["numerics"], scene.get("outlet", {})
    top = box["height"] + (outlet.get("height", 0) if outlet.get("place", "top") != "top" else 0)
    across, _, up = numerics["grid"]
    cell = cell or [box["width"] / across, box["height"] / up]
    lines = [f"title = {json.dumps(scene['title'])}", "[scene]",
             f"domain = {{ min = [0, 0, 0], max = [{box['width']}, {box['depth']}, {top:.10g}] }}",
             f"cell = [{cell[0]:.10g}, {cell[1]:.10g}]", f"gravity = {scene.get('gravity', 9.81)}",
             f"density = {scene['species'][0]['density']}", f"gas_density = {scene['gas']['density']}"]
    if heights:
        lines += ["[profiles]", f"heights = {heights}"]
    for label, begin, end in windows:
        lines += ["[[run]]", f"label = {json.dumps(label)}", 'particles = "DEM/post/dump*.liggghts_run"', 'gas = "CFD"',
                  f"time_step = {numerics['dem_step']}", f"average = {{ from = {begin}, to = {end} }}"]
    return "\n".join(lines) + "\n"


def write_flux(case, scene, windows, tables):
    """What leaves a riser, counted by the solver in intervals of 0.1 s: over long times what goes up in every layer."""
    rows = list(csv.DictReader(open(case / "history.csv")))
    area = scene["geometry"]["width"] * scene["geometry"]["depth"]
    last = rows[0]
    with open(tables / "series.csv", "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["run", "series", "unit", "time [s]", "value"])
        for row in rows:
            span = float(row["time [s]"]) - float(last["time [s]"])
            if span < 0.1 - 1e-9:
                continue
            left = float(row["left [kg]"]) - float(last["left [kg]"])
            last = row
            for label, begin, end in windows:
                if len(windows) == 1 or begin < float(row["time [s]"]) <= end:  # one run has its start-up, too
                    table.writerow([label, "solids flux", "kg/m2/s", row["time [s]"], f"{left / span / area:.6g}"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", type=pathlib.Path)
    parser.add_argument("run", type=pathlib.Path)
    parser.add_argument("--at", type=lambda text: [float(t) for t in text.split(",")], default=[])
    parser.add_argument("--blocks", type=int, default=1)
    parser.add_argument("--heights", type=lambda text: [float(h) for h in text.split(",")], default=[])
    parser.add_argument("--cell", type=lambda text: [float(edge) for edge in text.split(",")])
    parser.add_argument("--bedscope", default="bedscope")
    asked = parser.parse_args()
    record = json.loads((asked.case / "run.json").read_text())
    if record["state"] != "done":
        sys.exit(f"{asked.case}/run.json: expected state \"done\", found \"{record['state']}\"")
    scene = tomllib.loads((asked.case / "scene.toml").read_text())
    windows = windows_of(scene["numerics"], asked.run.name.replace("_", " "), asked.at, asked.blocks)
    (asked.case / "study.toml").write_text(study_of(scene, windows, asked.heights, asked.cell))
    subprocess.run([asked.bedscope, "analyse", "study.toml", "-o", "reduced", "--tables-only", "--quiet"], cwd=asked.case, check=True)
    tables = asked.run / "tables"
    tables.mkdir(parents=True, exist_ok=True)
    for table in sorted((asked.case / "reduced/tables").glob("*.csv")):
        if table.name not in LEFT_OUT and len(table.read_text().splitlines()) > 1:
            shutil.copy(table, tables)
    if scene.get("inlet", {}).get("particles", "closed") != "closed":
        write_flux(asked.case, scene, windows, tables)
    for name in ("scene.toml", "study.toml", "run.json"):
        shutil.copy(asked.case / name, asked.run)


main()
