# SPDX-License-Identifier: BSD-3-Clause
"""Gas volume and momentum in a fluidised bed whose bubbles make the voidage change: what the solver counts in
each of 1,000 gas steps (history.csv, run.json).

Expected: what flows in, less what flows out and what is stored, is nothing; what the particles get of drag
the gas loses; after 0.2 s the gas that came in has gone out or is there.
"""
import fluidised_bed

TITLE = "Gas is kept, and momentum given is momentum taken"


def verify(study):
    case = fluidised_bed.case(study.folder / "case", 0.75, 0.2)
    case.run()
    rows, kept = case.history(), case.record()["conservation"]
    lost = [(r["time"], (r["gas_in"] - r["gas_out"] - r["gas_storage"]) / r["gas_in"]) for r in rows]
    total = (kept["gas_in"] - kept["gas_out"] - kept["gas_stored"]) / kept["gas_in"]
    study.series("bed", gas_lost=("-", lost), gas_lost_in_all=("-", [(0.2, total)]),
                 momentum_exchange_worst=("-", [(0.2, kept["momentum_exchange_worst"])]),
                 height=("m", [(r["time"], r["mean_height"]) for r in rows]))
    heights = [r["mean_height"] for r in rows]
    assert max(heights) > 1.1 * min(heights), "the bed does not move"
    study.check("bed", "series: gas lost history", 0.0, "max error", 1e-7,
                "Of the inflow, in a step: what is asked of the solver; p is solved to 1e-9 of its scale in the last corrector.")
    study.check("bed", "series: gas lost in all", 0.0, "max error", 1e-7, "The same of all that came in.")
    study.check("bed", "series: momentum exchange worst", 0.0, "max error", 1e-12, """
        Of the sum of the drag: rounding, 2.2e-16 for each of 1,440 particles with 29 points is at most 1e-11 and, as the
        signs are random, of the order of 1e-13 to 1e-14.""")
