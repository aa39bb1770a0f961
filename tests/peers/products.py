# SPDX-License-Identifier: BSD-3-Clause
"""The products that the peers make of a series of snapshots, as a competent user writes them today.

numpy.histogram2d for the fields, scipy.ndimage.label (8-connected) for the clusters, CSV tables with
the column names of `bedscope analyse`, so that compare.py can hold them against each other number by
number. Mapping `centre`: a particle counts wholly in the cell of its centre. SI units.
"""

import csv
import os
import sys

import numpy as np
from scipy import ndimage

# The scene of the input of make_input.sh. The domain is shifted by a third of a micrometre: text dumps
# hold six digits, so particles lie exactly on multiples of the cell, and which side of such a face they
# count to is decided by rounding alone, differently in every program. No six-digit number lies on these.
SHIFT = -3.337e-7
X_MIN, X_MAX = SHIFT, 0.07 + SHIFT
Z_MIN, Z_MAX = SHIFT, 1.5 + SHIFT
DEPTH = 0.006
CELLS = (28, 600)
DENSITY = 2500.0
TIME_STEP = 1e-5
HEIGHTS = (0.02, 0.22, 0.55)
BAND = 0.01
THRESHOLD, CORE, MIN_AREA = 0.2, 0.4, 60e-6

DX = (X_MAX - X_MIN) / CELLS[0]
DZ = (Z_MAX - Z_MIN) / CELLS[1]
CELL_VOLUME = DX * DZ * DEPTH
X = X_MIN + (np.arange(CELLS[0]) + 0.5) * DX
Z = Z_MIN + (np.arange(CELLS[1]) + 0.5) * DZ


def snapshot_paths(folder):
    """The snapshots of a folder by step, without the bounding boxes that LIGGGHTS writes beside them."""
    paths = []
    for name in os.listdir(folder):
        digits = "".join(c for c in os.path.splitext(name)[0] if c.isdigit())
        if digits and "boundingBox" not in name:
            paths.append((int(digits), os.path.join(folder, name)))
    return sorted(paths)


def find_clusters(phi, phi_vx, phi_vz):
    """One row a cluster: x, z, area, holdup, holdup_max, velocity_x, velocity_z, major, minor, angle."""
    labels, count = ndimage.label(phi > THRESHOLD, structure=np.ones((3, 3)))
    if count == 0:
        return []
    i, k = np.nonzero(labels)
    label = labels[i, k]
    inside = phi[i, k]

    def total(weights):
        return np.bincount(label, weights, count + 1)[1:]

    cells = np.bincount(label, minlength=count + 1)[1:]
    peak = ndimage.maximum(phi, labels, np.arange(1, count + 1))
    solids = total(inside)
    x, z = total(X[i]) / cells, total(Z[k]) / cells
    xx = total((X[i] - x[label - 1]) ** 2) / cells + DX**2 / 12
    zz = total((Z[k] - z[label - 1]) ** 2) / cells + DZ**2 / 12
    xz = total((X[i] - x[label - 1]) * (Z[k] - z[label - 1])) / cells
    root = np.sqrt((xx - zz) ** 2 / 4 + xz**2)
    major = 4 * np.sqrt((xx + zz) / 2 + root)
    minor = 4 * np.sqrt(np.maximum((xx + zz) / 2 - root, 0))
    angle = 0.5 * np.arctan2(2 * xz, xx - zz)
    rows = np.column_stack(
        (x, z, cells * DX * DZ, solids / cells, peak, total(phi_vx[i, k]) / solids, total(phi_vz[i, k]) / solids,
         major, minor, angle))
    return rows[(rows[:, 2] >= MIN_AREA) & (peak > CORE)]


class Products:
    """Accumulates snapshots; write() leaves the tables in a folder."""

    def __init__(self):
        self.phi = np.zeros(CELLS)
        self.phi_vx = np.zeros(CELLS)
        self.phi_vz = np.zeros(CELLS)
        self.snapshots = 0
        self.inventory, self.occurrence, self.clusters = [], [], []

    def add(self, step, x, z, vx, vz, radius):
        volume = 4 / 3 * np.pi * radius**3
        grid = dict(bins=CELLS, range=((X_MIN, X_MAX), (Z_MIN, Z_MAX)))
        phi = np.histogram2d(x, z, weights=volume, **grid)[0] / CELL_VOLUME
        phi_vx = np.histogram2d(x, z, weights=volume * vx, **grid)[0] / CELL_VOLUME
        phi_vz = np.histogram2d(x, z, weights=volume * vz, **grid)[0] / CELL_VOLUME
        self.phi += phi
        self.phi_vx += phi_vx
        self.phi_vz += phi_vz
        self.snapshots += 1

        time = step * TIME_STEP
        rows = find_clusters(phi, phi_vx, phi_vz)
        self.clusters += [(time, n + 1, *row) for n, row in enumerate(rows)]
        area = sum(row[2] for row in rows)
        self.occurrence.append((time, len(rows), area / (DX * DZ * phi.size)))
        self.inventory.append((time, len(x), DENSITY * volume.sum(), (volume * z).sum() / volume.sum()))

    def write(self, folder):
        phi, phi_vx, phi_vz = (f / self.snapshots for f in (self.phi, self.phi_vx, self.phi_vz))
        tables = os.path.join(folder, "tables")
        os.makedirs(tables, exist_ok=True)
        np.savez(os.path.join(folder, "fields.npz"), holdup=phi, mass_flux_x=DENSITY * phi_vx,
                 mass_flux_z=DENSITY * phi_vz)

        with np.errstate(invalid="ignore"):
            a, g = phi.mean(axis=0), phi_vz.mean(axis=0)
            axial = np.column_stack((Z, a, g / a, DENSITY * g))
            lateral = []
            for height in HEIGHTS:
                top = np.minimum(Z + DZ / 2, height + BAND / 2)
                overlap = np.maximum(top - np.maximum(Z - DZ / 2, height - BAND / 2), 0)
                a, g = phi @ overlap / overlap.sum(), phi_vz @ overlap / overlap.sum()
                lateral += zip(np.full(X.size, height), X, a, g / a, DENSITY * g)

        curve = ["holdup [-]", "velocity_z [m/s]", "mass_flux_z [kg/m2/s]"]
        table(tables, "axial_profile", ["z [m]"] + curve, axial)
        table(tables, "lateral_profile", ["height [m]", "x [m]"] + curve, lateral)
        table(tables, "inventory", ["time [s]", "particles", "solids_mass [kg]", "mean_height [m]"], self.inventory)
        table(tables, "cluster_occurrence", ["time [s]", "clusters", "area_fraction [-]"], self.occurrence)
        table(tables, "clusters",
              ["time [s]", "cluster", "x [m]", "z [m]", "area [m2]", "holdup [-]", "holdup_max [-]", "velocity_x [m/s]",
               "velocity_z [m/s]", "major [m]", "minor [m]", "angle [rad]"], self.clusters)


def table(folder, name, columns, rows):
    with open(os.path.join(folder, name + ".csv"), "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)


def main(read):
    """The program of a peer: `peer.py FOLDER OUT`, read(path) -> x, z, vx, vz, radius."""
    if len(sys.argv) != 3:
        sys.exit(f"usage: {os.path.basename(sys.argv[0])} FOLDER OUT")
    products = Products()
    for step, path in snapshot_paths(sys.argv[1]):
        products.add(step, *read(path))
    products.write(sys.argv[2])
