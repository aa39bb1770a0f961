#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Measures bedscope against the peers and against the limit of reading, alternately and in one go:
# whole processes, warm files, one thread each. Prints ratios as the table of docs/performance.md.
#
#   run.sh INPUT PROGRAM [ROUNDS]
#
# INPUT is the folder of make_input.sh, PROGRAM the built `bedscope` (or - : the peers alone). Needs a C++
# compiler, GNU time and Debian's python3-vtk9, python3-numpy, python3-scipy.
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: run.sh INPUT PROGRAM [ROUNDS]" >&2; exit 2; }
[ -x /usr/bin/time ] || { echo "run.sh: needs Debian's package time" >&2; exit 2; }
[ "$2" = - ] || [ -x "$2" ] || { echo "run.sh: $2 is not a program" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 MKL_NUM_THREADS=1 VTK_SMP_MAX_THREADS=1 LC_ALL=C.UTF-8
"${CXX:-c++}" -std=c++20 -O3 -o "$work/limits" "$here/../bench/limits.cpp"
/usr/bin/python3 "$here/measure.py" "$(cd "$1" && pwd)" "$2" "$work" "${3:-5}"
