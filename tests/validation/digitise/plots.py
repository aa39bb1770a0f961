# SPDX-License-Identifier: BSD-3-Clause
"""Plots of known data, drawn by matplotlib and gnuplot from a seed, with the file that digitises them.

make(seed, family, folder) writes <name>.png or .jpg and <name>.toml and returns the truth: axes,
and for each series its points (markers) or its dense curve (line), in data units.
Family "tuned" was looked at while the digitiser was written; "held_out" (other palettes, styles,
fonts, marker edges, grounds, no frames, insets) was only measured.
"""
import json
import math
import random
import subprocess
from pathlib import Path

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

SHAPES = {"o": "circle", "s": "square", "^": "triangle", "v": "triangle_down", "D": "diamond",
          "x": "x", "+": "plus"}
# gnuplot's point types of pngcairo: (open, filled)
GNUPLOT = {"plus": (1, 1), "x": (2, 2), "square": (4, 5), "circle": (6, 7), "triangle": (8, 9),
           "triangle_down": (10, 11), "diamond": (12, 13)}


class Axis:
    def __init__(self, rng, log):
        self.log = log
        if log:
            low = rng.choice([-3, -2, -1, 0])
            self.lo, self.hi = 10.0**low, 10.0**(low + rng.choice([2, 3, 4]))
        else:
            self.lo = rng.choice([0.0, 0.0, -1.0, 10.0, -50.0])
            self.hi = self.lo + rng.choice([0.14, 1.0, 1.5, 7.0, 100.0])

    def value(self, t):
        """Value at the fraction t of the axis."""
        t = np.asarray(t, float)
        if self.log:
            return 10**(math.log10(self.lo) + t * (math.log10(self.hi) - math.log10(self.lo)))
        return self.lo + t * (self.hi - self.lo)

    def fraction(self, v):
        v = np.asarray(v, float)
        if self.log:
            return np.log(v / self.lo) / math.log(self.hi / self.lo)
        return (v - self.lo) / (self.hi - self.lo)


def curve(rng, kind):
    """A smooth function of t on [0, 1] with values in about [0.08, 0.92]."""
    a, b, c = rng.uniform(0.2, 0.8), rng.uniform(-0.3, 0.3), rng.uniform(0.5, 2.5)
    p = rng.uniform(0, 6.28)
    if kind == "wave":
        f = lambda t: a + 0.25 * np.sin(6.28 * c * t + p) + b * (t - 0.5)
    elif kind == "decay":
        f = lambda t: 0.1 + 0.75 * np.exp(-t * rng_k) + 0.05 * b * t
        rng_k = rng.uniform(1, 6)
    else:
        f = lambda t: a + b * (t - 0.5) * 2 + 0.4 * b * (t - 0.5)**2
    return lambda t: np.clip(f(np.asarray(t, float)), 0.06, 0.94)


def spread_points(rng, n, f, apart, taken):
    """Points near f(t), none closer than `apart` (fractions, an array of two) to one another."""
    points = []
    for _ in range(400):
        if len(points) == n:
            break
        t = rng.uniform(0.04, 0.96)
        q = np.array([t, float(f(t)) + rng.gauss(0, 0.02)])
        if not 0.04 < q[1] < 0.96:
            continue
        if all(np.any(np.abs(q - o) > apart) for o in points + taken):
            points.append(q)
    return sorted(points, key=lambda q: q[0])


def design(seed, family):
    """What is to be drawn: all choices, independent of the program that draws."""
    rng = random.Random(f"{family} {seed}")
    held = family == "held_out"
    d = {"seed": seed, "rng": rng, "held": held}
    d["program"] = rng.choice(["matplotlib", "matplotlib", "gnuplot"])
    d["dpi"] = rng.choice([150, 150, 200, 300, 600])
    d["size"] = rng.choice([(6.4, 4.8), (5, 4), (4, 3.5), (3.4, 2.8), (7, 4)])  # inch
    d["x"], d["y"] = Axis(rng, rng.random() < 0.25), Axis(rng, rng.random() < 0.3)
    d["frame"] = rng.choice(["box", "box", "box", "left_bottom"] + (["none"] if held else []))
    d["grid"] = rng.choice([None, None, "solid", "dashed", "dotted"])
    d["legend"] = rng.random() < 0.6
    d["jpeg"] = rng.choice([None, None, 60, 75])
    d["rotation"] = rng.choice([0, 0, 0, 2.0, -2.0, rng.uniform(-2, 2)])
    d["rounded"] = rng.random() < 0.5
    palettes = [["#1f77b4", "#ff7f0e", "#2ca02c", "#d62728", "#9467bd", "#8c564b", "#e377c2"],
                ["#ff0000", "#0000ff", "#008000", "#000000"],
                ["#9400d3", "#009e73", "#56b4e9", "#e69f00", "#0072b2", "#e51e10"]]
    if held:
        palettes = [["#440154", "#3b528b", "#21918c", "#5ec962"], ["#e41a1c", "#377eb8", "#4daf4a"],
                    ["#004488", "#ddaa33", "#bb5566"], ["#c03030", "#303080", "#108040", "#808080"],
                    ["#000000", "#cc0000"]]
    palette = rng.choice(palettes)
    rng.shuffle(palette)
    black_and_white = rng.random() < 0.2
    n = rng.choice([1, 2, 2, 3]) if not black_and_white else rng.choice([1, 2, 3])
    shapes = list(SHAPES)
    rng.shuffle(shapes)
    if black_and_white:  # no two that differ in nothing but the fill or a turn
        shapes = ["o", "^", "s"] if rng.random() < 0.5 else ["D", "x", "o"]
    d["series"] = []
    taken = []
    size = rng.uniform(5, 9)  # pt
    apart = 1.5 * size / 72 / (0.72 * np.array(d["size"]))
    for i in range(min(n, len(palette))):
        kinds = ["markers", "line", "both", "errorbars"]
        kind = rng.choice(kinds if not black_and_white else ["markers"])
        f = curve(rng, rng.choice(["wave", "decay", "bend"]))
        s = {"name": f"s{i}", "kind": kind, "colour": "#000000" if black_and_white else palette[i],
             "shape": shapes[i % len(shapes)], "filled": rng.random() < 0.6, "size": size,
             "width": rng.choice([0.8, 1.0, 1.5, 2.5]), "dash": "solid", "f": f}
        if kind == "line":
            s["dash"] = rng.choice(["solid", "solid", "dashed", "dotted", "dashdot"])
        if kind != "line":
            s["points"] = spread_points(rng, rng.choice([8, 15, 25]), f, apart, taken)
            if len(s["points"]) < 5:  # no room left
                continue
            taken += s["points"]
            if kind == "both":
                s["filled"] = s["filled"] or s["shape"] not in "x+"
        if kind == "errorbars":
            s["errors"] = [rng.uniform(0.03, 0.08) for _ in s["points"]]
            s["caps"] = rng.choice([0, 3])
        d["series"].append(s)
    return d


def draw_matplotlib(d, path):
    rng, held = d["rng"], d["held"]
    style = {"font.family": rng.choice(["DejaVu Sans", "DejaVu Serif"]) if held else "DejaVu Sans",
             "font.size": rng.choice([8, 10, 12]), "xtick.direction": rng.choice(["in", "out"]),
             "ytick.direction": rng.choice(["in", "out"]), "axes.linewidth": rng.choice([0.5, 0.8, 1.5])}
    if held:
        style["xtick.minor.visible"] = style["ytick.minor.visible"] = rng.random() < 0.4
        style["xtick.top"] = style["ytick.right"] = rng.random() < 0.4
    with plt.rc_context(style):
        fig, ax = plt.subplots(figsize=d["size"], dpi=d["dpi"])
        if held and rng.random() < 0.25:
            ax.set_facecolor(rng.choice(["#eaeaf2", "#f5f5dc", "#e5e5e5"]))
        for key in "xy":
            axis = d[key]
            if axis.log:
                getattr(ax, f"set_{key}scale")("log")
            getattr(ax, f"set_{key}lim")(axis.lo, axis.hi)
        if d["grid"]:
            ax.grid(True, linestyle={"solid": "-", "dashed": "--", "dotted": ":"}[d["grid"]],
                    color=rng.choice(["#b0b0b0", "#cccccc"]))
            ax.set_axisbelow(True)
        if d["frame"] != "box":
            for side in ("top", "right") + (("left", "bottom") if d["frame"] == "none" else ()):
                ax.spines[side].set_visible(False)
        for s in d["series"]:
            common = {"color": s["colour"], "label": s["name"]}
            face = s["colour"] if s["filled"] else rng.choice(["none", "white"])
            edge = {"mfc": face, "ms": s["size"]}
            if held and s["filled"] and s["shape"] not in "x+" and rng.random() < 0.3:
                edge.update(mec="black", mew=0.7)
            if s["kind"] == "line":
                t = np.linspace(0.02, 0.98, 800)
                ax.plot(d["x"].value(t), d["y"].value(s["f"](t)), lw=s["width"],
                        ls={"solid": "-", "dashed": "--", "dotted": ":", "dashdot": "-."}[s["dash"]], **common)
                continue
            p = np.array(s["points"])
            x, y = d["x"].value(p[:, 0]), d["y"].value(p[:, 1])
            if s["kind"] == "markers" and s["filled"] and rng.random() < 0.3:
                s["size"] = float(math.sqrt(s["size"]**2))
                ax.scatter(x, y, s=s["size"]**2, marker=s["shape"], **common)
            elif s["kind"] == "errorbars":
                e = np.array(s["errors"])
                lo, hi = d["y"].value(p[:, 1] - e), d["y"].value(p[:, 1] + e)
                ax.errorbar(x, y, yerr=[y - lo, hi - y], fmt=s["shape"], capsize=s["caps"],
                            elinewidth=rng.choice([0.8, 1.2]), **edge, **common)
            else:
                ax.plot(x, y, marker=s["shape"], ls="-" if s["kind"] == "both" else "none",
                        lw=s["width"], **edge, **common)
        ax.set_xlabel("abscissa (m)")
        ax.set_ylabel("ordinate [-]")
        if rng.random() < 0.4:
            ax.set_title("A title of the figure")
        with_inset = held and rng.random() < 0.25
        if d["legend"]:
            where = "best" if not held else rng.choice(["best", "upper center"])
            ax.legend(frameon=rng.random() < 0.6, loc="lower left" if with_inset else where)
        if with_inset:
            inset = ax.inset_axes([0.62, 0.6, 0.33, 0.33])
            t = np.linspace(0, 1, 100)
            inset.plot(t, np.sin(5 * t), color=d["series"][0]["colour"])
            d["inset"] = [0.62, 0.6, 0.33, 0.33]
        fig.tight_layout()
        fig.canvas.draw()
        d["over"] = [over.get_window_extent().transformed(ax.transAxes.inverted()).extents
                     for over in [ax.get_legend()] * d["legend"] + ([inset] if "inset" in d else [])]
        fig.savefig(path, dpi=d["dpi"])
        height = fig.bbox.height
        pixel = lambda fx, fy: [float(q) if i == 0 else float(height - q) for i, q in
                                enumerate(ax.transAxes.transform((fx, fy)))]
        plt.close(fig)
    return pixel


def draw_gnuplot(d, path):
    rng = d["rng"]
    width, height = (int(q * d["dpi"]) for q in d["size"])
    scale = d["dpi"] / 72.0
    out = [f"set terminal pngcairo size {width},{height} font 'DejaVu Sans,{rng.choice([8, 10])}' fontscale {scale*0.75:.3f} "
           f"linewidth {scale*0.75:.3f} pointscale {scale*0.75:.3f}" + rng.choice([" dashed", ""]),
           f"set output '{path}'", "set xlabel 'abscissa (m)'; set ylabel 'ordinate [-]'"]
    for key in "xy":
        axis = d[key]
        if axis.log:
            out.append(f"set logscale {key}; set format {key} '10^{{%T}}'")
        out.append(f"set {key}range [{axis.lo!r}:{axis.hi!r}]")
    out.append({"box": "set border 31", "left_bottom": "set border 3; set tics nomirror",
                "none": "set border 0; set tics nomirror"}[d["frame"]])
    if d["grid"]:
        out.append("set grid" + {"solid": " lt 1 lc rgb '#c0c0c0'", "dashed": " dt 2 lc rgb '#b0b0b0'", "dotted": ""}[d["grid"]])
    if d["legend"]:
        out.append("set key " + rng.choice(["top right", "top left", "bottom right"]) + rng.choice(["", " box"]))
    else:
        out.append("unset key")
    plots, blocks = [], []
    for s in d["series"]:
        colour = f"lc rgb '{s['colour']}'"
        pt = GNUPLOT[SHAPES[s["shape"]]][1 if s["filled"] else 0]
        if s["kind"] == "line":
            t = np.linspace(0.02, 0.98, 800)
            rows = zip(d["x"].value(t), d["y"].value(s["f"](t)))
            dash = {"solid": 1, "dashed": 2, "dotted": 3, "dashdot": 4}[s["dash"]]
            how = f"with lines lw {s['width']} dt {dash} {colour}"
        else:
            p = np.array(s["points"])
            rows = list(zip(d["x"].value(p[:, 0]), d["y"].value(p[:, 1])))
            mark = f"pt {pt} ps {s['size'] / 5.0:.2f}"
            if s["kind"] == "errorbars":
                e = np.array(s["errors"])
                rows = [r + (lo, hi) for r, lo, hi in zip(rows, d["y"].value(p[:, 1] - e), d["y"].value(p[:, 1] + e))]
                how = f"with yerrorbars {mark} lw 1 {colour}"
            elif s["kind"] == "both":
                how = f"with linespoints {mark} lw {s['width']} {colour}"
            else:
                how = f"with points {mark} lw 1 {colour}"
        plots.append(f"'-' {how} title '{s['name']}'")
        blocks.append("\n".join(" ".join(repr(float(v)) for v in row) for row in rows) + "\ne")
    out.append("plot " + ", ".join(plots))
    out += blocks
    out.append("print GPVAL_TERM_XMIN, GPVAL_TERM_XMAX, GPVAL_TERM_YMIN, GPVAL_TERM_YMAX, GPVAL_TERM_XSIZE, GPVAL_TERM_YSIZE")
    run = subprocess.run(["gnuplot", "-"], input="\n".join(out) + "\n", capture_output=True, text=True, check=True)
    left, right, bottom, top, xs, ys = (float(q) for q in run.stderr.strip().split("\n")[-1].split())
    d["gnuplot"] = (left, right, bottom, top, xs, ys, width, height)
    pixel = lambda fx, fy: [(left + fx * (right - left)) + 0.5, height - (bottom + fy * (top - bottom)) - 0.5]
    return pixel


def make(seed, family, folder):
    d = design(seed, family)
    rng = d["rng"]
    folder = Path(folder)
    name = f"{family}_{seed}"
    png = folder / f"{name}.png"
    pixel = (draw_gnuplot if d["program"] == "gnuplot" else draw_matplotlib)(d, png)
    picture = Image.open(png)
    if picture.mode != "RGB" and not d["jpeg"] and not d["rotation"]:
        pass
    else:
        picture = picture.convert("RGB")
    turn = math.radians(d["rotation"])
    centre = np.array(picture.size) / 2.0
    if d["rotation"]:
        picture = picture.rotate(d["rotation"], resample=Image.BICUBIC, fillcolor=(255, 255, 255))

    def seen(fx, fy):
        q = np.array(pixel(fx, fy)) - centre
        c, s = math.cos(turn), math.sin(turn)
        q = np.array([c * q[0] + s * q[1], -s * q[0] + c * q[1]]) + centre
        return [round(float(v), 0 if d["rounded"] else 2) for v in q]

    if d["jpeg"]:
        png.unlink()
        image = folder / f"{name}.jpg"
        picture.save(image, quality=d["jpeg"])
    else:
        image = png
        picture.save(image)
    n_points = rng.choice([2, 2, 3])
    toml = [f'image = "{image.name}"']
    if rng.random() < 0.3 and abs(d["rotation"]) < 0.01:
        l, t = pixel(0, 1)
        r, b = pixel(1, 0)
        toml.append(f"plot_area = [{round(l)}, {round(t)}, {round(r - l)}, {round(b - t)}]")
    for key in "xy":
        axis = d[key]
        points = []
        for k in range(n_points):
            t = k / (n_points - 1)
            at = seen(t, 0) if key == "x" else seen(0, t)
            points.append(f"{{ pixel = [{at[0]}, {at[1]}], value = {float(axis.value(t))!r} }}")
        toml += [f"[axes.{key}]", f'name = "{key}"', 'unit = "-"',
                 f'scale = "{"log" if axis.log else "linear"}"', f"points = [{', '.join(points)}]"]
    truth = {"name": name, "image": str(image), "toml": str(folder / f"{name}.toml"), "series": []}
    for key in "xy":
        truth[key] = [d[key].lo, d[key].hi, d[key].log]
    corner = [np.array(pixel(*q)) for q in ((0, 0), (1, 0), (0, 1))]
    truth["span_px"] = [float(np.hypot(*(corner[1] - corner[0]))), float(np.hypot(*(corner[2] - corner[0])))]
    same = len({s["colour"] for s in d["series"]}) < len(d["series"])
    for s in d["series"]:
        kinds = {"markers": ["markers"], "errorbars": ["markers"], "line": ["line"], "both": ["markers", "line"]}
        for kind in kinds[s["kind"]]:
            label = f"{s['name']}_{kind}"
            toml += ["[[series]]", f'name = "{label}"', f'kind = "{kind}"', f'colour = "{s["colour"]}"']
            if kind == "markers" and (same or SHAPES[s["shape"]] == "triangle" or rng.random() < 0.5):
                toml.append(f'shape = "{SHAPES[s["shape"]]}"')
            entry = {"name": label, "kind": kind, "drawn": s["kind"], "shape": SHAPES[s["shape"]],
                     "filled": s["filled"], "dash": s["dash"]}
            pad = 1.2 * s["size"] / 72 * d["dpi"] / min(truth["span_px"])
            hidden = [[b[0] - pad, b[1] - pad, b[2] + pad, b[3] + pad] for b in d.get("over", [])]
            entry["hidden"] = [[float(v) for v in b] for b in hidden]
            if kind == "markers":
                entry["points"] = [[float(v) for v in q] for q in s["points"]]  # fractions of the axes
                entry["size"] = [s["size"] / 72 * d["dpi"] / truth["span_px"][0], s["size"] / 72 * d["dpi"] / truth["span_px"][1]]
                if "errors" in s:
                    entry["errors"] = s["errors"]
            elif s["kind"] == "both":
                entry["curve"] = [[float(v) for v in q] for q in s["points"]]
            else:
                t = np.linspace(0.02, 0.98, 800)
                entry["curve"] = np.column_stack([t, s["f"](t)]).tolist()
            truth["series"].append(entry)
    truth["design"] = {k: d[k] for k in ("program", "dpi", "frame", "grid", "legend", "jpeg", "rotation", "rounded")}
    if "gnuplot" in d:
        truth["design"]["gnuplot"] = d["gnuplot"]
    Path(truth["toml"]).write_text("\n".join(toml) + "\n")
    (folder / f"{name}.json").write_text(json.dumps(truth))
    return truth


if __name__ == "__main__":
    import sys
    Path(sys.argv[3]).mkdir(parents=True, exist_ok=True)
    first, last = (int(q) for q in sys.argv[2].split("-"))
    for number in range(first, last + 1):
        print(make(number, sys.argv[1], sys.argv[3])["design"])
