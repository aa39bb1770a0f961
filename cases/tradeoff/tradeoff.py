#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Speed against accuracy of a simulation: runs the choices, and draws the error of each product against the cost.

    BEDSCOPE=build/release/app/bedscope BEDSCOPE_COUPLED=build/release/cases/coupled/bedscope-coupled \\
        cases/tradeoff/tradeoff.py cases/tradeoff/*.toml --work FOLDER --kept data/runs/tradeoff \\
        --figures docs/images/tradeoff_simulation

Each scene is a choice, SUBJECT_VALUE.toml. They are made, run one after the other in the order given (--jobs N: N at a time),
reduced to --kept, and their folders in --work removed. What is done is not done again, what was interrupted goes on. Errors
are against the finest run: that with the smallest particles, of these the most cells, the smallest steps. --draw runs
nothing and draws from --kept. On a busy machine --costs SECONDS measures costs anew at the end, by short runs.
Needs gnuplot, and a python with scipy.
"""
import argparse
import concurrent.futures
import csv
import math
import pathlib
import sys

import charts
import errors
import runs
from law import Law


def run_all(asked):
    asked.work.mkdir(parents=True, exist_ok=True)
    asked.kept.mkdir(parents=True, exist_ok=True)
    at = {scene.stem: scene for scene in asked.scenes}
    present = at.get(asked.present)
    if present is None:
        sys.exit(f"tradeoff.py: expected the present choice {asked.present} among the scenes, found {' '.join(at)}")
    try:
        cell = runs.cell_of(present, asked.work)
    except runs.Failed as error:
        sys.exit(f"{present}: {error}")

    def one(scene):
        try:
            runs.done(scene, asked.work, asked.kept, cell, asked.block)
            print(f"{scene.stem}: done", flush=True)
            return False
        except runs.Failed as error:
            print(f"{scene.stem}: {error}", file=sys.stderr, flush=True)
            return True

    with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
        failed = any(list(pool.map(one, asked.scenes)))
    if asked.costs:
        try:
            runs.measure_costs(asked.scenes, asked.work, asked.kept, asked.costs)
        except runs.Failed as error:
            print(f"--costs {asked.costs:g}: {error}", file=sys.stderr)
            failed = True
    runs.keep_costs(asked.work, asked.kept)
    return failed


def judged(choices, finest, present, tolerance):
    """For each product a dict as charts.draw wants it, with its sentence."""
    found = []
    for product in runs.PRODUCTS:
        reference = finest.products[product]
        if reference is None:  # page() says so
            continue
        # The mean velocity of clusters may be about zero.
        scale = finest.scene["gas"]["velocity"] if product == "cluster velocity" else None
        rows = [dict(subject=charts.PRESENT if c is present else c.subject, text=c.value or c.subject, choice=c, cost=c.per_second,
                     error=errors.error(c.products[product], reference, scale)) for c in choices if c is not finest]
        front = errors.front([(r["cost"], r["error"].shown, r["choice"].name) for r in rows])
        for r in rows:
            r["front"] = r["choice"].name in front
        found.append(dict(title=product, rows=rows, finest=finest.per_second, line=errors.interval(reference, scale),
                          sentence=sentence(product, rows, finest, tolerance)))
    return found


def in_percent(product):
    return dict(product, line=100 * product["line"], rows=[dict(r, error=r["error"] * 100) for r in product["rows"]])


def sentence(product, rows, finest, tolerance):
    def cheaper(cost):
        return f"{finest.per_second / cost:.2g} times cheaper than {finest.name.replace('_', ' ')}"
    text = f"{product[0].upper()}{product[1:]}:"
    for r in rows:
        if r["subject"] == charts.PRESENT:
            text += f" the present choice is {cheaper(r['cost'])} and off by {r['error']};"
    good = [r for r in rows if r["error"].high <= tolerance]
    if good:
        best = min(good, key=lambda r: r["cost"])
        text += f" the cheapest within {errors.percent(tolerance)} is {best['choice'].name.replace('_', ' ')}, {cheaper(best['cost'])}."
    else:
        best = min(rows, key=lambda r: r["error"].high if r["error"].known else math.inf)
        text += f" of none it is known that it lies within {errors.percent(tolerance)}; nearest is " \
                f"{best['choice'].name.replace('_', ' ')}, {best['error']}."
    return text


def page(asked, choices, costs, products, law, check, finest):
    """README.md beside what is kept: all that came out."""
    lines = ["# Speed against accuracy: what came out", "",
             "Written by `cases/tradeoff/tradeoff.py`; what is meant by it is in docs/tradeoff_simulation.md.", ""]
    lines += [p["sentence"] + "  " for p in products]
    if len(choices) < 2:
        lines.append("Errors need two runs that are done at least.")
    else:
        lines += [f"{p[0].upper()}{p[1:]}: {finest.name} has none.  " for p in runs.PRODUCTS if finest.products[p] is None]
    for c in choices:
        change, half = errors.drift(c.products["solids flux"])
        if abs(change) > half:
            lines.append(f"{c.name}: its solids flux changes by {100 * change:.2g} ± {100 * half:.2g} % over the window: is it still "
                         "starting up?  ")
    lines.append("")
    lines += ["| choice | particles | cells | DEM steps a gas step | gas step [s] | run [s] | averaged [s] | CPU a gas step [ms] | "
              "particle-steps [million per s] | cell-steps [million per s] | core-s per s | clusters seen |",
              "|---" * 12 + "|"]
    done = {c.name: c for c in choices}
    for c in sorted(costs, key=lambda c: c.per_second):
        d = done.get(c.name)
        lines.append(f"| {c.name} | {c.particles} | {c.cells} | {c.dem_steps:g} | {c.scene['numerics']['gas_step']:g} | "
                     f"{c.reached:.3g}{'' if d else ', not judged'} | {f'{d.averaged:g}' if d else ''} | {c.ms_per_step:.3g} | "
                     f"{c.particles * c.dem_steps * c.steps / c.reached / 1e6:.3g} | {c.cells * c.steps / c.reached / 1e6:.3g} | "
                     f"{c.per_second:.3g} | {f'{d.clusters:.0f}' if d else ''} |")
    if products:
        lines += ["", f"Relative error against {finest.name}, with its 95 % interval; \"less than\" where it is not told from noise. "
                  "In brackets the noise: what two runs of these lengths would differ by, were there no error.", "",
                  "| choice | " + " | ".join(p["title"] for p in products) + " |", "|---|" + "---|" * len(products)]
        for n, row in enumerate(products[0]["rows"]):
            cells = [p["rows"][n]["error"] for p in products]
            lines.append(f"| {row['choice'].name} | " + " | ".join(
                f"{e}" if not e.known else f"{e} [{errors.percent(e.noise)}]" for e in cells) + " |")
        lines.append("| the finest itself, 95 % interval | " + " | ".join(errors.percent(p["line"]) for p in products) + " |")
    if law:
        alone = sum(c.alone for c in costs)
        lines += ["", f"CPU time of a gas step, {len(costs)} runs ({alone} measured by themselves): {law}; 95 % intervals, scatter of the runs {errors.percent(law.scatter)}."]
        if check:
            run, other = check
            value, half = other.predict(run.particles, run.dem_steps, run.cells)
            lines.append(f"The law without {run.name} says {value:.3g} ± {half:.2g} ms for it; measured are {run.ms_per_step:.3g} ms.")
    text = "\n".join(lines) + "\n"
    (asked.kept / "README.md").write_text(text)
    print(text)


def write(products, name):
    with open(f"{name}.csv", "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["product", "choice", "core-seconds per second", "error [-]", "low [-]", "high [-]", "noise [-]", "on front"])
        for p in products:
            for r in p["rows"]:
                e = r["error"]
                out.writerow([p["title"], r["choice"].name, f"{r['cost']:.4g}",
                              *(f"{v:.4g}" for v in (e.value, e.low, e.high, e.noise)), int(r["front"])])


def report(asked):
    choices, costs = runs.load(asked.kept)
    if not costs:
        sys.exit(f"tradeoff.py: {asked.kept}: expected runs, found none")
    finest = min(choices, key=runs.Cost.fineness, default=None)
    present = next((c for c in choices if c.name == asked.present), None)
    products = []
    if len(choices) > 1:
        products = judged(choices, finest, present, asked.tolerance)
    if products:
        subjects = dict.fromkeys(c.subject for c in choices if c not in (finest, present))
        charts.draw([in_percent(p) for p in products], list(subjects), str(asked.figures))
        write(products, asked.figures)
    law = check = None
    if len(costs) > 2:
        law = Law(costs)
        out = next((c for c in costs if c.name == asked.check), min(costs, key=runs.Cost.fineness))
        check = (out, Law([c for c in costs if c is not out]))
        charts.draw_law(costs, law, check, f"{asked.figures}_cost")
    page(asked, choices, costs, products, law, check, finest)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", type=pathlib.Path, nargs="*")
    parser.add_argument("--work", type=pathlib.Path)
    parser.add_argument("--kept", type=pathlib.Path, required=True)
    parser.add_argument("--figures", type=pathlib.Path, required=True)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--block", type=float, default=1.0, help="[s], longer than the memory of the bed; 1")
    parser.add_argument("--present", default="scene", help="the present choice; scene")
    parser.add_argument("--tolerance", type=float, default=0.1, help="of the sentences; 0.1")
    parser.add_argument("--check", help="the run that the law of cost is checked on; the finest")
    parser.add_argument("--costs", type=float, metavar="SECONDS",
                        help="at the end, measure costs by runs of this length from the start, in turn; let nothing run beside them")
    parser.add_argument("--draw", action="store_true")
    asked = parser.parse_args()
    if not asked.draw and not (asked.scenes and asked.work):
        parser.error("scenes and --work, or --draw")
    failed = not asked.draw and run_all(asked)
    report(asked)
    sys.exit(2 if failed else 0)


if __name__ == "__main__":
    main()
