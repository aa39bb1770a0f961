#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Texts of errors start in lower case (or with a name in capitals, like VTK) and end without a full
# stop. Looks at the literals that stand first in FileError(, FormatError( and InputError(.
#   error_texts.sh FOLDER
set -eu
. "$(dirname "$0")/sources.sh"
cd "$1"

sources '*.hpp' '*.cpp' | xargs awk '
  function look(text,    line, literal, before) {
    line = 1
    while (match(text, /(File|Format|Input)Error\([ \n]*("([^"\\]|\\.)*"[ \n]*)+/)) {
      before = substr(text, 1, RSTART)
      line += gsub(/\n/, "", before)
      literal = substr(text, RSTART, RLENGTH)
      text = substr(text, RSTART + 1)
      sub(/^[^"]*"/, "", literal)
      sub(/"[ \n]*$/, "", literal)
      if (literal ~ /^[A-Z]([^A-Z]|$)/) complain(line, "starts in upper case", literal)
      if (literal ~ /\.$/) complain(line, "ends in a full stop", literal)
    }
  }
  function complain(line, what, literal) {
    printf "%s:%d: error text %s: \"%s\"\n", file, line, what, literal
    bad = 1
  }
  FNR == 1 && file != "" { look(text); text = "" }
  { file = FILENAME; text = text $0 "\n" }
  END { look(text); exit bad }'
