# SPDX-License-Identifier: BSD-3-Clause
"""Puts what the digitiser found against what was drawn: errors as fractions of the axes' spans."""
import csv
import math

import numpy as np
from scipy.optimize import linear_sum_assignment


class Axis:
    def __init__(self, low, high, log):
        self.low, self.high, self.log = low, high, log

    def fraction(self, v):
        v = np.asarray(v, float)
        with np.errstate(invalid="ignore", divide="ignore"):
            if self.log:
                return np.log(v / self.low) / math.log(self.high / self.low)
            return (v - self.low) / (self.high - self.low)

    def fraction_of_u(self, v, u):
        if self.log:
            return np.asarray(u) / np.asarray(v) / math.log(self.high / self.low)
        return np.asarray(u) / (self.high - self.low)


def read(path):
    """Series name -> columns x, x_u, y, y_u, lo, hi."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    found = {}
    for row in rows[1:]:
        numbers = [float(v) for v in row[1:]] + [math.nan] * (7 - len(row))
        found.setdefault(row[0], []).append(numbers)
    return {name: np.array(values) for name, values in found.items()}


def to_polyline(points, curve):
    """Distance of each point from a polyline and the unit vector to its nearest place."""
    a, b = curve[:-1], curve[1:]
    d = b - a
    length2 = np.maximum((d**2).sum(1), 1e-30)
    distances, vectors = [], []
    for p in points:
        t = np.clip(((p - a) * d).sum(1) / length2, 0, 1)
        away = p - (a + t[:, None] * d)
        r = np.hypot(away[:, 0], away[:, 1])
        i = int(np.argmin(r))
        distances.append(r[i])
        vectors.append(np.array([-d[i, 1], d[i, 0]]) / math.sqrt(length2[i]))
    return np.array(distances), np.array(vectors)


def hidden(series, q):
    """Whether a legend or an inset lies over a place."""
    return any(b[0] < q[0] < b[2] and b[1] < q[1] < b[3] for b in series.get("hidden", []))


def compare(truth, csv_path):
    """A list of dictionaries, one a series: kind, errors, u (both fractions), missed, invented."""
    found = read(csv_path)
    axes = [Axis(*truth["x"]), Axis(*truth["y"])]
    results = []
    for series in truth["series"]:
        rows = found.get(series["name"], np.empty((0, 6)))
        at = np.column_stack([axes[0].fraction(rows[:, 0]), axes[1].fraction(rows[:, 2])])
        u = np.column_stack([axes[0].fraction_of_u(rows[:, 0], rows[:, 1]),
                             axes[1].fraction_of_u(rows[:, 2], rows[:, 3])])
        result = {"name": truth["name"], "series": series["name"], "kind": series["kind"], "drawn": series["drawn"],
                  "shape": series["shape"]}
        if series["kind"] == "markers":
            real = np.array(series["points"])
            far = np.abs(real[:, None, :] - at[None, :, :]).max(2)
            i, j = linear_sum_assignment(np.minimum(far, 1))
            near = far[i, j] < 0.5 * max(series["size"])
            i, j = i[near], j[near]
            missed = [k for k in range(len(real)) if k not in i and not hidden(series, real[k])]
            result.update(missed=len(missed), invented=len(at) - len(j), wanted=len(real),
                          errors=at[j] - real[i], u=u[j])
            if "errors" in series and len(i):
                e = np.array(series["errors"])[i].reshape(len(i), -1)  # one for both sides, or below and above
                lo, hi = axes[1].fraction(rows[j, 4]), axes[1].fraction(rows[j, 5])
                ends = np.column_stack([lo - (real[i, 1] - e[:, 0]), hi - (real[i, 1] + e[:, -1])])
                result["bars"] = ends[np.broadcast_to(e, ends.shape) > 0.5 * series["size"][1] + 0.005]  # not within the marker
        else:
            curve = np.array(series["curve"])
            distance, normal = to_polyline(at, curve) if len(at) else (np.empty(0), np.empty((0, 2)))
            across = np.hypot(normal[:, 0] * u[:, 0], normal[:, 1] * u[:, 1])
            seen = [q for q in curve[::max(1, len(curve) // 100)] if not hidden(series, q)]
            covered = [np.abs(at - q).max(1).min() < 0.03 for q in seen] if seen and len(at) else [False]
            result.update(errors=distance, u=across, followed=float(np.mean(covered)))
        results.append(result)
    return results


def give_or_take(results, inside):
    """Standard error of the share of points that 2u covers: those of a plot share its calibration, so that
    whole plots are the sample (ratio estimator; Cochran, Sampling Techniques, 1977, ch. 6)."""
    plots = {}
    for r, within in zip(results, inside):
        n = plots.setdefault(r["name"], [0, 0])
        n[0] += within.size
        n[1] += int(within.sum())
    points, covered = np.array(list(plots.values()), float).T
    if len(plots) < 2 or not points.sum():
        return math.nan
    off = covered - covered.sum() / points.sum() * points
    return float(np.sqrt((off**2).sum() * len(plots) / (len(plots) - 1)) / points.sum())


def summary(results):
    """The figures of docs/digitiser.md over a list of results."""
    lines = {}
    markers = [r for r in results if r["kind"] == "markers"]
    curves = [r for r in results if r["kind"] == "line"]
    if markers:
        e = np.abs(np.concatenate([r["errors"].ravel() for r in markers]))
        u = np.concatenate([r["u"].ravel() for r in markers])
        lines["markers"] = dict(series=len(markers), points=len(e) // 2, p95=float(np.percentile(e, 95)) if len(e) else math.nan,
                                covered=float((e <= 2 * u).mean()),
                                give_or_take=give_or_take(markers, [np.abs(r["errors"]) <= 2 * r["u"] for r in markers]),
                                median_2u=float(np.median(2 * u)),
                                missed=sum(r["missed"] for r in markers), invented=sum(r["invented"] for r in markers))
        bars = [r["bars"].ravel() for r in markers if "bars" in r]
        if bars:
            b = np.concatenate(bars)
            seen = np.abs(b[~np.isnan(b)])
            lines["bars"] = dict(ends=len(b), unseen=int(np.isnan(b).sum()),
                                 p95=float(np.percentile(seen, 95)) if len(seen) else math.nan)
    if curves:
        e = np.concatenate([r["errors"] for r in curves])
        u = np.concatenate([r["u"] for r in curves])
        lines["lines"] = dict(series=len(curves), points=len(e), p95=float(np.percentile(e, 95)),
                              worst=float(e.max()), beyond=float((e > 0.005).mean()),
                              covered=float((e <= 2 * u).mean()),
                              give_or_take=give_or_take(curves, [r["errors"] <= 2 * r["u"] for r in curves]),
                              median_2u=float(np.median(2 * u)),
                              followed=float(np.mean([r["followed"] for r in curves])))
    return lines


def demands(figures, errors, plots, few):
    """What the promise is and is not kept, as texts. `few` plots are all digitised and none is wrong, and
    tell how often 2u covers to its standard error between plots only; over many, of all styles, one in
    fifty markers may be."""
    unmet = []

    def need(holds, text):
        if not holds:
            unmet.append(text)

    m, line = figures["markers"], figures["lines"]
    need(errors <= (0 if few else plots // 30), f"{errors} of {plots} plots not digitised")
    need(m["p95"] <= 0.003, f"markers' 95th percentile {m['p95']:.4f}, at most 0.003")
    wrong = (m["missed"] + m["invented"]) / max(1, m["points"])
    need(wrong <= (0 if few else 0.02), f"{m['missed']} markers missed, {m['invented']} invented of {m['points']}")
    need(line["p95"] <= 0.005, f"lines' 95th percentile {line['p95']:.4f}, at most 0.005")
    for name, kind in (("markers", m), ("lines", line)):
        known_to = kind["give_or_take"] if few else 0
        need(0.90 - known_to <= kind["covered"] <= 0.99 + known_to, f"2u covers {kind['covered']:.3f} of the {name}, 0.90 to 0.99")
        need(kind["median_2u"] <= 0.006, f"median 2u of the {name} {kind['median_2u']:.4f}, at most 0.006")
    return unmet
