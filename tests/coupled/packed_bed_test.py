# SPDX-License-Identifier: BSD-3-Clause
"""Pressure drop of a bed at rest against the drag law summed over the gas cells."""
import random
import unittest

from deck import Case
from laws import pressure_gradient
from support import folder

D, RHO = 0.85e-3, 2500.0
SPACING, ACROSS, LAYERS = 0.89e-3, 12, 24
WIDTH = SPACING * ACROSS
CELLS = (4, 4, 12)
SIZE = (WIDTH, WIDTH, CELLS[2] * WIDTH / 4)
GAS = dict(density=1.2, viscosity=1.8e-5)


def bed():
    """A cubic lattice, shaken, with a tenth of its places empty: voidage 0.51 to 0.64 by cell."""
    rng = random.Random(3)
    shaken = lambda n: (n + 0.5) * SPACING + rng.uniform(-1, 1) * 0.02e-3
    # One row of cells below stays empty: gas that entered between spheres would bring momentum along.
    return [(1, D, RHO, shaken(i), shaken(j), shaken(k) + WIDTH / 4)
            for k in range(LAYERS) for j in range(ACROSS) for i in range(ACROSS) if rng.random() > 0.1]


def case(at, velocity, **options):
    return Case(at, SIZE, CELLS, velocity=velocity, dt=2e-4, dem_steps=1, end=0.02, spheres=bed(),
                moving=False, walls=False, **options).write()


def summed(case, time):
    """Mean over the columns of cells of the law's gradient at each cell's voidage and velocity."""
    total = 0.0
    for eps, u in zip(case.read_field(time, "voidfraction"), case.read_field(time, "U")):
        if eps < 1:
            total += pressure_gradient(eps, eps * u[2], D, **{"gas_density": GAS["density"],
                                                             "viscosity": GAS["viscosity"]})
    return total * case.size[2] / case.cells[2] / (case.cells[0] * case.cells[1])


class PackedBed(unittest.TestCase):
    def test_pressure_drop_is_the_drag_law_summed_over_cells(self):
        for velocity in (0.15, 0.45):
            one = case(folder(self, f"u{velocity}"), velocity)
            one.run()
            found, expected = one.history()[-1]["pressure_drop"], summed(one, 0.02)
            print(f"U {velocity} m/s: {found:.2f} Pa, summed {expected:.2f} Pa, {found / expected - 1:+.2%}")
            self.assertLess(abs(found / expected - 1), 2e-3)

    def test_bed_force_is_what_the_pressure_carries(self):
        one = case(folder(self), 0.45)
        one.run()
        last = one.history()[-1]
        force = last["drag_z"] + last["pressure_force_z"]
        # Buoyancy is part of the pressure force, not of the pressure drop that is counted without rho g h.
        buoyancy = sum(GAS["density"] * 9.81 * 3.14159265 / 6 * s[1] ** 3 for s in one.spheres)
        self.assertAlmostEqual((force - buoyancy) / (last["pressure_drop"] * WIDTH**2), 1, delta=1e-3)


if __name__ == "__main__":
    unittest.main()
