#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs fuzz targets by hand for a long time, one after the other, and keeps a table of it.

    long.py CPU_SECONDS [FOLDER [TARGET ...]]      after tests/fuzz/build.sh .; all targets where none is named

CPU_SECONDS (of these targets together) are shared out evenly and counted as used, not by the clock, so
it may run at low priority beside other work: `setsid nohup nice -n 19 tests/fuzz/long.py 7200 &`.
FOLDER (default /tmp/bedscope_fuzz) gets copies of the programs, the corpus, which a next run goes on
from, logs, findings and table.md.
"""
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

project = Path(__file__).resolve().parents[2]
built = project / "build/fuzz/tests/fuzz"
most_findings = 5  # of one target; then it is time to mend


def cpu_seconds(pid):
    """User and system time of a process, from /proc (fields 14 and 15, behind the name)."""
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    except (FileNotFoundError, ProcessLookupError):
        return None
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Target:
    def __init__(self, name, program, folder):
        self.name, self.program, self.folder = name, program, folder
        self.cpu = self.clock = 0.0
        self.executions = self.findings = 0
        self.edges = self.features = self.corpus = 0

    def command(self):
        own = project / "tests/fuzz" / f"{self.name}.dict"
        corpus = self.folder / "corpus" / self.name
        corpus.mkdir(parents=True, exist_ok=True)
        return [self.folder / "bin" / f"fuzz_{self.program}", "-max_len=8192", "-timeout=10", "-rss_limit_mb=1024",
                "-malloc_limit_mb=256", "-print_final_stats=1", "-use_value_profile=1",
                f"-dict={own if own.exists() else own.with_name('foam.dict')}",
                f"-artifact_prefix={self.folder}/findings/{self.name}-", corpus, self.folder / "seeds" / self.name]

    def run(self, share, tell):
        while self.cpu < share and self.findings < most_findings:
            log = self.folder / "logs" / f"{self.name}.log"
            with open(log, "wb") as out:
                process = subprocess.Popen(self.command(), stdout=out, stderr=subprocess.STDOUT)
            start, used, asked = time.monotonic(), 0.0, False
            while process.poll() is None:
                time.sleep(2)
                used = cpu_seconds(process.pid) or used
                if self.cpu + used >= share and not asked:
                    process.send_signal(signal.SIGINT)  # libFuzzer prints its statistics and ends
                    asked = True
            self.cpu += used
            self.clock += time.monotonic() - start
            self.read(log.read_text(errors="replace"), asked)
            if not asked:
                shutil.copy(log, log.with_suffix(f".finding{self.findings}.log"))
            tell()

    def read(self, log, asked):
        self.findings += not asked
        executed = re.findall(r"stat::number_of_executed_units:\s*(\d+)", log)
        states = re.findall(r"#(\d+)\s.*?cov: (\d+) ft: (\d+) corp: (\d+)", log)
        self.executions += int(executed[-1] if executed else states[-1][0] if states else 0)
        if states:
            self.edges, self.features, self.corpus = (int(number) for number in states[-1][1:])


def write_table(targets, path, done):
    lines = ["| target | executions | CPU s | executions a CPU second | edges | features | corpus | findings |",
             "|---|---|---|---|---|---|---|---|"]
    for t in targets:
        lines.append(f"| {t.name} | {t.executions:,} | {t.cpu:.0f} | {t.executions / max(t.cpu, 1):.0f} | "
                     f"{t.edges} | {t.features} | {t.corpus} | {t.findings} |")
    lines.append(f"| all | {sum(t.executions for t in targets):,} | {sum(t.cpu for t in targets):.0f} | | | | | "
                 f"{sum(t.findings for t in targets)} |")
    lines.append(f"\n{'done' if done else 'running'}, {time.strftime('%Y-%m-%d %H:%M')}")
    path.with_suffix(".new").write_text("\n".join(lines) + "\n")
    path.with_suffix(".new").replace(path)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    total = float(sys.argv[1])
    folder = Path(sys.argv[2] if len(sys.argv) > 2 else "/tmp/bedscope_fuzz").resolve()
    wanted = sys.argv[3:]
    for name in ("bin", "logs", "findings"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    shutil.copytree(built / "seeds", folder / "seeds", dirs_exist_ok=True)
    targets = [Target(*line.split(), folder) for line in (built / "targets.txt").read_text().splitlines()
               if not wanted or line.split()[0] in wanted]
    for target in targets:
        shutil.copy(built / f"fuzz_{target.program}", folder / "bin")
    table = folder / "table.md"
    write_table(targets, table, False)
    for target in targets:
        target.run(total / len(targets), lambda: write_table(targets, table, False))
    write_table(targets, table, True)


main()
