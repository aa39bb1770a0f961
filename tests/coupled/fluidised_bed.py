# SPDX-License-Identifier: BSD-3-Clause
"""A bed of 1,440 spheres without friction in gas of 0.65 m/s, little above its minimum fluidisation.

Expected: a pressure drop, without rho g h, of the weight less buoyancy over the cross-section: the plateau. What is missing are the blows of the particles on the floor: a bubbling bed of this size
lands on it 20 times a second, and its mean stays 5 to 10 % below.
"""
import random

from deck import RISER, Case

TITLE = "Plateau of a fluidised bed at its weight"
D, RHO, GAS = 0.85e-3, 2500.0, 1.2
SPACING = 0.92e-3
ACROSS, DEEP, LAYERS = 12, 6, 20
SIZE, CELLS = (ACROSS * SPACING, DEEP * SPACING, 0.04), (4, 2, 16)


def loose_bed(across, deep, layers, seed=1):
    rng = random.Random(seed)
    at = lambda n: (n + 0.5) * SPACING + rng.uniform(-1, 1) * 0.03e-3
    return [(1, D, RHO, at(i), at(j), at(k)) for k in range(layers) for j in range(deep) for i in range(across)]


def case(at, velocity, end, **options):
    return Case(at, SIZE, CELLS, velocity=velocity, dt=2e-4, dem_steps=20, end=end, tolerance=1e-8,
                spheres=loose_bed(ACROSS, DEEP, LAYERS), contacts=RISER | {"friction": 0.0}, write_interval=0.01,
                dump_every=1000, **options).write()


def verify(study):
    end, begin = 1.05, 0.15
    with_ = {"area": SIZE[0] * SIZE[1], "particle_density": RHO, "gas_density": GAS, "gravity": 9.81,
             "mass": ACROSS * DEEP * LAYERS * RHO * 3.14159265 / 6 * D**3}
    for velocity in (0.65,):
        label = f"U {velocity}"
        one = case(study.folder / f"u{velocity}", velocity, end)
        one.run()
        drop = [(r["time"], r["pressure_drop"]) for r in one.history()]
        study.series(label, (begin, end), pressure_drop=("Pa", drop))
        study.check(label, "series: pressure drop", "theory:bed weight", "relative bias", 0.05, """
            The floor feels a granular pressure of the order of rho_p phi theta where the weight is rho_p phi g H, H being
            the bed's height of 18 mm: with velocity fluctuations sqrt(theta) of 0.1 m/s that is 5 %.""", **{"with": with_})
