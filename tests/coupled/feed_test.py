# SPDX-License-Identifier: BSD-3-Clause
"""Constant feed: the mass flow is held, of each species its share, and all of it is accounted for."""
import math
import unittest

from deck import Case
from support import folder

SMALL, LARGE, RHO = 0.8e-3, 1.0e-3, 2500.0
MASS = {1: RHO * math.pi / 6 * SMALL**3, 2: RHO * math.pi / 6 * LARGE**3}
FLOW = 2e-3  # kg/s


class Feed(unittest.TestCase):
    def test_two_sizes_enter_at_the_mass_flow_given_and_leave_at_the_top(self):
        end = 0.3
        case = Case(folder(self), (0.02, 0.02, 0.08), (4, 4, 16), velocity=9.0, dt=2e-4, dem_steps=20, end=end,
                    spheres=[(1, SMALL, RHO, 0.01, 0.01, 0.01), (2, LARGE, RHO, 0.01, 0.01, 0.02)], margin=0.03,
                    dump_every=6000, tolerance=1e-7, extra=f"""
inventory {{ policy fed; outlet {{ point (0 0 0.08); normal (0 0 1); }} massFlow {FLOW};
entry {{ min (0 0 0); max (0.02 0.02 0.01); velocity (0 0 0.5); }}
species ( {{ type 1; diameter {SMALL}; density {RHO}; fraction 0.4; }}
          {{ type 2; diameter {LARGE}; density {RHO}; fraction 0.6; }} ); }}
output {{ history 0.01; }}""").write()
        case.run()
        last, inventory = case.history()[-1], case.record()["inventory"]
        # Within the particle that is due next and those of the steps since the last look.
        self.assertAlmostEqual(inventory["mass_entered"], FLOW * end, delta=MASS[1] + MASS[2] + FLOW * 1e-3)
        self.assertAlmostEqual(inventory["mass_entered"] + inventory["mass_due"], FLOW * end, delta=1e-12)
        kept = MASS[1] + MASS[2] + inventory["mass_entered"] - inventory["mass_left"]
        self.assertAlmostEqual(last["solids_mass"], kept, delta=1e-12)
        self.assertGreater(inventory["left"], 50)
        rows = case.dump(30000).values()
        self.assertEqual(len(rows), last["particles"])
        here = sum(MASS[row["type"]] for row in rows)
        self.assertAlmostEqual(here, last["solids_mass"], delta=1e-12)
        print(f"entered {inventory['entered']}, left {inventory['left']}, mass {inventory['mass_entered']:.6g} kg "
              f"of {FLOW * end:.6g} kg")
        self.assertLess(case.record()["conservation"]["gas_worst_step"], 1e-6)

    def test_species_enter_by_their_share_of_the_mass(self):
        case = Case(folder(self), (0.02, 0.02, 0.4), (2, 2, 40), velocity=0.1, gravity=0.0, drag="none", dt=1e-3,
                    dem_steps=10, end=0.5, spheres=[(1, SMALL, RHO, 0.01, 0.01, 0.35), (2, LARGE, RHO, 0.01, 0.01, 0.37)],
                    dump_every=5000, margin=0.03, walls=True, tolerance=1e-6, extra="""
inventory { policy fed; outlet { point (0 0 1); normal (0 0 1); } massFlow 5e-3; every 1;
entry { min (0 0 0.001); max (0.02 0.02 0.03); velocity (0 0 0.5); }
species ( { type 1; diameter 0.8e-3; density 2500; fraction 0.4; } { type 2; diameter 1e-3; density 2500; fraction 0.6; } ); }
""").write()
        case.run()
        rows = case.dump(5000).values()
        masses = {t: sum(MASS[t] for row in rows if row["type"] == t) - MASS[t] for t in (1, 2)}
        share = masses[1] / (masses[1] + masses[2])
        print(f"{len(rows)} particles, mass share of the small ones {share:.3f}")
        self.assertAlmostEqual(share, 0.4, delta=2 * MASS[2] / (5e-3 * 0.5))  # a particle of each may be due


if __name__ == "__main__":
    unittest.main()
