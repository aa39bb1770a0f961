# SPDX-License-Identifier: BSD-3-Clause
"""How well plots are read that the digitiser was not written against (unseen_plots.py).

    unseen.py BEDSCOPE SEEDS [FOLDER]      # seeds as 200-203,208

Draws and digitises one plot a seed; prints each series, a table by style and the totals; stopped
with Ctrl-C, those of the plots so far. 2u is counted for every point (markers: twice, x and y), give or take
what differs between plots. A series is wrong if a marker is missed or invented, the 95th percentile is beyond 0.4 % of the
axis (a line: 0.6 %), less than 93 % of a line is followed, one of ten bars is not seen or off by 1 %.
FOLDER keeps the plots, tables and overlays.
"""
import collections
import os
import sys
import tempfile
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


def doubted(series, text):
    """Whether the program said that a series is doubtful, by name or for the whole picture."""
    return any("doubtful" in line and (f'"{series["name"]}"' in line or "doubtful: series" not in line)
               for line in text.splitlines())


def line_of(r, words):
    e, u = np.abs(r["errors"]), np.asarray(r["u"])
    text = f"  {r['series']}, {r['drawn']} {r['shape']}: "
    if e.size:
        text += (f"p95 {100 * np.percentile(e, 95):.3f} %, 2u {100 * np.median(2 * u):.3f} % covers "
                 f"{100 * (e <= 2 * u).mean():.0f} %")
    return text + (f"; WRONG: {', '.join(words)}" if words else "")


def main():
    program = os.path.abspath(sys.argv[1])
    spans = [part.split("-") for part in sys.argv[2].split(",")]
    seeds = [seed for span in spans for seed in range(int(span[0]), int(span[-1]) + 1)]
    kept = sys.argv[3] if len(sys.argv) > 3 else None
    results, refused, plots, table = [], 0, 0, collections.defaultdict(list)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(kept or temporary)
        folder.mkdir(parents=True, exist_ok=True)
        try:
            for seed in seeds:
                truth = unseen_plots.make(seed, folder)
                found, text, seconds = sweep.digitise(program, truth)
                plots += 1
                print(f"{truth['name']} ({truth['style']}, {truth['treatment']}, {seconds:.0f} s) {text.strip()}")
                refused += found is None
                for i, s in enumerate(truth["series"]):
                    words = ["refused"] if found is None else wrong(found[i])
                    for group in (truth["style"], truth["treatment"], f"{s['kind']} of {s['drawn']}"):
                        table[group].append((words, found and found[i], found is None or doubted(s, text)))
                    if found:
                        print(line_of(found[i], words), flush=True)
                results += found or []
        except KeyboardInterrupt:
            print(f"stopped in seed {seed}")
    print(f"\n{'style, treatment, series':24} {'series':>6} {'wrong':>6} {'markers':>7} {'missed':>6} {'invented':>8}")
    for group, all_of in sorted(table.items()):
        of = [r for _, r, _ in all_of if r and r["kind"] == "markers"]
        numbers = [sum(r[k] for r in of) for k in ("wanted", "missed", "invented")]
        print(f"{group:24} {len(all_of):6} {sum(bool(w) for w, _, _ in all_of):6} {numbers[0]:7} {numbers[1]:6} "
              f"{numbers[2]:8}")
    of_all = [q for group in table if " of " in group for q in table[group]]
    bad, good = ([d for w, _, d in of_all if bool(w) == is_wrong] for is_wrong in (True, False))
    print(f"\n{plots} plots, {refused} refused; {len(bad)} of {len(of_all)} series wrong, {sum(bad)} of them refused or "
          f"said to be doubtful; {sum(good)} of the {len(good)} right ones said to be doubtful")
    for kind, numbers in measure.summary(results).items():
        print(f"{kind}:", ", ".join(f"{k} {v:.4g}" for k, v in numbers.items()))


if __name__ == "__main__":
    main()
