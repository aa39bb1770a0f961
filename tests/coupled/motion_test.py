# SPDX-License-Identifier: BSD-3-Clause
"""Terminal velocity by each drag law, and restitution of the contacts."""
import math
import unittest

from deck import Case, RISER
from laws import LAWS, terminal_velocity
from support import folder

D, RHO, GAS, MU = 0.85e-3, 2500.0, 1.2, 1.8e-5


class Terminal(unittest.TestCase):
    def test_a_sphere_settles_to_the_terminal_velocity_of_the_law(self):
        size, cells = (0.15, 0.15, 0.5), (3, 3, 10)
        voidage = 1 - math.pi / 6 * D**3 / math.prod(s / n for s, n in zip(size, cells))
        for name, law in LAWS.items():
            terminal = terminal_velocity(law, voidage, D, RHO, GAS, MU)
            case = Case(folder(self, name), size, cells, velocity=terminal, drag=name, dt=1e-2, dem_steps=5,
                        end=3.0, spheres=[(1, D, RHO, 0.075, 0.075, 0.25, 0, 0, 0.1)], dump_every=1500).write()
            case.run()
            slip = terminal - case.dump(1500)[1]["vz"]
            print(f"{name}: slip {slip:.4f} m/s, terminal velocity {terminal:.4f} m/s")
            # The gas of the sphere's cell is slowed by F / (rho U A) = 5e-4 m/s.
            self.assertAlmostEqual(slip, terminal, delta=1e-3)


class Restitution(unittest.TestCase):
    def test_restitution_is_that_of_the_deck_within_the_error_of_the_step(self):
        contact = math.pi * math.sqrt(RHO * math.pi / 6 * D**3 / 2 / RISER["kn"])
        for steps, tolerance, gas_steps in ((5, 0.03, 3), (20, 0.003, 12)):
            h = contact / steps
            case = Case(folder(self, str(steps)), (0.012, 0.012, 0.012), (2, 2, 2), drag="none", gravity=0.0,
                        closed=True, side_walls="slip", dt=100 * h, dem_steps=100, end=100 * h * gas_steps, dump_every=100 * gas_steps,
                        spheres=[(1, D, RHO, 0.004, 0.004, 0.004, 1.0, 0, 0), (1, D, RHO, 0.0052, 0.004, 0.004),
                                 (1, D, RHO, 0.006, 0.009, D / 2 + 2e-4, 0, 0, -1.0)]).write()
            case.run()
            rows = case.dump(100 * gas_steps)
            pair = rows[2]["vx"] - rows[1]["vx"]
            wall = rows[3]["vz"]
            print(f"{steps} steps a contact: e {pair:.4f} (0.96), wall {wall:.4f} (0.86)")
            self.assertAlmostEqual(pair, RISER["restitution"], delta=tolerance)
            self.assertAlmostEqual(wall, RISER["wall_restitution"], delta=2 * tolerance)


if __name__ == "__main__":
    unittest.main()
