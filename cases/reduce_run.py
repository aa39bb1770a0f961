#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reduces a run of a scene to what data/runs/ keeps of it: tables with error bars, the scene, costs.

    cases/reduce_run.py CASE data/runs/NAME [--at SECONDS,...] [--heights METRES,...] [--bedscope PROGRAM]

CASE is a folder that `bedscope case make` wrote and the coupled solver has run. Averages are over the scene's
numerics.average_from to the end of the run; with --at there is a run of the tables for each of these instants
instead (transients). --heights are those of the lateral profiles. What was read is named in study.toml by its place in CASE.
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys
import tomllib

# Of each snapshot or cluster: too large to keep for what it tells.
LEFT_OUT = {"clusters.csv", "voidage_check.csv", "bed_height.csv"}


def study_of(scene, name, instants, heights):
    box, numerics, outlet = scene["geometry"], scene["numerics"], scene.get("outlet", {})
    top = box["height"] + (outlet.get("height", 0) if outlet.get("place", "top") != "top" else 0)
    across, _, up = numerics["grid"]
    lines = [f"title = {json.dumps(scene['title'])}", "[scene]",
             f"domain = {{ min = [0, 0, 0], max = [{box['width']}, {box['depth']}, {top:.10g}] }}",
             f"cell = [{box['width'] / across:.10g}, {box['height'] / up:.10g}]",
             f"density = {scene['species'][0]['density']}", f"gas_density = {scene['gas']['density']}"]
    if heights:
        lines += ["[profiles]", f"heights = {heights}"]
    windows = [(f"{name}, {t:g} s", t, t) for t in instants] or [(name, numerics.get("average_from", 0), numerics["end"])]
    for label, begin, end in windows:
        lines += ["[[run]]", f"label = {json.dumps(label)}", 'particles = "DEM/post/dump*.liggghts_run"', 'gas = "CFD"',
                  f"time_step = {numerics['dem_step']}", f"average = {{ from = {begin}, to = {end} }}"]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", type=pathlib.Path)
    parser.add_argument("run", type=pathlib.Path)
    parser.add_argument("--at", type=lambda text: [float(t) for t in text.split(",")], default=[])
    parser.add_argument("--heights", type=lambda text: [float(h) for h in text.split(",")], default=[])
    parser.add_argument("--bedscope", default="bedscope")
    asked = parser.parse_args()
    record = json.loads((asked.case / "run.json").read_text())
    if record["state"] != "done":
        sys.exit(f"{asked.case}/run.json: expected state \"done\", found \"{record['state']}\"")
    scene = tomllib.loads((asked.case / "scene.toml").read_text())
    (asked.case / "study.toml").write_text(study_of(scene, asked.run.name.replace("_", " "), asked.at, asked.heights))
    subprocess.run([asked.bedscope, "analyse", "study.toml", "-o", "reduced", "--tables-only", "--quiet"], cwd=asked.case, check=True)
    tables = asked.run / "tables"
    tables.mkdir(parents=True, exist_ok=True)
    for table in sorted((asked.case / "reduced/tables").glob("*.csv")):
        if table.name not in LEFT_OUT and len(table.read_text().splitlines()) > 1:
            shutil.copy(table, tables)
    for name in ("scene.toml", "study.toml", "run.json"):
        shutil.copy(asked.case / name, asked.run)


main()
