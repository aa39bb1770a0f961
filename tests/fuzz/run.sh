#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Runs one fuzz target from its seeds, RUNS inputs or for some seconds, and prints the end of its
# log. What it finds stays in FOLDER/findings. 77 (skipped) where the targets were not built.
#   run.sh FOLDER TARGET SECONDS [RUNS]
set -eu
folder=$1 target=$2 seconds=$3 runs=${4:--1}
dictionaries=$(cd "$(dirname "$0")" && pwd)
cd "$folder" 2>/dev/null || { echo "skipped: no fuzz targets in $folder"; exit 77; }
program=$(sed -n "s/^$target //p" targets.txt)
[ -n "$program" ] && [ -x "fuzz_$program" ] || { echo "skipped: $target is not built"; exit 77; }

mkdir -p findings
log=$(mktemp)
trap 'rm -f "$log"' EXIT
dictionary="$dictionaries/$target.dict"
[ -f "$dictionary" ] || dictionary="$dictionaries/foam.dict"

# The same inputs in every run of the same code, on any machine, so that a change is judged by the
# change and not by luck: one seed, the files in the order of their names and not of the disk, and no
# corpus of other runs; and addresses that stay the same, as libFuzzer learns from comparisons, those
# of pointers too. A slower machine tries the first of them only.
setarch -R true 2>/dev/null && fixed="setarch -R" || fixed=
seeds=$(LC_ALL=C ls -d "seeds/$target"/* | paste -sd, -)
$fixed "./fuzz_$program" -seed=1 -runs="$runs" -max_total_time="$seconds" -max_len=8192 -timeout=60 \
  -rss_limit_mb=1024 -malloc_limit_mb=256 -dict="$dictionary" -print_final_stats=1 \
  -artifact_prefix="findings/$target-" -seed_inputs="$seeds" >"$log" 2>&1 && bad=0 || bad=1
[ "$bad" = 0 ] && tail -n 8 "$log" || tail -n 60 "$log"
exit "$bad"
