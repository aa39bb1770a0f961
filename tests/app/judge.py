# SPDX-License-Identifier: BSD-3-Clause
"""An independent recomputation of what `bedscope analyse STUDY --tables-only` writes.

Usage: judge.py BEDSCOPE STUDY...

Written from the definitions only (docs/ and the design's tables), with its own parser of text dumps
and with numpy and scipy; nothing is shared with the program. Every column of every table is
compared; of the intervals only that they are there and plausible. Exit code 77: a module is missing.
"""

import csv
import glob
import gzip
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import tomllib

try:
    import numpy as np
    import scipy.ndimage
    import judge_gas
    import scipy.signal
    import scipy.stats
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)

RELATIVE = 1e-9  # both sides read the same text; only the order of the sums differs
NAN = float("nan")


# ------------------------------------------------------------------------------------------ dumps
def read_dump(path):
    """All snapshots of one LIGGGHTS text dump: [{step, box, columns: {name: array}}]."""
    with open(path, "rb") as file:
        raw = file.read()
    if raw[:2] == b"\x1f\x8b":
        raw = gzip.decompress(raw)
    lines = raw.decode().replace("\r\n", "\n").split("\n")
    snapshots, at = [], 0
    while at < len(lines):
        if not lines[at].strip():
            at += 1
            continue
        assert lines[at].startswith("ITEM: TIMESTEP"), lines[at]
        step = int(lines[at + 1])
        count = int(lines[at + 3])
        box = [[float(v) for v in lines[at + 5 + axis].split()] for axis in range(3)]
        names = lines[at + 8].split()[2:]
        rows = lines[at + 9 : at + 9 + count]
        values = np.array([row.split() for row in rows], dtype=float).reshape(count, len(names))
        at += 9 + count
        columns = {name: values[:, i] for i, name in enumerate(names)}
        snapshots.append({"step": step, "box": box, "columns": columns})
    return snapshots


def read_run(pattern):
    if os.path.isdir(pattern):
        pattern = os.path.join(pattern, "*")
    snapshots = [s for path in glob.glob(pattern) for s in read_dump(path)]
    return sorted(snapshots, key=lambda snapshot: snapshot["step"])


# ---------------------------------------------------------------------------------------- mapping
def rectangle(y, z, s):
    """Area of {y[0] <= y <= y[1], z[0] <= z <= z[1]} in the disc of radius s at the origin."""

    def under(x):  # integral of sqrt(s^2 - x^2) from 0 to x: odd, and pi s^2 / 4 at x = s
        return 0.5 * (x * np.sqrt(np.maximum(s * s - x * x, 0)) + s * s * np.arcsin(x / s))

    area = 0
    y = [np.clip(a, -s, s) for a in y]
    left = [2 * under(a) + math.pi / 2 * s * s for a in y]  # of {y <= a}
    for sign, b in zip((-1, 1), z):
        b = np.clip(b, -s, s)
        half = np.sqrt(s * s - b * b)  # half the chord at z = b
        whole = under(half)
        for side, a, below in zip((-1, 1), y, left):
            inner = np.clip(a, -half, half)
            cap = under(inner) + whole - np.abs(b) * (inner + half)
            area = area + sign * side * np.where(b >= 0, below - cap, cap)  # of {y <= a, z <= b}
    return area


GAUSS = np.polynomial.legendre.leggauss(48)


def overlap(radius, low, high):
    """Volume of spheres at the origin inside boxes, by quadrature over x of disc-rectangle areas.

    radius (n,), low and high (n, 3). The x range is split where the disc's edge passes an edge or a
    corner of the rectangle; the substitution 3u^2 - 2u^3 softens the square roots there.
    """
    whole = ((low <= -radius[:, None]) & (high >= radius[:, None])).all(axis=1)
    volume = np.where(whole, 4 / 3 * math.pi * radius**3, 0)
    nearest = np.maximum(np.maximum(low, -high), 0)
    cut = ~whole & ((nearest**2).sum(axis=1) < radius**2)
    volume[cut] = cut_overlap(radius[cut], low[cut], high[cut])
    return volume


def cut_overlap(radius, low, high):
    a = np.maximum(low[:, 0], -radius)
    b = np.minimum(high[:, 0], radius)
    distances = [low[:, 1], high[:, 1], low[:, 2], high[:, 2]]
    for y in (low[:, 1], high[:, 1]):
        for z in (low[:, 2], high[:, 2]):
            distances.append(np.hypot(y, z))
    breaks = [a, b]
    for distance in distances:
        with np.errstate(invalid="ignore"):
            x = np.sqrt(np.maximum(radius**2 - distance**2, 0))
        x = np.where(np.isfinite(x), x, 0)
        breaks += [np.clip(x, a, np.maximum(a, b)), np.clip(-x, a, np.maximum(a, b))]
    breaks = np.sort(np.array(breaks), axis=0)
    volume = np.zeros(len(radius))
    u = 0.5 * (GAUSS[0] + 1)
    place, weight = u * u * (3 - 2 * u), 0.5 * GAUSS[1] * 6 * u * (1 - u)
    for left, right in zip(breaks[:-1], breaks[1:]):
        width = right - left
        use = (width > 0) & (b > a)
        if not use.any():
            continue
        start, width, square = left[use], width[use], radius[use] ** 2
        y, z = (low[use, 1], high[use, 1]), (low[use, 2], high[use, 2])
        for p, w in zip(place, weight):
            x = start + p * width
            volume[use] += w * width * rectangle(y, z, np.sqrt(np.maximum(square - x * x, 1e-300)))
    return np.where(b > a, volume, 0)


class Grid:
    def __init__(self, s):
        self.min, self.max = np.array(s["domain"]["min"], float), np.array(s["domain"]["max"], float)
        self.axes = [s["lateral"], s["depth"], s["up"]]
        given = s.get("cells") or s["cell"]
        self.depth_averaged = len(given) == 2
        extent = (self.max - self.min)[self.axes]
        use = given if len(given) == 3 else [given[0], None, given[1]]
        if "cells" in s:
            self.n = [1 if v is None else int(v) for v in use]
        else:
            self.n = [1 if v is None else max(1, round(e / v)) for v, e in zip(use, extent)]
        self.size = extent / self.n
        self.low = self.min[self.axes]
        self.volume = float(np.prod(self.size))
        self.periodic = [axis in s["periodic"] for axis in self.axes]
        self.faces = [np.linspace(l, l + e, n + 1) for l, e, n in zip(self.low, extent, self.n)]

    def shares(self, position, radius, mapping):
        """(particle, cell, volume) triples; cell = (up * depth + depth index) * lateral + lateral."""
        p = position[:, self.axes].copy()
        extent = self.size * self.n
        for axis in range(3):
            if self.periodic[axis]:
                p[:, axis] = self.low[axis] + np.mod(p[:, axis] - self.low[axis], extent[axis])
        volume = 4 / 3 * math.pi * radius**3
        if mapping == "centre":
            # as numpy.histogram: [face, next face), the last cell closed
            index = [np.searchsorted(f, p[:, i], side="right") - 1 - (p[:, i] == f[-1])
                     for i, f in enumerate(self.faces)]
            ok = np.all([(i >= 0) & (i < n) for i, n in zip(index, self.n)], axis=0)
            cell = (index[2] * self.n[1] + index[1]) * self.n[0] + index[0]
            return np.nonzero(ok)[0], cell[ok], volume[ok]
        assert mapping == "exact"
        reach = [int(math.ceil(2 * radius.max() / d)) + 1 if len(radius) else 0 for d in self.size]
        first = [np.floor((p[:, i] - radius - self.low[i]) / self.size[i]).astype(int) for i in range(3)]
        who, where, low, high = [], [], [], []
        for i in range(reach[0] + 1):
            for k in range(reach[2] + 1):
                for j in range(1 if self.depth_averaged else reach[1] + 1):
                    index = [first[0] + i, first[1] + j, first[2] + k]
                    box_low = np.empty_like(p)
                    box_high = np.empty_like(p)
                    keep = np.ones(len(p), bool)
                    for axis in range(3):
                        if axis == 1 and self.depth_averaged:
                            # front and back do not cut: in or out by the centre
                            box_low[:, 1], box_high[:, 1] = -1e3 * radius, 1e3 * radius
                            index[1] = np.zeros(len(p), int)
                            keep &= (p[:, 1] >= self.low[1]) & (p[:, 1] <= self.low[1] + self.size[1])
                            continue
                        face = self.low[axis] + index[axis] * self.size[axis]
                        box_low[:, axis] = face - p[:, axis]
                        box_high[:, axis] = face + self.size[axis] - p[:, axis]
                        if self.periodic[axis]:
                            index[axis] = np.mod(index[axis], self.n[axis])
                        else:
                            keep &= (index[axis] >= 0) & (index[axis] < self.n[axis])
                        keep &= (box_low[:, axis] < radius) & (box_high[:, axis] > -radius)
                    cell = (index[2] * self.n[1] + index[1]) * self.n[0] + index[0]
                    who.append(np.nonzero(keep)[0])
                    where.append(cell[keep])
                    low.append(box_low[keep])
                    high.append(box_high[keep])
        who, where = np.concatenate(who), np.concatenate(where)
        part = overlap(radius[who], np.concatenate(low), np.concatenate(high))
        return who, where, part

    def fields(self, who, where, amount):
        flat = np.bincount(where, weights=amount, minlength=int(np.prod(self.n)))
        return flat.reshape(self.n[2], self.n[1], self.n[0])


# --------------------------------------------------------------------------------------- settings
def settings_of(study_path):
    with open(study_path, "rb") as file:
        study = tomllib.load(file)
    folder = os.path.dirname(os.path.abspath(study_path))
    for number, run in enumerate(study["run"], 1):
        s = {"up": "z", "lateral": "x", "periodic": [], "mapping": "exact", "step_zero": 0}
        s |= study.get("scene", {}) | run
        s["label"] = run.get("label", f"run {number}")
        for key in ("up", "lateral"):
            s[key] = "xyz".index(s[key])
        s["depth"] = 3 - s["up"] - s["lateral"]
        s["periodic"] = ["xyz".index(axis) for axis in s["periodic"]]
        s["particles"] = os.path.join(folder, run["particles"])
        if "gas" in run:
            s["gas"] = os.path.join(folder, run["gas"])
            s["gas_names"] = study.get("gas", {})
        s["profiles"] = study.get("profiles", {})
        s["clusters"] = {"threshold": 0.2, "core": 0.4, "min_area": 60e-6} | study.get("clusters", {})
        s["temperature"] = study.get("temperature", {})
        s["bubbles"] = {"threshold": 0.8, "core": 0.9} | study["bubbles"] if "bubbles" in study else None
        s["bed"], s["spectra"] = study.get("bed", {}), study.get("spectra")
        yield s


def by_type(value, types):
    if isinstance(value, dict):
        return np.array([value[str(int(t))] for t in types], float)
    return np.full(len(types), float(value))


COMPARE = {"<=": np.less_equal, ">=": np.greater_equal, "==": np.equal, "!=": np.not_equal,
           "<": np.less, ">": np.greater}


def weights_of(times):
    """Half the gap to each neighbour; the first and the last stand for their one gap whole."""
    if len(times) == 1:
        return np.ones(1)
    gaps = np.diff(times)
    weights = np.concatenate([[gaps[0]], (gaps[:-1] + gaps[1:]) / 2, [gaps[-1]]])
    return weights / weights.sum()


def ratio(a, b):
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(b > 0, a / b, NAN)


# ------------------------------------------------------------------------------------ recomputation
def find_clusters(grid, s, total, mass, momentum):
    """Clusters of one snapshot: fields (up, lateral) of holdup, mass, mass times velocity."""
    labels, count = scipy.ndimage.label(total > s["clusters"]["threshold"], np.ones((3, 3)))
    area = grid.size[0] * grid.size[2]
    found = []
    for label in range(1, count + 1):
        rows, columns = np.nonzero(labels == label)
        inside = total[rows, columns]
        # an area that is the limit but for rounding passes
        if len(rows) * area < s["clusters"]["min_area"] * (1 - 1e-12):
            continue
        if not inside.max() > s["clusters"]["core"]:
            continue
        x = grid.low[0] + (columns + 0.5) * grid.size[0]
        z = grid.low[2] + (rows + 0.5) * grid.size[2]
        xx = np.mean((x - x.mean()) ** 2) + grid.size[0] ** 2 / 12
        zz = np.mean((z - z.mean()) ** 2) + grid.size[2] ** 2 / 12
        xz = np.mean((x - x.mean()) * (z - z.mean()))
        moments, vectors = np.linalg.eigh([[xx, xz], [xz, zz]])
        angle = math.atan2(vectors[1, 1], vectors[0, 1])
        angle = angle - math.pi if angle > math.pi / 2 else angle
        angle = angle + math.pi if angle <= -math.pi / 2 else angle
        m = mass[rows, columns].sum()
        found.append({
            "x [m]": x.mean(), "z [m]": z.mean(), "area [m2]": len(rows) * area,
            "holdup [-]": inside.mean(), "holdup_max [-]": inside.max(),
            "velocity_x [m/s]": momentum[0][rows, columns].sum() / m,
            "velocity_z [m/s]": momentum[1][rows, columns].sum() / m,
            "major [m]": 4 * math.sqrt(moments[1]), "minor [m]": 4 * math.sqrt(moments[0]),
            "angle [rad]": angle if moments[1] - moments[0] > 1e-9 * moments[1] else None,
        })
    return found, area


def recompute(s):
    """The tables of one run, {name: {key: {column: value}}}, and its summary."""
    snapshots = read_run(s["particles"])
    grid = Grid(s)
    times = np.array([(n["step"] - s["step_zero"]) * s["time_step"] for n in snapshots])
    average = s.get("average", {})
    slack = s["time_step"] / 2
    window = np.nonzero((times >= average.get("from", -math.inf) - slack)
                        & (times <= average.get("to", math.inf) + slack))[0]
    weights = dict(zip(window, weights_of(times[window])))
    types = sorted({int(t) for n in snapshots for t in n["columns"]["type"]})
    rules = s.get("species", {})
    groups = ["all"] + [str(t) for t in types] + list(rules)
    shape = (grid.n[2], grid.n[1], grid.n[0])
    phi = {g: np.zeros(shape) for g in groups}
    phi_v = {g: np.zeros(shape) for g in groups}
    flux = {g: np.zeros(shape) for g in groups}
    tables = {name: {} for name in ("axial_profile", "lateral_profile", "inventory", "clusters",
                                    "cluster_occurrence", "temperature", "temperature_pdf",
                                    "bed_height", "bubbles", "bubble_profile", "spectrum",
                                    "fluctuation")}
    label, domain_volume = s["label"], float(np.prod(grid.max - grid.min))
    temperature_key = s["temperature"].get("column", "f_Temp[0]")
    bins = s["temperature"].get("bins", 25)
    edges = np.linspace(0, 1, bins + 1)
    pdf = {g: np.zeros(len(edges) - 1) for g in groups}
    pdf_all = {g: 0.0 for g in groups}
    outside = whole = inventory = mean_holdup = occurrence = 0.0
    seen = []  # bubbles of each snapshot in the window
    has_temperature = any(temperature_key in n["columns"] for n in snapshots)

    for number, snapshot in enumerate(snapshots):
        c, time = snapshot["columns"], times[number]
        position = np.stack([c["x"], c["y"], c["z"]], axis=1)
        velocity = np.stack([c["vx"], c["vy"], c["vz"]], axis=1)
        radius = c["radius"] if "radius" in c else by_type(s["radius"], c["type"])
        volume = 4 / 3 * math.pi * radius**3
        if "density" in s:
            rho = by_type(s["density"], c["type"])
        else:
            rho = c["density"] if "density" in c else c["mass"] / volume
        members = {"all": np.ones(len(radius), bool)}
        members |= {str(t): c["type"] == t for t in types}
        for name, rule in rules.items():
            column, sign, value = re.match(r"\s*(.*?)\s*(<=|>=|==|!=|<|>)\s*(.*)", rule).groups()
            members[name] = COMPARE[sign](c[column], float(value))
        for g in groups:
            use = members[g]
            v, m = volume[use], (volume * rho)[use]
            tables["inventory"][label, time, g] = {
                "particles": use.sum(), "solids_mass [kg]": m.sum(),
                "holdup [-]": v.sum() / domain_volume,
                "mean_height [m]": (m * position[use, grid.axes[2]]).sum() / m.sum() if use.any() else NAN}
            if has_temperature:
                t = c[temperature_key][use]
                tables["temperature"][label, time, g] = {
                    "mean [K]": t.mean(), "std [K]": t.std(), "min [K]": t.min(), "max [K]": t.max()
                } if use.any() else dict.fromkeys(("mean [K]", "std [K]", "min [K]", "max [K]"), NAN)

        who, where, part = grid.shares(position, radius, s["mapping"])
        lateral, up = velocity[who, grid.axes[0]], velocity[who, grid.axes[2]]
        total = grid.fields(who, where, part).mean(axis=1) / grid.volume
        mass = grid.fields(who, where, part * rho[who]).mean(axis=1)
        momentum = [grid.fields(who, where, part * rho[who] * v).mean(axis=1) for v in (lateral, up)]
        found, area = find_clusters(grid, s, total, mass, momentum)
        bed_row(tables["bed_height"], (label, time), s, grid, total,
                tables["inventory"][label, time, "all"]["mean_height [m]"])
        if s["bubbles"] is not None and number in weights:
            seen.append(find_bubbles(grid, s["bubbles"], total,
                                     tables["bed_height"][label, time]["height_surface [m]"]))
        tables["cluster_occurrence"][label, time] = {
            "clusters": len(found),
            "area_fraction [-]": sum(f["area [m2]"] for f in found) / (area * grid.n[0] * grid.n[2])}
        if number not in weights:
            continue
        w = weights[number]
        for f in found:  # the order of the clusters is the program's: found again by their place
            key = (label, time, round(f["x [m]"], 9), round(f["z [m]"], 9))
            assert key not in tables["clusters"]
            tables["clusters"][key] = f
        for g in groups:
            use = members[g][who]
            args = who[use], where[use]
            phi[g] += w * grid.fields(*args, part[use]) / grid.volume
            phi_v[g] += w * grid.fields(*args, part[use] * up[use]) / grid.volume
            flux[g] += w * grid.fields(*args, (part * rho[who] * up)[use]) / grid.volume
            if has_temperature and "from" in s["temperature"]:
                cold, hot = s["temperature"]["from"], s["temperature"]["to"]
                t = c[temperature_key][members[g]]
                pdf[g] += w * np.histogram(t, bins, (cold, hot))[0]
                pdf_all[g] += w * len(t)
        outside += w * (volume.sum() - part.sum())
        whole += w * volume.sum()
        inventory += w * (volume * rho).sum()
        mean_holdup += w * part.sum() / domain_volume
        occurrence += w * len(found)

    up_centres = grid.low[2] + (np.arange(grid.n[2]) + 0.5) * grid.size[2]
    x_centres = grid.low[0] + (np.arange(grid.n[0]) + 0.5) * grid.size[0]
    for g in groups:
        fields = phi[g], phi_v[g], flux[g]
        rows = [f.mean(axis=(1, 2)) for f in fields]
        for k, z in enumerate(up_centres):
            tables["axial_profile"][label, g, z] = profile_row(*[r[k] for r in rows])
        band = s["profiles"].get("band", 2 * grid.size[2])
        quarters = [grid.low[2] + part * grid.size[2] * grid.n[2] for part in (0.25, 0.5, 0.75)]
        for height in s["profiles"].get("heights", quarters):
            low, high = height - band / 2, height + band / 2
            faces = grid.faces[2]
            share = np.maximum(np.minimum(high, faces[1:]) - np.maximum(low, faces[:-1]), 0)
            columns = [np.tensordot(share / share.sum(), f.mean(axis=1), 1) for f in fields]
            for i, x in enumerate(x_centres):
                tables["lateral_profile"][label, g, height, x] = profile_row(*[r[i] for r in columns])
        if has_temperature and "from" in s["temperature"]:
            for i, centre in enumerate((edges[1:] + edges[:-1]) / 2):
                density = pdf[g][i] / (pdf_all[g] * (edges[1] - edges[0])) if pdf_all[g] else NAN
                tables["temperature_pdf"][label, g, centre] = {"probability_density [-]": density}
    if s["bubbles"] is not None:
        bubble_tables(tables, label, s, grid, times[window], [weights[i] for i in window], seen)
    if s["spectra"] is not None:
        spectra(tables, label, s, times[window])
    summary = {"label": label, "snapshots": len(window), "mean_holdup": mean_holdup,
               "inventory_kg": inventory, "mean_occurrence": occurrence,
               "outside_fraction": outside / whole if whole else NAN,
               "from": times[window[0]], "to": times[window[-1]]}
    if "gas" in s:
        gas, of_gas = judge_gas.recompute(sys.modules[__name__], s, snapshots, grid, times, window, tables)
        tables |= gas
        summary |= of_gas
    return tables, summary


# --------------------------------------------------------------- bed height, bubbles, fluctuations
def bed_row(table, key, s, grid, total, mean_height):
    layers = total.mean(axis=1)
    floor, width = grid.low[2], grid.size[2]
    row = {"height [m]": 2 * (mean_height - floor), "height_solids [m]": NAN,
           "height_surface [m]": NAN}
    if layers.sum() > 0:
        below = np.concatenate([[0], np.cumsum(layers)])
        wanted = 0.95 * below[-1]
        k = int(np.searchsorted(below, wanted)) - 1
        row["height_solids [m]"] = (k + (wanted - below[k]) / layers[k]) * width
        limit = (layers**2).sum() / layers.sum() / 2
        top = np.nonzero(layers > limit)[0][-1]
        above = layers[top + 1] if top + 1 < len(layers) else 0.0
        height = (top + 0.5 + (layers[top] - limit) / (layers[top] - above)) * width
        row["height_surface [m]"] = min(height, len(layers) * width)
    rest = s["bed"].get("height_at_rest")
    if rest is None:
        firsts = [r["height [m]"] for k, r in table.items() if k[0] == key[0]] + [row["height [m]"]]
        rest = next((h for h in firsts if not math.isnan(h)), NAN)
    row["expansion [-]"] = row["height [m]"] / rest
    table[key] = row


def find_bubbles(grid, limits, total, surface):
    """Bubbles of one snapshot with the cells that they own."""
    voidage = 1 - total
    labels, count = scipy.ndimage.label(voidage > limits["threshold"], np.ones((3, 3)))
    cell = grid.size[0] * grid.size[2]
    least = limits.get("min_area", 4 * cell)
    found = []
    for label in range(1, count + 1):
        rows, columns = np.nonzero(labels == label)
        if len(rows) * cell < least * (1 - 1e-9) or not voidage[rows, columns].max() > limits["core"]:
            continue
        z = (rows.mean() + 0.5) * grid.size[2]
        if rows.max() == grid.n[2] - 1 or not z < surface:
            continue
        x = (columns + 0.5) * grid.size[0]
        zz = rows.var() * grid.size[2] ** 2 + grid.size[2] ** 2 / 12
        xx = x.var() + grid.size[0] ** 2 / 12
        wall = columns.min() == 0 or columns.max() == grid.n[0] - 1 or rows.min() == 0
        found.append({"x": grid.low[0] + x.mean(), "z": grid.low[2] + z, "area": len(rows) * cell,
                      "aspect": math.sqrt(zz / xx), "voidage": voidage[rows, columns].mean(),
                      "wall": int(wall), "mask": labels == label})
    return found


def bubble_tables(tables, label, s, grid, times, weights, seen):
    """Sizes and shares; tracks are judged where bubbles are drawn (bubbling_test.py)."""
    top = grid.low[2] + grid.n[2] * grid.size[2]
    heights = s["profiles"].get("heights")
    if heights:
        band = s["profiles"].get("band", 2 * grid.size[2])
    else:
        band = (top - grid.low[2]) / min(20, grid.n[2])
        heights = [grid.low[2] + (b + 0.5) * band for b in range(min(20, grid.n[2]))]
    for time, found in zip(times, seen):
        for b in found:
            tables["bubbles"][label, time, round(b["x"], 9), round(b["z"], 9)] = {
                "x [m]": b["x"], "z [m]": b["z"], "area [m2]": b["area"],
                "diameter [m]": math.sqrt(4 * b["area"] / math.pi), "aspect [-]": b["aspect"],
                "voidage [-]": b["voidage"], "at_wall": b["wall"]}
    faces = grid.faces[2]
    for height in heights:
        low, high = height - band / 2, height + band / 2
        share = np.maximum(np.minimum(high, faces[1:]) - np.maximum(low, faces[:-1]), 0)
        number = diameter = covered = 0.0
        for weight, found in zip(weights, seen):
            inside = [b for b in found if low <= b["z"] < high]
            number += weight * len(inside)
            diameter += weight * sum(math.sqrt(4 * b["area"] / math.pi) for b in inside)
            if found:
                mask = sum(b["mask"] for b in found).mean(axis=1)
                covered += weight * (mask * share).sum() / share.sum()
        tables["bubble_profile"][label, height] = {
            "band [m]": band, "bubbles [-]": number, "area_fraction [-]": covered,
            "diameter [m]": diameter / number if number else NAN}


def spectra(tables, label, s, times):
    """scipy's Welch at the segment length that the program chose; the choice is judged in C++."""
    gap = (times[-1] - times[0]) / (len(times) - 1)
    inventory, bed = tables["inventory"], tables["bed_height"]
    signals = {"mean height": ("m", [inventory[label, t, "all"]["mean_height [m]"] for t in times]),
               "bed surface": ("m", [bed[label, t]["height_surface [m]"] for t in times]),
               "mean holdup": ("-", [inventory[label, t, "all"]["holdup [-]"] for t in times])}
    for name, (unit, values) in signals.items():
        values = np.array(values)
        weight = weights_of(times)
        mean = (weight * values).sum()
        tables["fluctuation"][label, name] = {
            "samples": len(values), "mean [unit]": mean,
            "std [unit]": math.sqrt((weight * (values - mean) ** 2).sum())}
        length = int(s["spectra"]["segment"] / gap + 1e-6) // 2 * 2
        f, density = scipy.signal.welch(values, 1 / gap, "hann", nperseg=length, noverlap=length // 2,
                                        detrend="linear")
        segments = (len(values) - length) // (length // 2) + 1
        window = scipy.signal.get_window("hann", length)
        rho = (window[: length // 2] @ window[length // 2 :] / (window @ window)) ** 2
        freedom = 2 * segments / (1 + 2 * (segments - 1) / segments * rho)
        for k in range(len(f)):
            nu = freedom / 2 if k in (0, len(f) - 1) else freedom
            tables["spectrum"][label, name, f[k]] = {
                "psd [unit2/Hz]": density[k],
                "psd_lo [unit2/Hz]": density[k] * nu / scipy.stats.chi2.ppf(0.975, nu),
                "psd_hi [unit2/Hz]": density[k] * nu / scipy.stats.chi2.ppf(0.025, nu)}
        tables["fluctuation"][label, name] |= {
            "resolution [Hz]": 1 / (length * gap), "segments": segments,
            "degrees_of_freedom": freedom}


def profile_row(phi, phi_v, flux):
    return {"holdup [-]": phi, "velocity_z [m/s]": float(ratio(np.float64(phi_v), np.float64(phi))),
            "mass_flux_z [kg/m2/s]": flux}


# -------------------------------------------------------------------------------------- comparison
KEYS = {
    "axial_profile": ["run", "type", "z [m]"],
    "lateral_profile": ["run", "type", "height [m]", "x [m]"],
    "inventory": ["run", "time [s]", "type"],
    "clusters": ["run", "time [s]", "x [m]", "z [m]"],
    "cluster_occurrence": ["run", "time [s]"],
    "temperature": ["run", "time [s]", "type"],
    "temperature_pdf": ["run", "type", "bin_centre [-]"],
    "bed_height": ["run", "time [s]"],
    "bubbles": ["run", "time [s]", "x [m]", "z [m]"],
    "bubble_profile": ["run", "height [m]"],
    "spectrum": ["run", "signal", "frequency [Hz]"],
    "fluctuation": ["run", "signal"],
} | judge_gas.KEYS
HEADERS = {
    "axial_profile": "run,type,z [m],holdup [-],holdup_ci95 [-],velocity_z [m/s],velocity_z_ci95 [m/s],mass_flux_z [kg/m2/s],mass_flux_z_ci95 [kg/m2/s]",
    "lateral_profile": "run,type,height [m],x [m],holdup [-],holdup_ci95 [-],velocity_z [m/s],velocity_z_ci95 [m/s],mass_flux_z [kg/m2/s],mass_flux_z_ci95 [kg/m2/s]",
    "inventory": "run,time [s],type,particles,solids_mass [kg],holdup [-],mean_height [m]",
    "clusters": "run,time [s],cluster,track,x [m],z [m],area [m2],holdup [-],holdup_max [-],velocity_x [m/s],velocity_z [m/s],track_velocity_x [m/s],track_velocity_z [m/s],major [m],minor [m],angle [rad],parents",
    "cluster_occurrence": "run,time [s],clusters,area_fraction [-]",
    "temperature": "run,time [s],type,mean [K],std [K],min [K],max [K]",
    "temperature_pdf": "run,type,bin_centre [-],probability_density [-]",
    "bed_height": "run,time [s],height [m],height_solids [m],height_surface [m],expansion [-]",
    "bubbles": "run,time [s],bubble,track,x [m],z [m],area [m2],diameter [m],aspect [-],voidage [-],velocity_x [m/s],velocity_z [m/s],at_wall,parents",
    "bubble_profile": "run,height [m],band [m],bubbles [-],bubbles_ci95 [-],diameter [m],diameter_ci95 [m],velocity_z [m/s],velocity_z_ci95 [m/s],frequency [1/s],frequency_ci95 [1/s],area_fraction [-],area_fraction_ci95 [-]",
    "spectrum": "run,signal,unit,frequency [Hz],psd [unit2/Hz],psd_lo [unit2/Hz],psd_hi [unit2/Hz]",
    "fluctuation": "run,signal,unit,samples,mean [unit],mean_ci95 [unit],std [unit],std_ci95 [unit],dominant_frequency [Hz],dominant_frequency_half_width [Hz],resolution [Hz],segments,degrees_of_freedom",
} | judge_gas.HEADERS
TEXT_KEYS = {"run", "type", "signal"}


def rounded(value):
    return value if isinstance(value, str) else round(float(value), 9)


class Judge:
    def __init__(self, relative, limit=5):
        self.relative, self.intervals = relative, 0
        self.faults, self.compared, self.worst, self.limit = {}, 0, 0.0, limit

    def fault(self, where, text):
        self.faults.setdefault(where, []).append(text)

    def number(self, where, key, expected, found, scale):
        """Within the tolerance of the value; of a difference of large terms, of those terms (`scale`)."""
        self.compared += 1
        expected, found = float(expected), float(found)
        if math.isnan(expected) or math.isnan(found):
            if math.isnan(expected) != math.isnan(found):
                self.fault(where, f"{key}: expected {expected!r}, found {found!r}")
            return
        error = abs(found - expected) / max(abs(expected), scale) if expected != found else 0
        self.worst = max(self.worst, error)
        if error > self.relative:
            self.fault(where, f"{key}: expected {expected!r}, found {found!r}")

    def table(self, name, folder, expected, several):
        path = os.path.join(folder, "tables", name + ".csv")
        if not os.path.exists(path):
            if expected:
                self.fault(name, f"no file, {len(expected)} rows expected")
            return
        with open(path, newline="") as file:
            text = file.read()
        rows = list(csv.DictReader(text.splitlines()))
        header = text.splitlines()[0]
        if header != HEADERS[name]:
            self.fault(name, f"header {header}")
        found = {}
        for row in rows:
            key = tuple(rounded(row[k] if k in TEXT_KEYS else float(row[k])) for k in KEYS[name])
            if key in found:
                self.fault(name, f"{key} twice")
            found[key] = row
        wanted = {tuple(rounded(k) for k in key): row for key, row in expected.items()}
        for key in wanted.keys() - found.keys():
            self.fault(name, f"{key} is missing")
        for key in found.keys() - wanted.keys():
            self.fault(name, f"{key} is not expected")
        largest = {}
        for row in wanted.values():
            for column, value in row.items():
                if value is not None and math.isfinite(value):
                    largest[column] = max(largest.get(column, 0), abs(value))
        for key in wanted.keys() & found.keys():
            for column, value in wanted[key].items():
                if value is None:
                    continue
                # sums of positive and negative velocities, and slivers of spheres, are as exact as
                # the largest terms in them
                signed = column.startswith(("velocity", "mass_flux", "angle", "mean_height", "slip"))
                scale = largest.get(column, 0) * (1e-3 if signed else 1e-6)
                self.number(f"{name}: {column}", key, value, found[key][column], max(scale, 1e-300))
            for column in row_intervals(found[key]):
                self.interval(f"{name}: {column}", key, found[key], column, several)

    def interval(self, where, key, row, column, several):
        value, centre = float(row[column]), float(row[column.replace("_ci95", "")])
        self.compared += 1
        if math.isnan(value):
            return  # whether there is one is the statistics' own business; below: not always nan
        self.intervals += 1
        if value < 0 or math.isinf(value) or (not several) or math.isnan(centre):
            self.fault(where, f"{key}: half-width {value!r} of {centre!r}")

    def summary(self, where, expected, found):
        for key, value in expected.items():
            if isinstance(value, str) or key in ("snapshots", "gas_times", "gas_matched"):
                if found.get(key) != value:
                    self.fault("summary", f"{where} {key}: expected {value}, found {found.get(key)}")
            else:
                got = found.get(key)
                self.number("summary", f"{where} {key}", value, NAN if got is None else got, 1e-5)
        n = found.get("independent_samples")
        if n is not None and not 0 < n <= expected["snapshots"] * (1 + 1e-9):
            self.fault("summary", f"{where} independent_samples {n} of {expected['snapshots']}")

    def report(self, title):
        count = sum(len(texts) for texts in self.faults.values())
        print(f"{title}: {self.compared} values compared, worst {self.worst:.1e}, {count} wrong")
        for where, texts in self.faults.items():
            print(f"  {where}: {len(texts)} wrong")
            for text in texts[: self.limit]:
                print(f"    {text}")
        return not self.faults


def row_intervals(row):
    return [column for column in row if "_ci95" in column]


def judge_study(program, study, folder=None, relative=RELATIVE):
    with tempfile.TemporaryDirectory() as temporary:
        folder = folder or temporary
        done = subprocess.run([program, "analyse", study, "-o", folder, "--tables-only", "--quiet"],
                              capture_output=True, text=True)
        judge = Judge(relative)
        if done.returncode != 0:
            judge.fault("exit code", f"{done.returncode}: {done.stderr}")
            return judge.report(study)
        with open(os.path.join(folder, "summary.json")) as file:
            runs = json.load(file)["runs"]
        expected = {name: {} for name in KEYS}
        several = False
        for s, found in zip(settings_of(study), runs, strict=True):
            tables, summary = recompute(s)
            several = several or summary["snapshots"] > 1
            judge.summary(s["label"], summary, found)
            for name, rows in tables.items():
                expected[name] |= rows
        for name, rows in expected.items():
            judge.table(name, folder, rows, several)
        if several and not judge.intervals:
            judge.fault("intervals", "none at all")
        return judge.report(study)


if __name__ == "__main__":
    results = [judge_study(sys.argv[1], study) for study in sys.argv[2:]]
    sys.exit(0 if results and all(results) else 1)
