# SPDX-License-Identifier: BSD-3-Clause
"""How well plots are read that the digitiser was not written against (unseen_plots.py).

    unseen.py BEDSCOPE SEEDS [FOLDER]      # seeds as 200-203,208

Draws and digitises one plot a seed; prints each series that is wrong, a table by style and the
totals. A series is wrong if a marker is missed or invented, the 95th percentile is beyond 0.4 % of the
axis (a line: 0.6 %), less than 93 % of a line is followed, one of ten bars is not seen or off by 1 %.
FOLDER keeps the plots, tables and overlays.
"""
import collections
import os
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import measure
import sweep
import unseen_plots


def wrong(r):
    """What is wrong with a series, as words."""
    e = np.abs(r["errors"])
    beyond = e.size and np.percentile(e, 95) > (.004 if r["kind"] == "markers" else .006)
    bars = np.abs(r["bars"]) if "bars" in r and r["bars"].size else np.zeros(1)
    return [word for word, holds in [
        ("missed", r.get("missed")), ("invented", r.get("invented")), ("off", beyond),
        ("not followed", r.get("followed", 1) < .93), ("bars unseen", np.isnan(bars).mean() > .1),
        ("bars off", np.nanpercentile(bars, 90) > .01 if not np.isnan(bars).all() else False)] if holds]


def main():
    program = os.path.abspath(sys.argv[1])
    spans = [part.split("-") for part in sys.argv[2].split(",")]
    seeds = [seed for span in spans for seed in range(int(span[0]), int(span[-1]) + 1)]
    kept = sys.argv[3] if len(sys.argv) > 3 else None
    results, refused, table = [], 0, collections.defaultdict(list)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(kept or temporary)
        folder.mkdir(parents=True, exist_ok=True)
        truths = [unseen_plots.make(seed, folder) for seed in seeds]
        pool = ThreadPoolExecutor(os.cpu_count())
        for truth, (found, text, seconds) in zip(truths, pool.map(lambda t: sweep.digitise(program, t), truths)):
            if found is None:
                refused += 1
                print(f"{truth['name']} ({truth['style']}, {truth['treatment']}): {text}")
            for i, s in enumerate(truth["series"]):
                words = ["refused"] if found is None else wrong(found[i])
                for group in (truth["style"], truth["treatment"], f"{s['kind']} of {s['drawn']}"):
                    table[group].append((words, found and found[i]))
                if words and found:
                    print(f"{truth['name']} ({truth['style']}, {truth['treatment']}, {seconds:.0f} s) {s['name']}, "
                          f"{s['drawn']} {s['shape']}: {', '.join(words)}", flush=True)
            results += found or []
    print(f"\n{'style, treatment, series':24} {'series':>6} {'wrong':>6} {'markers':>7} {'missed':>6} {'invented':>8}")
    for group, all_of in sorted(table.items()):
        of = [r for _, r in all_of if r and r["kind"] == "markers"]
        numbers = [sum(r[k] for r in of) for k in ("wanted", "missed", "invented")]
        print(f"{group:24} {len(all_of):6} {sum(bool(w) for w, _ in all_of):6} {numbers[0]:7} {numbers[1]:6} {numbers[2]:8}")
    of_all = [q for group in table if " of " in group for q in table[group]]
    print(f"\n{len(seeds)} plots, {refused} refused; {sum(bool(w) for w, _ in of_all)} of {len(of_all)} series wrong")
    for kind, numbers in measure.summary(results).items():
        print(f"{kind}:", ", ".join(f"{k} {v:.4g}" for k, v in numbers.items()))


if __name__ == "__main__":
    main()
