# SPDX-License-Identifier: BSD-3-Clause
"""A hundred spheres one above the other in a column of gas cells, cold, heated by gas of 1 m/s that enters 100 K
hotter; once without, once with a source in each sphere.

Expected: the closed form of Anzelius and Schumann, with the source (physics/fixed_bed), after 20 and 40 s; and
that the particles hold more by what gas and source gave.
"""
import math

from deck import Case

TITLE = "Heated fixed bed (Anzelius, Schumann), without and with source"
D, RHO, H = 0.85e-3, 2500.0, 100.0
EDGE, COUNT, U = 1e-3, 100, 1.0
GAS = dict(density=1.2, viscosity=1.8e-5)
CP_GAS, K_GAS, CP_SOLID = 1000.0, 0.025, 800.0
COLD, HOT = 300.0, 400.0
DT, END = 0.02, 40.0
SPHERE, AREA = math.pi / 6 * D**3, math.pi * D**2


def case(at, source):
    e = EDGE
    start = f"run 0\nset group all property/atom heatSource {source}\n" if source else ""
    return Case(at, (e, e, e * COUNT), (1, 1, COUNT), gas=GAS, velocity=U, dt=DT, dem_steps=1, end=END,
                write_interval=20.0, moving=False, walls=False, gravity=0.0, tolerance=1e-9, start=start,
                spheres=[(1, D, RHO, e / 2, e / 2, e * (k + 0.5)) for k in range(COUNT)],
                dem="dump t all custom 1000 DEM/post/dump*.liggghts id type x y z vx vy vz radius f_Temp\n",
                heat=f"energy {{ heatCapacity {CP_GAS}; conductivity {K_GAS}; exchange {H}; axialConduction none; }}\n",
                temperature=(COLD, HOT), heat_solid=(CP_SOLID, 1.0),
                schemes={"U": "Gauss upwind", "T": "Gauss linear"}).write()


def verify(study):
    bed = {"voidage": 1 - SPHERE / EDGE**3, "superficial_velocity": U, "gas_heat_capacity": GAS["density"] * CP_GAS,
           "solids_heat_capacity": RHO * CP_SOLID, "heat_exchange": H * AREA / EDGE**3,
           "initial_temperature": COLD, "inlet_temperature": HOT}
    for name, source in (("no source", 0.0), ("source", 1e-3)):
        one = case(study.folder / name.replace(" ", "_"), source)
        one.run()
        for time in (20.0, 40.0):
            label = f"{name}, {time:g} s"
            study.run(label, one, (time, time), (1, COUNT))
            for quantity, theory in (("axial temperature", "fixed bed"), ("axial gas temperature", "fixed bed gas")):
                study.check(label, quantity, f"theory:{theory}", "max error", 0.01 * (HOT - COLD),
                            "1 % of the step of the temperature: what is asked of the solver.",
                            **{"with": bed | {"time": time, "source": source / SPHERE}})
        rows = one.history()
        # A gas step gives its heat to the particles in the next one: what the last gave is not there yet.
        given = (one.record()["conservation"]["heat_from_gas_to_particles"] - rows[-1]["heat_to_particles"] * DT
                 + source * COUNT * END)
        gained = RHO * CP_SOLID * SPHERE * COUNT * (rows[-1]["particle_temperature"] - COLD)
        study.series(name + ", balance", heat_not_accounted_for=("-", [(END, gained / given - 1)]))
        study.check(name + ", balance", "series: heat not accounted for", 0.0, "max error", 1e-7, """
            history.csv gives the mean temperature with nine digits: of a rise of 10 K or more 2e-8.""")
