# SPDX-License-Identifier: BSD-3-Clause
"""The measuring part of run.sh: `measure.py INPUT PROGRAM WORK ROUNDS`.

Every round runs every contestant once; a ratio is taken within a round and its median over the rounds is
given, so that a machine that becomes slower or faster meanwhile changes little.
"""

import os
import shutil
import statistics
import subprocess
import sys
import time

import products

HERE = os.path.dirname(os.path.abspath(__file__))
PATTERN = {"text": "dump*.liggghts_run", "ascii": "bed_*.vtk", "binary": "bed_*.vtk", "binary500": "bed_*.vtk"}


def run(command):
    """(wall, CPU) seconds of a whole process; ends everything where it fails."""
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    output = process.stderr.read()
    _, status, used = os.wait4(process.pid, 0)
    wall = time.perf_counter() - start
    if status != 0:
        sys.exit(f"measure.py: {' '.join(command[:6])}: exit code {os.waitstatus_to_exitcode(status)}\n{output.decode()}")
    return wall, used.ru_utime + used.ru_stime


def write_study(path, folder, form, mapping):
    steps = [step for step, _ in products.snapshot_paths(folder)]
    with open(path, "w") as file:
        file.write(f'''title = "Speed"
[scene]
domain  = {{ min = [{products.X_MIN!r}, 0.0, {products.Z_MIN!r}], max = [{products.X_MAX!r}, {products.DEPTH}, {products.Z_MAX!r}] }}
up      = "z"
lateral = "x"
cells   = [{products.CELLS[0]}, {products.CELLS[1]}]
density = {products.DENSITY}
average = {{ from = {steps[0] * products.TIME_STEP!r}, to = {steps[-1] * products.TIME_STEP!r} }}
mapping = "{mapping}"
[profiles]
heights = {list(products.HEIGHTS)}
band    = {products.BAND}
[clusters]
threshold = {products.THRESHOLD}
core      = {products.CORE}
min_area  = {products.MIN_AREA}
[[run]]
label     = "{form}"
particles = "{folder}/{PATTERN[form]}"
time_step = {products.TIME_STEP}
''')


class Measurement:
    def __init__(self, source, program, work, rounds):
        self.work, self.rounds, self.program = work, rounds, program
        self.folders = {form: os.path.join(source, form) for form in PATTERN}
        self.files = {form: [p for _, p in products.snapshot_paths(f)] for form, f in self.folders.items()}
        self.times = {}  # contestant -> list of (wall, CPU), a round each

    def out(self, name):
        return os.path.join(self.work, name)

    def ours(self, form, mapping="centre", threads=1):
        study = self.out(f"{form}_{mapping}.toml")
        write_study(study, self.folders[form], form, mapping)
        return [self.program, "analyse", study, "-o", self.out(f"ours_{form}_{mapping}_{threads}"), "--tables-only",
                "--quiet", "--threads", str(threads)]

    def peer(self, form):
        script = "peer_text.py" if form == "text" else "peer_vtk.py"
        return [sys.executable, os.path.join(HERE, script), self.folders[form], self.out(f"peer_{form}")]

    def contestants(self):
        forms = ("binary500", "ascii", "text")
        commands = {f"peer {form}": self.peer(form) for form in forms}
        commands["limit binary500"] = [self.out("limits"), *self.files["binary500"]]
        commands["cat binary500"] = ["cat", *self.files["binary500"]]
        if self.program != "-":
            commands.update({f"ours {form}": self.ours(form) for form in forms})
            commands["ours binary500 exact"] = self.ours("binary500", "exact")
            commands["ours text exact"] = self.ours("text", "exact")
            commands["ours text 2 threads"] = self.ours("text", threads=2)
        return commands

    def measure(self):
        commands = self.contestants()
        for paths in self.files.values():  # into the page cache
            for path in paths:
                with open(path, "rb") as file:
                    while file.read(1 << 20):
                        pass
        for round_number in range(self.rounds):
            for name, command in commands.items():
                if name.startswith("ours"):
                    shutil.rmtree(command[4], ignore_errors=True)
                self.times.setdefault(name, []).append(run(command))
            print(f"round {round_number + 1} of {self.rounds} done", file=sys.stderr)

    def print_times(self):
        print("| whole process, one thread | wall, ms a snapshot | CPU, ms a snapshot | MB/s of CPU |")
        print("|---|---|---|---|")
        for name, times in self.times.items():
            files = self.files[name.split()[1]]
            size = sum(os.path.getsize(path) for path in files)
            wall, cpu = (statistics.median(t[i] for t in times) for i in (0, 1))
            print(f"| {name} | {1e3 * wall / len(files):.2f} | {1e3 * cpu / len(files):.2f} | {size / cpu / 1e6:.0f} |")

    def ratio(self, title, above, below, target):
        def of(i):
            values = [a[i] / b[i] for a, b in zip(self.times[above], self.times[below])]
            return f"{statistics.median(values):.2f} ({min(values):.2f}-{max(values):.2f})"

        print(f"| {title} | {of(0)} | {of(1)} | {target} |")

    def print_ratios(self):
        print("\n| ratio of whole processes | wall: median (range) | CPU: median (range) | asked for |")
        print("|---|---|---|---|")
        self.ratio("legacy binary: peer / ours", "peer binary500", "ours binary500", "at least 10")
        self.ratio("legacy binary: ours / limit", "ours binary500", "limit binary500", "at most 3")
        self.ratio("legacy ASCII: peer / ours", "peer ascii", "ours ascii", "at least 8")
        self.ratio("text: peer / ours", "peer text", "ours text", "at least 5")
        self.ratio("text: exact / centre", "ours text exact", "ours text", "at most 1.5")
        self.ratio("legacy binary: exact / centre", "ours binary500 exact", "ours binary500", "at most 3")
        self.ratio("text: one thread / two threads", "ours text", "ours text 2 threads", "at least 1.8 (wall, idle machine)")

    def print_memory(self):
        peaks = []
        for form in ("binary", "binary500"):
            record = self.out("peak")
            # GNU time starts the program from a small process: a fork of this one would count our own memory.
            run(["/usr/bin/time", "-f", "%M", "-o", record, *self.ours(form)])
            with open(record) as file:
                peaks.append(int(file.read().split()[-1]))
        print(f"\nPeak memory: 50 snapshots {peaks[0]} kB, 500 snapshots {peaks[1]} kB,"
              f" {100 * (peaks[1] / peaks[0] - 1):+.1f} % (asked for: within 5 %).")

    def agree(self):
        good = True
        for form in ("binary500", "ascii", "text"):
            result = subprocess.run([sys.executable, os.path.join(HERE, "compare.py"), self.out(f"ours_{form}_centre_1"),
                                     self.out(f"peer_{form}")], capture_output=True, text=True)
            lines = result.stdout.splitlines()
            bad = [line for line in lines if line.startswith("DIFFER")]
            print(f"\n{form}: {len(lines) - len(bad)} of {len(lines)} comparisons with the peer agree")
            print(*bad, result.stderr, sep="\n", end="")
            good &= result.returncode == 0
        return good


def main():
    source, program, work, rounds = sys.argv[1:]
    if program != "-":
        program = os.path.abspath(program)
    measurement = Measurement(source, program, work, int(rounds))
    for form, files in measurement.files.items():
        if not files:
            sys.exit(f"measure.py: no snapshots under {measurement.folders[form]}: run make_input.sh first")
    measurement.measure()
    measurement.print_times()
    if program == "-":
        return 0
    measurement.print_ratios()
    measurement.print_memory()
    return 0 if measurement.agree() else 1


if __name__ == "__main__":
    sys.exit(main())
