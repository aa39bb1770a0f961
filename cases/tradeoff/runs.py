# SPDX-License-Identifier: BSD-3-Clause
"""Runs of choices: made, run, reduced to the few numbers a choice is judged by, and read back.

A choice is a scene named SUBJECT_VALUE.toml (K_4.toml); what is kept of its run are scene.toml, study.toml, run.json
and products.csv: a row a point of a product, a column a block of the averaging window. Clusters are there as sums.
"""
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tomllib

import numpy


def program(variable, name):
    """Where it has a path, from any folder."""
    given = os.environ.get(variable, name)
    return os.path.abspath(given) if os.sep in given else given


BEDSCOPE, COUPLED = program("BEDSCOPE", "bedscope"), program("BEDSCOPE_COUPLED", "bedscope-coupled")
REDUCE = pathlib.Path(__file__).resolve().parents[1] / "reduce_run.py"
PRODUCTS = ("axial holdup", "lateral holdup", "solids flux", "pressure drop", "cluster holdup", "cluster velocity")


class Failed(RuntimeError):
    pass


def shell(words, where=None, **changes):
    try:
        done = subprocess.run([str(w) for w in words], cwd=where, env=dict(os.environ, **changes), text=True, capture_output=True)
    except FileNotFoundError:
        raise Failed(f"{words[0]}: program not found: set BEDSCOPE and BEDSCOPE_COUPLED, or PATH") from None
    if done.returncode:
        raise Failed((done.stderr.strip().splitlines() or [f"{words[0]}: exit {done.returncode}"])[-1])
    return done.stdout


def scene_of(folder):
    return tomllib.loads((folder / "scene.toml").read_text())


def cell_of(scene_file, work):
    """Lateral and upward edge of the gas cells of a scene [m]: the analysis of all choices is on these."""
    case = made(scene_file, work / ".cell")
    scene = scene_of(case)
    shutil.rmtree(case)
    across, _, up = scene["numerics"]["grid"]
    return scene["geometry"]["width"] / across, scene["geometry"]["height"] / up


def made(scene_file, case):
    shutil.rmtree(case, ignore_errors=True)
    shell([BEDSCOPE, "case", "make", scene_file, "-o", case, "--quiet", "--force"])
    return case


def done(scene_file, work, kept, cell, block):
    """What is kept of the run of a choice; it is made and run, or gone on with, where that is not there yet."""
    name = scene_file.stem
    fresh, case, result = made(scene_file, work / f".{name}"), work / name, kept / name
    same = lambda folder: (folder / "scene.toml").exists() and scene_of(folder) == scene_of(fresh)
    if (result / "products.csv").exists() and same(result):
        shutil.rmtree(fresh)
        return result
    if not case.exists():
        fresh.rename(case)
    elif not same(case):
        raise Failed(f"{case}: expected a run of {scene_file}, found that of another scene; remove it or name another --work")
    else:
        shutil.rmtree(fresh)
    run(case)
    reduce(case, result, cell, block)
    shutil.rmtree(case)
    return result


def run(case):
    record = case / "run.json"
    if record.exists() and json.loads(record.read_text())["state"] == "done":
        return
    path = os.environ["PATH"]
    if os.sep in COUPLED:
        path = os.path.dirname(COUPLED) + os.pathsep + path
    words = ["./run.sh"] + (["--resume"] if any((case / "checkpoint").glob("[0-9]*")) else [])
    shell(words, case, PATH=path, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def step_cost(scene, work, seconds):
    """Milliseconds of a gas step with nothing beside it, from the start of the scene: the wall clock of the steps. Throws Failed."""
    short, case = work / f".{scene.stem}.toml", work / f".{scene.stem}.cost"
    short.write_text(f'base = "{scene.resolve()}"\nnumerics.end = {seconds}\nnumerics.average_from = 0\n')
    made(short, case)
    run(case)
    record = json.loads((case / "run.json").read_text())
    shutil.rmtree(case)
    short.unlink()
    return 1e3 * sum(record["costs"]["seconds"].values()) / record["time"]["steps"]


def measure_costs(scenes, work, kept, seconds, rounds=2):
    """What a gas step of each choice that is kept costs: one after the other, the least of the rounds. Goes to cost.json there. Throws Failed."""
    scenes = [scene for scene in scenes if (kept / scene.stem / "run.json").exists()]
    found = {}
    for _ in range(rounds):
        for scene in scenes:
            ms = step_cost(scene, work, seconds)
            found[scene.stem] = min(ms, found.get(scene.stem, ms))
    for name, ms in found.items():
        (kept / name / "cost.json").write_text(json.dumps(dict(ms_per_step=ms, seconds=seconds, rounds=rounds)) + "\n")


def reduce(case, result, cell, block):
    """Blocks of the averaging window are about `block` seconds long, and four at least."""
    at = case / "kept" / case.name
    numerics = scene_of(case)["numerics"]
    blocks = max(4, round((numerics["end"] - numerics.get("average_from", 0)) / block))
    shell([sys.executable, REDUCE, case, at, "--blocks", blocks, "--cell", f"{cell[0]:.10g},{cell[1]:.10g}",
           "--bedscope", BEDSCOPE])
    rows = products(case / "reduced/tables", [r["label"] for r in tomllib.loads((case / "study.toml").read_text())["run"]])
    with open(at / "products.csv", "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["product", "z [m]", "x [m]", *(f"block {n + 1}" for n in range(blocks))])
        out.writerows([*head, *(f"{v:.6g}" for v in values)] for head, values in rows)
    shutil.rmtree(at / "tables")
    part = result.parent / f".{result.name}"  # it appears as a whole
    shutil.rmtree(part, ignore_errors=True)
    shutil.copytree(at, part)
    shutil.rmtree(result, ignore_errors=True)
    part.rename(result)


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def products(tables, labels):
    """(product, z, x) and a value for each block. Of clusters the sums: their means are over all of the window."""
    found = {}

    def put(product, z, x, label, value):
        found.setdefault((product, z, x), dict.fromkeys(labels, 0.0))[label] += value

    for row in table(tables / "axial_profile.csv"):
        if row["type"] == "all":
            put("axial holdup", row["z [m]"], "", row["run"], float(row["holdup [-]"]))
            put("solids flux", row["z [m]"], "", row["run"], float(row["mass_flux_z [kg/m2/s]"]))
    for row in table(tables / "lateral_profile.csv"):
        if row["type"] == "all":
            put("lateral holdup", row["height [m]"], row["x [m]"], row["run"], float(row["holdup [-]"]))
    study = tomllib.loads((tables.parent.parent / "study.toml").read_text())
    window = {r["label"]: (r["average"]["from"], r["average"]["to"]) for r in study["run"]}
    inside = lambda row: window[row["run"]][0] <= float(row["time [s]"]) <= window[row["run"]][1]
    drops = [r for r in table(tables / "pressure_drop.csv") if inside(r)]
    for label in labels:
        ratios = [float(r["pressure_drop [Pa]"]) / float(r["bed_weight_over_area [Pa]"]) for r in drops if r["run"] == label]
        put("pressure drop", "", "", label, sum(ratios) / len(ratios))
        for sums in ("clusters", "cluster holdup", "cluster velocity"):
            put(sums, "", "", label, 0.0)
    for row in table(tables / "clusters.csv") if (tables / "clusters.csv").exists() else []:
        if inside(row):
            put("clusters", "", "", row["run"], 1)
            put("cluster holdup", "", "", row["run"], float(row["holdup [-]"]))
            put("cluster velocity", "", "", row["run"], float(row["velocity_z [m/s]"]))
    return [(head, [values[label] for label in labels]) for head, values in found.items()]


class Cost:
    """What a run costs: by itself where that was measured, else what it has cost up to where it is."""

    def __init__(self, folder):
        self.name, self.scene = folder.name, scene_of(folder)
        self.subject, _, self.value = folder.name.partition("_")
        record = json.loads((folder / "run.json").read_text())
        self.state, self.reached, self.steps = record["state"], record["time"]["reached"], record["time"]["steps"]
        self.particles, self.cells = record["scene"]["particles"], record["scene"]["cells"]
        self.dem_steps = record["time"]["dem_steps"] / self.steps  # in a gas step
        self.alone = (folder / "cost.json").exists()  # measured with nothing beside it
        if self.alone:
            self.ms_per_step = json.loads((folder / "cost.json").read_text())["ms_per_step"]
        else:
            self.ms_per_step = 1e3 * record["costs"]["cpu_seconds"] / self.steps
        self.per_second = 1e-3 * self.ms_per_step * self.steps / self.reached  # core-seconds per simulated second

    def fineness(self):
        """Ascending from the finest: particles, then cells, then steps."""
        numerics = self.scene["numerics"]
        return self.scene["species"][0]["diameter"], -self.cells, numerics["gas_step"], numerics["dem_step"]


class Choice(Cost):
    """A run that is done, with its products as arrays (points, blocks); None where the run has none of it."""

    def __init__(self, folder):
        super().__init__(folder)
        self.averaged = self.scene["numerics"]["end"] - self.scene["numerics"].get("average_from", 0)  # s
        raw = {}
        for row in table(folder / "products.csv"):
            raw.setdefault(row["product"], []).append([float(v) for key, v in row.items() if key.startswith("block")])
        self.products = {name: numpy.array(values) for name, values in raw.items()}
        self.products["solids flux"] = self.products["solids flux"].mean(axis=0, keepdims=True)  # over the height
        number = self.products.pop("clusters")
        self.clusters = number.sum()
        for name in ("cluster holdup", "cluster velocity"):
            self.products[name] = ratio(self.products[name], number)


def ratio(sums, numbers):
    """Sums over numbers, in blocks: linearised, so that their mean is the ratio of the means. None without numbers."""
    if not numbers.any():
        return None
    mean = sums.sum() / numbers.sum()
    return mean + (sums - mean * numbers) / numbers.mean()


def keep_costs(work, kept):
    """Of runs that are not done: what they cost so far. Too little of a run tells nothing: 100 gas steps at least."""
    for case in sorted(work.iterdir()):
        if case.name[0] != "." and (case / "run.json").exists() and not (kept / case.name / "products.csv").exists():
            if json.loads((case / "run.json").read_text())["time"]["steps"] >= 100:
                (kept / case.name).mkdir(parents=True, exist_ok=True)
                for name in ("scene.toml", "run.json"):
                    shutil.copy(case / name, kept / case.name)


def load(kept):
    """All choices that are done, and the costs of all."""
    folders = [at for at in sorted(kept.iterdir()) if at.name[0] != "." and (at / "run.json").exists()]
    return ([Choice(at) for at in folders if (at / "products.csv").exists()],
            [Cost(at) for at in folders])
