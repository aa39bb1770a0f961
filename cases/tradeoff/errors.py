# SPDX-License-Identifier: BSD-3-Clause
"""The error of a choice against the finest one, both known from finite runs only."""
import dataclasses
import math

import numpy
import scipy.stats


@dataclasses.dataclass
class Error:
    """Relative; `value` has the noise taken out and is 0 where nothing is left, `low` and `high` are its 95 % interval."""
    value: float
    low: float
    high: float
    noise: float

    def __mul__(self, factor):
        return Error(*(factor * v for v in (self.value, self.low, self.high, self.noise)))

    @property
    def known(self):
        """Not that the choice has nothing to compare."""
        return not math.isnan(self.high)

    @property
    def shown(self):
        """What a chart shows: the largest that it may be where it is not told from noise."""
        return self.high if self.known and not self.told else self.value

    @property
    def told(self):
        return self.low > 0

    def __str__(self):
        if not self.known:
            return "has none"
        if not self.told:
            return f"less than {percent(self.high)}"
        return f"{percent(self.value)} ({percent(self.low)} to {percent(self.high)})"


ABSENT = Error(1.0, math.nan, math.nan, math.nan)


def percent(x):
    return f"{100 * x:.2g} %" if x < 0.995 else f"{100 * x:.0f} %"


def error(choice, finest, scale=None):
    """Of two arrays (points, blocks). With d the difference of their means over the blocks and S its covariance, as the
    blocks scatter, q = |d|^2 - tr S is the square of the true difference without bias. Its interval is in two parts, taken
    as independent: along d, where the noise is s^2 = d'Sd/|d|^2, and across it, where noise beyond what was taken out
    scatters by 2 (tr S^2 - s^4) (1 + 1/n); both times Student's t of n degrees of freedom (Welch and Satterthwaite). Of one
    point it is that of the difference itself. Blocks are taken as independent. Relative to `scale`, or to the mean size of
    the finest.
    """
    if choice is None:
        return ABSENT
    d = choice.mean(axis=1) - finest.mean(axis=1)
    parts = [scatter(choice), scatter(finest)]
    each = [float((x * x).sum()) for x in parts]
    noise = sum(each)
    scale = math.sqrt(len(d)) * (scale or size(finest))
    if noise == 0:
        off = math.sqrt(float(d @ d)) / scale
        return Error(off, off, off, 0.0)
    n = noise**2 / sum(one**2 / (x.shape[1] - 1) for one, x in zip(each, parts))
    x = numpy.concatenate(parts, axis=1)
    along = float(((d @ x) ** 2).sum() / (d @ d)) if d.any() else noise
    square = sum(square_trace(p) for p in parts) + 2 * float(((parts[0].T @ parts[1]) ** 2).sum())
    t = float(scipy.stats.t.ppf(0.975, n))
    across = t * math.sqrt(2 * (1 + 1 / n) * max(0.0, square - along**2))
    q = float(d @ d) - noise
    most, reach = max(0.0, q + along), t * math.sqrt(along)
    low = most - math.hypot(most - (math.sqrt(most) - reach) * abs(math.sqrt(most) - reach), across)
    high = most + math.hypot((math.sqrt(most) + reach) ** 2 - most, across)
    return Error(*(math.sqrt(max(0.0, y)) / scale for y in (q, min(q, low), high, noise)))


def size(blocks):
    return float(numpy.abs(blocks.mean(axis=1)).mean())


def interval(blocks, scale=None):
    """Relative 95 % interval of a run itself, as a root mean square over the points."""
    t = float(scipy.stats.t.ppf(0.975, blocks.shape[1] - 1))
    return t * math.sqrt(float((scatter(blocks) ** 2).sum()) / len(blocks)) / (scale or size(blocks))


def drift(blocks):
    """Of one point: by how much it changes from the first block to the last, by a line through them, relative to its mean,
    and the half-width of that at 95 % (Student's t)."""
    y, n = blocks[0], blocks.shape[1]
    x = numpy.arange(n) - (n - 1) / 2
    slope = float(x @ y / (x @ x))
    rest = y - y.mean() - slope * x
    half = float(scipy.stats.t.ppf(0.975, n - 2)) * math.sqrt(float(rest @ rest) / (n - 2) / float(x @ x))
    return (n - 1) * slope / size(blocks), (n - 1) * half / size(blocks)


def scatter(blocks):
    """X with X X' the covariance of the mean over the blocks."""
    count = blocks.shape[1]
    return (blocks - blocks.mean(axis=1, keepdims=True)) / math.sqrt(count * (count - 1))


def square_trace(x):
    """tr S^2 of the true covariance, without the bias that it has from X X' of few blocks (normal noise)."""
    n = x.shape[1] - 1
    found = float(((x.T @ x) ** 2).sum()) - float((x * x).sum()) ** 2 / n
    return max(0.0, found * n**2 / ((n - 1) * (n + 2)))


def front(points):
    """Of (cost, error, name): the names that nothing is both cheaper and nearer than, from the cheapest on."""
    best, names = math.inf, []
    for cost, off, name in sorted(points):
        if off < best:
            best = off
            names.append(name)
    return names
