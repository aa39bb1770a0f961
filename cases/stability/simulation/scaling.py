# SPDX-License-Identifier: BSD-3-Clause
"""What larger particles lose: room in the depth, and numbers in a cluster."""
import math
import random
import statistics

from trial import Trial

D, RHO = 0.85e-3, 2500.0
SPHERE = math.pi / 6 * D**3


def depth(folder, ratio, width=12.0, layers=10.0):
    """A bed that settles in a box `ratio` diameters deep: its voidage between a fifth and three fifths of its height."""
    count = round(0.58 * ratio * width * layers / (math.pi / 6))
    trial = Trial(folder, title="A bed in a thin box", geometry=dict(width=width * D, depth=ratio * D, height=60 * D),
                  species=dict(diameter=D, density=RHO), particles=dict(number=count),
                  contact=dict(normal_stiffness=200.0, restitution=0.6, friction=0.3, impact_velocity=0.1),
                  numerics=dict(dem_step=1.2e-5, output=0.12, end=0.12)).make()
    trial.run_particles()
    heights = sorted(row["z"] for row in trial.dump(trial.steps()[-1]).values())
    low, high = (heights[int(part * len(heights))] for part in (0.2, 0.6))
    solids = sum(slice_of_sphere(z, low, high) for z in heights)
    return trial, 1 - solids / ((high - low) * width * D * ratio * D)


def slice_of_sphere(z, low, high):
    """Volume of a sphere at z between two heights."""
    cap = lambda to: math.pi * ((D / 2) ** 2 * to - to**3 / 3)
    a, b = (max(-D / 2, min(D / 2, at - z)) for at in (low, high))
    return cap(b) - cap(a)


def scatter(folder, holdup=0.2, side=22.0, snapshots=6):
    """Elastic spheres in a box, at rest as a whole: relative standard deviation of the number in cubes, and that number,
    for cubes of several edges. By theory sqrt(S/N), S = (1 - phi)^4 / (1 + 4 phi + 4 phi^2 - 4 phi^3 + phi^4)."""
    count = round(holdup * side**3 * D**3 / SPHERE)
    step, pause = 2.5e-6, 1600
    trial = Trial(folder, title="A gas of spheres", gravity=0.0,
                  geometry=dict(width=side * D, depth=side * D, height=side * D),
                  species=dict(diameter=D, density=RHO),
                  particles=dict(number=count, arrangement="uniform", velocity=[1.0, 0.0, 0.0]),
                  contact=dict(normal_stiffness=1600.0), numerics=dict(dem_step=step, output=pause * step,
                                                                      end=(snapshots + 1) * pause * step)).make()
    rng = random.Random(1)
    trial.throw(lambda: [rng.gauss(0, 0.6) for _ in range(3)])
    trial.run_particles()
    found = []
    for edge in (2.5, 3.3, 4, 5, 6.6, 10):
        numbers = []
        for s in trial.steps()[2:]:
            at = [[(row[a] / D - 2) / edge for a in "xyz"] for row in trial.dump(s).values()]
            cubes = int((side - 4) / edge + 1e-9)
            inside = {}
            for place in at:
                key = tuple(math.floor(x) for x in place)
                inside[key] = inside.get(key, 0) + 1
            numbers += [inside.get((i, j, k), 0) for i in range(cubes) for j in range(cubes) for k in range(cubes)]
        mean = statistics.fmean(numbers)
        found.append((mean, statistics.pstdev(numbers) / mean))
    return trial, found


def structure(holdup):
    """S of hard spheres at rest among each other (Carnahan and Starling 1969)."""
    return (1 - holdup) ** 4 / (1 + 4 * holdup + 4 * holdup**2 - 4 * holdup**3 + holdup**4)
