#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Builds the fuzz targets and their seeds in build/fuzz; 77 (skipped) where there is no libFuzzer.
#   build.sh PROJECT
set -eu
cd "$1"
probe=$(mktemp)
trap 'rm -f "$probe"' EXIT
echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' |
  clang++ -fsanitize=fuzzer,address -x c++ - -o "$probe" 2>/dev/null || {
  echo "skipped: no clang++ with libFuzzer here; scripts/bootstrap --tests installs it"
  exit 77
}
cmake --preset fuzz
cmake --build --preset fuzz
