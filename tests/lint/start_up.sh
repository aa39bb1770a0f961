#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The program loads neither VTK nor OpenCV's imgcodecs when it starts: 70 ms each.
#   start_up.sh PROGRAM
set -eu
libraries=$(ldd "$1")
if echo "$libraries" | grep -E 'libvtk|opencv_imgcodecs'; then
  echo "$1 loads these libraries at every start"
  exit 1
fi
