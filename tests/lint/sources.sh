# SPDX-License-Identifier: BSD-3-Clause
# sources PATTERN...: the files of the current folder with such names, without what is built.
sources() {
  names=
  for pattern in "$@"; do names="$names -o -name $pattern"; done
  set -f
  find . \( -path ./build -o -path ./.git \) -prune -o \( ${names# -o} \) -type f -print | sort
  set +f
}
