# SPDX-License-Identifier: BSD-3-Clause
"""Error against cost, a panel a product, and the law of cost against what was measured; by gnuplot."""
import math
import subprocess

# Of colours that colour-blind readers tell apart (Okabe and Ito), each with its own mark: full, hollow.
BLACK = ("#000000", 7, 6)  # the present choice
LOOKS = [("#0072B2", 5, 4), ("#D55E00", 9, 8), ("#009E73", 13, 12), ("#CC79A7", 11, 10),
         ("#E69F00", 15, 14), ("#56B4E9", 7, 6), ("#777777", 5, 4)]
WIDTH, COLUMNS = 1080, 3
PANEL, KEY = (WIDTH / COLUMNS, 330), 52  # pixels
LEFT, RIGHT, ABOVE, BELOW = 66, 22, 30, 46  # margins in a panel
GREY = "#888888"
PRESENT = "present choice"


STEPS = [m * 10.0**e for e in range(-9, 9) for m in (1, 2, 5)]


def ends_of(values, margin=1.25):
    """Of a logarithmic axis that holds them: steps of 1, 2, 5, and three of them at least."""
    low = max(n for n, s in enumerate(STEPS) if s <= min(values) / margin)
    high = max(low + 2, min(n for n, s in enumerate(STEPS) if s >= max(values) * margin))
    return STEPS[low], STEPS[high]


class Axes:
    """Of a plot of some size in pixels, its ends in x and y: where a value lies."""

    def __init__(self, x, y, outside):
        self.x, self.y, self.size = x, y, (outside[0] - LEFT - RIGHT, outside[1] - ABOVE - BELOW)

    def at(self, x, y):
        part = lambda v, ends: math.log(v / ends[0]) / math.log(ends[1] / ends[0])
        return part(x, self.x) * self.size[0], part(y, self.y) * self.size[1]

    def margins(self, left, top, sheet):
        """Script that puts the plot there on a sheet, all in pixels."""
        edges = (left + LEFT) / sheet[0], (left + LEFT + self.size[0]) / sheet[0], \
            1 - (top + ABOVE + self.size[1]) / sheet[1], 1 - (top + ABOVE) / sheet[1]
        return "; ".join(f"set {side}margin at screen {e:.5f}" for side, e in zip("lrbt", edges))

    def ranges(self):
        def tics(ends, most):
            """Beyond so many decades numbers would touch: those of 10, 100, 1000 alone."""
            all_fit = ends[1] / ends[0] <= 10**most
            return ", ".join(f"{v:g}" if all_fit or f"{v:e}".startswith("1.0") else f"'' {v:g} 1"
                             for v in STEPS if ends[0] <= v <= ends[1])

        return f"set xrange [{self.x[0]:g}:{self.x[1]:g}]; set yrange [{self.y[0]:g}:{self.y[1]:g}]; " \
               f"set xtics ({tics(self.x, 2.4)}); set ytics ({tics(self.y, 4)})"

    def label(self, x, y, text, more="center"):
        return f"set label {quoted(text)} at graph {x / self.size[0]:.4f},{y / self.size[1]:.4f} {more} font ',8'"


def places(axes, points, obstacles):
    """A place beside each (x, y, text) where its text is over no mark, bar or other text, as far as there is one."""
    taken = [(px - 5, py - 5, px + 5, py + 5) for px, py in (axes.at(x, y) for x, y, _ in points)] + obstacles
    found = []
    wide, high = axes.size
    for x, y, text in points:
        px, py = axes.at(x, y)
        w, h = 5.6 * len(text), 11
        best = None
        for reach in (8, 14, 22, 32):
            for dx, dy in ((1, 0), (-1, 0), (1, 1), (-1, 1), (1, -1), (-1, -1), (0, 1), (0, -1)):
                cx, cy = px + dx * (reach + w / 2), py + dy * (reach + h / 2 - 3)
                box = (cx - w / 2, cy - h / 2, cx + w / 2, cy + h / 2)
                over = sum(max(0, min(box[2], b[2]) - max(box[0], b[0])) * max(0, min(box[3], b[3]) - max(box[1], b[1]))
                           for b in taken)
                if box[0] < 2 or box[2] > wide - 2 or box[1] < 2 or box[3] > high - 2:
                    over += w * h
                over += 0.02 * reach
                if best is None or over < best[0]:
                    best = (over, cx, cy, box)
        taken.append(best[3])
        found.append((best[1], best[2], text))
    return found


def quoted(text):
    return "'" + text.replace("'", "''") + "'"


def block(name, rows):
    return f"${name} << END\n" + "\n".join(" ".join(f"{v:.6g}" if isinstance(v, float) else str(v) for v in row)
                                           for row in rows) + "\nEND"


def panel(n, product, look):
    """Script of a panel. `product`: title, finest cost, dotted line, and rows (subject, text, cost, error, front)."""
    rows = product["rows"]
    heights = [v for r in rows for v in (r["error"].shown, r["error"].low, r["error"].high) if v > 0] + [product["line"]]
    axes = Axes(ends_of([r["cost"] for r in rows] + [product["finest"]], 1.4), ends_of(heights), PANEL)
    script, words = [axes.margins(*product["corner"], product["sheet"])], [f"{product['line']} w l dt 3 lc rgb '{GREY}' notitle"]
    step = sorted((r["cost"], r["error"].shown) for r in rows if r["front"])
    script.append(block(f"front{n}", step + [(axes.x[1], step[-1][1])] if step else [("NaN", "NaN")]))
    words.append(f"$front{n} w steps lc rgb '{GREY}' lw 1 notitle")
    corners = [axes.at(*corner) for corner in step] + [(axes.size[0], 0)]
    obstacles = [(a[0], a[1] - 2, b[0], a[1] + 2) for a, b in zip(corners, corners[1:])]
    for k, (subject, (colour, full, hollow)) in enumerate(look.items()):
        mine = [r for r in rows if r["subject"] == subject]
        told = [(r["cost"], r["error"].value, r["error"].low, r["error"].high) for r in mine if r["error"].told]
        none = [(r["cost"], r["error"].value) for r in mine if not r["error"].known]
        below = [(r["cost"], r["error"].high, 0.0, -1) for r in mine if r["error"].known and not r["error"].told]
        for x, _, low, high in told:
            (px, a), (_, b) = axes.at(x, low), axes.at(x, high)
            obstacles.append((px - 2, a, px + 2, b))
        for x, y, *_ in below:
            px, py = axes.at(x, y)
            obstacles.append((px - 3, py - 22, px + 3, py))
        for kind, data in (("t", told), ("b", below), ("o", none)):
            if data:
                script.append(block(f"{kind}{n}_{k}", data))
        if told:
            words.append(f"$t{n}_{k} u 1:2:3:4 w yerrorbars pt {full} ps .8 lw 1 lc rgb '{colour}' notitle")
        if below:
            script += [f"set arrow from {x:.6g},{y:.6g} rto graph 0,{-20 / axes.size[1]:.4f} size graph .016,20 "
                       f"lc rgb '{colour}'" for x, y, *_ in below]
            words.append(f"$b{n}_{k} u 1:2 w p pt {hollow} ps .9 lw 1.2 lc rgb '{colour}' notitle")
        if none:
            words.append(f"$o{n}_{k} u 1:2 w p pt 2 ps 1 lw 1.2 lc rgb '{colour}' notitle")
    present = [(r["cost"], r["error"].shown) for r in rows if r["subject"] == PRESENT]
    if present:  # a ring around it
        script.append(block(f"p{n}", present))
        words.append(f"$p{n} u 1:2 w p pt 6 ps 2 lw 1.4 lc rgb '#000000' notitle")
    others = [r for r in rows if r["subject"] != PRESENT]
    texts = places(axes, [(r["cost"], r["error"].shown, r["text"]) for r in others], obstacles)
    script += [axes.label(*place, f"center tc rgb '{look[r['subject']][0]}'") for place, r in zip(texts, others)]
    px, _ = axes.at(product["finest"], axes.y[0])
    script.append(f"set arrow from graph {px / axes.size[0]:.4f},0 to graph {px / axes.size[0]:.4f},1 nohead dt 3 lc rgb '{GREY}'")
    script.append(axes.label(px - 5, 8, "finest", f"left rotate by 90 tc rgb '{GREY}'"))
    script += [axes.ranges(), f"set title {quoted(product['title'])} offset 0,-.6", "plot " + ", ".join(words)]
    return script


def sheets(width, height):
    return (("svg", f"svg size {width:.0f},{height:.0f} font 'DejaVu Sans,10' background 'white'"),
            ("png", f"pngcairo size {2 * width:.0f},{2 * height:.0f} font 'DejaVu Sans,10' fontscale 2 pointscale 1.7 linewidth 1.8"))


START = ["set encoding utf8", "set border 31 lw .7", "set tics in scale .5", "set logscale xy", "set format '%g'"]


def draw(products, subjects, name):
    """Writes <name>.svg and .png. `subjects` are named in the key, in this order."""
    look = {s: LOOKS[n % len(LOOKS)] for n, s in enumerate(subjects)} | {PRESENT: BLACK}
    rows = math.ceil(len(products) / COLUMNS)
    height = rows * PANEL[1] + KEY
    script = list(START)
    for form, terminal in sheets(WIDTH, height):
        script += [f"set terminal {terminal}", f"set output '{name}.{form}'", "set multiplot"]
        for n, product in enumerate(products):
            product = dict(product, sheet=(WIDTH, height), corner=(n % COLUMNS * PANEL[0], n // COLUMNS * PANEL[1]))
            script += ["unset arrow; unset label; unset key",
                       "set xlabel 'cost [core-s per simulated s]' offset 0,.4", "set ylabel 'relative error [%]' offset 0.2,0"]
            script += panel(f"{form}{n}", product, look)
        marks = [f"NaN w p pt {full} ps .9 lc rgb '{c}' t {quoted(s)}" for s, (c, full, _) in look.items() if s != PRESENT]
        marks += [f"NaN w p pt 6 ps 1.7 lw 1.4 lc rgb '#000000' t '{PRESENT}'",
                  f"NaN w l lc rgb '{GREY}' t 'front'", f"NaN w l dt 3 lc rgb '{GREY}' t '95 % interval of the finest'"]
        script += ["unset arrow; unset label; unset title; unset xlabel; unset ylabel; unset tics; unset border",
                   f"set lmargin at screen .02; set rmargin at screen .98; set bmargin at screen 0; set tmargin at screen {KEY / height:.4f}",
                   "set key center center horizontal Left reverse samplen 1.5 maxrows 2 font ',9'",
                   "set xrange [1:10]; set yrange [1:10]", "plot " + ", ".join(marks),
                   "unset multiplot; unset output; set tics in scale .5; set border 31 lw .7"]
    subprocess.run(["gnuplot", "-"], input="\n".join(script), text=True, check=True)


def draw_law(runs, law, left_out, name):
    """Writes <name>.svg and .png: CPU time of a gas step, measured against the law's. `left_out`: (run, its law)."""
    side = 460
    rows = {"fit": [], "out": []}
    for run in runs:
        out = left_out is not None and run is left_out[0]
        value, half = (left_out[1] if out else law).predict(run.particles, run.dem_steps, run.cells)
        rows["out" if out else "fit"].append((value, run.ms_per_step, run.name.replace("_", " "), half))
    ends = ends_of([v for kind in rows.values() for r in kind for v in r[:2]], 1.3)
    axes = Axes(ends, ends, (side, side))
    diagonal = [(x - 4, x - 4, x + 4, x + 4) for x in range(0, side, 6)]
    bars = [axes.at(max(v - half, ends[0]), y) + axes.at(v + half, y) for v, y, _, half in rows["out"]]
    bars = [(left, y - 3, right, y + 3) for left, y, right, _ in bars]
    texts = places(axes, [r[:3] for kind in rows.values() for r in kind], diagonal + bars)
    script = list(START) + [block("fit", [r[:2] for r in rows["fit"]])]
    words = [f"x w l lc rgb '{GREY}' t 'equal'", f"$fit w p pt 7 ps .9 lc rgb '{BLACK[0]}' t 'in the fit'"]
    if rows["out"]:
        script.append(block("out", [(x, y, x - half, x + half) for x, y, _, half in rows["out"]]))
        words.append(f"$out u 1:2:3:4 w xerrorbars pt 5 ps 1 lc rgb '{LOOKS[1][0]}' t 'left out of it, 95 % interval'")
    for form, terminal in sheets(side, side):
        script += [f"set terminal {terminal}", f"set output '{name}.{form}'", axes.margins(0, 0, (side, side)),
                   *(axes.label(*place) for place in texts),
                   axes.ranges(),
                   "set xlabel 'CPU time of a gas step by the law [ms]' offset 0,.4",
                   "set ylabel 'measured [ms]' offset .8,0", "set key top left Left reverse samplen 1.5 font ',9'",
                   "plot " + ", ".join(words), "unset output; unset label"]
    subprocess.run(["gnuplot", "-"], input="\n".join(script), text=True, check=True)
