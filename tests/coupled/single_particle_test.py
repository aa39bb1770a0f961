# SPDX-License-Identifier: BSD-3-Clause
"""One sphere in a uniform gas stream against its equation of motion."""
import math
import unittest

from deck import Case
from laws import beetstra
from support import folder

D, RHO, U, G, GAS, MU = 0.85e-3, 2500.0, 5.0, 9.81, 1.2, 1.8e-5
SIZE, CELLS = (0.15, 0.15, 0.5), (3, 3, 10)


def acceleration(v, voidage):
    slip = U / voidage - v
    re = voidage * GAS * abs(slip) * D / MU
    mass = RHO * math.pi / 6 * D**3
    drag = 3 * math.pi * MU * D * voidage * beetstra(voidage, re) * slip
    return drag / mass - G * (1 - GAS / RHO)


class SingleParticle(unittest.TestCase):
    def test_velocity_follows_the_equation_of_motion(self):
        dt, steps, end = 2e-3, 20, 0.6
        case = Case(folder(self), SIZE, CELLS, velocity=U, dt=dt, dem_steps=steps, end=end,
                    spheres=[(1, D, RHO, 0.075, 0.075, 0.1)], dump_every=steps).write()
        case.run()
        voidage = 1 - math.pi / 6 * D**3 / math.prod(s / n for s, n in zip(SIZE, CELLS))
        v, fine, worst = 0.0, 100, 0.0
        for n in range(1, round(end / dt) + 1):
            for _ in range(fine):  # midpoint rule
                half = v + acceleration(v, voidage) * dt / fine / 2
                v += acceleration(half, voidage) * dt / fine
            row = case.dump(n * steps)[1]
            worst = max(worst, abs(row["vz"] - v))
            self.assertLess(abs(row["vx"]), 1e-5)
        # The sphere slows the gas of its cell by F / (rho U A) = 5e-4 m/s.
        self.assertLess(worst, 8e-4)
        record = case.record()["conservation"]
        self.assertLess(record["momentum_exchange_worst"], 1e-12)
        self.assertLess(record["gas_worst_step"], 1e-9)
        print(f"worst dv {worst:.2e} m/s, slip {U - row['vz']:.4f}, by the equation {U - v:.4f}")


if __name__ == "__main__":
    unittest.main()
