# SPDX-License-Identifier: BSD-3-Clause
"""Closed forms, written down here independently of physics/."""
import math


def beetstra(eps, re):
    """F of Beetstra, van der Hoef and Kuipers (2007), eq. 16, with Re superficial."""
    phi = 1 - eps
    f = 10 * phi / eps**2 + eps**2 * (1 + 1.5 * math.sqrt(phi))
    if re > 0:
        f += 0.413 * re / (24 * eps**2) * (1 / eps + 3 * eps * phi + 8.4 * re**-0.343) / (
            1 + 10 ** (3 * phi) * re ** (-(1 + 4 * phi) / 2))
    return f


def pressure_gradient(eps, velocity, d, gas_density, viscosity, law=beetstra):
    """-dp/dz of a bed at rest, superficial velocity [Pa/m]."""
    re = gas_density * velocity * d / viscosity
    return 18 * viscosity * (1 - eps) * law(eps, re) * velocity / (eps * d * d)


def gunn(eps, re, pr):
    return ((7 - 10 * eps + 5 * eps**2) * (1 + 0.7 * re**0.2 * pr ** (1 / 3))
            + (1.33 - 2.4 * eps + 1.2 * eps**2) * re**0.7 * pr ** (1 / 3))


def wen_yu(eps, re):
    return (1 + 0.15 * re**0.687 if re < 1000 else 0.44 * re / 24) * eps**-3.65


def di_felice(eps, re):
    chi = 3.7 - 0.65 * math.exp(-((1.5 - math.log10(re)) ** 2) / 2)
    return (0.63 + 4.8 / math.sqrt(re)) ** 2 * re / 24 * eps**-chi


def gidaspow(eps, re):
    return wen_yu(eps, re) if eps > 0.8 else (150 * (1 - eps) + 1.75 * re) / (18 * eps**2)


LAWS = {"beetstra": beetstra, "wen_yu": wen_yu, "gidaspow": gidaspow, "di_felice": di_felice}


def terminal_velocity(law, eps, d, density, gas_density, viscosity, g=9.81):
    """Slip (interstitial) at which drag is weight less buoyancy, by bisection [m/s]."""
    weight = (density - gas_density) * g * math.pi / 6 * d**3
    low, high = 1e-6, 100.0
    for _ in range(100):
        u = (low + high) / 2
        drag = 3 * math.pi * viscosity * d * eps * law(eps, eps * gas_density * u * d / viscosity) * u
        low, high = (u, high) if drag < weight else (low, u)
    return u


def rebound(kn, mass, e, speed, gap, step):
    """Ratio of the speeds after and before a collision of a linear spring and dashpot as LIGGGHTS
    integrates it: velocity Verlet, whose force is taken at the new place with the velocity of half a
    step before. `gap`: before the first step [m]; `mass`: effective [kg]; `step` [s]."""
    eta = -2 * math.log(e) * math.sqrt(kn * mass) / math.sqrt(math.pi**2 + math.log(e) ** 2)
    place, velocity, force = gap, -speed, 0.0
    while velocity <= 0 or place < 0 or force:
        velocity += force / mass * step / 2
        place += velocity * step
        force = -kn * place - eta * velocity if place < 0 else 0.0
        velocity += force / mass * step / 2
    return velocity / speed
