# SPDX-License-Identifier: BSD-3-Clause
"""Gas beside particles as a user meets it: closed forms, what is said of wrong input, a live run.

Usage: gas_test.py BEDSCOPE [unittest arguments]. Exit code 77: numpy or scipy is missing.
"""

import json
import math
import os
import shutil
import sys
import time
import unittest

import command_test  # takes BEDSCOPE from the command line; exits with 77 where numpy is missing
import numpy as np
from command_test import read, write
from gas_cases import FoamCase, random_gas
from judge_cases import DOMAIN, PROFILES, RUN, Dumps, scene, write_study

SAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")


class GasCommand(command_test.Command):
    def case(self, low=DOMAIN[0], high=DOMAIN[1], n=(14, 2, 30)):
        return FoamCase(self.at("CFD"), low, high, n)

    def study(self, run=None, gas=None, **keys):
        sections = {"profiles": PROFILES} | ({"gas": gas} if gas else {})
        return write_study(self.folder, scene(**keys), [RUN | {"gas": "CFD"} | (run or {})], **sections)

    def problems(self):
        return "\n".join(self.summary()[0]["problems"])


class GasNumbers(GasCommand):
    def test_closed_forms(self):
        """Voidage and pressure linear in height, 2 m/s superficial: all means are known."""
        self.post(range(0, 5000, 1000))
        case = self.case()
        z = case.centres[:, 2]
        for name in ("0", "0.02", "0.04"):
            eps = 0.5 + z
            case.field(name, "voidfraction", eps, "0 0 0 0 0 0 0")
            case.field(name, "U", np.outer(2 / eps, [0, 0, 1]), "0 1 -1 0 0 0 0")
            case.field(name, "p", 1e5 - 700 * z, "1 -1 -2 0 0 0 0")
            case.field(name, "T", 300 + 0 * z, "0 0 0 1 0 0 0")
        self.analyse(self.study(cell=[0.01, 0.02]))  # two layers of the mesh in one of the grid
        rows = self.rows("gas_axial")
        self.assertEqual(len(rows), 15)
        for row in rows:
            height = float(row["z [m]"])
            self.assertAlmostEqual(float(row["voidage [-]"]), 0.5 + height, places=9)
            self.assertAlmostEqual(float(row["velocity_z [m/s]"]), 2 / (0.5 + height), places=7)
            self.assertAlmostEqual(float(row["temperature [K]"]), 300, places=9)
            # the gas of the upper layer weighs more: <eps p>/<eps> of two values 700 x 5 mm apart
            eps = np.array([0.495, 0.505]) + height
            p = 1e5 - 700 * (height + np.array([-0.005, 0.005]))
            self.assertAlmostEqual(float(row["pressure [Pa]"]), (eps * p).sum() / eps.sum(), places=4)
            solids = [r for r in self.rows("axial_profile") if r["z [m]"] == row["z [m]"]][0]
            if solids["velocity_z [m/s]"] != "nan":
                self.assertAlmostEqual(float(row["slip_z [m/s]"]), float(row["velocity_z [m/s]"])
                                       - float(solids["velocity_z [m/s]"]), places=12)
        self.assertEqual({row["voidage_ci95 [-]"] for row in rows}, {"0"})  # nothing changes in time
        summary = self.summary()[0]
        self.assertAlmostEqual(summary["pressure_drop"], 700 * 0.3, places=6)
        mass = float(self.rows("inventory")[0]["solids_mass [kg]"])
        self.assertAlmostEqual(summary["bed_weight_over_area"] / (mass * 9.81 / (0.07 * 0.006)), 1, places=9)
        self.assertEqual((summary["gas_times"], summary["gas_matched"]), (3, 3))

    def test_a_bed_weighs_by_its_own_gravity(self):
        self.post(range(0, 3000, 1000))
        random_gas(self.case(), "0.01", 1, kinematic=False)
        self.analyse(self.study())
        weight = self.summary()[0]["bed_weight_over_area"]
        self.analyse(self.study(gravity=4.905))
        self.assertAlmostEqual(self.summary()[0]["bed_weight_over_area"] / weight, 0.5, places=12)

    def test_threads_do_not_change_a_byte(self):
        self.post(range(0, 20000, 500), types=(1, 2), radii=[5e-4, 9e-4])
        case = self.case()
        for k in range(30):
            random_gas(case, f"{0.006 * k:g}", k)
        study = self.study(average="auto", density={"1": 1000, "2": 3000}, gas_density=1.2)
        for threads in ("1", "2", "5"):
            self.analyse(study, "--threads", threads, out=self.at(threads))
        self.assertEqual(self.tables(self.at("1")), self.tables(self.at("2")))
        self.assertEqual(self.tables(self.at("1")), self.tables(self.at("5")))
        window = self.summary(self.at("1"))[0]
        times = [0.006 * k for k in range(30)]
        inside = [t for t in times if window["from"] - 5e-6 <= t <= window["to"] + 5e-6]
        self.assertEqual(window["gas_times"], len(inside))

    def test_the_real_run_agrees_with_its_particles(self):
        """Gas of data/samples/riser: two programs that exchanged their fields agree on the solids."""
        FoamCase(self.at("CFD"), (0, 0, 0), (0.07, 0.006, 1.57), (14, 2, 300))
        shutil.copytree(os.path.join(SAMPLES, "tests/data/riser_gas"), self.at("CFD"), dirs_exist_ok=True)
        study = read(os.path.join(SAMPLES, "data/samples/riser/study.toml"), "r")
        study = study.replace('"dump_', f'"{SAMPLES}/data/samples/riser/dump_') + '\ngas = "../CFD"\n'
        os.makedirs(self.at("study"))
        write(self.at("study", "study.toml"), study)
        self.analyse(self.at("study", "study.toml"))
        checks = self.rows("voidage_check")
        self.assertEqual([round(float(row["time [s]"]), 9) for row in checks], [5, 6, 7])
        for row in checks:
            # measured: 0.9998 and 0.004 to 0.005; the fields of 0.01 s before differ by 0.02
            self.assertAlmostEqual(float(row["ratio [-]"]), 1, delta=1e-3)
            self.assertLess(float(row["rms_difference [-]"]), 0.008)
        velocities = [float(row["velocity_z [m/s]"]) for row in self.rows("gas_axial")]
        superficial = [float(row["velocity_z [m/s]"]) * float(row["voidage [-]"]) for row in self.rows("gas_axial")]
        self.assertEqual(len(velocities), 314)
        # what comes in below, 5.55 m/s, goes up all the way to the outlet (z > 1.502 m)
        # (at one instant a layer that fills or empties passes a little less or more)
        self.assertAlmostEqual(np.mean(superficial[:300]), 5.55, delta=0.02)
        self.assertLess(max(abs(flow - 5.55) for flow in superficial[:300]), 0.3)


class GasAgainstParticles(GasCommand):
    def moving_clump(self, gas_times, radius=0.0006):
        """A clump that rises 2.4 m/s, and the voidage that it leaves, by the centres of particles."""
        dumps = Dumps(self.at("post"), 3)
        base = dumps.particles(800)
        spread = np.random.default_rng(3).normal(0, 0.008, 800)
        volume = 4 / 3 * math.pi * radius**3
        case = self.case()
        for k in range(20):
            particles = {**base, "z": 0.05 + spread + 0.012 * k * 0.8, "radius": np.full(800, radius)}
            dumps.write(500 * k, particles)
            if gas_times is None:
                continue
            place = [np.clip((particles[n] / width).astype(int), 0, m - 1)
                     for n, width, m in zip("xyz", (0.005, 0.003, 0.01), case.n)]
            count = np.bincount(place[0] + 14 * (place[1] + 2 * place[2]), minlength=840)
            eps = 1 - count * volume / (0.005 * 0.003 * 0.01)
            case.field(gas_times(0.005 * k), "voidfraction", eps, "0 0 0 0 0 0 0")

    def test_fields_that_fit_say_nothing(self):
        self.moving_clump(lambda t: f"{t:g}")
        self.analyse(self.study())
        self.assertAlmostEqual(self.summary()[0]["voidage_ratio"], 1, places=5)
        self.assertEqual(self.summary()[0]["gas_matched"], 20)
        self.assertNotIn("fit", self.problems())
        self.assertNotIn("particles' volume", self.problems())

    def lattice(self, case, lean=0):
        """One snapshot of equal particles at the centres of cells that lean along x; returns the volume of one."""
        dumps = Dumps(self.at("post"), 3)
        x, y, z = case.centres.T
        dumps.write(0, dumps.particles(len(x)) | {"x": x + lean * z, "y": y, "z": z})
        return 4 / 3 * math.pi * 0.0006**3

    def test_a_bed_without_spread_is_doubted_beyond_the_noise_of_counting(self):
        """n = 2 particles in each cell of the grid: their holdup is known to 1/sqrt(2) of itself."""
        case = self.case()
        holdup = self.lattice(case) / (0.005 * 0.003 * 0.01)
        sign = (-1) ** (case.centres[:, [0, 2]] // [0.005, 0.01]).sum(axis=1)  # in x and z, so in the grid too
        for share, doubted in ((0.8, False), (1.25, True)):  # of the noise, either side of it
            case.field("0", "voidfraction", 1 - holdup * (1 + share / math.sqrt(2) * sign), "0 0 0 0 0 0 0")
            self.analyse(self.study(cell=[0.005, 0.01]))
            self.assertAlmostEqual(float(self.rows("voidage_check")[0]["rms_difference [-]"]),
                                   share * holdup / math.sqrt(2), places=7)
            self.assertEqual("voidage and particles differ" in self.problems(), doubted, self.problems())

    def test_particles_count_whole_in_cells_that_a_slanting_wall_cuts(self):
        """All particles are within walls that lean by the width of 3 cells of the grid; so all of their volume counts."""
        case = self.case(high=(0.055, 0.006, 0.3), n=(11, 2, 30))
        lean = 0.015 / 0.3
        case.write_points(lean)
        volume = len(case.centres) * self.lattice(case, lean)
        case.field("0", "voidfraction", 1 - volume / (0.055 * 0.006 * 0.3), "0 0 0 0 0 0 0")
        self.analyse(self.study(cell=[0.005, 0.01]))
        row = self.rows("voidage_check")[0]
        self.assertLess(int(row["cells"]), 14 * 30)
        for side in ("particles", "gas"):  # to the nine digits of the voidage
            self.assertAlmostEqual(float(row[f"solids_volume_{side} [m3]"]) / volume, 1, delta=3e-7)

    def test_a_shifted_clock_is_found(self):
        self.moving_clump(lambda t: f"{t + 0.02:g}")
        self.analyse(self.study())
        self.assertIn("fit the particles best 0.02 s later", self.problems())
        self.assertIn("step_zero", self.problems())
        self.analyse(self.study({"step_zero": -2000}))
        self.assertNotIn("fit the particles", self.problems())
        self.analyse(self.study({"step_zero": -3000}))
        self.assertIn("fit the particles best 0.01 s earlier", self.problems())

    def test_a_wrong_radius_is_found(self):
        self.moving_clump(lambda t: f"{t:g}")
        self.analyse(self.study(radius=0.0003))
        self.assertAlmostEqual(self.summary()[0]["voidage_ratio"], 0.125, places=6)
        self.assertIn("the radius is off by a factor of 0.5", self.problems())

    def test_a_time_step_that_is_off_by_a_factor_is_told(self):
        self.moving_clump(lambda t: f"{2 * t:g}")
        self.analyse(self.study())
        self.assertIn("its times run from 0 to 0.19 s, the snapshots from 0 to 0.095 s: time_step", self.problems())

    def test_a_density_that_is_not_the_logs_is_told(self):
        self.moving_clump(lambda t: f"{t:g}")
        write(self.at("post", "log.liggghts"), "LIGGGHTS (Version LIGGGHTS-PUBLIC 3.8.0)\ntimestep 1e-5\n"
              "fix p all particletemplate/sphere 1 atom_type 1 density constant 2400 radius constant 0.0006\n")
        self.analyse(self.study(density=1800))
        self.assertIn("density of type 1 is 1800 kg/m3", self.problems())
        self.analyse(self.study(density=2400))
        self.assertNotIn("density of type", self.problems())

    def test_times_that_never_meet(self):
        self.moving_clump(lambda t: f"{t + 0.0021:g}")
        self.analyse(self.study())
        self.assertIn("none of its times (0.0021 to 0.0971 s) is that of a snapshot (0 to 0.095 s)",
                      self.problems())
        self.assertEqual(self.summary()[0]["gas_matched"], 0)
        self.assertIsNone(self.summary()[0]["voidage_ratio"])
        self.assertEqual(len(self.rows("gas_axial")), 120)  # averages need no coincidence

    def test_no_gas_in_the_window(self):
        self.moving_clump(lambda t: f"{t + 100:g}")
        self.analyse(self.study())
        self.assertIn("no time in the averaging window (0 to 0.095 s); its times run from 100 to 100.095 s",
                      self.problems())
        self.assertEqual({row["voidage [-]"] for row in self.rows("gas_axial")}, {"nan"})

    def test_tables_of_the_gas_go_with_it(self):
        self.moving_clump(lambda t: f"{t:g}")
        self.analyse(self.study())
        self.assertIn("gas_axial.csv", self.tables())
        write_study(self.folder, scene(), [RUN], profiles=PROFILES)
        self.analyse(self.at("study.toml"))
        self.assertNotIn("gas_axial.csv", self.tables())
        self.assertNotIn("gas_times", self.summary()[0])


class GasBadInput(GasCommand):
    def setUp(self):
        super().setUp()
        self.post(range(0, 300, 100))

    def test_fields(self):
        self.fails(self.study(), "CFD", "expected the folder of an OpenFOAM case")
        case = self.case()
        case.field("0.001", "U", np.ones((840, 3)), "0 1 -1 0 0 0 0")
        self.fails(self.study(), "no voidage", "expected voidfraction", "found U", "[gas] voidage")
        case.field("0.001", "eps", np.ones(840), "0 0 0 0 0 0 0")
        self.fails(self.study(gas={"voidage": "epsilon"}), "gas.voidage", '"epsilon"', "(U, eps)")
        self.fails(self.study(gas={"voidage": "U"}), "field U at time 0.001", "expected 1", "found 3")
        self.fails(self.study(gas={"voidage": "eps", "solids": "eps"}), "expected one of them")
        case.field("0.001", "p", np.ones(840), "0 0 0 1 0 0 0")
        self.fails(self.study(gas={"voidage": "eps"}), "expected a pressure", "[0 0 0 1 0 0 0]")
        os.remove(self.at("CFD", "0.001", "p"))
        self.analyse(self.study(gas={"voidage": "eps"}))
        self.assertEqual(self.summary()[0]["gas_times"], 1)

    def test_keys(self):
        random_gas(self.case(), "0.001", 1)
        self.fails(self.study({"decomposition": "reconstucted"}), "decomposition", "reconstructed")
        self.fails(self.study(gas={"voidge": "x"}), "unknown key gas.voidge", "gas.voidage")
        self.fails(self.study(gravity=-9.81), "gravity", "above 0")
        self.fails(self.study({"gas": 3}), "run.gas", "expected a text")

    def test_kinematic_pressure_needs_a_density(self):
        random_gas(self.case(), "0.001", 1)
        self.analyse(self.study())
        self.assertIn("p is p/rho [m2/s2] and gas_density is missing", self.problems())
        self.assertEqual({row["pressure [Pa]"] for row in self.rows("gas_axial")}, {"nan"})
        self.assertNotIn("pressure_drop.csv", self.tables())
        self.assertIsNone(self.summary()[0]["pressure_drop"])

    def test_phases_by_their_names(self):
        case = self.case()
        case.field("0.001", "alpha.nitrogen", np.full(840, 0.75), "0 0 0 0 0 0 0")
        case.field("0.001", "alpha.particles", np.full(840, 0.25), "0 0 0 0 0 0 0")
        case.field("0.001", "U.nitrogen", np.tile([0, 0, 3.0], (840, 1)), "0 1 -1 0 0 0 0")
        case.field("0.001", "U.particles", np.tile([0, 0, 1.0], (840, 1)), "0 1 -1 0 0 0 0")
        self.analyse(self.study())
        row = self.rows("gas_axial")[0]
        self.assertAlmostEqual(float(row["voidage [-]"]), 0.75, places=12)
        self.assertAlmostEqual(float(row["velocity_z [m/s]"]), 3, places=12)

    def test_values_that_are_no_numbers(self):
        case = self.case()
        eps = np.full(840, 0.5)
        eps[3] = np.nan
        case.field("0.001", "voidfraction", eps, "0 0 0 0 0 0 0")
        case.field("0.001", "T", np.where(np.arange(840) == 5, np.inf, 300), "0 0 0 1 0 0 0")
        self.analyse(self.study())
        self.assertIn("2 values are nan or inf", self.problems())
        for row in self.rows("gas_axial"):
            self.assertAlmostEqual(float(row["voidage [-]"]), 0.5, places=12)
            self.assertAlmostEqual(float(row["temperature [K]"]), 300, places=9)


class GasVtk(GasCommand):
    """Tables out of foamToVTK's files are those of the case (tests/data/vtk_gas/README.md)."""

    DATA = os.path.join(SAMPLES, "tests", "data")
    TABLES = ("gas_axial", "gas_lateral", "voidage_check", "pressure_drop")

    def vtk_study(self, gas):
        low, high = [-0.0075, -0.075, 0.0], [0.0075, 0.075, 0.5]  # above the mesh, which ends at 0.45 m
        return self.study({"gas": gas, "step_zero": 0}, domain={"min": low, "max": high}, lateral="y",
                          cell=[0.01, 0.0175], gas_density=1.2)

    def same(self, a, b, tolerance):
        self.assertEqual(len(a), len(b))
        for left, right in zip(a, b):
            self.assertEqual(list(left), list(right))
            for key in left:
                x, y = left[key], right[key]
                if key in ("run", "type") or "nan" in (x, y):
                    self.assertEqual(x, y, (key, left, right))
                elif not key.endswith("ci95 [-]"):
                    self.assertAlmostEqual(float(x), float(y), delta=tolerance * max(1e-3, abs(float(x))), msg=key)

    def test_tables_are_those_of_the_case(self):
        self.post((0, 300, 400), domain=([-0.0075, -0.075, 0.0], [0.0075, 0.075, 0.3]))
        self.analyse(self.vtk_study(os.path.join(self.DATA, "openfoam", "ascii")))
        whole = {name: self.rows(name) for name in self.TABLES}
        heights = [row["z [m]"] for row in whole["gas_axial"]]
        # Float in binary, six digits in text; of moved walls no sliver reaches another cell.
        for form, tolerance in (("xml/boxes_0.vtm", 2e-6), ("legacy/boxes_0.vtk", 2e-6),
                                ("ascii", 2e-5), ("legacy_ascii", 2e-5)):
            with self.subTest(form=form):
                self.analyse(self.vtk_study(os.path.join(self.DATA, "vtk_gas", form)))
                self.assertEqual([row["z [m]"] for row in self.rows("gas_axial")], heights)
                for name in self.TABLES:
                    self.same(whole[name], self.rows(name), tolerance)
                self.assertIn("p has no dimensions: taken as p/rho", self.problems())

    def test_two_times_are_averaged(self):
        self.post((0, 300, 400))
        self.analyse(self.vtk_study(os.path.join(self.DATA, "vtk_gas", "xml")))
        self.assertEqual(self.summary()[0]["gas_times"], 2)
        self.assertEqual(self.summary()[0]["gas_matched"], 2)

    def test_info_names_form_times_cells_and_fields(self):
        for form in ("xml", "legacy", "xml/boxes.vtm.series", "legacy/boxes.vtk.series"):
            found = self.info(os.path.join(self.DATA, "vtk_gas", form))
            self.assertEqual((found["form"], found["times"], found["cells"]), ("vtk-gas", [0.003, 0.004], 200))
            self.assertEqual(found["mesh"]["grid"], [1, 10, 20])
            self.assertAlmostEqual(found["mesh"]["volume"], 0.015 * 0.15 * 0.45, delta=1e-9)
            self.assertIn("alpha.air", found["columns"])
            self.assertEqual(found["problems"], [])

    def test_bad_input(self):
        self.post((0, 300, 400))
        shutil.copytree(os.path.join(self.DATA, "vtk_gas", "xml"), self.at("VTK"))
        study = self.vtk_study("VTK")
        os.remove(self.at("VTK", "boxes_1.vtm"))
        self.fails(study, "boxes.vtm.series", "boxes_1.vtm", "not found")
        os.remove(self.at("VTK", "boxes.vtm.series"))
        self.analyse(study)  # the one .vtm that is left
        shutil.rmtree(self.out)
        whole = read(self.at("VTK", "boxes_0", "internal.vtu"))
        write(self.at("VTK", "boxes_0", "internal.vtu"), whole[:9000])
        self.fails(study, "internal.vtu", "line")
        write(self.at("VTK", "boxes_0", "internal.vtu"), whole.replace(b"NumberOfCells='200'", b"NumberOfCells='201'"))
        self.fails(study, "internal.vtu", "array types")
        write(self.at("VTK", "boxes_0", "internal.vtu"), whole.replace(b"alpha.air", b"alpha_air"))
        self.fails(study, "no voidage", "alpha_air")
        shutil.rmtree(self.at("VTK", "boxes_0"))
        self.fails(study, "internal.vtu", "not found")
        os.remove(self.at("VTK", "boxes_0.vtm"))
        self.fails(study, "VTK")

    def info(self, path):
        done = self.run_it("info", path, "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout)


class Parcels(GasCommand):
    """One parcel stands for nParticle particles: masses, holdups and fluxes are those of the particles."""

    def test_closed_form(self):
        case = self.case(n=(2, 1, 3))
        case.field("0.5", "p", np.zeros(6), "0 2 -2 0 0 0 0")
        rng = np.random.default_rng(5)
        count = 60
        d, n = rng.choice([2e-4, 3e-4], count), rng.choice([1, 8, 20.5], count)
        layer = np.arange(count) % 3  # each well inside one of the three layers of 0.1 m
        at = np.stack([rng.uniform(0.01, 0.06, count), np.full(count, 0.003), 0.1 * layer + rng.uniform(0.02, 0.08, count)], axis=1)
        u = rng.normal(0, 1, (count, 3))
        cloud = "0.5/lagrangian/kinematicCloud/"

        def rows(values):
            return "\n%d\n(\n%s\n)\n" % (count, "\n".join(values))

        case.write(cloud + "positions", "Cloud<basicKinematicParcel>",
                   rows("(%.12g %.12g %.12g) 0" % tuple(x) for x in at))
        for name, values in (("d", d), ("nParticle", n), ("rho", np.full(count, 2500.0))):
            case.write(cloud + name, "scalarField", rows("%.12g" % v for v in values))
        case.write(cloud + "U", "vectorField", rows("(%.12g %.12g %.12g)" % tuple(v) for v in u))
        self.analyse(write_study(self.folder, {"domain": {"min": DOMAIN[0], "max": DOMAIN[1]}, "cells": [1, 3]},
                                 [{"label": "parcels", "particles": "CFD"}], profiles={"heights": [0.15], "band": 0.1}))
        volume = n * math.pi / 6 * d**3
        bed = self.rows("inventory")[0]
        self.assertEqual(bed["particles"], str(count))  # of parcels, as docs/study.md says
        self.assertAlmostEqual(float(bed["solids_mass [kg]"]) / (2500 * volume.sum()), 1, places=10)
        self.assertAlmostEqual(float(bed["holdup [-]"]) / (volume.sum() / (0.07 * 0.006 * 0.3)), 1, places=10)
        self.assertAlmostEqual(float(bed["mean_height [m]"]), (volume * at[:, 2]).sum() / volume.sum(), places=10)
        for k, row in enumerate(r for r in self.rows("axial_profile") if r["type"] == "all"):
            of = volume[layer == k]
            holdup = of.sum() / (0.07 * 0.006 * 0.1)
            flux = 2500 * (of * u[layer == k, 2]).sum() / (0.07 * 0.006 * 0.1)
            self.assertAlmostEqual(float(row["holdup [-]"]) / holdup, 1, places=10)
            self.assertAlmostEqual(float(row["mass_flux_z [kg/m2/s]"]) / flux, 1, places=9)
            self.assertAlmostEqual(float(row["velocity_z [m/s]"]) * 2500 * holdup / flux, 1, places=9)
        self.assertIn("one parcel stands for 1 to 20.5 particles (nParticle)", self.problems())


class GasFollow(GasCommand):
    start, end = command_test.Follow.start, command_test.Follow.end

    def wait_for(self, process, snapshots, gas_rows):
        until = time.monotonic() + command_test.PATIENCE
        while time.monotonic() < until:
            self.assertIsNone(process.poll(), "it ended by itself")
            try:
                if (len(self.rows("cluster_occurrence")) == snapshots
                        and len(self.rows("pressure_drop")) == gas_rows and self.summary()):
                    return
            except (FileNotFoundError, ValueError):
                pass
            time.sleep(0.02)
        self.fail(f"not {snapshots} snapshots and {gas_rows} times of the gas")

    def check(self, **keys):
        """Gas and particles run ahead of each other; a time that is being written is left out."""
        self.post(range(0, 3000, 100), name="all", count=50)
        os.makedirs(self.at("post"))
        case = FoamCase(self.at("whole"), *DOMAIN, (7, 1, 12))
        names = [f"{0.001 * k:g}" for k in range(30)]
        for k, name in enumerate(names):
            random_gas(case, name, k)
        shutil.copytree(self.at("whole", "constant"), self.at("CFD", "constant"))
        study = self.study(gas_density=1.2, **keys)

        def particles(*numbers):
            for k in numbers:
                shutil.copy(self.at("all", f"dump{100 * k}.liggghts_run"), self.at("post"))

        def gas(*numbers):
            for k in numbers:
                shutil.copytree(self.at("whole", names[k]), self.at("new"))
                os.rename(self.at("new"), self.at("CFD", names[k]))

        gas(0, 1)
        particles(0, 1, 2)
        process = self.start(study)
        self.wait_for(process, 3, 2)
        particles(*range(3, 12))  # the gas comes later
        self.wait_for(process, 12, 2)
        gas(*range(2, 18))
        self.wait_for(process, 12, 18)
        os.makedirs(self.at("CFD", names[18]))  # being written: first one field, then another cut
        shutil.copy(self.at("whole", names[18], "U"), self.at("CFD", names[18]))
        particles(12)
        self.wait_for(process, 13, 18)
        whole = read(self.at("whole", names[18], "voidfraction"))
        write(self.at("CFD", names[18], "voidfraction"), whole[:400])
        particles(13)
        self.wait_for(process, 14, 18)
        for field in ("voidfraction", "p", "T"):
            shutil.copy(self.at("whole", names[18], field), self.at("CFD", names[18]))
        self.wait_for(process, 14, 19)
        for k in range(14, 30):
            particles(k)
            if k > 18:
                gas(k)
            time.sleep(0.02)
        self.wait_for(process, 30, 30)
        time.sleep(0.3)
        self.end(process)
        self.analyse(study, out=self.at("fresh"))
        self.assertEqual(self.tables(), self.tables(self.at("fresh")))
        followed, fresh = self.summary()[0], self.summary(self.at("fresh"))[0]
        for key in set(fresh) - {"seconds", "bytes_read"}:
            self.assertEqual(followed[key], fresh[key], key)

    def test_equals_a_fresh_run(self):
        self.check()

    def test_equals_a_fresh_run_with_auto(self):
        self.check(average="auto")

    def test_equals_a_fresh_run_with_a_window(self):
        self.check(average={"from": 0.0005, "to": 0.0155})


if __name__ == "__main__":
    unittest.main()
