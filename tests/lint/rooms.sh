#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# No room includes a header of a room that it may not know.
#   rooms.sh FOLDER
set -eu
cd "$1"

# What each room may include besides itself; app and tests may include all. Everybody but physics
# may name the project's own error types: they are what crosses every room, up to exit code 2; who
# has TOML files of its own reads them by readers/toml_table.hpp. cases/coupled is no part of the room
# but a program of its own, on OpenFOAM and LIGGGHTS.
rooms='physics:
readers:
analysis: readers/ physics/
validation: readers/error.hpp readers/toml_table.hpp analysis/ physics/
validation/digitise: readers/error.hpp
report: readers/error.hpp analysis/ validation/
cases: readers/error.hpp readers/toml_table.hpp physics/'

bad=$(echo "$rooms" | while IFS=: read -r room allowed; do
  [ -d "$room" ] || continue
  find "$room" -path cases/coupled -prune -o \( -name '*.hpp' -o -name '*.cpp' \) -exec grep -Hn '^ *# *include *["<]' {} + |
    awk -v room="$room" -v allowed="$room/ $allowed" '
      BEGIN { n = split(allowed, may, " ") }
      {
        match($0, /["<][^">]*/)
        header = substr($0, RSTART + 1, RLENGTH - 1)
        ours = header ~ /^(physics|readers|analysis|validation|report|cases|app|tests)\//
        if (!ours && substr($0, RSTART, 1) == "<") next  # a library
        for (i = 1; i <= n; ++i) if (index(header, may[i]) == 1) next
        split($0, place, ":")
        printf "%s:%s: %s must not include %s\n", place[1], place[2], room, header
      }'
done)
[ -z "$bad" ] || { echo "$bad"; exit 1; }
