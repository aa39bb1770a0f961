# SPDX-License-Identifier: BSD-3-Clause
"""A fluidised bed carries its weight; what flows in flows out."""
import random
import unittest

from deck import Case
from support import folder

D, RHO = 0.85e-3, 2500.0


def loose_bed(across, deep, layers, spacing=0.92e-3, seed=1):
    rng = random.Random(seed)
    at = lambda n: (n + 0.5) * spacing + rng.uniform(-1, 1) * 0.03e-3
    return [(1, D, RHO, at(i), at(j), at(k)) for k in range(layers) for j in range(deep) for i in range(across)]


class Fluidisation(unittest.TestCase):
    def test_pressure_drop_of_a_fluidised_bed_is_its_weight_over_the_area(self):
        across, deep, layers = 12, 6, 20
        width, depth = across * 0.92e-3, deep * 0.92e-3
        case = Case(folder(self), (width, depth, 0.06), (4, 2, 20), velocity=0.75, dt=2e-4, dem_steps=20, end=0.6,
                    spheres=loose_bed(across, deep, layers), tolerance=1e-8).write()
        case.run()
        rows = [row for row in case.history() if row["time"] > 0.2]
        weight = rows[0]["solids_mass"] * 9.81 * (1 - 1.2 / RHO) / (width * depth)
        drop = sum(row["pressure_drop"] for row in rows) / len(rows)
        heights = [row["mean_height"] for row in rows]
        record = case.record()["conservation"]
        print(f"pressure drop {drop:.1f} Pa, weight less buoyancy over area {weight:.1f} Pa, {drop / weight - 1:+.2%}; "
              f"gas kept to {record['gas_worst_step']:.1e}, momentum to {record['momentum_exchange_worst']:.1e}")
        self.assertGreater(max(heights), 1.05 * heights[0])  # it moves
        # Bubbles make it swing; the mean of 0.4 s holds the weight within 3 %.
        self.assertAlmostEqual(drop / weight, 1, delta=0.03)
        self.assertLess(record["gas_worst_step"], 1e-7)
        self.assertLess(abs(record["gas_in"] - record["gas_out"] - record["gas_stored"]) / record["gas_in"], 1e-7)
        self.assertLess(record["momentum_exchange_worst"], 1e-11)


if __name__ == "__main__":
    unittest.main()
