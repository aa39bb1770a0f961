#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""`bedscope validate` and `bedscope curves` as a user and a CI run them.

    validate_test.py BEDSCOPE PROJECT
"""
import csv
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml

try:
    import numpy as np
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)

BEDSCOPE, PROJECT = sys.argv[1:3]
del sys.argv[1:]
VARAS = PROJECT + "/cases/validation/varas_2017/study.toml"
CURVES = PROJECT + "/data/curves/varas_2017/"


def bedscope(*words):
    return subprocess.run([BEDSCOPE, *words], capture_output=True, text=True, timeout=120)


def rows_of(path, **chosen):
    with open(path) as file:
        return [row for row in csv.DictReader(file) if all(row[k] == v for k, v in chosen.items())]


def relative_rmse(reference, result):
    """Interpolated linearly to the reference's abscissae, none extrapolated; over its mean there."""
    x, y = np.array(sorted(result)).T
    at = np.array([p for p in reference if x[0] <= p[0] <= x[-1]])
    return np.sqrt(np.mean((np.interp(at[:, 0], x, y) - at[:, 1]) ** 2)) / at[:, 1].mean()


def curve(name, velocity):
    return [(float(r["z [m]"]), float(r["holdup [-]"]))
            for r in rows_of(CURVES + name, **{"U [m/s]": velocity})]


class Validate(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = self.scratch.name
        self.addCleanup(self.scratch.cleanup)

    def study(self, checks, run='label = "a"\ntables = "a"', head=""):
        os.makedirs(self.folder + "/a/tables", exist_ok=True)
        with open(self.folder + "/a/tables/axial_profile.csv", "w") as file:
            file.write("z [m],holdup [-],holdup_ci95 [-]\n")
            file.writelines(f"{z / 50},{0.1 - z / 1000},0.001\n" for z in range(51))
        path = self.folder + "/study.toml"
        with open(path, "w") as file:
            file.write(head + f"[[run]]\n{run}\n" + "".join(f"[[check]]\n{c}\n" for c in checks))
        return path

    def validate(self, path, *words):
        return bedscope("validate", path, "-o", self.folder + "/out", *words)

    def test_the_papers_own_simulation_misses_its_experiment_as_is_known(self):
        done = self.validate(VARAS, "--json")
        self.assertEqual(done.returncode, 1, done.stderr)
        checks = json.loads(done.stdout)["checks"]
        axial = {c["run"]: c for c in checks if c["quantity"] == "axial holdup" and c["metric"] == "relative rmse"}
        for velocity, known, verdict in (("5.55", 0.320, "does not hold"), ("5.95", 0.115, "holds")):
            check = axial[velocity + " m/s"]
            self.assertEqual(round(check["value"], 3), known)
            self.assertAlmostEqual(check["value"], relative_rmse(
                curve("axial_holdup.csv", velocity), curve("axial_holdup_simulation.csv", velocity)), 12)
            self.assertEqual(check["verdict"], verdict)
            self.assertLessEqual(check["lo"], check["value"])
            self.assertGreaterEqual(check["hi"], check["value"])
            self.assertEqual(check["points_outside"], 1)

    def test_what_a_ci_shows(self):
        self.validate(VARAS)
        suite = xml.parse(self.folder + "/out/junit.xml").getroot().find("testsuite")
        self.assertEqual((suite.get("failures"), suite.get("skipped")), ("1", "0"))
        self.assertEqual(int(suite.get("tests")), len(suite.findall("testcase")))
        with open(self.folder + "/out/summary.md") as file:
            self.assertIn("**does not hold** | 5.55 m/s", file.read())
        with open(self.folder + "/out/report.html") as file:
            page = file.read()
        self.assertNotIn('src="http', page)
        self.assertNotIn("<script", page)
        self.assertIn("Carlos Varas", page)

    def test_another_velocitys_experiment_is_rejected(self):
        study = self.study(['quantity = "axial holdup"\nagainst = "varas_2017/axial_holdup?U=6.74"\n'
                            'metric = "relative rmse"\nlimit = 0.25'])
        self.assertEqual(self.validate(study).returncode, 1)

    def test_exit_codes(self):
        mean = 'quantity = "axial holdup"\nmetric = "relative rmse"\nlimit = {}\nagainst = {}\nuncertainty = {}'
        for limit, number, uncertainty, code, lenient in ((2, 0.075, 0.001, 0, 0), (0.1, 0.3, 0.001, 1, 1),
                                                          (0.25, 0.075, 0.02, 1, 0)):
            study = self.study([mean.format(limit, number, uncertainty)])
            self.assertEqual(self.validate(study).returncode, code)
            self.assertEqual(self.validate(study, "--allow-undecided").returncode, lenient)

    def test_a_curve_that_may_not_be_passed_on_skips_its_check(self):
        os.makedirs(self.folder + "/mine")
        with open(self.folder + "/mine/closed.toml", "w") as file:
            file.write('redistribute = "no"\n')
        check = 'quantity = "axial holdup"\nagainst = "closed"\nmetric = "relative rmse"\nlimit = 1'
        done = self.validate(self.study([check], head='curves = ["mine"]\n'), "--json")
        self.assertEqual(json.loads(done.stdout)["checks"][0]["verdict"], "skipped")
        self.assertEqual(done.returncode, 1)
        with open(self.folder + "/mine/closed.csv", "w") as file:
            file.write("z [m],holdup [-]\n0.5,0.075\n")
        self.assertEqual(self.validate(self.folder + "/study.toml").returncode, 0)

    def test_an_earlier_result_is_a_reference_and_a_history(self):
        check = 'quantity = "axial holdup"\nagainst = "baseline:old"\nmetric = "max error"\nlimit = 0.01'
        study = self.study([check])
        os.rename(self.folder + "/a", self.folder + "/old")
        study = self.study([check])
        self.assertEqual(self.validate(study).returncode, 0)
        earlier = self.folder + "/earlier.json"
        os.rename(self.folder + "/out/summary.json", earlier)
        self.assertEqual(self.validate(study, "--earlier", earlier).returncode, 0)
        with open(self.folder + "/out/report.html") as file:
            self.assertIn("<th>Before</th>", file.read())

    def test_bad_checks_are_one_line_and_leave_nothing(self):
        good = dict(quantity='"axial holdup"', against='"varas_2017/axial_holdup?U=5.55"',
                    metric='"relative rmse"', limit="1")
        for change, text in (({"metric": '"relative rms"'}, 'nearest known one is "relative rmse"'),
                             ({"quantity": '"axial hold"'}, 'nearest known one is "axial holdup"'),
                             ({"limit": None}, "limit is missing"),
                             ({"against": None}, "against is missing"),
                             ({"against": '"varas_2018/axial_holdup"'}, "no such curve"),
                             ({"against": '"varas_2017/axial_holdup"'}, "expected a choice of U"),
                             ({"against": '"theory:bed weigth"'}, "nearest known one is"),
                             ({"against": '"run:b"'}, 'no run "b"'),
                             ({"quantity": '"mean temperature"', "against": "300"}, "no mean temperature"),
                             ({"quantity": '"lateral holdup"', "at": "{ height = 0.3 }"}, "no profile at 0.3 m"),
                             ({"metric": '"area"'}, "no distribution"),
                             ({"metric": '"decreasing"'}, "needs none"),
                             ({"limits": "2"}, "unknown key"),
                             ({"against": '"wachem_2001/voidage"'}, "expected the units")):
            keys = {k: v for k, v in (good | change).items() if v is not None}
            done = self.validate(self.study(["\n".join(f"{k} = {v}" for k, v in keys.items())]))
            self.assertEqual(done.returncode, 2, change)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn(text, done.stderr)
            self.assertIn("study.toml", done.stderr)
            self.assertFalse(os.path.exists(self.folder + "/out/report.html"))

    def test_pipes_devices_and_folders_are_no_curves(self):
        study = self.study(['quantity = "axial holdup"\nagainst = "mine"\nmetric = "max error"\nlimit = 1'],
                           head='curves = ["c"]\n')
        os.makedirs(self.folder + "/c")
        path = self.folder + "/c/mine"
        for make in (os.mkfifo, os.mkdir, lambda name: os.symlink("/dev/zero", name)):
            for ending in (".csv", ".toml"):
                with open(path + (".toml" if ending == ".csv" else ".csv"), "w") as file:
                    file.write('redistribute = "no"\n' if ending == ".csv" else "z [m],holdup [-]\n0,0.1\n1,0.1\n")
                make(path + ending)
                done = self.validate(study)
                self.assertLessEqual(done.stderr.count("\n"), 1, done.stderr)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertFalse(os.path.exists(self.folder + "/out"))
                (os.rmdir if make is os.mkdir else os.remove)(path + ending)
                os.remove(path + (".toml" if ending == ".csv" else ".csv"))
        os.mkfifo(self.folder + "/earlier.json")
        done = self.validate(self.study(['quantity = "mean holdup"\nagainst = 0.1\nmetric = "max error"\nlimit = 1']),
                             "--earlier", self.folder + "/earlier.json")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)

    def test_a_write_that_fails_leaves_the_folder_as_it_was(self):
        check = 'quantity = "axial holdup"\nagainst = 0.08\nmetric = "max error"\nlimit = 1'
        whole = self.validate(self.study([check]))
        self.assertEqual(whole.returncode, 0, whole.stderr)
        out = self.folder + "/out"

        def tree():
            paths = [os.path.join(folder, name) for folder, _, names in os.walk(out) for name in names]
            return {path: pathlib.Path(path).read_bytes() for path in paths}

        before = tree()
        study = self.study([check, check.replace("0.08", "0.07")])
        sizes = sorted({len(content) for content in before.values()})
        for limit in [0, *(size - 1 for size in sizes[::3]), sizes[-1] - 1]:
            done = subprocess.run([BEDSCOPE, "validate", study, "-o", out], capture_output=True, text=True,
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertEqual(tree(), before, limit)

    def test_curves_lists_shows_and_prints(self):
        listed = bedscope("curves").stdout
        self.assertGreater(len(listed.splitlines()), 40)
        self.assertIn("Chem. Eng. Sci. 169", bedscope("curves", "varas_2017/axial_holdup").stdout)
        points = bedscope("curves", "varas_2017/axial_holdup?U=5.55").stdout
        self.assertEqual(len([p for p in points.splitlines() if p[0].isdigit()]), 80)
        self.assertEqual(bedscope("curves", "varas_2017/axial").returncode, 2)


if __name__ == "__main__":
    unittest.main()
