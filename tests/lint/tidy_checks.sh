#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Every entry of Checks in .clang-tidy names checks that clang-tidy has: it says nothing about a
# misspelt one, which then looks for nothing.
#   tidy_checks.sh FOLDER
set -eu
cd "$1"
entries=$(sed -n '/^Checks:/,/^[^ ]*:/p' .clang-tidy | sed -n 's/^  -\{0,1\}\([a-z][^,]*\),\{0,1\}$/\1/p')
[ -n "$entries" ] || { echo ".clang-tidy: no checks found"; exit 1; }
bad=$(echo "$entries" | while read -r entry; do
  clang-tidy --checks="-*,$entry" --list-checks 2>/dev/null | grep -q '^  ' ||
    echo ".clang-tidy: $entry names no check"
done)
[ -z "$bad" ] || { echo "$bad"; exit 1; }
