# SPDX-License-Identifier: BSD-3-Clause
"""Plots that the digitiser was not written against, drawn by matplotlib and gnuplot from a seed.

In the programs' own styles, with a scanner's or a journal's treatment, from data and choices that
plots.py does not share; the figure files are as a user writes them: whole pixels, colours by eye.
"""
import math
import random
import subprocess
from pathlib import Path

import matplotlib
matplotlib.use("Agg")
import matplotlib.colors
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image, ImageFilter

# Our name of each of matplotlib's markers (None: no name, the digitiser learns it), gnuplot's point types.
NAMES = {"o": "circle", "s": "square", "^": "triangle", "v": "triangle_down", "D": "diamond", "d": "diamond",
         "x": "x", "+": "plus", "*": "star", "p": "pentagon", "<": "triangle_left", ">": "triangle_right",
         "h": "hexagon", "P": None, "X": None, "8": None}
GNUPLOT = {"+": (1, 1), "x": (2, 2), "asterisk": (3, 3), "s": (4, 5), "o": (6, 7), "^": (8, 9), "v": (10, 11),
           "D": (12, 13)}
STROKES = ("x", "+", "asterisk")  # neither open nor filled
PALETTES = [
    "#1f77b4 #ff7f0e #2ca02c #d62728 #9467bd #8c564b #e377c2 #bcbd22 #17becf",
    "#e41a1c #377eb8 #4daf4a #984ea3 #ff7f00", "#1b9e77 #d95f02 #7570b3 #e7298a #66a61e",
    "#66c2a5 #fc8d62 #8da0cb #e78ac3", "#ff0000 #0000ff #000000 #00aa00", "#ff00ff #00ffff #0000ff #008000",
    "#332288 #117733 #44aa99 #cc6677 #882255", "#e69f00 #56b4e9 #009e73 #0072b2 #d55e00 #cc79a7",
    "#4c72b0 #dd8452 #55a868 #c44e52", "#000000 #777777"]
STYLES = ["default", "default", "classic", "ggplot", "seaborn-v0_8-whitegrid", "bmh", "dark_background",
          "fivethirtyeight", "Solarize_Light2", "seaborn-v0_8-ticks", "seaborn-v0_8-darkgrid", "fast"]
DASHES = {"-": 1, "--": 2, ":": 3, "-.": 4}


class Axis:
    def __init__(self, r, log):
        self.log = log
        if log:
            decade = r.choice([-4, -2, -1, 0, 1])
            self.lo = 10.0**decade * r.choice([1, 1, 2])
            self.hi = self.lo * 10**r.choice([1.5, 2, 3, 5])
        else:
            self.lo = r.choice([0, 0, -1, -0.05, 5, 200])
            self.hi = self.lo + r.choice([0.1, 0.6, 1, 2.4, 10, 350])

    def value(self, t):
        t = np.asarray(t, float)
        return self.lo * (self.hi / self.lo)**t if self.log else self.lo + t * (self.hi - self.lo)


def curve(r):
    """A function of t on [0, 1] with values in [0.05, 0.95]; fractions of the axes."""
    kind = r.choice(["swing", "decay", "hump", "step", "bend", "peak"])
    a, b, w, p, c = r.uniform(.15, .4), r.uniform(.45, .9), r.uniform(2, 9), r.uniform(0, 6), r.uniform(.25, .75)
    shape = {"swing": lambda t: .5 + .38 * np.sin(w * t + p) * np.exp(-1.2 * t * a),
             "decay": lambda t: a * .5 + (b - .1) * np.exp(-w * t * .7),
             "hump": lambda t: a * .6 + (b - a) * np.exp(-((t - c) / .18)**2),
             "step": lambda t: a * .5 + (b - a) / (1 + np.exp(-14 * (t - c))),
             "bend": lambda t: .1 + a + (b - .35) * (t - .2)**2 * 1.2 + .15 * t,
             "peak": lambda t: .2 + .55 * np.exp(-((t - c) / .05)**2) + .2 * a * np.sin(10 * t)}[kind]
    return lambda t: np.clip(shape(np.asarray(t, float)), .05, .95)


def places(r, d, s, taken):
    """Markers along the curve of a series that do not touch those of any series."""
    size = s["size"] + max([q["size"] for q in d["series"]], default=0) + 3
    apart = size / (np.array(d["size"]) * 54)  # the axes have about three quarters of the figure
    wanted, points = r.choice([6, 10, 16, 24]), []
    free = lambda q: all((np.abs(q - o) > apart).any() for o in points + taken)
    for _ in range(600):
        if len(points) == wanted:
            break
        t = r.uniform(.03, .97)
        q = np.array([t, float(s["f"](t)) + (r.gauss(0, .03) if s["drawn"] == "markers" else 0)])
        if .03 < q[1] < .97 and free(q):
            points.append(q)
    if len(points) >= 4 and r.random() < .15 and d["program"] == "matplotlib":  # one on the frame
        q = np.array([1.0 if r.random() < .5 else 0.0, r.uniform(.2, .8)])
        if free(q):
            points.append(q)
            s["clip"] = r.random() < .5
    return sorted(points, key=lambda q: q[0])


def design(seed):
    """All that is to be drawn; `r` goes on with what only one program has."""
    r = random.Random(f"independent-{seed}")
    d = {"r": r, "program": r.choice(["matplotlib"] * 6 + ["gnuplot"] * 3), "dpi": r.choice([150, 150, 200, 300, 300, 600]),
         "size": r.choice([(6.4, 4.8), (5, 4), (4, 3), (3.5, 2.6), (8, 5), (4.5, 4.5)]),
         "x": Axis(r, r.random() < .2), "y": Axis(r, r.random() < .25)}
    d["style"] = r.choice(STYLES) if d["program"] == "matplotlib" else "gnuplot"
    dark = d["style"] == "dark_background"
    palette = r.choice(PALETTES).split()
    d["legend"] = r.choice(["none", "none", "inside", "no frame", "outside"])
    d["exclude"] = d["legend"] in ("inside", "no frame") and r.random() < .4
    d["treatment"] = r.choice(["clean", "clean", "clean", "JPEG 60", "JPEG 60", "JPEG 80", "turned", "turned JPEG", "blurred",
                               "scan", "grey scan"])
    d["grid"] = r.choice(["none", "none", "major", "minor", "dashed", "dotted"])
    d["open"] = r.choice([False, False, False, True])
    d["note"], d["twin"], d["clicks"] = r.random() < .2, r.random() < .06, r.choice([2, 2, 3, 4])
    one_ink = r.random() < .15 or d["treatment"] == "grey scan"
    r.shuffle(palette)
    if dark:
        palette = [c for c in palette if sum(matplotlib.colors.to_rgb(c)) > .8] or ["#8dd3c7"]
    number = r.choice([1, 2, 3, 4])
    marks = list(NAMES if d["program"] == "matplotlib" else GNUPLOT)
    r.shuffle(marks)
    if one_ink:
        palette = ["#ffffff" if dark else "#000000"] * 3
        marks = r.choice([["o", "^", "x"], ["s", "x", "o"], ["D", "+", "v"], ["^", "o", "s"]])
    d["series"], taken = [], []
    for i in range(min(number, len(palette))):
        drawn = r.choice(["markers", "markers", "line", "both", "bars", "bars and line"])
        if one_ink and number > 1:
            drawn = "markers"
        s = {"name": f"s{i}", "drawn": drawn, "colour": palette[i], "mark": marks[i % len(marks)], "filled": r.random() < .55,
             "size": r.uniform(3.5, 9), "width": r.choice([.8, 1, 1.5, 2, 3]), "dash": r.choice(["-", "-", "--", ":", "-."]),
             "f": curve(r)}
        if drawn in ("both", "bars and line"):
            s["dash"] = r.choice(["-", "-", "-", "--"])
        if drawn != "line":
            s["points"] = places(r, d, s, taken)
            if len(s["points"]) < 4:  # no room left
                continue
            taken += s["points"]
        if s["mark"] in ("+", "asterisk") and drawn.startswith("bars"):  # would be one stroke
            s["drawn"] = "markers"
        if s["drawn"].startswith("bars"):
            even = r.random() > .3
            s["bars"] = [[e, e if even else r.uniform(.03, .1)] for e in (r.uniform(.03, .1) for _ in s["points"])]
            s["cap"] = r.choice([0, 2, 3, 5])
        d["series"].append(s)
    return d


def corners(s):
    """The markers, or the corners of a curve, in fractions of the axes."""
    t = np.linspace(.01, .99, 1500)
    return np.array(s["points"]) if "points" in s else np.column_stack([t, s["f"](t)])


def data(d, s):
    """Abscissae, ordinates and the ends of bars in data units."""
    p = corners(s)
    bars = np.array(s.get("bars", np.zeros((len(p), 2))))
    return (d["x"].value(p[:, 0]), d["y"].value(p[:, 1]), d["y"].value(p[:, 1] - bars[:, 0]),
            d["y"].value(p[:, 1] + bars[:, 1]))


def draw_series(ax, d, s):
    r, c, ls = d["r"], s["colour"], s["dash"]
    x, y, lo, hi = data(d, s)
    common = {"color": c, "label": "Series " + s["name"], "lw": s["width"]}
    if s["drawn"] == "line":
        ax.plot(x, y, ls=ls, **common)
        return
    filled = s["filled"] and s["mark"] not in STROKES
    marker = {"marker": s["mark"], "ms": s["size"], "mfc": c if filled else r.choice(["none", ax.get_facecolor()]),
              "mew": r.choice([.7, 1, 1.5]), "mec": c, "clip_on": s.get("clip", True)}
    if filled and s["drawn"] == "markers" and r.random() < .15:
        marker.update(mec="k" if d["style"] == "dark_background" else "w", mew=.5)
    if s["drawn"].startswith("bars"):
        ax.errorbar(x, y, yerr=[y - lo, hi - y], ls=ls if s["drawn"] == "bars and line" else "none", capsize=s["cap"],
                    elinewidth=r.choice([.6, 1, 1.5]), **marker, **common)
    else:
        ax.plot(x, y, ls=ls if s["drawn"] == "both" else "none", **marker, **common)


def draw_matplotlib(d, path):
    """Returns the place in pixels of fractions of the axes."""
    r = d["r"]
    text = {"font.family": r.choice(["DejaVu Sans", "DejaVu Serif", "STIXGeneral"]),
            "font.size": r.choice([7, 9, 11, 13])}
    with plt.style.context([d["style"], text]):
        way, minor, around = r.choice(["in", "out", "inout"]), r.random() < .4, r.random() < .3
        plt.rcParams.update({"axes.linewidth": r.choice([.5, .8, 1.2, 2]), "xtick.direction": way, "ytick.direction": way,
                             "xtick.minor.visible": minor, "ytick.minor.visible": minor, "xtick.top": around,
                             "ytick.right": around, "figure.autolayout": False})
        fig, ax = plt.subplots(figsize=d["size"], dpi=d["dpi"])
        for key in "xy":
            if d[key].log:
                getattr(ax, f"set_{key}scale")("log")
            getattr(ax, f"set_{key}lim")(d[key].lo, d[key].hi)
        if d["grid"] != "none":
            ax.grid(True, which="both" if d["grid"] == "minor" else "major",
                    ls={"dashed": "--", "dotted": ":"}.get(d["grid"], "-"),
                    color="0.3" if d["style"] == "dark_background" else r.choice(["0.85", "0.7", "0.8"]))
            ax.set_axisbelow(True)
        if d["open"]:
            ax.spines[["top", "right"]].set_visible(False)
        for s in d["series"]:
            draw_series(ax, d, s)
        if d["twin"]:
            t = np.linspace(.05, .95, 300)
            other = ax.twinx()
            other.plot(d["x"].value(t), 3 + np.cos(5 * t), color="#a0522d", lw=1)
            other.set_ylim(1, 6)
            other.grid(False)
        if d["note"]:
            used = np.concatenate([corners(s) for s in d["series"]])
            spots = [(r.uniform(.2, .75), r.uniform(.15, .9)) for _ in range(60)]
            spot = max(spots, key=lambda q: np.hypot(*(used - q).T).min())
            ax.text(*spot, r.choice(["Eq. (3)", "peak", "$U = 5.95$ m/s"]), transform=ax.transAxes, ha="center", fontsize=9)
        ax.set_xlabel(r.choice(["height z [m]", "r/R [-]", "$U_g$ (m/s)"]))
        ax.set_ylabel(r.choice(["solids holdup (-)", "$G_s$ [kg/m$^2$s]"]))
        if d["legend"] == "outside":
            ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1), fontsize=7)
        elif d["legend"] != "none":
            ax.legend(frameon=d["legend"] == "inside", loc=r.choice(["best", "best", "upper right", "lower left"]), fontsize=7)
        fig.tight_layout()
        fig.canvas.draw()
        if d["legend"] in ("inside", "no frame"):
            d["over"] = ax.get_legend().get_window_extent().transformed(ax.transAxes.inverted()).extents
        fig.savefig(path, dpi=d["dpi"])
        height, (left, bottom), (right, top) = fig.bbox.height, *ax.transAxes.transform([(0, 0), (1, 1)])
        plt.close(fig)
    return lambda fx, fy: (left + fx * (right - left), height - bottom - fy * (top - bottom))


def draw_gnuplot(d, path):
    """Returns the place in pixels of fractions of the axes."""
    r = d["r"]
    width, height = (int(q * d["dpi"]) for q in d["size"])
    scale = d["dpi"] / 96 * r.choice([.8, 1, 1.2])
    out = [f"set terminal pngcairo size {width},{height} font 'DejaVu Sans,{r.choice([8, 10, 12])}' fontscale {scale} "
           f"linewidth {scale} pointscale {scale}", f"set output '{path}'", "set xlabel 'height z [m]'; set ylabel 'holdup [-]'"]
    for key in "xy":
        out += [f"set logscale {key}"] * d[key].log
        out.append(f"set {key}range [{d[key].lo!r}:{d[key].hi!r}]; set format {key} '%g'")
    out += ["set border 3; set tics nomirror" if d["open"] else "set border 31", r.choice(["set tics in", "set tics out"]),
            r.choice(["set mxtics; set mytics", ""])]
    out.append({"none": "", "major": "set grid lt 1 lw .5 lc rgb '#cccccc'", "dashed": "set grid dt 2 lc rgb '#aaaaaa'",
                "minor": "set grid xtics ytics mxtics mytics lt 1 lc rgb '#dddddd'",
                "dotted": "set grid dt 3 lc rgb '#888888'"}[d["grid"]])
    out.append({"none": "unset key", "outside": "set key outside right", "inside": "set key above box",
                "no frame": "set key below"}[d["legend"]])  # nowhere over the data, as its place is not told
    plots, blocks = [], []
    for s in d["series"]:
        s["size"] = max(4.5, s["size"])
        points = f"pt {GNUPLOT.get(s['mark'], (7, 7))[s['filled']]} ps {s['size'] / 5.5:.2f}"
        if s["drawn"] != "line":
            s["dash"] = "-"
        how = {"line": f"lines lw {s['width']} dt {DASHES[s['dash']]}", "bars": f"yerrorbars {points} lw 1",
               "bars and line": f"yerrorlines {points} lw 1", "both": f"linespoints {points} lw {s['width']}",
               "markers": f"points {points} lw {r.choice([1, 1.5])}"}[s["drawn"]]
        plots.append(f"'-' with {how} lc rgb '{s['colour']}' title 'Series {s['name']}'")
        rows = np.column_stack(data(d, s)[:4 if s["drawn"].startswith("bars") else 2])
        blocks.append("\n".join(" ".join(repr(float(v)) for v in row) for row in rows) + "\ne")
    out += ["plot " + ", ".join(plots), *blocks, "print GPVAL_TERM_XMIN, GPVAL_TERM_XMAX, GPVAL_TERM_YMIN, GPVAL_TERM_YMAX"]
    run = subprocess.run(["gnuplot", "-"], input="\n".join(out) + "\n", capture_output=True, text=True, check=True)
    left, right, bottom, top = (float(v) for v in run.stderr.strip().split("\n")[-1].split())
    return lambda fx, fy: (left + fx * (right - left) + .5, height - bottom - fy * (top - bottom) - .5)


def treat(d, seed, path):
    """What scanners and journals do to a picture; returns the picture's path and the turn."""
    r, how, picture, angle = d["r"], d["treatment"], Image.open(path).convert("RGB"), 0.0
    if "turned" in how or "scan" in how:
        angle = r.uniform(-2, 2)
        picture = picture.rotate(angle, resample=Image.BICUBIC, fillcolor=picture.getpixel((1, 1)))
    if how == "blurred":
        picture = picture.filter(ImageFilter.GaussianBlur(r.uniform(.4, .9) * max(1, d["dpi"] / 200)))
    if "scan" in how:
        picture = picture.filter(ImageFilter.GaussianBlur(.7 * max(1, d["dpi"] / 250)))
        picture = picture.convert("L" if "grey" in how else "RGB")
        values = np.asarray(picture, float)
        values = values * .94 + 6 + np.random.default_rng(seed).normal(0, r.choice([3, 6]), values.shape)
        picture = Image.fromarray(np.clip(values, 0, 255).astype(np.uint8)).convert("RGB")
    if "JPEG" in how or ("scan" in how and r.random() < .5):
        path.unlink()
        path = path.with_suffix(".jpg")
        picture.save(path, quality=80 if "80" in how or "scan" in how else 60)
    else:
        picture.save(path)
    return path, math.radians(angle), np.array(picture.size) / 2


def by_eye(d, s):
    """The colour of a series as a user picks it from the picture."""
    rgb = np.array(matplotlib.colors.to_rgb(s["colour"])) * 255
    rgb = rgb * .94 + 6 if "scan" in d["treatment"] else rgb
    off = d["r"].choice([10, 20])
    return "#%02x%02x%02x" % tuple(min(255, max(0, round(float(v)) + d["r"].randint(-off, off))) for v in rgb)


def asked(d, s, size, shared):
    """For each series of the figure file that a drawn one gives: its lines, and the truth for measure.compare."""
    r = d["r"]
    kinds = {"line": ["line"], "both": ["markers", "line"], "bars and line": ["markers", "line"]}.get(s["drawn"], ["markers"])
    if len(kinds) == 2 and r.random() < .4:
        kinds = [r.choice(kinds)]
    for kind in kinds:
        toml = ["[[series]]", f'name = "{s["name"]}_{kind}"', f'kind = "{kind}"', f'colour = "{by_eye(d, s)}"']
        if kind == "markers" and NAMES.get(s["mark"]) and (shared or r.random() < .15):
            fill = ("filled " if s["filled"] else "open ") if shared and s["mark"] not in STROKES else ""
            toml.append(f'shape = "{fill}{NAMES[s["mark"]]}"')
        truth = {"name": f"{s['name']}_{kind}", "kind": kind, "drawn": s["drawn"], "size": size, "points": s.get("points"),
                 "shape": ("" if s["filled"] else "open ") + s["mark"]}
        if "over" in d:
            truth["hidden"] = [[*(d["over"][:2] - size), *(d["over"][2:] + size)]]
        if "bars" in s:
            truth["errors"] = s["bars"]
        if kind == "line":
            p = corners(s)
            along = np.r_[0, np.cumsum(np.hypot(*np.diff(p, axis=0).T))]
            at = np.unique(np.r_[along, np.linspace(0, along[-1], 400)])
            truth["curve"] = np.column_stack([np.interp(at, along, p[:, k]) for k in (0, 1)])
        yield toml, truth


def make(seed, folder):
    """Draws the plot of a seed, writes its figure file, returns the truth as measure.compare wants it."""
    d = design(seed)
    r, path = d["r"], Path(folder) / f"unseen_{seed}.png"
    place = (draw_matplotlib if d["program"] == "matplotlib" else draw_gnuplot)(d, path)
    path, turn, centre = treat(d, seed, path)
    back = np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])
    seen = lambda fx, fy: back @ (np.array(place(fx, fy)) - centre) + centre
    toml = [f'image = "{path.name}"']
    if d["exclude"] and "over" in d:
        a, b = seen(d["over"][0], d["over"][3]), seen(d["over"][2], d["over"][1])
        toml.append(f"exclude = [{[round(float(v)) for v in (*(a - 3), *(b - a + 6))]}]")
    for key in "xy":
        clicks = []
        for t in np.linspace(*((0, 1) if r.random() < .6 else (.1, .9)), d["clicks"]):
            at = [round(float(v) + r.uniform(-.7, .7)) for v in (seen(t, 0) if key == "x" else seen(0, t))]
            clicks.append(f"{{ pixel = {at}, value = {float(d[key].value(t))!r} }}")
        toml += [f"[axes.{key}]", f'name = "{key}"', f'scale = "{"log" if d[key].log else "linear"}"',
                 f"points = [{', '.join(clicks)}]"]
    truth = {"name": path.stem, "toml": str(path.with_suffix(".toml")), "style": d["style"], "treatment": d["treatment"],
             "series": [], **{key: [d[key].lo, d[key].hi, d[key].log] for key in "xy"}}
    span = np.hypot(*np.column_stack([seen(1, 0) - seen(0, 0), seen(0, 1) - seen(0, 0)]))
    shared = len({s["colour"] for s in d["series"]}) < len(d["series"])
    for s in d["series"]:
        for lines, one in asked(d, s, s["size"] / 72 * d["dpi"] / span, shared):
            toml += lines
            truth["series"].append(one)
    Path(truth["toml"]).write_text("\n".join(toml) + "\n")
    return truth
