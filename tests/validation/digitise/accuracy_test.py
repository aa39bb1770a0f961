# SPDX-License-Identifier: BSD-3-Clause
"""The accuracy that the digitiser promises (docs/digitiser.md), on plots of known data.

Usage: accuracy_test.py BEDSCOPE few|many. Exit code 77: matplotlib, scipy or gnuplot is missing.
"""
import os
import shutil
import sys
import tempfile

try:
    import measure
    import plots
except ImportError as missing:
    print(missing)
    sys.exit(77)
if not shutil.which("gnuplot"):
    print("gnuplot is missing")
    sys.exit(77)
import sweep

# Few: 16 plots that between them have every shape, dash, scale, grid, resolution, compression, turn.
SEEDS = {"few": [("tuned", range(1, 17))],
         "many": [("tuned", range(1, 61)), ("held_out", range(1, 61)), ("last", range(1, 61))]}


def main():
    program, how_many = os.path.abspath(sys.argv[1]), sys.argv[2]
    failed = False
    for family, seeds in SEEDS[how_many]:
        folder = tempfile.mkdtemp(prefix="bedscope_")
        results, errors = [], []
        try:
            for seed in seeds:
                truth = plots.make(seed, family, folder)
                found, text, _ = sweep.digitise(program, truth)
                if found is None:
                    errors.append(f"{truth['name']}: {text}")
                else:
                    results += found
        finally:
            shutil.rmtree(folder)
        figures = measure.summary(results)
        print(family, len(seeds), "plots;", len(errors), "not digitised", *errors, sep="\n  ")
        for kind, numbers in figures.items():
            print(f"  {kind}:", ", ".join(f"{k} {v:.5g}" for k, v in numbers.items()))
        demands = measure.demands(figures, len(errors), len(seeds), few=how_many == "few")
        for text in demands:
            print("  NOT MET:", text)
        failed = failed or bool(demands)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
