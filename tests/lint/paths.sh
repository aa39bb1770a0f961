#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Every path of the project that README.md and docs/*.md name exists: what follows the name of a
# top-level folder and a slash (with * as in the shell), and the targets of relative links.
#   paths.sh FOLDER
set -eu
cd "$1"

folders='physics|readers|analysis|validation|report|cases|data|app|tests|docs|scripts|cmake|\.ci'
bad=$(for page in README.md docs/*.md; do
  [ -f "$page" ] || continue
  { grep -noE "(^|[^A-Za-z0-9_./<>-])($folders)/[A-Za-z0-9_./*-]+" "$page" |
      sed -E 's/^([0-9]+):[^A-Za-z.]?/\1:/; s/[.]+$//'
    grep -noE '\]\([^)#: ]+[)#]' "$page" | sed -E "s|^([0-9]+):\]\(|\1:$(dirname "$page")/|; s/[)#]$//"
  } | while IFS=: read -r line path; do
    ls -d $path >/dev/null 2>&1 || echo "$page:$line: $path does not exist"
  done
done)
[ -z "$bad" ] || { echo "$bad"; exit 1; }
