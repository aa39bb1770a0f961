#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Every source file names its licence in its first three lines.
#   licences.sh FOLDER
set -eu
. "$(dirname "$0")/sources.sh"
cd "$1"

bad=$({ sources '*.hpp' '*.cpp' '*.cmake' 'CMakeLists.txt' '*.sh' '*.py' '*.supp'
        find scripts .ci -type f 2>/dev/null; } |
  while read -r file; do
    head -n 3 "$file" | grep -q 'SPDX-License-Identifier: ' || echo "$file: no SPDX line"
  done)
[ -z "$bad" ] || { echo "$bad"; exit 1; }
