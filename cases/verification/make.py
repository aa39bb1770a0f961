#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Constructed runs whose answers are known, and the study that judges bedscope's analysis by them.

    make.py FOLDER [--mutant NAME]

Then `bedscope validate FOLDER/study.toml` must find that every check holds. With a mutant, one of the
wrongs below is built in, and validate must reject it:

    drag       drag as Eq. 3.4 of Mu (2022) is printed       damping   dashpot as Eq. 4.10 is printed
    height     the profile taken 25 mm too high              half      half of the averaging time
    start-up   averaged from the start-up on                 velocity  the experiment of another velocity
    inflated   a wrong mean under large fluctuations

All expected numbers come from formulas in this file; random numbers only make noise of known mean.
"""

import math
import os
import random
import sys

import liggghts

CELL, WIDTH, DEPTH, DENSITY = 0.005, 0.07, 0.006, 2500.0
COLUMNS = round(WIDTH / CELL)
SPHERE = math.pi / 6 * liggghts.DIAMETER ** 3
HOLDUP_OF_ONE = SPHERE / (CELL * CELL * DEPTH)  # of one sphere in a cell
TIME_STEP = 1e-4


class Study:
    def __init__(self, folder):
        self.folder, self.runs, self.checks = folder, [], []

    def run(self, label, top, average=(-1.0, 1e9), **keys):
        low, high = average
        keys = {"time_step": TIME_STEP} | keys
        text = (f'[[run]]\nlabel = "{label}"\nparticles = "{label}/post/dump*.liggghts_run"\n'
                f"domain = {{ min = [0, 0, 0], max = [{WIDTH}, {DEPTH}, {top}] }}\n"
                f"average = {{ from = {low}, to = {high} }}\n")
        self.runs.append(text + "".join(f"{k} = {v}\n" for k, v in keys.items()))
        return liggghts.Run(f"{self.folder}/{label}/post", top)

    def check(self, run, quantity, against, metric, limit, **more):
        keys = {"run": f'"{run}"', "quantity": f'"{quantity}"', "metric": f'"{metric}"', "limit": limit}
        if against is not None:
            keys["against"] = f'"{against}"' if isinstance(against, str) else repr(against)
        keys.update(more)
        self.checks.append("[[check]]\n" + "".join(f"{k} = {v}\n" for k, v in keys.items()))

    def curve(self, *words):
        liggghts.curve(self.folder + "/expected", *words)

    def write(self):
        with open(self.folder + "/study.toml", "w") as file:
            file.write('title = "Verification: constructed runs whose answers are known"\n'
                       'curves = ["expected"]\n[scene]\n'
                       f"cell = [{CELL}, {CELL}]\ndensity = {DENSITY}\n"
                       "[profiles]\nband = 0.005\n"
                       "[temperature]\nfrom = 300\nto = 400\nbins = 25\n"
                       + "\n".join(self.runs + self.checks))


def in_cell(noise, i, k):
    """A place for a sphere that no face of the cell cuts."""
    margin = liggghts.DIAMETER / 2 * 1.001
    return ((i + 0.5) * CELL + noise.uniform(-1, 1) * (CELL / 2 - margin), DEPTH / 2,
            (k + 0.5) * CELL + noise.uniform(-1, 1) * (CELL / 2 - margin))


class Count:
    """A number that is n or n + 1 in time, of mean m; it keeps its value with probability `memory`."""

    def __init__(self, noise, mean, memory=0.5):
        self.noise, self.low, self.share, self.memory = noise, math.floor(mean), mean - math.floor(mean), memory
        self.more = noise.random() < self.share
        self.square = self.low ** 2 + (2 * self.low + 1) * self.share  # <n^2>

    def next(self):
        if self.noise.random() >= self.memory:
            self.more = self.noise.random() < self.share
        return self.low + self.more


def riser(study, mutant):
    """Holdup, velocity and flux that vary with place and time, and with each other: a particle in a cell
    of n moves at v(z) - 0.2 n, so that <phi v> is not <phi><v>."""
    layers, snapshots, velocities = 24, 150, {"5.55": 1.0, "6.74": 0.7}
    label, noise = "riser", random.Random(1)
    run = study.run(label, layers * CELL)

    def mean(i, k, scale=1.0):
        across = 1 + 0.6 * (2 * (i + 0.5) / COLUMNS - 1) ** 2
        return scale * (1.2 + 3 * math.exp(-k / 8)) * across

    def speed(k):
        return 2.0 + 0.05 * k

    counts = [[Count(noise, mean(i, k)) for i in range(COLUMNS)] for k in range(layers)]
    for step in range(snapshots):
        rows = []
        for k in range(layers):
            for i in range(COLUMNS):
                n = counts[k][i].next()
                for _ in range(n):
                    rows.append((1 + (i >= COLUMNS // 2), *in_cell(noise, i, k), speed(k) - 0.2 * n, 350))
        run.snapshot(1000 * step, rows)

    def profile(places):
        """Of cells: holdup, solids velocity and mass flux."""
        n = sum(mean(i, k) for i, k in places) / len(places)
        moved = sum(speed(k) * mean(i, k) - 0.2 * counts[k][i].square for i, k in places) / len(places)
        return HOLDUP_OF_ONE * n, moved / n, DENSITY * HOLDUP_OF_ONE * moved

    across, along = range(COLUMNS), range(layers)
    axial = [((k + 0.5) * CELL, *profile([(i, k) for i in across])) for k in along]
    band = layers // 2 - 2  # its middle is the height of the study
    lateral = [((i + 0.5) * CELL, *profile([(i, band)])) for i in across]
    names = (("holdup", "-"), ("velocity", "m/s"), ("mass flux", "kg/m2/s"))
    for column, (name, unit) in enumerate(names, 1):
        file = name.replace(" ", "_")
        study.curve("axial_" + file, f"z [m],{name} [{unit}]", [(r[0], r[column]) for r in axial])
        study.curve("lateral_" + file, f"x [m],{name} [{unit}]", [(r[0], r[column]) for r in lateral])
        for direction in ("axial", "lateral"):
            place = {"at": "{ height = 0.0525 }"} if direction == "lateral" else {}
            # u_val covers the error (e/u about 1), and is small enough to mean something
            study.check(label, f"{direction} {name}", f"{direction}_{file}", "e over u", 1.6,
                        accuracy=0.4 if direction == "lateral" else 0.1, **place)
            study.check(label, f"{direction} {name}", f"{direction}_{file}", "relative rmse", 0.08, **place)
    study.curve("experiment", "U [m/s],z [m],holdup [-]",
                [(float(u), z, s * h) for u, s in velocities.items() for z, h, *_ in axial])
    study.check(label, "axial holdup", "experiment?U=" + ("6.74" if mutant == "velocity" else "5.55"),
                "relative rmse", 0.08)
    if mutant == "height":
        study.check(label, "lateral holdup", "lateral_holdup", "relative rmse", 0.08, at="{ height = 0.0775 }")
    total = sum(mean(i, k) for k in along for i in across)
    right = sum(mean(i, k) for k in along for i in across if i >= COLUMNS // 2)
    study.check(label, "mean holdup", HOLDUP_OF_ONE * total / (COLUMNS * layers), "relative bias", 0.02)
    study.check(label, "mean holdup", HOLDUP_OF_ONE * right / (COLUMNS * layers), "relative bias", 0.02,
                species='"2"')
    study.check(label, "inventory", total * SPHERE * DENSITY, "relative bias", 0.02)
    study.check(label, "lateral holdup", None, "u-shaped", 0.2, at="{ height = 0.0525 }")
    # One place: a count that flickers by 1/2, correlated over 3 snapshots; the interval is about 2.7 standard
    # errors wide, the value within two.
    study.check(label, "local voidage", 1 - lateral[4][1], "max error",
                5 * 0.5 * HOLDUP_OF_ONE * math.sqrt(3 / snapshots), at=f"{{ height = 0.0525, x = {lateral[4][0]} }}")
    study.check(label, "axial holdup", None, "decreasing", 0.02)
    study.check(label, "lateral velocity", None, "core-annulus", 0, at="{ height = 0.0525 }")


def filling(study, mutant, seed=3):
    """A small bed that fills for 5 s, then fluctuates about a known mean for 20 s."""
    label, noise, layers, rate, memory = "filling", random.Random(seed), 24, 25, 0.8
    window = {"half": (5.01, 15.0), "start-up": (0.0, 25.0)}.get(mutant, (5.01, 25.0))
    run = study.run(label, layers * CELL, window)
    counts = [[Count(noise, 1.5, memory) for _ in range(COLUMNS)] for _ in range(layers)]
    inflated = Count(noise, 0.5, 0.98)
    for step in range(25 * rate):
        now = step / rate
        rows, high = [], 2.4 * inflated.next()
        for k in range(layers):
            for i in range(COLUMNS):
                n = counts[k][i].next()
                if mutant == "inflated":  # 1.2 times the mean, in long bursts
                    n = round(n * high)
                if now < 5:
                    n = round(n * now / 5)
                rows += [(1, *in_cell(noise, i, k), 0, 350) for _ in range(n)]
        run.snapshot(round(step / rate / TIME_STEP), rows)
    # sigma of a layer's mean over 20 s: 14 cells of 1/2 about 1.5, correlated over (1 + m) / (1 - m) = 9
    # snapshots. The interval of such a mean is 1.37 * 1.96 sigma = 2.7 sigma wide to either side, that of
    # half the time 1.55 * 1.96 * 2^(1/2) sigma = 4.3 sigma (docs/statistics.md). Half the time is no wrong
    # answer, it is too little to give one: the limit is the geometric mean of the two.
    sigma = 0.5 / math.sqrt(COLUMNS) * math.sqrt(9 / (20 * rate)) / 1.5
    study.check(label, "axial holdup", 1.5 * HOLDUP_OF_ONE, "relative bias", 3.4 * sigma)


def clusters(study):
    """Blocks of 4 x 3 cells of 18 spheres round a core of 2 with 27: two at the walls in each snapshot, one
    in the middle in every other."""
    label, layers, snapshots = "clusters", 30, 60
    run = study.run(label, layers * CELL)

    def block(column, layer, slow, fast):
        rows = []
        for i in range(4):
            for k in range(3):
                core = k == 1 and i in (1, 2)
                for a in range(3):
                    for b in range(3):
                        for c in range(3 if core else 2):
                            rows.append((1, (column + i) * CELL + (a + 0.5) * CELL / 3, (c + 0.5) * DEPTH / 3,
                                         (layer + k) * CELL + (b + 0.5) * CELL / 3, fast if core else slow, 350))
        return rows

    for step in range(snapshots):
        rows = block(0, 4, -1, -2) + block(10, 14, -1, -2)
        run.snapshot(1000 * step, rows + (block(5, 22, 1, 1) if step % 2 else []))
    spheres = 10 * 18 + 2 * 27
    falling = -(10 * 18 + 2 * 2 * 27) / spheres  # weighted by mass
    study.check(label, "occurrence", 2.5, "relative bias", 0.1)
    study.check(label, "cluster holdup", HOLDUP_OF_ONE * spheres / 12, "relative bias", 1e-6)
    study.check(label, "cluster velocity", (4 * falling + 1) / 5, "relative bias", 0.05)
    study.check(label, "cluster position", None, "near walls", 0)


def march(bed, length, end, cells):
    """Fixed bed heated by its gas: gas and particle temperatures in the middles of the cells. The gas moves
    by one cell a step and exchanges heat by the trapezoidal rule: second order."""
    step = length / cells * bed["voidage"] / bed["superficial_velocity"]
    to_gas = bed["heat_exchange"] / (bed["voidage"] * bed["gas_heat_capacity"])
    to_solids = bed["heat_exchange"] / ((1 - bed["voidage"]) * bed["solids_heat_capacity"])
    heating = bed["source"] / bed["solids_heat_capacity"]
    gas, solids = [bed["initial_temperature"]] * cells, [bed["initial_temperature"]] * cells

    def exchange(h):
        half = (to_gas + to_solids) * h / 2
        for i in range(cells):
            old = solids[i] - gas[i]
            new = (old * (1 - half) + heating * h) / (1 + half)
            gas[i] += to_gas * h * (old + new) / 2
            solids[i] += heating * h - to_solids * h * (old + new) / 2

    for _ in range(round(end / step)):
        exchange(step / 2)
        gas[1:] = gas[:-1]
        gas[0] = bed["inlet_temperature"]
        exchange(step / 2)
    return solids


def heat(study):
    """A fixed bed at one instant, a bed that cools, and a temperature's distribution."""
    layers = 20
    top = layers * CELL
    bed = {"voidage": 0.4, "superficial_velocity": 0.5, "gas_heat_capacity": 1e5, "solids_heat_capacity": 4e5 / 0.3,
           "heat_exchange": 2e5, "initial_temperature": 300.0, "inlet_temperature": 390.0, "source": 3e5}
    label, time = "fixed bed", 1.6
    run = study.run(label, top)
    fine = 21  # odd: a middle of the fine cells is the middle of a layer
    solids = march(bed, top, time, layers * fine)
    run.snapshot(round(time / TIME_STEP),
                 [(1, (i + 0.5) * CELL, DEPTH / 2, (k + 0.5) * CELL, 0, solids[k * fine + fine // 2])
                  for k in range(layers) for i in range(COLUMNS)])
    study.check(label, "axial temperature", "theory:fixed bed", "max error", 0.01,
                **{"with": "{ " + ", ".join(f"{k} = {v}" for k, v in bed.items()) + f", time = {time} }}"})

    label, noise = "cooling", random.Random(4)
    run = study.run(label, top)
    cooled = []
    for step in range(60):
        mean = 320 + 60 * math.exp(-step / 20)
        cooled.append((step / 10, mean))
        run.snapshot(1000 * step, [(1, *in_cell(noise, i, k), 0, mean + (5 if (i + k) % 2 else -5))
                                   for k in range(layers) for i in range(COLUMNS)])
    study.curve("cooled", "time [s],temperature [K]", cooled)
    study.check(label, "temperature history", "cooled", "max error", 1e-6)
    study.check(label, "temperature spread", 5.0, "relative bias", 1e-6)

    label = "distribution"
    run = study.run(label, top)
    for step in range(4):  # 2 b + 1 of 625 particles in bin b: the density 2 x
        rows = [(1, *in_cell(noise, k % COLUMNS, k % layers), 0, 300 + 4 * (b + 0.5))
                for b in range(25) for k in range(2 * b + 1)]
        run.snapshot(1000 * step, rows)
    study.curve("ramp", "x [-],density [-]", [((b + 0.5) / 25, (2 * b + 1) / 25) for b in range(25)])
    study.check(label, "temperature pdf", "ramp", "area", 1e-9)
    study.check(label, "temperature pdf", "ramp", "relative rmse", 1e-9)


def gas(study):
    """A bed that the gas carries: pressure drop = weight; velocities of gas and solids known."""
    label, layers, noise = "gas", 20, random.Random(5)
    top, case = layers * CELL, study.folder + "/gas/CFD"
    run = study.run(label, top, gas='"gas/CFD"', gas_density=1.2)
    liggghts.column_mesh(case, top, layers)
    holdup, fall, rise = 4 * HOLDUP_OF_ONE, -0.5, 3.0
    for step in range(12):
        run.snapshot(1000 * step, [(1, *in_cell(noise, i, k), fall, 350)
                                   for k in range(layers) for i in range(COLUMNS) for _ in range(4)])
        weight = holdup * (DENSITY - 1.2) * 9.81  # of a cubic metre of bed, less buoyancy
        swing = 20 * math.sin(2 * math.pi * step / 4)
        place = [(k + 0.5) * CELL for k in range(layers)]
        time = step / 10
        liggghts.field(case, time, "p", "1 -1 -2 0 0 0 0", [1e5 + (weight + swing / top) * (top - z) for z in place])
        liggghts.field(case, time, "voidfraction", "0 0 0 0 0 0 0", [1 - holdup] * layers)
        liggghts.field(case, time, "U", "0 1 -1 0 0 0 0", [(0.0, 0.0, rise)] * layers)
        liggghts.field(case, time, "T", "0 0 0 1 0 0 0", [300 + 500 * z for z in place])
    study.curve("warming", "z [m],temperature [K]", [(z, 300 + 500 * z) for z in place])
    study.check(label, "pressure drop", "theory:bed weight", "relative bias", 0.1,
                **{"with": f"{{ area = {WIDTH * DEPTH}, particle_density = {DENSITY}, gas_density = 1.2, gravity = 9.81 }}"})
    for quantity, number in (("voidage", 1 - holdup), ("gas velocity", rise), ("slip velocity", rise - fall)):
        study.check(label, "axial " + quantity, number, "relative max error", 1e-6)
    study.check(label, "axial gas temperature", "warming", "max error", 1e-6)


def beetstra(voidage, reynolds, printed):
    """Drag by Beetstra et al. (2007), or as Eq. 3.4 of Mu (2022) prints it."""
    phi = 1 - voidage
    viscous = 10 * phi / voidage ** 2 + voidage ** 2 * (1 + 1.5 * math.sqrt(phi))
    bracket = 1 / voidage + 3 * voidage * phi + 8.4 * reynolds ** -0.343
    if printed:  # no 1/(24 eps^2); 10^3 (1 - eps); another exponent
        return viscous + 0.413 * reynolds * bracket / (1 + 1e3 * phi * reynolds ** -(1 + 4 * phi / 2))
    return viscous + 0.413 * reynolds / (24 * voidage ** 2) * bracket / (
        1 + 10 ** (3 * phi) * reynolds ** (-(1 + 4 * phi) / 2))


def settling(study, mutant):
    """A suspension that settles in a closed vessel: the solids fall at the superficial slip velocity, for
    the gas that they displace rises. 3 pi mu d eps F w = weight less buoyancy, w: interstitial slip."""
    label, layers, noise = "settling", 12, random.Random(6)
    voidage = 1 - 10 * HOLDUP_OF_ONE
    gas_density, viscosity, d = 1.2, 1.8e-5, liggghts.DIAMETER
    weight = SPHERE * (DENSITY - gas_density) * 9.81
    low, high = 1e-3, 100.0
    for _ in range(200):
        superficial = (low + high) / 2
        force = 3 * math.pi * viscosity * d * superficial * beetstra(
            voidage, gas_density * superficial * d / viscosity, mutant == "drag")
        # drag without the mean pressure gradient, which carries the share 1 - eps of the weight
        low, high = (superficial, high) if force < weight * voidage else (low, superficial)
    run = study.run(label, layers * CELL)
    for step in range(4):
        run.snapshot(1000 * step, [(1, *in_cell(noise, i, k), -superficial, 350)
                                   for k in range(layers) for i in range(COLUMNS) for _ in range(10)])
    study.check(label, "axial velocity", "theory:batch settling", "relative max error", 1e-6, **{
        "with": f"{{ diameter = {d}, particle_density = {DENSITY}, gas_density = {gas_density}, "
                f"gas_viscosity = {viscosity}, gravity = 9.81, voidage = {voidage!r} }}"})


def rebound(study, mutant):
    """Spheres that have hit the floor at 1 m/s: m x'' + eta x' + k x = 0, integrated by small steps."""
    label, layers, noise = "rebound", 4, random.Random(7)
    mass, stiffness, restitution = SPHERE * DENSITY, 1600.0, 0.9
    logarithm = math.log(restitution)
    damping = -2 * logarithm * math.sqrt(mass * stiffness / (math.pi ** 2 + logarithm ** 2))
    applied = 2 * math.sqrt(mass * stiffness) if mutant == "damping" else damping
    x, v, step = 0.0, -1.0, 1e-4 * math.sqrt(mass / stiffness)

    def rate(x, v):
        return v, -(applied * v + stiffness * x) / mass

    for _ in range(60000):  # until the sphere leaves the floor, or two periods
        a, b = rate(x, v)
        c, e = rate(x + step / 2 * a, v + step / 2 * b)
        x, v = x + step * c, v + step * e
        if x >= 0 and v > 0:
            break
    run = study.run(label, layers * CELL)
    for count in range(4):
        run.snapshot(1000 * count, [(1, *in_cell(noise, i, k), v, 350)
                                    for k in range(layers) for i in range(COLUMNS) for _ in range(3)])
    study.check(label, "axial velocity", "theory:rebound", "relative max error", 1e-3, **{
        "with": f"{{ stiffness = {stiffness}, effective_mass = {mass!r}, damping = {damping!r}, "
                "impact_velocity = 1 }"})


RUNS_OF = {"drag": (settling,), "damping": (rebound,), "height": (riser,), "velocity": (riser,),
           "half": (filling,), "start-up": (filling,), "inflated": (filling,)}


def main(folder, mutant=None):
    study = Study(folder)
    os.makedirs(folder + "/expected", exist_ok=True)
    if mutant is None:
        clusters(study)
        heat(study)
        gas(study)
    for part in RUNS_OF[mutant] if mutant else (riser, filling, settling, rebound):
        part(study, mutant)
    study.write()


if __name__ == "__main__":
    words = sys.argv[1:]
    if len(words) == 3 and words[1] == "--mutant" and words[2] in RUNS_OF:
        main(words[0], words[2])
    elif len(words) == 1 and not words[0].startswith("-"):
        main(words[0])
    else:
        sys.exit(__doc__)
