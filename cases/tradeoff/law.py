# SPDX-License-Identifier: BSD-3-Clause
"""The law of cost: CPU time of a gas step, by what a step has to do."""
import math

import numpy
import scipy.stats

# Of a run: particles N, DEM steps in a gas step n, gas cells C. Of terms that the runs cannot tell apart the later one stays.
TERMS = {"DEM step": lambda N, n, C: n, "gas step": lambda N, n, C: 1.0, "particle": lambda N, n, C: N,
         "particle and DEM step": lambda N, n, C: N * n, "cell": lambda N, n, C: C}


class Law:
    """Least squares of relative deviations. A term is kept where it is positive and the runs support it: twice its own
    uncertainty at least; the least supported one goes first."""

    def __init__(self, runs):
        self.terms = list(TERMS)[-max(1, len(runs) - 1):]  # a run more than terms, or nothing is known of the scatter
        y = numpy.array([r.ms_per_step for r in runs])
        while True:
            a = numpy.array([self.row(r.particles, r.dem_steps, r.cells) for r in runs]) / y[:, None]
            if self.drop_dependent(a):
                continue
            self.values, *_ = numpy.linalg.lstsq(a, numpy.ones(len(y)), rcond=None)
            self.free = len(y) - len(self.terms)
            off = a @ self.values - 1
            self.scatter = math.sqrt(float(off @ off) / self.free) if self.free else math.nan
            self.covariance = self.scatter**2 * numpy.linalg.pinv(a.T @ a)
            self.uncertainty = numpy.sqrt(numpy.diag(self.covariance))
            strength = self.values / self.uncertainty
            worst = int(numpy.argmin(strength))
            if len(self.terms) == 1 or not strength[worst] < 2:
                return
            del self.terms[worst]

    def drop_dependent(self, a):
        a = a / numpy.linalg.norm(a, axis=0)
        for n in range(a.shape[1] if numpy.linalg.matrix_rank(a, 1e-8) < a.shape[1] else 0):
            if numpy.linalg.matrix_rank(numpy.delete(a, n, axis=1), 1e-8) == numpy.linalg.matrix_rank(a, 1e-8):
                del self.terms[n]
                return True
        return False

    def row(self, particles, dem_steps, cells):
        return [TERMS[t](particles, dem_steps, cells) for t in self.terms]

    def predict(self, particles, dem_steps, cells):
        """CPU time of a gas step [ms] and the half-width of the 95 % interval of a new run's."""
        x = numpy.array(self.row(particles, dem_steps, cells))
        value = float(x @ self.values)
        sd = math.sqrt(float(x @ self.covariance @ x) + (self.scatter * value) ** 2)
        return value, float(scipy.stats.t.ppf(0.975, self.free)) * sd if self.free else math.nan

    def __str__(self):
        t = float(scipy.stats.t.ppf(0.975, self.free)) if self.free else math.nan
        return " + ".join(f"({1e3 * v:.3g} ± {1e3 * t * u:.2g}) µs" + f" a {name}"
                          for name, v, u in zip(self.terms, self.values, self.uncertainty))
