# SPDX-License-Identifier: BSD-3-Clause
"""A sphere in rising gas, after 3 s, by each of four drag laws: its slip velocity.

Expected: the slip at which the drag law (written down a second time in tests/coupled/laws.py) carries the
weight less buoyancy; of Wen and Yu's and Gidaspow's law also Schiller and Naumann's terminal velocity.
"""
import math

from deck import Case
from laws import LAWS, terminal_velocity

TITLE = "Terminal velocity by four drag laws"
D, RHO, GAS, MU = 0.85e-3, 2500.0, 1.2, 1.8e-5
SIZE, CELLS = (0.15, 0.15, 0.5), (3, 3, 10)


def verify(study):
    voidage = 1 - math.pi / 6 * D**3 / math.prod(s / n for s, n in zip(SIZE, CELLS))
    lone = {"diameter": D, "particle_density": RHO, "gas_density": GAS, "gas_viscosity": MU, "gravity": 9.81}
    for name, law in LAWS.items():
        terminal = terminal_velocity(law, voidage, D, RHO, GAS, MU)
        case = Case(study.folder / name, SIZE, CELLS, velocity=terminal, drag=name, dt=1e-2, dem_steps=5, end=3.0,
                    spheres=[(1, D, RHO, 0.075, 0.075, 0.25, 0, 0, 0.1)], dump_every=1500).write()
        case.run()
        study.series(name, slip=("m/s", [(3.0, terminal - case.dump(1500)[1]["vz"])]))
        # F / (rho U A), by which the sphere slows the gas of its cell
        slowed = RHO * math.pi / 6 * D**3 * 9.81 / (GAS * terminal * (SIZE[0] / CELLS[0]) ** 2)
        study.check(name, "series: slip", terminal, "max error", 2 * slowed, f"""
            The sphere slows the gas of its own cell by F / (rho U A) = {slowed:.1e} m/s; twice that.""")
        if name in ("wen_yu", "gidaspow"):
            study.check(name, "series: slip", "theory:terminal velocity", "max error", 2 * slowed + 1e-3 * terminal, """
                The same, and 0.1 %: the law's factor eps^-3.65 at the voidage of the cell is not quite 1, and
                Schiller and Naumann's sphere falls in gas without bounds.""", **{"with": lone})
