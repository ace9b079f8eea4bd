#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The program and some hard cases, shortened by FW_TEST_QUICK, under valgrind: reads of what was never
# written, reads and writes beyond what was allocated, leaks. valgrind.sh DIRECTORY-OF-THE-BUILD [case ...]
set -eu
cd "$(dirname "$0")/../.."
command -v valgrind >/dev/null || {
    echo "valgrind is not installed: skipped"
    exit 77
}
build=$1
shift
status=0
log=$(mktemp) out=$(mktemp -d)
trap 'rm -rf "$log" "$out"' EXIT
clean() { # NAME COMMAND ...
    name=$1
    shift
    if valgrind -q --error-exitcode=99 --leak-check=full --errors-for-leak-kinds=definite "$@" >"$log" 2>&1; then
        echo "$name: clean"
    else
        echo "$name: FAILED"
        cat "$log"
        status=1
    fi
}
# all rooms: judged, drawn, written; then a motion
if [ $# -eq 0 ]; then
    corners=none # the same lines, at each corner of the flow once more
    [ -z "${FW_TEST_ALL:-}" ] || corners=auto
    clean plan "$build/flexwright" plan docs/gallery/leaf-four-bar/device.xml --accuracy 3e-2 --advice none --corners $corners -q -o "$out"
    clean simulate "$build/flexwright" simulate docs/gallery/reference-six-bar/device.xml --accuracy 3e-2 --json
fi
# some forty times slower than alone: the others take it longer than ten seconds and run when they are named
[ $# -gt 0 ] || set -- pendulum snap squeezer
export FW_TEST_QUICK=1
for name in "$@"; do
    clean "hard.$name" "$build/tests/test_hard_$name"
done
exit $status
