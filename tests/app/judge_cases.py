# SPDX-License-Identifier: BSD-3-Clause
"""Random dumps as LIGGGHTS writes them, and studies of them, for judge.py.

Usage: judge_cases.py BEDSCOPE CASE...    (`list` prints the names; KEEP=FOLDER keeps the files)
"""

import os
import random
import sys
import tempfile

import bubbling_bed
import judge  # exits with 77 where numpy or scipy is missing
import numpy as np
from gas_cases import FoamCase, random_gas

DOMAIN = ([0.0, 0.0, 0.0], [0.07, 0.006, 0.3])


class Dumps:
    """Writes snapshots with shuffled rows, columns in any order, %g numbers, more columns than needed."""

    def __init__(self, folder, seed, axes="xyz", **options):
        self.folder, self.rng = folder, np.random.default_rng(seed)
        self.order = random.Random(seed)
        self.axes, self.options, self.names = axes, options, []
        os.makedirs(folder, exist_ok=True)

    def particles(self, count, beyond=0.0, clumps=0, types=(1,), radii=None, domain=DOMAIN):
        """`count` particles with a share `beyond` the domain, most of them in `clumps`."""
        rng, low, high = self.rng, np.array(domain[0]), np.array(domain[1])
        r = np.array(radii or [0.0006])
        kind = rng.integers(0, len(types), count)
        extent = high - low
        place = low + extent * (rng.random((count, 3)) * (1 + 2 * beyond) - beyond)
        for _ in range(clumps):
            inside = rng.random(count) < 0.25
            at = low + extent * rng.random(3)
            place[inside] = at + np.array([0.006, extent[1] / 4, 0.009]) * rng.normal(size=(inside.sum(), 3))
        radius = r[kind % len(r)] * (1 if radii is None or len(radii) == len(types) else rng.uniform(0.6, 1.6, count))
        return {
            "id": rng.choice(10 * count + 10, count, replace=False) + 1,
            "type": np.array(types)[kind] if count else np.zeros(0, int),
            "x": place[:, 0], "y": place[:, 1], "z": place[:, 2],
            "vx": rng.normal(0, 0.3, count), "vy": rng.normal(0, 0.1, count),
            "vz": rng.normal(0.4, 1.2, count),
            "radius": radius, "f_Temp[0]": rng.normal(350, 12, count), "q": rng.normal(size=count),
            "fx": rng.normal(0, 1e-5, count), "omegaz": rng.normal(0, 90, count),
        }

    def write(self, step, columns, name=None, leave=()):
        if not self.names:  # one run of LIGGGHTS keeps one order of its columns
            self.names = list(columns)
            self.order.shuffle(self.names)
        names = [n for n in self.names if n not in leave]
        a = dict(zip("xyz", self.axes))  # x of the case is written as another axis
        turned = {**columns, **{a[n]: columns[n] for n in "xyz"},
                  **{"v" + a[n]: columns["v" + n] for n in "xyz"}}
        count = len(columns["id"])
        low, high = DOMAIN
        lines = ["ITEM: TIMESTEP", str(step), "ITEM: NUMBER OF ATOMS", str(count),
                 "ITEM: BOX BOUNDS ff ff ff"]
        box = {a[n]: (low[i] - 0.01, high[i] + 0.01) for i, n in enumerate("xyz")}
        lines += ["%g %g" % box[n] for n in "xyz"]
        lines.append("ITEM: ATOMS " + " ".join(names) + " ")
        formats = ["%d" if n in ("id", "type") else "%g" for n in names]
        for i in range(count):
            lines.append("".join(f % turned[n][i] + " " for f, n in zip(formats, names)))
        with open(os.path.join(self.folder, name or f"dump{step}.liggghts_run"), "w", newline="") as file:
            file.write("\n".join(lines) + "\n")


def toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k if k.replace('_', '').isalnum() else repr(k)} = {toml(v)}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml, value)) + "]"
    if isinstance(value, str):
        return '"' + value.replace('"', '\\"') + '"'
    return repr(value)


def write_study(folder, scene, runs, name="study.toml", **sections):
    text = 'title = "case"\n[scene]\n'
    text += "".join(f"{k} = {toml(v)}\n" for k, v in scene.items())
    for section, keys in sections.items():
        text += f"[{section}]\n" + "".join(f"{k} = {toml(v)}\n" for k, v in keys.items())
    for run in runs:
        text += "[[run]]\n" + "".join(f"{k} = {toml(v)}\n" for k, v in run.items())
    path = os.path.join(folder, name)
    with open(path, "w") as file:
        file.write(text)
    return path


def scene(**more):
    return {"domain": {"min": DOMAIN[0], "max": DOMAIN[1]}, "cell": [0.0025, 0.0025], "density": 2500,
            "mapping": "centre", "average": {}} | more


RUN = {"label": "a run", "particles": "post/dump*.liggghts_run", "time_step": 1e-5}
PROFILES = {"heights": [0.05, 0.1012, 0.2], "band": 0.01}


def plain(folder, mapping="centre", count=3000, snapshots=24, **more):
    dumps = Dumps(folder + "/post", 1)
    for k in range(snapshots):
        dumps.write(1000 * k, dumps.particles(count, clumps=3))
    return write_study(folder, scene(mapping=mapping, **more), [RUN], profiles=PROFILES)


def uneven_window(folder):
    """Uneven spacing, step_zero, a window whose ends fall on snapshots, bands cut by the edge."""
    dumps = Dumps(folder + "/post", 2)
    for step in [100, 250, 1000, 2500, 2600, 4000, 4100, 9000, 9500, 9700, 12000]:
        dumps.write(step, dumps.particles(1500, clumps=2))
    return write_study(folder, scene(average={"from": 0.005, "to": 0.085}), [RUN | {"step_zero": 500}],
                       profiles={"heights": [0.001, 0.003, 0.149, 0.299], "band": 0.011})


def species(folder, mapping="centre", count=2500):
    """Three types of different density and size, one that comes late; rules; temperatures."""
    dumps = Dumps(folder + "/post", 3)
    for k in range(9):
        types = (1, 4) if k < 5 else (1, 2, 4)
        radii = [0.0005, 0.0009] if k < 5 else [0.0005, 0.0007, 0.0009]
        dumps.write(2000 * k, dumps.particles(count, clumps=2, types=types, radii=radii))
    return write_study(
        folder, scene(mapping=mapping, density={"1": 2400, "2": 1100, "4": 7800}, average={"from": 0.03},
                      species={"active": "q > 0", "hot": "f_Temp[0] >= 355", "big": "radius > 0.0008"}),
        [RUN], profiles=PROFILES, temperature={"from": 330.0, "to": 380.0, "bins": 20})


def outside(folder, mapping="centre", count=2000):
    """A fifth of the particles beyond the domain on all sides; radii of up to a cell."""
    dumps = Dumps(folder + "/post", 4)
    for k in range(5):
        dumps.write(500 * k, dumps.particles(count, beyond=0.2, radii=[0.0008, 0.0011, 0.0014], types=(1, 2)))
    return write_study(folder, scene(mapping=mapping, cell=[0.0025, 0.002, 0.0025]), [RUN], profiles=PROFILES)


def outside_depth_averaged(folder, mapping="exact", count=2000):
    """As before, but nothing beyond front and back (what then counts is the kernel's business)."""
    dumps = Dumps(folder + "/post", 5)
    for k in range(5):
        particles = dumps.particles(count, beyond=0.1, radii=[0.0008, 0.0011, 0.0014], types=(1, 2))
        particles["y"] = np.clip(particles["y"], 0.0001, 0.0059)
        dumps.write(500 * k, particles)
    return write_study(folder, scene(mapping=mapping), [RUN], profiles=PROFILES)


def periodic(folder, mapping="exact", cell=(0.0025, 0.0025), axes=("x", "z")):
    dumps = Dumps(folder + "/post", 6)
    for k in range(4):
        particles = dumps.particles(1200, beyond=0.1, radii=[0.0008, 0.0016], types=(1, 2))
        if "y" not in axes:
            particles["y"] = np.clip(particles["y"], 0.0001, 0.0059)
        dumps.write(500 * k, particles)
    return write_study(folder, scene(mapping=mapping, cell=list(cell), periodic=list(axes)), [RUN],
                       profiles=PROFILES, clusters={"threshold": 9.0, "core": 10.0})


def turned(folder, axes="zxy", up="y", lateral="z", mapping="exact"):
    """The same bed with other axes: `axes` are where x, y, z of the case are written."""
    dumps = Dumps(folder + "/post", 7, axes=axes)
    for k in range(6):
        dumps.write(700 * k, dumps.particles(1500, clumps=3, types=(1, 2), radii=[0.0006, 0.0009]))
    place = {axis: i for i, axis in enumerate(axes)}
    domain = {"min": [DOMAIN[0][place[a]] for a in "xyz"], "max": [DOMAIN[1][place[a]] for a in "xyz"]}
    return write_study(folder, scene(domain=domain, up=up, lateral=lateral, mapping=mapping), [RUN],
                       profiles=PROFILES)


def shifted(folder):
    """A domain that starts at negative coordinates, cells by number, more than one depth layer."""
    dumps = Dumps(folder + "/post", 8)
    domain = ([-0.035, -0.013, 0.5], [0.035, 0.011, 0.83])
    for k in range(4):
        dumps.write(700 * k, dumps.particles(2500, clumps=3, domain=domain))
    keys = scene(domain={"min": domain[0], "max": domain[1]}, cells=[27, 4, 131], mapping="exact")
    del keys["cell"]
    return write_study(folder, keys, [RUN], profiles={"heights": [0.51, 0.7], "band": 0.017})


def one_snapshot(folder):
    dumps = Dumps(folder + "/post", 9)
    dumps.write(4000, dumps.particles(2000, clumps=2))
    return write_study(folder, scene(), [RUN], profiles=PROFILES, temperature={"from": 330.0, "to": 380.0})


def empty_snapshots(folder):
    """No particles in the first, in two in the middle and in the last snapshot."""
    dumps = Dumps(folder + "/post", 10)
    for k, count in enumerate([0, 300, 0, 0, 900, 40, 0]):
        dumps.write(100 * k, dumps.particles(count))
    return write_study(folder, scene(), [RUN], profiles=PROFILES, temperature={"from": 330.0, "to": 380.0})


def few_particles(folder):
    """A handful of particles: most cells see nothing, clusters need other thresholds."""
    dumps = Dumps(folder + "/post", 11)
    for k in range(5):
        dumps.write(100 * k, dumps.particles(7))
    return write_study(folder, scene(mapping="exact"), [RUN], profiles=PROFILES,
                       clusters={"threshold": 0.001, "core": 0.01, "min_area": 6.25e-6})


def clusters(folder):
    """Many clusters of all shapes, some exactly as large as the limit."""
    dumps = Dumps(folder + "/post", 12)
    for k in range(8):
        dumps.write(1000 * k, dumps.particles(4000, clumps=1 + k % 3, radii=[0.0005, 0.0008], types=(1, 2)))
    return write_study(folder, scene(density={"1": 900, "2": 5000}), [RUN], 
                       clusters={"threshold": 0.15, "core": 0.22, "min_area": 25e-6})


def several_runs(folder):
    """Two runs of their own settings and the first once more under another label."""
    for number, seed in (("a", 13), ("b", 14)):
        dumps = Dumps(f"{folder}/{number}", seed)
        for k in range(5):
            dumps.write(300 * k, dumps.particles(900, clumps=2), name=f"{number}_{9 - k}.dump")
    return write_study(folder, scene(mapping="exact"), [
        {"label": "one", "particles": "a/*.dump", "time_step": 1e-5},
        {"label": 'two, "b"', "particles": "b", "time_step": 2e-5, "step_zero": -100,
         "cell": [0.005, 0.003], "density": 1000, "average": {"from": 0.01}},
        {"label": "three", "particles": "a", "time_step": 1e-5, "mapping": "centre"}], profiles=PROFILES)


def radius_of_study(folder):
    """Dumps without a radius: it comes from the study, by type."""
    dumps = Dumps(folder + "/post", 15)
    for k in range(4):
        dumps.write(10 * k, dumps.particles(1000, types=(1, 3)), leave=("radius",))
    return write_study(folder, scene(radius={"1": 0.0004, "3": 0.0009}), [RUN], profiles=PROFILES)


def several_in_one_file(folder):
    """All snapshots in one file, with LIGGGHTS' own CRLF-free text and blanks at line ends."""
    dumps = Dumps(folder + "/parts", 16)
    os.makedirs(folder + "/post")
    with open(folder + "/post/dump.liggghts_run", "wb") as file:
        for k in range(6):
            dumps.write(50 * k, dumps.particles(800))
            with open(f"{folder}/parts/dump{50 * k}.liggghts_run", "rb") as part:
                file.write(part.read())
    return write_study(folder, scene(mapping="exact"), [RUN], profiles=PROFILES)


def on_faces(folder, mapping="centre"):
    """Positions of few digits: many exactly on faces of cells and on the domain's sides."""
    dumps = Dumps(folder + "/post", 17)
    for k in range(6):
        particles = dumps.particles(4000)
        for n, digits in (("x", 4), ("y", 4), ("z", 3)):
            particles[n] = np.round(particles[n], digits)
        particles["f_Temp[0]"] = np.round(particles["f_Temp[0]"], 1)
        dumps.write(50 * k, particles)
    return write_study(folder, scene(mapping=mapping), [RUN], profiles=PROFILES,
                       temperature={"from": 345.0, "to": 380.0})


def density_column(folder, column="density"):
    """No density in the study: it is a column of the dumps; a type that comes late."""
    dumps = Dumps(folder + "/post", 18)
    for k in range(5):
        particles = dumps.particles(1000, types=(1, 2) if k > 1 else (1,))
        density = np.where(particles["type"] == 1, 2500.0, 900.0)
        # powers of ten keep their digits through %g
        particles[column] = density if column == "density" else density * 4 / 3 * np.pi * particles["radius"] ** 3
        dumps.write(50 * k, particles)
    keys = scene()
    del keys["density"]
    return write_study(folder, keys, [RUN], profiles=PROFILES)


def defaults(folder):
    """Only what has no default; a cell that does not divide the domain."""
    dumps = Dumps(folder + "/post", 19)
    for k in range(4):
        dumps.write(50 * k, dumps.particles(500))
    keys = scene(cell=[0.003, 0.0041])
    del keys["mapping"]
    return write_study(folder, keys, [RUN])


def bubbling(folder, mapping="exact", **sections):
    """A packed bed with rising voids, some at a wall, and a little splash above."""
    columns = [(0.0, 0.02, 0.25, 4.0, 0.2), (0.03, 0.016, 0.3, 5.0, 0.0), (0.055, 0.011, 0.2, 6.0, 0.6)]
    bubbling_bed.write_run(folder + "/post", columns, snapshots=64, interval=0.02, width=0.07,
                           height=0.12, diameter=0.002, splash=40)
    return write_study(folder, scene(cell=[0.0035, 0.004], mapping=mapping, average={"from": 0.1}),
                       [RUN], **({"bubbles": {}, "spectra": {"segment": 0.4}} | sections))


def gas(folder, low=(0, 0, 0), high=(0.07, 0.006, 0.3), n=(14, 2, 30), mapping="exact", axes="xyz",
        up="z", lateral="x", names=None, kinematic=True, times=None, late_temperature=False, **keys):
    """Particles and gas: the gas at `times` [s], the particles every 0.01 s of ten."""
    dumps = Dumps(folder + "/post", 20, axes=axes)
    place = {axis: i for i, axis in enumerate(axes)}
    for k in range(10):
        particles = dumps.particles(400, clumps=2, types=(1, 2), radii=[0.0006, 0.0009])
        particles["y"] = np.clip(particles["y"], 0.001, 0.005)
        dumps.write(1000 * k, particles)

    def turned(v):
        return [v[place[a]] for a in "xyz"]

    case = FoamCase(folder + "/CFD", turned(low), turned(high), turned(n))
    for seed, time in enumerate(times or [f"{0.01 * k:g}" for k in range(10)]):
        random_gas(case, time, seed, "xyz".index(up), kinematic, not late_temperature or seed > 2,
                   "alpha.particles" if names else "voidfraction")
    if kinematic:
        keys["gas_density"] = 1.2
    sections = {"gas": names} if names else {}
    run = RUN | {"gas": "CFD"}
    return write_study(folder, scene(mapping=mapping, up=up, lateral=lateral, density={"1": 2400, "2": 1100},
                                     domain={"min": turned(DOMAIN[0]), "max": turned(DOMAIN[1])}, **keys),
                       [run], profiles=PROFILES, **sections)


CASES = {
    "bubbling": bubbling,
    "bubbling at heights": lambda f: bubbling(
        f, "centre", bubbles={"threshold": 0.7, "core": 0.75, "min_area": 30e-6},
        profiles={"heights": [0.02, 0.06, 0.11], "band": 0.03}, bed={"height_at_rest": 0.11}),
    "gas": gas,
    "gas on an offset mesh": lambda f: gas(f, low=(-0.0123, 0.0011, 0.0321), high=(0.0612, 0.0071, 0.2713)),
    "gas on a fine mesh": lambda f: gas(f, n=(41, 3, 70), cell=[0.01, 0.02], times=["0.02", "0.04"]),
    "gas on a 3-D grid": lambda f: gas(f, n=(9, 3, 17), cell=[0.005, 0.0015, 0.01], gravity=4.905),
    "gas up is y": lambda f: gas(f, axes="zxy", up="y", lateral="z", low=(0.001, 0, -0.01)),
    "gas as solids fraction": lambda f: gas(f, names={"solids": "alpha.particles"}, kinematic=False),
    "gas at times of its own": lambda f: gas(
        f, average={"from": 0.015, "to": 0.07}, late_temperature=True,
        times=["0", "0.004", "0.01", "0.015", "0.02", "0.033", "0.05", "0.0500004", "0.07", "0.08", "0.2"]),
    "on faces": on_faces,
    "on faces exact": lambda f: on_faces(f, "exact"),
    "density column": density_column,
    "mass column": lambda f: density_column(f, "mass"),
    "defaults": defaults,
    "plain": plain,
    "plain exact": lambda f: plain(f, "exact", count=1500, snapshots=20),
    "three dimensions": lambda f: plain(f, "centre", cell=[0.0025, 0.0015, 0.0025]),
    "three dimensions exact": lambda f: plain(f, "exact", count=600, snapshots=4, cell=[0.0025, 0.0015, 0.0025]),
    "uneven window": uneven_window,
    "species": species,
    "species exact": lambda f: species(f, "exact", 800),
    "outside": outside,
    "outside exact": lambda f: outside(f, "exact", 700),
    "outside exact depth averaged": outside_depth_averaged,
    "periodic": periodic,
    "periodic centre": lambda f: periodic(f, "centre"),
    "periodic three dimensions": lambda f: periodic(f, cell=(0.0025, 0.0015, 0.0025), axes=("x", "y", "z")),
    "up is y": turned,
    "up is x": lambda f: turned(f, "yzx", "x", "y", "centre"),
    "shifted": shifted,
    "one snapshot": one_snapshot,
    "empty snapshots": empty_snapshots,
    "few particles": few_particles,
    "clusters": clusters,
    "several runs": several_runs,
    "radius of study": radius_of_study,
    "several in one file": several_in_one_file,
}


# A mass of six digits gives a density of six digits.
TOLERANCE = {"mass column": 5e-6}


def main():
    program, names = sys.argv[1], sys.argv[2:]
    if names == ["list"]:
        print("\n".join(CASES))
        return 0
    good = True
    for name in names or CASES:
        with tempfile.TemporaryDirectory() as folder:
            folder = os.path.join(os.environ.get("KEEP") or folder, name.replace(" ", "_"))
            os.makedirs(folder, exist_ok=True)
            study = CASES[name](folder)
            out = folder + "/out" if os.environ.get("KEEP") else None
            print(f"-- {name}", flush=True)
            relative = TOLERANCE.get(name, judge.RELATIVE)
            good = judge.judge_study(program, study, out, relative) and good
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
