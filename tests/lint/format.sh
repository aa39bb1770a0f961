#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# All C++ is as clang-format writes it. `scripts/bootstrap --dev` installs the version that counts.
#   format.sh FOLDER
set -eu
. "$(dirname "$0")/sources.sh"
cd "$1"
sources '*.hpp' '*.cpp' | xargs clang-format --dry-run -Werror
