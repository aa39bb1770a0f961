# SPDX-License-Identifier: BSD-3-Clause
"""Voids of known size and speed, and pressure probes of known frequency, through the whole program.

Usage: bubbling_test.py BEDSCOPE
"""

import csv
import json
import os
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy as np

    import bubbling_bed
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)

BEDSCOPE = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 else "bedscope"
STUDY = """
[scene]
domain = {{ min = [0, 0, 0], max = [0.08, 0.006, 0.25] }}
cell = [0.004, 0.004]
density = 2500
{scene}
average = {{ from = 0.2 }}
{sections}
[[run]]
label = "voids"
particles = "post/dump*"
time_step = 1e-5
{run}
"""


class Bubbling(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = cls.holder.name
        # Speeds that are no whole number of cells a snapshot: else each void has the same pixels.
        cls.diameter, cls.speed, cls.frequency = 0.024, 0.37, 4.3
        cls.bed = bubbling_bed.write_run(
            cls.folder + "/post", [(0.041, cls.diameter, cls.speed, cls.frequency, 0.1)],
            snapshots=220, interval=0.01, width=0.08, height=0.16, domain_height=0.25, diameter=0.002)

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def analyse(self, sections, scene="", run="", code=0):
        path = os.path.join(self.folder, "study.toml")
        with open(path, "w") as file:
            file.write(STUDY.format(sections=sections, scene=scene, run=run))
        out = os.path.join(self.folder, "out")
        done = subprocess.run([BEDSCOPE, "analyse", path, "-o", out, "--tables-only", "--quiet"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        if code:
            return done.stderr
        tables = {}
        for name in os.listdir(out + "/tables"):
            with open(f"{out}/tables/{name}") as file:
                tables[name[:-4]] = list(csv.DictReader(file))
        with open(out + "/summary.json") as file:
            return tables, json.load(file)["runs"][0]

    def probes(self, name, header, rows):
        os.makedirs(os.path.join(self.folder, os.path.dirname(name)), exist_ok=True)
        with open(os.path.join(self.folder, name), "w") as file:
            file.write(header + "".join(rows))

    def test_size_speed_and_frequency_are_those_of_the_voids(self):
        tables, summary = self.analyse("[bubbles]\n")
        self.assertNotIn("spectrum", tables)
        rows = [{k: float(v) for k, v in row.items() if k != "run"} for row in tables["bubble_profile"]]
        middle = [r for r in rows if 0.04 < r["height [m]"] < 0.13]
        self.assertGreater(len(middle), 5)
        for r in middle:
            # The boundary is where 2/3 of a cell are void: the diameter is a third of a cell less.
            self.assertAlmostEqual(r["diameter [m]"], self.diameter - 0.004 / 3, delta=0.0012)
            # A centroid of pixels moves by some 0.5 mm too much or too little, 0.05 m/s.
            self.assertAlmostEqual(r["velocity_z [m/s]"], self.speed, delta=0.06 * self.speed)
            self.assertAlmostEqual(r["frequency [1/s]"], self.frequency, delta=0.5)  # +-1 in 2 s
        mean = np.mean([r["velocity_z [m/s]"] for r in middle])
        self.assertAlmostEqual(mean, self.speed, delta=0.02 * self.speed)
        for b in tables["bubbles"]:
            self.assertAlmostEqual(float(b["x [m]"]), 0.041, delta=0.002)  # half a cell
            self.assertLess(float(b["z [m]"]), 0.16)
        velocity = [float(b["velocity_x [m/s]"]) for b in tables["bubbles"]]
        self.assertLess(abs(np.nanmean(velocity)), 0.01)
        # A new track each period, none lost on the way: 2 s of 4.3 Hz and those that are there.
        tracks = {b["track"] for b in tables["bubbles"]}
        self.assertLessEqual(abs(len(tracks) - 10), 1.5)
        self.assertAlmostEqual(summary["bubbles"]["mean_velocity"], self.speed, delta=0.1 * self.speed)

    def test_bed_height_is_that_of_the_lattice(self):
        tables, summary = self.analyse("[bed]\nheight_at_rest = 0.08\n")
        self.assertNotIn("bubbles", tables)
        self.assertIsNone(summary["bubbles"])
        for row in tables["bed_height"]:
            self.assertAlmostEqual(float(row["height_surface [m]"]), 0.16, delta=0.002)
            self.assertAlmostEqual(float(row["expansion [-]"]), float(row["height [m]"]) / 0.08, 9)
        self.assertAlmostEqual(summary["mean_bed_height"], 0.16, delta=0.002)
        self.assertAlmostEqual(summary["mean_bed_expansion"], 2, delta=0.03)

    def test_probes_of_two_starts_give_the_frequency_of_the_pressure(self):
        def row(t):
            p = 100 + 30 * np.sin(2 * np.pi * 7 * t) + 5 * np.sin(2 * np.pi * 23 * t)
            return f"  {t:.6g}   {p:.8g}   -1e+300\n"

        header = ("# Probe 0 (0.04 0.003 0.05)\n# Probe 1 (9 9 9)  # Not Found\n"
                  "#       Probe             0             1\n#        Time\n")
        self.probes("probes/0/p", header, [row(k * 1e-3) for k in range(1500)])
        self.probes("probes/1.2/p", header, [row(1.2 + k * 1e-3) for k in range(1, 1000)] + ["  2.3 1"])
        tables, summary = self.analyse("", scene="gas_density = 1.2", run='probes = "probes"')
        rows = {r["signal"]: r for r in tables["fluctuation"]}
        self.assertEqual(set(rows), {"mean height", "bed surface", "mean holdup",
                                     "p at (0.04 0.003 0.05) m"})
        p = rows["p at (0.04 0.003 0.05) m"]
        self.assertEqual(p["unit"], "Pa")
        self.assertEqual(p["samples"], "1991")  # 0.2 to 2.19 s, the window's end
        self.assertAlmostEqual(float(p["mean [unit]"]), 120, delta=0.5)
        self.assertAlmostEqual(float(p["std [unit]"]), 1.2 * np.sqrt((900 + 25) / 2), delta=0.2)
        self.assertAlmostEqual(float(p["dominant_frequency [Hz]"]), 7, delta=0.1)
        said = "\n".join(summary["problems"])
        self.assertIn("probe 1 at (9 9 9) is outside the mesh", said)
        self.assertIn("multiplied by gas_density", said)
        self.assertIn("last row is left out", said)
        spectrum = [r for r in tables["spectrum"] if r["unit"] == "Pa"]
        power = sum(float(r["psd [unit2/Hz]"]) for r in spectrum) * float(p["resolution [Hz]"])
        self.assertAlmostEqual(power, 1.44 * 462.5, delta=0.02 * 1.44 * 462.5)

    def test_results_do_not_depend_on_the_number_of_threads(self):
        self.analyse("[bubbles]\n[spectra]\n")
        found = []
        for threads in ("1", "3"):
            out = os.path.join(self.folder, "threads" + threads)
            subprocess.run([BEDSCOPE, "analyse", self.folder + "/study.toml", "-o", out, "--tables-only",
                            "--quiet", "--threads", threads], check=True)
            found.append({name: open(f"{out}/tables/{name}", "rb").read()
                          for name in os.listdir(out + "/tables")})
        self.assertIn("bubble_profile.csv", found[0])
        self.assertEqual(found[0], found[1])

    def test_what_is_wrong_is_one_line(self):
        self.probes("empty/note", "nothing\n", [])
        error = self.analyse("", run='probes = "empty"', code=2)
        self.assertIn("empty: expected tables of OpenFOAM's postProcessing, found none", error)
        self.assertEqual(error.count("\n"), 1)
        self.assertIn("voidages below 1", self.analyse("[bubbles]\nthreshold = 1.2\n", code=2))
        self.assertIn("nearest known one is bubbles.core", self.analyse("[bubbles]\ncor = 0.9\n", code=2))

    def test_tables_of_an_earlier_analysis_do_not_stay(self):
        self.assertIn("bubbles", self.analyse("[bubbles]\n[spectra]\n")[0])
        tables = self.analyse("")[0]
        for name in ("bubbles", "bubble_profile", "spectrum", "fluctuation"):
            self.assertNotIn(name, tables)
        self.assertIn("bed_height", tables)


if __name__ == "__main__":
    unittest.main()
