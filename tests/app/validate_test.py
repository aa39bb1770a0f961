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

    def test_the_runs_of_the_fixed_bed_follow_its_closed_form(self):
        done = self.validate(PROJECT + "/cases/validation/mu_2022_fixed_bed/study.toml", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        checks = json.loads(done.stdout)["checks"]
        self.assertEqual({c["verdict"] for c in checks}, {"holds"})
        self.assertEqual(len(checks), 20)

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

    def test_long_curves_give_a_page_that_can_be_sent(self):
        os.makedirs(self.folder + "/long/tables")
        rng, z = np.random.default_rng(3), (np.arange(20000) + 0.5) / 20000
        with open(self.folder + "/long/tables/axial_profile.csv", "w") as file:
            file.write("z [m],holdup [-],holdup_ci95 [-]\n")
            file.writelines(f"{a},{0.1 - 0.05 * a + e},0.004\n" for a, e in zip(z, 0.002 * rng.normal(size=20000)))
        with open(self.folder + "/long.csv", "w") as file:
            file.write("z [m],holdup [-],holdup_u [-]\n")
            file.writelines(f"{a},{0.1 - 0.05 * a},0.002\n" for a in z)
        path = self.folder + "/study_of_long.toml"
        with open(path, "w") as file:
            file.write('[[run]]\nlabel = "a"\ntables = "long"\n[[check]]\nquantity = "axial holdup"\n'
                       'against = "long.csv"\nmetric = "relative rmse"\nlimit = 0.1\n')
        done = self.validate(path)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("its interval was drawn at 1000 of 20000 points", done.stdout)
        self.assertLess(os.path.getsize(self.folder + "/out/report.html"), 2e6)  # two panels of a megabyte
        with open(self.folder + "/out/report.html") as file:
            self.assertIn("More points than can be seen (20000 of the result, 20000 of the reference)", file.read())

    def series(self, times, values):
        os.makedirs(self.folder + "/a/tables", exist_ok=True)
        with open(self.folder + "/a/tables/series.csv", "w") as file:
            file.write("series,unit,time [s],value\n")
            file.writelines(f"dp,Pa,{t},{v}\n" for t, v in zip(times, values))
        return self.study(['quantity = "series: dp"\nagainst = 100\nmetric = "relative bias"\nlimit = 0.5'])

    def test_what_makes_the_mean_of_a_series_doubtful_is_said(self):
        rng, t = np.random.default_rng(5), np.arange(1000) / 100
        for values, said in ((100 + rng.normal(size=1000), ""), (100 + t + rng.normal(size=1000), "may not be steady"),
                             ([99, 101, 100], "3 independent samples, too few")):
            done = self.validate(self.series(t[:len(values)], values))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual('run "a": dp:' in done.stdout, said != "", done.stdout)
            self.assertIn(said, done.stdout)

    def test_names_of_any_letters_are_drawn_as_they_are(self):
        label, name = "Lauf <1> & \"größe\" 温度 ]]>", "T_gas {x} ^2 @ &<b> ]]>"
        with open(self.series([0, 1, 2], [99, 101, 100]), "r+") as file:
            study = file.read().replace('label = "a"', "label = " + json.dumps(label, ensure_ascii=False))
            file.seek(0)
            file.write(study.replace("series: dp", "series: " + name))
        with open(self.folder + "/a/tables/series.csv", "r+") as file:
            rows = file.read().replace("dp,", name + ",")
            file.seek(0)
            file.write(rows)
        self.assertEqual(self.validate(self.folder + "/study.toml").returncode, 0)
        self.assertIn(label, xml.parse(self.folder + "/out/junit.xml").getroot()[0][0].get("classname"))
        picture = "".join(xml.parse(self.folder + "/out/checks/check_01.svg").getroot().itertext())
        for words in (label, name):
            self.assertIn(words, picture.replace("\u200b", "").replace("\n", ""))

    def test_figures_of_tiny_values_and_of_many_runs_can_be_read(self):
        runs = ""
        for k in range(20):
            os.makedirs(f"{self.folder}/r{k}")
            with open(f"{self.folder}/r{k}/axial_profile.csv", "w") as file:
                file.write("z [m],holdup [-],holdup_ci95 [-]\n")
                file.writelines(f"{z / 9},{(1 + z) * 1e-12},1e-15\n" for z in range(10))
            runs += f'[[run]]\nlabel = "run {k}"\ntables = "r{k}"\n'
        with open(self.folder + "/many.toml", "w") as file:
            file.write(runs + '[[check]]\nquantity = "axial holdup"\nagainst = 5e-12\nmetric = "max error"\nlimit = 1\n')
        self.assertEqual(self.validate(self.folder + "/many.toml").returncode, 0)
        texts = {name: list(xml.parse(f"{self.folder}/out/checks/{name}.svg").getroot().itertext())
                 for name in ("check_01", "quantity_01")}
        for name, words in (("check_01", "axial holdup [10⁻¹²]"), ("check_01", "error [10⁻¹²]"),
                            ("quantity_01", "20 runs"), ("quantity_01", "result axial holdup [10⁻¹²]")):
            self.assertIn(words, [text.strip() for text in texts[name]])
        self.assertNotIn("0.000", "".join(texts["check_01"]))

    def test_a_study_that_is_named_as_its_curve_is_told_from_a_sidecar(self):
        study = self.study(['quantity = "axial holdup"\nagainst = "study.csv"\nmetric = "max error"\nlimit = 1'])
        with open(self.folder + "/study.csv", "w") as file:
            file.write("z [m],holdup [-]\n0.1,0.1\n")
        self.assertIn("read as the sidecar of " + self.folder + "/study.csv", self.validate(study).stderr)

    def test_columns_that_are_taken_for_the_curve_are_named(self):
        study = self.study(['quantity = "axial holdup"\nagainst = "r.csv"\nmetric = "max error"\nlimit = 1'])
        with open(self.folder + "/r.csv", "w") as file:
            file.write("z [m],holdup [-],holdup_std [-]\n" + "".join(f"{k / 50},0.1,0.01\n" for k in range(50)))
        told = self.validate(study).stderr
        self.assertIn("several curves of holdup_std [-] against holdup [-]", told)
        self.assertIn("a choice of z among 0.0, 0.02 ... 0.98 (50 values)", told)

    def test_nothing_is_compared_in_a_gap_of_the_result(self):
        study = self.study(['quantity = "axial holdup"\nagainst = "r.csv"\nmetric = "max error"\nlimit = 1'])
        with open(self.folder + "/a/tables/axial_profile.csv", "w") as file:
            file.write("z [m],holdup [-],holdup_ci95 [-]\n")
            file.writelines(f"{z / 50},{'nan' if 10 < z < 20 else 0.1},0.001\n" for z in range(51))
        with open(self.folder + "/r.csv", "w") as file:
            file.write("z [m],holdup [-]\n" + "".join(f"{k / 10},0.1\n" for k in range(11)))
        self.assertIn("1 of 11 points of the reference lie outside the result, or in a gap of it",
                      self.validate(study).stdout)

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
        (skipped,) = json.loads(done.stdout)["checks"]
        self.assertEqual(skipped["verdict"], "skipped")
        self.assertEqual(done.returncode, 1)
        with open(self.folder + "/mine/closed.csv", "w") as file:
            file.write("z [m],holdup [-]\n0.5,0.075\n")
        done = self.validate(self.folder + "/study.toml", "--json")
        self.assertEqual(done.returncode, 0)
        self.assertEqual(json.loads(done.stdout)["checks"][0]["key"], skipped["key"])  # the same check in its history

    def test_large_numbers_and_tags_are_shown_as_people_read_them(self):
        self.tables(pressure_drop="time [s],pressure_drop [Pa]\n" + "".join(
            f"{k / 10},{2450 + 300 * (k % 3 - 1)}\n" for k in range(40)))
        check = 'quantity = "pressure drop"\nagainst = 1200\nuncertainty = 1\nmetric = "max error"\nlimit = 1251'
        self.validate(self.study([check], head='title = "bed <a> | b"\n[scene]\naverage = {}\n'))
        with open(self.folder + "/out/summary.md") as file:
            summary = file.read()
        self.assertIn("## bed \\<a> \\| b\n", summary)
        self.assertIn("max error 1240 [", summary)
        self.assertNotIn("e+0", summary)

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

    def test_an_earlier_result_of_the_same_snapshots_has_the_same_errors(self):
        check = ('quantity = "axial holdup"\nagainst = "baseline:old"\nmetric = "relative max error"\n'
                 "limit = 0.01")

        def tables(name, factor, heights):
            os.makedirs(f"{self.folder}/{name}/tables", exist_ok=True)
            with open(f"{self.folder}/{name}/tables/axial_profile.csv", "w") as file:
                file.write("z [m],holdup [-],holdup_ci95 [-]\n")
                file.writelines(f"{z / 50},{factor * 0.1},0.01\n" for z in range(51))
            with open(f"{self.folder}/{name}/tables/inventory.csv", "w") as file:
                file.write("time [s],type,particles,solids_mass [kg],holdup [-],mean_height [m]\n")
                file.writelines(f"{k / 10},all,100,0.04,0.1,{h}\n" for k, h in enumerate(heights))

        study = self.study([check])
        rising, other = [0.5 + k / 100 for k in range(40)], [0.5 + k % 3 / 100 for k in range(40)]
        tables("old", 1, rising)
        for factor, heights, verdict in ((1.005, rising, "holds"), (1.02, rising, "does not hold"),
                                         (1.005, other, "undecided"), (1, other, "holds")):
            tables("a", factor, heights)
            done = self.validate(study, "--json")
            self.assertEqual(json.loads(done.stdout)["checks"][0]["verdict"], verdict, (factor, done.stdout))

    def test_several_checks_of_one_comparison_share_its_panel(self):
        check = 'quantity = "axial holdup"\nagainst = 0.075\nmetric = "{}"\nlimit = 1\nuncertainty = 0.001'
        self.validate(self.study([check.format(m) for m in ("relative rmse", "max error", "relative bias")]))
        self.assertEqual(os.listdir(self.folder + "/out/checks").count("check_01.svg"), 1)
        self.assertNotIn("check_02.svg", os.listdir(self.folder + "/out/checks"))
        with open(self.folder + "/out/report.html") as file:
            self.assertIn('id="check3"', file.read())

    def test_single_values_have_a_panel_too(self):
        check = 'quantity = "bed height"\nagainst = 0.2\nmetric = "relative bias"\nlimit = 1\nuncertainty = 0.01'
        self.tables(bed_height="time [s],height_surface [m]\n0,0.2\n1,0.3\n2,0.2\n")
        self.validate(self.study([check]))
        self.assertIn("check_01.svg", os.listdir(self.folder + "/out/checks"))

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
                             ({"quantity": '"lateral holdup"', "at": "{ height = 0.3 }"}, "it has no lateral holdup"),
                             ({"metric": '"area"'}, "no distribution"),
                             ({"metric": '"decreasing"'}, "needs none"),
                             ({"limits": "2"}, "unknown key"),
                             ({"against": '"wachem_2001/voidage"'}, "expected the units"),
                             ({"against": '"varas_2017/axial_holdup?U=5.5"'}, "no point has U = 5.5; there are"),
                             ({"against": '"varas_2017/axial_holdup?V=5.5"'}, "expected a choice among U"),
                             ({"against": '"varas_2017/axial_holdup?U"'}, "expected a selection such as"),
                             ({"against": '"mu_2022/text_statements"'}, "not a curve"),
                             ({"against": '"nowhere.csv"'}, "no such file"),
                             ({"against": '"baseline:nowhere.json"'}, "no such file"),
                             ({"against": '"theory:fixed bed"'}, "with.voidage is missing"),
                             ({"against": '"theory:random close packing"', "with": "{ area = 1 }"}, "unknown key"),
                             ({"quantity": '"mean holdup"'}, "has no mean holdup"),
                             ({"quantity": '"pressure drop"', "against": "3"}, "has no pressure drop"),
                             ({"quantity": '"axial temperature"', "against": "3"}, "has no axial temperature"),
                             ({"quantity": '"bubble diameter"', "against": "3"}, "has no bubble diameter"),
                             ({"quantity": '"probe pressure deviation"', "against": "3"}, "has no probes"),
                             ({"run": '"b"'}, 'no run "b"'),
                             ({"species": '"7"'}, 'no species "7"'),
                             ({"limit": '"a"'}, "limit"),
                             ({"limit": "-0.1"}, "expected at least 0"),
                             ({"metric": '"rank correlation"', "limit": "2"}, "expected -1 to 1"),
                             ({"at": "{ hight = 1 }"}, "unknown key at.hight of axial holdup; expected at.U, at.time"),
                             ({"against": "0.1", "at": "{ U = 5.55 }"}, "unknown key at.U"),
                             ({"against": "0.1", "at": "{ height = 0.5 }"}, "unknown key at.height of axial holdup"),
                             ({"against": '"run:a"'}, "a run against itself"),
                             ({"accuracy": "-1"}, "accuracy"),
                             ({"accuracy": "0.1"}, 'belongs to the metric "e over u"'),
                             ({"uncertainty": "0.1"}, "belongs to a number in against"),
                             ({"with": "{ area = 1 }"}, "belongs to a theory in against"),
                             ({"uncertainty": "-1"}, "uncertainty")):
            keys = {k: v for k, v in (good | change).items() if v is not None}
            done = self.validate(self.study(["\n".join(f"{k} = {v}" for k, v in keys.items())]))
            self.assertEqual(done.returncode, 2, change)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn(text, done.stderr)
            self.assertIn("study.toml", done.stderr)
            self.assertFalse(os.path.exists(self.folder + "/out/report.html"))

    def test_bad_curves_are_one_line_and_leave_nothing(self):
        os.makedirs(self.folder + "/mine")
        check = 'quantity = "axial holdup"\nagainst = "bad"\nmetric = "relative rmse"\nlimit = 1'
        study = self.study([check], head='curves = ["mine"]\n')
        for table, sidecar, text in (
                ("z,holdup\n0.1,0.2\n", "", 'column "z": expected its unit in brackets'),
                ("z [m],holdup\n0.1,0.2\n", "", 'column "holdup": expected its unit in brackets'),
                ("z [m]\n0.1\n", "", "expected an abscissa and an ordinate"),
                ("z [m],holdup [-]\n", "", "no rows"),
                ("", "", "bad.csv"),
                ("z [m],holdup [-]\n0.1,a\n", "", "line 2"),
                ("z [m],holdup [-],holdup_lo [-]\n0.1,0.2,0.1\n", "", "expected both ends"),
                ("z [m],holdup [-]\n0.1,nan\n", "", "line 2"),
                ("z [m],holdup [-]\n0.1,0.2,3\n", "", "line 2"),
                ("z [m],holdup [-]\n7,0.2\n8,0.3\n", "", "outside the result: z [m] from 7 to 8"),
                ("z [mm],holdup [-]\n0.1,0.2\n", "", "expected the units of the result"),
                ("z [m],holdup [-]\n0.1,0.2\n", 'redistribute = "maybe"', 'expected "yes" or "no"'),
                ("z [m],holdup [-]\n0.1,0.2\n", 'redistribte = "no"', "unknown key"),
                ("z [m],holdup [-]\n0.1,0.2\n", "ordinate_uncertainty = -1", "at least 0"),
                ("z [m],holdup [-]\n0.1,0.2\n", 'ordinate_uncertainty = "x %"', "expected a share"),
                ("z [m],holdup [-]\n0.1,0.2\n", 'ordinate = "velocity"', 'expected a column "velocity"'),
                ("z [m],holdup [-]\n0.1,0.2\n", "title = ", "bad.toml")):
            with open(self.folder + "/mine/bad.csv", "w") as file:
                file.write(table)
            with open(self.folder + "/mine/bad.toml", "w") as file:
                file.write(sidecar)
            done = self.validate(study)
            self.assertEqual(done.returncode, 2, table + sidecar)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn(text, done.stderr)
            self.assertFalse(os.path.exists(self.folder + "/out"))

    def test_a_table_that_lacks_what_a_check_needs_is_named(self):
        check = 'quantity = "{}"\nagainst = 0.1\nmetric = "relative bias"\nlimit = 1'
        for name, quantity, text in (("axial_profile", "axial holdup", "holdup [-]"),
                                     ("inventory", "inventory", "solids_mass [kg]")):
            rows = {"axial_profile": "z [m],hold [-]\n0,1\n1,1\n", "inventory": "time [s],particles\n0,1\n1,1\n"}
            study = self.study([check.format(quantity)])
            self.tables(**{name: rows[name]})
            done = self.validate(study)
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"it has no {quantity} ({text} of {name}.csv)", done.stderr)

    def test_columns_are_there_once_and_numbers_are_finite(self):
        check = 'quantity = "axial holdup"\nagainst = "own.csv"\nmetric = "relative bias"\nlimit = 1'
        good = "z [m],holdup [-]\n0,1\n1,1\n"
        for table, own, text in (("z [m];holdup [-]\n0;1\n", good, "with commas between them"),
                                 ("z [m],holdup [-],holdup [-]\n0,1,2\n", good, "one column 'holdup [-]'"),
                                 ("z [m],holdup [-]\n0,1\n1,-inf\n", good, "expected a number for 'holdup [-]'"),
                                 (good, "z [m],holdup [-],holdup [-]\n0,1,2\n1,1,2\n", "one column 'holdup [-]'")):
            study = self.study([check])
            self.tables(axial_profile=table)
            with open(self.folder + "/own.csv", "w") as file:
                file.write(own)
            done = self.validate(study)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn(text, done.stderr)

    def test_a_run_without_clusters_is_undecided_and_hides_no_other_check(self):
        cluster = 'quantity = "cluster {}"\nagainst = {}\nmetric = "{}"\nlimit = 1'
        checks = [cluster.format("holdup", 0.3, "relative bias"), cluster.format("velocity", 1, "max error"),
                  'quantity = "cluster position"\nshape = "near walls"',
                  'quantity = "mean holdup"\nagainst = 0.02\nmetric = "relative bias"\nlimit = 1']
        study = self.study(checks)
        self.tables(clusters="time [s],cluster,x [m],z [m],holdup [-],velocity_z [m/s]\n",
                    cluster_occurrence="time [s],clusters\n" + "".join(f"{k},0\n" for k in range(12)),
                    inventory="time [s],particles,holdup [-]\n" + "".join(f"{k},9,0.02\n" for k in range(12)))
        done = self.validate(study)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(done.stdout.count("no cluster in the 12 snapshots of the window"), 3, done.stdout)
        self.assertIn("cluster holdup: relative bias against 0.3: no cluster", done.stdout)
        self.assertEqual(done.stdout.count("\nholds"), 1, done.stdout)
        with open(self.folder + "/out/summary.json") as file:
            self.assertIsNone(json.load(file)["checks"][0]["value"])
        os.remove(self.folder + "/a/tables/cluster_occurrence.csv")  # then nobody looked
        self.assertIn("it has no cluster holdup (holdup [-] of clusters.csv)", self.validate(study).stderr)

    def test_what_has_no_area_no_shape_or_no_time_is_one_line(self):
        pdf = "bin_centre [-],probability_density [-],probability_density_ci95 [-]\n0.25,{},0.1\n0.75,0.5,{}\n"
        area = 'quantity = "temperature pdf"\nagainst = "{}.csv"\nmetric = "area"\nlimit = 1'
        history = 'quantity = "inventory history"\nagainst = 1\nmetric = "max error"\nlimit = 1'
        zero = 'quantity = "lateral velocity"\nat = { height = 1 }\nshape = "down-flow at walls"'
        for name, unit in (("share", "-"), ("kelvin", "K")):
            with open(f"{self.folder}/{name}.csv", "w") as file:
                file.write(f"T [{unit}],f [-]\n0.25,1\n0.75,1\n")
        still = "height [m],x [m],velocity_z [m/s]\n" + "".join(f"1,{k},0\n" for k in range(8))
        for check, table, text in (
                (area.format("kelvin"), pdf.format(1.5, 0.1), "expected it along scaled temperature [-]"),
                (area.format("share"), pdf.format("nan", 0.1), "scaled temperature = 0.25: expected temperature pdf"),
                (area.format("share"), pdf.format(1.5, "nan"), "scaled temperature = 0.75: expected temperature pdf"),
                (area.format("share"), pdf.format(1.5, -0.1), "a half-width of at least 0"),
                (history, "time [s],particles,solids_mass [kg]\n0,1,1\n2,1,1\n1,1,1\n", "do not ascend"),
                (zero, still, "is 0 everywhere")):
            name = {"b": "temperature_pdf", "t": "inventory", "h": "lateral_profile"}[table[0]]
            self.tables(**{name: table})
            done = self.validate(self.study([check]))
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr + done.stdout)
            self.assertIn(text, done.stderr)
            self.assertFalse(os.path.exists(self.folder + "/out"))
            os.remove(f"{self.folder}/a/tables/{name}.csv")
        self.tables(temperature_pdf=pdf.format(1.5, 0.1))
        self.assertEqual(self.validate(self.study([area.format("share")])).returncode, 0)

    def test_a_profile_at_another_height_is_none(self):
        """Tables do not say how wide their bands are: a check takes the height that it names, or none."""
        self.tables(lateral_profile="height [m],x [m],holdup [-]\n0.3,0.01,0.1\n0.3,0.02,0.1\n")
        check = ('quantity = "lateral holdup"\nat = {{ height = {} }}\nagainst = 0.1\nmetric = "max error"\n'
                 "limit = 0.01")
        self.assertEqual(self.validate(self.study([check.format("0.30")])).returncode, 0)
        done = self.validate(self.study([check.format("0.31")]))
        self.assertEqual(done.returncode, 2)
        self.assertIn("no profile at 0.31 m, there are 0.3 m", done.stderr)

    def test_a_path_of_a_curve_is_relative_to_the_study(self):
        check = 'quantity = "axial holdup"\nagainst = "mine.csv"\nmetric = "max error"\nlimit = 1'
        study = self.study([check])
        with open(self.folder + "/mine.csv", "w") as file:
            file.write("z [m],holdup [-]\n0.5,0.075\n")
        self.assertEqual(self.validate(study).returncode, 0)

    def test_checks_of_one_name_are_told_apart(self):
        """Two theories that differ by a parameter, and two limits: panels, test cases and histories of their own."""
        theory = ('quantity = "pressure drop"\nagainst = "theory:bed weight"\nmetric = "relative bias"\n'
                  "with = {{ area = {}, mass = 1, particle_density = 2500, gas_density = 0, gravity = 9.81 }}\n"
                  "limit = {}")
        self.tables(pressure_drop="time [s],pressure_drop [Pa]\n0,98\n1,98.2\n2,98\n")
        study = self.study([theory.format(0.1, 1), theory.format(0.2, 0.1), theory.format(0.1, 1e-9)])
        done = self.validate(study, "--json")
        self.assertEqual(done.stderr, "")
        checks = json.loads(done.stdout)["checks"]
        self.assertEqual([c["verdict"] for c in checks], ["holds", "does not hold", "undecided"])
        self.assertEqual(len({c["key"] for c in checks}), 3)
        self.assertEqual(len([n for n in os.listdir(self.folder + "/out/checks") if n.startswith("check_")
                              and n.endswith(".svg")]), 2)
        names = [c.get("name") for c in xml.parse(self.folder + "/out/junit.xml").getroot().iter("testcase")]
        self.assertEqual(len(set(names)), 3)
        earlier = self.folder + "/earlier.json"
        os.rename(self.folder + "/out/summary.json", earlier)
        self.validate(study, "--earlier", earlier)
        with open(self.folder + "/out/report.html") as file:
            self.assertNotIn("<b>holds</b>", file.read())  # bold in the history: it has changed

    def test_a_density_needs_ascending_abscissae(self):
        os.makedirs(self.folder + "/mine")
        os.makedirs(self.folder + "/a/tables")
        with open(self.folder + "/a/tables/temperature_pdf.csv", "w") as file:
            file.write("bin_centre [-],probability_density [-]\n0.25,1.5\n0.75,0.5\n")
        with open(self.folder + "/mine/bad.csv", "w") as file:
            file.write("T [-],density [-]\n0.2,1\n0.2,2\n0.4,1\n")
        check = 'quantity = "temperature pdf"\nagainst = "bad"\nmetric = "area"\nlimit = 1'
        done = self.validate(self.study([check], head='curves = ["mine"]\n'))
        self.assertEqual(done.returncode, 2)
        self.assertIn("expected ascending abscissae", done.stderr)

    def test_a_wrong_check_is_found_before_the_dumps_are_read(self):
        study = self.study(['quantity = "axial holdup"\nagainst = "no_such"\nmetric = "max error"\nlimit = 1'],
                           run='label = "a"\nparticles = "no/such/dump*"\ntime_step = 1')
        self.assertIn("no such curve", self.validate(study).stderr)

    def test_an_earlier_summary_that_is_none(self):
        study = self.study(['quantity = "axial holdup"\nagainst = 0.075\nmetric = "max error"\nlimit = 1'])
        done = self.validate(study, "--earlier", study)
        self.assertEqual(done.returncode, 2)
        self.assertIn("expected a summary.json", done.stderr)
        self.assertFalse(os.path.exists(self.folder + "/out"))

    def tables(self, **files):
        """Tables of another program, as the run "a"."""
        os.makedirs(self.folder + "/a/tables", exist_ok=True)
        for name, text in files.items():
            with open(f"{self.folder}/a/tables/{name}.csv", "w") as file:
                file.write(text)

    def test_a_bed_is_judged_by_a_papers_signals(self):
        """van Wachem et al. (2001): a height that fluctuates. The reference's numbers by numpy."""
        height = np.array([(float(r["time [s]"]), float(r["bed_height [m]"]))
                           for r in rows_of(PROJECT + "/data/curves/wachem_2001/bed_height.csv")])
        time = np.arange(0, 20, 0.02)
        surface = 0.16 + 0.03 * np.sin(2 * np.pi * 2.5 * time)
        self.tables(bed_height="time [s],height_surface [m]\n" + "".join(f"{t},{h}\n" for t, h in zip(time, surface)))
        check = 'quantity = "{}"\nagainst = "wachem_2001/bed_height"\nmetric = "relative bias"\nlimit = 1'
        done = self.validate(self.study([check.format(q) for q in (
            "bed height", "bed height deviation", "bed height frequency")]), "--json")
        self.assertEqual(done.stderr, "")
        mean, deviation, frequency = json.loads(done.stdout)["checks"]
        span = np.diff(height[:, 0], prepend=np.nan)
        weights = np.nan_to_num((span + np.roll(span, -1)) / 2)
        weights[0], weights[-1] = span[1], span[-1]
        known = np.average(height[:, 1], weights=weights)
        self.assertAlmostEqual(mean["value"], abs(0.16 - known) / known, 2)
        self.assertAlmostEqual(deviation["value"], abs(0.03 / np.sqrt(2) / height[:, 1].std() - 1), 1)
        self.assertLess(frequency["value"], 0.5)
        self.assertGreater(frequency["hi"], frequency["value"])

    def test_a_bed_without_gas_is_judged_by_a_measured_voidage(self):
        """Mueller et al.: what the solids leave, here by 0.01 more than was measured."""
        measured = [(float(r["x [m]"]), float(r["voidage [-]"])) for r in rows_of(
            PROJECT + "/data/curves/mueller_2009/voidage.csv", **{"U [m/s]": "0.6", "height [m]": "0.0164"})]
        self.assertGreater(len(measured), 5)
        self.tables(lateral_profile="height [m],x [m],holdup [-],holdup_ci95 [-]\n" + "".join(
            f"0.0164,{x},{1 - e - 0.01},0.001\n" for x, e in measured))
        done = self.validate(self.study([
            'quantity = "lateral voidage"\nat = { height = 0.0164 }\nagainst = "mueller_2009/voidage?U=0.6"\n'
            'metric = "relative bias"\nlimit = 0.1']), "--json")
        (check,) = json.loads(done.stdout)["checks"]
        self.assertAlmostEqual(check["value"], 0.01 / np.mean([e for _, e in measured]), 9)
        self.assertEqual(check["verdict"], "holds")

    def test_gas_and_histories_of_another_program(self):
        rows = [(k / 10, 500 + 10 * (-1) ** k) for k in range(100)]
        self.tables(
            pressure_drop="time [s],pressure_drop [Pa]\n" + "".join(f"{t},{p}\n" for t, p in rows),
            gas_axial="z [m],voidage [-],velocity_z [m/s],temperature [K],pressure [Pa],slip_z [m/s]\n"
                      + "".join(f"{z / 10},0.9,2,{300 + z},{100 - z},1.5\n" for z in range(11)),
            gas_lateral="height [m],x [m],voidage [-]\n0.2,0.01,0.8\n0.2,0.02,0.9\n0.2,0.03,0.8\n",
            temperature="time [s],mean [K],std [K]\n" + "".join(f"{t},{350 - t},2\n" for t in range(10)),
            inventory="time [s],particles,solids_mass [kg]\n" + "".join(f"{t},10,{0.1 * t}\n" for t in range(10)))
        os.makedirs(self.folder + "/mine")
        with open(self.folder + "/mine/cool.csv", "w") as file:
            file.write("time [s],temperature [K]\n0.5,349.5\n8.5,341.5\n")
        ask = 'quantity = "{}"\nagainst = {}\nmetric = "{}"\nlimit = {}\n'
        checks = [ask.format("pressure drop", 500, "relative bias", 0.01),
                  ask.format("pressure drop deviation", 10, "relative bias", 0.05),
                  ask.format("axial voidage", 0.9, "max error", 1e-12),
                  ask.format("axial gas velocity", 2, "max error", 1e-12),
                  ask.format("axial slip velocity", 1.5, "max error", 1e-12),
                  ask.format("axial temperature", 305, "max error", 5.001),
                  ask.format("axial gas temperature", 305, "max error", 5.001),
                  ask.format("axial pressure", 95, "max error", 5.001),
                  ask.format("lateral voidage", 0.85, "max error", 0.0501) + "at = { height = 0.2 }",
                  ask.format("temperature history", '"cool"', "max error", 0.2),
                  ask.format("temperature spread", 2, "relative bias", 1e-9),
                  ask.format("inventory history", 0.45, "max error", 0.4501)]
        done = self.validate(self.study(checks, head='curves = ["mine"]\n[scene]\naverage = {}\n'), "--json")
        self.assertEqual(done.stderr, "")
        self.assertEqual([c["reason"] for c in json.loads(done.stdout)["checks"] if c["verdict"] != "holds"], [])

    def test_every_shipped_curve_says_where_it_comes_from(self):
        for folder, _, files in os.walk(PROJECT + "/data/curves"):
            for name in files:
                if name.endswith(".csv"):
                    with open(os.path.join(folder, name[:-4] + ".toml")) as file:
                        sidecar = file.read()
                    for key in ("title", "citation", "kind", "method", "by", "source", "licence", "redistribute",
                                "uncertainty_note"):
                        self.assertIn(f"\n{key} = ", "\n" + sidecar, name)

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
        with open(self.folder + "/mine.csv", "w") as file:
            file.write(points)
        again = bedscope("curves", "mine", "--curves", self.folder)
        self.assertEqual((again.returncode, again.stderr), (0, ""))
        self.assertEqual(bedscope("curves", "varas_2017/axial").returncode, 2)
        self.assertIn("assumed as for a digitised plot", bedscope("curves", "varas_2017/axial_holdup").stdout)
        self.assertIn("theory:bed weight", listed)
        self.assertIn("gas_density", bedscope("curves", "theory:bed weight").stdout)


if __name__ == "__main__":
    unittest.main()
