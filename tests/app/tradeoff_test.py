#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""`bedscope tradeoff` on runs made so that the answer is known, and `products` in a study.

Usage: tradeoff_test.py BEDSCOPE [unittest arguments]. Exit code 77: numpy is missing.
"""
import csv
import json
import os
import sys
import unittest

try:
    import numpy as np
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)

from running import Running

STUDY = """\
# my study: cells are small
title = "Constructed"

[scene]
domain  = {{ min = [0, 0, 0], max = [0.08, 0.01, 0.32] }}   # m
cell    = [0.01, 0.01]
density = 2500.0                                          # glass
average = {{ from = {first}, to = {last} }}
mapping = "{mapping}"

[profiles]
heights = [0.1, 0.2]

[tradeoff]
{tradeoff}

[[run]]
label     = "a"
particles = "post/dump*.liggghts"
time_step = 0.001
"""


class Runs(Running):
    def dump(self, step, rows, columns="id type x y z vx vy vz radius", words=None):
        os.makedirs(self.at("post"), exist_ok=True)
        with open(self.at("post", f"dump{step}.liggghts"), "w") as file:
            file.write(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(rows)}\n"
                       "ITEM: BOX BOUNDS ff ff ff\n0 0.08\n0 0.01\n0 0.32\n"
                       f"ITEM: ATOMS {columns}\n")
            for i, (x, y, z, vz) in enumerate(rows):
                own, kind, vx = words or (i + 1, 1, 0.125)
                file.write(f"{own} {kind} {x:.6g} {y:.6g} {z:.6g} {vx} 0 {vz:.6g} 0.002\n")

    def series(self, states, seed=1):
        """Snapshot k holds `states[k]` = (number of particles, seed): equal states, equal snapshots."""
        for k, (count, own) in enumerate(states):
            random = np.random.default_rng([seed, own])
            at = random.uniform([0.003, 0.003, 0.003], [0.077, 0.007, 0.317], (count, 3))
            self.dump(10 * k, np.column_stack([at, random.normal(1, 0.2, count)]))
        return len(states)

    def study(self, snapshots, tradeoff="tolerance = 0.02", mapping="exact", change=None, name="study.toml",
              first=0.0):
        text = STUDY.format(first=first, last=0.01 * (snapshots - 1), tradeoff=tradeoff, mapping=mapping)
        with open(self.at(name), "w") as file:
            file.write(change(text) if change else text)
        return self.at(name)

    def weigh(self, study, *words, out=None):
        done = self.run_it("tradeoff", study, "-o", out or self.out, "--quiet", *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with open(os.path.join(out or self.out, "summary.json")) as file:
            return json.load(file)["tradeoff"]

    def table(self, out=None):
        with open(os.path.join(out or self.out, "tables", "tradeoff.csv")) as file:
            return {(row["product"], row["setting"]): row for row in csv.DictReader(file)}

    def error(self, product, setting):
        return float(self.table()[product, setting]["error [-]"])

    @staticmethod
    def profile(out, name="axial_profile", value="holdup [-]", at="z [m]"):
        with open(os.path.join(out, "tables", name + ".csv")) as file:
            rows = [r for r in csv.DictReader(file) if r["type"] == "all"]
        return np.array([float(r[at]) for r in rows]), np.array([float(r[value]) for r in rows])


FOURS = [(60 + 5 * (k // 4 % 3), k // 4) for k in range(64)]  # four equal snapshots in a row
PAIRS = [(100 if k % 2 else 50, k % 2) for k in range(64)]    # two states in turn


class Tradeoff(Runs):
    def test_four_equal_snapshots_in_a_row_need_one(self):
        found = self.weigh(self.study(self.series(FOURS)))
        for setting in ("every 2nd snapshot", "every 4th snapshot"):
            for product in ("axial holdup", "lateral mass flux", "mean holdup"):
                self.assertLess(self.error(product, f"exact, cells x 1, {setting}, whole window"), 1e-12)
        self.assertGreater(self.error("axial holdup", "exact, cells x 1, every 3rd snapshot, whole window"), 0.02)
        self.assertEqual(found["recommended"]["every"], 4)
        self.assertTrue(found["promise_kept"])

    def test_two_states_in_turn_need_both(self):
        found = self.weigh(self.study(self.series(PAIRS), 'tolerance = 0.02\nproducts = ["mean holdup"]'))
        # 50 and 100 particles: either half of the snapshots alone misses the mean of 75 by 25.
        for n, nth in ((2, "2nd"), (4, "4th")):
            row = self.table()["mean holdup", f"exact, cells x 1, every {nth} snapshot, whole window"]
            self.assertAlmostEqual(float(row["error [-]"]), 1 / 3, 12)
            self.assertLess(float(row["error_ci95 [-]"]), 1e-9)  # the same in every block
        self.assertNotIn(found["recommended"]["every"], (2, 4))
        self.assertTrue(found["promise_kept"])

    def test_a_promise_that_the_second_half_breaks_is_told(self):
        broken = [(75, 0)] * 32 + PAIRS[32:]
        found = self.weigh(self.study(self.series(broken), 'tolerance = 0.02\nproducts = ["mean holdup"]'))
        self.assertEqual(found["chosen"]["every"], 4)
        self.assertFalse(found["promise_kept"])
        chosen = next(p for p in found["products"] if p["product"] == "mean holdup")["chosen"]
        self.assertEqual(chosen["first"], 0)
        self.assertAlmostEqual(chosen["second"], 1 / 3, 12)
        self.assertNotIn(found["recommended"]["every"], (2, 4))
        with open(self.at("out", "index.html")) as page:
            text = page.read()
        self.assertIn("The second half says: the promise was not kept", text)
        self.assertIn("<b>not kept</b>", text)
        self.assertNotIn('src="http', text)

    def test_errors_of_mapping_and_cells_are_those_of_the_tables(self):
        n = self.series(FOURS)
        self.weigh(self.study(n))
        finest = self.analyse(self.study(n, name="finest.toml"), out=self.at("finest"))
        z, r = self.profile(finest)
        for setting, change in (
                ("centre, cells x 1", lambda t: t.replace('"exact"', '"centre"')),
                ("gaussian, cells x 1", lambda t: t.replace('"exact"', '"gaussian"')),
                ("exact, cells x 2", lambda t: t.replace("cell    = [0.01, 0.01]", "cells = [4, 16]")),
                ("centre, cells x 2", lambda t: t.replace("cell    = [0.01, 0.01]", "cells = [4, 16]")
                 .replace('"exact"', '"centre"'))):
            other = self.analyse(self.study(n, change=lambda t: change(t).replace("[profiles]", "[profiles]\nband = 0.02"),
                                            name="other.toml"), out=self.at("other"))
            at, a = self.profile(other)
            expected = np.sqrt(np.mean((np.interp(z, at, a) - r) ** 2)) / np.mean(np.abs(r))
            self.assertAlmostEqual(self.error("axial holdup", setting + ", every snapshot, whole window"),
                                   expected, 12)
            x, flux = self.profile(finest, "lateral_profile", "mass_flux_z [kg/m2/s]", "x [m]")
            at, other_flux = self.profile(other, "lateral_profile", "mass_flux_z [kg/m2/s]", "x [m]")
            rows = len(at) // 2  # two heights
            brought = np.concatenate([np.interp(x[:8], at[:rows], other_flux[:rows]),
                                      np.interp(x[8:], at[rows:], other_flux[rows:])])
            self.assertAlmostEqual(self.error("lateral mass flux", setting + ", every snapshot, whole window"),
                                   np.sqrt(np.mean((brought - flux) ** 2)) / np.mean(np.abs(flux)), 12)

    def test_a_shorter_window_has_the_error_of_its_places(self):
        self.weigh(self.study(self.series([(40 + k // 8, 0) for k in range(64)])))
        means = np.array([40 + k // 8 for k in range(64)], float)
        for parts in (2, 4):
            places = means.reshape(parts, -1).mean(1)
            expected = np.sqrt(np.mean((places - means.mean()) ** 2)) / means.mean()
            self.assertAlmostEqual(
                self.error("mean holdup", f"exact, cells x 1, every snapshot, 1/{parts} of the window"), expected, 12)

    def test_the_recommended_study_is_the_users_and_keeps_the_tolerance(self):
        n = self.series(FOURS)
        study = self.study(n, 'tolerance = 0.02\nproducts = ["axial holdup", "mean holdup"]  # mine', "divided")
        found = self.weigh(study)
        with open(study) as file, open(self.at("out", "recommended.toml")) as other:
            before, after = file.read().splitlines(), other.read().splitlines()
        for line in before:
            if line not in after:
                self.assertRegex(line, "^(particles|mapping|average|cell) ")
        self.assertIn("# my study: cells are small", after)
        self.assertIn('particles = "../post/dump*.liggghts"', after)
        self.assertIn(f"every = {found['recommended']['every']}", after)
        z, r = self.profile(self.analyse(self.study(n, name="finest.toml"), out=self.at("finest")))
        at, a = self.profile(self.analyse(self.at("out", "recommended.toml"), out=self.at("cheap")))
        error = np.sqrt(np.mean((np.interp(z, at, a) - r) ** 2)) / r.mean()
        self.assertLess(error, 0.02)

    def test_keys_of_runs_are_changed_where_they_stand(self):
        n = self.series(FOURS)
        study = self.study(n, 'tolerance = 0.02\nproducts = ["mean holdup"]', change=lambda t: t.replace(
            'mapping = "exact"', "").replace('label     = "a"', 'label = "µ a"  # µ\nmapping = "gaussian"')
            + '\n[[run]]\nlabel = "b"\nparticles = "post/dump*.liggghts"\ntime_step = 0.001\ncells = [8, 32]\n'
            'mapping = "gaussian"\n')
        mapping = self.weigh(study)["recommended"]["setting"].split(",")[0]
        self.assertIn(mapping, ("exact", "centre"))
        with open(self.at("out", "recommended.toml")) as file:
            text = file.read()
        self.assertEqual(text.count(f'mapping = "{mapping}"'), 2, text)
        self.assertIn(f'label = "µ a"  # µ\nmapping = "{mapping}"', text)
        self.analyse(self.at("out", "recommended.toml"), out=self.at("cheap"))

    def test_results_but_times_do_not_depend_on_threads(self):
        study = self.study(self.series(FOURS))
        self.weigh(study, "--threads", "1")
        self.weigh(study, "--threads", "3", out=self.at("other"))
        kept = ("product", "setting", "error [-]", "error_ci95 [-]", "bytes")
        one, three = ([[row[k] for k in kept] for row in self.table(out).values()]
                      for out in (self.out, self.at("other")))
        self.assertEqual(one, three)

    def test_every_choice_is_there_with_its_cost(self):
        self.weigh(self.study(self.series(FOURS)))
        settings = {setting for _, setting in self.table()}
        for what in ("centre, cells x 1", "divided, cells x 1", "gaussian, cells x 1", "exact, cells x 2",
                     "every 3rd snapshot", "1/4 of the window", "cells in depth", "dumps as text",
                     "dumps in binary, double", "dumps in binary VTK, single", "cluster threshold x 0.9",
                     "cluster core x 1.1", "cluster min_area x 2"):
            self.assertTrue(any(what in setting for setting in settings), what)
        rows = self.table()
        finest = rows["axial holdup", "exact, cells x 1, every snapshot, whole window"]
        half = rows["axial holdup", "exact, cells x 1, every 2nd snapshot, whole window"]
        self.assertAlmostEqual(float(half["seconds"]), float(finest["seconds"]) / 2)
        # x y z vx vz radius type in doubles; a header of 96 bytes, chunks and their count.
        binary = rows["axial holdup", "dumps in binary, double precision"]
        particles = sum(count for count, _ in FOURS) / len(FOURS)
        self.assertAlmostEqual(float(binary["bytes"]) / 64, 104 + 8 * 7 * particles, delta=250)
        self.assertEqual(float(binary["error [-]"]), 0)
        self.assertLess(float(rows["axial holdup", "dumps in binary VTK, single precision"]["error [-]"]), 1e-6)
        self.assertLess(float(rows["axial holdup", "dumps as text, six digits"]["error [-]"]), 1e-12)

    def test_bad_input_is_one_line(self):
        n = self.series(FOURS)
        for study, words in (
                (self.study(n, "tolerance = 0"), ["tradeoff.tolerance", "above 0"]),
                (self.study(n, "tolerance = 0.1\nprodcts = []", name="b.toml"), ["prodcts", "products"]),
                (self.study(n, 'products = ["axial holdups"]', name="c.toml"),
                 ["tradeoff.products", "axial holdups", '"axial holdup"', "line 15"]),
                (self.study(8, name="d.toml"), ["at least 16 snapshots", "found 8"]),
                (self.study(n, name="e.toml", change=lambda t: t.replace("particles = ", "tables = ")),
                 ["expected particles, found tables"]),
                (self.study(n, name="f.toml", change=lambda t: t.replace("[profiles]", "every = 0\n[profiles]")),
                 ["scene.every", "from 1"]),
                (self.study(n, name="g.toml", change=lambda t: t.replace("[profiles]", "every = 7\n[profiles]")),
                 ["every = 7", "1, 2, 3, 4"])):
            done = self.run_it("tradeoff", study, "-o", self.at("none"))
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            for word in words:
                self.assertIn(word, done.stderr)
            self.assertFalse(os.path.exists(self.at("none")))

    def test_the_present_choice_may_be_coarse(self):
        found = self.weigh(self.study(self.series(FOURS), mapping="centre", change=lambda t: t.replace(
            "[profiles]", "every = 2\n[profiles]")))
        self.assertEqual(found["present"]["setting"], "centre, cells x 1, every 2nd snapshot, whole window")
        axial = next(p for p in found["products"] if p["product"] == "axial holdup")
        self.assertGreater(axial["present"]["whole"], 0.01)  # against exact


class Products(Runs):
    def test_what_is_not_asked_for_is_not_parsed(self):
        random = np.random.default_rng(3)
        for step in range(0, 200, 10):
            at = random.uniform([0.003, 0.003, 0.003], [0.077, 0.007, 0.317], (50, 3))
            rows = np.column_stack([at, random.normal(1, 0.2, 50)])
            self.dump(step, rows)
        all_of_it = self.analyse(self.study(20), out=self.at("all"))
        axial = self.study(20, name="axial.toml", change=lambda t: 'products = ["axial"]\n' + t)
        some = self.analyse(axial, out=self.at("some"))
        for value in ("holdup [-]", "holdup_ci95 [-]", "velocity_z [m/s]", "mass_flux_z_ci95 [kg/m2/s]"):
            self.assertEqual(self.profile(all_of_it, value=value)[1].tobytes(),
                             self.profile(some, value=value)[1].tobytes())
        # Words where id, type and the lateral velocity should be: nobody looks at them.
        for name in os.listdir(self.at("post")):
            path = self.at("post", name)
            with open(path) as file:
                lines = file.read().splitlines()
            for i in range(9, len(lines)):
                words = lines[i].split()
                words[0] = words[1] = words[5] = "none"
                lines[i] = " ".join(words)
            with open(path, "w") as file:
                file.write("\n".join(lines) + "\n")
        again = self.analyse(axial, out=self.at("again"))
        self.assertEqual(self.profile(some)[1].tobytes(), self.profile(again)[1].tobytes())
        done = self.run_it("analyse", self.study(20), "-o", self.at("fails"), "--tables-only")
        self.assertEqual(done.returncode, 2)

    def test_an_unknown_product_is_one_line(self):
        self.series(FOURS[:4])
        study = self.study(4, change=lambda t: 'products = ["radial"]\n' + t)
        done = self.run_it("analyse", study, "-o", self.at("none"))
        self.assertEqual(done.returncode, 2)
        self.assertIn('found "radial"', done.stderr)


if __name__ == "__main__":
    unittest.main()
