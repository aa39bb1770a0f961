#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How often the 95 % interval of a metric holds its true value, on constructed cases with known errors.

    coverage_test.py BEDSCOPE [CASES]      fewer than 100 (40): two kinds of curves only

Result and reference are drawn about true curves; the metric of the true curves is the truth. Prints a
table; fails where far fewer than 95 % of the intervals hold it. Intervals are meant to be wide rather than
narrow: nobody knows whether errors of neighbouring points are independent or common, so they are made
for both.
"""
import json
import math
import os
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)

BEDSCOPE = sys.argv[1]
CASES = int(sys.argv[2]) if len(sys.argv) > 2 else 40
POINTS = 24
Z = np.linspace(0.05, 1.5, POINTS)
METRICS = ("relative rmse", "relative bias", "relative max error", "max error", "rank correlation", "model bias",
           "model scatter")
SHAPES = ("u-shaped", "decreasing")
MEMORY = 0.2  # of neighbours, over the curve's length
BINS = (np.arange(25) + 0.5) / 25


def spearman(a, b):
    ra, rb = np.argsort(np.argsort(a)), np.argsort(np.argsort(b))
    return np.corrcoef(ra, rb)[0, 1]


def truth_of(metric, result, reference):
    e, m = result - reference, reference.mean()
    ratio = np.log(result / reference)
    return {"relative rmse": math.sqrt((e ** 2).mean()) / m, "relative bias": abs(e.mean()) / m,
            "relative max error": abs(e).max() / m, "max error": abs(e).max(),
            "rank correlation": spearman(result, reference), "model scatter": ratio.std(ddof=1),
            "model bias": abs(math.exp(ratio.mean() + ratio.var(ddof=1) / 2) - 1)}[metric]


def shape_of(name, y):
    share = (Z - Z[0]) / (Z[-1] - Z[0])
    if name == "u-shaped":
        walls = min(y[share <= 0.2].mean(), y[share >= 0.8].mean())
        return (walls - y[(share >= 0.3) & (share <= 0.7)].mean()) / abs(y).mean()
    falling = []  # pool adjacent violators: [level, count]
    for value in y:
        falling.append([value, 1])
        while len(falling) > 1 and falling[-2][0] < falling[-1][0]:
            level, count = falling.pop()
            below = falling[-1]
            falling[-1] = [(below[0] * below[1] + level * count) / (below[1] + count), below[1] + count]
    nearest = np.concatenate([[level] * count for level, count in falling])
    return math.sqrt(((y - nearest) ** 2).mean()) / abs(y).mean()


def draw(rng, u, errors):
    if errors == "common":
        return u * rng.normal()
    if errors == "independent":
        return u * rng.normal(size=len(u))
    share = (Z - Z[0]) / (Z[-1] - Z[0])
    together = np.exp(-abs(share[:, None] - share) / MEMORY)
    return u * (np.linalg.cholesky(together) @ rng.normal(size=len(u)))


def study_of(folder, name, off, u_share, v_share, errors, rng):
    """CASES runs of one kind and their checks; truths by metric."""
    reference = 0.02 + 0.08 * np.exp(-Z / 0.5)
    result = off(reference)
    u, v = u_share * reference.mean() * np.ones(POINTS), v_share * reference.mean() * np.ones(POINTS)
    os.makedirs(f"{folder}/{name}")
    os.makedirs(f"{folder}/curves", exist_ok=True)
    with open(f"{folder}/{name}/axial_profile.csv", "w") as runs, open(f"{folder}/curves/{name}.csv", "w") as curves:
        runs.write("run,z [m],holdup [-],holdup_ci95 [-]\n")
        curves.write("case [-],z [m],holdup [-],holdup_u [-]\n")
        text = 'curves = ["curves"]\n'
        for k in range(CASES):
            seen, held = result + draw(rng, u, errors), reference + draw(rng, v, errors)
            for z, a, b, du, dv in zip(Z, seen, held, u, v):
                runs.write(f"{k},{z!r},{a!r},{1.96 * du!r}\n")
                curves.write(f"{k},{z!r},{b!r},{dv!r}\n")
            text += f'[[run]]\nlabel = "{k}"\ntables = "{name}"\n'
            for metric in METRICS:
                text += (f'[[check]]\nquantity = "axial holdup"\nrun = "{k}"\nagainst = "{name}?case={k}"\n'
                         f'metric = "{metric}"\nlimit = 1\n')
            for shape in SHAPES:
                text += f'[[check]]\nquantity = "axial holdup"\nrun = "{k}"\nshape = "{shape}"\n'
    with open(f"{folder}/curves/{name}.toml", "w") as sidecar:
        sidecar.write('method = "original"\nabscissa_uncertainty = 0\n')
    with open(f"{folder}/{name}_study.toml", "w") as study:
        study.write(text)
    truths = {metric: truth_of(metric, result, reference) for metric in METRICS}
    return truths | {shape: shape_of(shape, result) for shape in SHAPES}


def peak(centre):
    """Density of a normal distribution of deviation 0.1, in bins."""
    faces = np.array([0.5 + 0.5 * math.erf((x - centre) / 0.1 / math.sqrt(2)) for x in np.linspace(0, 1, 26)])
    return np.diff(faces) * 25


def study_of_area(folder, name, shift, moves, rng):
    """Distributions that stand `shift` beside the reference's, which move as a whole or whose bins err one by one."""
    folder += "/" + name
    os.makedirs(folder + "/runs")
    # The mean of a distribution that moves is broader: so is the reference, and the shift is the area.
    true, reference = (np.mean([peak(centre + s) for s in 0.03 * rng.normal(size=4000)] if moves else
                               [peak(centre)], axis=0) for centre in (0.45 + shift, 0.45))
    text = ""
    with open(folder + "/runs/temperature_pdf.csv", "w") as runs:
        runs.write("run,bin_centre [-],probability_density [-],probability_density_ci95 [-]\n")
        for k in range(CASES):
            if moves:
                batches = np.array([peak(0.45 + shift + 0.03 * rng.normal()) for _ in range(10)])
            else:
                batches = true + 0.1 * np.sqrt(true * true.max()) * rng.normal(size=(10, 25))
            half = 2.262 * batches.std(axis=0, ddof=1) / math.sqrt(10)  # Student's t, 9 degrees of freedom
            for x, mean, ci95 in zip(BINS, batches.mean(axis=0), half):
                runs.write(f"{k},{x!r},{mean!r},{ci95!r}\n")
            text += f'[[run]]\nlabel = "{k}"\ntables = "runs"\n'
    with open(folder + "/reference.csv", "w") as file:
        file.write("T [-],T_u [-],density [-],density_u [-]\n")
        file.writelines(f"{x!r},0,{y!r},0\n" for x, y in zip(BINS, reference))
    text += '[[check]]\nquantity = "temperature pdf"\nagainst = "reference.csv"\nmetric = "area"\nlimit = 1\n'
    with open(folder + "/study.toml", "w") as study:
        study.write(text)
    return np.abs(np.cumsum(true - reference)).sum() / 25 ** 2


def area(folder, rng, few, failed):
    for moves in (False, True):
        for shift in ((0.02,) if few else (0, 0.02, 0.05)):
            name = f"area_{moves}_{shift}"
            truth = study_of_area(folder, name, shift, moves, rng)
            done = subprocess.run([BEDSCOPE, "validate", f"{folder}/{name}/study.toml", "--json", "-o",
                                   f"{folder}/out"], capture_output=True, text=True)
            own = json.loads(done.stdout)["checks"]
            held = sum(c["lo"] - 1e-12 <= truth <= c["hi"] + 1e-12 for c in own) / len(own)
            width = np.mean([c["hi"] - c["lo"] for c in own])
            print(f"{'moving' if moves else 'bins err':<14}shift {shift:<6} area: {100 * held:.0f} ({width:.2g})")
            if held < (0.85 if few else 0.9):
                failed.append(f"{name}: {held:.3f}")


def main():
    rng = np.random.default_rng(11)
    kinds = {
        "proportional": lambda r: 1.2 * r,
        "shifted": lambda r: r + 0.1 * r.mean(),
        "shape": lambda r: r * (1 + 0.15 * np.sin(7 * Z)),
        "equal": lambda r: r.copy(),
    }
    failed = []
    print(f"{'curves':<14}{'errors':<13}{'u':>5}{'u_ref':>6}  share of intervals with the truth, of", CASES)
    with tempfile.TemporaryDirectory() as folder:
        few = CASES < 100
        for kind in ("shifted", "shape") if few else kinds:
            off = kinds[kind]
            for errors in ("independent", "neighbours", "common"):
                for u, v in ((0.06, 0.02),) if few else ((0.02, 0.02), (0.08, 0.01), (0.01, 0.08)):
                    name = f"{kind}_{errors}_{u}_{v}".replace(".", "")
                    truths = study_of(folder, name, off, u, v, errors, rng)
                    done = subprocess.run([BEDSCOPE, "validate", f"{folder}/{name}_study.toml", "--json", "-o",
                                           f"{folder}/out"], capture_output=True, text=True)
                    checks = json.loads(done.stdout)["checks"]
                    line = f"{kind:<14}{errors:<13}{u:>5}{v:>6}  "
                    for metric in METRICS + SHAPES:
                        own = [c for c in checks if c["metric"] == metric]
                        held = sum(c["lo"] - 1e-12 <= truths[metric] <= c["hi"] + 1e-12 for c in own) / len(own)
                        width = np.mean([c["hi"] - c["lo"] for c in own])
                        line += f"{metric}: {100 * held:.0f} ({width:.2g})  "
                        if held < (0.85 if few else 0.9):  # of 40: 93 % less two standard errors
                            failed.append(f"{name}: {metric}: {held:.3f}")
                    print(line)
        area(folder, rng, few, failed)
    print("\n".join(failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
