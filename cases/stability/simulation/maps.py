#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs LIGGGHTS and the coupled solver over the edge of each method and draws the maps of docs/stability.md.

    BEDSCOPE=build/release/app/bedscope BEDSCOPE_COUPLED=build/release/cases/coupled/bedscope-coupled \\
        cases/stability/simulation/maps.py docs/images/stability_simulation

writes <name>.csv (all that was measured, and whether `bedscope case check` warned), <name>.svg and <name>.png; a few minutes
of one core. --jobs N runs N at a time; with --draw it draws anew from the .csv. Needs gnuplot and a python with scipy.
"""
import concurrent.futures
import csv
import itertools
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile
import threading

import cells
import contacts
import drag
import heat
import scaling

LOST = 1e3  # stands for what was lost or blew up


def collisions():
    for model, angles in (("linear", (0, 45)), ("hertz", (0,))):
        for n in (1.2, 1.6, 2, 2.5, 3.3, 4.4, 5.5, 7.5, 10.5, 20.5):
            for angle in angles:
                def run(at, m=model, n=n, a=angle):
                    return contacts.impacts(at, m, n, a, count=49)
                kinds = [(f"{model} {angle}", statistics.fmean), (f"{model} {angle} largest", max)]
                yield ("collision", n, run, contacts.LIMITS[model],
                       [(name, lambda found, of=of: of(found[2]) if found[2] else LOST) for name, of in kinds])


def beds():
    for model in contacts.LIMITS:
        for n in (1.3, 1.6, 2, 2.5, 3, 4, 6, 10):
            yield ("bed", n, lambda at, m=model, n=n: contacts.bed(at, m, n, count=64), contacts.LIMITS[model],
                   [(model, lambda found: LOST if found[1] is None else found[1])])


def risers():
    for n in (1.3, 1.6, 1.9, 2.2, 3, 5, 10, 20):
        yield ("riser", n, lambda at, n=n: contacts.riser(at, n), contacts.LIMITS["linear"],
               [("linear", lambda found: LOST if found[1] is None else found[1])])


def overlaps():
    for speed, stiffnesses in ((0.1, (25, 100, 400, 1600)), (5.55, (60, 100, 130, 400, 1600, 25600, 1.6e6))):
        for k in stiffnesses:
            yield ("overlap", k, lambda at, k=k, v=speed: contacts.overlap(at, k, v), ["overlap over radius at walls"],
                   [(str(speed), lambda found: found[1] if found[2] else LOST)])


def drag_steps():
    limit = ["gas step over the particles' relaxation time"]
    for x in (0.25, 0.5, 1.5, 1.9, 2.3):
        yield "particle", x, lambda at, x=x: drag.lone(at, x), limit, [("lone", lambda found: drag.growth(found[1][:6]))]
    for implicit in (True, False):
        name = "implicit" if implicit else "explicit"
        for x in (0.2, 0.6, 1.2, 1.5, 1.9, 2.3) if implicit else (0.6, 1.5, 2.3):
            yield ("particle", x, lambda at, x=x, i=implicit: drag.plug(at, x, implicit=i, voidage=0.45), limit,
                   [("dense " + name, lambda found: drag.swing(found[1]))])
        for x in (0.5, 1.5, 1.8, 2.2, 3, 6):
            yield ("gas", x, lambda at, x=x, i=implicit: drag.fixed_bed(at, x, i),
                   [] if implicit else ["explicit drag on the gas"],
                   [(name, lambda found: drag.growth(found[1], 1e-7))])


def grids():
    for method in cells.METHODS:
        for ratio in (0.5, 1, 3.6, 15, 60):
            yield ("jump", ratio, lambda at, r=ratio, m=method: cells.crossing(at, r, m), ["dV/V_p"],
                   [(method, lambda found: found[1])])
    places, lock = [], threading.Lock()
    for method in cells.METHODS:
        for n in (2, 3, 4, 5, 6, 8, 10, 12, 16):
            def run(at, n=n, m=method):
                with lock:
                    if not places:
                        places.extend(cells.settled(at / "settled"))
                return cells.packed(at / "cells", places, n, m)
            yield "holdup", 12 / n, run, ["cell edge over diameter"], [(method, lambda found: found[1])]


def scalings():
    for ratio in (1.1, 1.8, 2.3, 3, 4, 6, 9):
        yield "depth", ratio, lambda at, r=ratio: scaling.depth(at, r), [], [("bed", lambda found: found[1])]


def temperatures():
    for each, capacity in ((1, 0.4), (8, 0.4), (8, 8.0)):
        for part in (0.25, 0.6, 0.9, 1.1, 1.4):
            def run(at, e=each, c=capacity, p=part):
                return heat.large_step(at, heat.Column(capacity=c).part_of_edge(p, e), e, capacity=c)
            yield ("heat step", part, run, ["gas step over the particles' thermal time"],
                   [(f"{each} {capacity:g}", lambda found: min(LOST, max(1e-4, found[1])))])
    for each in (1, 2, 4, 8, 16):
        column = heat.Column()
        yield ("grid", each * column.pitch / column.length, lambda at, e=each: heat.grid(at, e),
               ["cell height over exchange length"], [("front", lambda found: found[1])])


def measured(point):
    panel, x, run, limits, series = point
    with tempfile.TemporaryDirectory(prefix="stability.") as folder:
        found = run(pathlib.Path(folder))
        warned = found[0].warned(*limits) if limits else False
    rows = [[panel, name, f"{x:.4g}", f"{value(found):.4g}", int(warned)] for name, value in series]
    print(*rows, flush=True)
    return rows


def measure(jobs):
    parts = (temperatures, risers, scalings, grids, drag_steps, overlaps, beds, collisions)  # long ones first
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        points = itertools.chain.from_iterable(part() for part in parts)
        rows = list(itertools.chain.from_iterable(pool.map(measured, points)))
    with tempfile.TemporaryDirectory(prefix="stability.") as folder:
        for number, off in scaling.scatter(pathlib.Path(folder))[1]:
            rows.append(["scatter", "spheres", f"{number:.4g}", f"{off:.4g}", int(off_warned(number))])
    return rows


def off_warned(number):
    """The rule of `case check` for the smallest cluster."""
    return math.sqrt(scaling.structure(0.2) / number) > 0.1


BLUE, RED, GREEN, ORANGE = "#0072B2", "#D55E00", "#009E73", "#E69F00"
LOOKS = [(BLUE, 7, "solid"), (GREEN, 9, "(8,4)"), (ORANGE, 5, "(3,3)"), ("#CC79A7", 11, "(8,3,2,3)"), ("#56B4E9", 13, "(12,3)")]
E2 = 0.96**2
PANELS = [  # title, x, y, key, settings, series: (key, label), theories: (formula of x, label)
    ("One collision, e = 0.96", "steps in a contact", "energy after / before", "collision",
     "set logscale xy; set xrange [0.9:45]; set yrange [0.7:1500]",
     [("linear 0", "linear, mean"), ("hertz 0", "Hertz, mean"), ("linear 45", "45°, mean"),
      ("linear 0 largest", "linear, largest"), ("hertz 0 largest", "Hertz, largest")], [(f"x>1.58?{E2}/(1-(pi/x)**2/4):1/0", "bound"), ("1", "")]),
    ("A bed at rest", "steps in a contact", "rms speed / √(2 g d)", "bed",
     "set logscale xy; set xrange [1.1:12]; set yrange [1e-5:2e3]", [("linear", "linear"), ("hertz", "Hertz")], []),
    ("A riser", "steps in a contact", "random speed / gas velocity", "riser",
     "set logscale xy; set xrange [1.1:25]; set yrange [1e-2:2e3]", [("linear", "linear")], []),
    ("Overlap at a wall", "stiffness [N/m]", "overlap / radius", "overlap",
     "set logscale xy; set xtics (100, '10^4' 1e4, '10^6' 1e6); set xrange [15:3e6]; set yrange [2e-3:2e3]",
     [("0.1", "0.1 m/s"), ("5.55", "5.55 m/s")],
     [(f"{contacts.largest_overlap(1, v, 0.86) / contacts.D * 2}/sqrt(x)", "theory" if v == 0.1 else "")
      for v in (0.1, 5.55)] + [("0.01", ""), ("1", "")]),
    ("Drag on particles", "step / relaxation time", "growth of the slip a step, or swing", "particle",
     "set logscale y; set xrange [0:2.6]; set yrange [0.01:2e3]",
     [("lone", "lone: growth"), ("dense implicit", "dense: swing"), ("dense explicit", "dense, explicit")],
     [("abs(1-x)", "|1 − x|"), ("1", "")]),
    ("Drag on the gas", "(1+n) β Δt / (ε ρ)", "growth of changes a step", "gas",
     "set logscale y; set xrange [0:8.2]; set yrange [0.03:30]",
     [("explicit", "explicit"), ("implicit", "implicit")], [("abs(1-x)", "|1 − x|"), ("1", "")]),
    ("A sphere crosses a face", "ΔV/V_p", "jump of the voidage", "jump",
     "set logscale xy; set xrange [0.4:80]; set yrange [3e-3:2]", [("centre", "centre"), ("divided", "divided")],
     [("1/x", "V_p/ΔV"), ("9./29/x", "9/29 V_p/ΔV")]),
    ("Settled bed on gas cells", "cell edge / diameter", "largest holdup", "holdup",
     "set xrange [0.6:6.2]; set yrange [0.5:1.05]", [("centre", "centre"), ("divided", "divided")],
     [("0.74048", "π/√18")]),
    ("Depth", "D/d", "voidage of a settled bed", "depth", "set logscale x; set xrange [1:16]; set yrange [0.36:0.62]",
     [("bed", "12 d wide")], []),
    ("Numbers in a cluster", "spheres", "scatter of holdup", "scatter",
     "set logscale xy; set xrange [4:500]; set yrange [0.01:0.4]", [("spheres", "holdup 0.2")],
     [(f"sqrt({scaling.structure(0.2)}/x)", "√(S/N)")]),
    ("Heat with large steps", "step / theoretical edge", "temperature beyond both / step", "heat step",
     "set logscale y; set xrange [0.2:1.7]; set yrange [5e-5:2e3]",
     [("1 0.4", "cell 0.35 long"), ("8 0.4", "2.8 long"), ("8 8", "2.8 long, slow")], []),
    ("Fixed bed on a coarse grid", "cell height / exchange length", "largest error / step", "grid",
     "set logscale xy; set xrange [0.2:8]; set yrange [1e-3:0.2]", [("front", "half-way front")], [("0.01", "")]),
]


def draw(rows, name):
    script = ["set encoding utf8", "set border lw .7", "set tics in scale .5", "set samples 400",
              "set key outside top center horizontal Left reverse samplen 2.5 maxcols 2 font ',9'", "set format '%g'"]
    for n, (*_, key, _, series, _) in enumerate(PANELS):
        for k, (one, _) in enumerate(series):
            points = sorted((float(r[2]), float(r[3]), r[4]) for r in rows if r[0] == key and r[1] == one)
            script.append(f"$p{n}_{k} << END\n" + "\n".join(f"{x} {y} {w}" for x, y, w in points) + "\nEND")
    for form, terminal in (("svg", "svg size 1080,1240 font 'DejaVu Sans,10' background 'white'"),
                           ("png", "pngcairo size 2160,2480 font 'DejaVu Sans,10' fontscale 2 pointscale 1.5 linewidth 1.6")):
        script += [f"set terminal {terminal}", f"set output '{name}.{form}'", "set multiplot layout 4,3"]
        for n, (title, x, y, key, settings, series, theories) in enumerate(PANELS):
            words = [f"{f} w l lw 1 dt 1 lc rgb '#888888' " + (f"t '{label}'" if label else "notitle")
                     for f, label in theories]
            for k, (_, label) in enumerate(series):
                colour, mark, dash = LOOKS[k]
                words.append(f"$p{n}_{k} u 1:2 w lp pt {mark} ps .5 dt {dash} lc rgb '{colour}' t '{label}'")
                words.append(f"$p{n}_{k} u 1:($3>0?$2:1/0) w p pt 6 ps 1.1 lc rgb '{RED}' "
                             + ("t 'warned'" if k == 0 and any(r[0] == key and r[4] == "1" for r in rows) else "notitle"))
            script += ["unset logscale; set xtics autofreq; set autoscale", settings, f"set title '{title}' offset 0,0",
                       f"set xlabel '{x}' offset 0,.5", f"set ylabel '{y}' offset 1,0", "plot " + ", ".join(words)]
        script += ["unset multiplot; unset output"]
    subprocess.run(["gnuplot", "-"], input="\n".join(script), text=True, check=True)


def main(name, *flags):
    jobs = int(flags[flags.index("--jobs") + 1]) if "--jobs" in flags else 1
    table = pathlib.Path(name + ".csv")
    if "--draw" not in flags:
        rows = measure(jobs)
        with open(table, "w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([["map", "series", "x", "y", "warned"], *rows])
    with open(table, newline="") as file:
        draw(list(csv.reader(file))[1:], name)


if __name__ == "__main__":
    main(*sys.argv[1:])
