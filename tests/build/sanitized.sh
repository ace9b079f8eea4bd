#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The second compiler, clang, has no warning about any source either. What it builds runs under
# AddressSanitizer and UndefinedBehaviorSanitizer without recovery: of the unit tests all but long ones that
# add few edges of control flow (tests/edges), with FW_TEST_ALL=1 (./test --all) all of them; and the whole program on
# the gallery. At the end it says which external functions of src/ ran in none. In every second turn of ./test (tests/turn.py) a quarter
# runs, and always what reads the bytes of strangers: half of the time goes into compiling it, whatever runs then.
set -eu
cd "$(dirname "$0")/../.."
. tools/setup.sh
. tests/build/sanitized_build.sh
all=OFF
[ -z "${FW_TEST_ALL:-}" ] || all=ON
sanitized_build sanitized -DFW_SANITIZE_ALL=$all
[ -n "${FW_TEST_ALL:-}" ] || export FW_TEST_FEWEST=1 # asked by test_fewest() of tests/unit/test.h
FW_EDGES_TO=$(mktemp -d)
export FW_EDGES_TO
log=$(mktemp)
trap 'rm -rf "$FW_EDGES_TO" "$log"' EXIT
tests/build/sanitized_beside.sh build-asan >"$log" 2>&1 &
beside=$!
tests/build/sanitized_unit.sh build-asan "$sanitized_never"
ctest --test-dir build-asan -L 'quick|longer' --output-on-failure -j 2 -E "^unit|$sanitized_never"
wait "$beside" || {
    cat "$log"
    exit 1
}
[ "${FW_TURN:-all}" != all ] || python3 tests/edges/edges.py reached "$FW_EDGES_TO" build-asan || echo "this is said, and is no failure"
