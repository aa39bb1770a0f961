# SPDX-License-Identifier: BSD-3-Clause
"""A lifting bed whose spheres leave at the top and are put back below: run to 0.04 s with a checkpoint at 0.02 s,
and run to 0.02 s and resumed; on one rank and on two.

Expected: the same to the bit: fields, dumps, history, state.
"""
from deck import Case
from fluidised_bed import SPACING, loose_bed

TITLE = "A resumed run equals the one that went on"
SIZE = (6 * SPACING, 6 * SPACING, 0.03)
LIFT = f"""inventory {{ policy constant; outlet {{ point (0 0 0.02); normal (0 0 1); }}
entry {{ min (0 0 0.001); max ({SIZE[0]} {SIZE[1]} 0.02); }} every 2; }}
output {{ checkpoint 0.02; }}"""


def case(at, end):
    spheres = [s + (0, 0, 0.2) for s in loose_bed(6, 6, 8)]
    return Case(at, SIZE, (3, 3, 15), velocity=3.0, dt=2e-4, dem_steps=20, end=end, spheres=spheres, extra=LIFT,
                dump_every=1000, write_interval=0.02, margin=0.01, tolerance=1e-8).write()


def go_on(case, end, ranks):
    control = case.folder / "CFD/system/controlDict"
    control.write_text(control.read_text().replace(f"endTime {case.end};", f"endTime {end};"))
    case.run("--resume", ranks=ranks, decompose=False)


def contents(case):
    """All that the run wrote after t = 0.02 s, but its costs."""
    return {str(p.relative_to(case.folder)): p.read_bytes() for p in sorted(case.folder.rglob("*"))
            if p.is_file() and (p.parent.name == "0.04" or p.name in ("dump3000.liggghts", "dump4000.liggghts",
                                                                     "history.csv") or p.name.startswith("gas."))}


def verify(study):
    for ranks in (1, 2):
        suffix = f", {ranks} rank" + "s" * (ranks - 1)
        whole, cut = case(study.folder / f"whole_{ranks}", 0.04), case(study.folder / f"resumed_{ranks}", 0.02)
        whole.run(ranks=ranks)
        cut.run(ranks=ranks)
        go_on(cut, 0.04, ranks)
        for name, one in (("whole", whole), ("resumed", cut)):
            study.run(name + suffix, one, (0.04, 0.04), (3, 15),
                      **({"decomposition": "processors"} if ranks > 1 else {}))
        for quantity in ("axial holdup", "axial velocity", "axial gas velocity", "axial pressure"):
            study.check("resumed" + suffix, quantity, "run:whole" + suffix, "max error", 0.0, "To the bit.")
        one, other = contents(whole), contents(cut)
        assert len(one) > 6 * ranks and list(one) == list(other), (list(one), list(other))
        assert whole.record()["inventory"]["left"] > 10, "nobody left: the policy was not at work"
        study.series("files" + suffix, files_that_differ=("-", [(0.04, sum(one[n] != other[n] for n in one))]))
        study.check("files" + suffix, "series: files that differ", 0.0, "max error", 0.0, f"""
            To the bit, {len(one)} files: fields, dumps, history, the state of the gas.""")
