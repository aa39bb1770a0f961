#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What asking for the axial profile alone saves: CPU time and bytes of whole processes.

    products_bench.py BEDSCOPE FOLDER [ROUNDS]

FOLDER is that of tests/peers/make_input.sh. In a round every contestant runs once, in turn, on one thread; the least CPU
time (user and system) of all rounds is given, and what the reader took from disk. The axial profiles must agree to the bit.
"""
import json
import os
import resource
import subprocess
import sys
import tempfile

STUDY = """{products}
[scene]
domain  = {{ min = [0, 0, 0], max = [0.07, 0.006, 1.57] }}
cells   = [28, 600]
density = 2500
mapping = "centre"
average = {{ from = 0 }}
[[run]]
particles = "{dumps}"
time_step = 1e-5
"""


def cpu_of(words):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main(program, folder, rounds=7):
    with tempfile.TemporaryDirectory() as scratch:
        contestants = []
        for form, pattern in (("text", "text/dump*"), ("ascii", "ascii/*.vtk"), ("binary", "binary/*.vtk")):
            for products in ("", 'products = ["axial"]'):
                name = f"{form}_{'axial' if products else 'all'}"
                path = os.path.join(scratch, name + ".toml")
                with open(path, "w") as file:
                    file.write(STUDY.format(products=products, dumps=os.path.abspath(os.path.join(folder, pattern))))
                contestants.append((name, path, []))
        for _ in range(int(rounds)):
            for name, path, times in contestants:
                times.append(cpu_of([program, "analyse", path, "-o", os.path.join(scratch, name), "--tables-only",
                                     "--fresh", "--quiet", "--threads", "1"]))
        for name, _, times in contestants:
            with open(os.path.join(scratch, name, "summary.json")) as file:
                run = json.load(file)["runs"][0]
            n = run["snapshots"]
            print(f"{name:13} {1e3 * min(times) / n:7.2f} ms a snapshot, {run['bytes_read'] / n / 1e6:6.2f} MB read")
        for form in ("text", "ascii", "binary"):
            tables = [open(os.path.join(scratch, f"{form}_{kind}", "tables/axial_profile.csv")).read().splitlines()
                      for kind in ("axial", "all")]
            only = [line for line in tables[1] if line.split(",")[1] in ("type", "all")]
            assert tables[0] == only, form


if __name__ == "__main__":
    main(*sys.argv[1:])
