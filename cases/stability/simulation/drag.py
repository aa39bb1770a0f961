# SPDX-License-Identifier: BSD-3-Clause
"""The drag's step driven over its edge: on particles, and on the gas where it is taken explicitly."""
import itertools
import math
import random
import statistics

from trial import Trial

DENSITY, VISCOSITY = 1.2, 1.8e-5  # of the gas
SLIPPING = dict(sides="free-slip", front_back="free-slip")


def beetstra(eps, re):
    """F of Beetstra, van der Hoef and Kuipers (2007), Re superficial."""
    phi = 1 - eps
    return (10 * phi / eps**2 + eps**2 * (1 + 1.5 * math.sqrt(phi)) + 0.413 * re / (24 * eps**2)
            * (1 / eps + 3 * eps * phi + 8.4 * re**-0.343) / (1 + 10 ** (3 * phi) * re ** (-(1 + 4 * phi) / 2)))


def exchange(eps, re, d, viscosity=VISCOSITY):
    """beta [kg/m3/s]."""
    return 18 * viscosity * eps * (1 - eps) * beetstra(eps, re) / d**2


def slope(eps, re):
    """d ln F / d ln Re."""
    return math.log(beetstra(eps, re * 1.001) / beetstra(eps, re / 1.001)) / math.log(1.001**2)


def weak(step):
    """A contact so weak that spheres may overlap: here they only follow the gas."""
    return dict(normal_stiffness=LIGHT["density"] * math.pi / 6 * LIGHT["diameter"] ** 3 * (1e-3 / step) ** 2)


# Light spheres in a viscous gas: their drag is linear (Re below 0.1) and their relaxation time a few milliseconds.
LIGHT = dict(diameter=1e-3, density=100.0)
VISCOUS = dict(density=DENSITY, viscosity=1.8e-3, velocity=0.05)


def light_spheres(folder, title, step, gas_steps, grid, edge, implicit, particles):
    trial = Trial(folder, title=title, gravity=0.0, walls=SLIPPING,
                  geometry=dict(width=grid[0] * edge, depth=grid[1] * edge, height=grid[2] * edge), gas=VISCOUS,
                  species=LIGHT, particles=particles, contact=weak(step),
                  numerics=dict(grid=grid, dem_step=step / 20, gas_step=step, output=step, end=gas_steps * step),
                  models=dict(coupling="implicit" if implicit else "explicit"))
    return trial.make()


def lone(folder, ratio, implicit=True, gas_steps=16):
    """A sphere at rest in a gas stream, gas steps of `ratio` of its relaxation time: its slip, step by step, over that at
    the start. By theory it changes by 1 - ratio a step."""
    step = ratio * LIGHT["density"] * LIGHT["diameter"] ** 2 / (18 * VISCOUS["viscosity"])  # Stokes
    trial = light_spheres(folder, "A lone sphere", step, gas_steps, [3, 3, 8], 20e-3, implicit,
                          dict(arrangement="single", position=[30e-3, 30e-3, 45e-3]))
    trial.run_coupled()
    return trial, [1 - trial.dump(s)[1]["vz"] / VISCOUS["velocity"] for s in trial.steps()]


def plug(folder, ratio, implicit=True, gas_steps=16, count=1500, voidage=0.6):
    """Spheres at random places, at rest and free to move as a plug in a given flow of gas; gas steps of `ratio` of
    eps (1 - eps) rho_s / beta. Slip of those in the middle, step by step, over that at the start. By theory: `slips`."""
    grid, edge = [2, 2, 24], 3e-3
    filled = count * math.pi / 6 * LIGHT["diameter"] ** 3 / (1 - voidage) / (4 * edge**2)
    beta = exchange(voidage, 1e-3, LIGHT["diameter"], VISCOUS["viscosity"])
    step = ratio * voidage * (1 - voidage) * LIGHT["density"] / beta
    trial = light_spheres(folder, "A plug of spheres", step, gas_steps, grid, edge, implicit,
                          dict(number=count, arrangement="uniform"))
    rng = random.Random(1)
    places = [(rng.random() * 2 * edge, rng.random() * 2 * edge, rng.random() * filled + edge) for _ in range(count)]
    trial.move(lambda x, y, z, to=iter(places): next(to))
    trial.run_coupled()
    middle = [n for n, (*_, z) in enumerate(places, 1) if filled / 3 < z - edge < filled * 2 / 3]
    u, slip = VISCOUS["velocity"], []
    for s in trial.steps():
        rows = trial.dump(s)
        if len(rows) < count:
            break
        slip.append(1 - statistics.fmean(rows[n]["vz"] for n in middle) / u)
    return trial, slip


def fixed_bed(folder, ratio, implicit, u=0.5, d=0.85e-3, gas_steps=30):
    """Gas through spheres that are held, with gas steps of `ratio` of eps rho_g / (beta (1 + n)), n = d ln beta / d ln
    Re: by how much the gas velocity changes in each step, as root mean square over cells and over u; cut where it blew
    up. By theory it changes by a factor of 1 - ratio a step, explicit, and (1 - n x) / (1 + x), x = ratio / (1 + n),
    implicit."""
    across, layers, pitch = 12, 24, d / 0.94
    eps = 1 - math.pi / 6 * 0.94**3
    re = DENSITY * u * d / VISCOSITY
    n = slope(eps, re)
    step = ratio * eps * DENSITY / exchange(eps, re, d) / (1 + n)
    trial = Trial(folder, title="A fixed bed", walls=SLIPPING,
                  geometry=dict(width=across * pitch, depth=across * pitch, height=layers * pitch),
                  gas=dict(density=DENSITY, viscosity=VISCOSITY, velocity=u), species=dict(diameter=d, density=2500.0),
                  particles=dict(arrangement="lattice", lattice=[across, across, layers], fixed=True),
                  numerics=dict(grid=[4, 4, 8], dem_step=step, gas_step=step, output=step, end=gas_steps * step),
                  models=dict(coupling="implicit" if implicit else "explicit")).make().ascii_fields()
    shake(trial, (pitch - d) / 2)
    trial.run_coupled()
    last = max(trial.times(), default=0)
    fields = [trial.field(k * step, "U") for k in range(1, round(last / step) + 1)]
    return trial, [math.sqrt(statistics.fmean((a - b) ** 2 for v, w in zip(*pair) for a, b in zip(v, w))) / u
                   for pair in itertools.pairwise(fields)]


def shake(trial, by, seed=1):
    """Moves the spheres of a deck within their sites, so that cells differ."""
    rng = random.Random(seed)
    trial.move(lambda x, y, z: (x + rng.uniform(-by, by), y + rng.uniform(-by, by), z + rng.uniform(-by, by)))


def growth(changes, noise=1e-3):
    """Factor by which they change a step, as geometric mean of the later ones above the noise."""
    above = [abs(c) for c in changes]
    last = next((k for k, c in enumerate(above) if c < noise), len(above)) - 1
    first = min(2, last - 1) if last >= 2 else 0
    if last <= first:  # gone within a step or two
        return above[1] / above[0]
    return (above[last] / above[first]) ** (1 / (last - first))


def swing(slip, steps=16):
    """Root mean square of the later half; where the run broke off, 1000."""
    if len(slip) <= steps:
        return 1e3
    return math.sqrt(statistics.fmean(s**2 for s in slip[steps // 2:]))
