#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Installs bedscope to a folder of its own, builds the outside project beside this file against it
# and runs both programs.
#   run.sh CMAKE BUILD_FOLDER WORK_FOLDER COMPILER
set -eux
cmake=$1 build=$2 work=$3 compiler=$4
rm -rf "$work"
"$cmake" --install "$build" --prefix "$work/installed" >/dev/null
"$cmake" -G Ninja -S "$(dirname "$0")" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/installed" \
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler"
"$cmake" --build "$work/build"
(cd "$work" && build/consumer)
"$work/installed/bin/bedscope" --help >/dev/null
