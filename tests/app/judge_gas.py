# SPDX-License-Identifier: BSD-3-Clause
"""The gas of a run, recomputed by numpy from the definitions in docs/: part of judge.py.

Reads OpenFOAM cases in ascii with meshes of boxes, by a parser of its own. Every cell of the mesh is
laid over every cell of the grid (dense matrices), so cases have to be small.
"""

import gzip
import math
import os
import re

import numpy as np

NAN = float("nan")
PROFILE = "voidage [-],velocity_z [m/s],temperature [K],pressure [Pa],slip_z [m/s]"
INTERVALS = ("voidage_ci95 [-],velocity_z_ci95 [m/s],temperature_ci95 [K],pressure_ci95 [Pa],"
             "slip_z_ci95 [m/s]")
KEYS = {
    "gas_axial": ["run", "z [m]"],
    "gas_lateral": ["run", "height [m]", "x [m]"],
    "voidage_check": ["run", "time [s]"],
    "pressure_drop": ["run", "time [s]"],
}
HEADERS = {
    "gas_axial": f"run,z [m],{PROFILE},{INTERVALS}",
    "gas_lateral": f"run,height [m],x [m],{PROFILE},{INTERVALS}",
    "voidage_check": "run,time [s],solids_volume_particles [m3],solids_volume_gas [m3],ratio [-],"
                     "mean_difference [-],rms_difference [-],largest_difference [-],cells",
    "pressure_drop": "run,time [s],pressure_drop [Pa],bed_weight_over_area [Pa]",
}


# ------------------------------------------------------------------------------------------- cases
def text_of(path):
    if not os.path.exists(path):
        path += ".gz"
    raw = open(path, "rb").read()
    return (gzip.decompress(raw) if path.endswith(".gz") else raw).decode()


def body_of(path):
    """The list behind the header: what stands between the outermost brackets."""
    text = text_of(path)
    text = text[text.index("}") + 1:]
    return text[text.index("(") + 1 : text.rindex(")")]


def read_boxes(case):
    """Lowest and highest corner of each cell, (cells, 3), from the points of its faces."""
    folder = os.path.join(case, "constant", "polyMesh")
    points = np.array(re.sub(r"[()]", " ", body_of(folder + "/points")).split(), float).reshape(-1, 3)
    faces = [np.array(f.split(), int) for f in re.findall(r"\(([^()]*)\)", body_of(folder + "/faces"))]
    owner = np.array(body_of(folder + "/owner").split(), int)
    neighbour = np.array(body_of(folder + "/neighbour").split(), int)
    cells = owner.max() + 1
    low, high = np.full((cells, 3), np.inf), np.full((cells, 3), -np.inf)
    for face, points_of in enumerate(faces):
        for cell in [owner[face]] + ([neighbour[face]] if face < len(neighbour) else []):
            low[cell] = np.minimum(low[cell], points[points_of].min(axis=0))
            high[cell] = np.maximum(high[cell], points[points_of].max(axis=0))
    return low, high


def read_field(case, time, name, cells):
    """(values, dimensions), or None where the time has no such field."""
    path = os.path.join(case, time, name)
    if not os.path.exists(path) and not os.path.exists(path + ".gz"):
        return None
    text = text_of(path)
    dimensions = [float(v) for v in re.search(r"dimensions\s*\[([^]]*)\]", text).group(1).split()]
    field = re.search(r"internalField\s+(uniform|nonuniform)([^;]*);", text, re.S)
    if field.group(1) == "uniform":
        one = np.array(re.sub(r"[()]", " ", field.group(2)).split(), float)
        return np.tile(one, (cells, 1)).squeeze(), dimensions
    inner = field.group(2)[field.group(2).index("(") + 1 : field.group(2).rindex(")")]
    values = np.array(re.sub(r"[()]", " ", inner).split(), float)
    return values.reshape(cells, -1).squeeze(), dimensions


# ----------------------------------------------------------------------------------------- mapping
class Overlap:
    """Volume of each cell of the mesh in each cell of the grid: (mesh, up, depth, lateral)."""

    def __init__(self, grid, low, high):
        parts = []
        for k, axis in enumerate(grid.axes):
            faces = grid.faces[k]
            upper = np.minimum(high[:, axis, None], faces[None, 1:])
            lower = np.maximum(low[:, axis, None], faces[None, :-1])
            parts.append(np.maximum(upper - lower, 0))
        self.w = np.einsum("cz,cy,cx->czyx", parts[2], parts[1], parts[0])
        self.w[self.w < 1e-6 * self.w.max()] = 0  # slivers of planes that are meant to be the same
        self.volume = np.prod(high - low, axis=1)
        self.covered = self.w.sum(axis=0)
        self.inside = self.w.sum(axis=(1, 2, 3))

    def to_grid(self, values):  # integrals
        return np.tensordot(values, self.w, 1)


def pressure_drop(grid, low, high, overlap, pressure, domain):
    up = grid.axes[2]
    centre = (low[:, up] + high[:, up]) / 2
    inside = overlap.inside > 0.5 * overlap.volume
    heights = np.unique(np.round(centre[inside], 9))
    if len(heights) < 2:
        return NAN
    means = []
    for i, height in enumerate(heights):
        layer = inside & (abs(centre - height) < 1e-8)
        heights[i] = centre[layer].mean()
        means.append(np.average(pressure[layer], weights=overlap.volume[layer]))
    bottom, top = max(domain[0], low[:, up].min()), min(domain[1], high[:, up].max())

    def at(z, i, j):  # the line through two layers
        return means[i] + (means[j] - means[i]) * (z - heights[i]) / (heights[j] - heights[i])

    return at(bottom, 0, 1) - at(top, -1, -2)


def mean_of(numerator, denominator):
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(denominator > 0, numerator / denominator, NAN)


# -------------------------------------------------------------------------------------- recomputation
def recompute(judge, s, snapshots, grid, times, window, solids):
    """Tables and summary of the gas; `solids`: the tables of the particles, for the slip."""
    case, label = s["gas"], s["label"]
    low, high = read_boxes(case)
    overlap = Overlap(grid, low, high)
    names = {"voidage": "voidfraction", "velocity": "U", "pressure": "p", "temperature": "T"} | s["gas_names"]
    folders = sorted((f for f in os.listdir(case) if re.fullmatch(r"[0-9.e+-]+", f)), key=float)
    clock = np.array([float(f) for f in folders])
    tolerance = max(s["time_step"] / 2, 1e-6 * (clock[-1] - clock[0]) / max(1, len(clock) - 1))
    average = s.get("average", {})
    begin = average.get("from", times[window[0]])
    end = average.get("to", times[window[-1]])
    used = np.nonzero((clock >= begin - tolerance) & (clock <= end + tolerance))[0]
    weights = dict(zip(used, judge.weights_of(clock[used])))
    shape = overlap.covered.shape
    sums = {key: np.zeros(shape) for key in ("V", "eps", "u", "flux", "t", "heat", "p", "press")}
    tables = {name: {} for name in KEYS}
    drops, voidages = {}, {}
    for n, folder in enumerate(folders):
        solids_name = s["gas_names"].get("solids")
        voidage = read_field(case, folder, solids_name or names["voidage"], len(low))[0]
        if solids_name:
            voidage = 1 - voidage
        voidages[n] = voidage
        pressure = read_field(case, folder, names["pressure"], len(low))
        if pressure is not None:
            factor = s["gas_density"] if pressure[1][:3] == [0, 2, -2] else 1
            pressure = pressure[0] * factor
            up = grid.axes[2]
            drops[n] = pressure_drop(grid, low, high, overlap, pressure, (grid.min[up], grid.max[up]))
        if n not in weights:
            continue
        w = weights[n]
        gas = overlap.to_grid(voidage)
        sums["V"] += w * overlap.covered
        sums["eps"] += w * gas
        velocity = read_field(case, folder, names["velocity"], len(low))
        temperature = read_field(case, folder, names["temperature"], len(low))
        for values, volume, total in ((velocity and velocity[0][:, grid.axes[2]], "u", "flux"),
                                      (temperature and temperature[0], "t", "heat"),
                                      (pressure, "p", "press")):
            if values is not None:
                sums[volume] += w * gas
                sums[total] += w * overlap.to_grid(voidage * values)

    def row(q, solids_row):
        velocity = float(mean_of(q["flux"], q["u"]))
        return {"voidage [-]": float(mean_of(q["eps"], q["V"])), "velocity_z [m/s]": velocity,
                "temperature [K]": float(mean_of(q["heat"], q["t"])),
                "pressure [Pa]": float(mean_of(q["press"], q["p"])),
                "slip_z [m/s]": velocity - solids_row["velocity_z [m/s]"]}

    for k in range(grid.n[2]):
        z = grid.low[2] + (k + 0.5) * grid.size[2]
        tables["gas_axial"][label, z] = row({key: f[k].sum() for key, f in sums.items()},
                                            solids["axial_profile"][label, "all", z])
    band = s["profiles"].get("band", 2 * grid.size[2])
    quarters = [grid.low[2] + part * grid.size[2] * grid.n[2] for part in (0.25, 0.5, 0.75)]
    for height in s["profiles"].get("heights", quarters):
        share = np.maximum(np.minimum(height + band / 2, grid.faces[2][1:])
                           - np.maximum(height - band / 2, grid.faces[2][:-1]), 0) / grid.size[2]
        columns = {key: np.tensordot(share, f.sum(axis=1), 1) for key, f in sums.items()}
        for i in range(grid.n[0]):
            x = grid.low[0] + (i + 0.5) * grid.size[0]
            tables["gas_lateral"][label, height, x] = row(
                {key: c[i] for key, c in columns.items()},
                solids["lateral_profile"][label, "all", height, x])

    totals, weight_of = [], {}
    area = (grid.size * grid.n)[0] * (grid.size * grid.n)[1]
    for number, snapshot in enumerate(snapshots):
        nearest = int(np.argmin(abs(clock - times[number])))
        if abs(clock[nearest] - times[number]) > tolerance:
            continue
        c = snapshot["columns"]
        position = np.stack([c["x"], c["y"], c["z"]], axis=1)
        who, where, part = grid.shares(position, c["radius"], s["mapping"])
        phi = grid.fields(who, where, part) / grid.volume
        volume = 4 / 3 * math.pi * c["radius"] ** 3
        mass = (volume * judge.by_type(s["density"], c["type"])).sum()
        weight_of[times[number]] = mass * part.sum() / volume.sum() * s.get("gravity", 9.81) / area
        on_mesh = mean_of((overlap.w * phi).sum(axis=(1, 2, 3)), overlap.inside)
        on_mesh = np.where(overlap.inside > 0, on_mesh, 0)
        used_cells = overlap.covered > 0
        v = overlap.covered[used_cells]
        mine = overlap.to_grid(on_mesh)[used_cells] / v
        difference = mine - overlap.to_grid(1 - voidages[nearest])[used_cells] / v
        by_particles = (phi * overlap.covered).sum()
        by_gas = (overlap.inside * (1 - voidages[nearest])).sum()
        if number in window:
            totals.append((times[number], by_particles, by_gas))
        tables["voidage_check"][label, times[number]] = {
            "solids_volume_particles [m3]": by_particles, "solids_volume_gas [m3]": by_gas,
            "ratio [-]": by_particles / by_gas,
            "mean_difference [-]": np.average(difference, weights=v),
            "rms_difference [-]": math.sqrt(np.average(difference**2, weights=v)),
            "largest_difference [-]": abs(difference).max(), "cells": used_cells.sum()}
    for n, drop in drops.items():
        matched = np.array(list(weight_of))
        weight = weight_of[matched[np.argmin(abs(matched - clock[n]))]] if len(matched) else NAN
        tables["pressure_drop"][label, clock[n]] = {
            "pressure_drop [Pa]": drop, "bed_weight_over_area [Pa]": weight}
    ratio = NAN
    if totals:
        t, a, b = np.array(totals).T
        ratio = np.average(a, weights=judge.weights_of(t)) / np.average(b, weights=judge.weights_of(t))
    inside = [n for n in used if n in drops]
    w = judge.weights_of(clock[used])[[list(used).index(n) for n in inside]] if inside else []

    def mean(column):
        rows = [tables["pressure_drop"][label, clock[n]][column] for n in inside]
        return np.average(rows, weights=w) if inside else NAN

    summary = {"gas_times": len(used), "gas_matched": len(tables["voidage_check"]),
               "voidage_ratio": ratio, "pressure_drop": mean("pressure_drop [Pa]"),
               "bed_weight_over_area": mean("bed_weight_over_area [Pa]")}
    return tables, summary
