#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# sanitized_unit.sh DIRECTORY-OF-THE-BUILD EXPRESSION: the unit tests that ctest knows there as quick or longer, but for those of
# the expression, a dozen of one room in one program, two programs at a time. A program takes a fifth of a second to begin under
# AddressSanitizer, which one for each test would pay some three hundred times. In a turn of ./test (tests/turn.py), which is an even one,
# every fourth dozen, and always the rooms that read what strangers wrote.
set -eu
build=$1
case ${2:-} in
--these) # what xargs runs: ROOM NAME...
    shift 2
    room=$1
    shift
    log=$(mktemp)
    trap 'rm -f "$log"' EXIT
    FW_TEST_QUICK=1 timeout 900 "$build/tests/unit_$room" "$@" >"$log" 2>&1 || {
        status=$?
        cat "$log"
        echo "unit_$room $*: status $status"
        exit 1
    }
    echo "unit_$room $*: passed"
    ;;
*)
    # rooms with the most tests first, so that both processors end together
    ctest --test-dir "$build" -L 'quick|longer' -N -E "$2" |
        sed -n 's/^ *Test *#[0-9]*: unit[.]\([a-z_0-9]*\)[.]\([a-z_0-9]*\)$/\1 \2/p' |
        awk '{ n[$1]++; at = $1 " " int((n[$1] - 1) / 12); t[at] = t[at] " " $2; c[at]++ }
             END { for (a in t) { split(a, r, " "); print c[a], r[1] t[a] } }' |
        sort -k1,1nr -k2 | cut -d ' ' -f 2- |
        awk -v turn="${FW_TURN:-all}" 'turn == "all" || /^(base|quantity|xml|device|drawing|process) / || other++ % 4 == int(turn / 2)' >"$build/unit-groups.txt"
    [ -s "$build/unit-groups.txt" ] || { echo "ctest knows no unit tests in $build"; exit 1; }
    xargs -P 2 -L 1 "$0" "$build" --these <"$build/unit-groups.txt"
    ;;
esac
