#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Runs one fuzz target from its seeds for some seconds and prints the end of its log. What it finds
# stays in FOLDER/findings. 77 (skipped) where the targets were not built.
#   run.sh FOLDER TARGET SECONDS
set -eu
folder=$1 target=$2 seconds=$3
dictionaries=$(cd "$(dirname "$0")" && pwd)
cd "$folder" 2>/dev/null || { echo "skipped: no fuzz targets in $folder"; exit 77; }
program=$(sed -n "s/^$target //p" targets.txt)
[ -n "$program" ] && [ -x "fuzz_$program" ] || { echo "skipped: $target is not built"; exit 77; }

mkdir -p findings
corpus=$(mktemp -d)
trap 'rm -rf "$corpus"' EXIT
dictionary="$dictionaries/$target.dict"
[ -f "$dictionary" ] || dictionary="$dictionaries/foam.dict"

# One seed for all runs: a change is judged by the change, not by luck.
"./fuzz_$program" -seed=1 -max_total_time="$seconds" -max_len=8192 -timeout=10 -rss_limit_mb=1024 \
  -malloc_limit_mb=256 -dict="$dictionary" -print_final_stats=1 \
  -artifact_prefix="findings/$target-" "$corpus" "seeds/$target" >"$corpus.log" 2>&1 && bad=0 || bad=1
[ "$bad" = 0 ] && tail -n 8 "$corpus.log" || tail -n 60 "$corpus.log"
rm -f "$corpus.log"
exit "$bad"
