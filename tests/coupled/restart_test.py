# SPDX-License-Identifier: BSD-3-Clause
"""A run that is resumed, or on two ranks, is the run that went on, or on one."""
import unittest

import packed_bed_test
from deck import Case
from fluidisation_test import loose_bed
from support import folder

LIFT = """inventory { policy constant; outlet { point (0 0 0.02); normal (0 0 1); }
entry { min (0 0 0.001); max (0.00552 0.00552 0.02); } every 2; }
output { checkpoint 0.02; }"""


def bed(at, end):
    spheres = [s + (0, 0, 0.2) for s in loose_bed(6, 6, 8)]
    return Case(at, (0.00552, 0.00552, 0.03), (3, 3, 15), velocity=3.0, dt=2e-4, dem_steps=20, end=end,
                spheres=spheres, extra=LIFT, dump_every=1000, write_interval=0.02, margin=0.01, tolerance=1e-8).write()


def contents(case):
    """All that the run wrote after t = 0.02 s, but its costs."""
    files = {str(p.relative_to(case.folder)): p.read_bytes() for p in sorted(case.folder.rglob("*"))
             if p.is_file() and (p.parent.name == "0.04" or p.name in ("dump3000.liggghts", "dump4000.liggghts",
                                                                      "history.csv", "gas.0"))}
    return files


class Restart(unittest.TestCase):
    def test_a_resumed_run_equals_the_one_that_went_on_to_the_bit(self):
        base = folder(self)
        whole = bed(base / "whole", 0.04)
        whole.run()
        cut = bed(base / "cut", 0.02)
        cut.run()
        control = cut.folder / "CFD/system/controlDict"
        control.write_text(control.read_text().replace("endTime 0.02;", "endTime 0.04;"))
        cut.run("--resume")
        one, other = contents(whole), contents(cut)
        self.assertEqual(list(one), list(other))
        self.assertGreater(len(one), 6)
        for name in one:
            self.assertEqual(one[name], other[name], name)
        inventory = whole.record()["inventory"]
        print("left and put back", inventory["left"], "identical files", len(one))
        self.assertGreater(inventory["left"], 10)  # the policy was at work
        self.assertEqual(whole.history()[-1]["particles"], 288)


class TwoRanks(unittest.TestCase):
    def test_pressure_drop_of_a_fixed_bed_is_that_of_one_rank(self):
        serial = packed_bed_test.case(folder(self, "serial"), 0.45)
        serial.run()
        expected = serial.history()[-1]["pressure_drop"]
        for cut in ("(2 1 1)", "(1 1 2)"):  # through the bed, along and across LIGGGHTS' own cut
            pair = packed_bed_test.case(folder(self, "pair"), 0.45)
            choice = pair.folder / "CFD/system/decomposeParDict"
            choice.write_text(choice.read_text().replace("(1 1 2)", cut))
            pair.run(ranks=2)
            found = pair.history()[-1]["pressure_drop"]
            print(f"cut {cut}: {found:.6f} Pa, one rank {expected:.6f} Pa, {found / expected - 1:+.1e}")
            self.assertAlmostEqual(found / expected, 1, delta=1e-4)
            self.assertLess(pair.record()["conservation"]["momentum_exchange_worst"], 1e-12)


if __name__ == "__main__":
    unittest.main()
