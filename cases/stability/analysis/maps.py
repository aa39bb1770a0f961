#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the maps of docs/stability.md that concern the analysis.

    cases/stability/analysis/maps.py build/release/tests/analysis/analysis_stability_test docs/images/stability_analysis

runs the tests of where the methods fail, takes what they measured (lines "map ...") and draws
<name>.svg and <name>.png with gnuplot. Fails where a test does.
"""
import collections
import subprocess
import sys

BLUE, RED, GREEN = "#0072B2", "#D55E00", "#009E73"
PANELS = [  # title, x, y, left and bottom [screen], settings, plot words
    ("Cluster thresholds", "margin of the holdups over the threshold [%]", "change of the number [%]", "clusters",
     "set xrange [-6:6]; set yrange [0:110]",
     [("$1*100", "$2*100", f"w lp pt 7 ps .5 lc rgb '{BLUE}'", "threshold ± 0.5 %"),
      ("$1*100", "$3*100", f"w lp pt 4 ps .5 dt (6,3) lc rgb '{GREEN}'", "± 1 %, as measured by the tool"),
      ("$1*100", "$4*100", f"w steps lw 1.6 lc rgb '{RED}'", "warned")]),
    ("Windows", "independent samples in the window [-]", "share of windows [%]", "windows",
     "set logscale x 2; set xrange [0.8:300]; set yrange [0:119]",
     [("$1==@?$2:1/0", "$3*100", "w lp pt {m} ps .5 lc rgb '" + BLUE + "'", "interval holds, ρ = @"),
      ("$1==@?$2:1/0", "$4*100", "w lp pt {m} ps .5 dt (6,3) lc rgb '" + RED + "'", "warned, ρ = @")]),
    ("Drifting series", "drift [standard errors of the mean]", "share of series [%]", "drift",
     "set logscale x 2; set xrange [0.4:80]; set yrange [0:119]",
     [("$1==@?$2:1/0", "$3*100", "w lp pt {m} ps .5 lc rgb '" + BLUE + "'", "final state missed, ρ = @"),
      ("$1==@?$2:1/0", "$4*100", "w lp pt {m} ps .5 dt (6,3) lc rgb '" + RED + "'", "warned, ρ = @")]),
    ("Gaussian kernel", "width of the kernel [cells]", "jump as a particle crosses a face [%]", "gaussian",
     "set logscale x; set xrange [0.015:5]; set yrange [0:119]",
     [("$1", "$2*100", f"w lp pt 7 ps .5 lc rgb '{BLUE}'", "of its volume, over a tenth of a cell"),
      ("$1", "$3*100", f"w steps lw 1.6 lc rgb '{RED}'", "warned")]),
    ("Cells across the domain", "cells across [-]", "wall excess that is lost [%]", "across",
     "set logscale x 2; set xrange [0.9:32]; set yrange [0:119]",
     [("$1", "$2*100", f"w lp pt 7 ps .5 lc rgb '{BLUE}'", "of 0.45 of the core's holdup"),
      ("$1", "$3*100", f"w steps lw 1.6 lc rgb '{RED}'", "warned")]),
]


def main(test, name):
    done = subprocess.run([test], capture_output=True, text=True)
    rows = collections.defaultdict(list)
    for line in done.stdout.splitlines():
        if line.startswith("map "):
            rows[line.split()[1]].append(line.split()[2:])
    if done.returncode != 0:
        sys.exit(done.stdout)
    script = ["set encoding utf8", "set key outside above left Left reverse samplen 2 width -2 maxrows 3",
              "set border lw .7", "set tics in scale .5"]
    for panel in PANELS:
        script.append(f"${panel[3]} << END\n" + "\n".join(" ".join(row) for row in rows[panel[3]]) + "\nEND")
    for form, terminal in (("svg", "svg size 680,900 font 'DejaVu Sans,10' background 'white'"),
                           ("png", "pngcairo size 1360,1800 font 'DejaVu Sans,10' fontscale 2 pointscale 1.6 linewidth 1.6")):
        script += [f"set terminal {terminal}", f"set output '{name}.{form}'", "set multiplot layout 3,2 columnsfirst"]
        for title, x, y, key, settings, curves in PANELS:
            words = []
            for at, value, style, label in curves:
                series = sorted({row[0] for row in rows[key]}, key=float) if "@" in at else [""]
                for k, of in enumerate(series):
                    words.append(f"${key} u ({at.replace('@', of)}):({value}) {style.replace('{m}', str(5 + 2 * k))} "
                                 f"t '{label.replace('@', of)}'")
            script += ["unset logscale; set xtics autofreq", settings, f"set title '{title}' offset 0,0",
                       f"set xlabel '{x}' offset 0,.5", f"set ylabel '{y}' offset 1.5,0", "plot " + ", ".join(words)]
        script.append("unset multiplot; unset output")
    subprocess.run(["gnuplot", "-"], input="\n".join(script), text=True, check=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
