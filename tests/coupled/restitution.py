# SPDX-License-Identifier: BSD-3-Clause
"""A pair of spheres and a sphere on a wall collide head-on at 1 m/s, at 5, 10 and 20 steps a contact.

Expected: the ratio of speeds that velocity Verlet gives to a linear spring and dashpot from the same gap
(tests/coupled/laws.py). It is not the restitution e of the deck: it depends on where in a time step the
contact begins, at 5 steps from e - 2 % to e + 3.5 %, at 20 within 0.5 %; its mean over all beginnings is e.
"""
import math

from deck import RISER, Case
from laws import rebound

TITLE = "Restitution for the steps used"
D, RHO = 0.85e-3, 2500.0
MASS = RHO * math.pi / 6 * D**3
CONTACT = math.pi * math.sqrt(MASS / 2 / RISER["kn"])  # of a pair [s]


def impacts(at, steps, gas_steps, gap):
    h = CONTACT / steps
    case = Case(at, (0.012, 0.012, 0.012), (2, 2, 2), drag="none", gravity=0.0, closed=True, dt=100 * h,
                dem_steps=100, end=100 * h * gas_steps, dump_every=100 * gas_steps,
                spheres=[(1, D, RHO, 0.004, 0.004, 0.004, 1.0, 0, 0), (1, D, RHO, 0.004 + D + gap, 0.004, 0.004),
                         (1, D, RHO, 0.006, 0.009, D / 2 + gap, 0, 0, -1.0)]).write()
    case.run()
    rows = case.dump(100 * gas_steps)
    return rows[2]["vx"] - rows[1]["vx"], rows[3]["vz"]


def verify(study):
    gap = 2e-4
    for steps, gas_steps in ((5, 1), (10, 2), (20, 4)):
        h, label = CONTACT / steps, f"{steps} steps"
        pair, wall = impacts(study.folder / f"{steps}_steps_case", steps, max(3, 3 * gas_steps), gap)
        study.series(label, pair=("-", [(0.0, pair)]), wall=("-", [(0.0, wall)]))
        for name, e, mass in (("pair", RISER["restitution"], MASS / 2), ("wall", RISER["wall_restitution"], MASS)):
            study.check(label, f"series: {name}", rebound(RISER["kn"], mass, e, 1.0, gap, h), "max error", 5e-6, """
                The same arithmetic. What is left is the pressure of the gas that the spheres push aside: gas of a
                density ratio of 5e-4 at 1.5e-3 of their speed, the share of a cell that they fill: some 1e-6.""")
            if steps == 20:
                study.check(label, f"series: {name}", e, "max error", 0.01, """
                    By rebound() the beginning of the contact in the step changes it by up to 0.0085 at 20 steps.""")
