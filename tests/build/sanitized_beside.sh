#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What runs under the sanitizers besides unit tests: the whole program on the gallery, the server and its workers.
# sanitized_beside.sh DIRECTORY-OF-THE-BUILD
set -eu
cd "$(dirname "$0")/../.."
build=$1
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
{
    FW_TEST_QUICK=1 "$build/tests/test_hard_numbers"
    # the server and its workers; the tests fail when anything is said on standard error
    python3 tests/serve/hostile.py "$build/flexwright"
    python3 tests/serve/robust.py "$build/flexwright" file words entry streams signals
} >"$out/log" 2>&1 &
beside=$!
number=0
for device in docs/gallery/*/device.xml; do
    number=$((number + 1))
    [ "${FW_TURN:-all}" = all ] || [ $((number % 4)) -eq $((FW_TURN / 2)) ] || continue # tests/turn.py
    status=0
    case $device in */copper-nodder/*) expected=1 ;; *) expected=0 ;; esac # rejected, accepted
    corners=auto # of devices whose corners take ten times what the drawing takes: what the others run, too
    case $device in */four-tendons/* | */free-form-gripper/*) [ -n "${FW_TEST_ALL:-}" ] || corners=none ;; esac
    "$build/flexwright" plan "$device" --accuracy 3e-2 --advice none --corners $corners -o "$out/plan" -q >/dev/null || status=$?
    [ "$status" -eq "$expected" ] || { echo "$device: status $status, not $expected"; exit 1; }
    "$build/flexwright" simulate "$device" --accuracy 3e-2 --json >/dev/null
done
# laws that come again are followed once more at corners, with what is kept of a device that is given back
status=0
"$build/flexwright" check tests/data/clearance/comb-root.xml --corners auto --advice none -q >/dev/null || status=$?
[ "$status" -eq 1 ] || { echo "comb-root: status $status, not 1"; exit 1; }
wait "$beside" || {
    cat "$out/log"
    exit 1
}
