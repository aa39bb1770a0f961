# SPDX-License-Identifier: BSD-3-Clause
"""Who enters a deck of `bedscope case make` moves and is dumped like those that were there from the start."""
import os
import pathlib
import subprocess
import unittest

from support import folder

BEDSCOPE, SOLVER = os.environ["BEDSCOPE"], os.environ["BEDSCOPE_COUPLED"]
SCENE = """title = "A short riser"
[geometry]
width = 0.02
depth = 0.006
height = 0.06
[gas]
density = 1.2
viscosity = 3.6e-5
velocity = 9.0
[[species]]
diameter = 1.7e-3
density = 2500
[particles]
number = 60
arrangement = "uniform"
[contact]
normal_stiffness = 1000
restitution = 0.9
friction = 0.1
[inlet]
particles = "%s"
%s
[outlet]
place = "top"
[numerics]
grid = [5, 2, 16]
dem_step = 1e-5
gas_step = 2e-4
output = 0.05
end = 0.3
"""


def snapshot(path):
    lines = path.read_text().splitlines()
    names = lines[8].split()[2:]
    return [dict(zip(names, map(float, line.split()))) for line in lines[9:]]


class Entering(unittest.TestCase):
    def run_scene(self, particles, more=""):
        base = folder(self)
        base.mkdir(parents=True)
        (base / "scene.toml").write_text(SCENE % (particles, more))
        subprocess.run([BEDSCOPE, "case", "make", base / "scene.toml", "-o", base / "case", "--quiet", "--force"], check=True,
                       stderr=subprocess.DEVNULL)
        environment = {"WM_PROJECT_DIR": "/usr/share/openfoam"} | os.environ
        for command in (["blockMesh", "-case", "CFD"], [SOLVER]):
            subprocess.run(command, cwd=base / "case", check=True, env=environment, stdout=subprocess.DEVNULL)
        return base / "case"

    def expect_moving(self, case, count):
        dumps = sorted((case / "DEM/post").glob("dump*.liggghts_run"), key=lambda p: int("".join(filter(str.isdigit, p.stem))))
        entered = 0
        for dump in dumps[1:]:
            rows = snapshot(dump)
            entered += sum(row["id"] > 60 for row in rows)
            at_rest = [row for row in rows if row["vz"] == 0]
            # Who entered less than a look (5 gas steps) ago may not have moved yet.
            self.assertLess(len(at_rest), 0.05 * len(rows) + 3, dump)
            if count:
                self.assertEqual(len(rows), count, dump)
        self.assertGreater(entered, 100)

    def test_an_inventory_that_is_held_is_held_in_the_dumps(self):
        self.expect_moving(self.run_scene("inventory"), 60)

    def test_a_feed_is_dumped(self):
        case = self.run_scene("feed", "flux = 20\nvelocity = [0, 0, 0.5]")
        self.expect_moving(case, None)
        history = (case / "history.csv").read_text().splitlines()
        names = history[0].split(",")
        column = next(k for k, name in enumerate(names) if name.startswith("particles"))
        last = sorted((case / "DEM/post").glob("dump*.liggghts_run"), key=lambda p: int("".join(filter(str.isdigit, p.stem))))[-1]
        self.assertEqual(len(snapshot(last)), int(float(history[-1].split(",")[column])))

    def test_the_log_tells_the_step_to_who_reads_the_dumps(self):
        case = self.run_scene("inventory")
        report = subprocess.run([BEDSCOPE, "info", "DEM/post", "--json"], cwd=case, capture_output=True, text=True, check=True).stdout
        self.assertIn('"times"', report)
        self.assertIn("timestep", (case / "DEM/log.liggghts").read_text())


if __name__ == "__main__":
    unittest.main()
