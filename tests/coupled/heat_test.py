# SPDX-License-Identifier: BSD-3-Clause
"""Heat: a fixed bed against its one-dimensional equations, a stirred bed against its balance."""
import math
import unittest

import numpy

from deck import Case
from support import folder

D, RHO, H = 0.85e-3, 2500.0, 100.0
GAS = dict(density=1.2, viscosity=1.8e-5)
CP_GAS, K_GAS, CP_SOLID = 1000.0, 0.025, 800.0
COLD, HOT = 300.0, 400.0


def column(xi_end, tau_end, source, cells=800):
    """Gas and particle temperature over xi at tau_end, 0 at the start, 1 at the inlet: trapezoidal
    rule along both characteristics of dG/dxi = P - G, dP/dtau = G - P + source."""
    a, b = xi_end / cells / 2, tau_end / cells / 2
    solid = numpy.zeros(cells + 1)
    gas = numpy.empty(cells + 1)

    def sweep(known):  # gas and solid at a level, where P = (known + b G) / (1 + b)
        gas[0] = 1.0
        new = numpy.empty(cells + 1)
        new[0] = (known[0] + b * gas[0]) / (1 + b)
        c = b / (1 + b)
        for n in range(cells):
            gas[n + 1] = (gas[n] * (1 - a) + a * new[n] + a * known[n + 1] / (1 + b)) / (1 + a - a * c)
            new[n + 1] = (known[n + 1] + b * gas[n + 1]) / (1 + b)
        return new

    gas[0] = 1.0
    for n in range(cells):  # before the first step the particles are cold
        gas[n + 1] = gas[n] * (1 - a) / (1 + a)
    for _ in range(cells):
        solid = sweep(solid + b * (gas - solid) + 2 * b * source)
    return gas, solid


class FixedBed(unittest.TestCase):
    """Spheres one above the other in a column of cells as wide as their distance."""
    EDGE, COUNT, U = 1e-3, 100, 1.0

    def case(self, name, source):
        e, n = self.EDGE, self.COUNT
        start = f"run 0\nset group all property/atom heatSource {source}\n" if source else ""
        return Case(folder(self, name), (e, e, e * n), (1, 1, n), gas=GAS, velocity=self.U, dt=0.02, dem_steps=1,
                    end=40.0, write_interval=20.0, moving=False, walls=False, gravity=0.0, tolerance=1e-9,
                    spheres=[(1, D, RHO, e / 2, e / 2, e * (k + 0.5)) for k in range(n)], start=start,
                    dem="dump t all custom 1000 DEM/post/dump*.liggghts id type x y z vx vy vz radius f_Temp\n",
                    heat=f"energy {{ heatCapacity {CP_GAS}; conductivity {K_GAS}; exchange {H}; axialConduction none; }}\n"
                         "output { history 1; }", temperature=(COLD, HOT), heat_solid=(CP_SOLID, 1.0),
                    schemes={"U": "Gauss upwind", "T": "Gauss linear"}).write()

    def check(self, source):
        case = self.case(f"q{source:g}", source)
        case.run()
        volume, area = math.pi / 6 * D**3, math.pi * D**2
        flow = GAS["density"] * CP_GAS * self.U * self.EDGE**2  # [W/K]
        for time in (20.0, 40.0):
            xi_end = H * area * self.COUNT / flow
            tau = H * area * time / (RHO * CP_SOLID * volume)
            gas, solid = column(xi_end, tau, source / (H * area * (HOT - COLD)))
            rows = case.dump(round(time / 0.02))
            found_gas = case.read_field(f"{time:g}", "T")
            at = numpy.linspace(0, xi_end, len(gas))
            centres = (numpy.arange(self.COUNT) + 0.5) / self.COUNT * xi_end
            off_solid = max(abs(rows[k + 1]["f_Temp"] - COLD - (HOT - COLD) * s)
                            for k, s in enumerate(numpy.interp(centres, at, solid)))
            off_gas = max(abs(t - COLD - (HOT - COLD) * g)
                          for t, g in zip(found_gas, numpy.interp(centres, at, gas)))
            scale = max(HOT - COLD, (HOT - COLD) * solid.max())
            print(f"source {source:g} W, {time:g} s, xi {xi_end:.1f}, tau {tau:.1f}: particles within "
                  f"{off_solid / scale:.2%}, gas {off_gas / scale:.2%} of the step")
            self.assertLess(max(off_solid, off_gas) / scale, 0.01)
        kept = case.record()["conservation"]
        # All that the particles hold more came from the gas or from their source.
        gained = RHO * CP_SOLID * volume * sum(row["f_Temp"] - COLD for row in rows.values())
        given = kept["heat_from_gas_to_particles"] + source * self.COUNT * 40.0
        print(f"heat of the particles over what they were given, less 1: {gained / given - 1:.1e}")
        # What the last of the 2,000 gas steps gave is taken up in the next one.
        self.assertAlmostEqual(gained / given, 1, delta=1 / 2000)

    def test_heated_bed_follows_anzelius_and_schumann(self):
        self.check(0.0)

    def test_heated_bed_with_a_source_follows_its_equations(self):
        self.check(1e-3)


class StirredBed(unittest.TestCase):
    def test_bubbling_bed_with_a_source_comes_to_its_equilibrium_temperature(self):
        spacing, across, deep, layers = 1.08e-3, 8, 4, 10
        d, rho, u, source = 1e-3, 667.0, 0.5, 6.64e5
        gas = dict(density=1.49, viscosity=1e-5)
        spheres = [(1, d, rho, (i + 0.5) * spacing, (j + 0.5) * spacing, (k + 0.5) * spacing)
                   for k in range(layers) for j in range(deep) for i in range(across)]
        width, depth = across * spacing, deep * spacing
        cp_gas, k_gas, inlet = 1670.0, 0.0209, 330.0
        heat = source * math.pi / 6 * d**3
        rise = len(spheres) * heat / (gas["density"] * cp_gas * u * width * depth)
        time = len(spheres) * math.pi / 6 * d**3 * rho * cp_gas / 100 / (gas["density"] * cp_gas * u * width * depth)
        case = Case(folder(self), (width, depth, 0.04), (4, 2, 18), gas=gas, velocity=u, dt=4e-4, dem_steps=20,
                    end=0.8, spheres=spheres, start=f"run 0\nset group all property/atom heatSource {heat}\n",
                    heat=f"energy {{ heatCapacity {cp_gas}; conductivity {k_gas}; }}\noutput {{ history 0.01; }}",
                    temperature=(inlet + rise, inlet), solid_start=inlet + rise, heat_solid=(cp_gas / 100, 1.0),
                    contacts=dict(density=rho, kn=200.0, kt=60.0, restitution=0.6, wall_restitution=0.6, friction=0.1),
                    tolerance=1e-8).write()
        case.run()
        rows = [r for r in case.history() if r["time"] > 0.4]
        mean = lambda key: sum(r[key] for r in rows) / len(rows)
        print(f"thermal time {time:.3f} s; gas out {mean('gas_temperature_out') - inlet:.3f} K above the inlet, "
              f"balance {rise:.3f} K; particles {mean('particle_temperature') - inlet:.3f} K")
        self.assertAlmostEqual((mean("gas_temperature_out") - inlet) / rise, 1, delta=0.01)


if __name__ == "__main__":
    unittest.main()
