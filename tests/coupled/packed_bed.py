# SPDX-License-Identifier: BSD-3-Clause
"""Gas through a bed at rest: a shaken cubic lattice with 3 % of its places empty, once from the inlet to the outlet,
once with gas alone before and behind it.

Expected: Beetstra's law summed over the gas cells of each column, at each cell's voidage and velocity; and
that the pressure carries the force which LIGGGHTS' particles got.
"""
import random

from deck import Case
from laws import pressure_gradient

TITLE = "Pressure drop of a packed bed against Beetstra's law summed over cells"
D, RHO = 0.85e-3, 2500.0
SPACING, ACROSS, LAYERS = 0.89e-3, 12, 24
WIDTH = SPACING * ACROSS
EDGE, ROWS = WIDTH / 4, 8  # of the gas cells, three spheres each way in one; rows of cells in the bed


def bed(below=0):
    """Above so many rows of cells."""
    rng = random.Random(3)
    shaken = lambda n: (n + 0.5) * SPACING + rng.uniform(-1, 1) * 0.02e-3
    return [(1, D, RHO, shaken(i), shaken(j), shaken(k) + below * EDGE)
            for k in range(LAYERS) for j in range(ACROSS) for i in range(ACROSS) if rng.random() > 0.03]


def case(at, velocity, around=0, **options):
    """With so many rows of gas alone before and behind the bed."""
    cells = (4, 4, ROWS + 2 * around)
    options = dict(dt=2e-4, end=0.02) | options
    return Case(at, (WIDTH, WIDTH, cells[2] * EDGE), cells, velocity=velocity, dem_steps=1, spheres=bed(around),
                moving=False, walls=False, dump_every=100, **options).write()


def summed(case, time):
    """Mean over the columns of cells of the law's gradient at each cell's voidage and velocity."""
    total = 0.0
    for eps, u in zip(case.read_field(time, "voidfraction"), case.read_field(time, "U")):
        if eps < 1:
            total += pressure_gradient(eps, eps * u[2], D, case.gas["density"], case.gas["viscosity"])
    return total * EDGE / (case.cells[0] * case.cells[1])


def verify(study):
    for velocity, around in ((0.15, 0), (0.45, 0), (0.15, 4)):
        label = f"U {velocity}" + (", gas around" if around else "")
        one = case(study.folder / label.replace(" ", "_").replace(",", ""), velocity, around)
        one.run()
        drop = summed(one, 0.02)
        last = one.history()[-1]
        study.series(label, pressure_drop=("Pa", [(last["time"], last["pressure_drop"])]))
        study.check(label, "series: pressure drop", drop, "relative bias", 5e-3 if around else 2e-3, f"""
            0.2 %, as asked of the solver{'; and the dynamic pressure rho U^2 (1/eps^2 - 1) / 2 = 0.03 Pa at each end' if around else ''}.""")
        if not around:
            continue
        # Buoyancy is part of the force, not of the pressure drop, which is counted without rho g h.
        buoyancy = sum(one.gas["density"] * 9.81 * 3.14159265 / 6 * s[1] ** 3 for s in one.spheres)
        force = (last["drag_z"] + last["pressure_force_z"] - buoyancy) / WIDTH**2
        study.check(label, "series: pressure drop", force, "relative bias", 1e-3,
                    "Force on the particles over the cross-section; slip walls take nothing, and as much momentum leaves as came.")
