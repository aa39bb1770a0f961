#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Lints the lints: each one passes a clean tree and minds a planted violation by name.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

# fails LINT EXPECTED FILE TEXT: the lint minds the file in these words.
fails() {
  mkdir -p "$tree/$(dirname "$3")"
  printf '%b' "$4" > "$tree/$3"
  if found=$("$here/$1.sh" "$tree" 2>&1); then echo "$1 passes $3: $4"; exit 1; fi
  case "$found" in
    *"$2"*) ;;
    *) echo "$1 should say '$2', says: $found"; exit 1 ;;
  esac
  rm "$tree/$3"
}
# catches: the same, and without the file the lint has nothing to say.
catches() {
  "$here/$1.sh" "$tree" || { echo "$1 minds a clean tree"; exit 1; }
  fails "$@"
}
# passes LINT FILE TEXT: the lint has nothing against it.
passes() {
  mkdir -p "$tree/$(dirname "$2")"
  printf '%b' "$3" > "$tree/$2"
  "$here/$1.sh" "$tree" || { echo "$1 minds $2: $3"; exit 1; }
  rm "$tree/$2"
}

spdx='// SPDX-License-Identifier: BSD-3-Clause\n'
mkdir "$tree/readers" "$tree/docs"
printf "$spdx" > "$tree/readers/good.hpp"

catches rooms 'readers/up.cpp:2: readers must not include analysis/grid.hpp' \
  readers/up.cpp "$spdx"'#include "analysis/grid.hpp"\n'
catches rooms 'must not include readers/error.hpp' physics/up.hpp '#include <readers/error.hpp>\n'
catches rooms 'must not include readers/series.hpp' report/a.cpp '# include "readers/series.hpp"\n'
catches rooms 'must not include ../analysis/grid.hpp' readers/up.cpp '#include "../analysis/grid.hpp"\n'
catches rooms 'validation/digitise must not include analysis/grid.hpp' \
  validation/digitise/a.cpp '#include "analysis/grid.hpp"\n'
passes rooms report/a.cpp '#include <vector>\n#include "readers/error.hpp"\n#include "analysis/grid.hpp"\n'
passes rooms app/a.cpp '#include "cases/scene.hpp"\n'

printf "$spdx" > "$tree/readers/own.hpp"
catches own_header_first 'readers/own.cpp: includes something before readers/own.hpp' \
  readers/own.cpp "$spdx"'#include <vector>\n#include "readers/own.hpp"\n'
fails own_header_first 'readers/own.cpp: includes' readers/own.cpp "$spdx"'int x;\n'
passes own_header_first readers/own.cpp "$spdx"'#include "readers/own.hpp"\n#include <vector>\n'
passes own_header_first readers/other.cpp "$spdx"'#include <vector>\n'
rm "$tree/readers/own.hpp"

catches licences './analysis/bare.cpp: no SPDX line' analysis/bare.cpp 'int x;\n'
catches licences 'scripts/run: no SPDX line' scripts/run '#!/bin/sh\n'

catches error_texts 'a.cpp:2: error text starts in upper case' readers/a.cpp \
  '\nthrow FileError("Cannot open {}", path);\n'
catches error_texts 'a.cpp:3: error text ends in a full stop' readers/a.cpp \
  'throw FileError("one");\n\nthrow FormatError(\n    "{}: cut "\n    "off.",\n path);\n'
passes error_texts readers/a.cpp 'throw InputError("VTK \\"x\\" is off");\nInputError(text + ".");\n'

catches paths 'README.md:1: readers/none.cpp does not exist' README.md 'see `readers/none.cpp`.\n'
catches paths 'docs/a.md:2: docs/b.md does not exist' docs/a.md '\n[b](b.md#part)\n'
catches paths 'docs/a.md:1: readers/*.py does not exist' docs/a.md '`readers/*.py`\n'
passes paths docs/a.md 'In readers/good.hpp. [it](../readers/good.hpp) `readers/<form>.cpp` `readers/*.hpp`\n'

if command -v clang-format >/dev/null; then
  catches format 'readers/a.cpp:1' readers/a.cpp 'int  x;\n'
fi
if command -v clang-tidy >/dev/null; then
  tidy='Checks: >\n  -*,\n  bugprone-*,\n  '
  passes tidy_checks .clang-tidy "$tidy-bugprone-branch-clone\nOther: x\n"
  fails tidy_checks 'cppcoreguideline-* names no check' .clang-tidy "${tidy}cppcoreguideline-*\n"
fi
catches_start_up() {  # a program that does load VTK is not at hand, a copy of ldd's words is
  mkdir "$tree/bin"
  printf '#!/bin/sh\necho "libvtkCommonCore-9.1.so.9.1 => /usr/lib/x"\n' > "$tree/bin/ldd"
  chmod +x "$tree/bin/ldd"
  if PATH="$tree/bin:$PATH" "$here/start_up.sh" program >/dev/null; then
    echo "start_up passes a program that loads VTK"; exit 1
  fi
}
catches_start_up
