# SPDX-License-Identifier: BSD-3-Clause
"""The packed bed at 0.45 m/s on one rank and on two, the gas mesh cut across (as LIGGGHTS cuts) and along the flow;
a fluidised bed of 1,440 spheres on one rank and on two.

Expected: of the bed at rest the same pressure drop; where particles move their paths part, as all paths in a
fluidised bed do after a change in the last digit, but means agree within their errors.
"""
import fluidised_bed
import packed_bed

TITLE = "Two ranks against one"


def verify(study):
    for ranks, cut in ((1, None), (2, "(1 1 2)"), (2, "(2 1 1)")):
        label = {None: "rest, 1 rank", "(1 1 2)": "rest, 2 ranks", "(2 1 1)": "rest, 2 ranks along"}[cut]
        one = packed_bed.case(study.folder / label.replace(" ", "_").replace(",", ""), 0.45)
        if cut:
            choice = one.folder / "CFD/system/decomposeParDict"
            choice.write_text(choice.read_text().replace("(1 1 2)", cut))
        one.run(ranks=ranks)
        study.run(label, one, (0.02, 0.02), (one.cells[0], one.cells[2]), **({"decomposition": "processors"} if cut else {}))
        if cut:
            study.check(label, "pressure drop", "run:rest, 1 rank", "relative bias", 1e-4,
                        "What is asked of the solver; tolerances of 1e-9 leave some 1e-8.")
    begin, end = 0.1, 0.5
    for ranks in (1, 2):
        label = f"moving, {ranks} rank" + "s" * (ranks - 1)
        one = fluidised_bed.case(study.folder / f"moving_{ranks}", 0.75, end)
        one.run(ranks=ranks)
        study.run(label, one, (begin, end), (fluidised_bed.CELLS[0], fluidised_bed.CELLS[2]), **({"decomposition": "processors"} if ranks > 1 else {}))
        assert one.record()["conservation"]["momentum_exchange_worst"] < 1e-11
    for quantity in ("pressure drop", "bed height"):
        study.check("moving, 2 ranks", quantity, "run:moving, 1 rank", "e over u", 3.0, """
            Three standard uncertainties of the difference (99.7 %), which must be below a fifth of the value to mean something.
            """, accuracy=0.2)
