# SPDX-License-Identifier: BSD-3-Clause
"""A bubbling bed of 320 spheres with a source in each, started at its equilibrium.

Expected: gas that leaves warmer than it came by the sources' power over the gas' heat flow. The heat capacity
of the spheres is a hundredth of a real one, so that the thermal time is shorter than the window.
"""
import math

from deck import Case

TITLE = "Equilibrium temperature of a well-mixed heated bed"


def verify(study):
    spacing, across, deep, layers = 1.08e-3, 8, 4, 10
    d, rho, u, source = 1e-3, 667.0, 0.5, 6.64e5
    gas = dict(density=1.49, viscosity=1e-5)
    spheres = [(1, d, rho, (i + 0.5) * spacing, (j + 0.5) * spacing, (k + 0.5) * spacing)
               for k in range(layers) for j in range(deep) for i in range(across)]
    width, depth, volume = across * spacing, deep * spacing, math.pi / 6 * d**3
    cp_gas, inlet = 1670.0, 330.0
    flow = gas["density"] * cp_gas * u * width * depth  # [W/K]
    rise = len(spheres) * source * volume / flow
    thermal_time = len(spheres) * volume * rho * cp_gas / 100 / flow
    begin, end = 0.3, 1.0
    assert end - begin > 2 * thermal_time
    case = Case(study.folder / "case", (width, depth, 0.04), (4, 2, 18), gas=gas, velocity=u, dt=4e-4, dem_steps=20,
                end=end, spheres=spheres, start=f"run 0\nset group all property/atom heatSource {source * volume}\n",
                heat=f"energy {{ heatCapacity {cp_gas}; conductivity 0.0209; }}\noutput {{ history 0.01; }}",
                temperature=(inlet + rise, inlet), solid_start=inlet + rise, heat_solid=(cp_gas / 100, 1.0),
                contacts=dict(density=rho, kn=200.0, kt=60.0, restitution=0.6, wall_restitution=0.6, friction=0.1),
                tolerance=1e-8).write()
    case.run()
    rows = case.history()
    study.series("bed", (begin, end), gas_out=("K", [(r["time"], r["gas_temperature_out"] - inlet) for r in rows]))
    study.check("bed", "series: gas out", rise, "relative bias", 0.01, f"""
        1 % of the rise of {rise:.3f} K. What the bed stores or gives back while it swings averages out over the window, which is
        {(end - begin) / thermal_time:.1f} thermal times long.""")
