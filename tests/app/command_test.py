# SPDX-License-Identifier: BSD-3-Clause
"""`bedscope analyse` and `info` as a user meets them: files in, files, exit codes and one line out.

Usage: command_test.py BEDSCOPE [unittest arguments]. Exit code 77: numpy or scipy is missing.
"""

import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest

import judge  # exits with 77 where numpy or scipy is missing
import judge_cases
import numpy as np
from judge_cases import PROFILES, RUN, Dumps, scene, write_study
from running import PATIENCE, PROGRAM, Running


def read(path, mode="rb"):
    with open(path, mode) as file:
        return file.read()


def write(path, content):
    with open(path, "wb") as file:
        file.write(content if isinstance(content, bytes) else content.encode())


class Command(Running):
    def post(self, steps=range(0, 600, 100), count=60, name="post", seed=1, **options):
        dumps = Dumps(self.at(name), seed)
        for step in steps:
            dumps.write(step, dumps.particles(count, **options))
        return dumps

    def dump(self, step):
        return self.at("post", f"dump{step}.liggghts_run")

    def study(self, run=None, sections=None, **keys):
        return write_study(self.folder, scene(**keys), [RUN | (run or {})],
                           **(sections or {"profiles": PROFILES}))

    def tables(self, out=None):
        folder = os.path.join(out or self.out, "tables")
        return {name: read(os.path.join(folder, name)) for name in sorted(os.listdir(folder))}

    def rows(self, name, out=None):
        lines = read(os.path.join(out or self.out, "tables", name + ".csv"), "r").splitlines()
        return list(judge.csv.DictReader(lines))

    def summary(self, out=None):
        return json.loads(read(os.path.join(out or self.out, "summary.json")))["runs"]

    def fails(self, what, *words, more=()):
        """Exit code 2, one line on stderr with all these words, nothing written."""
        done = self.run_it("analyse", what, "-o", self.out, "--tables-only", *more)
        said = f"exit {done.returncode}, stderr: {done.stderr!r}, stdout: {done.stdout!r}"
        self.assertEqual(done.returncode, 2, said)
        self.assertEqual(done.stderr.count("\n"), 1, said)
        self.assertTrue(done.stderr.startswith("bedscope: "), said)
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertFalse(os.path.isdir(self.out) and os.listdir(self.out), "something was written")
        return done.stderr

    def edit(self, path, line, text):
        """Puts another text for line `line` (from 1); None takes the line out."""
        lines = read(path).split(b"\n")
        lines[line - 1 : line] = [] if text is None else [text.encode()]
        write(path, b"\n".join(lines))

    def columns(self, path):
        return read(path).split(b"\n")[8].decode().split()[2:]

    def cut(self, path, rows):
        lines = read(path).split(b"\n")
        write(path, b"\n".join(lines[: 9 + rows]) + b"\n" + lines[9 + rows][:7])


class OneStepInManyForms(Command):
    """tests/data/liggghts_parallel: one step of a run of two processes, in every form."""

    DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data", "liggghts_parallel")

    def study_of(self, columns, forms):
        text = "[scene]\ndensity = 2500\n"
        text += "domain = { min = [-0.05, -0.05, 0], max = [0.05, 0.05, 0.15] }\n"
        for form in forms:
            text += f'[[run]]\nlabel = "{form}"\nparticles = "{os.path.join(self.DATA, form)}"\n'
            text += f"time_step = 1e-5\n{columns if form.endswith('.bin') else ''}\n"
        path = self.at("forms.toml")
        write(path, text.encode())
        return path

    def test_inventory_is_the_same(self):
        forms = ("gather1000.bin", "split*.bin", "dump*", "sorted*", "par_1000.pvtp", "par_1000*",
                 "paru_1000.pvtu", "case_1000.vtm")
        self.analyse(self.study_of('columns = ["id", "type", "x", "y", "z", "radius"]', forms))
        rows = [row for row in self.rows("inventory") if row["type"] == "all"]
        self.assertEqual(len(rows), len(forms))
        for row in rows:
            self.assertEqual(row["particles"], "304")
            self.assertEqual(float(row["time [s]"]), 0.01)
            for name in ("solids_mass [kg]", "mean_height [m]"):  # text dumps hold six digits
                self.assertAlmostEqual(float(row[name]) / float(rows[0][name]), 1, delta=1e-6)

    def test_binary_dumps_need_names(self):
        self.fails(self.study_of("", ["gather1000.bin"]), "names no columns", "columns = [...]")
        self.fails(self.study_of('columns = ["id"]', ["gather1000.bin"]), "6 columns", "names 1")


class SameResults(Command):
    def test_threads_do_not_change_a_byte(self):
        self.post(range(0, 4000, 100), count=200, clumps=2, types=(1, 2), radii=[5e-4, 9e-4])
        study = self.study(mapping="exact", average="auto", species={"hot": "f_Temp[0] > 350"},
                           density={"1": 1000, "2": 3000})
        for threads in ("1", "2", "5"):
            self.analyse(study, "--threads", threads, out=self.at(threads))
        self.assertEqual(self.tables(self.at("1")), self.tables(self.at("2")))
        self.assertEqual(self.tables(self.at("1")), self.tables(self.at("5")))

    def test_names_of_files_do_not_matter(self):
        self.post()
        self.analyse(self.study(), out=self.at("a"))
        for number, step in enumerate((300, 0, 500, 100, 400, 200)):
            os.rename(self.dump(step), self.at("post", f"{'zyxwvu'[number]}.txt"))
        self.analyse(self.study({"particles": "post/*.txt"}), out=self.at("b"))
        self.assertEqual(self.tables(self.at("a")), self.tables(self.at("b")))

    def test_one_file_or_many(self):
        self.post()
        self.analyse(self.study(), out=self.at("a"))
        write(self.at("all.dump"), b"".join(read(self.dump(s)) for s in range(0, 600, 100)))
        self.analyse(self.study({"particles": "all.dump"}), out=self.at("b"))
        self.assertEqual(self.tables(self.at("a")), self.tables(self.at("b")))

    def test_crlf(self):
        self.post()
        self.analyse(self.study(), out=self.at("a"))
        for step in range(0, 600, 100):
            write(self.dump(step), read(self.dump(step)).replace(b"\n", b"\r\n"))
        self.analyse(self.study(), out=self.at("b"))
        self.assertEqual(self.tables(self.at("a")), self.tables(self.at("b")))

    def test_order_of_rows_changes_rounding_only(self):
        self.post()
        self.analyse(self.study(), out=self.at("a"))
        for step in range(0, 600, 100):
            lines = read(self.dump(step)).split(b"\n")
            write(self.dump(step), b"\n".join(lines[:9] + sorted(lines[9:-1]) + [b""]))
        self.analyse(self.study(), out=self.at("b"))
        for a, b in zip(self.rows("axial_profile", self.at("a")), self.rows("axial_profile", self.at("b"))):
            for key in set(a) - {"run", "type"}:
                x, y = float(a[key]), float(b[key])
                self.assertTrue(x == y or (x != x and y != y) or abs(x - y) < 1e-9 * max(1, abs(x)), (key, x, y))

    def test_one_run_under_two_labels(self):
        self.post()
        study = write_study(self.folder, scene(), [RUN | {"label": "a"}, RUN | {"label": "b"}], profiles=PROFILES)
        self.analyse(study)
        for name, content in self.tables().items():
            lines = content.decode().splitlines()[1:]
            a = [line[2:] for line in lines if line.startswith("a,")]
            b = [line[2:] for line in lines if line.startswith("b,")]
            self.assertEqual(a, b, name)
            self.assertEqual(len(a) + len(b), len(lines), name)

    def test_an_earlier_analysis_leaves_nothing_behind(self):
        self.post()
        self.analyse(self.study(sections={"temperature": {"from": 330.0, "to": 380.0}}))
        self.assertIn("temperature_pdf.csv", self.tables())
        self.analyse(self.study())
        self.assertNotIn("temperature_pdf.csv", self.tables())
        self.assertIn("temperature.csv", self.tables())


class Window(Command):
    def steps(self, **average):
        self.analyse(self.study(average=average))
        run = self.summary()[0]
        return run["snapshots"], round(run["from"] / 1e-5), round(run["to"] / 1e-5)

    def test_both_ends_belong_to_it(self):
        self.post()
        self.assertEqual(self.steps(**{"from": 0.001, "to": 0.004}), (4, 100, 400))
        self.assertEqual(self.steps(**{"from": 0.0010049}), (5, 100, 500))
        self.assertEqual(self.steps(**{"from": 0.0010051}), (4, 200, 500))
        self.assertEqual(self.steps(**{"to": 0.0039951}), (5, 0, 400))
        self.assertEqual(self.steps(**{"to": 0.0039949}), (4, 0, 300))

    def test_no_snapshot_in_it(self):
        self.post()
        self.fails(self.study(average={"from": 3.0, "to": 4.0}), "average", "a run", "3", "4", "0.005")

    def test_auto_begins_at_a_block_of_16_after_the_start(self):
        dumps = Dumps(self.at("post"), 5)
        for k in range(96):  # fills for 20 snapshots, then rests with noise
            count = int(50 + 150 * min(k / 20, 1) + 5 * dumps.rng.normal())
            dumps.write(100 * k, dumps.particles(count))
        self.analyse(self.study(average="auto"))
        run = self.summary()[0]
        first = round(run["from"] / 1e-3)
        self.assertEqual(first % 16, 0)
        self.assertTrue(16 <= first <= 48, first)
        self.assertEqual(run["snapshots"], 96 - first)
        self.assertFalse(any("not steady" in p for p in run["problems"]))
        # the tables are those of the window
        self.analyse(self.study(average={"from": run["from"]}), out=self.at("b"))
        same = ("axial_profile.csv", "lateral_profile.csv", "clusters.csv")
        for a, b in zip(self.rows("axial_profile"), self.rows("axial_profile", self.at("b"))):
            for key in ("holdup [-]", "velocity_z [m/s]", "mass_flux_z [kg/m2/s]"):
                x, y = float(a[key]), float(b[key])
                self.assertTrue(x != x and y != y or abs(x - y) <= 1e-9 * abs(y) + 1e-12, (same, x, y))

    def test_auto_of_a_few_snapshots_is_never_empty(self):
        for count in (1, 2, 5, 15, 16, 17, 20, 33):
            shutil.rmtree(self.at("post"), ignore_errors=True)
            self.post(range(0, 100 * count, 100), count=20)
            self.analyse(self.study(average="auto"))
            self.assertGreater(self.summary()[0]["snapshots"], 0)

    def test_auto_of_a_run_that_never_rests(self):
        dumps = Dumps(self.at("post"), 5)
        for k in range(64):
            dumps.write(100 * k, dumps.particles(20 + 5 * k))
        self.analyse(self.study(average="auto"))
        run = self.summary()[0]
        self.assertTrue(any("not steady" in p for p in run["problems"]), run["problems"])
        self.assertGreater(run["snapshots"], 0)


class Doubts(Command):
    """What looks plausible in every table and is wrong is said in `problems`."""

    def said(self, *words, **keys):
        self.analyse(self.study(**keys))
        return [p for p in self.summary()[0]["problems"] if all(word in p for word in words)]

    def test_nothing_of_a_good_run(self):
        self.post(range(0, 2400, 100))
        for word in ("missing", "lost", "packing", "metres"):
            self.assertEqual(self.said(word), [])

    def test_missing_snapshots(self):
        self.post([step for step in range(0, 2400, 100) if step not in (500, 600, 1400)])
        self.assertEqual(len(self.said("3 snapshots are missing", "400", "1500", "2 gaps")), 1)
        self.assertEqual(self.said("missing", average={"to": 0.004}), [])  # the window has none

    def test_particles_lost(self):
        dumps = self.post(range(0, 2400, 100), count=200)
        dumps.write(1200, dumps.particles(90))
        self.assertEqual(len(self.said("particles are lost: 200 at 0.011 s, 90 at 0.012 s")), 1)
        dumps.write(1200, dumps.particles(0))
        self.assertEqual(len(self.said("particles are lost: 200 at 0.011 s, 0 at 0.012 s")), 1)

    def test_denser_than_any_packing(self):
        self.post(range(0, 2400, 100), count=200, radii=[0.003])  # 200 spheres: 0.18 of the domain
        self.assertEqual(self.said("densest packing"), [])
        self.post(range(0, 2400, 100), count=200, radii=[0.006])  # 1.4 of it
        self.assertEqual(len(self.said("densest packing")), 1)

    def test_a_domain_in_millimetres(self):
        self.post()
        domain = {"min": [0, 0, 0], "max": [70, 6, 300]}
        self.assertEqual(len(self.said("70 m wide in x", "metres", domain=domain, cell=[2.5, 2.5])), 1)


class Repeated(Command):
    def setUp(self):
        super().setUp()
        dumps = self.post()
        dumps.write(300, dumps.particles(33), name="dumpx300.liggghts_run")

    def test_is_an_error_that_names_both_places(self):
        self.fails(self.study(), "300", "dump300.liggghts_run", "dumpx300.liggghts_run")

    def test_first_and_last(self):
        counts = {}
        for which in ("first", "last"):
            self.analyse(self.study({"repeated": which}))
            counts[which] = [r["particles"] for r in self.rows("inventory") if r["type"] == "all"]
        self.assertEqual(sorted(c[3] for c in counts.values()), ["33", "60"])
        for c in counts.values():
            self.assertEqual(len(c), 6)

    def test_first_and_last_in_one_file(self):
        parts = [read(self.dump(s)) for s in (0, 100, 200, 300, 400, 500)]
        parts.append(read(self.at("post", "dumpx300.liggghts_run")))
        write(self.at("all.dump"), b"".join(parts))
        for which, expected in (("first", "60"), ("last", "33")):
            self.analyse(self.study({"repeated": which, "particles": "all.dump"}))
            counts = [r["particles"] for r in self.rows("inventory") if r["type"] == "all"]
            self.assertEqual((len(counts), counts[3]), (6, expected))

    def test_other_words_are_refused(self):
        self.fails(self.study({"repeated": "newest"}), "repeated", "first", "last", "newest")


class BarePath(Command):
    def test_folder(self):
        self.post()
        self.analyse(self.at("post"))
        run = self.summary()[0]
        self.assertTrue(any("domain assumed" in p for p in run["problems"]))
        self.assertTrue(all(r["solids_mass [kg]"] == "nan" for r in self.rows("inventory")))
        self.assertTrue(all(r["mass_flux_z [kg/m2/s]"] == "nan" for r in self.rows("axial_profile")))
        self.assertTrue(all(r["time [s]"] == "nan" for r in self.rows("inventory")))
        self.assertTrue(any(float(r["holdup [-]"]) > 0 for r in self.rows("axial_profile")))
        self.assertTrue(any(r["velocity_z [m/s]"] != "nan" for r in self.rows("axial_profile")))
        self.assertIsNone(run["from"])
        self.assertIsNone(run["inventory_kg"])

    def test_tilted_box(self):
        """The domain is the box around it; a sphere that a side cuts is not wrapped to the other, which lies elsewhere."""
        write(self.at("tilted.dump"), "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz pp pp ff\n"
              "0 0.15 0.05\n0 0.1 0\n0 0.2 0\nITEM: ATOMS id x y z radius \n1 0.0005 0.05 0.1 0.001 \n")
        self.analyse(self.at("tilted.dump"))
        self.assertTrue(any("tilted" in p for p in self.summary()[0]["problems"]))
        r, cap = 1e-3, 5e-4
        inside = np.pi * (4 / 3 * r**3 - cap**2 * (3 * r - cap) / 3)
        mean = np.mean([float(r["holdup [-]"]) for r in self.rows("axial_profile") if r["type"] == "all"])
        self.assertAlmostEqual(mean / (inside / (0.15 * 0.1 * 0.2)), 1, places=9)

    LOG = """LIGGGHTS (Version LIGGGHTS-PUBLIC 3.8.0)
variable dt equal 2e-5
timestep ${dt}
timestep 2e-05
fix pts1 all particletemplate/sphere 15485863 atom_type 1 density constant 2000 radius constant 0.0006
"""

    def check_log(self, place):
        self.post()
        write(self.at(*place), self.LOG)
        self.analyse(self.at("post"))
        rows = [r for r in self.rows("inventory") if r["type"] == "all"]
        self.assertEqual([float(r["time [s]"]) for r in rows], [s * 2e-5 for s in range(0, 600, 100)])
        mass = 60 * 2000 * 4 / 3 * np.pi * 6e-4**3
        for r in rows:
            self.assertAlmostEqual(float(r["solids_mass [kg]"]) / mass, 1, 12)

    def test_log_beside(self):
        self.check_log(("post", "log.liggghts"))

    def test_log_one_folder_up(self):
        self.check_log(("log.liggghts",))

    def test_the_study_wins_over_the_log(self):
        self.post()
        write(self.at("log.liggghts"), self.LOG)
        self.analyse(self.study({"time_step": 1e-3}, density=1000))
        rows = [r for r in self.rows("inventory") if r["type"] == "all"]
        self.assertEqual(float(rows[1]["time [s]"]), 0.1)
        self.assertAlmostEqual(float(rows[1]["solids_mass [kg]"]) / (60 * 1000 * 4 / 3 * np.pi * 6e-4**3), 1, 12)

    def test_file_and_pattern(self):
        self.post()
        self.analyse(self.dump(300))
        self.assertEqual(self.summary()[0]["snapshots"], 1)
        self.analyse(self.at("post", "dump[1-3]*"), out=self.at("b"))
        self.assertEqual(len(self.rows("cluster_occurrence", self.at("b"))), 3)

    def test_json(self):
        self.post()
        done = self.run_it("analyse", self.at("post"), "-o", self.out, "--tables-only", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["runs"][0]["label"], self.summary()[0]["label"])
        for key in ("label", "snapshots", "from", "to", "mean_holdup", "inventory_kg", "mean_occurrence",
                    "independent_samples", "outside_fraction", "bytes_read", "seconds", "problems"):
            self.assertIn(key, self.summary()[0])
        self.assertEqual(self.summary()[0]["bytes_read"],
                         sum(os.path.getsize(self.dump(s)) for s in range(0, 600, 100)))


class BadInput(Command):
    def test_a_misspelt_command_names_the_nearest(self):
        done = self.run_it("analyze", "post")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, 'bedscope: no command "analyze"; the nearest known one is "analyse"\n')

    def test_unknown_keys_name_the_nearest(self):
        self.post()
        for text, wrong, right in (("[scene]\ncel = [1, 1]", "cel", "cell"),
                                   ("[scene]\ndensty = 1", "densty", "density"),
                                   ("[profile]\nband = 1", "profile", "profiles"),
                                   ("[clusters]\nmin_aera = 1", "min_aera", "min_area"),
                                   ("[[run]]\nparticle = 'post'", "particle", "particles"),
                                   ("[scene]\naverage = { form = 1.0 }", "form", "from"),
                                   ("[scene]\ndomain = { min = [0,0,0], max = [1,1,1], mx = 1 }", "mx", "max")):
            path = self.at("wrong.toml")
            rest = "" if "[[run]]" in text else "\n[[run]]\nparticles = 'post'\ntime_step = 1e-5\n"
            write(path, text + rest + ("\nparticles = 'post'" if "[[run]]" in text else ""))
            error = self.fails(path, "wrong.toml", "line", wrong)
            self.assertRegex(error, rf"\b{right}\b")

    def test_toml_that_does_not_parse(self):
        write(self.at("a.toml"), "[scene\nup = 1\n")
        self.fails(self.at("a.toml"), "a.toml", "line 1")

    def test_text_with_a_nul_character(self):
        self.post()  # the system would open what stands before it
        write(self.at("a.toml"), '[[run]]\nparticles = "post\\u0000x"\ntime_step = 1e-5\n')
        self.fails(self.at("a.toml"), "a.toml", "line 2", "NUL")

    def test_empty_paths(self):
        self.fails("", "empty path")
        for key in ("particles", "tables"):
            write(self.at("a.toml"), f"[[run]]\n{key} = ''\ntime_step = 1e-5\n")
            self.fails(self.at("a.toml"), "a.toml", "line 2", f"run.{key}")

    def test_study_that_is_not_there(self):
        self.fails(self.at("nothing.toml"), "nothing.toml")

    def test_path_that_is_not_there(self):
        self.fails(self.at("nothing"), "nothing")

    def test_pipes_devices_and_folders(self):
        """None is waited for, or read without end."""
        self.post()
        os.mkfifo(self.at("pipe.toml"))
        os.mkdir(self.at("folder.toml"))
        os.symlink("/dev/zero", self.at("zero.toml"))
        os.symlink("loop.toml", self.at("loop.toml"))
        for name in ("pipe", "folder", "zero", "loop"):
            path = self.at(name + ".toml")
            self.fails(path, path)
            for command in ("validate", "digitise"):
                with self.subTest(command=command, path=path):
                    done = self.run_it(command, path, "-o", self.out)
                    self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
                    self.assertIn(path, done.stderr)
                    self.assertFalse(os.path.exists(self.out))

    def test_dumps_that_are_pipes_or_devices(self):
        self.post()
        os.mkfifo(self.at("post", "dump50.liggghts_run"))
        os.symlink("/dev/zero", self.at("post", "dump60.liggghts_run"))
        self.fails(self.study(), "dump50.liggghts_run: not a regular file")  # matches dump*
        self.analyse(self.study(run={"particles": self.at("post")}))  # of a folder they are none
        for name in ("dump50", "dump60"):
            path = self.at("post", name + ".liggghts_run")
            done = self.run_it("info", path)
            self.assertEqual((done.returncode, done.stderr), (2, f"bedscope: {path}: not a regular file\n"))

    def test_study_without_a_run(self):
        write(self.at("a.toml"), "title = 'x'\n")
        self.fails(self.at("a.toml"), "a.toml", "[[run]]")

    def test_values_of_a_wrong_kind(self):
        self.post()
        for keys, words in (({"up": "w"}, ("up", '"w"')), ({"cell": "small"}, ("cell",)),
                            ({"cell": [0.0, 0.0025]}, ("cell", "0")), ({"cell": [0.0025]}, ("cell",)),
                            ({"cell": [-1.0, 0.0025]}, ("cell", "-1")),
                            ({"up": "x", "lateral": "x"}, ("up", "lateral")), ({"mapping": "center"}, ("mapping", "centre", "center")),
                            ({"density": -1}, ("density", "-1")), ({"average": "automatic"}, ("average", "auto")),
                            ({"average": {"from": 2.0, "to": 1.0}}, ("average",)),
                            ({"domain": {"min": [0, 0, 0], "max": [0.07, 0, 0.3]}}, ("domain", "y")),
                            ({"domain": {"min": [0, 0, 0]}}, ("domain", "max")),
                            ({"periodic": ["w"]}, ("periodic", "w")), ({"species": {"a": "q"}}, ("species", "q"))):
            with self.subTest(keys=keys):
                self.fails(self.study(**keys), "study.toml", *words)

    def test_a_grid_beyond_all_memory(self):
        self.post()
        self.fails(self.study(cell=[1e-9, 1e-9]), "cell", "1e-09")

    def test_density_table_without_a_type_that_occurs(self):
        self.post(types=(1, 2), radii=[5e-4, 5e-4])
        self.fails(self.study(density={"1": 1000}), "density", "2")

    def test_height_outside(self):
        self.post()
        self.fails(self.study(sections={"profiles": {"heights": [0.5]}}), "heights", "0.5", "0.3")

    def test_missing_radius_names_the_key(self):
        dumps = Dumps(self.at("post"), 1)
        dumps.write(0, dumps.particles(50), leave=("radius",))
        self.fails(self.study(), "radius", "a run")

    def test_missing_positions(self):
        dumps = Dumps(self.at("post"), 1)
        dumps.write(0, dumps.particles(50), leave=("x",))
        self.fails(self.study(), "dump0.liggghts_run", "x")

    def test_missing_time_step_names_the_key(self):
        self.post()
        path = self.study()
        write(path, re.sub(rb"time_step.*\n", b"", read(path)))
        self.fails(path, "time_step", "a run")

    def test_rule_on_a_column_that_is_not_there(self):
        self.post()
        self.fails(self.study(species={"wet": "moisture > 0"}), "moisture")

    def test_column_that_vanishes(self):
        for gone in ("radius", "vz", "y", "type", "f_Temp[0]"):
            with self.subTest(gone=gone):
                shutil.rmtree(self.at("post"), ignore_errors=True)
                dumps = self.post()
                dumps.write(300, dumps.particles(50), leave=(gone,))
                self.fails(self.study(sections={"temperature": {"from": 330.0, "to": 380.0}}),
                           "dump300.liggghts_run", gone)

    def test_column_that_nobody_needs_may_vanish(self):
        dumps = self.post()
        dumps.write(300, dumps.particles(50), leave=("fx", "omegaz"))
        self.analyse(self.study())

    def test_empty_file_folder_without_dumps_and_mixed_forms(self):
        os.makedirs(self.at("post"))
        self.fails(self.at("post"), "post")
        write(self.dump(0), b"")
        self.fails(self.dump(0), "dump0", "empty")
        write(self.dump(0), b"hello\nworld\n")
        self.fails(self.dump(0), "dump0")
        self.post()
        write(self.at("post", "particles_100.vtk"),
              "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n0.01 0.002 0.1\n"
              "VERTICES 1 2\n1 0\nPOINT_DATA 1\nSCALARS radius float 1\nLOOKUP_TABLE default\n0.001\n")
        self.fails(self.at("post"), "vtk")

    def test_truncated_last_snapshot_is_left_out(self):
        self.post()
        whole = self.at("whole")
        self.post(range(0, 500, 100), name="whole")
        self.analyse(self.study({"particles": "whole/dump*"}), out=self.at("a"))
        self.cut(self.dump(500), 30)
        self.analyse(self.study())
        self.assertEqual(self.tables(self.at("a")), self.tables(), whole)
        problems = " ".join(self.summary()[0]["problems"])
        self.assertIn("dump500.liggghts_run", problems)

    def test_truncated_earlier_snapshot(self):
        self.post()
        self.cut(self.dump(200), 30)
        self.fails(self.study(), "dump200.liggghts_run")

    def test_truncated_in_one_file(self):
        self.post()
        parts = [read(self.dump(s)) for s in range(0, 600, 100)]
        write(self.at("all.dump"), b"".join(parts[:5]) + parts[5][: len(parts[5]) // 2])
        self.analyse(self.study({"particles": "all.dump"}))
        self.assertEqual(len(self.rows("cluster_occurrence")), 5)
        self.assertIn("all.dump", " ".join(self.summary()[0]["problems"]))
        shutil.rmtree(self.out)
        write(self.at("all.dump"), b"".join(parts[:2]) + parts[2][: len(parts[2]) // 2] + parts[3])
        self.fails(self.study({"particles": "all.dump"}), "all.dump", "line")

    def test_cut_anywhere(self):
        """A dump that a killed run leaves may end at any byte of its header or its rows."""
        self.post([0, 100], count=3)
        first, second = read(self.dump(0)), read(self.dump(100))
        header = second.index(b"ITEM: ATOMS") + 140
        places = [*range(1, header), *range(header, len(second) - 2, 17), len(second) - 3]
        cuts = [(one_file, place) for one_file in (False, True) for place in places]
        wrong = []
        for begin in range(0, len(cuts), 64):  # runs of a study, as starting the program takes longer than a cut
            batch, runs = cuts[begin : begin + 64], []
            for one_file, place in batch:
                name = f"{'one' if one_file else 'two'}{place}"
                os.mkdir(self.at(name))
                cut = second[:place]
                write(self.at(name, "dump0.liggghts_run"), first + cut if one_file else first)
                if not one_file:
                    write(self.at(name, "dump100.liggghts_run"), cut)
                runs.append(RUN | {"label": name, "particles": f"{name}/dump*.liggghts_run"})
            done = self.run_it("analyse", write_study(self.folder, scene(), runs, profiles=PROFILES), "-o", self.out,
                               "--tables-only", "--quiet", "--threads", "1")
            if done.returncode != 0:  # the line names the place
                wrong.append((batch[0], batch[-1], done.stderr.strip()[-60:]))
                continue
            for (one_file, place), said in zip(batch, self.summary(), strict=True):
                if said["snapshots"] != 1 or not said["problems"]:
                    wrong.append((one_file, place, second[:place][-12:]))
        self.assertEqual(wrong[:5], [], f"{len(wrong)} of {len(cuts)} cuts")

    def test_nothing_but_a_truncated_snapshot(self):
        self.post([0])
        self.cut(self.dump(0), 30)
        self.fails(self.study(), "dump0.liggghts_run")

    def test_declared_counts(self):
        for count, words in (("1099511627776", ("1099511627776",)), ("99999999999999999999999", ()),
                             ("-5", ("-5",)), ("6e1", ("6e1",))):
            with self.subTest(count=count):
                self.post()
                self.edit(self.dump(200), 4, count)
                start = time.monotonic()
                self.fails(self.study(), "dump200.liggghts_run", "line", *words)
                self.assertLess(time.monotonic() - start, 30)

    def test_particles_that_are_not_finite_are_counted(self):
        self.post()
        names = self.columns(self.dump(200))
        lines = read(self.dump(200)).decode().split("\n")
        for row, (column, value) in enumerate((("x", "nan"), ("z", "inf"), ("y", "-nan"), ("vz", "nan"))):
            values = lines[9 + row].split()
            values[names.index(column)] = value
            lines[9 + row] = " ".join(values) + " "
        write(self.dump(200), "\n".join(lines))
        self.analyse(self.study())
        row = [r for r in self.rows("inventory") if r["type"] == "all"][2]
        self.assertEqual(row["particles"], "56")
        self.assertTrue(float(row["holdup [-]"]) > 0)
        problems = " ".join(self.summary()[0]["problems"])
        self.assertIn("4 particles", problems)
        self.assertIn("dump200.liggghts_run", problems)

    def test_radii_that_are_none(self):
        self.post()
        names = self.columns(self.dump(200))
        lines = read(self.dump(200)).decode().split("\n")
        for row, value in enumerate(("0", "-0.001")):
            values = lines[9 + row].split()
            values[names.index("radius")] = value
            lines[9 + row] = " ".join(values) + " "
        write(self.dump(200), "\n".join(lines))
        self.analyse(self.study())
        rows = [r for r in self.rows("inventory") if r["type"] == "all"]
        self.assertAlmostEqual(float(rows[2]["holdup [-]"]) / float(rows[1]["holdup [-]"]), 58 / 60, 12)
        self.assertIn("radius", " ".join(self.summary()[0]["problems"]))

    def test_duplicate_ids(self):
        self.post()
        names = self.columns(self.dump(0))
        lines = read(self.dump(0)).decode().split("\n")
        a, b = lines[9].split(), lines[10].split()
        b[names.index("id")] = a[names.index("id")]
        lines[10] = " ".join(b) + " "
        write(self.dump(0), "\n".join(lines))
        done = self.run_it("analyse", self.study(), "-o", self.out, "--tables-only", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("id", " ".join(self.summary()[0]["problems"]))
        info = json.loads(self.run_it("info", self.at("post"), "--json", "--full").stdout)
        self.assertIn("id", " ".join(info["problems"]))

    def test_rows_that_are_ragged_or_no_numbers(self):
        for line, text in ((12, "1 2 3"), (12, "1 " * 40), (12, "x " * 13), (12, "")):
            with self.subTest(text=text):
                self.post()
                self.edit(self.dump(200), line, text)
                self.fails(self.study(), "dump200.liggghts_run", "line")

    def test_output_folder_that_cannot_be_written(self):
        self.post()
        write(self.at("file"), b"")
        done = self.run_it("analyse", self.study(), "-o", self.at("file", "out"), "--tables-only")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn(self.at("file"), done.stderr)

    def test_usage(self):
        for arguments in ([], ["analyze"], ["analyse"], ["analyse", "x", "--thread", "2"],
                          ["analyse", "x", "--threads", "0"], ["analyse", "x", "--threads", "a\n\x1b[31m"], ["info"],
                          ["info", "x", "y"]):
            with self.subTest(arguments=arguments):
                done = self.run_it(*arguments)
                self.assertEqual((done.returncode, done.stderr.count("\n"), done.stdout), (2, 1, ""),
                                 done.stderr)

    def test_two_labels_alike(self):
        self.post()
        study = write_study(self.folder, scene(), [RUN, RUN])
        self.fails(study, "label", "a run")


class Info(Command):
    def test_json(self):
        self.post(types=(1, 4), radii=[5e-4, 9e-4])
        info = json.loads(self.run_it("info", self.at("post"), "--json").stdout)
        self.assertEqual(info["snapshots"], 6)
        self.assertEqual(info["steps"], list(range(0, 600, 100)))
        self.assertEqual(info["particles"], {"min": 60, "max": 60})
        self.assertEqual(info["types"], [1, 4])
        self.assertEqual(info["radius"], {"min": 5e-4, "max": 9e-4})
        self.assertEqual(info["problems"], [])
        self.assertEqual(info["columns"], self.columns(self.dump(0)))
        snapshots = judge.read_run(self.at("post"))
        for k, n in enumerate("xyz"):
            values = np.concatenate([s["columns"][n] for s in snapshots])
            self.assertEqual((info["bounds"]["min"][k], info["bounds"]["max"][k]), (values.min(), values.max()))

    def test_no_radius(self):
        dumps = Dumps(self.at("post"), 1)
        dumps.write(0, dumps.particles(50), leave=("radius",))
        done = self.run_it("info", self.at("post"), "--json")
        self.assertEqual(done.returncode, 0)
        self.assertIsNone(json.loads(done.stdout)["radius"])

    def test_binary_without_names(self):
        dump = os.path.join(os.path.dirname(__file__), "../data/liggghts_parallel/gather1000.bin")
        info = json.loads(self.run_it("info", dump, "--json").stdout)
        self.assertEqual((info["snapshots"], info["steps"], info["columns"][0]), (1, [1000], "column 1"))
        self.assertIsNone(info["inventory"])
        self.assertIn("columns = [...]", info["analyse"]["stops"])
        study = self.run_it("info", dump, "--study")
        self.assertEqual((study.returncode, "columns = [...]" in study.stderr), (2, True))


class Follow(Command):
    def start(self, study):
        process = subprocess.Popen(
            [PROGRAM, "analyse", study, "-o", self.out, "--tables-only", "--follow", "--interval", "0.05"],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(lambda: process.poll() is None and process.kill())
        self.addCleanup(process.stderr.close)
        return process

    def wait_for(self, process, snapshots):
        until = time.monotonic() + PATIENCE
        while time.monotonic() < until:
            self.assertIsNone(process.poll(), "it ended by itself")
            try:
                if len(self.rows("cluster_occurrence")) == snapshots and self.summary()[0]["label"]:
                    return
            except FileNotFoundError:
                pass
            time.sleep(0.02)
        self.fail(f"not {snapshots} snapshots in {PATIENCE} s")

    def end(self, process, signal_number=signal.SIGINT):
        process.send_signal(signal_number)
        self.assertEqual(process.wait(PATIENCE), 0)
        self.assertEqual(process.stderr.read(), "")

    def check(self, study_keys, one_file=False, window_is_open=True):
        self.post(range(0, 4000, 100), name="all", count=50, types=(1, 2), radii=[5e-4, 9e-4])
        parts = {s: read(self.at("all", f"dump{s}.liggghts_run")) for s in range(0, 4000, 100)}
        os.makedirs(self.at("post"))
        study = self.study(**study_keys)

        def add(step, content, mode="wb"):
            path = self.at("post", "dump.liggghts_run") if one_file else self.dump(step)
            with open(path, "ab" if one_file else mode) as file:
                file.write(content)

        process = self.start(study)
        time.sleep(0.2)
        add(0, parts[0][:50])  # the first dump is being written
        time.sleep(0.2)
        add(0, parts[0][50:], "ab")
        if window_is_open:
            self.wait_for(process, 1)
        for step in range(100, 2000, 100):
            add(step, parts[step])
        self.wait_for(process, 20)
        add(2000, parts[2000][:1500])
        time.sleep(0.3)
        self.assertIsNone(process.poll(), "a half-written dump ended it")
        self.assertEqual(len(self.rows("cluster_occurrence")), 20)
        add(2000, parts[2000][1500:], "ab")
        self.wait_for(process, 21)
        for step in range(2100, 4000, 100):
            add(step, parts[step])
            time.sleep(0.03)
        self.wait_for(process, 40)
        time.sleep(0.3)
        self.end(process)
        self.analyse(study, out=self.at("fresh"))
        self.assertEqual(self.tables(), self.tables(self.at("fresh")))
        followed, fresh = self.summary()[0], self.summary(self.at("fresh"))[0]
        for key in set(fresh) - {"seconds", "bytes_read", "problems"}:
            self.assertEqual(followed[key], fresh[key], key)
        self.assertEqual(followed["problems"], fresh["problems"])

    def test_equals_a_fresh_run(self):
        self.check({"mapping": "exact", "density": {"1": 1000, "2": 3000}})

    def test_equals_a_fresh_run_with_auto(self):
        self.check({"average": "auto"})

    def test_equals_a_fresh_run_with_a_window(self):
        self.check({"average": {"from": 0.0049, "to": 0.03}}, window_is_open=False)

    def test_equals_a_fresh_run_of_one_growing_file(self):
        self.check({}, one_file=True)

    def test_waits_for_the_window(self):
        self.post([0, 100])
        process = self.start(self.study(average={"from": 0.0019}))
        time.sleep(0.5)
        self.assertIsNone(process.poll(), "it ended before the simulation came to the window")
        self.post([200, 300])
        self.wait_for(process, 4)
        self.assertEqual(self.summary()[0]["snapshots"], 2)
        self.end(process)

    def test_a_snapshot_that_comes_late(self):
        self.post(range(0, 1000, 100))
        late = read(self.dump(300))
        os.remove(self.dump(300))
        study = self.study()
        process = self.start(study)
        self.wait_for(process, 9)
        write(self.dump(300), late)
        self.wait_for(process, 10)
        self.end(process, signal.SIGTERM)
        self.analyse(study, out=self.at("fresh"))
        self.assertEqual(self.tables(), self.tables(self.at("fresh")))

    def test_a_type_that_comes_late(self):
        self.post([0, 100])
        study = self.study(density={"1": 1000, "2": 3000})
        process = self.start(study)
        self.wait_for(process, 2)
        dumps = Dumps(self.at("post"), 9)
        for step in (200, 300):
            dumps.write(step, dumps.particles(50, types=(1, 2), radii=[5e-4, 9e-4]))
            self.wait_for(process, step // 100 + 1)
        self.end(process)
        self.analyse(study, out=self.at("fresh"))
        self.assertEqual(self.tables(), self.tables(self.at("fresh")))

    def test_bad_input_ends_it(self):
        self.post([0, 100])
        process = self.start(self.study())
        self.wait_for(process, 2)
        dumps = Dumps(self.at("post"), 9)
        dumps.write(200, dumps.particles(50), leave=("radius",))
        self.assertEqual(process.wait(PATIENCE), 2)
        error = process.stderr.read()
        self.assertEqual(error.count("\n"), 1, error)
        self.assertIn("dump200.liggghts_run", error)


class Files(Command):
    def tree(self, folder):
        found = {}
        for place, _, names in os.walk(folder):
            for name in names:
                path = os.path.join(place, name)
                found[os.path.relpath(path, folder)] = read(path)
        return found


class Resume(Files):
    """A second analysis reads what is new; whatever it finds, results are those of a fresh one."""

    def results(self, folder):
        """All files that are results, the summary without what tells of the work."""
        tree = {name: content for name, content in self.tree(folder).items()
                if not name.startswith(("resume/", "index/"))}
        summary = json.loads(tree["summary.json"])
        for run in summary["runs"]:
            for key in ("seconds", "bytes_read", "snapshots_kept"):
                del run[key]
        return tree | {"summary.json": summary}

    def again(self, study, *more, draw=False):
        """Analyses into the same folder and into a new one; how many snapshots each run kept."""
        more += ("--threads", "2") if draw else ("--tables-only",)
        fresh = self.at("fresh")
        shutil.rmtree(fresh, ignore_errors=True)
        for out, options in ((self.out, more), (fresh, () if draw else more[-1:])):
            done = self.run_it("analyse", study, "-o", out, *options)
            self.assertEqual(done.returncode, 0, done.stderr)
            if out == self.out:
                self.said = done.stderr
        a, b = self.results(self.out), self.results(fresh)
        self.assertEqual(sorted(a), sorted(b))
        for name in a:
            self.assertTrue(a[name] == b[name], name)
        return [run["snapshots_kept"] for run in self.summary()]

    def test_two_runs_with_figures(self):
        self.post(range(0, 1000, 100), types=(1, 2), radii=[5e-4, 9e-4])
        other = self.post(range(0, 500, 100), name="other", seed=2)
        study = write_study(self.folder, scene(density={"1": 1000, "2": 3000}),
                            [RUN | {"label": "a"}, RUN | {"label": "b", "particles": "other"}],
                            profiles=PROFILES)
        self.assertEqual(self.again(study, draw=True), [0, 0])
        other.write(500, other.particles(60))
        self.assertEqual(self.again(study, draw=True), [10, 4])
        self.assertEqual(self.said, "")
        self.assertEqual(self.again(study, "--fresh", draw=True), [0, 0])
        self.assertEqual(self.said, "")

    def test_one_file_has_an_index(self):
        self.post(range(0, 1000, 100), count=200)
        parts = [read(self.dump(s)) for s in range(0, 1000, 100)]
        write(self.at("all.dump"), b"".join(parts[:6]) + parts[6][:3000])
        study = self.study({"particles": "all.dump"})
        self.assertEqual(self.again(study), [0])
        self.assertEqual(len(os.listdir(os.path.join(self.out, "index"))), 1)
        write(self.at("all.dump"), b"".join(parts))
        self.assertEqual(self.again(study), [5], "rewritten, but what was read is in it unchanged")
        with open(self.at("all.dump"), "ab") as file:
            file.write(read(self.dump(900)).replace(b"TIMESTEP\n900", b"TIMESTEP\n1000"))
        self.assertEqual(self.again(study), [9])
        for name in os.listdir(os.path.join(self.out, "index")):
            write(os.path.join(self.out, "index", name), b"bedscope index")
        self.assertEqual(self.again(study), [11])

    def test_what_begins_anew_is_said(self):
        self.post()
        study = self.study()
        self.again(study)
        self.edit(self.dump(200), 10, read(self.dump(200)).split(b"\n")[10].decode())
        self.again(study)
        self.assertIn("dump200.liggghts_run", self.said)
        self.assertEqual(self.said.count("\n"), 1, self.said)
        write(os.path.join(self.out, "resume", "run_1.state"), b"bedscope")
        self.assertEqual(self.again(study), [0])
        self.assertIn("run_1.state", self.said)

    def test_results_of_a_failed_analysis_stay_as_they_were(self):
        self.post()
        study = self.study()
        self.again(study)
        before = self.tree(self.out)
        self.post([600], name="post", seed=3)
        self.edit(self.dump(300), 12, "1 2 3")
        done = self.run_it("analyse", study, "-o", self.out)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(self.tree(self.out), before)

    def test_files_of_others_stay(self):
        self.post()
        study = self.study(sections={"temperature": {"from": 330.0, "to": 380.0}})
        self.again(study, draw=True)
        for name in ("tables/mine.txt", "figures/mine.svg", "results.mine", "notes"):
            write(os.path.join(self.out, name), name)
        self.analyse(self.study())
        for name in ("tables/mine.txt", "figures/mine.svg", "results.mine", "notes"):
            self.assertEqual(read(os.path.join(self.out, name)), name.encode())
        self.assertNotIn("temperature_pdf.csv", self.tables())

    def test_follow_goes_on(self):
        self.post(range(0, 1000, 100))
        study = self.study()
        self.analyse(study)
        self.post(range(1000, 1200, 100), seed=4)
        process = subprocess.Popen([PROGRAM, "analyse", study, "-o", self.out, "--tables-only", "--follow",
                                    "--interval", "0.05"], stdout=subprocess.DEVNULL)
        self.addCleanup(lambda: process.poll() is None and process.kill())
        until = time.monotonic() + PATIENCE
        while len(self.rows("cluster_occurrence")) < 12 and time.monotonic() < until:
            time.sleep(0.02)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(PATIENCE), 0)
        self.assertEqual(self.summary()[0]["snapshots_kept"], 9)
        self.analyse(study, out=self.at("other"))
        self.assertEqual(self.tables(), self.tables(self.at("other")))
        self.analyse(study)
        self.assertEqual(self.summary()[0]["snapshots_kept"], 12)
        self.assertNotIn(".part", os.listdir(self.out))


class FullDisk(Files):
    """A write that fails: one line, exit code 2, and the folder as it was."""

    VARAS = os.path.join(os.path.dirname(os.path.abspath(__file__)),
                         "../../cases/validation/varas_2017/study.toml")

    def limited(self, size, *arguments, **options):
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
        return self.run_it(*arguments, preexec_fn=limit, **options)

    def refused(self, done, *words):
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def sizes(self, tree):
        """Limits at which one file or another is the first that does not fit."""
        sizes = sorted({len(content) for content in tree.values()})
        return [0] + [size - 1 for size in sizes if size > 9000][-1::-4]

    def test_each_file_that_does_not_fit(self):
        self.post()
        study = self.study()
        self.run_it("analyse", study, "-o", self.at("whole"))
        whole = self.tree(self.at("whole"))
        for size in self.sizes(whole):
            with self.subTest(size=size):
                new, old = self.at(f"new{size}"), self.at(f"old{size}")
                shutil.copytree(self.at("whole"), old)
                for out in (new, old):
                    done = self.limited(size, "analyse", study, "-o", out, "--fresh")
                    if done.returncode == 0:  # all but what only serves the next analysis
                        self.assertIn("resume/run_1.state", done.stderr)
                    else:
                        self.refused(done, out)
                names = set(self.tree(new)) | {"resume/run_1.state"}
                self.assertTrue(not os.path.exists(new) or names == set(whole), names)
                if done.returncode != 0:
                    self.assertTrue(self.tree(old) == whole)
                self.assertNotIn(".part", os.listdir(old))

    def test_gnuplot_that_meets_the_end(self):
        self.post(range(0, 1200, 100), count=300)
        study = self.study()
        self.run_it("analyse", study, "-o", self.at("whole"))
        figures = {name: content for name, content in self.tree(self.at("whole")).items()
                   if name.endswith((".png", ".svg"))}
        os.makedirs(self.at("bin"))
        path = self.at("bin", "gnuplot")
        real = shutil.which("gnuplot")
        for size in self.sizes(figures)[:: 2]:
            with self.subTest(size=size):
                write(path, f"#!/bin/bash\nulimit -f {size // 1024}\ntrap '' XFSZ\nexec {real} \"$@\"\n")
                os.chmod(path, 0o755)
                done = self.run_it("analyse", study, "-o", self.out, "--quiet",
                                   env=os.environ | {"PATH": self.at("bin") + ":" + os.environ["PATH"]})
                self.refused(done, self.out)
                self.assertFalse(os.path.exists(self.out))

    def test_folder_that_vanishes(self):
        self.post(range(0, 3000, 100), count=500)
        study = self.study(mapping="divided")
        process = subprocess.Popen([PROGRAM, "analyse", study, "-o", self.out, "--quiet", "--threads", "1"],
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stderr.close)
        while not os.path.isdir(os.path.join(self.out, ".part")):
            self.assertIsNone(process.poll())
        shutil.rmtree(self.out)
        error = process.communicate(timeout=PATIENCE)[1]
        self.assertIn(process.returncode, (0, 2), error)
        if process.returncode == 2:
            self.assertEqual(error.count("\n"), 1, error)
            self.assertIn(self.out, error)
        else:  # it made the folder anew, in time
            self.assertIn("index.html", os.listdir(self.out))

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_folder_without_permission(self):
        self.post()
        os.makedirs(self.out)
        os.chmod(self.out, 0o555)
        self.refused(self.run_it("analyse", self.study(), "-o", self.out), self.out)

    def test_standard_output(self):
        self.post()
        with open("/dev/full", "w") as full:
            for arguments in (("info", self.at("post")), ("info", self.at("post"), "--json"),
                              ("analyse", self.study(), "-o", self.out, "--json"),
                              ("validate", self.VARAS, "-o", self.out)):  # prints more than a buffer
                done = subprocess.run([PROGRAM, *arguments], stdout=full, stderr=subprocess.PIPE, text=True)
                self.refused(done, "standard output: No space left on device")


class Killed(Command):
    def test_leaves_no_half_table(self):
        self.post(range(0, 500, 100), count=400)
        study = self.study(cell=[0.0007, 0.0005])  # tables of some size
        self.analyse(study, out=self.at("whole"))
        whole = self.tables(self.at("whole"))
        for attempt in range(12):
            shutil.rmtree(self.out, ignore_errors=True)
            process = subprocess.Popen([PROGRAM, "analyse", study, "-o", self.out, "--tables-only", "--quiet"])
            folder = os.path.join(self.out, "tables")
            while process.poll() is None and not os.path.isdir(folder):
                pass
            time.sleep(0.001 * attempt)
            process.kill()
            process.wait()
            for name in os.listdir(folder) if os.path.isdir(folder) else []:
                if name.endswith(".csv"):
                    self.assertEqual(read(os.path.join(folder, name)), whole[name], name)


if __name__ == "__main__":
    unittest.main()
