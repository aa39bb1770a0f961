#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reduces a run of a scene to what data/runs/ keeps of it: tables with error bars, the scene, costs.

    cases/reduce_run.py CASE data/runs/NAME [--at SECONDS,...] [--heights METRES,...] [--bedscope PROGRAM]

CASE is a folder that `bedscope case make` wrote and the coupled solver has run. Averages are over the scene's
numerics.average_from to the end of the run; with --at there is a run of the tables for each of these instants
instead (transients). --heights are those of the lateral profiles. Of a riser, series.csv has the solids' flux that the
solver counted. What was read is named in study.toml by its place in CASE.
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


def write_flux(case, scene, name, tables):
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
            table.writerow([name, "solids flux", "kg/m2/s", row["time [s]"], f"{left / span / area:.6g}"])
            last = row


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
    if scene.get("inlet", {}).get("particles", "closed") != "closed":
        write_flux(asked.case, scene, asked.run.name.replace("_", " "), tables)
    for name in ("scene.toml", "study.toml", "run.json"):
        shutil.copy(asked.case / name, asked.run)


main()
