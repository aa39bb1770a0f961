# SPDX-License-Identifier: BSD-3-Clause
"""Heat between gas and particles that are held: with large steps, and on coarse grids."""
import math

from scipy import integrate, special

from trial import Trial

D, RHO = 1e-3, 2500.0
GAS = dict(density=1.2, viscosity=1.8e-5, heat_capacity=1000.0, conductivity=0.025)
SLIPPING = dict(sides="free-slip", front_back="free-slip")
COLD, HOT = 300.0, 400.0


def gunn(eps, re, pr):
    return ((7 - 10 * eps + 5 * eps**2) * (1 + 0.7 * re**0.2 * pr ** (1 / 3))
            + (1.33 - 2.4 * eps + 1.2 * eps**2) * re**0.7 * pr ** (1 / 3))


def anzelius(xi, tau):
    """Gas and particle temperature of a bed without source, 0 at the start, 1 at the inlet (physics/fixed_bed.hpp)."""
    def integral(end, other):
        def part(s):  # e^-(s+other) I0(2 sqrt(other s)), scaled
            return special.i0e(2 * math.sqrt(other * s)) * math.exp(-((math.sqrt(s) - math.sqrt(other)) ** 2))
        return integrate.quad(part, 0, end, limit=200)[0]
    return 1 - integral(xi, tau), integral(tau, xi)


class Column:
    """Spheres one above the other, `each` in a cell, in a column of gas of velocity u."""

    def __init__(self, u=1.0, pitch=1.3, capacity=800.0):
        self.u, self.pitch, self.capacity = u, pitch * D, capacity
        self.eps = 1 - math.pi / 6 / pitch**3
        re, pr = GAS["density"] * u * D / GAS["viscosity"], GAS["viscosity"] * GAS["heat_capacity"] / GAS["conductivity"]
        self.h = gunn(self.eps, re, pr) * GAS["conductivity"] / D
        self.exchange = self.h * 6 * (1 - self.eps) / D  # h a_s
        self.length = GAS["density"] * GAS["heat_capacity"] * u / self.exchange  # of xi = 1
        self.solids_time = (1 - self.eps) * RHO * capacity / self.exchange  # of tau = 1
        self.gas_time = self.eps * GAS["density"] * GAS["heat_capacity"] / self.exchange

    def run(self, folder, count, each, step, steps, outputs=1):
        trial = Trial(folder, title="A heated column", gravity=0.0, walls=SLIPPING,
                      geometry=dict(width=self.pitch, depth=self.pitch, height=count * self.pitch),
                      gas=dict(GAS, velocity=self.u, temperature=HOT),
                      species=dict(diameter=D, density=RHO, heat_capacity=self.capacity),
                      particles=dict(arrangement="lattice", lattice=[1, 1, count], fixed=True, temperature=COLD),
                      models=dict(energy=True),
                      numerics=dict(grid=[1, 1, count // each], dem_step=step, gas_step=step,
                                    output=steps // outputs * step, end=steps * step))
        trial.make().ascii_fields().run_coupled()
        return trial

    def edge(self, each, step):
        """Largest stable step over the particles' thermal time: 2 (1 + a / (2 + C)), a = step / the gas' thermal time, C
        = u step / (eps dz)."""
        return 2 * (1 + step / self.gas_time / (2 + self.u * step / (self.eps * each * self.pitch)))

    def part_of_edge(self, part, each):
        """Step over the particles' thermal time that is `part` of the largest stable one."""
        ratio = part
        for _ in range(200):  # the edge grows with the step, ever less
            ratio = part * self.edge(each, ratio * self.solids_time)
        return ratio


def grid(folder, each, xi=8.0, tau=8.0, capacity=80.0, steps=1200):
    """A column of `each` spheres to a cell, when its front is half through: largest error of gas and of particles (mean
    of a cell) against the closed form, over the step; and the height of a cell in exchange lengths."""
    column = Column(capacity=capacity)
    count = math.ceil(1.8 * xi * column.length / column.pitch / 16) * 16
    step = tau * column.solids_time / steps
    trial = column.run(folder, count, each, step, steps)
    gas = [(t - COLD) / (HOT - COLD) for t in trial.field(steps * step, "T")]
    rows = trial.dump(steps)
    solid = [sum(rows[n * each + k + 1]["f_Temp[0]"] - COLD for k in range(each)) / each / (HOT - COLD)
             for n in range(len(gas))]
    off = 0.0
    for n, (g, s) in enumerate(zip(gas, solid)):
        z = (n + 0.5) * each * column.pitch
        exact_gas, exact_solid = anzelius(z / column.length, (steps * step - column.eps * z / column.u) / column.solids_time)
        error = max(abs(g - exact_gas), abs(s - exact_solid))
        off = max(off, error if math.isfinite(error) else math.inf)
    return trial, off, each * column.pitch / column.length


def large_step(folder, ratio, each, count=32, steps=40, capacity=8.0):
    """Steps of `ratio` of the particles' thermal time: the largest departure of a particle's temperature from the two
    that gas and particles had, over their difference (0 where it stays between them)."""
    column = Column(capacity=capacity)
    step = ratio * column.solids_time
    trial = column.run(folder, count, each, step, steps, outputs=steps)
    worst = 0.0
    for s in trial.steps():
        for row in trial.dump(s).values():
            off = max(row["f_Temp[0]"] - HOT, COLD - row["f_Temp[0]"]) / (HOT - COLD)
            worst = max(worst, off if math.isfinite(off) else math.inf)
    return trial, worst, column.edge(each, step)
