# SPDX-License-Identifier: BSD-3-Clause
"""cases/reduce_run.py on a short riser: what is kept are the tables that were asked for, and a flux that adds up."""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tomllib
import unittest

from support import folder

ROOT = pathlib.Path(__file__).resolve().parents[2]
BEDSCOPE, COUPLED = os.environ["BEDSCOPE"], os.environ["BEDSCOPE_COUPLED"]


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class ReduceRun(unittest.TestCase):
    def setUp(self):
        self.base = folder(self, "")
        self.base.mkdir(exist_ok=True)
        scene = self.base / "short.toml"
        scene.write_text(f'base = "{ROOT}/cases/tradeoff/scene.toml"\nscale.factor = 4\n'
                         "numerics.end = 0.5\nnumerics.average_from = 0.2\n")
        self.case = self.base / "case"
        self.call(BEDSCOPE, "case", "make", scene, "-o", self.case, "--quiet")

    def call(self, *words, code=0, **more):
        done = subprocess.run([str(w) for w in words], text=True, capture_output=True, **more)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def run_case(self):
        path = os.path.dirname(COUPLED) + os.pathsep + os.environ["PATH"]
        self.call("./run.sh", cwd=self.case, env=dict(os.environ, PATH=path, OMPI_ALLOW_RUN_AS_ROOT="1",
                                                      OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1"))

    def reduce(self, *words, code=0):
        kept = self.base / "short_riser"
        done = self.call(sys.executable, ROOT / "cases/reduce_run.py", self.case, kept, "--bedscope", BEDSCOPE, *words, code=code)
        return kept, done

    def test_heights_and_the_flux_that_the_solver_counted(self):
        self.run_case()
        kept, _ = self.reduce("--heights", "0.1,0.3")
        self.assertEqual({float(r["height [m]"]) for r in table(kept / "tables/lateral_profile.csv")}, {0.1, 0.3})
        scene = tomllib.loads((kept / "scene.toml").read_text())
        area = scene["geometry"]["width"] * scene["geometry"]["depth"]
        history = table(self.case / "history.csv")
        flux, gone, begin = table(kept / "tables/series.csv"), 0.0, 0.0
        for row in flux:
            self.assertEqual((row["run"], row["series"], row["unit"]), ("short riser", "solids flux", "kg/m2/s"))
            time = float(row["time [s]"])
            gone += float(row["value"]) * area * (time - begin)
            begin = time
        left = next(float(r["left [kg]"]) for r in history if float(r["time [s]"]) == begin)
        print(f"{len(flux)} intervals to {begin} s, {gone:.6g} kg of {left:.6g} kg")
        self.assertGreater(left, 0)
        self.assertAlmostEqual(gone / left, 1, delta=1e-5)  # the table has six digits
        self.assertAlmostEqual(begin, 0.5, delta=0.1)
        study = tomllib.loads((kept / "study.toml").read_text())
        self.assertEqual([r["average"] for r in study["run"]], [{"from": 0.2, "to": 0.5}])
        self.assertEqual(json.loads((kept / "run.json").read_text())["state"], "done")

    def test_a_run_that_is_not_done_is_one_clear_line(self):
        (self.case / "run.json").write_text('{"state": "running"}')
        kept, done = self.reduce(code=1)
        self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assertIn('expected state "done", found "running"', done.stderr)
        self.assertFalse(kept.exists())


if __name__ == "__main__":
    unittest.main()
