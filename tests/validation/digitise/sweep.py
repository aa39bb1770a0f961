# SPDX-License-Identifier: BSD-3-Clause
"""Digitises plots of known data and prints how far off it was: sweep.py PROGRAM FAMILY FIRST-LAST FOLDER"""
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

import measure
import plots


def digitise(program, truth):
    """What compare() gives and what the program doubts, or the one line of the error."""
    csv = Path(truth["toml"]).with_suffix(".csv")
    csv.unlink(missing_ok=True)
    begun = time.time()
    run = subprocess.run([program, "digitise", truth["toml"], "-o", str(csv)], capture_output=True, text=True)
    if run.returncode != 0:
        return None, f"exit {run.returncode}: {run.stderr.strip()}", time.time() - begun
    return measure.compare(truth, csv), run.stderr, time.time() - begun


def main():
    program, family, span, folder = sys.argv[1:5]
    verbose = len(sys.argv) > 5
    first, last = (int(q) for q in span.split("-"))
    Path(folder).mkdir(parents=True, exist_ok=True)
    results, failures = [], 0
    for seed in range(first, last + 1):
        truth = plots.make(seed, family, folder)
        found, text, seconds = digitise(program, truth)
        d = truth["design"]
        tag = (f"{truth['name']} {d['program']} {d['dpi']} {d['frame']} grid={d['grid']} jpeg={d['jpeg']} "
               f"turn={d['rotation']:.1f} {seconds:.1f}s")
        if found is None:
            failures += 1
            print(f"{tag}\n   FAILED {text}")
            results += [dict(name=truth["name"], kind="markers", errors=np.empty((0, 2)), u=np.empty((0, 2)),
                             missed=len(s["points"]), invented=0) for s in truth["series"] if s["kind"] == "markers"]
            continue
        results += found
        for r in found:
            e = np.abs(r["errors"])
            if r["kind"] == "markers":
                bad = r["missed"] or r["invented"] or (e.size and np.percentile(e, 95) > 0.003)
                what = f"missed {r['missed']} invented {r['invented']} of {r['wanted']}"
                if "bars" in r:
                    b = np.abs(r["bars"])
                    what += f" bars unseen {np.isnan(b).sum()} max {np.nanmax(b) if not np.isnan(b).all() else 0:.4f}"
                    bad = bad or np.isnan(b).any() or np.nanmax(b) > 0.006
            else:
                bad = not e.size or (e > 0.005).mean() > 0.02 or r["followed"] < 0.9
                what = f"followed {r['followed']:.2f}"
            if bad or verbose:
                print(f"{tag}\n   {r['series']} {r['drawn']} {r['shape']}: {what}", end="")
                if e.size:
                    inside = (e <= 2 * r["u"]).mean()
                    print(f" p95 {np.percentile(e, 95):.5f} max {e.max():.5f} covered {inside:.2f} 2u {np.median(2 * r['u']):.5f}", end="")
                print()
    print(f"{family} {span}: {failures} failed")
    for kind, figures in measure.summary(results).items():
        print(kind, {k: round(v, 5) if isinstance(v, float) else v for k, v in figures.items()})


if __name__ == "__main__":
    main()
