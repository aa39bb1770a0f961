# SPDX-License-Identifier: BSD-3-Clause
"""The voidage of gas cells against the size of the particles in them, divided and by centre."""
import math

from trial import Trial

D, RHO = 0.85e-3, 2500.0
SPHERE = math.pi / 6 * D**3
GAS = dict(density=1.2, viscosity=1.8e-5, velocity=0.1)
CONTACT = dict(normal_stiffness=200.0, restitution=0.6, friction=0.3, impact_velocity=0.1)
SLIPPING = dict(sides="free-slip", front_back="free-slip")
METHODS = ("centre", "divided")


def crossing(folder, ratio, method, moves=40):
    """One sphere crosses a face between cells of `ratio` of its volume, a twentieth of its diameter a step: the largest
    change of a cell's voidage in a step. By theory V_p/dV by centre; divided 9/29 of it, as nine of 29 points lie in the
    plane of the centre, and all where the cell takes the whole sphere at once."""
    edge = (ratio * SPHERE) ** (1 / 3)
    cells = 2 * math.ceil((2.5 * D + edge) / edge / 2)
    size, step = cells * edge, 1e-4
    x = size / 2 - moves / 2 * D / 20
    middle = (cells // 2 + 0.5) * edge
    trial = Trial(folder, title="A sphere crosses a face", gravity=0.0, walls=SLIPPING,
                  geometry=dict(width=size, depth=size, height=size), gas=GAS, species=dict(diameter=D, density=RHO),
                  particles=dict(arrangement="single", position=[x, middle, middle],
                                 velocity=[D / 20 / step, 0.0, 0.0]),
                  contact=CONTACT, models=dict(void_fraction=method),
                  numerics=dict(grid=[cells] * 3, dem_step=step / 10, gas_step=step, output=step, end=moves * step))
    trial.make().ascii_fields()
    trial.change("CFD/constant/coupledProperties", "drag         beetstra", "drag         none")
    trial.change("CFD/constant/coupledProperties", f"method {method};", f"method {method}; floor 1e-9;")
    trial.run_coupled()
    fields = [trial.field(k * step, "voidfraction") for k in range(1, moves + 1)]
    return trial, max(abs(a - b) for u, v in zip(fields, fields[1:]) for a, b in zip(u, v))


def settled(folder, side=12.0, height=24.0, count=2000):
    """Places of spheres that have settled in a box, from LIGGGHTS."""
    trial = Trial(folder, title="A settled bed", geometry=dict(width=side * D, depth=side * D, height=height * D),
                  species=dict(diameter=D, density=RHO), particles=dict(number=count), contact=CONTACT,
                  numerics=dict(dem_step=1.2e-5, output=0.12, end=0.12)).make()
    trial.run_particles()
    return [(r["x"], r["y"], r["z"]) for r in trial.dump(trial.steps()[-1]).values()]


def packed(folder, places, cells, method, side=12.0):
    """A settled bed on gas cells, `cells` along a side: the largest holdup of a cell, and the share of cells below the
    bed's top that hold more than spheres can fill (pi / sqrt(18))."""
    edge = side * D / cells
    layers = math.ceil(26 * D / edge)
    step = 1e-5
    trial = Trial(folder, title="A settled bed on gas cells", walls=SLIPPING,
                  geometry=dict(width=side * D, depth=side * D, height=layers * edge), gas=GAS,
                  species=dict(diameter=D, density=RHO), particles=dict(number=len(places), fixed=True),
                  models=dict(void_fraction=method),
                  numerics=dict(grid=[cells, cells, layers], dem_step=step, gas_step=step, output=step, end=step))
    trial.make().ascii_fields()
    trial.change("CFD/constant/coupledProperties", f"method {method};", f"method {method}; floor 1e-9;")
    trial.move(lambda x, y, z, to=iter(places): next(to))
    trial.run_coupled()
    holdup = [1 - eps for eps in trial.field(step, "voidfraction")]
    bed = holdup[:cells * cells * int(10 * D / edge)]
    return trial, max(bed), sum(h > DENSEST for h in bed) / len(bed)


DENSEST = math.pi / math.sqrt(18)
