#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Writes the input of the speed comparisons with LIGGGHTS itself (two minutes of one core, 0.9 GB):
#   FOLDER/text        50 text dumps of 50,000 particles, 12 columns
#   FOLDER/ascii       the same snapshots as legacy VTK ASCII
#   FOLDER/binary      the same snapshots as legacy VTK binary
#   FOLDER/binary500   500 snapshots: ten times the same 50 as hard links, under growing steps
# Usage: make_input.sh FOLDER
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: make_input.sh FOLDER" >&2; exit 2; }
command -v liggghts > /dev/null || { echo "make_input.sh: needs Debian's package liggghts" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1"
folder=$(cd "$1" && pwd)
rm -rf "$folder"/{text,ascii,binary,binary500}
mkdir -p "$folder"/{text,ascii,binary,binary500}

cd "$folder"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1
liggghts -echo log -in "$here/in.bench_input" -var out . > liggghts.out 2>&1 ||
  { tail -5 liggghts.out >&2; echo "make_input.sh: liggghts failed, see $folder/liggghts.out" >&2; exit 1; }

step_of() { local name=${1##*_}; echo "${name%.vtk}"; }
for file in binary/bed_*.vtk; do
  case $file in *boundingBox*) continue ;; esac
  step=$(step_of "$file")
  for copy in 0 1 2 3 4 5 6 7 8 9; do
    ln "$file" "binary500/bed_$((step + copy * 10000)).vtk"
  done
done
for form in text ascii binary binary500; do
  echo "$form: $(find "$form" -type f ! -name '*boundingBox*' | wc -l) snapshots," \
       "$(find "$form" -type f ! -name '*boundingBox*' -printf '%s\n' |
          awk '{ s += $1 } END { printf "%.2f MB each", s / NR / 1e6 }')"
done
