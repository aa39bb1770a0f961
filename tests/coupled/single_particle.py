# SPDX-License-Identifier: BSD-3-Clause
"""One sphere that a gas stream of 5 m/s takes along, from rest, for 0.6 s.

Expected: the solution of m dv/dt = K (U/eps - v) - (m - rho V) g, by the midpoint rule with 100 steps
in each gas step, eps being the voidage of the sphere's cell.
"""
import math

from deck import Case
from laws import beetstra

TITLE = "Single particle against its equation of motion"
D, RHO, U, G, GAS, MU = 0.85e-3, 2500.0, 5.0, 9.81, 1.2, 1.8e-5
SIZE, CELLS = (0.15, 0.15, 0.5), (3, 3, 10)
VOIDAGE = 1 - math.pi / 6 * D**3 / math.prod(s / n for s, n in zip(SIZE, CELLS))
MASS = RHO * math.pi / 6 * D**3
# What the drag of the weight takes from the velocity of the gas in the sphere's column of cells.
SLOWED = MASS * G / (GAS * U * (SIZE[0] / CELLS[0]) ** 2)


def acceleration(v):
    slip = U / VOIDAGE - v
    drag = 3 * math.pi * MU * D * VOIDAGE * beetstra(VOIDAGE, VOIDAGE * GAS * abs(slip) * D / MU) * slip
    return drag / MASS - G * (1 - GAS / RHO)


def trajectory(dt, count, fine=100):
    v, rows = 0.0, []
    for n in range(1, count + 1):
        for _ in range(fine):
            half = v + acceleration(v) * dt / fine / 2
            v += acceleration(half) * dt / fine
        rows.append((n * dt, v))
    return rows


def verify(study):
    dt, steps, end = 2e-3, 20, 0.6
    case = Case(study.folder / "case", SIZE, CELLS, velocity=U, dt=dt, dem_steps=steps, end=end,
                spheres=[(1, D, RHO, 0.075, 0.075, 0.1)], dump_every=steps).write()
    case.run()
    expected = trajectory(dt, round(end / dt))
    rows = [case.dump(n * steps)[1] for n in range(1, len(expected) + 1)]
    times = [t for t, _ in expected]
    study.series("sphere", velocity=("m/s", list(zip(times, (r["vz"] for r in rows)))),
                 sideways_velocity=("m/s", list(zip(times, (r["vx"] for r in rows)))))
    study.curve("velocity", "time [s],velocity [m/s]", expected)
    study.check("sphere", "series: velocity history", "velocity", "max error", 2 * SLOWED, f"""
        The sphere slows the gas of its own cell, which the equation does not know, by F / (rho U A) = {SLOWED:.1e} m/s;
        twice that leaves as much again for the forces that are held during a gas step.""")
    study.check("sphere", "series: sideways velocity history", 0.0, "max error", 1e-5,
                "Nothing pushes it sideways but the tolerance of the gas' solver.")
