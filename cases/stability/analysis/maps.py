#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the maps of docs/stability.md that concern the analysis.

    cases/stability/analysis/maps.py build/release/tests/analysis/analysis_stability_test docs/images/stability_analysis.png

runs the tests of where the methods fail, takes what they measured (lines "map ...") and draws
<name>.svg and <name>.png with gnuplot. Fails where a test does.
"""
import collections
import subprocess
import sys

BLUE, RED, GREEN = "#0072B2", "#D55E00", "#009E73"
CURVE = "w lp pt {m} ps .5 dt {d} lc rgb '%s'"
WARNED = f"w steps lw 1.6 lc rgb '{RED}'"
PANELS = [  # title, x, y, key of the rows, settings, curves: x, y, style, label
    ("Cluster thresholds", "margin of the holdups over the threshold [%]", "change of the number [%]", "clusters",
     "set xrange [-6:6]; set yrange [0:110]",
     [("$1*100", "$2*100", CURVE % BLUE, "for ± 0.5 % of the threshold"), ("$1*100", "$4*100", WARNED, "warned")]),
    ("Windows", "independent samples in the window [-]", "share of windows [%]", "windows",
     "set logscale x 2; set xrange [0.8:300]; set yrange [0:110]; set xtics 4",
     [("$1==@?$2:1/0", "$3*100", CURVE % BLUE, "interval holds the mean"),
      ("$1==@?$2:1/0", "$4*100", CURVE % RED, "warned")]),
    ("Drifting series", "drift [standard errors of the mean]", "share of series [%]", "drift",
     "set logscale x 2; set xrange [0.4:80]; set yrange [0:110]; set xtics 2",
     [("$1==@?$2:1/0", "$3*100", CURVE % BLUE, "final state missed"),
      ("$1==@?$2:1/0", "$5*100", CURVE % GREEN, "by twice the interval"),
      ("$1==@?$2:1/0", "$4*100", CURVE % RED, "warned")]),
    ("Gaussian kernel", "width of the kernel [cells]", "jump of a cell [% of a particle]", "gaussian",
     "set logscale x; set xrange [0.015:5]; set yrange [0:110]",
     [("$1", "$2*100", CURVE % BLUE, "over a tenth of a cell"), ("$1", "$3*100", WARNED, "warned")]),
    ("Cells across the domain", "cells across [-]", "wall excess that is lost [%]", "across",
     "set logscale x 2; set xrange [0.9:32]; set yrange [0:110]; set xtics 2",
     [("$1", "$2*100", CURVE % BLUE, "of 0.45 of the core’s holdup"), ("$1", "$3*100", WARNED, "warned")]),
]
DASHES = ["solid", "(10,4)", "(3,3)"]
MARKERS = [7, 4, 9]

def main(test, name):
    name = name.removesuffix(".png")
    done = subprocess.run([test], capture_output=True, text=True)
    rows = collections.defaultdict(list)
    for line in done.stdout.splitlines():
        if line.startswith("map "):
            rows[line.split()[1]].append(line.split()[2:])
    if done.returncode != 0:
        sys.exit(done.stdout)
    script = ["set encoding utf8", "set key outside top center horizontal Left reverse samplen 3 maxcols 2 font ',9'",
              "set border lw .7", "set tics in scale .5"]
    for panel in PANELS:
        script.append(f"${panel[3]} << END\n" + "\n".join(" ".join(row) for row in rows[panel[3]]) + "\nEND")
    for form, terminal in (("svg", "svg size 720,840 font 'DejaVu Sans,10' background 'white'"),
                           ("png", "pngcairo size 1440,1680 font 'DejaVu Sans,10' fontscale 2 pointscale 1.6 linewidth 1.6")):
        script += [f"set terminal {terminal}", f"set output '{name}.{form}'", "set multiplot layout 3,2"]
        for title, x, y, key, settings, curves in PANELS:
            words = []
            for at, value, style, label in curves:
                series = sorted({row[0] for row in rows[key]}, key=float) if "@" in at else [""]
                for k, of in enumerate(series):
                    look = style.replace("{m}", str(MARKERS[k])).replace("{d}", DASHES[k])
                    words.append(f"${key} u ({at.replace('@', of)}):({value}) {look} "
                                 + (f"t '{label}'" if k == 0 else "notitle"))
            script += ["unset logscale; set xtics autofreq", settings, f"set title '{title}' offset 0,0",
                       f"set xlabel '{x}' offset 0,.5", f"set ylabel '{y}' offset 1.5,0", "plot " + ", ".join(words)]
        script += ["unset border; unset tics; unset xlabel; unset ylabel; unset title; unset logscale",
                   "set xrange [0:1]; set yrange [0:1]",
                   "set label 1 'Correlation of consecutive samples ρ:' at graph .05,.75",
                   "set label 2 'full lines, discs: 0' at graph .1,.62",
                   "set label 3 'long dashes, squares: 0.8, of drift 0.5' at graph .1,.5",
                   "set label 4 'short dashes, triangles: 0.95, of drift 0.9' at graph .1,.38", "plot NaN notitle",
                   "unset multiplot; unset output; unset label; set border; set tics in scale .5"]
    subprocess.run(["gnuplot", "-"], input="\n".join(script), text=True, check=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
