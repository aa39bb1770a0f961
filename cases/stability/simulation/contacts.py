# SPDX-License-Identifier: BSD-3-Clause
"""Contacts driven over their edge: the step of the particles and their stiffness."""
import itertools
import math
import statistics

from trial import Trial

D, RHO, KN = 0.85e-3, 2500.0, 1600.0  # of the riser
MASS = RHO * math.pi / 6 * D**3
YOUNG, POISSON = 5e7, 0.25
LIMITS = {"linear": ["DEM step"], "hertz": ["DEM step", "DEM step in the Rayleigh time"]}


def linear_time(stiffness, mass, e):
    return math.sqrt(mass / stiffness) * math.sqrt(math.pi**2 + math.log(e) ** 2)


def contact_time(model, e, speed):
    """Of two spheres that meet at `speed`."""
    if model == "linear":
        return linear_time(KN, MASS / 2, e)
    modulus = YOUNG / (1 - POISSON**2) / 2
    return 2.8683 * ((MASS / 2) ** 2 / (D / 4 * modulus**2 * speed)) ** 0.2


def contact_table(model, e, friction, stiffness=KN):
    common = dict(model=model, restitution=e, friction=friction)
    if model == "linear":
        return dict(common, normal_stiffness=stiffness, tangential_restitution=1.0)
    return dict(common, young=YOUNG, poisson=POISSON)


# With such a wall a sphere has as long a contact as with another sphere.
STIFF_WALL = {"linear": dict(normal_stiffness=2 * KN), "hertz": dict(young=YOUNG / (math.sqrt(2) - 1))}


def impacts(folder, model, per_contact, angle=0.0, e=0.96, speed=1.0, count=64, friction=0.15):
    """Spheres that hit a plate at `speed`, each somewhere else within its step; `per_contact` steps a contact. The
    restitution of each, and the energy of each (of rotation too) over what it should be: None where one was lost."""
    contact = contact_time(model, e, speed)
    step = contact / per_contact
    side, down = round(math.sqrt(count)), speed * math.cos(math.radians(angle))
    end = (0.4 * D + step * down) / down + 3 * contact
    steps = math.ceil(end / step)
    trial = Trial(folder, title="Impacts", gravity=0.0,
                  geometry=dict(width=side * ROOM, depth=side * ROOM, height=4 * ROOM),
                  species=dict(diameter=D, density=RHO),
                  particles=dict(arrangement="lattice", lattice=[side, side, 1], speed=speed, angle=angle),
                  contact=dict(contact_table(model, e, friction), impact_velocity=speed, wall=STIFF_WALL[model]),
                  numerics=dict(dem_step=step, output=steps * step, end=steps * step)).make()
    phases = (n * 0.6180339887498949 % 1 for n in itertools.count())  # evenly, in any number
    trial.move(lambda x, y, z: (x, y, 0.6 * D + step * down * next(phases)))
    trial.run_particles()
    before, after = (trial.dump(s) for s in (trial.steps()[0], trial.steps()[-1]))
    if len(after) < len(before) or not all(math.isfinite(row["vz"]) for row in after.values()):
        return trial, None, None
    return (trial, [after[n]["vz"] / -before[n]["vz"] for n in before],
            [kinetic(after[n]) / kinetic(before[n]) for n in before])


ROOM = 4 * D  # of a sphere that must not meet another


def kinetic(row):
    spin = sum(row[f"omega{a}"] ** 2 for a in "xyz") * 0.4 * row["radius"] ** 2
    return sum(row[f"v{a}"] ** 2 for a in "xyz") + spin


def bed(folder, model, per_contact, time=0.2, count=216, e=0.6, friction=0.3, impact=0.1):
    """Spheres that fall from a shaken lattice and should come to rest; `per_contact` steps a contact of two that
    meet with `impact`. Their speed at the end, as root mean square over that of a fall through one diameter."""
    step = contact_time(model, e, impact) / per_contact
    steps = round(time / step)
    side = 6.5 * D
    trial = Trial(folder, title="Bed at rest", geometry=dict(width=side, depth=side, height=12 * D),
                  species=dict(diameter=D, density=RHO), particles=dict(number=count),
                  contact=dict(contact_table(model, e, friction), impact_velocity=impact),
                  numerics=dict(dem_step=step, output=steps * step, end=steps * step)).make()
    trial.run_particles()
    last = trial.dump(trial.steps()[-1])
    if len(last) < count or trial.steps()[-1] != steps:
        return trial, None
    return trial, math.sqrt(sum(row[f"v{a}"] ** 2 for row in last.values() for a in "xyz") / count / (2 * 9.81 * D))


def riser(folder, per_contact, time=0.5, velocity=12.0, e=0.96):
    """A short riser of some 300 spheres that are put back where they leave; `per_contact` steps a contact of two.
    Its solids' random speed over that of the gas, as root mean square over the second half of `time`:
    None where spheres were lost or the gas blew up."""
    stiffness = 2 * KN
    step = linear_time(stiffness, 8 * MASS / 2, e) / per_contact
    gas_step = max(1, round(1.5e-4 / step)) * step
    pause = max(1, round(5e-3 / gas_step)) * gas_step
    end = round(time / pause) * pause
    trial = Trial(folder, title="Riser", geometry=dict(width=0.03, depth=0.006, height=0.15),
                  gas=dict(density=1.2, viscosity=1.8e-5, velocity=velocity),
                  species=dict(diameter=2 * D, density=RHO), particles=dict(arrangement="uniform", holdup=0.06),
                  contact=dict(normal_stiffness=stiffness, restitution=e, tangential_restitution=0.33, friction=0.15),
                  inlet=dict(particles="inventory"), models=dict(drag="gidaspow"),
                  numerics=dict(grid=[6, 2, 30], dem_step=step, gas_step=gas_step, output=pause, end=end)).make()
    done = trial.run_coupled()
    if done.returncode:
        return trial, None
    dumps = [list(trial.dump(s).values()) for s in trial.steps() if s * step > end / 2]
    spread = [statistics.pvariance(row[f"v{a}"] for row in rows) for rows in dumps for a in "xyz"]
    return trial, math.sqrt(3 * statistics.fmean(spread)) / velocity


def overlap(folder, stiffness, speed, e=0.86):
    """A sphere of the riser that hits a wall: its largest overlap over its radius (of 20 steps a contact), and whether
    it came back. By theory: `largest_overlap`."""
    step = linear_time(stiffness, MASS, e) / 20
    steps = math.ceil(0.2 * D / speed / step) + 30
    trial = Trial(folder, title="Overlap", gravity=0.0, geometry=dict(width=ROOM, depth=ROOM, height=4 * ROOM),
                  species=dict(diameter=D, density=RHO),
                  particles=dict(arrangement="single", position=[ROOM / 2, ROOM / 2, 0.55 * D], speed=speed),
                  contact=dict(contact_table("linear", e, 0.0, stiffness), impact_velocity=speed),
                  numerics=dict(dem_step=step, output=step, end=steps * step)).make()
    trial.run_particles()
    rows = [trial.dump(s) for s in trial.steps()]
    back = len(rows[-1]) == 1 and rows[-1][1]["vz"] > 0
    return trial, max(1 - row[1]["z"] / (D / 2) for row in rows if row), back


def largest_overlap(stiffness, speed, e):
    """Of a damped spring [m]."""
    zeta = -math.log(e) / math.hypot(math.pi, math.log(e))
    root = math.sqrt(1 - zeta**2)
    return speed * math.sqrt(MASS / stiffness) * math.exp(-zeta / root * math.atan2(root, zeta))
