#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""`bedscope case` as a user runs it; its decks in Debian's LIGGGHTS and OpenFOAM, where installed.

    case_test.py BEDSCOPE PROJECT [Scale|Check|Run|BadInput|Decks|OpenFoam|Liggghts]
"""
import glob
import json
import math
import os
import re
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest

BEDSCOPE, PROJECT = sys.argv[1:3]
del sys.argv[1:3]
SCENES = PROJECT + "/cases/"


def run(*words, **more):
    return subprocess.run(words, capture_output=True, text=True, errors="replace", **more)


def case(*words):
    return run(BEDSCOPE, "case", *words)


class Case(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w") as file:
            file.write(text)
        return path

    def over(self, scene, text):
        """A scene of the project with something laid over it."""
        return self.write("over.toml", f'base = "{SCENES}{scene}"\n{text}\n')

    def made(self, scene, *words):
        done = case("make", scene, "-o", self.folder + "/case", "--quiet", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.folder + "/case"

    def read(self, *parts):
        with open(os.path.join(self.folder, "case", *parts)) as file:
            return file.read()


class Scale(Case):
    def test_what_is_kept_and_what_is_not(self):
        for factor, condition, grid, number in ((2, "b", [14, 2, 300], 6250), (2, "d", [14, 4, 300], 12500)):
            done = case("scale", SCENES + "riser/scene.toml", "--factor", str(factor),
                        "--condition", condition, "--json")
            self.assertEqual(done.returncode, 0, done.stderr)
            told = json.loads(done.stdout)
            for name in ("Re", "Ar", "Fr", "N_kn", "N_gamma_n", "density ratio"):
                self.assertAlmostEqual(told["kept"][name], 1, 9)
            self.assertAlmostEqual(told["not_kept"]["St_L"], factor)
            self.assertAlmostEqual(told["not_kept"]["Fr_L"], factor)
            self.assertAlmostEqual(told["not_kept"]["pressure drop"], 1 / factor)
            self.assertAlmostEqual(told["not_kept"]["contact time"], factor)
            self.assertAlmostEqual(told["not_kept"]["cells in the smallest cluster"], factor**-2)
            self.assertEqual(told["grid"], grid)
            self.assertEqual(told["particles"][0]["number"], number)
            self.assertAlmostEqual(told["depth"], 0.006 if condition == "b" else 0.012)
            if condition == "b":
                self.assertAlmostEqual(told["gas_viscosity"], 3.6e-5)
                self.assertAlmostEqual(told["gravity"], 4.905)
                self.assertAlmostEqual(told["normal_stiffness"], 3200)
                self.assertAlmostEqual(told["tangential_stiffness"], 1028, delta=0.5)

    def test_every_species_is_scaled(self):
        told = json.loads(case("scale", SCENES + "binary_riser/scene.toml", "--factor", "3",
                               "--condition", "b", "--json").stdout)
        sizes = [p["diameter"] for p in told["particles"]]
        self.assertAlmostEqual(sizes[0], 375e-6)
        self.assertAlmostEqual(sizes[1], 555e-6)
        self.assertEqual(sum(p["number"] for p in told["particles"]), 22758)

    def test_the_scaled_scene_is_a_scene(self):
        path = self.folder + "/K2.toml"
        done = case("scale", SCENES + "riser/scene.toml", "--factor", "2", "--condition", "b", "-o", path)
        self.assertEqual(done.returncode, 0, done.stderr)
        first, second = (json.loads(case("check", p, "--json").stdout)["numbers"]
                         for p in (path, SCENES + "riser/K2_b.toml"))
        self.assertEqual(first, second)


class Check(Case):
    def checked(self, scene):
        done = case("check", scene, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_every_scene_that_ships_is_checked(self):
        for name in ("riser", "bubbling_bed", "fixed_bed", "binary_riser", "mueller_bed", "impact"):
            told = self.checked(f"{SCENES}{name}/scene.toml")
            self.assertTrue(told["numbers"] and told["limits"] and told["advice"], name)
            for limit in told["limits"]:
                self.assertEqual(limit["ok"], limit["margin"] >= 1 - 1e-9)
                self.assertTrue(limit["rule"])

    def test_the_printed_scene_says_what_is_wrong(self):
        told = self.checked(SCENES + "riser/feed_bottom_printed.toml")
        feed = [l for l in told["limits"] if l["name"] == "feed"][0]
        self.assertFalse(feed["ok"])
        self.assertAlmostEqual(feed["value"], 1.28)
        self.assertEqual(feed["limit"], 0.6)
        self.assertIn("1.28", told["notes"][0])

    def test_terminal_velocity_is_that_of_the_law(self):
        for law, expected in (("beetstra", 4.938), ("wen_yu", 5.953), ("di_felice", 5.31)):
            numbers = self.checked(self.over("riser/scene.toml", f'models.drag = "{law}"'))["numbers"]
            self.assertAlmostEqual(numbers["u_t"], expected, delta=0.005)


class Run(Case):
    SAMPLE = PROJECT + "/data/samples/riser/study.toml"

    def checked(self, *words):
        done = case("check", *words, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_of_a_run_with_its_scene_is_the_scene_as_it_ran(self):
        told = self.checked(self.SAMPLE, "--scene", SCENES + "riser/K2_b.toml")
        scene = self.checked(SCENES + "riser/K2_b.toml")
        for name in ("u_t", "u_mf", "Re", "Ar", "dV/V_p", "contact time"):
            self.assertAlmostEqual(told["numbers"][name] / scene["numbers"][name], 1, 5, name)
        # particles meet more slowly than gas and gravity could make them
        self.assertLess(told["numbers"]["impact velocity"], scene["numbers"]["impact velocity"])
        self.assertGreater(told["numbers"]["impact velocity"], 0.5)

    def test_of_a_run_alone_tells_what_is_known(self):
        told = self.checked(self.SAMPLE)
        numbers = told["numbers"]
        mass = numbers["particles"] * 2500 * math.pi / 6 * 1.7e-3**3
        self.assertAlmostEqual(numbers["solids mass"] / mass, 1, 4)
        self.assertAlmostEqual(numbers["holdup"], mass / 2500 / (0.07 * 0.006 * 1.57), 6)
        self.assertNotIn("u_t", numbers)
        self.assertTrue(any("no scene is known" in r for r in told["remarks"]))

    def test_of_results_is_that_of_the_dumps(self):
        done = run(BEDSCOPE, "analyse", self.SAMPLE, "-o", self.folder + "/out", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        scene = self.write("out/scene.toml", f'base = "{SCENES}riser/K2_b.toml"\n')
        by_results, by_dumps = (self.checked(*words)["numbers"] for words in (
            [self.folder + "/out/results.h5"], [self.SAMPLE, "--scene", scene]))
        for name in ("u_t", "Ar", "particles", "solids mass"):
            self.assertAlmostEqual(by_results[name] / by_dumps[name], 1, 3, name)

    def test_a_type_that_is_no_number_is_type_0_as_analyse_has_it(self):
        self.write("dump.0", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n"
                             "ITEM: ATOMS id type x y z radius\n1 1 0.1 0.2 0.3 0.01\n2 nan 0.4 0.2 0.3 0.01\n")
        study = self.write("study.toml", '[[run]]\nparticles = "dump.0"\ndensity = { 0 = 1000, 1 = 2000 }\n')
        self.assertAlmostEqual(self.checked(study)["numbers"]["solids mass"], 3000 * 4 / 3 * math.pi * 1e-6, 9)

    def test_what_is_no_run_is_one_line(self):
        for path in (self.write("no.h5", "text"), self.folder + "/none", self.write("x.toml", "[[run]]\n")):
            done = case("check", path)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)


class BadInput(Case):
    def refused(self, *words):
        done = case(*words)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr

    def test_a_scene_that_cannot_run_is_refused_with_number_and_limit(self):
        for scene, parts in (("riser/feed_bottom_printed.toml", ("feed", "1.28", "0.6")),
                             ("riser/feed_side_printed.toml", ("feed", "1.785", "0.6")),
                             ("riser/K2_c.toml", ("cell edge", "0.88", "1")),
                             ("binary_riser/printed.toml", ("DEM step", "1e-05", "1.376e-06"))):
            text = self.refused("make", SCENES + scene, "-o", self.folder + "/no")
            for part in parts:
                self.assertIn(part, text)
            self.assertFalse(os.path.exists(self.folder + "/no"))

    def test_force_writes_it_all_the_same(self):
        self.made(SCENES + "riser/K2_c.toml", "--force")
        self.assertIn("run ${steps}", self.read("DEM", "in.liggghts"))

    def test_files_that_are_no_scene(self):
        self.assertIn("no such file", self.refused("check", self.folder + "/none.toml"))
        self.assertIn("line 1", self.refused("check", self.write("a.toml", "x = [")))
        self.assertIn("[geometry] is missing", self.refused("check", self.write("b.toml", "")))
        self.assertIn("no such file", self.refused("check", self.write("c.toml", 'base = "no.toml"')))
        self.assertIn("nearest known one", self.refused(
            "check", self.over("riser/scene.toml", "numerics.dem_stp = 1")))
        self.refused("scale", SCENES + "riser/scene.toml", "--factor", "-1", "--condition", "b")
        self.refused("scale", SCENES + "riser/scene.toml", "--factor", "2", "--condition", "e")
        self.refused("make", SCENES + "riser/scene.toml")

    def test_a_scaled_scene_replaces_nothing_but_a_file(self):
        pipe = self.folder + "/pipe"
        os.mkfifo(pipe)
        text = self.refused("scale", SCENES + "riser/scene.toml", "--factor", "2", "--condition", "b", "-o", pipe)
        self.assertIn("pipe: not a regular file", text)
        self.assertEqual(os.listdir(self.folder), ["pipe"])
        self.assertTrue(stat.S_ISFIFO(os.stat(pipe).st_mode))


class Decks(Case):
    def test_contacts_have_the_right_stiffness_and_damping(self):
        self.made(SCENES + "riser/K2_b.toml")
        script = re.sub(r" &\n", " ", self.read("DEM", "in.liggghts"))

        def values(name):
            return [float(v) for v in re.search(rf"fix {name} .*peratomtypepair 2 (.*)", script).group(1).split()]

        mass = 2500 * math.pi / 6 * 1.7e-3**3
        log = math.log
        kt = [2 / 7 * k * (math.pi**2 + log(0.33)**2) / (math.pi**2 + log(e)**2)
              for k, e in ((3200, 0.96), (3200, 0.86))]
        self.assertAlmostEqual(values("kn")[0], 3200)
        self.assertAlmostEqual(values("kt")[0], kt[0], delta=1e-4)
        self.assertAlmostEqual(values("kt")[1], kt[1], delta=1e-4)
        # e by the oscillator that LIGGGHTS integrates: m_eff x'' + gamman m_eff x' + kn x = 0
        for i, (m, e) in enumerate(((mass / 2, 0.96), (mass, 0.86))):
            gamma, k = values("gamman")[i], values("kn")[i]
            self.assertAlmostEqual(math.exp(-math.pi * gamma / 2 / math.sqrt(k / m - gamma**2 / 4)), e, 6)
            gamma, k = values("gammat")[i] * 3.5, values("kt")[i] * 3.5
            self.assertAlmostEqual(math.exp(-math.pi * gamma / 2 / math.sqrt(k / m - gamma**2 / 4)), 0.33, 6)

    def test_the_coupled_solver_gets_the_scene(self):
        self.made(SCENES + "riser/varas_feed_6.35.toml")
        text = self.read("CFD", "constant", "coupledProperties")
        self.assertIn("policy  fed;", text)
        self.assertIn("massFlow 0.01344;", text)  # 32 kg/m2s 0.07 x 0.006 m2
        self.assertIn("demSteps     20;", text)
        self.assertIn("type 1; diameter 0.0017; density 2500; fraction 1;", text)
        self.assertIn("point (0 0 0); normal (-1 0 0);", text)

    def test_cfdemcoupling_gets_its_files(self):
        self.made(SCENES + "riser/K2_b.toml")
        self.assertIn("BeetstraDrag gradPForce viscForce", self.read("CFD", "constant", "couplingProperties"))
        self.assertIn("runLiggghts", self.read("CFD", "constant", "liggghtsCommands"))

    def test_a_rough_outlet_is_made_of_particles(self):
        self.made(SCENES + "riser/feed_bottom_rough.toml")
        rows = [l.split() for l in self.read("DEM", "particles.data").splitlines() if len(l.split()) == 7]
        rough = [r for r in rows if r[1] == "3"]
        self.assertEqual(len(rough), 7 * int(math.pi / 2 * 0.07 / 0.85e-3))
        for row in rough:
            self.assertAlmostEqual(math.hypot(float(row[4]), float(row[6]) - 1.5), 0.07, 9)
        self.assertIn("wallTypes    (3);", self.read("CFD", "constant", "coupledProperties"))

    def test_the_script_is_executable_and_the_scene_comes_with_it(self):
        folder = self.made(SCENES + "impact/scene.toml")
        self.assertTrue(os.access(folder + "/run.sh", os.X_OK))
        self.assertEqual(case("check", folder + "/scene.toml").returncode, 0)
        self.assertFalse(os.path.exists(folder + "/CFD"))


class OpenFoam(Case):
    @unittest.skipUnless(shutil.which("blockMesh"), "no OpenFOAM")
    def test_blockmesh_and_checkmesh_accept_every_shape(self):
        box = 'outlet.head = "box"'
        right = 'outlet.place = "right"'
        shapes = (("riser/K2_b.toml", "", 14 * 2 * 300 + 2 * (8 * 8 + 2 * 6 * 8), 0.07 * 1.5 * 0.006 + math.pi / 4 * 0.07**2 * 0.006),
                  ("riser/K2_b.toml", right, 14 * 2 * 300 + 2 * (8 * 8 + 2 * 6 * 8), 0.07 * 1.5 * 0.006 + math.pi / 4 * 0.07**2 * 0.006),
                  ("riser/K2_b.toml", box, 14 * 2 * 314, 0.07 * 1.57 * 0.006),
                  ("mueller_bed/scene.toml", "", 20 * 4 * 55, 0.044 * 0.01 * 0.12))
        for scene, change, cells, volume in shapes:
            folder = self.made(self.over(scene, change)) + "/CFD"
            os.environ.setdefault("WM_PROJECT_DIR", "/usr/share/openfoam")
            done = run("blockMesh", "-case", folder)
            self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr)
            told = run("checkMesh", "-case", folder).stdout
            self.assertIn("Mesh OK.", told, scene)
            self.assertEqual(int(re.search(r"cells: +(\d+)", told).group(1)), cells)
            found = float(re.search(r"Total volume = ([0-9.e+-]+?)\.? ", told).group(1))
            self.assertAlmostEqual(found / volume, 1, delta=1e-3)  # faces on the arc are flat
            self.assertNotIn("defaultFaces", told)


class Liggghts(Case):
    def particles(self, folder, step):
        """Rows of a dump by its own column names."""
        with open(f"{folder}/DEM/post/dump{step}.liggghts_run") as file:
            lines = file.read().splitlines()
        names = lines[8].split()[2:]
        return [dict(zip(names, map(float, l.split()))) for l in lines[9:]]

    def ran(self, folder, steps):
        done = run("liggghts", "-in", "DEM/in.liggghts", "-var", "steps", str(steps), cwd=folder)
        self.assertEqual(done.returncode, 0, done.stdout[-1500:] + done.stderr[-500:])

    def setUp(self):
        super().setUp()
        if not shutil.which("liggghts"):
            self.skipTest("no LIGGGHTS")

    def test_the_dump_holds_the_scenes_particles(self):
        for scene, change, energy in (("riser/K2_b.toml", "", False),
                              ("riser/feed_bottom_rough.toml", 'scale = { factor = 2, condition = "b" }\ninlet.particles = "inventory"', False),
                              ("binary_riser/K3_b.toml", "particles.number = 200000", False),
                              ("mueller_bed/scene.toml", "", False),
                              ("bubbling_bed/H0.04_u0.5_active.toml", "particles.number = 2000", True)):
            path = self.over(scene, change + "\nnumerics.output = 1e-3\nnumerics.end = 1e-2"
                             + ("\nnumerics.gas_step = 1e-4" if "bubbling" in scene else ""))
            expected = json.loads(case("scale", path, "--factor", "1", "--condition", "a", "--json").stdout)
            numbers = json.loads(case("check", path, "--json").stdout)["numbers"]
            shutil.rmtree(self.folder + "/case", ignore_errors=True)
            folder = self.made(path)
            self.ran(folder, 1000)
            last = max(int(re.search(r"dump(\d+)", f).group(1)) for f in glob.glob(folder + "/DEM/post/dump*"))
            rows = self.particles(folder, last)
            for species in expected["particles"]:
                mine = [r for r in rows if r["type"] == species["type"]]
                self.assertEqual(len(mine), species["number"], scene)
            mass = sum(4 / 3 * math.pi * r["radius"]**3 * expected["particles"][int(r["type"]) - 1]["density"] for r in rows)
            self.assertAlmostEqual(mass / numbers["solids mass"], 1, delta=1e-3, msg=scene)
            self.assertEqual(energy, "f_Temp[0]" in rows[0])
            info = json.loads(run(BEDSCOPE, "info", folder + "/DEM/post", "--json").stdout)
            self.assertEqual(info["particles"]["max"], len(rows))
            self.assertEqual(info["problems"], [])

    def test_heat_sources_heat_the_active_alone(self):
        folder = self.made(self.over("bubbling_bed/H0.04_u0.5_active.toml",
                                     "particles.number = 500\nnumerics.output = 1e-2\nnumerics.end = 1e-2"))
        self.ran(folder, 1000)
        rows = self.particles(folder, 1000)
        for row in rows:
            rise = 0 if row["type"] == 1 else 3.32e7 * 0.01 / (667 * 1670)  # q t / (rho C_p)
            self.assertAlmostEqual(row["f_Temp[0]"] - 345, rise, delta=2e-3)

    def test_an_impact_restores_what_the_scene_says(self):
        for scene, e in (("impact/angle_2.toml", 0.98), ("mueller_bed/scene.toml", 0.9)):
            change = "" if "impact" in scene else (
                'particles = { arrangement = "single", position = [0.02, 0.005, 0.0007], velocity = [0, 0, -1] }\n'
                "numerics.output = 1e-3\nnumerics.end = 1e-3\nnumerics.dem_step = 1e-6\nnumerics.gas_step = 1e-6\ngravity = 0")
            path = self.over(scene, change)
            folder = self.made(path)
            self.ran(folder, 1000)
            before, after = self.particles(folder, 0)[0], self.particles(folder, 1000)[0]
            self.assertAlmostEqual(-after["vz"] / before["vz"], e, delta=0.005, msg=scene)
            shutil.rmtree(folder)

    def test_a_bend_turns_particles_into_the_outlet(self):
        folder = self.made(self.over("riser/K2_b.toml", """particles.arrangement = "single"
particles.position = [0.06, 0.003, 1.45]
particles.velocity = [0, 0, 6]
numerics.output = 1e-3
numerics.end = 0.03"""))
        self.ran(folder, 3000)
        xs = [r["x"] for s in range(0, 3001, 100) if os.path.exists(f"{folder}/DEM/post/dump{s}.liggghts_run")
              for r in self.particles(folder, s)]
        zs = [r["z"] for s in range(0, 3001, 100) for r in self.particles(folder, s)]
        self.assertLess(min(xs), 0.0)  # out through the left
        self.assertLess(max(zs), 1.57)

    def test_a_feed_enters_with_its_mass_flow(self):
        folder = self.made(self.over("riser/feed_side.toml", """particles.number = 8
numerics = { dem_step = 1e-5, output = 0.02, end = 0.2 }
scale = { factor = 2, condition = "b" }"""))
        self.ran(folder, 20000)
        rows = self.particles(folder, 20000)
        mass = 2500 * math.pi / 6 * 1.7e-3**3
        self.assertAlmostEqual((len(rows) - 1) * mass / 0.2, 32 * 0.07 * 0.006, delta=0.05 * 0.01344)


if __name__ == "__main__":
    unittest.main()
