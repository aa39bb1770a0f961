#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Verifies bedscope-coupled: runs small cases and has `bedscope validate` judge them.

    verify.py [--fresh] FOLDER [NAME ...]    all, or those named; FOLDER/NAME/report/report.html is the page of each

The programs are those of build/release, or BEDSCOPE_COUPLED and BEDSCOPE. Exit code 0: every check
holds; 1: one does not, or cannot be decided; 2: usage. With --fresh the
FOLDER/NAME of an earlier time are replaced.
"""
import importlib
import os
import pathlib
import shutil
import sys
import time

BUILD = pathlib.Path(__file__).resolve().parents[2] / "build/release"
os.environ.setdefault("BEDSCOPE", str(BUILD / "app/bedscope"))
os.environ.setdefault("BEDSCOPE_COUPLED", str(BUILD / "cases/coupled/bedscope-coupled"))

NAMES = ["single_particle", "terminal_velocity", "restitution", "packed_bed", "fluidised_bed", "conservation",
         "fixed_bed_heat", "stirred_bed_heat", "two_ranks", "restart"]


def main(folder, names, fresh):
    failed = []
    for name in names:
        from study import Study
        module = importlib.import_module(name)
        begin, cpu = time.time(), os.times()
        place = pathlib.Path(folder).resolve() / name
        if place.exists() and not fresh:
            print(f"verify.py: {place} is there already; --fresh replaces it", file=sys.stderr)
            return 2
        shutil.rmtree(place, ignore_errors=True)
        study = Study(place, module.TITLE, module.__doc__)
        print(f"{name}: {module.TITLE}", flush=True)
        module.verify(study)
        if not study.judge():
            failed.append(name)
        used = sum(os.times()[:4]) - sum(cpu[:4])
        print(f"  {study.folder}/report/report.html ({used:.0f} s of processor time, {time.time() - begin:.0f} s)", flush=True)
    print(f"{len(names) - len(failed)} of {len(names)} hold" + (": not " + ", ".join(failed) if failed else ""))
    return 1 if failed else 0


if __name__ == "__main__":
    words = [word for word in sys.argv[1:] if word != "--fresh"]
    if not words or any(w.startswith("-") for w in words) or set(words[1:]) - set(NAMES):
        print(__doc__ + "NAME: " + ", ".join(NAMES), file=sys.stderr)
        sys.exit(2)
    sys.exit(main(words[0], words[1:] or NAMES, "--fresh" in sys.argv))
