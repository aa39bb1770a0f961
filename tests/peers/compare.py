# SPDX-License-Identifier: BSD-3-Clause
"""Holds two folders of tables against each other, number by number: `compare.py A B`.

Each folder is what a peer or `bedscope analyse` leaves (CSV files in it or under its tables/). Compared are
all columns of B (the peer), which A must have too, in rows of type `all` where there are types. Clusters are paired in each snapshot by
their centre, since the programs number them differently. Exit code 0: all agree; 1: some do not; 2: usage.
"""

import csv
import math
import os
import sys

# Relative, or absolute below 1: sums of up to 50,000 terms in another order differ by about 1e-13 of the
# largest partial sum; velocities are ratios of such sums and cancel further.
TOLERANCE = 1e-9
KEYS = {  # columns that say which row it is
    "axial_profile": ("z [m]",),
    "lateral_profile": ("height [m]", "x [m]"),
    "inventory": ("time [s]",),
    "cluster_occurrence": ("time [s]",),
}
# Names and numbers of their own; the angle has its own comparison.
UNPAIRED = ("run", "type", "cluster", "angle [rad]")


def rows_of(folder, name):
    for place in (os.path.join(folder, "tables"), folder):
        path = os.path.join(place, name + ".csv")
        if os.path.exists(path):
            with open(path, newline="") as file:
                rows = list(csv.DictReader(file))
            return [row for row in rows if row.get("type", "all") == "all"]
    sys.exit(f"compare.py: {folder} has no {name}.csv")


def number(text):
    return float(text) if text else math.nan


def off(a, b):
    """How far a and b lie apart, relative to the larger one or to 1."""
    if math.isnan(a) and math.isnan(b):
        return 0.0
    if math.isnan(a) or math.isnan(b):
        return math.inf
    return abs(a - b) / max(1.0, abs(a), abs(b))


class Report:
    def __init__(self):
        self.failed = False

    def line(self, name, text, good):
        self.failed |= not good
        print(f"{'agree ' if good else 'DIFFER'}  {name}: {text}")

    def columns(self, name, pairs):
        """pairs: rows of A and B that belong together."""
        for column in pairs[0][1]:
            if column in UNPAIRED:
                continue
            if column not in pairs[0][0]:
                self.line(name, f"A has no column '{column}'", False)
                continue
            # Lengths and areas are far below 1: judged against the largest of the column instead.
            a = [number(row[column]) for row, _ in pairs]
            b = [number(row[column]) for _, row in pairs]
            scale = max((abs(v) for v in a + b if math.isfinite(v)), default=1.0) or 1.0
            scale = min(scale, 1.0)
            worst = max(off(p / scale, q / scale) for p, q in zip(a, b))
            self.line(name, f"{column}, {len(pairs)} rows, worst difference {worst:.1e}", worst <= TOLERANCE)


def by_key(rows, keys):
    # Nine digits: coordinates are computed differently, their spacing is far larger.
    return {tuple(f"{float(row[k]):.9g}" for k in keys): row for row in rows}


def compare_table(report, folder_a, folder_b, name):
    a, b = (by_key(rows_of(folder, name), KEYS[name]) for folder in (folder_a, folder_b))
    if a.keys() != b.keys():
        report.line(name, f"{len(a.keys() ^ b.keys())} of {len(a)} and {len(b)} rows have no partner", False)
    pairs = [(a[key], b[key]) for key in a if key in b]
    if pairs:
        report.columns(name, pairs)


def compare_clusters(report, folder_a, folder_b):
    def by_time(folder):
        groups = {}
        for row in rows_of(folder, "clusters"):
            groups.setdefault(f"{float(row['time [s]']):.9g}", []).append(row)
        return groups

    a, b = by_time(folder_a), by_time(folder_b)
    pairs, alone = [], 0
    for time in sorted(a.keys() | b.keys(), key=float):
        left = list(b.get(time, []))
        for row in a.get(time, []):
            place = (number(row["x [m]"]), number(row["z [m]"]))
            near = min(left, default=None, key=lambda r: math.dist(place, (number(r["x [m]"]), number(r["z [m]"]))))
            if near is None:
                alone += 1
            else:
                left.remove(near)
                pairs.append((row, near))
        alone += len(left)
    report.line("clusters", f"{len(pairs)} pairs, {alone} without a partner", alone == 0 and len(pairs) > 0)
    if not pairs:
        return
    report.columns("clusters", pairs)
    worst = 0.0
    for p, q in pairs:
        # A round cluster has no direction; +pi/2 and -pi/2 are the same one.
        if number(p["major [m]"]) > 1.01 * number(p["minor [m]"]):
            turn = number(p["angle [rad]"]) - number(q["angle [rad]"])
            worst = max(worst, abs(turn - math.pi * round(turn / math.pi)))
    report.line("clusters", f"angle [rad], worst difference {worst:.1e}", worst <= TOLERANCE)


def main():
    if len(sys.argv) != 3:
        print("usage: compare.py A B", file=sys.stderr)
        return 2
    report = Report()
    for name in KEYS:
        compare_table(report, sys.argv[1], sys.argv[2], name)
    compare_clusters(report, sys.argv[1], sys.argv[2])
    return 1 if report.failed else 0


if __name__ == "__main__":
    sys.exit(main())
