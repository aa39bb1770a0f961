# SPDX-License-Identifier: BSD-3-Clause
"""What the solver offers beside the verified core, each on a case as small as shows it."""
import math
import os
import pathlib
import re
import resource
import signal
import subprocess
import time
import unittest

import packed_bed
import restart
from deck import ENV, PROGRAM, RISER, Case
from laws import pressure_gradient, rebound, terminal_velocity, beetstra
from support import folder

D, RHO = 0.85e-3, 2500.0
BEDSCOPE = os.environ.get("BEDSCOPE", "bedscope")
CASES = pathlib.Path(__file__).resolve().parents[2] / "cases"


class Killed(unittest.TestCase):
    def test_a_run_that_is_killed_loses_its_last_interval_alone(self):
        base = folder(self)
        def case(name):
            one = restart.case(base / name, 0.04)
            file = one.folder / "CFD/constant/coupledProperties"
            file.write_text(file.read_text().replace("checkpoint 0.02", "checkpoint 0.004"))
            return one
        whole, cut = case("whole"), case("cut")
        whole.run()
        process = subprocess.Popen([PROGRAM], cwd=cut.folder, env=ENV, stdout=subprocess.DEVNULL)
        reached = lambda: max((int(p.name) for p in (cut.folder / "checkpoint").glob("[0-9]*")), default=0)
        while process.poll() is None and reached() < 60:
            time.sleep(0.005)
        process.send_signal(signal.SIGKILL)
        self.assertEqual(process.wait(), -signal.SIGKILL)  # it was still running
        kept, rows = reached(), len(cut.history())
        self.assertGreaterEqual(kept, 60)
        self.assertLessEqual(rows - kept, 20 + 1)  # gas steps lost: at most those of an interval
        cut.run("--resume")
        one, other = restart.contents(whole), restart.contents(cut)
        self.assertEqual(list(one), list(other))
        self.assertEqual([n for n in one if one[n] != other[n]], [])
        print(f"killed after step {rows}, resumed at {kept}; {len(one)} files equal to the bit")
        cut.run("--resume")  # nothing is left to do
        self.assertEqual(cut.record()["state"], "done")
        self.assertEqual(restart.contents(cut), other)


class Costs(unittest.TestCase):
    def test_cpu_seconds_are_those_of_all_ranks_and_of_all_parts(self):
        def used():
            spent = resource.getrusage(resource.RUSAGE_CHILDREN)
            return spent.ru_utime + spent.ru_stime
        case = restart.case(folder(self), 0.02)  # long beside what starting costs
        case.shell("decomposePar", "-case", "CFD")
        before = used()
        case.run(ranks=2, decompose=False)
        restart.go_on(case, 0.04, 2)
        counted, spent = case.record()["costs"]["cpu_seconds"], used() - before
        print(f"{counted:.2f} s of CPU, {spent:.2f} s by the system's count")
        self.assertLess(counted, spent)
        # What is not counted is the end of a process, and mpirun. A rank or a part that is forgotten leaves a half.
        self.assertGreater(counted, 0.7 * spent)


class Drag(unittest.TestCase):
    def relaxation(self, case):
        """beta / (eps rho) of the densest cell [1/s]."""
        return max(pressure_gradient(e, e * u[2], D, 1.2, 1.8e-5) / (u[2] * 1.2)
                   for e, u in zip(case.read_field("0.02", "voidfraction"), case.read_field("0.02", "U")) if e < 1 and u[2] > 0)

    def test_explicit_drag_is_implicit_drag_below_its_limit_and_blows_up_above(self):
        base = folder(self)
        implicit = packed_bed.case(base / "implicit", 0.15)
        implicit.run()
        rate = self.relaxation(implicit)
        drop = implicit.history()[-1]["pressure_drop"]
        def explicit(name, share):
            dt = float(f"{share / rate:.2g}")
            return packed_bed.case(base / name, 0.15, dt=dt, end=100 * dt, extra="dragCoupling explicit;")
        stable = explicit("stable", 1.0)
        stable.run()
        found = stable.history()[-1]["pressure_drop"]
        print(f"limit {2 / rate:.3g} s; at half of it {found:.3f} Pa, implicit {drop:.3f} Pa")
        # Either moves by some per cent with a step of this size: where the voidage varies, 1 / A does.
        self.assertAlmostEqual(found / drop, 1, delta=5e-2)
        unstable = explicit("unstable", 3.0)
        done = subprocess.run([PROGRAM], cwd=unstable.folder, env=ENV, text=True, capture_output=True)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1), done.stderr)
        self.assertIn("implicit drag", done.stderr)

    def test_two_sizes_keep_each_its_own_terminal_velocity(self):
        size, cells, sizes, gas, end = (0.15, 0.15, 0.5), (3, 3, 10), (0.85e-3, 0.7e-3), 4.6, 0.4
        def terminal(d):
            voidage = 1 - math.pi / 6 * d**3 / math.prod(s / c for s, c in zip(size, cells))
            return terminal_velocity(beetstra, voidage, d, RHO, 1.2, 1.8e-5)
        spheres = [(n, d, RHO, 0.025 + 0.1 * (n - 1), 0.025 + 0.1 * (n - 1), 0.25, 0, 0, gas - terminal(d))
                   for n, d in enumerate(sizes, 1)]
        case = Case(folder(self), size, cells, velocity=gas, dt=1e-2, dem_steps=5, end=end, dump_every=200, spheres=spheres).write()
        case.run()
        for n, d in enumerate(sizes, 1):
            slip = gas - case.dump(200)[n]["vz"]
            print(f"d {d}: slip {slip:.4f}, terminal velocity {terminal(d):.4f} m/s")
            # A drag that is wrong by 1 % changes it by 0.01 g x 0.4 s = 0.04 m/s; the gas of each of the three cells
            # that it passes is slowed by F / (rho U A) = 6e-4 m/s at most.
            self.assertAlmostEqual(slip, terminal(d), delta=0.01)


class Voidage(unittest.TestCase):
    def test_centre_method_puts_each_sphere_into_the_cell_of_its_centre(self):
        one = packed_bed.case(folder(self), 0.15, extra="voidFraction { method centre; }")
        one.run()
        edge = packed_bed.EDGE
        count = {}
        for _, _, _, *at in one.spheres:
            cell = tuple(int(x / edge) for x in at)
            count[cell] = count.get(cell, 0) + 1
        nx, ny, _ = one.cells
        for n, eps in enumerate(one.read_field("0.02", "voidfraction")):
            here = count.get((n % nx, n // nx % ny, n // nx // ny), 0)
            self.assertAlmostEqual(1 - eps, here * math.pi / 6 * D**3 / edge**3, delta=1e-9)
        self.assertAlmostEqual(one.history()[-1]["pressure_drop"] / packed_bed.summed(one, "0.02"), 1, delta=2e-3)

    def test_spheres_of_a_wall_type_are_no_particles(self):
        spheres = [(2, D, RHO, 0.005, 0.005, z * 1e-3) for z in range(2, 9)] + [(1, D, RHO, 0.005, 0.005, 0.009, 0, 0, -0.5)]
        case = Case(folder(self), (0.01, 0.01, 0.02), (4, 4, 8), velocity=0.5, dt=1e-4, dem_steps=10, end=0.01,
                    spheres=spheres, extra="wallTypes (2);", dump_every=1000).write()
        deck = case.folder / "DEM/in.liggghts"
        deck.write_text(deck.read_text().replace("fix integrate all", "group moving type 1\nfix integrate moving"))
        case.run()
        self.assertEqual(case.history()[-1]["particles"], 1)
        solids = sum(1 - e for e in case.read_field("0.01", "voidfraction")) * 1e-6 * 2 / 128
        self.assertAlmostEqual(solids / (math.pi / 6 * D**3), 1, delta=1e-6)
        self.assertGreater(case.dump(1000)[8]["vz"], 0)  # it bounced off them


class Contacts(unittest.TestCase):
    def test_hertz_contacts_run_with_the_restitution_of_the_deck(self):
        case = Case(folder(self), (0.012, 0.012, 0.012), (2, 2, 2), drag="none", gravity=0.0, closed=True, dt=1e-4,
                    dem_steps=100, end=1e-3, dump_every=1000,
                    spheres=[(1, D, RHO, 0.004, 0.004, 0.004, 1.0, 0, 0), (1, D, RHO, 0.0052, 0.004, 0.004)]).write()
        deck = case.folder / "DEM/in.liggghts"
        text = re.sub(r"fix (kn|kt|gamman|gammat) .*\n", "", deck.read_text()).replace("hooke/stiffness", "hertz")
        text = text.replace("pair_style", "fix youngs all property/global youngsModulus peratomtype 5e6 5e6\n"
                            "fix poisson all property/global poissonsRatio peratomtype 0.25 0.25\npair_style", 1)
        deck.write_text(text)
        case.run()
        rows = case.dump(1000)
        e = rows[2]["vx"] - rows[1]["vx"]
        print(f"e {e:.4f} of {RISER['restitution']}")
        # The dashpot of LIGGGHTS' Hertz model (Tsuji et al. 1992) gives e whatever the speed; the contact takes
        # some 100 steps, where a linear one is off by up to 0.0008 (laws.rebound).
        self.assertAlmostEqual(e, RISER["restitution"], delta=2e-3)


class LongRuns(unittest.TestCase):
    def test_steps_beyond_a_million_and_beyond_31_bits_keep_their_names_and_counts(self):
        for first in (0, 2**31 - 600_000):
            case = Case(folder(self, f"from{first}"), (0.01, 0.01, 0.02), (2, 2, 4), drag="beetstra", velocity=0.1,
                        dt=0.05, dem_steps=100_000, end=0.6, spheres=[(1, D, RHO, 0.005, 0.005, D / 2)],
                        dump_every=100_000, write_interval=0.3, extra="output { checkpoint 0.3; }").write()
            if first:
                deck = case.folder / "DEM/in.liggghts"
                deck.write_text(deck.read_text().replace("timestep", f'if "${{resumed}} == 0" then "reset_timestep {first}"\ntimestep', 1))
            case.run()
            names = {p.name for p in (case.folder / "DEM/post").iterdir()}
            last = first + 1_200_000
            last_aligned = last - last % 100_000
            self.assertIn(f"dump{last_aligned}.liggghts", names)
            text = (case.folder / f"DEM/post/dump{last_aligned}.liggghts").read_text()
            self.assertEqual(text.splitlines()[1], str(last_aligned))
            self.assertEqual(case.record()["time"]["dem_steps"], 1_200_000)
            self.assertTrue((case.folder / "CFD/0.6/U").exists())
            row = case.dump(last_aligned)[1]
            self.assertAlmostEqual(row["z"], D / 2, delta=1e-5 * D)


class Scenes(unittest.TestCase):
    """Decks of `bedscope case make`, their first moments."""

    def made(self, scene, end, **changes):
        at = folder(self)
        subprocess.run([BEDSCOPE, "case", "make", str(CASES / scene), "-o", str(at), "--quiet"], check=True,
                       capture_output=True)
        case = Case(at, (1, 1, 1), (1, 1, 1))
        control = at / "CFD/system/controlDict"
        text = re.sub(r"endTime\s+[^;]+;", f"endTime {end};", control.read_text())
        control.write_text(re.sub(r"writeInterval\s+[^;]+;", f"writeInterval {end};", text))
        properties = at / "CFD/constant/coupledProperties"
        text = properties.read_text()
        for old, new in changes.items():
            text = re.sub(rf"{old}\s+[^;]+;", f"{old} {new};", text)
        properties.write_text(text)
        case.shell("blockMesh", "-case", "CFD")
        return case

    def test_feed_enters_from_the_side_at_its_mass_flow(self):
        case = self.made("riser/feed_side.toml", 0.003)
        case.run()
        inventory, last = case.record()["inventory"], case.history()[-1]
        sphere = RHO * math.pi / 6 * D**3
        flow = 32.0 * 0.07 * 0.006
        self.assertGreater(inventory["entered"], 20)
        self.assertAlmostEqual(inventory["mass_entered"] + inventory["mass_due"], flow * last["time"], delta=1e-9)
        self.assertLess(inventory["mass_due"], 5 * flow * 1e-4 + sphere)
        print(f"{inventory['entered']} entered from the side, {inventory['mass_due'] / sphere:.1f} are due")


if __name__ == "__main__":
    unittest.main()
