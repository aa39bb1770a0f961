# SPDX-License-Identifier: BSD-3-Clause
"""Dumps of a packed bed through which round voids of known size rise at known speed.

A lattice of spheres, shaken a little; what lies in a void is left out. Voids start below the floor,
one every 1/frequency in each column, and leave through the surface.
"""

import os

import numpy as np


class Bed:
    def __init__(self, seed=1, width=0.12, depth=0.006, height=0.2, domain_height=0.3, diameter=0.0015,
                 shake=0.1, splash=0):
        self.rng = np.random.default_rng(seed)
        self.size, self.height, self.diameter = (width, depth, domain_height), height, diameter
        n = [int(length / diameter) for length in (width, depth, height)]
        place = np.stack(np.meshgrid(*[np.arange(k) + 0.5 for k in n], indexing="ij"), -1).reshape(-1, 3)
        self.place = place * (np.array([width, depth, height]) / n)
        self.shake, self.splash = shake * diameter, splash  # particles above the bed

    def particles(self, voids):
        """Those outside of the voids, given as (x, z, diameter)."""
        place = self.place + self.shake * (self.rng.random(self.place.shape) - 0.5)
        keep = np.ones(len(place), bool)
        for x, z, diameter in voids:
            keep &= np.hypot(place[:, 0] - x, place[:, 2] - z) > diameter / 2
        width, depth, top = self.size
        above = self.rng.random((self.splash, 3)) * [width, depth, top - self.height]
        return np.concatenate([place[keep], above + [0, 0, self.height]])

    def write(self, path, step, voids):
        place = self.particles(voids)
        lines = ["ITEM: TIMESTEP", str(step), "ITEM: NUMBER OF ATOMS", str(len(place)),
                 "ITEM: BOX BOUNDS ff ff ff"]
        lines += ["0 %g" % length for length in self.size]
        lines.append("ITEM: ATOMS id type x y z vx vy vz radius ")
        lines += ["%d 1 %.6g %.6g %.6g 0 0 0 %g " % (i + 1, *row, self.diameter / 2)
                  for i, row in enumerate(place)]
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w") as file:
            file.write("\n".join(lines) + "\n")


def columns_of_voids(time, columns):
    """Voids at a time: each column (x, diameter, speed, frequency, phase), phase in periods."""
    found = []
    for x, diameter, speed, frequency, phase in columns:
        first = (time * frequency + phase) % 1 / frequency  # time since the last one started
        for k in range(100):
            z = speed * (first + k / frequency) - diameter / 2
            if z > 1:
                break
            found.append((x, z, diameter))
    return found


def write_run(folder, columns, snapshots=200, interval=0.02, time_step=1e-5, **bed):
    """The run's dumps in `folder`; voids come and go at the surface of the bed by themselves."""
    made = Bed(**bed)
    for k in range(snapshots):
        step = round(k * interval / time_step)
        made.write(f"{folder}/dump{step}.liggghts_run", step, columns_of_voids(k * interval, columns))
    return made
