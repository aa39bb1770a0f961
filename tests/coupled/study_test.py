# SPDX-License-Identifier: BSD-3-Clause
"""bedscope validate judges what bedscope-coupled wrote: dumps and time directories as any user has them."""
import json
import os
import subprocess
import unittest

import packed_bed_test
from support import folder

BEDSCOPE = os.environ.get("BEDSCOPE", "bedscope")


class Study(unittest.TestCase):
    def test_validate_finds_two_ranks_equal_to_one(self):
        base = folder(self)
        for ranks in (1, 2):
            case = packed_bed_test.case(base / str(ranks), 0.45, dump_every=100)
            case.run(ranks=ranks)
            if ranks > 1:
                case.shell("reconstructPar", "-case", "CFD", "-time", "0.02")
        x, y, z = packed_bed_test.SIZE
        runs = "".join(f"""
[[run]]
label = "{n} rank"
particles = "{n}/DEM/post/dump*.liggghts"
time_step = 2e-4
gas = "{n}/CFD"
decomposition = "reconstructed"
""" for n in (1, 2))
        (base / "study.toml").write_text(f"""
title = "A fixed bed on one rank and on two"
[scene]
domain = {{ min = [0, 0, 0], max = [{x}, {y}, {z}] }}
up = "z"
lateral = "x"
cells = [4, 12]
density = 2500
gas_density = 1.2
average = {{ from = 0.02, to = 0.02 }}
{runs}
[[check]]
quantity = "pressure drop"
run = "2 rank"
against = "run:1 rank"
metric = "relative bias"
limit = 1e-4
""")
        done = subprocess.run([BEDSCOPE, "validate", "study.toml", "-o", "out"], cwd=base, text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stdout[-800:] + done.stderr[-800:])
        verdict = json.loads((base / "out/summary.json").read_text())["checks"][0]
        print(verdict)
        self.assertEqual(verdict["verdict"], "holds")


if __name__ == "__main__":
    unittest.main()
