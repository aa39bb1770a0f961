#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# A source that has a header of its name includes it first: the build then shows that the header compiles alone.
#   own_header_first.sh FOLDER
set -eu
. "$(dirname "$0")/sources.sh"
cd "$1"
bad=$(sources '*.cpp' | sed 's|^\./||' | while read -r source; do
  header=${source%.cpp}.hpp
  case "$source" in tests/* | cases/coupled/*) continue ;; esac  # of no room
  [ -f "$header" ] || continue
  first=$(grep -m 1 '^ *# *include' "$source" || true)
  [ "$first" = "#include \"$header\"" ] || echo "$source: includes something before $header"
done)
[ -z "$bad" ] || { echo "$bad"; exit 1; }
