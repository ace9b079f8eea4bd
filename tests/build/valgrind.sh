#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The hard suite, shortened by FW_TEST_QUICK, under valgrind: reads of what was never written, reads
# and writes beyond what was allocated, leaks. valgrind.sh DIRECTORY-OF-PROGRAMS [case ...]
set -eu
cd "$(dirname "$0")/../.."
command -v valgrind >/dev/null || {
    echo "valgrind is not installed: skipped"
    exit 77
}
programs=$1
shift
# some forty times slower than alone: the cases that take it longer than fifteen seconds (flat, impacts,
# memory, redundant; windows, dead_centre, masses, numbers, periods) run when they are named
[ $# -gt 0 ] || set -- assembly pendulum snap squeezer start stiffness units
export FW_TEST_QUICK=1
status=0
for name in "$@"; do
    log=$(mktemp)
    if valgrind -q --error-exitcode=99 --leak-check=full --errors-for-leak-kinds=definite \
        "$programs/test_hard_$name" >"$log" 2>&1; then
        echo "hard.$name: clean"
    else
        echo "hard.$name: FAILED"
        cat "$log"
        status=1
    fi
    rm -f "$log"
done
exit $status
