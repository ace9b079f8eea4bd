#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Everything compiles with clang under the same warnings; the unit tests pass.
set -eu
cd "$(dirname "$0")/../.."
. tools/setup.sh
configure_and_build build-clang -DCMAKE_C_COMPILER=clang -DFW_TESTS=ON -DFW_PAGE=OFF
ctest --test-dir build-clang -L quick --output-on-failure -j 2
