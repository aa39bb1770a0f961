# SPDX-License-Identifier: BSD-3-Clause
"""A verification: cases that are run, what is expected of them, and the verdict of bedscope validate."""
import csv
import json
import os
import pathlib
import re
import subprocess

BEDSCOPE = os.environ.get("BEDSCOPE", "bedscope")


def toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(v)}" for key, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value) if isinstance(value, str) else repr(float(value)) if isinstance(value, float) else str(value)


class Study:
    def __init__(self, folder, title, text):
        """`text` is printed at the head of the study, which its page shows."""
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True)
        lines = [f"# {line}".rstrip() for line in text.strip().splitlines()]
        self.instants = {}  # runs of which one snapshot is meant
        self.parts = ["\n".join(lines), f"title = {toml(title)}\ncurves = [\"expected\"]"]
        (self.folder / "expected").mkdir()

    def run(self, label, case, average, cells, **keys):
        """The dumps and times of a case in a folder of the study; `cells` across and up."""
        keys = {
            "label": label, "particles": f"{case.folder.relative_to(self.folder)}/DEM/post/dump*.liggghts",
            "time_step": case.dt / case.dem_steps, "gas": f"{case.folder.relative_to(self.folder)}/CFD",
            "decomposition": "reconstructed", "gas_density": float(case.gas["density"]),
            "density": float(case.spheres[0][2]), "up": "z", "lateral": "x", "cells": list(cells),
            "domain": {"min": [0, 0, 0], "max": [float(x) for x in case.size]},
            "average": {"from": float(average[0]), "to": float(average[1])}} | keys
        self.table("run", keys)
        if average[0] == average[1]:
            self.instants[label] = float(average[0])

    def series(self, label, average=None, **named):
        """Numbers in time, {name: (unit, [(time, value) ...])}, as tables of another program."""
        place = self.folder / re.sub(r"\W+", "_", label) / "tables"
        place.mkdir(parents=True)
        with open(place / "series.csv", "w", newline="") as file:
            table = csv.writer(file)
            table.writerow(["run", "series", "unit", "time [s]", "value"])
            for name, (unit, rows) in named.items():
                table.writerows((label, name.replace("_", " "), unit, repr(t), repr(v)) for t, v in rows)
        keys = {"label": label, "tables": str(place.relative_to(self.folder))}
        if average:
            keys["average"] = {"from": float(average[0]), "to": float(average[1])}
        self.table("run", keys)

    def curve(self, name, header, rows):
        with open(self.folder / f"expected/{name}.csv", "w") as file:
            file.write(header + "\n")
            file.writelines(",".join(map(repr, row)) + "\n" for row in rows)
        (self.folder / f"expected/{name}.toml").write_text(
            'kind = "theory"\nmethod = "original"\nby = "formulas in tests/coupled/laws.py"\n'
            "abscissa_uncertainty = 0\nordinate_uncertainty = 0\n")

    def check(self, run, quantity, against, metric, limit, reason, **more):
        """`reason`: why this is the limit."""
        if run in self.instants:
            more = {"at": {"time": self.instants[run]}} | more
        self.table("check", {"run": run, "quantity": quantity, "against": against, "metric": metric,
                             "limit": float(limit)} | more, reason)

    def table(self, kind, keys, comment=""):
        lines = [f"# {line.strip()}" for line in comment.strip().splitlines()]
        self.parts.append("\n".join(lines + [f"[[{kind}]]"] + [f"{k} = {toml(v)}" for k, v in keys.items()]))

    def judge(self):
        """Whether every check holds; report/ has the page."""
        (self.folder / "study.toml").write_text("\n\n".join(self.parts) + "\n")
        done = subprocess.run([BEDSCOPE, "validate", "study.toml", "-o", "report", "--quiet"], cwd=self.folder,
                              text=True, capture_output=True)
        if done.returncode not in (0, 1):
            raise RuntimeError(f"{self.folder}/study.toml: {done.stdout}{done.stderr}")
        for check in json.loads((self.folder / "report/summary.json").read_text())["checks"]:
            print(f"  {check['verdict']:14} {check['run']}: {check['quantity']}, {check['metric']} "
                  f"{check['value']:.3g} (limit {check['limit']:.3g}) against {check['against']}", flush=True)
        return done.returncode == 0
