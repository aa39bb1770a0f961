#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Each method of the simulation beyond its edge, short of it, and at twice the margin of `bedscope case check`.

    stability_test.py [Collision|BedAtRest|Overlap|ParticleDrag|GasDrag|Cells|Heat]

Beyond the edge the method fails and the warning is on; it is on before; at twice the margin it is silent and the method
works. Tolerances come from the theory of each (docs/stability.md).
"""
import math
import pathlib
import shutil
import statistics
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "cases/stability/simulation"))
try:
    import heat  # needs scipy
except ImportError:
    print("no scipy: skipped")
    sys.exit(77)
import cells
import contacts
import drag
import trial


class Edge(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="stability."))
        self.addCleanup(shutil.rmtree, self.folder, True)
        self.runs = 0

    def at(self):
        self.runs += 1
        return self.folder / str(self.runs)

    def assertWarned(self, run, *limits):
        self.assertTrue(run.warned(*limits), f"no warning of {limits}")

    def assertSilent(self, run, *limits):
        """At twice the margin, but for rounding."""
        told = run.check()[1]
        for name in limits:
            self.assertGreaterEqual(told[name]["margin"], 2 - 1e-6, name)
            self.assertTrue(told[name]["ok"])


class Collision(Edge):
    def test_energy_is_made_by_long_steps_only_and_after_the_warning(self):
        for model, limits in contacts.LIMITS.items():
            for angle in (0, 45):
                run, e, energy = contacts.impacts(self.at(), model, 1.6, angle)
                self.assertGreater(statistics.fmean(energy), 1, f"{model} {angle}")
                self.assertWarned(run, *limits)
                run, e, energy = contacts.impacts(self.at(), model, 4.9, angle)
                self.assertLess(statistics.fmean(energy), 1)
                self.assertWarned(run, *limits)
                # Half of the smallest limit.
                told = run.check()[1]
                n = 4.9 * 2 / min(told[name]["margin"] for name in limits)
                run, e, energy = contacts.impacts(self.at(), model, n, angle)
                self.assertSilent(run, *limits)
                self.assertLess(max(energy), 1)
                # An undamped contact that starts a part s into its step loses s (1 - s) (pi / n)^2 of its energy, and
                # gains as much where it ends: a quarter at most. The dashpot acts a step more or less.
                off = 0.96 * ((1 - (math.pi / 2 / n) ** 2) ** -0.5 - 1) + 0.04 / n
                print(f"{model}, {angle} degrees, {n:.1f} steps a contact: e {min(e):.4f} to {max(e):.4f}, bound {off:.4f}")
                self.assertLess(max(abs(x - 0.96) for x in e), off)

    def test_make_refuses_a_step_of_half_a_contact(self):
        for per_contact, code in ((1.95, 2), (2.05, 0)):
            run, *_ = contacts.impacts(self.at(), "linear", per_contact, count=4)
            done = run.shell(trial.BEDSCOPE, "case", "make", run.scene, "-o", self.at(), "--quiet", fails=True)
            self.assertEqual(done.returncode, code, done.stderr)


class BedAtRest(Edge):
    def test_a_bed_comes_to_rest_unless_steps_are_long(self):
        for model, limits in contacts.LIMITS.items():
            run, speed = contacts.bed(self.at(), model, 1.4, time=0.02, count=64)
            self.assertTrue(speed is None or speed > 1, f"{model}: {speed}")
            self.assertWarned(run, *limits)
            run, speed = contacts.bed(self.at(), model, 4.9, count=64)
            # At rest: what is left would lift a sphere by less than 1e-4 of its diameter.
            self.assertLess(speed, 1e-2)
            self.assertWarned(run, *limits)
            n = 4.9 * 2 / min(run.check()[1][name]["margin"] for name in limits)
            run, speed = contacts.bed(self.at(), model, n, count=64)
            self.assertSilent(run, *limits)
            self.assertLess(speed, 1e-2)


class Riser(Edge):
    def test_spheres_are_thrown_out_of_a_riser_by_long_steps_only(self):
        limits = contacts.LIMITS["linear"]
        run, speed = contacts.riser(self.at(), 1.5, time=0.3)
        self.assertIsNone(speed)
        self.assertWarned(run, *limits)
        run, speed = contacts.riser(self.at(), 4.9, time=0.3)
        self.assertLess(speed, 1)  # no sphere goes faster than what carries it
        self.assertWarned(run, *limits)
        n = 4.9 * 2 / min(run.check()[1][name]["margin"] for name in limits)
        run, speed = contacts.riser(self.at(), n, time=0.3)
        self.assertSilent(run, *limits)
        self.assertLess(speed, 1)


class Overlap(Edge):
    LIMIT = "overlap over radius at walls"

    def test_a_soft_sphere_goes_through_a_wall_long_after_the_warning(self):
        run, found, back = contacts.overlap(self.at(), 100.0, 5.55)
        self.assertFalse(back)
        self.assertGreater(contacts.largest_overlap(100.0, 5.55, 0.86), contacts.D / 2)
        self.assertWarned(run, self.LIMIT)
        run, found, back = contacts.overlap(self.at(), 1600.0, 5.55)
        self.assertTrue(back)
        self.assertWarned(run, self.LIMIT)
        # Twenty steps a contact see its maximum within cos(pi / 40), and its phase moves it by (pi / 20)^2 / 4.
        expected = contacts.largest_overlap(1600.0, 5.55, 0.86) / (contacts.D / 2)
        self.assertAlmostEqual(found / expected, 1, delta=0.01)
        speed = run.check()[0]["impact velocity of 1 % overlap at walls"] / 2
        run, found, back = contacts.overlap(self.at(), 1600.0, speed)
        self.assertSilent(run, self.LIMIT)
        self.assertTrue(back)
        self.assertAlmostEqual(found, 0.005, delta=0.005 * 0.01)


class ParticleDrag(Edge):
    LIMIT = "gas step over the particles' relaxation time"

    def test_the_slip_of_a_lone_sphere_grows_beyond_twice_its_relaxation_time(self):
        for ratio, grows, warned in ((2.4, True, True), (1.8, False, True), (0.45, False, False)):
            run, slip = drag.lone(self.at(), ratio)
            found = drag.growth(slip[:6])  # a slip that has grown far is no longer in creeping flow
            # The first half step of LIGGGHTS still has the force of before: q of it, of 20 steps.
            q, x = 1 / 40, ratio
            half = (1 - x * (1 - q)) / 2
            root = abs(half) + math.sqrt(half**2 - x * q) if half**2 > x * q else math.sqrt(x * q)
            print(f"lone, {ratio} relaxation times: {found:.3f} a step, by theory {root:.3f}")
            self.assertEqual(found > 1, grows)
            self.assertAlmostEqual(found / root, 1, delta=0.05)  # its drag is up to 2 % above Stokes'
            self.assertWarned(run, self.LIMIT) if warned else self.assertSilent(run, self.LIMIT)

    def test_a_plug_swings_ever_farther_beyond_the_edge_that_its_pressure_makes(self):
        for ratio, fails, warned in ((2.2, True, True), (0.6, False, True), (0.2, False, False)):
            run, slip = drag.plug(self.at(), ratio, voidage=0.45)
            found = drag.swing(slip)
            print(f"plug, {ratio}: swing {found:.3g} of the first slip")
            self.assertEqual(found > 1, fails)
            self.assertWarned(run, self.LIMIT) if warned else self.assertSilent(run, self.LIMIT)


class GasDrag(Edge):
    LIMIT = "explicit drag on the gas"

    def test_explicit_drag_grows_beyond_two_and_implicit_never(self):
        for ratio, grows, warned in ((3, True, True), (1.5, False, True), (0.5, False, False)):
            run, changes = drag.fixed_bed(self.at(), ratio, False)
            found = drag.growth(changes, 1e-7)
            print(f"explicit, {ratio}: {found:.3f} a step, by theory {abs(1 - ratio):.3f}")
            self.assertEqual(found > 1, grows)
            self.assertWarned(run, self.LIMIT) if warned else self.assertSilent(run, self.LIMIT)
        run, changes = drag.fixed_bed(self.at(), 8, True)
        self.assertLess(drag.growth(changes, 1e-7), 1)
        self.assertNotIn(self.LIMIT, run.check()[1])


class Cells(Edge):
    def test_a_sphere_that_crosses_a_face_moves_the_voidage_as_its_points_do(self):
        for ratio in (60, 3.6):
            for method, part in (("centre", 1), ("divided", 9 / 29)):
                run, jump = cells.crossing(self.at(), ratio, method, moves=12)
                self.assertAlmostEqual(jump * ratio, part, 6)
                if ratio == 3.6:
                    self.assertWarned(run, "dV/V_p")
                elif method == "divided":  # by centre the limit is 52
                    self.assertSilent(run, "dV/V_p")

    def test_cells_overfill_after_the_warning(self):
        places = cells.settled(self.at())
        for method, points in (("centre", ((8, True, True), (4, False, None), (2, False, False))),
                               ("divided", ((12, True, True), (8, False, True), (3, False, False)))):
            for across, overfull, warned in points:
                run, most, share = cells.packed(self.at(), places, across, method)
                print(f"{method}, edge {12 / across:.2f} d: largest holdup {most:.3f}")
                self.assertEqual(most > cells.DENSEST, overfull)
                name = "cell edge over diameter"
                if warned is not None:  # an edge of 3 is the limit itself
                    self.assertWarned(run, name) if warned else self.assertSilent(run, name)


class Heat(Edge):
    def test_temperatures_swing_ever_farther_beyond_the_edge(self):
        limit = "gas step over the particles' thermal time"
        for each, capacity in ((1, 0.4), (8, 8.0)):
            for part, grows, warned in ((1.3, True, True), (0.7, False, True), (0.25, False, False)):
                ratio = heat.Column(capacity=capacity).part_of_edge(part, each)
                run, worst, edge = heat.large_step(self.at(), ratio, each, capacity=capacity)
                print(f"{each} to a cell, {part} of the edge ({ratio:.2f} thermal times): {worst:.3g} of the step beyond")
                self.assertEqual(worst > 1, grows)
                if warned:
                    self.assertWarned(run, limit)
                else:
                    self.assertSilent(run, limit)
                    self.assertLess(worst, 0.01)  # the limited scheme of the gas alone, in cells of 2.8 exchange lengths

    def test_a_coarse_grid_moves_the_front_after_the_warning(self):
        limit = "cell height over exchange length"
        for each, warned in ((8, True), (4, True), (1, False)):
            run, off, length = heat.grid(self.at(), each, xi=4.0, tau=4.0, steps=600)
            print(f"cells of {length:.2f} exchange lengths: off by {off:.2%} of the step")
            self.assertEqual(off > 0.02, each == 8)
            self.assertWarned(run, limit) if warned else self.assertSilent(run, limit)
            if not warned:
                self.assertLess(off, 0.01)


if __name__ == "__main__":
    if not trial.have_liggghts() or (not {"Collision", "BedAtRest", "Overlap"} & set(sys.argv[1:])
                                     and not trial.have_coupled()):
        print("no LIGGGHTS or no coupled solver: skipped")
        sys.exit(77)
    unittest.main()
