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


def draw(rng, u, together):
    return u * (rng.normal() if together else rng.normal(size=len(u)))


def study_of(folder, name, off, u_share, v_share, together, rng):
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
            seen, held = result + draw(rng, u, together), reference + draw(rng, v, together)
            for z, a, b, du, dv in zip(Z, seen, held, u, v):
                runs.write(f"{k},{z!r},{a!r},{1.96 * du!r}\n")
                curves.write(f"{k},{z!r},{b!r},{dv!r}\n")
            text += f'[[run]]\nlabel = "{k}"\ntables = "{name}"\n'
            for metric in METRICS:
                text += (f'[[check]]\nquantity = "axial holdup"\nrun = "{k}"\nagainst = "{name}?case={k}"\n'
                         f'metric = "{metric}"\nlimit = 1\n')
    with open(f"{folder}/curves/{name}.toml", "w") as sidecar:
        sidecar.write('method = "original"\nabscissa_uncertainty = 0\n')
    with open(f"{folder}/{name}_study.toml", "w") as study:
        study.write(text)
    return {metric: truth_of(metric, result, reference) for metric in METRICS}


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
            for together in (False, True):
                for u, v in ((0.06, 0.02),) if few else ((0.02, 0.02), (0.08, 0.01), (0.01, 0.08)):
                    name = f"{kind}_{'common' if together else 'own'}_{u}_{v}".replace(".", "")
                    truths = study_of(folder, name, off, u, v, together, rng)
                    done = subprocess.run([BEDSCOPE, "validate", f"{folder}/{name}_study.toml", "--json", "-o",
                                           f"{folder}/out"], capture_output=True, text=True)
                    checks = json.loads(done.stdout)["checks"]
                    line = f"{kind:<14}{'common' if together else 'independent':<13}{u:>5}{v:>6}  "
                    for metric in METRICS:
                        own = [c for c in checks if c["metric"] == metric]
                        held = sum(c["lo"] - 1e-12 <= truths[metric] <= c["hi"] + 1e-12 for c in own) / len(own)
                        width = np.mean([c["hi"] - c["lo"] for c in own])
                        line += f"{metric}: {100 * held:.0f} ({width:.2g})  "
                        if held < (0.85 if few else 0.9):  # of 40: 93 % less two standard errors
                            failed.append(f"{name}: {metric}: {held:.3f}")
                    print(line)
    print("\n".join(failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
