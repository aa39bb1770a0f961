# SPDX-License-Identifier: BSD-3-Clause
# Every library from outside, each a Debian package (scripts/bootstrap installs them).
# Read by the build and, installed, by find_package(bedscope).
find_package(Threads REQUIRED)
find_package(ZLIB REQUIRED)
find_package(fmt REQUIRED)
find_package(OpenCVImgproc REQUIRED MODULE)
find_package(OpenCVImgcodecs REQUIRED MODULE)
find_package(HDF5 REQUIRED COMPONENTS C)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)
