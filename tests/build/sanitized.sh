#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The second compiler, clang, has no warning about any source either. What it builds runs under
# AddressSanitizer and UndefinedBehaviorSanitizer without recovery: the unit tests, and the whole
# program on the gallery.
set -eu
cd "$(dirname "$0")/../.."
. tools/setup.sh
. tests/build/sanitized_build.sh
sanitized_build sanitized
# What both builds find of numbers the other one found: left out are tests of motion that take seconds and reach no branch
# that others do not, but for 38 of 42875. Hard tests alone reach 119, one of them 73. What reads sources and pages runs nothing
# of ours.
ctest --test-dir build-asan -L quick --output-on-failure -j 2 \
    -E '^(arch|gate|judge|library)|^docs.(accuracy|effects|masks|names|pages)|dynamics.test_(trust|method_motions|envelope|peak|element_motion|hinge_bounds)|test_cancel_threads|hard_(flat|impacts|redundant)'
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
{
    FW_TEST_QUICK=1 build-asan/tests/test_hard_numbers
    # the server and its workers; the tests fail when anything is said on standard error
    python3 tests/serve/hostile.py build-asan/flexwright
    python3 tests/serve/robust.py build-asan/flexwright file words entry streams signals
} >"$out/log" 2>&1 &
beside=$!
for device in docs/gallery/*/device.xml; do
    status=0
    case $device in */copper-nodder/*) expected=1 ;; *) expected=0 ;; esac # rejected, accepted
    build-asan/flexwright plan "$device" --accuracy 3e-2 --advice none -o "$out/plan" -q >/dev/null || status=$?
    [ "$status" -eq "$expected" ] || { echo "$device: status $status, not $expected"; exit 1; }
    build-asan/flexwright simulate "$device" --accuracy 3e-2 --json >/dev/null
done
wait "$beside" || {
    cat "$out/log"
    exit 1
}
