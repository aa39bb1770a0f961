# SPDX-License-Identifier: BSD-3-Clause
"""What cannot run is refused with one line and exit code 2."""
import subprocess
import unittest

from deck import PROGRAM, ENV, Case
from support import folder


def case(at, **options):
    return Case(at, (0.01, 0.01, 0.02), (2, 2, 4), velocity=0.1, dt=1e-4, dem_steps=10, end=1e-3,
                spheres=[(1, 1e-3, 2500.0, 0.005, 0.005, 0.005)], **options).write()


def run(one, *options):
    done = subprocess.run([PROGRAM, *options], cwd=one.folder, env=ENV, text=True, capture_output=True)
    return done.returncode, done.stderr.strip()


class Input(unittest.TestCase):
    def refused(self, one, *words, options=()):
        code, error = run(one, *options)
        self.assertEqual(code, 2, error)
        self.assertEqual(len(error.splitlines()), 1, error)
        for word in words:
            self.assertIn(word, error)
        self.assertFalse((one.folder / "run.json").exists())

    def edited(self, path, old, new):
        one = case(folder(self))
        file = one.folder / path
        self.assertIn(old, file.read_text())
        file.write_text(file.read_text().replace(old, new))
        return one

    PROPERTIES = "CFD/constant/coupledProperties"

    def test_an_unknown_key_is_named_with_those_known(self):
        self.refused(self.edited(self.PROPERTIES, "drag beetstra", "dragLaw beetstra"), "unknown key 'dragLaw'", "demSteps")

    def test_an_unknown_drag_law_is_named_with_those_known(self):
        self.refused(self.edited(self.PROPERTIES, "drag beetstra", "drag beatstra"), "'beatstra'", "gidaspow")

    def test_a_negative_density_is_refused(self):
        self.refused(self.edited(self.PROPERTIES, "density 1.2", "density -1.2"), "density", "positive")

    def test_time_steps_that_do_not_agree_are_refused_with_both(self):
        self.refused(self.edited(self.PROPERTIES, "demSteps 10", "demSteps 9"), "0.000090 s", "0.000100 s")

    def test_a_missing_field_is_named(self):
        one = case(folder(self))
        (one.folder / "CFD/0/voidfraction").unlink()
        self.refused(one, "voidfraction")

    def test_a_missing_deck_is_named(self):
        one = case(folder(self))
        (one.folder / "DEM/in.liggghts").unlink()
        self.refused(one, "DEM/in.liggghts")

    def test_an_error_of_liggghts_is_passed_on(self):
        self.refused(self.edited("DEM/in.liggghts", "pair_coeff", "pair_cooff"), "LIGGGHTS", "Unknown command: pair_cooff")

    def test_a_deck_without_the_fix_that_takes_the_force_is_refused(self):
        self.refused(self.edited("DEM/in.liggghts", "fix drag all couple/cfd/force", ""), "couple/cfd/force")

    def test_nothing_to_resume_is_said(self):
        self.refused(case(folder(self)), "checkpoint", options=["--resume"])

    def test_an_unknown_option_is_refused(self):
        code, error = run(case(folder(self)), "--restart")
        self.assertEqual(code, 2)
        self.assertIn("usage", error)

    def test_a_lost_particle_is_an_error(self):
        one = Case(folder(self), (0.01, 0.01, 0.02), (2, 2, 4), drag="none", walls=False, dt=1e-4, dem_steps=10,
                   end=0.05, spheres=[(1, 1e-3, 2500.0, 0.005, 0.005, 0.0, 0, 0, -1.0)]).write()
        self.refused(one, "LIGGGHTS lost 1 particle")

    def test_a_second_start_does_not_overwrite_a_checkpoint(self):
        one = case(folder(self))
        self.assertEqual(run(one)[0], 0)
        code, error = run(one)
        self.assertEqual(code, 2)
        self.assertIn("--resume", error)
        self.assertEqual(run(one, "--again")[0], 0)


if __name__ == "__main__":
    unittest.main()
